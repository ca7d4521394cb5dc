//! What is wrong with a cut, in words that fit any operation.

use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_job::operation::Operation;
use vcutc_simulation::disc::{Hold, PassFault, Stretch};
use vcutc_simulation::prove::{ClearingFault, CutFault, Finding, SlitFault};

/// What is wrong with a cut, in words that fit any operation.
#[must_use]
pub fn explained(asked: &dyn Operation, finding: Finding) -> Diagnostic {
    let span = asked.setup().head_span;
    match finding.fault {
        CutFault::NotFreed { needed, .. } if !needed.is_finite() => Diagnostic::new(
            Code::ChipNotFreed,
            format!(
                "{} has one flank, and its tip lies in the material",
                place(&finding)
            ),
            span,
            "a cut of this operation",
        )
        .help("cut the other flank too, or begin at a wall or a side of the stock"),
        CutFault::NotFreed { needed, available } => Diagnostic::new(
            Code::ChipNotFreed,
            format!(
                "{} needs {} mm of edge, the blade has {} mm",
                place(&finding),
                show(needed.to_mm()),
                show(available.to_mm())
            ),
            span,
            "a cut of this operation",
        )
        .help("use a longer blade, or cut less deep"),
        CutFault::Blocked { at, by } => blocked(span, finding, at, by),
        CutFault::Overcut { at, depth } => overcut(asked, finding, at, depth),
        CutFault::Strays { y, by } => Diagnostic::new(
            Code::Internal,
            format!(
                "{} leaves its way by {} mm, which is a fault of the compiler",
                place(&finding),
                show(by.to_mm())
            ),
            span,
            format!("at y {} mm", show(y.to_mm())),
        )
        .help("please report the job together with this message"),
        CutFault::Clearing(fault) => {
            let message = format!("at {}, {}", place(&finding), clearing_words(fault));
            let code = match fault {
                ClearingFault::Uncut { .. } => Code::PocketUncut,
                ClearingFault::Thick { .. } => Code::LayerTooThick,
                ClearingFault::Body { .. } => Code::BodyInWork,
                ClearingFault::Wall { .. } | ClearingFault::Floor { .. } => Code::Overcut,
                ClearingFault::Shank { .. } => Code::NoWayForDisc,
                ClearingFault::Attached { .. } => Code::ChipNotFreed,
                ClearingFault::Pillars { .. } => Code::PillarsStay,
                ClearingFault::Leans
                | ClearingFault::Unopened
                | ClearingFault::Engaged { .. }
                | ClearingFault::Undecided => Code::Internal,
            };
            Diagnostic::new(code, message, span, "a pass of this operation")
        }
        CutFault::Slit(fault) => {
            let message = format!("at {}, {}", place(&finding), slit_words(fault));
            let code = match fault {
                SlitFault::Wall { .. } | SlitFault::Floor { .. } => Code::Overcut,
                SlitFault::Edge { .. } => Code::LayerTooThick,
                SlitFault::Body { .. } => Code::BodyInWork,
                SlitFault::Stays { .. } => Code::WallLeft,
                SlitFault::Strays | SlitFault::Undecided => Code::Internal,
            };
            Diagnostic::new(code, message, span, "a slit of this operation")
        }
        CutFault::Stays { at, height, limit } => {
            let (what, label) = stays_words(at, height, limit);
            let place = place(&finding);
            Diagnostic::new(
                Code::ScallopOverLimit,
                format!("beside {place}, {what}"),
                span,
                label,
            )
        }
        CutFault::Strip(fault) => {
            let (what, label) = strip_words(fault);
            let message = format!("at {}, {what}", place(&finding));
            let code = match fault {
                PassFault::Body { .. } => Code::BodyInWork,
                PassFault::EntersPart { .. } => Code::Overcut,
                _ => Code::ChipNotFreed,
            };
            Diagnostic::new(code, message, span, label)
        }
    }
}

/// What is wrong with a slit along a wall, after "at layer 1, cut 2 (x 12 mm, y 40 mm, z 16 mm), ".
#[must_use]
pub fn slit_words(fault: SlitFault) -> String {
    let mm = |length: Length| show((length.to_mm() * 1e6).ceil() / 1e6);
    match fault {
        SlitFault::Wall { by } => format!("the blade enters a wall by {} mm", mm(by)),
        SlitFault::Floor { by } => format!("the blade goes below the floor by {} mm", mm(by)),
        SlitFault::Strays => "the blade goes neither along a wall nor straight down".to_owned(),
        SlitFault::Edge { needed, available } => {
            format!(
                "the blade needs {} mm of edge and has {} mm",
                mm(needed),
                mm(available)
            )
        }
        SlitFault::Body { above, by } => format!(
            "the body of the blade, from {} mm above its tip, is below the top of the stock by {} mm",
            mm(above),
            mm(by)
        ),
        SlitFault::Stays { by, limit } if by.is_finite() => format!(
            "{} mm stay at the foot of the wall, the limit is {} mm",
            show((by.to_mm() * 1e3).ceil() / 1e3),
            show(limit.to_mm())
        ),
        SlitFault::Stays { .. } => "no slit reaches the floor".to_owned(),
        SlitFault::Undecided => "the walls are too many to say what stays at their foot".to_owned(),
    }
}

/// What is wrong with a pass over a region, after "at layer 2, cut 1 (x 12 mm, y 40 mm, z 16 mm), ".
#[must_use]
pub fn clearing_words(fault: ClearingFault) -> String {
    let mm = |length: Length| show((length.to_mm() * 1e6).ceil() / 1e6);
    match fault {
        ClearingFault::Wall { by } => format!("the tool enters a wall by {} mm", mm(by)),
        ClearingFault::Floor { by } => format!("the tool goes below the floor by {} mm", mm(by)),
        ClearingFault::Leans => "the tool does not stand upright".to_owned(),
        ClearingFault::Unopened => "the program has a hole that the job does not name".to_owned(),
        ClearingFault::Thick { layer, limit } => format!(
            "a layer is {} mm thick, and the tool cuts {} mm",
            mm(layer),
            mm(limit)
        ),
        ClearingFault::Body { above, by } => format!(
            "the body of the tool, from {} mm above its edge, meets a wall by {} mm",
            mm(above),
            mm(by)
        ),
        ClearingFault::Uncut {
            area, widest, limit, ..
        } => format!(
            "{} mm2 stay uncut in places up to {} mm wide, the limit is {} mm2",
            show((area.to_mm2() * 10.0).ceil() / 10.0),
            show((widest.to_mm() * 100.0).ceil() / 100.0),
            show(limit.to_mm2())
        ),
        ClearingFault::Shank { by } => format!(
            "the shank of the disc is {} mm too near to ground that was not freed before",
            show((by.to_mm() * 100.0).ceil() / 100.0)
        ),
        ClearingFault::Attached { area, limit } => format!(
            "{} mm2 of ground stay attached, corners and the limit allow {} mm2",
            show((area.to_mm2() * 10.0).ceil() / 10.0),
            show((limit.to_mm2() * 10.0).floor() / 10.0)
        ),
        ClearingFault::Pillars { area, limit } => format!(
            "{} mm2 stand in corners of walls, the limit is {} mm2",
            show((area.to_mm2() * 10.0).ceil() / 10.0),
            show(limit.to_mm2())
        ),
        ClearingFault::Engaged { angle, limit } => format!(
            "{} deg of the tool's rim are in the material, the limit is {} deg",
            show((angle.to_deg() * 10.0).ceil() / 10.0),
            show(limit.to_deg())
        ),
        ClearingFault::Undecided => {
            "the passes are too many or too entangled to say what they clear".to_owned()
        }
    }
}

/// What is wrong with a pass of a disc, after "at layer 2, cut 3, ", and a label for the operation.
#[must_use]
pub fn strip_words(fault: PassFault) -> (String, String) {
    let mm = |length: Length| show(length.to_mm());
    let over = |stretch: Stretch| format!("x {} mm to {} mm", show(stretch.from), show(stretch.to));
    match fault {
        PassFault::Attached { stretch, hold } => (
            format!("the strip from {} stays attached", over(stretch)),
            match hold {
                Hold::SlitShort { x, above } => {
                    format!(
                        "its slit ends {} mm above the floor at x {} mm",
                        mm(above),
                        show(x)
                    )
                }
                Hold::RimShort { x, by } => {
                    format!(
                        "the rim of the disc ends {} mm before its slit at x {} mm",
                        mm(by),
                        show(x)
                    )
                }
                Hold::Buried { missing } => format!(
                    "the rim of the disc ends {} mm below the surface beside it",
                    mm(missing)
                ),
                Hold::Closed => "no side of it is open".to_owned(),
            },
        ),
        PassFault::Meets(stretch) => (
            "the disc meets more than its strip".to_owned(),
            format!(
                "material up to {} mm above it from {}",
                mm(stretch.height),
                over(stretch)
            ),
        ),
        PassFault::EntersPart { at, depth } => (
            format!("the disc enters the part by {} mm", mm(depth)),
            format!("deepest at {}", point(at)),
        ),
        PassFault::Body { at, depth, .. } => (
            format!("the body of the disc meets the stock by {} mm", mm(depth)),
            format!("deepest at {}", point(at)),
        ),
        PassFault::TooThick { stretch, limit } => (
            format!(
                "the strip is {} mm thick, the disc takes {} mm",
                mm(stretch.height),
                mm(limit)
            ),
            format!("from {}", over(stretch)),
        ),
        PassFault::OverBody { stretch, limit } => (
            format!(
                "a strip of {} mm runs over the body of the disc, which has room for {} mm",
                mm(stretch.height),
                mm(limit)
            ),
            format!("from {}", over(stretch)),
        ),
        PassFault::TooWide {
            stretch,
            width,
            limit,
        } => (
            format!(
                "the strip is {} mm wide, the disc takes {} mm",
                mm(width),
                mm(limit)
            ),
            format!("from {}", over(stretch)),
        ),
    }
}

/// What stays beside a track, after "beside layer 1, track 3, ", and a label.
#[must_use]
pub fn stays_words(at: Point2, height: Length, limit: Length) -> (String, String) {
    let rounded = Length::mm((height.to_mm() * 1e4).ceil() / 1e4);
    (
        format!(
            "{} mm of material stay on the part, the limit is {} mm",
            show(rounded.to_mm()),
            show(limit.to_mm())
        ),
        format!("the most at {}", point(at)),
    )
}

/// A cut whose flank uncut material stands above; the label is at a span.
#[must_use]
pub fn blocked(span: Span, finding: Finding, at: Point2, by: Length) -> Diagnostic {
    Diagnostic::new(
        Code::BladeBlocked,
        format!(
            "above {}, {} mm of uncut material is in the way of the blade",
            place(&finding),
            show(by.to_mm())
        ),
        span,
        format!("the blade meets it at {}", point(at)),
    )
}

/// A cut that enters the part.
#[must_use]
pub fn overcut(asked: &dyn Operation, finding: Finding, at: Point2, depth: Length) -> Diagnostic {
    Diagnostic::new(
        Code::Overcut,
        format!(
            "{} enters the part by {} mm",
            place(&finding),
            show(depth.to_mm())
        ),
        asked.setup().head_span,
        format!("deepest at {}", point(at)),
    )
    .note("the planner keeps every cut out of the part, so this is a fault of the compiler: please report it")
}

/// `layer 7, cut 12 (x 43.2 mm, z 18.6 mm)`.
#[must_use]
pub fn place(finding: &Finding) -> String {
    let (layer, kind, cut) = (finding.layer, finding.kind.noun(), finding.cut);
    let tip = finding.tip;
    match finding.y {
        None => format!("layer {layer}, {kind} {cut} ({})", point(tip)),
        Some(y) => format!(
            "layer {layer}, {kind} {cut} (x {} mm, y {} mm, z {} mm)",
            show(tip.x),
            show(y),
            show(tip.z)
        ),
    }
}

/// `x 43.2 mm, z 18.6 mm`.
#[must_use]
pub fn point(point: Point2) -> String {
    format!("x {} mm, z {} mm", show(point.x), show(point.z))
}

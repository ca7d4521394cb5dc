//! Patterns: the passes over a region, as a job asks for them.

use super::FieldFigures;
use crate::asked::{Axis, ClearPocket, Pattern};
use crate::refused::Why;
use vcutc_backend_api::units::{Angle, Area, Length};
use vcutc_field::axis::Detail;
use vcutc_field::passes::{PassesError, Wanted, passes};
use vcutc_job::Auto;
use vcutc_region::offset::{OffsetFault, Offsets};
use vcutc_region::pass::Pass;
use vcutc_region::pattern::{self, PatternFault, Tool};
use vcutc_region::region::Region;

/// Passes of a pattern.
#[derive(Clone, Debug)]
pub(super) struct Laid {
    pub(super) pattern: Pattern,
    pub(super) passes: Vec<Pass>,
    /// Passes that clear what these leave.
    pub(super) extra: Vec<Pass>,
    /// What the lines of a sound field came to.
    pub(super) field: Option<FieldFigures>,
    /// The largest radius of rounded corners, as far as one was asked for.
    pub(super) corners: Option<Length>,
    /// Where rows go.
    pub(super) angle: Angle,
}

/// Where rows go where that is open.
const ANGLES: [f64; 2] = [0.0, 90.0];

/// Radii beyond all corners, in mm: how round they are is then for what nothing stays between.
const ROUNDEST: f64 = 1e5;

/// The passes of a pattern, in each way that the job leaves open.
///
/// # Errors
/// Why there are none.
pub(super) fn lay(
    asked: &ClearPocket,
    region: &Region,
    tool: &Tool,
    step: f64,
    pattern: Pattern,
) -> Result<Vec<Laid>, Why> {
    let laid = |wanted, angle: f64| {
        let laid = pattern::passes(region, tool, wanted).map_err(|fault| refused(fault, region, tool))?;
        Ok(Laid {
            pattern,
            passes: laid,
            extra: Vec::new(),
            field: None,
            corners: match (pattern, asked.corners.value) {
                (Pattern::Sfs, Auto::Given(corners)) => Some(corners),
                (Pattern::Sfs, Auto::Auto) | (Pattern::Offset | Pattern::Zigzag | Pattern::Field, _) => None,
            },
            angle: Angle::deg(angle),
        })
    };
    match pattern {
        Pattern::Offset => Ok(vec![laid(pattern::Pattern::Offset { step }, 0.0)?]),
        Pattern::Sfs => {
            let corner = asked.corners.value.or(Length::mm(ROUNDEST)).to_mm();
            Ok(vec![laid(pattern::Pattern::Smooth { step, corner }, 0.0)?])
        }
        Pattern::Zigzag => {
            let angles = match asked.angle.value {
                Auto::Given(angle) => vec![angle.to_deg()],
                Auto::Auto => ANGLES.to_vec(),
            };
            let rows = |angle: f64| {
                let rows = pattern::Pattern::Zigzag {
                    step,
                    angle: angle.to_radians(),
                };
                laid(rows, angle)
            };
            angles.into_iter().map(rows).collect()
        }
        Pattern::Field => Ok(vec![along_field(asked, region, tool, step)?]),
    }
}

/// How far the lines of a field lie over its sources where that is open, in steps: it rounds corners to about that radius.
const LIFT: f64 = 0.5;

fn along_field(asked: &ClearPocket, region: &Region, tool: &Tool, step: f64) -> Result<Laid, Why> {
    let lift = asked.lift.value.or(Length::mm(LIFT * step));
    let wanted = Wanted {
        step,
        lift: lift.to_mm(),
        detail: match asked.axis.value {
            Axis::Exact => Detail::True,
            Axis::Simplified => Detail::Simplified,
        },
        uncut: asked.limits.uncut.value.to_mm2(),
    };
    let found = passes(region, tool, &wanted).map_err(|fault| match fault {
        PassesError::TooWide => too_narrow(region, tool),
        PassesError::Level(OffsetFault::NoWalls) => Why::NoWalls,
        PassesError::Parameter
        | PassesError::Axis(_)
        | PassesError::Field(_)
        | PassesError::Lines(_)
        | PassesError::Level(_)
        | PassesError::Coverage(_) => Why::NoField,
    })?;
    Ok(Laid {
        pattern: Pattern::Field,
        field: Some(FieldFigures {
            lift,
            lines: found.lines,
            broken: found.broken,
            extra: found.extra.len(),
            cleared: Area::mm2(found.cleared),
        }),
        passes: found.passes,
        extra: found.extra,
        corners: None,
        angle: Angle::ZERO,
    })
}

fn refused(fault: PatternFault, region: &Region, tool: &Tool) -> Why {
    match fault {
        PatternFault::TooWide => too_narrow(region, tool),
        PatternFault::Offset(fault) => without_level(fault),
        PatternFault::Parameter | PatternFault::TooMany => Why::TooLarge,
    }
}

fn without_level(fault: OffsetFault) -> Why {
    match fault {
        OffsetFault::NoWalls => Why::NoWalls,
        OffsetFault::Broken(at) => Why::Broken { at: [at.x, at.y] },
        OffsetFault::Distance | OffsetFault::Dense => Why::TooLarge,
    }
}

/// How often the width of a region is halved to find its widest circle: to a nanometre.
const HALVINGS: u32 = 40;

/// The widest circle within a region in which a tool does not fit.
fn too_narrow(region: &Region, tool: &Tool) -> Why {
    let mut offsets = Offsets::of(region, tool.reach());
    let (mut fits, mut fits_not) = (0.0, tool.wall_distance());
    let mut at = [0.0; 2];
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(fits, fits_not);
        let place = offsets.level(middle).ok().and_then(|ways| {
            let piece = *ways.first()?.pieces.first()?;
            Some([piece.from.x, piece.from.y])
        });
        match place {
            Some(place) => {
                fits = middle;
                at = place;
            }
            None => fits_not = middle,
        }
    }
    Why::TooNarrow { wide: 2.0 * fits, at }
}

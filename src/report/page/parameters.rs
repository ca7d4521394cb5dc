//! Every parameter of the job with its value and where it came from: a place in a text, `auto` with the reason, or the
//! default of the language.

use super::source::Listing;
use super::{Section, Subject};
use crate::html::{Column, Html, table, unbroken};
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{AxisKind, Edges, Load, Ready, Registered};
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_diagnostics::source::Span;
use vcutc_driver::summary;
use vcutc_job::{Auto, Bounds, Formulas, Machine, Objective, Operation, RoughVcut, Sourced};
use vcutc_process::plan::parameters::show;
use vcutc_process::plan::{PlannedOperation, PlannedVcut};

/// A parameter.
struct Row {
    name: &'static str,
    /// Value and unit.
    value: String,
    origin: Origin,
}

/// Where a value came from.
enum Origin {
    /// Written in a text.
    Written(Span),
    /// Left to the compiler, there if it was written at all, and why it came out so.
    Chosen(Option<Span>, String),
    /// Not written: the default of the language.
    Default,
}

impl Row {
    /// A value of the job.
    fn of<T>(name: &'static str, sourced: Sourced<T>, words: impl FnOnce(T) -> String) -> Self {
        Self {
            name,
            value: words(sourced.value),
            origin: sourced.span.map_or(Origin::Default, Origin::Written),
        }
    }

    /// A value that may have been left open, and what it came out as.
    fn open<T>(name: &'static str, asked: &Sourced<Auto<T>>, value: String, why: impl Into<String>) -> Self {
        let origin = match (&asked.value, asked.span) {
            (Auto::Given(_), Some(span)) => Origin::Written(span),
            (Auto::Given(_), None) => Origin::Default,
            (Auto::Auto, span) => Origin::Chosen(span, why.into()),
        };
        Self { name, value, origin }
    }

    fn written(name: &'static str, value: String, span: Span) -> Self {
        Self {
            name,
            value,
            origin: Origin::Written(span),
        }
    }

    fn cells(&self, listing: &Listing<'_>) -> Vec<Html> {
        let linked = |span: Span| {
            let place = listing.place(span);
            html!(in "{place} <code>{line}</code>", place = place.linked(), line = place.line)
        };
        let origin = match &self.origin {
            Origin::Written(span) => linked(*span),
            Origin::Chosen(span, why) => html!(
                in "<strong>auto</strong>: {why}{place}",
                why = unbroken(why),
                place = span.map(|span| html!(in "<br>{place}", place = linked(span)))
            ),
            Origin::Default => unbroken("default"),
        };
        vec![unbroken(self.name), unbroken(&self.value), origin]
    }
}

/// The section.
pub(super) fn section(subject: Subject<'_>, listing: &Listing<'_>) -> Section {
    let columns = [
        Column::Words("Parameter"),
        Column::Words("value"),
        Column::Words("from"),
    ];
    let rows =
        |caption: &str, rows: Vec<Row>| table(caption, &columns, rows.iter().map(|row| row.cells(listing)));
    let mut body = rows("Workpiece", workpiece(subject));
    let job = subject.material.job;
    let several = job.operations.len() > 1;
    let planned = job.operations.iter().zip(&subject.material.plan.operations);
    for (number, (Operation::RoughVcut(asked), PlannedOperation::RoughVcut(planned))) in (1..).zip(planned) {
        let of = if several {
            format!(" of operation {number}")
        } else {
            String::new()
        };
        body += rows(&format!("Blade{of}"), blade(asked));
        body += rows(&format!("Cut{of}"), as_laid_out(asked, cut(asked, planned)));
        body += rows(
            &format!("Motion{of}"),
            without_lattice(asked, motion(asked, planned)),
        );
        let limits = limits(asked);
        if !limits.is_empty() {
            body += rows(&format!("Limits{of}"), limits);
        }
    }
    if let Some(machine) = &job.machine {
        body += rows("Machine", machine_rows(machine));
    }
    Section {
        id: "parameters",
        title: "Parameters",
        body,
    }
}

fn workpiece(subject: Subject<'_>) -> Vec<Row> {
    let job = subject.material.job;
    let stock = job.stock;
    let size = format!(
        "{} x {} x {} mm (x, y, z)",
        show(stock.width.to_mm()),
        show(stock.depth.to_mm()),
        show(stock.height.to_mm())
    );
    let profile = format!(
        "{} corners, {} mm long, z from {} to {} mm",
        job.profile.points().len(),
        show(job.profile.arc_length().to_mm()),
        show(job.profile.lowest().z),
        show(job.profile.highest().z)
    );
    vec![
        Row::written("stock", size, job.stock_span),
        Row::written("profile", profile, job.profile_span),
    ]
}

fn blade(asked: &RoughVcut) -> Vec<Row> {
    let blade = &asked.blade;
    let edges = match blade.edges {
        Edges::Single => "single",
        Edges::Double => "double",
    };
    vec![
        Row::written("blade", format!("{}, {edges} edge", blade.name), blade.span),
        Row::of("cutting_length", blade.cutting_length, length),
        Row::of("half_apex", blade.half_apex, angle),
        Row::of("thickness", blade.thickness, length),
    ]
}

fn cut(asked: &RoughVcut, planned: &PlannedVcut) -> Vec<Row> {
    let best = best(asked, planned);
    let found = &planned.parameters;
    vec![
        Row::of("objective", asked.objective, |objective| {
            objective.word().to_owned()
        }),
        Row::of("model", asked.formulas, |formulas| formulas.word().to_owned()),
        Row::open(
            "lattice",
            &asked.lattice,
            found.lattice.word().to_owned(),
            decided(planned, "lattice").unwrap_or_else(|| best.clone()),
        ),
        Row::of("rake", asked.rake, angle),
        Row::open("swing", &asked.swing, angle(found.swing), best.clone()),
        Row::open("layer", &asked.layer, length(found.layer), best.clone()),
        Row::open("step", &asked.step, length(found.step), best.clone()),
        Row::open("overlap", &asked.overlap, show(found.overlap), best),
        Row::of("allowance", asked.allowance, length),
        Row::open(
            "residual",
            &asked.residual,
            planned.strategy.word().to_owned(),
            decided(planned, "residual").unwrap_or_else(|| {
                "the strategy that leaves the part within its limits in the least time".to_owned()
            }),
        ),
    ]
}

/// Where tips are given, they stand for the rows of a lattice.
fn as_laid_out(asked: &RoughVcut, rows: Vec<Row>) -> Vec<Row> {
    let tips = asked.tips.as_ref();
    let given = tips.map(|tips| Row::written("tips", format!("{} given", tips.tips.len()), tips.span));
    given.into_iter().chain(without_lattice(asked, rows)).collect()
}

/// Rows that say something where tips are given.
fn without_lattice(asked: &RoughVcut, mut rows: Vec<Row>) -> Vec<Row> {
    const OF_A_LATTICE: [&str; 8] = [
        "objective",
        "model",
        "lattice",
        "layer",
        "step",
        "overlap",
        "residual",
        "sequence",
    ];
    if asked.tips.is_some() {
        rows.retain(|row| !OF_A_LATTICE.contains(&row.name));
    }
    rows
}

fn motion(asked: &RoughVcut, planned: &PlannedVcut) -> Vec<Row> {
    let found = &planned.parameters;
    let direction = asked.direction.value.word();
    // Where both are open, the order is decided with the sequence.
    let sequence = decided(planned, "sequence");
    let order = decided(planned, "order").or_else(|| sequence.clone());
    let fastest = || "the order of least time in which every chip comes free".to_owned();
    vec![
        Row::open(
            "order",
            &asked.order,
            planned.order.word().to_owned(),
            order.unwrap_or_else(fastest),
        ),
        Row::open(
            "sequence",
            &asked.sequence,
            planned.sequence.word().to_owned(),
            sequence.unwrap_or_else(fastest),
        ),
        Row::of("direction", asked.direction, |_| direction.to_owned()),
        Row::of("feed cut", asked.cut_feed, |speed| {
            format!("{} mm/s", show(speed.to_mm_per_s()))
        }),
        Row::of("feed travel", asked.travel_feed, |speed| {
            format!("{} mm/s", show(speed.to_mm_per_s()))
        }),
        Row::of("feed reorient", asked.reorient_rate, |rate| {
            format!("{} deg/s", show(rate.to_deg_per_s()))
        }),
        Row::of("clearance", asked.clearance, length),
        Row::open(
            "extension",
            &asked.extension,
            length(found.extension),
            "the blade's overhang and the run-out",
        ),
        Row::of("run_out", asked.run_out, length),
        Row::open(
            "standoff",
            &asked.standoff,
            length(found.standoff),
            "half the blade's thickness",
        ),
    ]
}

fn limits(asked: &RoughVcut) -> Vec<Row> {
    let limits = &asked.limits;
    let mut rows = bounds("swing", limits.swing, angle);
    rows.extend(bounds("layer", limits.layer, length));
    rows.extend(bounds("step", limits.step, length));
    let most = |name, limit: Option<Sourced<Length>>| {
        limit.map(|limit| Row::of(name, limit, |value| format!("at most {}", length(value))))
    };
    rows.extend(most("scallop", limits.scallop));
    rows.extend(most("edge", limits.edge));
    let time = |value: Duration| format!("at most {} s", show(value.to_s()));
    rows.extend(limits.time.map(|limit| Row::of("time", limit, time)));
    let cuts = |value: f64| format!("at most {}", show(value));
    rows.extend(limits.cuts.map(|limit| Row::of("cuts", limit, cuts)));
    rows
}

fn bounds<T: Copy>(name: &'static str, bounds: Bounds<T>, words: impl Fn(T) -> String) -> Vec<Row> {
    let row = |limit: Option<Sourced<T>>, which: &str| {
        limit.map(|limit| Row::of(name, limit, |value| format!("{which} {}", words(value))))
    };
    let (least, most) = (row(bounds.least, "at least"), row(bounds.most, "at most"));
    least.into_iter().chain(most).collect()
}

fn machine_rows(machine: &Machine) -> Vec<Row> {
    let model = &machine.model;
    let mut rows = vec![
        Row::written("machine", machine.name.clone(), machine.head_span),
        Row::written("model", model.name.clone(), machine.model_span),
        Row::of("tool", machine.tool, |tool| frame(&tool.frame)),
        Row::of("base", machine.base, |base| frame(&base.frame)),
    ];
    rows.extend(machine.load.map(|given| Row::of("load", given, load)));
    rows.extend(machine.home.map(|home| {
        Row::of("home", home, |home| {
            let values = model
                .axes
                .iter()
                .zip(home.0)
                .map(|(axis, value)| match axis.kind {
                    AxisKind::Rotary => format!("{} {} deg", axis.name, show(value.to_degrees())),
                    AxisKind::Linear => format!("{} {} mm", axis.name, show(value)),
                });
            values.collect::<Vec<_>>().join(", ")
        })
    }));
    let output = |number: u32| format!("output {number}");
    rows.extend(
        machine
            .ultrasonic
            .map(|given| Row::of("ultrasonic", given, output)),
    );
    rows.push(Row::of("ready", machine.ready, |ready| match ready {
        Ready::Input(number) => format!("input {number}"),
        Ready::After(time) => format!("{} s after switching on", show(time.to_s())),
    }));
    rows
}

fn load(load: Registered<Load>) -> String {
    match load {
        Registered::Number(number) => format!("number {number} of the controller"),
        Registered::Value(Load { mass, centre }) => format!(
            "{} kg at x {}, y {}, z {} mm",
            show(mass.to_kg()),
            show(centre.x),
            show(centre.y),
            show(centre.z)
        ),
    }
}

fn frame(frame: &Frame) -> String {
    let (origin, turn) = (frame.origin, frame.orientation.to_zyx());
    format!(
        "x {}, y {}, z {} mm; a {}, b {}, c {} deg",
        show(origin.x),
        show(origin.y),
        show(origin.z),
        show(turn.a.to_deg()),
        show(turn.b.to_deg()),
        show(turn.c.to_deg())
    )
}

/// What was compared for a field that the job leaves open, in the words of the summary.
fn decided(planned: &PlannedVcut, field: &str) -> Option<String> {
    let decision = planned
        .decisions
        .iter()
        .find(|decision| decision.field == field)?;
    Some(summary::compared(decision))
}

/// Why a parameter of the lattice came out as it did, and what keeps it from coming out better.
fn best(asked: &RoughVcut, planned: &PlannedVcut) -> String {
    let least = match asked.objective.value {
        Objective::Time => "the least time",
        Objective::Scallop => "the lowest scallops",
        Objective::Cuts => "the fewest cuts",
        Objective::BladeLoad => "the shortest edge in use",
    };
    let by = match (planned.is_found_by_simulation(), asked.formulas.value) {
        (true, Formulas::Paper | Formulas::Exact) => "as simulated",
        (false, Formulas::Paper) => "by the paper's formulas",
        (false, Formulas::Exact) => "by the exact formulas",
    };
    let bounds = planned.parameters.reasons(asked);
    if bounds.is_empty() {
        return format!("{least} within the limits, {by}");
    }
    format!("{least}, {by}; bound by {}", bounds.join(", "))
}

fn length(length: Length) -> String {
    format!("{} mm", show(length.to_mm()))
}

fn angle(angle: Angle) -> String {
    format!("{} deg", show(angle.to_deg()))
}

//! Every parameter of the job with its value and where it came from: a place in a text, `auto` with the reason, or the
//! default of the language.

use super::source::Listing;
use super::{Section, Subject};
use crate::facts::carried;
use crate::html::{Column, Html, table, unbroken};
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{AxisKind, Ready};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_job::description::{Origin, ParameterRow as Row, ParameterTable};
use vcutc_job::{HeldTool, Machine};

/// The cells of a parameter's row.
fn cells(row: &Row, listing: &Listing<'_>) -> Vec<Html> {
    let linked = |span: Span| {
        let place = listing.place(span);
        html!(in "{place} <code>{line}</code>", place = place.linked(), line = place.line)
    };
    let origin = match &row.origin {
        Origin::Written(span) => linked(*span),
        Origin::Chosen(span, why) => html!(
            in "<strong>auto</strong>: {why}{place}",
            why = unbroken(why),
            place = span.map(|span| html!(in "<br>{place}", place = linked(span)))
        ),
        Origin::Default => unbroken("default"),
    };
    vec![unbroken(row.name), unbroken(&row.value), origin]
}

/// The section.
pub(super) fn section(subject: Subject<'_>, listing: &Listing<'_>) -> Section {
    let columns = [
        Column::Words("Parameter"),
        Column::Words("value"),
        Column::Words("from"),
    ];
    let rows =
        |caption: &str, rows: Vec<Row>| table(caption, &columns, rows.iter().map(|row| cells(row, listing)));
    let mut body = rows("Workpiece", workpiece(subject));
    let job = subject.material.job;
    let several = job.operations.len() > 1;
    for (number, planned) in (1..).zip(&subject.material.plan.operations) {
        let of = if several {
            format!(" of operation {number}")
        } else {
            String::new()
        };
        for ParameterTable { caption, rows: of_it } in planned.tables() {
            body += rows(&format!("{caption}{of}"), of_it);
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
    let part = &subject.material.plan.profile;
    let profile = format!(
        "{} corners, {} mm long, z from {} to {} mm",
        part.points().len(),
        show(part.arc_length().to_mm()),
        show(part.lowest().z),
        show(part.highest().z)
    );
    vec![
        Row::written("stock", size, job.stock_span),
        match job.part.surface() {
            None => Row::written("profile", profile, job.profile_span),
            Some(_) => Row::written("surface, its shadow", profile, job.profile_span),
        },
    ]
}

/// With the name of the blade, where each has a tool of its own.
fn held(tool: &HeldTool, text: String) -> String {
    match &tool.blade {
        Some(blade) => format!("{}: {text}", blade.node),
        None => text,
    }
}

fn machine_rows(machine: &Machine) -> Vec<Row> {
    let model = &machine.model;
    let mut rows = vec![
        Row::written("machine", machine.name.clone(), machine.head_span),
        Row::written("model", model.name.clone(), machine.model_span),
    ];
    rows.extend(
        machine
            .tools
            .iter()
            .map(|tool| Row::of("tool", tool.frame, |placed| held(tool, frame(&placed.frame)))),
    );
    rows.push(Row::of("base", machine.base, |base| frame(&base.frame)));
    for tool in machine.tools.iter() {
        rows.extend(
            tool.load
                .map(|given| Row::of("load", given, |given| held(tool, carried(given)))),
        );
    }
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
    rows.extend(machine.spindle.map(|given| Row::of("spindle", given, output)));
    rows.push(Row::of("ready", machine.ready, |ready| match ready {
        Ready::Input(number) => format!("input {number}"),
        Ready::After(time) => format!("{} s after switching on", show(time.to_s())),
    }));
    rows
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

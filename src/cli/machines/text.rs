//! Machines as people read them: columns, and wrapped lists.

use super::{Description, axis_unit, kind_word, maker_word, mechanism, path_numbers, row};
use std::fmt::Write;
use vcutc_backend_api::ir::{Axis, AxisKind};
use vcutc_machine::catalogue::Summary;
use vcutc_machine::facts::{Facts, FkCheck};
use vcutc_machine::masses::{Masses, Torques};
use vcutc_machine::path_limits::PathLimits;
use vcutc_machine::sheet::{Confidence, Sheet};

/// Width at which texts are wrapped.
const WIDTH: usize = 100;

/// What stands where a number is not known.
const UNKNOWN: &str = "-";

/// The list of the catalogue.
pub(super) fn list(summaries: &[Summary]) -> String {
    let head = ["name", "model", "payload", "reach", "confidence"].map(str::to_owned);
    let rows = summaries.iter().map(|summary| {
        [
            summary.name.to_owned(),
            summary.model.clone(),
            with_unit(summary.payload, "kg"),
            with_unit(summary.reach, "mm"),
            summary.confidence.map_or(UNKNOWN, Confidence::word).to_owned(),
        ]
    });
    let mut text = columns(core::iter::once(head).chain(rows).collect(), "");
    text.push_str(
        "\nReach is that of the wrist centre. `vcutc machines NAME` shows one machine with all its numbers and sources;\n\
         NAME may also be a file that describes a machine of your own.\n",
    );
    text
}

pub(super) fn machine(description: &Description) -> String {
    let Description { model, sheet } = description;
    let mut text = format!("{}\n", model.name);
    let mut traits = vec![format!(
        "{}, controller: {}",
        kind_word(model.kind()),
        maker_word(model.maker)
    )];
    if let Some(sheet) = sheet {
        text = format!("{}  {}\n", model.name, sheet.model);
        traits.extend(of_sheet(sheet));
    }
    for line in traits {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {line}");
    }
    text.push('\n');
    text.push_str(&axes(&model.axes));
    text.push_str(&path(&model.path));
    text.push('\n');
    text.push_str(&mechanism::text(&model.mechanism));
    if let Some(sheet) = sheet {
        text.push_str(&facts(&sheet.facts));
        text.push_str(&sheet.masses.as_ref().map_or_else(String::new, masses));
        text.push_str(&sheet.torques.as_ref().map_or_else(String::new, torques));
    }
    text
}

fn of_sheet(sheet: &Sheet) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(payload) = sheet.payload.rated {
        lines.push(format!("payload {payload} kg"));
    }
    if let Some(wrist) = sheet.payload.wrist {
        lines.push(format!(
            "wrist: at most {} kg m2 about axis 5, {} kg m2 about axis 6",
            wrist.axis_5, wrist.axis_6
        ));
    }
    match (sheet.facts.wrist_reach, sheet.facts.designated_reach) {
        (Some(reach), Some(named)) => {
            lines.push(format!(
                "reach of the wrist centre {reach} mm, {named} mm by its name"
            ));
        }
        (Some(reach), None) => lines.push(format!("reach of the wrist centre {reach} mm")),
        (None, _) => {}
    }
    if let Some(confidence) = sheet.confidence {
        let meaning = match confidence {
            Confidence::High => "two or more sources agree on all lengths",
            Confidence::MediumHigh => "sources agree except for one number, or none comes from the maker",
            Confidence::Medium => "one source, or incomplete limits or speeds",
            Confidence::Example => "made up to show an arrangement; no real machine",
        };
        lines.push(format!("confidence {}: {meaning}", confidence.word()));
    }
    lines
}

/// A line with what the controller keeps along the way of the tip; nothing when nothing is known.
fn path(path: &PathLimits) -> String {
    let known: Vec<String> = path_numbers(path)
        .iter()
        .filter_map(|number| Some(format!("{} {} {}", number.words, number.value?, number.unit)))
        .collect();
    if known.is_empty() {
        return String::new();
    }
    format!("  along the path of the tip: {}\n", known.join(", "))
}

fn axes(axes: &[Axis]) -> String {
    let head = ["axis", "from", "to", "rate", "acceleration", "jerk"].map(str::to_owned);
    let rows = axes.iter().map(|axis| {
        let unit = axis_unit(axis);
        let (rate, acceleration, jerk) = match axis.kind {
            AxisKind::Rotary => ("deg/s", "deg/s2", "deg/s3"),
            AxisKind::Linear => ("mm/s", "mm/s2", "mm/s3"),
        };
        [
            axis.name.clone(),
            with_unit(Some(unit.of(axis.min)), unit.name),
            with_unit(Some(unit.of(axis.max)), unit.name),
            with_unit(axis.rate.map(|value| unit.of(value)), rate),
            with_unit(axis.acceleration.map(|value| unit.of(value)), acceleration),
            with_unit(axis.jerk.map(|value| unit.of(value)), jerk),
        ]
    });
    columns(core::iter::once(head).chain(rows).collect(), "  ")
}

fn facts(facts: &Facts) -> String {
    let mut text = String::new();
    for sources in facts.sources.iter().filter(|sources| !sources.list.is_empty()) {
        text += &section(&format!("sources of the {}", sources.of), &sources.list);
    }
    text += &section("disagreements, and the values adopted", &facts.disagreements);
    text += &section("remarks", &facts.remarks);
    let checks: Vec<String> = facts.fk_checks.iter().map(check).collect();
    text += &section(
        "published poses that this model meets (axes in deg -> flange in mm; orientation w x y z)",
        &checks,
    );
    text
}

fn check(check: &FkCheck) -> String {
    let orientation = check
        .quaternion
        .map_or_else(String::new, |quaternion| format!("; {}", row(&quaternion)));
    let mut text = format!(
        "{} -> {}{orientation}, to {} mm and {} deg",
        row(&check.joints_deg),
        row(&check.xyz_mm),
        check.position_tolerance_mm,
        check.rotation_tolerance_deg
    );
    for more in [&check.source, &check.independence, &check.note] {
        text += &more.as_ref().map_or_else(String::new, |more| format!("; {more}"));
    }
    text
}

fn masses(masses: &Masses) -> String {
    let mut lines: Vec<String> = masses
        .links
        .iter()
        .map(|link| {
            format!(
                "{} {} kg at {} mm",
                link.name,
                link.mass,
                row(&link.centre_mm.to_array())
            )
        })
        .collect();
    lines.extend(masses.total_mass.map(|mass| format!("together {mass} kg")));
    lines.extend(masses.note.clone());
    lines.extend(masses.sources.iter().map(|source| format!("from {source}")));
    section("masses, with all axes at 0", &lines)
}

fn torques(torques: &Torques) -> String {
    let mut lines = vec![format!("{} Nm, {}", row(&torques.limits), torques.backing.word())];
    lines.extend(torques.sources.iter().map(|source| format!("from {source}")));
    section("torques of the drives, at the axes", &lines)
}

/// A heading with a list; nothing when the list is empty.
fn section(title: &str, list: &[String]) -> String {
    if list.is_empty() {
        return String::new();
    }
    let items: String = list.iter().map(|item| wrapped(item)).collect();
    format!("\n  {title}\n{items}")
}

/// An item of a list, wrapped between words.
fn wrapped(item: &str) -> String {
    let mut text = String::from("    -");
    let mut used = text.len();
    for word in item.split_whitespace() {
        let length = word.chars().count();
        if used + 1 + length > WIDTH && used > 6 {
            text.push_str("\n     ");
            used = 5;
        }
        text.push(' ');
        text.push_str(word);
        used += 1 + length;
    }
    text.push('\n');
    text
}

fn with_unit(value: Option<f64>, unit: &str) -> String {
    value.map_or_else(|| UNKNOWN.to_owned(), |value| format!("{value} {unit}"))
}

/// Rows in columns, two blanks apart; the first row is the heading.
fn columns<const N: usize>(rows: Vec<[String; N]>, indent: &str) -> String {
    let mut widths = [0; N];
    for row in &rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = cell.chars().count().max(*width);
        }
    }
    let mut text = String::new();
    for row in rows {
        let mut line = indent.to_owned();
        for (cell, width) in row.iter().zip(widths) {
            let _ = write!(line, "{cell:<width$}  ");
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_items_are_wrapped_between_words() {
        let item = "word ".repeat(60);
        let text = wrapped(&item);
        assert!(text.lines().count() > 2);
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
        assert_eq!(text.split_whitespace().filter(|word| *word == "word").count(), 60);
        let endless = "x".repeat(300);
        assert_eq!(wrapped(&endless), format!("    - {endless}\n"));
    }

    #[test]
    fn columns_are_as_wide_as_their_widest_cell() {
        let rows = vec![["a", "b"], ["long", "c"]]
            .into_iter()
            .map(|row| row.map(str::to_owned))
            .collect();
        assert_eq!(columns(rows, " "), " a     b\n long  c\n");
    }
}

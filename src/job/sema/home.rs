//! Home: where the axes are when a program starts and ends, compared with their limits.

use super::arguments::{Parameter, calls};
use super::dimension::Dimension;
use super::field_ranges::{AXIS_ANGLE, COORDINATE};
use super::read::Reader;
use super::report::Checked;
use vcutc_backend_api::ir::{Axis, AxisKind, AxisValues, MOST_AXES, MachineKind};
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic, Edit, Fix};
use vcutc_machine::{Model, usual_home};
use vcutc_syntax::ast::Expr;

/// How the home of a robot is written.
pub(crate) const JOINTS: &str = "joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)";

/// The calls that the home of a robot takes.
pub(crate) const CALLS: &[(&str, &str)] = &[("joints", JOINTS)];

/// Where an axis is at home.
struct Place {
    value: f64,
    span: Span,
}

/// The field that most places are given by.
pub(crate) const HOME: &str = "home";

/// Where the axes of a machine of that model are, as a field such as `home` says it.
pub(crate) fn read(
    field: &str,
    expr: &Spanned<Expr>,
    model: &Model,
    model_span: Span,
    reader: &mut Reader<'_>,
) -> Checked<AxisValues> {
    let places = match model.kind() {
        MachineKind::Robot => joints(field, expr, reader)?,
        MachineKind::FiveAxis => axes(field, expr, &model.axes, reader)?,
    };
    if let Some(diagnostic) = outside(field, &places, model, expr.span, model_span) {
        return Err(reader.reports.push(diagnostic));
    }
    let mut values = [0.0; MOST_AXES];
    for (value, place) in values.iter_mut().zip(&places) {
        *value = place.value;
    }
    Ok(AxisValues(values))
}

/// `joints(a1, a2, a3, a4, a5, a6)`.
fn joints(field: &str, expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<Vec<Place>> {
    let call = calls(field, expr, CALLS, reader.reports)?;
    let angles: [f64; 6] = call.listed(AXIS_ANGLE, "the angle of an axis", reader)?;
    let spans = call.all().iter().map(|argument| argument.value.span);
    Ok(angles
        .into_iter()
        .zip(spans)
        .map(|(value, span)| Place { value, span })
        .collect())
}

/// `axes(x = , y = , z = , b = , a = )`, with the names of the machine's axes in small letters.
fn axes(field: &str, expr: &Spanned<Expr>, axes: &[Axis], reader: &mut Reader<'_>) -> Checked<Vec<Place>> {
    let names: Vec<String> = axes.iter().map(|axis| axis.name.to_lowercase()).collect();
    let parameters: Vec<Parameter<'_>> = axes
        .iter()
        .zip(&names)
        .map(|(axis, name)| Parameter {
            name,
            range: match axis.kind {
                AxisKind::Rotary => AXIS_ANGLE,
                AxisKind::Linear => COORDINATE,
            },
            typical: match axis.kind {
                AxisKind::Rotary => "0 deg",
                AxisKind::Linear => "0 mm",
            },
        })
        .collect();
    let samples: Vec<String> = parameters
        .iter()
        .map(|parameter| format!("{} = {}", parameter.name, parameter.typical))
        .collect();
    let example = format!("axes({})", samples.join(", "));
    let call = calls(field, expr, &[("axes", &example)], reader.reports)?;
    let values = call.read_all(&parameters, reader)?;
    let spans = names
        .iter()
        .map(|name| call.find(name).map_or(call.span, |argument| argument.value.span));
    Ok(values
        .into_iter()
        .zip(spans)
        .map(|(value, span)| Place { value, span })
        .collect())
}

/// The diagnostic for a home that is not within the limits, with the nearest one that is and the usual one of the model. Whether the
/// way from there to the work is clear is for the machine to try.
fn outside(
    field: &str,
    places: &[Place],
    model: &Model,
    whole: Span,
    model_span: Span,
) -> Option<Diagnostic> {
    let mut beyond = model
        .axes
        .iter()
        .zip(places)
        .filter(|(axis, place)| !(axis.min..=axis.max).contains(&place.value));
    let (axis, place) = beyond.next()?;
    let (text, limit) = (text(axis, place.value), nearest(axis, place.value));
    let by = self::text(axis, (place.value - limit).abs());
    let mut diagnostic = Diagnostic::new(
        Code::HomeOutsideLimits,
        format!(
            "{} has {} at {text}, {by} beyond its limit of {}",
            if field == HOME { HOME } else { "the change place" },
            axis.name,
            self::text(axis, limit)
        ),
        place.span,
        range(axis),
    );
    let mut edits = vec![edit(axis, place)];
    for (axis, place) in beyond {
        diagnostic = diagnostic.and(place.span, format!("outside too: {}", range(axis)));
        edits.push(edit(axis, place));
    }
    let title = match edits.as_slice() {
        [only] => format!("the nearest position within is `{}`", only.replacement),
        several => format!(
            "the nearest positions within are {}",
            several
                .iter()
                .map(|edit| format!("`{}`", edit.replacement))
                .collect::<Vec<_>>()
                .join(", ")
        ),
    };
    let mut diagnostic = diagnostic.and(model_span, "the limits of this machine");
    diagnostic.fixes.push(Fix { title, edits });
    if field != HOME {
        return Some(diagnostic);
    }
    let usual = usual_home(model);
    Some(diagnostic.fix(format!("the usual home of this model is `{usual}`"), whole, usual))
}

fn range(axis: &Axis) -> String {
    format!(
        "{} goes from {} to {}",
        axis.name,
        text(axis, axis.min),
        text(axis, axis.max)
    )
}

fn nearest(axis: &Axis, value: f64) -> f64 {
    value.max(axis.min).min(axis.max)
}

/// The change that brings an axis to the nearest place within its limits, rounded to four decimals inwards.
fn edit(axis: &Axis, place: &Place) -> Edit {
    const STEPS: f64 = 1e4;
    // What rounding in the limit's own conversion has lost must not cost a step.
    const SLACK: f64 = 1e-6;
    let unit = dimension(axis).unit_size();
    let end = nearest(axis, place.value) / unit * STEPS;
    let inside = if place.value > axis.max {
        (end + SLACK).floor() / STEPS
    } else {
        (end - SLACK).ceil() / STEPS
    };
    Edit {
        span: place.span,
        replacement: format!("{inside} {}", dimension(axis).unit()),
    }
}

fn text(axis: &Axis, value: f64) -> String {
    let dimension = dimension(axis);
    dimension.show(value / dimension.unit_size())
}

const fn dimension(axis: &Axis) -> Dimension {
    match axis.kind {
        AxisKind::Rotary => Dimension::ANGLE,
        AxisKind::Linear => Dimension::LENGTH,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_diagnostics::source::SourceMap;
    use vcutc_machine::catalogue;

    /// What a fix writes is within the limits as they are kept, in rad or mm, and as near to them as four decimals allow.
    #[test]
    fn the_nearest_position_is_within_on_every_axis_of_the_catalogue() {
        let span = Span::of_bytes(SourceMap::default().add("job", ""), 0..0);
        for name in catalogue::names() {
            for axis in catalogue::find(name).unwrap().axes {
                let unit = dimension(&axis).unit_size();
                for (limit, value) in [(axis.max, axis.max + 0.1), (axis.min, axis.min - 7.0)] {
                    let edit = edit(&axis, &Place { value, span });
                    let (number, _) = edit.replacement.split_once(' ').unwrap();
                    let fixed = number.parse::<f64>().unwrap() * unit;
                    assert!(
                        (axis.min..=axis.max).contains(&fixed),
                        "{name} {}: {number}",
                        axis.name
                    );
                    assert!(
                        (fixed - limit).abs() < 1.01e-4 * unit,
                        "{name} {}: {number}",
                        axis.name
                    );
                }
            }
        }
    }

    #[test]
    fn limits_with_more_digits_are_rounded_inwards() {
        let span = Span::of_bytes(SourceMap::default().add("job", ""), 0..0);
        let axis = Axis {
            name: "X".to_owned(),
            kind: AxisKind::Linear,
            min: -1_000.000_06,
            max: 1_234.567_89,
            rate: None,
            acceleration: None,
            jerk: None,
        };
        let written = |value| edit(&axis, &Place { value, span }).replacement;
        assert_eq!(written(2000.0), "1234.5678 mm");
        assert_eq!(written(-2000.0), "-1000 mm");
    }
}

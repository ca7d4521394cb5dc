//! What a program asks of its machine in words: a few lines, and a table of its axes.

use crate::figures::{BranchFigure, ReachFigures, SingularFigure, SlowerFigure};
use vcutc_diagnostics::number::show;

/// The figures in a few lines: a name and a text each.
#[must_use]
pub fn lines(figures: &ReachFigures) -> Vec<(&'static str, String)> {
    let mut lines = vec![("reach", reach_line(figures)), ("margins", margins_line(figures))];
    let nearest = figures.singular.iter().min_by(|a, b| a.share.total_cmp(&b.share));
    lines.extend(nearest.map(|nearest| {
        let SingularFigure {
            kind,
            unit,
            distance,
            at,
            ..
        } = nearest;
        let text = format!(
            "nearest is the {kind}, {} {unit} away, at {}",
            show_tenths(*distance),
            at.words
        );
        ("singular", text)
    }));
    lines.extend(rates_line(figures).map(|line| ("rates", line)));
    lines.extend(
        figures
            .slower
            .as_ref()
            .map(|slower| ("turns", turns_line(slower))),
    );
    lines
}

/// `2 of 90 motions that turn the blade are slower than `reorient`, the slowest at 66 deg/s at layer 1, cut 2; ...`.
fn turns_line(slower: &SlowerFigure) -> String {
    let SlowerFigure {
        motions,
        of,
        lowest,
        at,
        axis,
        unit,
        needed,
        limit,
    } = slower;
    let verb = if *motions == 1 { "is" } else { "are" };
    let limit = limit.map_or_else(String::new, |limit| format!(" of {limit:.1} {unit}/s"));
    format!(
        "{motions} of {of} motions that turn the blade {verb} slower than `reorient`, the slowest at {} deg/s at {}; without, {axis} would \
         need up to {needed:.1} {unit}/s{limit}",
        show(*lowest),
        at.words,
    )
}

fn reach_line(figures: &ReachFigures) -> String {
    // The branch that most ops end on first.
    let mut ops: Vec<(&BranchFigure, u32)> = Vec::new();
    for branch in &figures.branches {
        match ops.iter_mut().find(|(known, _)| known.words == branch.words) {
            Some((_, count)) => *count = count.saturating_add(branch.ops),
            None => ops.push((branch, branch.ops)),
        }
    }
    ops.sort_by_key(|(_, count)| core::cmp::Reverse(*count));
    let named = |branch: &BranchFigure| {
        let status = branch
            .kuka_status
            .map_or_else(String::new, |status| format!(" (KUKA status {status})"));
        format!("{}{status}", branch.words)
    };
    let words: Vec<String> = ops.iter().map(|(branch, _)| named(branch)).collect();
    let changes = match figures.changes {
        0 => String::new(),
        1 => "; 1 travel is an axis move, which is not timed".to_owned(),
        times => format!("; {times} travels are axis moves, which are not timed"),
    };
    if words.is_empty() {
        return "nothing moves".to_owned();
    }
    // A number alone says nothing.
    let words = match ops.as_slice() {
        [
            (
                BranchFigure {
                    is_numbered: true, ..
                },
                _,
            ),
        ] => "same configuration throughout".to_owned(),
        _ => words.join("; for a smaller part "),
    };
    format!("{words}{changes}")
}

fn margins_line(figures: &ReachFigures) -> String {
    let axes: Vec<String> = figures
        .axes
        .iter()
        .map(|axis| format!("{} {}", axis.name, margin_words(axis.margin)))
        .collect();
    format!(
        "smallest {} {} at {} (100 % = middle of the range); {}",
        figures.least.of,
        margin_words(figures.margin),
        figures.least.at.words,
        axes.join(", "),
    )
}

/// What has the smallest margin: `margin A5 6.5 %`.
#[must_use]
pub fn least_margin(figures: &ReachFigures) -> String {
    format!("margin {} {}", figures.least.of, margin_words(figures.margin))
}

/// The axis that comes nearest to its rate. Rates that are not known are among what is not checked.
fn rates_line(figures: &ReachFigures) -> Option<String> {
    let known = figures
        .axes
        .iter()
        .filter_map(|axis| Some((axis, axis.rate_share()?)));
    known
        .max_by(|(_, a), (_, b)| a.total_cmp(b))
        .map(|(axis, share)| {
            format!(
                "{} comes nearest to its speed limit: {:.0} % at {}",
                axis.name,
                share * 100.0,
                axis.rate_at.words
            )
        })
}

/// The figures of every axis, a line each under a heading.
#[must_use]
pub fn table(figures: &ReachFigures) -> Vec<String> {
    let heading = format!(
        "{:<5} {:>9} {:>9}   {:>9} {:>9} {:>8}  {:>9} {:>9}  nearest to its limit, without axis moves",
        "axis", "low", "high", "min", "max", "margin", "rate", "of"
    );
    let rows = figures.axes.iter().map(|axis| {
        let limit = axis
            .rate_limit
            .map_or_else(|| "unknown".to_owned(), |limit| format!("{limit:.1}"));
        format!(
            "{:<5} {:>9.2} {:>9.2}   {:>9.2} {:>9.2} {:>8}  {:>9.1} {limit:>9}  {}",
            axis.name,
            axis.low,
            axis.high,
            axis.min,
            axis.max,
            margin_words(axis.margin),
            axis.rate,
            axis.margin_at.words
        )
    });
    core::iter::once(heading).chain(rows).collect()
}

/// A margin as a percentage, `12.3 %`, rounded down: no more is said to be left than there is.
#[must_use]
pub fn margin_words(share: f64) -> String {
    format!("{:.1} %", (share * 1000.0).floor() / 10.0)
}

fn show_tenths(value: f64) -> String {
    show((value * 10.0).round() / 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::{AxisFigure, Least, PlaceFigure};

    fn axis(name: &str, rate_limit: Option<f64>) -> AxisFigure {
        let at = |words: &str| PlaceFigure {
            op: 1,
            words: words.to_owned(),
        };
        AxisFigure {
            name: name.to_owned(),
            unit: "deg",
            low: -10.0,
            high: 20.0,
            min: -100.0,
            max: 100.0,
            margin: 0.8,
            margin_at: at("layer 1, cut 2"),
            rate: 50.0,
            rate_limit,
            rate_at: at("layer 3, cut 4"),
        }
    }

    #[test]
    fn the_axis_that_comes_nearest_to_its_rate_is_named() {
        let mut figures = ReachFigures {
            branches: Vec::new(),
            changes: 0,
            margin: 0.8,
            least: Least {
                of: "A1".to_owned(),
                at: axis("", None).margin_at,
            },
            axes: vec![axis("A1", Some(100.0)), axis("A2", None), axis("A3", Some(60.0))],
            singular: Vec::new(),
            slower: None,
            solves: 7,
        };
        assert_eq!(
            rates_line(&figures).unwrap(),
            "A3 comes nearest to its speed limit: 83 % at layer 3, cut 4"
        );
        figures.axes.truncate(0);
        assert_eq!(rates_line(&figures), None);
    }
}

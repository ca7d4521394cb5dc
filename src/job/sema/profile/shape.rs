//! What makes a polyline a profile of the stock: one height at every x, from side to side, within the stock.
//!
//! What the drawing does beyond the two sides of the stock does not matter, so it is cut away first.

use super::Trace;
use crate::sema::fields::Place;
use crate::sema::part::{REACHES, SAME, Strip};
use crate::sema::quantity::mm;
use crate::sema::report::{Checked, Reports};
use vcutc_backend_api::ir::Stock;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::{Profile, ProfileError};

/// Checks that a trace is a profile across the stock.
pub(super) fn check(trace: &Trace, stock: Spanned<Stock>, reports: &mut Reports) -> Checked<()> {
    let width = stock.node.width.to_mm();
    let strip = Strip::cut(&trace.points, width);
    if let Some(diagnostic) = gap(trace, &strip, stock) {
        return Err(reports.push(diagnostic));
    }
    match strip.profile(width) {
        Ok(_) => {}
        Err(ProfileError::NotSingleValued { index }) => {
            let diagnostic = two_heights(&strip, trace, index, width, stock.span);
            return Err(reports.push(with_drawn(diagnostic, strip.drawn_at(trace, index))));
        }
        Err(ProfileError::TooFew | ProfileError::OutOfRange { .. }) => {
            let span = trace.piece_at(0).unwrap_or(stock.span);
            let diagnostic = Diagnostic::new(
                Code::ProfileTooShort,
                "the profile has no extent",
                span,
                "a single point",
            )
            .help("add a line to the other side of the stock");
            return Err(reports.push(diagnostic));
        }
    }
    let mut fault = None;
    for leaving in outside(&strip, stock.node.height.to_mm()) {
        let diagnostic = leaving.diagnostic(&strip, trace, stock);
        let drawn = strip.drawn_at(trace, leaving.farthest);
        fault = Some(reports.push(with_drawn(diagnostic, drawn)));
    }
    match fault {
        Some(reported) => Err(reported),
        None => Ok(()),
    }
}

/// The profile that all of a trace is, wherever the stock lies.
pub(super) fn whole(trace: &Trace, place: Place, reports: &mut Reports) -> Checked<Profile> {
    Profile::new(trace.points.clone()).map_err(|error| {
        let span = |index: usize| trace.piece_at(index).unwrap_or(place.head);
        let diagnostic = match error {
            ProfileError::NotSingleValued { index } => {
                let x = trace.points.get(index).map_or(0.0, |point| point.x);
                let diagnostic = Diagnostic::new(
                    Code::NotSingleValued,
                    format!("the profile has two heights at x = {}", mm(x)),
                    span(index),
                    "it turns back or rises straight up here",
                )
                .note("a loft joins all of its profiles, also what lies beyond the stock")
                .help("draw the profile from left to right without turning back");
                with_drawn(diagnostic, trace.drawn_at(index))
            }
            ProfileError::TooFew | ProfileError::OutOfRange { .. } => Diagnostic::new(
                Code::ProfileTooShort,
                "the profile has no extent",
                span(0),
                "a single point",
            )
            .help("add a line to the other side of the stock"),
        };
        reports.push(diagnostic)
    })
}

impl Strip {
    /// How far beyond a side of the stock the trace goes between a point of the strip and the one before it, where it leaves the
    /// stock in between.
    fn turned_outside(&self, trace: &Trace, index: usize, width: f64) -> Option<f64> {
        let before = *self.sources.get(index.checked_sub(1)?)?;
        let between = trace.points.get(before..*self.sources.get(index)?)?;
        let beyond = |x: f64| (-x).max(x - width);
        let farthest = between.iter().map(|point| point.x);
        let farthest = farthest.max_by(|one, other| beyond(*one).total_cmp(&beyond(*other)))?;
        (beyond(farthest) > SAME).then_some(farthest)
    }

    fn piece_at(&self, trace: &Trace, index: usize, otherwise: Span) -> Span {
        let source = self.sources.get(index).copied().unwrap_or(0);
        trace.piece_at(source).unwrap_or(otherwise)
    }

    fn drawn_at(&self, trace: &Trace, index: usize) -> Option<Span> {
        trace.drawn_at(self.sources.get(index).copied()?)
    }
}

/// Points at what drew a place, if that stands in a drawing.
fn with_drawn(diagnostic: Diagnostic, drawn: Option<Span>) -> Diagnostic {
    match drawn {
        Some(span) => diagnostic.and(span, "drawn here"),
        None => diagnostic,
    }
}

/// A profile that does not reach both sides.
fn gap(trace: &Trace, strip: &Strip, stock: Spanned<Stock>) -> Option<Diagnostic> {
    let width = stock.node.width.to_mm();
    let first = trace.points.first()?;
    let last = trace.points.last()?;
    let (leftmost, rightmost) = trace
        .points
        .iter()
        .fold((first.x, first.x), |(left, right), point| {
            (left.min(point.x), right.max(point.x))
        });
    if leftmost <= REACHES && rightmost >= width - REACHES && !strip.points.is_empty() {
        return None;
    }
    let last_point = trace.points.len().saturating_sub(1);
    let (left_end, right_end) = if first.x <= last.x {
        (0, last_point)
    } else {
        (last_point, 0)
    };
    let piece_at = |end: usize| trace.piece_at(end).unwrap_or(stock.span);
    let sides = format!("the stock reaches from x = 0 mm to x = {}", mm(width));
    let (span, label, help) = if leftmost > REACHES {
        let help = format!("let the profile begin at x = 0 mm, {} further left", mm(leftmost));
        (
            piece_at(left_end),
            format!("begins at x = {}", mm(leftmost)),
            help,
        )
    } else {
        let missing = width - rightmost;
        let help = if rightmost > SAME {
            format!(
                "extend the profile to x = {}, or make the stock {} wide",
                mm(width),
                mm(rightmost)
            )
        } else {
            format!("extend the profile to x = {}", mm(width))
        };
        (
            piece_at(right_end),
            format!("ends at x = {}, {} too early", mm(rightmost), mm(missing)),
            help,
        )
    };
    let diagnostic = Diagnostic::new(
        Code::ProfileTooShort,
        "the profile does not reach across the stock",
        span,
        label,
    );
    let diagnostic = diagnostic.and(stock.span, sides);
    let both = leftmost > REACHES && rightmost < width - REACHES;
    let diagnostic = if both {
        diagnostic.note(format!("it also ends too early, at x = {}", mm(rightmost)))
    } else {
        diagnostic
    };
    Some(diagnostic.help(help))
}

/// The diagnostic for a profile that turns back or rises straight up at a point of the strip.
fn two_heights(strip: &Strip, trace: &Trace, index: usize, width: f64, otherwise: Span) -> Diagnostic {
    let span = strip.piece_at(trace, index, otherwise);
    let (before, rest) = strip.points.split_at(index.min(strip.points.len()));
    let (Some(turn), Some(back)) = (before.last(), rest.first()) else {
        return Diagnostic::new(
            Code::NotSingleValued,
            "the profile has two heights at one x",
            span,
            "here",
        );
    };
    if let Some(farthest) = strip.turned_outside(trace, index, width) {
        return turned_outside(farthest, (*turn, *back), span);
    }
    if (turn.x - back.x).abs() < SAME {
        return Diagnostic::new(
            Code::NotSingleValued,
            format!("the profile has two heights at x = {}", mm(back.x)),
            span,
            format!("it steps from z = {} to z = {} here", mm(turn.z), mm(back.z)),
        )
        .help(format!(
            "slope the step, for example over 0.1 mm, to x = {}",
            mm(back.x + 0.1)
        ));
    }
    let backwards = (back.x - turn.x).signum();
    // How far it runs back, and the middle of that stretch as the example.
    let mut end = *back;
    for next in rest
        .iter()
        .skip(1)
        .take_while(|next| (next.x - turn.x) * backwards > 0.0)
    {
        if (next.x - end.x) * backwards > 0.0 {
            end = *next;
        }
    }
    let reach = before.first().map_or(turn.x, |first| first.x);
    let limit = if backwards < 0.0 {
        end.x.max(reach)
    } else {
        end.x.min(reach)
    };
    let x = f64::midpoint(turn.x, limit);
    let there = height_at(before.iter().rev(), x).unwrap_or(turn.z);
    let again = height_at([turn].into_iter().chain(rest), x).unwrap_or(back.z);
    Diagnostic::new(
        Code::NotSingleValued,
        format!("the profile has two heights at x = {}", mm(x)),
        span,
        format!(
            "it turns back at x = {}; at x = {} it is at z = {} and at z = {}",
            mm(turn.x),
            mm(x),
            mm(there),
            mm(again)
        ),
    )
    .note("blades come from above, so a part has one height at every x")
    .help("draw the profile from left to right without turning back")
}

/// The diagnostic for a profile that leaves the stock, turns back out there and comes in again.
fn turned_outside(farthest: f64, (leaves, enters): (Point2, Point2), span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NotSingleValued,
        format!("the profile has two heights at x = {}", mm(enters.x)),
        span,
        format!(
            "it leaves the stock at z = {}, turns back at x = {} and enters again at z = {}",
            mm(leaves.z),
            mm(farthest),
            mm(enters.z)
        ),
    )
    .note("blades come from above, so a part has one height at every x")
    .help(format!(
        "end the profile at x = {}, where it leaves the stock",
        mm(leaves.x)
    ))
}

/// The height of the first piece of a polyline that passes x.
fn height_at<'a>(points: impl Iterator<Item = &'a Point2>, x: f64) -> Option<f64> {
    let mut last: Option<&Point2> = None;
    for point in points {
        if let Some(last) = last {
            let (low, high) = (last.x.min(point.x), last.x.max(point.x));
            if (low..=high).contains(&x) && high > low {
                return Some(last.lerp(*point, (x - last.x) / (point.x - last.x)).z);
            }
        }
        last = Some(point);
    }
    None
}

/// The two ways to leave the stock.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Way {
    Above,
    Below,
}

/// A stretch of the profile outside of the stock.
struct Leaving {
    way: Way,
    from_x: f64,
    to_x: f64,
    /// By how much, at most.
    excess: f64,
    /// The point of the strip that is farthest out.
    farthest: usize,
}

/// The worst stretch above the stock and the worst below.
fn outside(strip: &Strip, height: f64) -> Vec<Leaving> {
    [Way::Above, Way::Below]
        .into_iter()
        .filter_map(|way| {
            let excess = |point: &Point2| match way {
                Way::Above => point.z - height,
                Way::Below => -point.z,
            };
            worst_stretch(strip, way, &excess)
        })
        .collect()
}

fn worst_stretch(strip: &Strip, way: Way, excess: &dyn Fn(&Point2) -> f64) -> Option<Leaving> {
    let (farthest, point) = strip
        .points
        .iter()
        .enumerate()
        .max_by(|(_, a), (_, b)| excess(a).total_cmp(&excess(b)))?;
    let most = excess(point);
    if most <= SAME {
        return None;
    }
    let (before, after) = strip.points.split_at(farthest);
    let from_x = crossing(point, before.iter().rev(), excess);
    let to_x = crossing(point, after.iter().skip(1), excess);
    Some(Leaving {
        way,
        from_x: from_x.min(to_x),
        to_x: from_x.max(to_x),
        excess: most,
        farthest,
    })
}

/// The x at which a run of points, starting outside, comes back into the stock.
fn crossing<'a>(
    start: &'a Point2,
    points: impl Iterator<Item = &'a Point2>,
    excess: &dyn Fn(&Point2) -> f64,
) -> f64 {
    let mut last = start;
    for point in points {
        let (out, now) = (excess(last), excess(point));
        if now <= 0.0 {
            return last.lerp(*point, out / (out - now)).x;
        }
        last = point;
    }
    last.x
}

impl Leaving {
    fn diagnostic(&self, strip: &Strip, trace: &Trace, stock: Spanned<Stock>) -> Diagnostic {
        // Upwards in the digits that are shown, so that what is offered is enough.
        let enough = |length: f64| mm(up(length));
        let span = strip.piece_at(trace, self.farthest, stock.span);
        let height = stock.node.height.to_mm();
        let (headline, help) = match self.way {
            Way::Above => (
                "the profile rises above the stock",
                format!(
                    "make the stock at least {} high, or lower the profile by {}",
                    enough(height + self.excess),
                    enough(self.excess)
                ),
            ),
            Way::Below => (
                "the profile sinks below the stock",
                format!("raise the profile by {}", enough(self.excess)),
            ),
        };
        let label = format!(
            "from x = {} to x = {}, by up to {}",
            mm(self.from_x),
            mm(self.to_x),
            mm(self.excess)
        );
        Diagnostic::new(Code::ProfileOutsideStock, headline, span, label)
            .and(
                stock.span,
                format!("the stock reaches from z = 0 mm to z = {}", mm(height)),
            )
            .help(help)
    }
}

/// A length in mm rounded up to what six digits show of it, and no finer than to a micrometre.
pub(crate) fn up(length: f64) -> f64 {
    let per_mm = match length {
        short if short < 1000.0 => 1000.0,
        long if long < 10_000.0 => 100.0,
        _ => 10.0,
    };
    ((length - SAME) * per_mm).ceil() / per_mm
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_offered_is_enough_in_the_digits_that_are_shown() {
        for length in [
            0.000_048_8,
            51.987_548_8,
            151.987_51,
            1_000.000_1,
            1_051.987_548_8,
            10_000.04,
        ] {
            let text = mm(up(length));
            let shown: f64 = text.trim_end_matches(" mm").parse().unwrap();
            assert!(shown >= length - SAME, "{text} for {length}");
            assert!(shown <= length + 0.1, "{text} for {length}");
        }
        assert_eq!(mm(up(52.0)), "52 mm", "a length that can be written stays");
    }
}

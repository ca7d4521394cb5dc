//! A plot of curves over a value: its frame, axes and grid.

use super::band::Band;
use super::palette::INK;
use super::scale::Scale;
use super::section::most_ticks;
use super::sheet::Room;
use super::svg::{Anchor, Svg, number};
use super::trace::Trace;

/// Room below a plot for its axis.
pub(super) const BELOW: f64 = 66.0;
const GRID: &str = "stroke=\"#dcd6c8\" fill=\"none\"";

/// Where values are in the picture.
pub(super) struct Plot {
    pub(super) x: Scale,
    pub(super) y: Scale,
}

impl Plot {
    /// A plot over the whole width, from `top` to `bottom`.
    pub(super) fn new(room: Room, xs: [f64; 2], ys: [f64; 2], [top, bottom]: [f64; 2]) -> Self {
        Self {
            x: Scale::new(xs, [room.left, room.right]),
            y: Scale::new(ys, [bottom, top]),
        }
    }

    /// Where a point is.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.at(x), self.y.at(y)]
    }

    pub(super) fn curve(&self, points: &[[f64; 2]]) -> Trace {
        Trace::through(points.iter().map(|&point| self.at(point)))
    }

    /// What lies between a lower and an upper curve.
    pub(super) fn between(&self, band: &Band) -> Trace {
        let outline = band.upper.iter().chain(band.lower.iter().rev());
        let mut trace = Trace::default();
        if !band.upper.is_empty() {
            trace.closed(outline.map(|&point| self.at(point)));
        }
        trace
    }

    /// The area between a curve and the lowest value.
    pub(super) fn area(&self, points: &[[f64; 2]]) -> Trace {
        let mut trace = Trace::default();
        if let (Some(first), Some(last)) = (points.first(), points.last()) {
            let low = self.y.values[0];
            let ends = [[last[0], low], [first[0], low]];
            trace.closed(points.iter().chain(&ends).map(|&point| self.at(point)));
        }
        trace
    }

    /// A line at a height, over the whole width.
    pub(super) fn level(&self, y: f64) -> String {
        let [left, right] = self.x.places;
        format!("M{} {}H{}", number(left), number(self.y.at(y)), number(right))
    }

    /// The ground with its grid. Comes before curves.
    pub(super) fn ground(&self, svg: &mut Svg) {
        let ([left, right], [bottom, top]) = (self.x.places, self.y.places);
        svg.rect([left, top, right - left, bottom - top], "fill=\"#ffffff\"");
        let grid: String = self
            .y_ticks()
            .iter()
            .map(|(value, _)| self.level(*value))
            .collect();
        svg.path(&grid, GRID);
    }

    /// The frame with its values. Comes after curves.
    pub(super) fn frame(&self, svg: &mut Svg, x_label: &str, y_label: &str) {
        let [left, right] = self.x.places;
        let ticks = self.x.ticks(most_ticks(right - left, 80.0));
        self.framed(svg, &ticks, x_label, y_label);
    }

    /// The same over a time in s, which is written as minutes and seconds.
    pub(super) fn frame_over_time(&self, svg: &mut Svg) {
        let [left, right] = self.x.places;
        let clock = self.x.clock(most_ticks(right - left, 80.0));
        self.framed(svg, &clock.ticks, clock.label, "");
    }

    fn framed(&self, svg: &mut Svg, ticks: &[(f64, String)], x_label: &str, y_label: &str) {
        let ([left, right], [bottom, top]) = (self.x.places, self.y.places);
        let mut marks = String::new();
        for (value, text) in ticks {
            let at = self.x.at(*value);
            marks += &format!("M{} {}v6", number(at), number(bottom));
            svg.text((at, bottom + 23.0), Anchor::Middle, "", text);
        }
        for (value, text) in self.y_ticks() {
            let at = self.y.at(value);
            marks += &format!("M{} {}h-6", number(left), number(at));
            svg.text((left - 10.0, at + 5.0), Anchor::End, "", &text);
        }
        let axes = format!("stroke=\"{INK}\" fill=\"none\"");
        svg.path(&marks, &axes);
        svg.rect([left, top, right - left, bottom - top], &axes);
        svg.text(
            (f64::midpoint(left, right), bottom + 47.0),
            Anchor::Middle,
            "",
            x_label,
        );
        let middle = f64::midpoint(top, bottom);
        let turned = format!("transform=\"rotate(-90 18 {})\"", number(middle));
        svg.text((18.0, middle), Anchor::Middle, &turned, y_label);
    }

    fn y_ticks(&self) -> Vec<(f64, String)> {
        let [bottom, top] = self.y.places;
        self.y.ticks(most_ticks(bottom - top, 32.0))
    }
}

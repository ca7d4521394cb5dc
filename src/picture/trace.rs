//! Numbers with two decimals, and paths of them in relative coordinates: short, and without drift.
//!
//! Points are rounded to hundredths once, and what is written is the difference of rounded points: errors do not add up along
//! the path.

use super::Point;
use core::fmt::Write;

/// A path under construction.
#[derive(Debug, Default)]
pub(super) struct Trace {
    text: String,
    /// Where the path is, in hundredths.
    at: [i64; 2],
    /// Where its open piece began.
    start: [i64; 2],
}

impl Trace {
    /// A path through points, as one open piece.
    pub(super) fn through(points: impl IntoIterator<Item = Point>) -> Self {
        Self::pieces([points])
    }

    /// A path of open pieces.
    pub(super) fn pieces(pieces: impl IntoIterator<Item: IntoIterator<Item = Point>>) -> Self {
        let mut trace = Self::default();
        for piece in pieces {
            trace.open(piece);
        }
        trace
    }

    /// A path around points, as one closed piece.
    pub(super) fn around(points: impl IntoIterator<Item = Point>) -> Self {
        let mut trace = Self::default();
        trace.closed(points);
        trace
    }

    /// Discs at points.
    pub(super) fn dots(points: impl IntoIterator<Item = Point>) -> Self {
        let mut trace = Self::default();
        for point in points {
            trace.dot(point);
        }
        trace
    }

    /// Adds an open piece through points.
    pub(super) fn open(&mut self, points: impl IntoIterator<Item = Point>) {
        let mut points = points.into_iter();
        let Some(first) = points.next() else { return };
        self.begin(first);
        // Pairs behind a move are lines.
        for point in points {
            let to = point.map(hundredths);
            if to != self.at {
                self.step(to, true);
            }
        }
    }

    /// Adds a closed piece through points, if there are any.
    pub(super) fn closed(&mut self, points: impl IntoIterator<Item = Point>) {
        let before = self.text.len();
        self.open(points);
        if self.text.len() > before {
            self.text.push('z');
            self.at = self.start;
        }
    }

    /// Adds a dot: a piece of no length, which is seen as a disc when lines have round ends.
    pub(super) fn dot(&mut self, point: Point) {
        self.begin(point);
        self.text.push_str("h0");
    }

    /// The path.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    fn begin(&mut self, point: Point) {
        self.text.push('m');
        self.step(point.map(hundredths), false);
        self.start = self.at;
    }

    fn step(&mut self, to: [i64; 2], spaced: bool) {
        let [dx, dz] = [to[0] - self.at[0], to[1] - self.at[1]];
        if spaced && dx >= 0 {
            self.text.push(' ');
        }
        push(&mut self.text, dx);
        if dz >= 0 {
            self.text.push(' ');
        }
        push(&mut self.text, dz);
        self.at = to;
    }
}

/// Two decimals, without those that are zero, and never `-0`.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" {
        "0".to_owned()
    } else {
        short.to_owned()
    }
}

/// To the nearest hundredth; beyond what a picture can be, to its edge.
#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn hundredths(value: f64) -> i64 {
    (value.clamp(-1e6, 1e6) * 100.0).round() as i64
}

/// Hundredths as a number: `1205` is `12.05`, `-50` is `-.5`.
fn push(text: &mut String, value: i64) {
    if value < 0 {
        text.push('-');
    }
    let (whole, rest) = (value.unsigned_abs() / 100, value.unsigned_abs() % 100);
    // Writing to a string cannot fail.
    let _ = match (whole, rest) {
        (0, 0) => write!(text, "0"),
        (0, rest) if rest % 10 == 0 => write!(text, ".{}", rest / 10),
        (0, rest) => write!(text, ".{rest:02}"),
        (whole, 0) => write!(text, "{whole}"),
        (whole, rest) if rest % 10 == 0 => write!(text, "{whole}.{}", rest / 10),
        (whole, rest) => write!(text, "{whole}.{rest:02}"),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Reads a path of this form back: its corners in absolute coordinates.
    fn corners(path: &str) -> Vec<[f64; 2]> {
        let (mut at, mut start) = ([0.0, 0.0], [0.0, 0.0]);
        let mut corners = Vec::new();
        for piece in path.split('m').skip(1) {
            let closed = piece.ends_with('z');
            let spaced = piece.trim_end_matches(['z', 'h']).replace('-', " -");
            let numbers: Vec<f64> = spaced.split_whitespace().map(|n| n.parse().unwrap()).collect();
            for (index, pair) in numbers.chunks(2).enumerate() {
                at = [at[0] + pair[0], at[1] + pair[1]];
                if index == 0 {
                    start = at;
                }
                corners.push(at);
            }
            if closed {
                at = start;
            }
        }
        corners
    }

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        for (value, text) in [
            (0.0, "0"),
            (-0.001, "0"),
            (12.0, "12"),
            (1.5, "1.5"),
            (-0.126, "-0.13"),
            (100.0, "100"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn paths_are_short() {
        let mut trace = Trace::through([[1.0, 2.0], [1.5, 2.0], [0.0, 0.004]]);
        trace.closed([[10.0, 10.0], [12.05, 10.0], [12.05, 9.5]]);
        trace.dot([10.0, 10.0]);
        assert_eq!(trace.text(), "m1 2 .5 0-1.5-2m10 10 2.05 0 0-.5zm0 0h0");
    }

    proptest! {
        #[test]
        fn no_path_drifts(points in prop::collection::vec((-900.0..900.0_f64, -900.0..900.0_f64), 2..200)) {
            let points: Vec<[f64; 2]> = points.into_iter().map(|(x, y)| [x, y]).collect();
            let mut trace = Trace::default();
            for (index, piece) in points.chunks(3).enumerate() {
                let piece = piece.iter().copied();
                if index % 2 == 0 { trace.open(piece) } else { trace.closed(piece) }
            }
            for (found, wanted) in corners(trace.text()).iter().zip(&points) {
                prop_assert!((found[0] - wanted[0]).abs() < 0.00501 && (found[1] - wanted[1]).abs() < 0.00501);
            }
        }
    }
}

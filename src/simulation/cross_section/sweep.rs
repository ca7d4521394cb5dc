//! What a rim cuts, in pieces from left to right.
//!
//! A piece is a stretch in which the surface lies above the rim without a break. It ends where the rim comes out of the
//! surface, at a crack that reaches down to the rim, at a side of the stock, or where the rim itself ends. Of such columns those
//! are free that do not end with the rim; what is beside a crack or in the air does not hold them.

use super::TOUCH;
use super::crack::Crack;
use crate::disc::Stretch;
use crate::rim::{Above, Over, Rim};
use crate::surface::Side;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;

/// How a piece ends on a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// In the air, at a side of the stock, or at a crack.
    Open,
    /// With the rim, in the material.
    Attached,
}

/// A crack in a piece that does not reach down to the rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Short {
    pub(super) x: f64,
    pub(super) above: f64,
}

/// A column above the rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub(super) span: [f64; 2],
    pub(super) ends: [End; 2],
    /// Its greatest height above the rim, in mm.
    pub(super) height: f64,
    /// Where that is.
    pub(super) at: f64,
    /// The crack that ends the least above the rim, of those that do not reach it.
    pub(super) short: Option<Short>,
}

impl Piece {
    fn starting(x: f64, end: End) -> Self {
        Self {
            span: [x, x],
            ends: [end, End::Open],
            height: 0.0,
            at: x,
            short: None,
        }
    }

    pub(super) const fn end(&self, side: Side) -> End {
        let [left, right] = self.ends;
        match side {
            Side::Left => left,
            Side::Right => right,
        }
    }

    /// As it is reported.
    pub(super) fn stretch(&self) -> Stretch {
        let [from, to] = self.span;
        Stretch {
            from,
            to,
            height: Length::mm(self.height),
            highest: self.at,
        }
    }

    pub(super) fn is_free(&self) -> bool {
        self.ends == [End::Open; 2]
    }
}

/// A rim on its way through the section.
pub(super) struct Sweep<'s> {
    pub(super) rim: &'s Rim,
    /// The surface over what is swept, from left to right.
    pub(super) line: &'s [Point2],
    /// What counts as touching, in mm.
    pub(super) tolerance: f64,
    /// How the swept stretch ends where the surface is above the rim.
    pub(super) ends: [End; 2],
}

impl Sweep<'_> {
    /// The pieces from left to right. `cracks` are those over the swept stretch and at its ends, in order.
    pub(super) fn pieces(&self, cracks: impl Iterator<Item = Crack>, out: &mut Vec<Piece>) {
        let mut walk = Walk {
            sweep: self,
            cracks: cracks.peekable(),
            open: None,
            out,
        };
        let mut corners = self.line.iter().map(|&corner| self.rim.over(corner));
        if let Some(mut from) = corners.next() {
            for to in corners {
                walk.go_on(from, to);
                from = to;
            }
        }
        if let Some(&last) = self.line.last() {
            walk.end(last.x);
        }
    }

    fn span(&self) -> [f64; 2] {
        let x = |corner: Option<&Point2>| corner.map_or(0.0, |corner| corner.x);
        [x(self.line.first()), x(self.line.last())]
    }

    fn reaches(&self, crack: Crack) -> bool {
        crack.bottom <= self.rim.height(crack.x) + TOUCH
    }
}

struct Walk<'s, 'o, C: Iterator<Item = Crack>> {
    sweep: &'s Sweep<'s>,
    cracks: core::iter::Peekable<C>,
    open: Option<Piece>,
    out: &'o mut Vec<Piece>,
}

impl<C: Iterator<Item = Crack>> Walk<'_, '_, C> {
    /// Along a straight piece of the surface, or a wall of it.
    fn go_on(&mut self, from: Over, to: Over) {
        let Sweep { rim, tolerance, .. } = *self.sweep;
        if to.at.x <= from.at.x {
            if to.above <= tolerance {
                self.close(from.at.x, End::Open);
            }
            return;
        }
        let highest = |above: &Above| {
            let x = rim.highest_above(above.line, above.from, above.to);
            rim.below(above.line.at(x))
        };
        let above = (!rim.is_clear(from, to, tolerance))
            .then(|| rim.above(from.at, to.at, 0.0))
            .flatten()
            .filter(|above| from.above.max(to.above) > tolerance || highest(above) > tolerance);
        let Some(above) = above else {
            self.close(from.at.x, End::Open);
            return;
        };
        if from.above <= tolerance {
            self.close(from.at.x, End::Open);
        }
        if self.open.is_none() {
            self.start(above.from);
        }
        self.pass_cracks(above);
        if to.above <= tolerance {
            self.close(above.to, End::Open);
        }
    }

    fn start(&mut self, x: f64) {
        let [first, _] = self.sweep.span();
        let end = if x <= first { self.sweep.ends[0] } else { End::Open };
        self.open = Some(Piece::starting(x, end));
    }

    /// Splits the piece at the cracks below a straight piece of the surface.
    fn pass_cracks(&mut self, above: Above) {
        let mut from = above.from;
        while let Some(crack) = self.cracks.next_if(|crack| crack.x <= above.to + TOUCH) {
            if crack.x < above.from - TOUCH {
                continue;
            }
            let x = crack.x.max(above.from).min(above.to);
            if x - from > TOUCH {
                self.note_height(above, from, x);
            }
            from = x;
            if self.sweep.reaches(crack) {
                self.close(x, End::Open);
                self.open = Some(Piece::starting(x, End::Open));
            } else if let Some(piece) = &mut self.open {
                let short = Short {
                    x: crack.x,
                    above: crack.bottom - self.sweep.rim.height(crack.x),
                };
                if crack.bottom < above.line.at(x).z
                    && piece.short.is_none_or(|known| short.above < known.above)
                {
                    piece.short = Some(short);
                }
            }
        }
        // Beside a crack at the edge of a wall nothing is left of a straight piece: what lies on the other side of the wall is as high as
        // it is, and not as the wall.
        let is_split = from > above.from;
        if !is_split || above.to - from > TOUCH {
            self.note_height(above, from, above.to);
        }
    }

    fn note_height(&mut self, above: Above, from: f64, to: f64) {
        if let Some(piece) = &mut self.open {
            let x = self.sweep.rim.highest_above(above.line, from, to);
            let height = self.sweep.rim.below(above.line.at(x));
            if height > piece.height {
                (piece.height, piece.at) = (height, x);
            }
        }
    }

    /// Ends the piece at hand; one without width is dropped.
    fn close(&mut self, x: f64, end: End) {
        if let Some(mut piece) = self.open.take() {
            piece.span[1] = x;
            piece.ends[1] = end;
            if x - piece.span[0] > TOUCH && piece.height > self.sweep.tolerance {
                self.out.push(piece);
            }
        }
    }

    fn end(&mut self, x: f64) {
        let ends_open = self
            .cracks
            .any(|crack| crack.x <= x + TOUCH && self.sweep.reaches(crack));
        let end = if ends_open { End::Open } else { self.sweep.ends[1] };
        self.close(x, end);
    }
}

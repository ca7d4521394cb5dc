//! Whether a strip is within what its disc takes, and what holds one that stays.

use super::sweep::{End, Piece};
use super::{CrossSection, TOUCH};
use crate::disc::{Disc, DiscPass, Hold, PassFault};
use crate::rim::Rim;
use crate::surface::Side;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;

impl CrossSection {
    /// Compares a strip with what the disc takes. Ends thinner than a sliver do not count as width.
    pub(super) fn judge_size(
        &mut self,
        disc: &Disc,
        pass: &DiscPass,
        strip: &Piece,
        shave: f64,
    ) -> impl Iterator<Item = PassFault> + use<> {
        let body = self.thicker(&pass.rim(disc), strip.span, shave);
        let limit = room(disc, pass, body);
        let stretch = strip.stretch();
        let thick = limit.filter(|&limit| strip.height > limit.to_mm() + TOUCH);
        let thick = thick.map(|limit| PassFault::TooThick { stretch, limit });
        let wide = disc.width.and_then(|limit| {
            let width = Length::mm(body.map_or(0.0, |[first, last]| last - first));
            let is_wide = width.to_mm() > limit.to_mm() + TOUCH;
            is_wide.then_some(PassFault::TooWide {
                stretch,
                width,
                limit,
            })
        });
        thick.into_iter().chain(wide)
    }

    /// From where to where a strip is thicker than so much, with all between.
    pub(super) fn thicker(&mut self, rim: &Rim, [from, to]: [f64; 2], level: f64) -> Option<[f64; 2]> {
        let mut span: Option<[f64; 2]> = None;
        let mut before: Option<Point2> = None;
        for corner in self.surface.stretch(from, to) {
            let start = before.replace(corner).unwrap_or(corner);
            if let Some(above) = rim.above(start, corner, level) {
                let [first, _] = span.unwrap_or([above.from; 2]);
                span = Some([first, above.to]);
            }
        }
        span
    }

    /// What holds a strip that ends like this on the side away from the rim.
    pub(super) fn hold(&mut self, rim: &Rim, side: Side, strip: &Piece, inner: End) -> Hold {
        if let Some(short) = strip.short {
            return Hold::SlitShort {
                x: short.x,
                above: Length::mm(short.above),
            };
        }
        let beyond = match inner {
            End::Attached => None,
            End::Open => self.end_beyond(rim, side),
        };
        let [left, right] = rim.cover();
        beyond.map_or(Hold::Closed, |x| Hold::RimShort {
            x,
            by: Length::mm(match side {
                Side::Left => left - x,
                Side::Right => x - right,
            }),
        })
    }

    /// The nearest place beyond a rim at which its strip would end, no farther than the rim's radius: a crack that reaches down
    /// to it, a wall, or the side of the stock.
    fn end_beyond(&mut self, rim: &Rim, side: Side) -> Option<f64> {
        let ([left, right], centre) = (rim.cover(), rim.centre());
        let reaches = |bottom: f64| bottom <= centre.z + TOUCH;
        let (crack, span) = match side {
            Side::Left => {
                self.cracks.go_to(left - TOUCH);
                (
                    self.cracks.behind().find(|crack| reaches(crack.bottom)),
                    [left - (centre.x - left), left],
                )
            }
            Side::Right => {
                self.cracks.go_to(right + TOUCH);
                (
                    self.cracks.ahead().find(|crack| reaches(crack.bottom)),
                    [right, right + (right - centre.x)],
                )
            }
        };
        let crack = crack
            .map(|crack| crack.x)
            .filter(|x| (span[0]..=span[1]).contains(x));
        let mut line: Vec<Point2> = self.surface.stretch(span[0], span[1]).collect();
        if side == Side::Left {
            line.reverse();
        }
        let low = line.iter().find(|corner| reaches(corner.z));
        let width = self.surface.width();
        let stock = match side {
            Side::Left => 0.0,
            Side::Right => width,
        };
        let ends = [crack, low.map(|corner| corner.x), Some(stock)];
        let within = ends
            .into_iter()
            .flatten()
            .filter(|x| (span[0]..=span[1]).contains(x));
        within.min_by(|a, b| (a - centre.x).abs().total_cmp(&(b - centre.x).abs()))
    }
}

/// The thickest strip that the disc takes, and that its body leaves room for. Slivers beside the strip take no room.
fn room(disc: &Disc, pass: &DiscPass, strip: Option<[f64; 2]>) -> Option<Length> {
    let Some([from, to]) = strip else {
        return disc.depth;
    };
    let lies_over = |radius: Length| {
        let radius = (radius + pass.clearance).to_mm();
        from < pass.centre.x + radius && to > pass.centre.x - radius
    };
    let stages = disc.body.iter().filter(|stage| lies_over(stage.radius));
    let heights = stages.map(|stage| stage.from);
    heights.chain(disc.depth).reduce(|a, b| if b < a { b } else { a })
}

//! The x-z section that pictures of cuts are drawn in: the stock, the part, axes in mm.
//!
//! It is drawn to scale: the angle of a V on paper is that of the blade. A flat stock gets a wider sheet; only one that would be no
//! more than a line, over forty times as wide as it is high, is drawn higher by a round factor, which is said below the axis.

use super::chart;
use super::scale::{Scale, round_step};
use super::sheet::{MARGIN, PAGE_WIDTH, Room};
use super::svg::{Along, Anchor, Svg};
use super::thin::Thinned;
use super::trace::number;
use super::{Point, Prefix, Setting};

/// The highest plot.
const HIGHEST: f64 = 600.0;
/// A lower plot gets a wider sheet, if it stands alone.
const FLAT: f64 = 130.0;
/// The lowest plot that is still to scale.
const LOWEST: f64 = 24.0;
/// A narrower sheet would have no room for words.
const NARROWEST: f64 = 400.0;
/// Columns that curves are looked at in: so many to a unit of the picture, so that it can be enlarged.
const FINER: u32 = 3;
/// Room below the section for its x axis and scale bar.
pub(super) const BELOW: f64 = 74.0;

/// Where things of the section are in the picture.
pub(super) struct Section {
    pub(super) room: Room,
    pub(super) x: Scale,
    pub(super) z: Scale,
    /// By how much z is drawn larger than x.
    stretch: u32,
    /// The lower edge.
    pub(super) bottom: f64,
}

impl Section {
    /// A section through a stock of this width and height, in mm.
    pub(super) fn of([width, height]: [f64; 2], ids: Prefix) -> Self {
        let room = Room::of(ids);
        let scale_in = |room: Room| (room.across() / width).min(HIGHEST / height);
        let room = match ids.setting {
            Setting::Alone if height * scale_in(room) < FLAT => room.of_width(PAGE_WIDTH),
            Setting::Alone | Setting::Page | Setting::Phone => room,
        };
        let scale = scale_in(room);
        let right = room.left + width * scale;
        let room = room.of_width((right + MARGIN).max(NARROWEST));
        let fits = |stretch: &u32| height * scale * f64::from(*stretch) >= LOWEST;
        let stretch = [1, 2, 5, 10, 20, 50, 100].into_iter().find(fits).unwrap_or(100);
        let bottom = room.top + height * scale * f64::from(stretch);
        Self {
            room,
            x: Scale::new([0.0, width], [room.left, right]),
            z: Scale::new([0.0, height], [bottom, room.top]),
            stretch,
            bottom,
        }
    }

    /// Where a point in mm is.
    pub(super) fn at(&self, [x, z]: Point) -> Point {
        [self.x.at(x), self.z.at(z)]
    }

    /// A curve over x, of no more points than can be seen.
    pub(super) fn curve(&self, points: &[Point]) -> Vec<Point> {
        let thinned = Thinned::of(points, FINER * self.room.columns());
        thinned.into_iter().map(|point| self.at(point)).collect()
    }

    /// What is below a curve.
    pub(super) fn below(&self, svg: &mut Svg, points: &[Point], paint: &str) {
        let curve = self.curve(points);
        let ends = [curve.last(), curve.first()].map(|end| end.map(|end| [end[0], self.bottom]));
        svg.closed(curve.iter().copied().chain(ends.into_iter().flatten()), paint);
    }

    /// The stock, as its outline, with attributes.
    pub(super) fn stock(&self, svg: &mut Svg, paint: &str) {
        let ([left, _], [_, top]) = (self.x.places, self.z.places);
        svg.rect([left, top, self.x.length(), self.z.length()], paint);
    }

    /// Axes with round values, and a bar of a round length for comparison, at most a fifth of the width.
    pub(super) fn axes(&self, svg: &mut Svg) {
        let ([left, right], [bottom, top]) = (self.x.places, self.z.places);
        chart::ticks_below(svg, &self.x, bottom, 70.0);
        chart::ticks_beside(svg, &self.z, left, 28.0);
        svg.text([left, bottom + 49.0], Anchor::Start, "", &self.x_label());
        // A turned name takes as much room upwards as it has letters.
        svg.upwards([18.0, top.midpoint(bottom).max(top + 20.0)], "z, mm");
        let step = round_step(self.x.values[1] / 10.0).size;
        let words = format!("{} mm", number(step));
        chart::bar(svg, [right, bottom + 44.0], step * self.x.per_unit(), &words);
        svg.cursor(Along::Width, &self.x, [top, bottom]);
    }

    fn x_label(&self) -> String {
        match self.stretch {
            1 => "x, mm".to_owned(),
            stretch => format!("x, mm; z is drawn {stretch} times larger"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_to_scale_until_they_would_be_lines() {
        for (stock, stretch) in [
            ([60.0, 50.0], 1),
            ([900.0, 30.0], 1),
            ([40.0, 400.0], 1),
            ([4000.0, 20.0], 5),
        ] {
            for ids in [Prefix::NONE, Prefix::new("a-"), Prefix::for_phones("b-")] {
                let section = Section::of(stock, ids);
                let drawn = section.z.per_unit() / section.x.per_unit();
                assert!(
                    (drawn - f64::from(section.stretch)).abs() < 1e-9,
                    "{stock:?} {ids:?}"
                );
                let to_scale = stock[1] * section.x.per_unit();
                assert!(section.stretch == 1 || to_scale < LOWEST, "{stock:?} {ids:?}");
                assert_eq!(section.x_label().contains("larger"), section.stretch > 1);
                assert!(
                    section.x.places[1] <= section.room.right + 1e-9,
                    "{stock:?} {ids:?}"
                );
            }
            assert_eq!(
                Section::of(stock, Prefix::new("a-")).stretch,
                stretch,
                "{stock:?}"
            );
        }
    }
}

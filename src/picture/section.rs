//! The x-z section that pictures of cuts are drawn in: the stock, the part, axes in mm.
//!
//! It is drawn to scale: the angle of a V on paper is that of the blade. A flat stock gets a wider sheet; only one that would be no
//! more than a line, over forty times as wide as it is high, is drawn higher by a round factor, which is said below the axis.

use super::palette::INK;
use super::scale::{Scale, round_step};
use super::sheet::{MARGIN, PAGE_WIDTH, Room};
use super::svg::{Along, Anchor, Svg, number};
use super::thin::Thinned;
use super::trace::Trace;
use super::{Prefix, Setting};

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
    pub(super) fn at(&self, [x, z]: [f64; 2]) -> [f64; 2] {
        [self.x.at(x), self.z.at(z)]
    }

    /// A curve over x, of no more points than can be seen.
    pub(super) fn curve(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let thinned = Thinned::of(points, FINER * self.room.columns());
        thinned.into_iter().map(|point| self.at(point)).collect()
    }

    /// What is below a curve.
    pub(super) fn below(&self, points: &[[f64; 2]]) -> Trace {
        let mut outline = self.curve(points);
        let ends = [outline.last(), outline.first()].map(|end| end.map(|end| [end[0], self.bottom]));
        outline.extend(ends.into_iter().flatten());
        let mut trace = Trace::default();
        trace.closed(outline);
        trace
    }

    /// The stock, as its outline, with attributes.
    pub(super) fn stock(&self, svg: &mut Svg, paint: &str) {
        let [left, right] = self.x.places;
        let top = self.room.top;
        svg.rect([left, top, right - left, self.bottom - top], paint);
    }

    /// Axes with round values, and a bar for comparison.
    pub(super) fn axes(&self, svg: &mut Svg) {
        let (left, right, bottom) = (self.x.places[0], self.x.places[1], self.bottom);
        let top = self.room.top;
        let mut marks = String::new();
        for (value, text) in self.x.ticks(most_ticks(right - left, 70.0)) {
            let at = self.x.at(value);
            marks += &format!("M{} {}v6", number(at), number(bottom));
            svg.text((at, bottom + 23.0), Anchor::Middle, "", &text);
        }
        for (value, text) in self.z.ticks(most_ticks(bottom - top, 28.0)) {
            let at = self.z.at(value);
            marks += &format!("M{} {}h-6", number(left), number(at));
            svg.text((left - 11.0, at + 5.0), Anchor::End, "", &text);
        }
        svg.path(&marks, &format!("stroke=\"{INK}\" fill=\"none\""));
        svg.text((left, bottom + 49.0), Anchor::Start, "", &self.x_label());
        // A turned name takes as much room upwards as it has letters.
        let middle = f64::midpoint(top, bottom).max(top + 20.0);
        let turned = format!("transform=\"rotate(-90 18 {})\"", number(middle));
        svg.text((18.0, middle), Anchor::Middle, &turned, "z, mm");
        self.bar(svg);
        svg.cursor(Along::Width, &self.x, [top, bottom]);
    }

    fn x_label(&self) -> String {
        match self.stretch {
            1 => "x, mm".to_owned(),
            stretch => format!("x, mm; z is drawn {stretch} times larger"),
        }
    }

    /// A bar of a round length, at most a fifth of the width.
    fn bar(&self, svg: &mut Svg) {
        let width = self.x.values[1];
        let step = round_step(width / 10.0).size();
        let (right, y) = (self.x.places[1], self.bottom + 44.0);
        let length = step * self.x.per_unit();
        let path = format!("M{} {}v-5m0 5h-{}v-5", number(right), number(y), number(length));
        svg.path(
            &path,
            &format!("stroke=\"{INK}\" stroke-width=\"2\" fill=\"none\""),
        );
        let words = format!("{} mm", number(step));
        svg.text((right - length - 9.0, y + 5.0), Anchor::End, "", &words);
    }
}

/// How many steps fit along an axis when each needs so much room.
pub(super) fn most_ticks(length: f64, room: f64) -> u32 {
    ((length / room) as u32).max(1)
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

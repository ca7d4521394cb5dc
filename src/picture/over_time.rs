//! What pictures over the time of a program share: what is done when, and a panel for each axis of the machine.

use super::Setting;
use super::band::{Band, MANY};
use super::chart::{FRAME, Plot};
use super::palette::VERMILION;
use super::scale::Scale;
use super::sheet::{self, Entry, Room};
use super::svg::{Anchor, Svg};
use super::times::KINDS;
use super::trace::Trace;
use super::{Point, Prefix};

/// Columns that curves are looked at in: as many as the widest plot is wide.
pub const COLUMNS: u32 = 1050;
/// The narrowest columns in which the turns of many cuts are looked at.
const NARROWEST: f64 = 2.0;

/// The course of a program; times are in s.
#[derive(Clone, Debug, PartialEq)]
pub struct Course<'a> {
    /// How long the program takes.
    pub seconds: f64,
    /// Names of the kinds of motion.
    pub kinds: &'a [&'static str],
    /// What is done when: stretches in the order of time.
    pub spans: &'a [Span],
    /// When layers begin, and what they are called.
    pub layers: &'a [(f64, String)],
    /// How many cuts there are. What the axes do in a hundred and more is drawn as the band that it fills.
    pub cuts: usize,
}

/// A stretch of time in which motions of one kind are done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// When it begins and ends.
    pub time: [f64; 2],
    /// Which of the kinds.
    pub kind: usize,
}

const STRIP: f64 = 16.0;
/// Room above the values of a panel for its words.
pub(super) const HEAD: f64 = 30.0;
/// How far the words of a panel begin before its plot.
const BEFORE: f64 = 42.0;
pub(super) const CURVE: &str =
    "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.4\" stroke-linejoin=\"round\"";
pub(super) const EDGED: &str =
    "fill=\"#0072b2\" fill-opacity=\"0.35\" stroke=\"#0072b2\" stroke-width=\"0.8\"";
pub(super) const USED: &str = "fill=\"#8a8577\"";
pub(super) const BEYOND: &str = "fill=\"#d55e00\" fill-opacity=\"0.25\"";

impl Course<'_> {
    /// The kinds of motion that there are.
    pub(super) fn legend(&self) -> Vec<Entry> {
        let is_done = |kind: &usize| self.spans.iter().any(|span| span.kind == *kind);
        let kinds = self.kinds.iter().zip(KINDS).enumerate();
        kinds
            .filter(|(number, _)| is_done(number))
            .map(|(_, (kind, colour))| Entry::area(format!("fill=\"{colour}\""), *kind))
            .collect()
    }

    /// What the curve of a quantity is called.
    pub(super) fn curve(&self, name: &str) -> Entry {
        if self.cuts >= MANY {
            Entry::area(EDGED, format!("{name} (turns drawn as a band)"))
        } else {
            Entry::line(CURVE, name)
        }
    }

    /// For each column, how much of its time each kind takes, in steps of a sixteenth so that neighbours are often alike.
    fn shares(&self, count: u32) -> Vec<Vec<f64>> {
        let width = self.seconds.max(f64::MIN_POSITIVE) / f64::from(count);
        let mut columns = vec![vec![0.0; self.kinds.len()]; count as usize];
        for span in self.spans {
            let [from, to] = span.time;
            let first = (from / width) as usize;
            for (column, shares) in columns.iter_mut().enumerate().skip(first) {
                let [start, end] = [column as f64 * width, (column + 1) as f64 * width];
                if start >= to {
                    break;
                }
                if let Some(share) = shares.get_mut(span.kind) {
                    *share += (end.min(to) - start.max(from)).max(0.0) / width;
                }
            }
        }
        for share in columns.iter_mut().flatten() {
            *share = (*share * 16.0).round() / 16.0;
        }
        columns
    }
}

/// A picture of panels under construction.
pub(super) struct Panels<'a> {
    course: &'a Course<'a>,
    ids: Prefix,
    pub(super) room: Room,
}

impl<'a> Panels<'a> {
    pub(super) const fn new(course: &'a Course<'a>, ids: Prefix) -> Self {
        Self {
            course,
            ids,
            room: Room::of(ids),
        }
    }

    /// Where the first panel begins.
    pub(super) const fn top(&self) -> f64 {
        self.room.top + STRIP + 34.0
    }

    pub(super) fn time(&self) -> Scale {
        Scale::clock([0.0, self.course.seconds], [self.room.left, self.room.right])
    }

    pub(super) fn plot(&self, values: [f64; 2], [top, bottom]: [f64; 2]) -> Plot {
        Plot {
            x: self.time(),
            y: Scale::new(values, [bottom, top]),
        }
    }

    /// The band that what many cuts do over time fills: in columns of more than a cut each, so that there are no gaps between them.
    pub(super) fn turns(&self, curve: &[Point]) -> Option<Band> {
        let most = self.course.cuts as f64 / 1.3;
        let columns = most.min(self.room.across() / NARROWEST) as u32;
        (self.course.cuts >= MANY).then(|| Band::of(curve, columns))
    }

    /// What is done when: each column divided by the shares of kinds, and where layers begin.
    pub(super) fn strip(&self, svg: &mut Svg) {
        let mut rects: Vec<Vec<[f64; 4]>> = vec![Vec::new(); self.course.kinds.len()];
        let width = self.room.across() / f64::from(self.room.columns());
        let mut left = self.room.left;
        for run in self.course.shares(self.room.columns()).chunk_by(|a, b| a == b) {
            let right = left + width * run.len() as f64;
            let mut top = self.room.top;
            for (share, rects) in run.iter().take(1).flatten().zip(&mut rects) {
                if *share > 0.0 {
                    rects.push([left, top, right - left, share * STRIP]);
                    top += share * STRIP;
                }
            }
            left = right;
        }
        for (rects, colour) in rects.iter().zip(KINDS) {
            svg.rects(
                rects,
                &format!("fill=\"{colour}\" shape-rendering=\"crispEdges\""),
            );
        }
        self.layers(svg, self.room.top + STRIP);
    }

    /// Names of layers above where they begin, as many as there is room for.
    fn layers(&self, svg: &mut Svg, top: f64) {
        let (time, mut marks, mut free_from) = (self.time(), Trace::default(), self.room.left);
        for (start, name) in self.course.layers {
            let x = time.at(*start);
            let width = sheet::text_width(name);
            if x >= free_from - 1e-9 && x + width <= self.room.right {
                marks.open([[x, top], [x, top + 5.0]]);
                svg.text([x, top + 20.0], Anchor::Start, "", name);
                free_from = x + width + 10.0;
            }
        }
        svg.path(marks.text(), FRAME);
        svg.text([self.room.left - 10.0, top + 20.0], Anchor::End, "", "layer");
    }

    /// The words above a panel, then what there is to warn of. A telephone has no room for the warning.
    pub(super) fn headline(&self, svg: &mut Svg, words: &str, warning: &str, top: f64) {
        let at = [self.room.left - BEFORE, top + 20.0];
        svg.text(at, Anchor::Start, "", words);
        match self.ids.setting {
            Setting::Phone => {}
            Setting::Alone | Setting::Page => {
                let after = [at[0] + sheet::text_width(words) + 12.0, at[1]];
                svg.coloured(after, Anchor::Start, VERMILION, "font-weight=\"bold\"", warning);
            }
        }
    }

    /// Beside a panel: a whole range, and what is used of it.
    pub(super) fn gauge(
        &self,
        svg: &mut Svg,
        limits: [f64; 2],
        used: [f64; 2],
        paint: &str,
        [top, bottom]: [f64; 2],
    ) {
        let left = self.room.right + 12.0;
        let range = Scale::new(limits, [bottom, top]);
        let [low, high] = used.map(|value| value.clamp(range.values[0], range.values[1]));
        let [upper, lower] = [high, low].map(|value| range.at(value));
        let whole = [left, top, 16.0, bottom - top];
        svg.rect(whole, "fill=\"#ffffff\"");
        svg.rect([left, upper, 16.0, (lower - upper).max(1.5)], paint);
        svg.rect(whole, FRAME);
    }
}

/// The lowest and the highest value of a curve.
pub(super) fn extremes(points: &[Point]) -> [f64; 2] {
    let values = points.iter().map(|point| [point[1], point[1]]);
    let found = values.reduce(|[low, high], [value, _]| [low.min(value), high.max(value)]);
    found.unwrap_or_default()
}

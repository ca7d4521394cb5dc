//! Counts and times by formulas: which process is faster, and from where on.
//!
//! With the length `D` of the stock, counts `N` and extensions `b` of V-cuts, slits (s) and strips (p), `C` changes of `t_c`, feeds
//! `v_t` of the straight blade and `v_d` of the disc, `r = v_d / v_t`, the time in the material is *(derived here, from the form of
//! [Yu 2019])*
//!
//! ```text
//! T_V = 2 N_V (D + 2 b_V) / v_t
//! T_R = N_s (D + 2 b_s) / v_t + N_p (D + 2 b_p) / v_d + C t_c
//! r*  = N_p / (2 N_V - N_s)                                            both as fast per mm of D
//! D*  = (C t_c v_t + 2 b_s N_s + 2 b_p N_p / r - 4 b_V N_V) / (2 N_V - N_s - N_p / r)
//! ```
//!
//! D enters linearly, so both are exact for programmed speeds.

use super::Work;
use super::blades::{Knife, Wheel};
use crate::asked::Residual;
use vcutc_backend_api::units::{Angle, AngularSpeed, Area, Duration, Length, Speed};

/// How many cuts a plan has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    pub slits: usize,
    pub strips: usize,
    /// Changes of blade, with the straight one at hand before.
    pub changes: usize,
    /// The lowest layer with strips, counted from 1.
    pub layers: u32,
}

impl Counts {
    /// Slits and strips together.
    #[must_use]
    pub const fn cuts(self) -> usize {
        self.slits + self.strips
    }
}

/// How fast everything goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Of the straight blade in the material; positive.
    pub slit: Speed,
    /// Of the disc in the material; positive.
    pub free: Speed,
    /// Through the air; positive.
    pub travel: Speed,
    /// Of turning a blade; positive.
    pub reorient: AngularSpeed,
    /// A change of blade; zero where people do it.
    pub change: Duration,
    /// The way to where blades are changed, and back.
    pub change_way: Duration,
    /// Air between blade and stock where it turns.
    pub run_out: Length,
    /// Height of the safe plane above the stock.
    pub clearance: Length,
}

/// V-cutting as the model sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VCut {
    /// Vs, of two passes each.
    pub cuts: f64,
    /// How far a pass extends beyond the stock, on either side.
    pub extension: Length,
}

/// Rectangular cutting as the model sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RectCut {
    pub slits: f64,
    pub strips: f64,
    pub changes: f64,
    pub layers: f64,
    /// How far a slit extends beyond the stock, on either side.
    pub slit_extension: Length,
    /// How far a pass of the disc does.
    pub strip_extension: Length,
    /// How far blades turn between two cuts.
    pub slit_turn: Angle,
    pub strip_turn: Angle,
}

impl VCut {
    /// The time in the material.
    #[must_use]
    pub fn time(&self, length: Length, feed: Speed) -> Duration {
        (length + 2.0 * self.extension) * (2.0 * self.cuts) / feed
    }
}

impl RectCut {
    /// With these counts and blades.
    #[must_use]
    pub fn of(counts: Counts, knife: &Knife, wheel: &Wheel, pace: &Pace) -> Self {
        Self {
            slits: counts.slits as f64,
            strips: counts.strips as f64,
            changes: counts.changes as f64,
            layers: f64::from(counts.layers),
            slit_extension: knife.overhang() + pace.run_out,
            strip_extension: wheel.overhang() + pace.run_out,
            slit_turn: knife.turn(),
            strip_turn: 2.0 * wheel.lead,
        }
    }

    /// The time in the material, and for changes without their ways.
    #[must_use]
    pub fn time(&self, length: Length, pace: &Pace) -> Duration {
        self.slitting(length, pace) + self.freeing(length) / pace.free + pace.change * self.changes
    }

    /// The time with ways through the air: from cut to cut, from layer to layer, to where blades are changed.
    #[must_use]
    pub fn planned_time(&self, work: Work<'_>, step: Length, pace: &Pace) -> Duration {
        let aside = step / pace.travel;
        let beside = aside.max(self.slit_turn / pace.reorient) * self.slits
            + aside.max(self.strip_turn / pace.reorient) * self.strips;
        let width = work.stock.width;
        let removed = width.to_mm() * work.stock.height.to_mm()
            - work
                .bound
                .area_below(Length::ZERO.to_mm(), width.to_mm())
                .to_mm2();
        let mean_depth = Length::mm(removed / width.to_mm());
        let layer = (2.0 * (pace.clearance + mean_depth) + width) / pace.travel;
        self.time(work.stock.depth, pace) + pace.change_way * self.changes + beside + layer * self.layers
    }

    fn slitting(&self, length: Length, pace: &Pace) -> Duration {
        (length + 2.0 * self.slit_extension) * self.slits / pace.slit
    }

    fn freeing(&self, length: Length) -> Length {
        (length + 2.0 * self.strip_extension) * self.strips
    }
}

/// Both processes on one stock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    pub v: VCut,
    pub rect: RectCut,
}

impl Comparison {
    /// The ratio of the disc's feed to the straight blade's at which both take as long for every further millimetre of length;
    /// none where slits alone take as long as Vs.
    #[must_use]
    pub fn even_ratio(&self) -> Option<f64> {
        let gained = 2.0 * self.v.cuts - self.rect.slits;
        (gained > 0.0).then(|| self.rect.strips / gained)
    }

    /// The length of the stock from which on rectangular cutting is faster, with the Vs cut as fast as the slits; none where
    /// it never is. Zero or less where it always is.
    #[must_use]
    pub fn even_length(&self, pace: &Pace) -> Option<Length> {
        let gap = self.rect.time(Length::ZERO, pace) - self.v.time(Length::ZERO, pace.slit);
        let metre = Length::m(1.0);
        let gain = (self.v.time(metre, pace.slit) - self.v.time(Length::ZERO, pace.slit))
            - (self.rect.time(metre, pace) - self.rect.time(Length::ZERO, pace));
        (gain > Duration::ZERO).then(|| metre * (gap / gain))
    }

    /// The feed of the disc at which both take as long on a stock of this length; none where slits and changes alone take
    /// longer than the Vs.
    #[must_use]
    pub fn even_feed(&self, length: Length, pace: &Pace) -> Option<Speed> {
        let without = self.rect.slitting(length, pace) + pace.change * self.rect.changes;
        let time = self.v.time(length, pace.slit) - without;
        (time > Duration::ZERO).then(|| self.rect.freeing(length) / time)
    }
}

/// How many Vs there are for one strip when both take the same area: the ratio of the sections of their chips, `h s` and
/// `d^2 sin(2 swing)` of an interlaced lattice *(derived here)*.
#[must_use]
pub fn cuts_per_strip(layer: Length, step: Length, reach: Length, swing: Angle) -> f64 {
    (layer / reach) * (step / reach) / (2.0 * swing).sin()
}

/// What a part is to the counting of strips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Removal {
    /// Area of the cross-section to remove.
    pub area: Area,
    /// How far the part rises and falls in all over the width of the stock.
    pub variation: Length,
    pub width: Length,
    /// How many whole layers there are above the lowest place.
    pub layers: f64,
}

impl Removal {
    /// How many strips there are on average, without planning them; none of `mixed`, which no formula counts. With `A` the
    /// area, `V` the variation and `m` whole layers *(derived here)*:
    ///
    /// ```text
    /// discard  A / (h s) - V / (2 h) - W / (2 s)
    /// lift     A / (h s) - V / (2 h) + W / (2 s)
    /// shift    A / (h s) - W / (2 s) + m / 2
    /// ```
    #[must_use]
    pub fn strips(&self, layer: Length, step: Length, residual: Residual) -> Option<f64> {
        let whole = self.area.to_mm2() / (layer.to_mm() * step.to_mm());
        let (rising, across) = (self.variation / layer / 2.0, self.width / step / 2.0);
        match residual {
            Residual::Discard => Some(whole - rising - across),
            Residual::Lift => Some(whole - rising + across),
            Residual::Shift => Some(whole - across + self.layers / 2.0),
            Residual::Mixed => None,
        }
    }
}

//! The mean-value estimate of the process time [Cui 8-11].
//!
//! It needs only the parameters, not the cuts, which makes it the objective of parameter choice; the program's own time
//! (`vcutc_simulation::timing`) is what the planned cuts really take.

use vcutc_backend_api::units::{Angle, AngularSpeed, Area, Duration, Length, Speed};

/// What the estimate depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeModel {
    /// Stock across the cuts (W).
    pub width: Length,
    /// Stock along the cuts (D).
    pub depth: Length,
    /// Area to remove in the x-z plane (A_C).
    pub area: Area,
    /// Safe plane above the stock (h0).
    pub clearance: Length,
    /// How far a cut runs out (b).
    pub extension: Length,
    /// Rake (theta).
    pub rake: Angle,
    /// Cutting speed (v1).
    pub cut_feed: Speed,
    /// Speed through the air (v2).
    pub travel_feed: Speed,
    /// Rate of turning (omega).
    pub reorient_rate: AngularSpeed,
}

impl TimeModel {
    /// How many Vs the estimate is made for.
    #[must_use]
    pub fn cuts(&self, layer: Length, step: Length) -> f64 {
        self.points(step) * self.layers(layer)
    }

    fn points(&self, step: Length) -> f64 {
        self.width / step + 0.5
    }

    /// Less than one layer is still one.
    fn layers(&self, layer: Length) -> f64 {
        let mean_depth = self.area.to_mm2() / self.width.to_mm();
        (mean_depth / layer.to_mm() - 0.5).max(1.0)
    }

    /// Estimated process time for a swing, a layer and a step.
    #[must_use]
    pub fn estimate(&self, swing: Angle, layer: Length, step: Length) -> Duration {
        self.of_cuts(swing, (layer, step), self.points(step), self.layers(layer))
    }

    /// The same for so many points in each of so many layers.
    #[must_use]
    pub fn of_cuts(
        &self,
        swing: Angle,
        (layer, step): (Length, Length),
        points: f64,
        layers: f64,
    ) -> Duration {
        let mean_depth = self.area.to_mm2() / self.width.to_mm();
        let turn = Angle::rad(2.0 * libm::acos(swing.cos() * self.rake.sin())) / self.reorient_rate;
        let cuts = (2.0 * self.depth + 4.0 * self.extension) / self.cut_feed;
        let per_point = cuts + turn + turn.max(step / self.travel_feed);
        let change = 2.0 * self.clearance + Length::mm(2.0 * mean_depth) + self.width - layer - 0.5 * step;
        points * layers * per_point + layers * (change / self.travel_feed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Table 1 of the paper, with the extension of the edge in use [Cui 5]: `b = 3 h cot(theta - beta) / (2 cos(alpha))`.
    fn paper(swing: Angle, layer: f64) -> TimeModel {
        let lead = Angle::deg(60.0 - 7.13);
        TimeModel {
            width: Length::mm(85.0),
            depth: Length::mm(50.0),
            area: Area::mm2(3137.0),
            clearance: Length::mm(10.0),
            extension: Length::mm(1.5 * layer / lead.tan() / swing.cos()),
            rake: Angle::deg(60.0),
            cut_feed: Speed::mm_per_s(200.0),
            travel_feed: Speed::mm_per_s(200.0),
            reorient_rate: AngularSpeed::deg_per_s(90.0),
        }
    }

    #[test]
    fn reproduces_the_paper() {
        let time = |swing: f64, layer: f64, step: f64| {
            let swing = Angle::deg(swing);
            paper(swing, layer)
                .estimate(swing, Length::mm(layer), Length::mm(step))
                .to_s()
        };
        assert!(
            (time(45.0, 3.0, 6.0) - 515.3).abs() < 0.05,
            "{}",
            time(45.0, 3.0, 6.0)
        );
        assert!(
            (time(34.16, 4.40, 5.97) - 307.6).abs() < 0.4,
            "{}",
            time(34.16, 4.40, 5.97)
        );
    }
}

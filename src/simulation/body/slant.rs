//! A plane along which the work is seen, where the cuts that leave it follow a spine.

/// A plane along x over some y, above which the work lies nowhere by more than its section: seen along that plane, the section is the
/// same at every y.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Slant {
    /// Rise over y.
    pub(super) slope: f64,
    /// Height at y = 0.
    start: f64,
}

impl Slant {
    /// Of a slope, and so high at y = 0.
    pub(super) const fn of(slope: f64, start: f64) -> Self {
        Self { slope, start }
    }

    pub(super) fn height(self, y: f64) -> f64 {
        self.start + self.slope * y
    }
}

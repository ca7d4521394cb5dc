//! Classes of places of a surface by their principal curvatures.
//!
//! [Yang 7] separates elliptic, hyperbolic, parabolic and plane points by the Gaussian curvature, and elliptic ones by the mean curvature
//! into convex and concave. Here the signs of both principal curvatures decide, which is the same, and a stated tolerance says what counts as
//! 0: of a cylinder, rounding would make a saddle here and a bowl there.

/// What the part looks like around a place, from the most raised to the most hollow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Convex in all directions: a convex elliptic point.
    Dome,
    /// Convex in one direction and straight in the other: a convex parabolic point.
    Ridge,
    /// Straight in all directions: a plane point.
    Flat,
    /// Hollow in one direction and convex in the other: a hyperbolic point.
    Saddle,
    /// Hollow in one direction and straight in the other: a concave parabolic point.
    Trough,
    /// Hollow in all directions: a concave elliptic point.
    Bowl,
}

/// Curvatures below this, in 1/mm, count as 0: a radius above 50 m, which rises by 0.025 mm over 100 mm.
pub const FLAT: f64 = 2e-5;

/// So does a principal curvature below this share of the other one.
pub const STRAIGHT: f64 = 0.01;

/// Which way a part bends in a direction.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Way {
    Convex,
    Straight,
    Hollow,
}

impl Class {
    /// All of them, in their order.
    pub const ALL: [Self; 6] = [
        Self::Dome,
        Self::Ridge,
        Self::Flat,
        Self::Saddle,
        Self::Trough,
        Self::Bowl,
    ];

    /// What it is called.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Dome => "dome",
            Self::Ridge => "ridge",
            Self::Flat => "flat",
            Self::Saddle => "saddle",
            Self::Trough => "trough",
            Self::Bowl => "bowl",
        }
    }

    /// By the greatest and the least principal curvature, in 1/mm, positive where the part is hollow, each with what it may be off.
    #[must_use]
    pub fn of(principal: [f64; 2], doubt: [f64; 2]) -> Self {
        let largest = principal[0].abs().max(principal[1].abs());
        let level = FLAT.max(STRAIGHT * largest);
        let way = |number: usize| {
            let (curvature, least) = (principal[number], level.max(doubt[number]));
            if curvature > least {
                Way::Hollow
            } else if curvature < -least {
                Way::Convex
            } else {
                Way::Straight
            }
        };
        match [way(0), way(1)] {
            [Way::Hollow, Way::Hollow] => Self::Bowl,
            [Way::Hollow, Way::Straight] | [Way::Straight, Way::Hollow] => Self::Trough,
            [Way::Hollow, Way::Convex] | [Way::Convex, Way::Hollow] => Self::Saddle,
            [Way::Straight, Way::Straight] => Self::Flat,
            [Way::Straight, Way::Convex] | [Way::Convex, Way::Straight] => Self::Ridge,
            [Way::Convex, Way::Convex] => Self::Dome,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_of_both_curvatures_make_the_class() {
        for (principal, class) in [
            ([2e-3, 1e-3], Class::Bowl),
            ([2e-3, 0.0], Class::Trough),
            ([2e-3, -1e-3], Class::Saddle),
            ([0.0, 0.0], Class::Flat),
            ([0.0, -2e-3], Class::Ridge),
            ([-1e-3, -2e-3], Class::Dome),
        ] {
            assert_eq!(Class::of(principal, [0.0; 2]), class);
        }
    }

    #[test]
    fn rounding_and_doubt_change_no_class() {
        for rounding in [-1e-12, 0.0, 1e-12, 1e-5] {
            assert_eq!(Class::of([2e-3, rounding], [0.0; 2]), Class::Trough);
            assert_eq!(Class::of([rounding, -2e-3], [0.0; 2]), Class::Ridge);
            assert_eq!(
                Class::of([rounding.abs(), -rounding.abs()], [0.0; 2]),
                Class::Flat
            );
        }
        // What matters is the ratio, then the radius of 50 m.
        assert_eq!(Class::of([2e-3, -1.9e-5], [0.0; 2]), Class::Trough);
        assert_eq!(Class::of([2e-3, -2.1e-5], [0.0; 2]), Class::Saddle);
        assert_eq!(Class::of([1e-2, -9e-5], [0.0; 2]), Class::Trough);
        assert_eq!(Class::of([2e-3, -5e-4], [0.0, 6e-4]), Class::Trough);
        assert_eq!(Class::of([2e-3, -5e-4], [3e-3, 6e-4]), Class::Flat);
    }
}

//! Rest to rest over a distance with bounded rate, acceleration and jerk: the fastest profile in closed form.
//!
//! With all three bounds it has up to seven segments: jerk up, constant acceleration, jerk down, constant rate, and the same
//! backwards to rest. Where the distance or the rate is too small some of them vanish. With `V`, `A`, `J` the bounds and `v`
//! the highest rate that is reached, gathering speed takes
//!
//! - `v / A + A / J` where `v >= A^2 / J`, so that the full acceleration is reached,
//! - `2 sqrt(v / J)` otherwise,
//!
//! and leads over `v / 2` times that, by symmetry. `v` is `V` when twice this way fits into the distance `D`; else it is what
//! makes it fit: `(A / 2) (sqrt((A / J)^2 + 4 D / A) - A / J)`, or `(D^2 J / 4)^(1/3)` where the full acceleration is not
//! reached ([Biagiotti 2008], section 3.4). Without a bound of jerk it is the trapezoid, without one of acceleration a jump.

/// Bounds along a way, in its own unit and seconds; each where there is one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Bounds {
    pub(super) rate: Option<f64>,
    pub(super) acceleration: Option<f64>,
    pub(super) jerk: Option<f64>,
}

/// How speed is gathered.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Gain {
    /// At once.
    Jump,
    /// At a constant acceleration.
    Ramp { acceleration: f64 },
    /// At a constant jerk, up to an acceleration if it has a bound.
    Smooth { acceleration: Option<f64>, jerk: f64 },
}

impl Bounds {
    /// The tighter of each.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            rate: lesser(self.rate, other.rate),
            acceleration: lesser(self.acceleration, other.acceleration),
            jerk: lesser(self.jerk, other.jerk),
        }
    }

    /// The bounds of a quantity that goes so far while another goes one unit, seen from that other. Nothing bounds what does
    /// not move.
    pub(super) fn over(self, way: f64) -> Self {
        let share = |bound: Option<f64>| bound.filter(|_| way > 0.0).map(|bound| bound / way);
        Self {
            rate: share(self.rate),
            acceleration: share(self.acceleration),
            jerk: share(self.jerk),
        }
    }

    const fn gain(self) -> Gain {
        match (self.acceleration, self.jerk) {
            (None, None) => Gain::Jump,
            (Some(acceleration), None) => Gain::Ramp { acceleration },
            (acceleration, Some(jerk)) => Gain::Smooth { acceleration, jerk },
        }
    }

    /// How long it takes, in s, to gather a rate; half of that times the rate is the way.
    pub(super) fn gathering(self, rate: f64) -> f64 {
        match self.gain() {
            Gain::Jump => 0.0,
            Gain::Ramp { acceleration } => rate / acceleration,
            Gain::Smooth { acceleration, jerk } => match acceleration {
                Some(acceleration) if rate * jerk >= acceleration * acceleration => {
                    rate / acceleration + acceleration / jerk
                }
                Some(_) | None => 2.0 * (rate / jerk).sqrt(),
            },
        }
    }

    /// How long a way takes from rest to rest, in s; none where no bound holds it.
    pub(super) fn duration(self, way: f64) -> Option<f64> {
        if way <= 0.0 {
            return Some(0.0);
        }
        if let Some(rate) = self.rate {
            let gathering = self.gathering(rate);
            let left = way - rate * gathering;
            if left >= 0.0 {
                return Some(2.0 * gathering + left / rate);
            }
        }
        let highest = self.highest(way)?;
        Some(2.0 * self.gathering(highest))
    }

    /// The rate up to which and down from which fills a way; none where speed is gathered at once.
    fn highest(self, way: f64) -> Option<f64> {
        match self.gain() {
            Gain::Jump => None,
            Gain::Ramp { acceleration } => Some((way * acceleration).sqrt()),
            Gain::Smooth { acceleration, jerk } => {
                let without = libm::cbrt(way * way * jerk / 4.0);
                Some(match acceleration {
                    Some(most) if without * jerk > most * most => {
                        let rise = most / jerk;
                        most / 2.0 * ((rise * rise + 4.0 * way / most).sqrt() - rise)
                    }
                    Some(_) | None => without,
                })
            }
        }
    }
}

fn lesser(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    match (one, other) {
        (Some(one), Some(other)) => Some(one.min(other)),
        (one, None) => one,
        (None, other) => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bounds(rate: f64, acceleration: f64, jerk: f64) -> Bounds {
        Bounds {
            rate: Some(rate),
            acceleration: Some(acceleration),
            jerk: Some(jerk),
        }
    }

    #[test]
    fn the_published_examples_come_out() {
        // [Biagiotti 2008], examples 3.9 and 3.10 with rest at both ends: h = 10, v = 5 (10), a = 10, j = 30.
        let t = |b: Bounds| b.duration(10.0).unwrap();
        // T_j = 1/3, T_a = 5/10 + 1/3, T_v = 10/5 - T_a.
        assert!((t(bounds(5.0, 10.0, 30.0)) - (10.0 / 5.0 + 5.0 / 10.0 + 1.0 / 3.0)).abs() < 1e-12);
        // The rate 10 is not reached: T_a = (a^2/j + sqrt(a^4/j^2 + 4 h a)) / (2 a).
        let square = 100.0_f64 / 30.0;
        let gathering = (square + (square * square + 4.0 * 10.0 * 10.0).sqrt()) / 20.0;
        assert!((t(bounds(10.0, 10.0, 30.0)) - 2.0 * gathering).abs() < 1e-12);
        // Trapezoid and triangle: h / v + v / a, 2 sqrt(h / a).
        let ramp = |rate| Bounds {
            jerk: None,
            ..bounds(rate, 10.0, 1.0)
        };
        assert!((t(ramp(5.0)) - 2.5).abs() < 1e-12);
        assert!((t(ramp(100.0)) - 2.0).abs() < 1e-12);
        // Jerk alone: 4 cbrt(h / (2 j)).
        let jerk = Bounds {
            jerk: Some(30.0),
            ..Bounds::default()
        };
        assert!((t(jerk) - 4.0 * libm::cbrt(10.0 / 60.0)).abs() < 1e-12);
        assert_eq!(Bounds::default().duration(10.0), None);
        assert_eq!(Bounds::default().duration(0.0), Some(0.0));
    }

    /// The same by small steps: at every moment the hardest jerk up from which it is still possible to stop in time.
    fn stepped(way: f64, b: Bounds) -> f64 {
        let (rate, most, jerk) = (b.rate.unwrap(), b.acceleration.unwrap(), b.jerk.unwrap());
        // Half of the profile is the other half backwards, so only gathering is stepped: until half of the way or the rate.
        let step = 1e-5;
        // With a given highest rate the way of gathering it, by steps; then the highest rate is sought by halving.
        let gather = |highest: f64| {
            let (mut time, mut at, mut v, mut a) = (0.0, 0.0, 0.0_f64, 0.0_f64);
            while v < highest - 1e-9 && time < 100.0 {
                // Ease off when what is left is what easing off gains.
                let easing = v + a * a / (2.0 * jerk) >= highest;
                let change = if easing { -jerk * step } else { jerk * step };
                let next = (a + change).clamp(0.0, most);
                let mean = f64::midpoint(a, next).max(1e-6);
                at += v * step + mean * step * step / 2.0;
                v += mean * step;
                a = next;
                time += step;
            }
            (time, at)
        };
        let (time, at) = gather(rate);
        if 2.0 * at <= way {
            return 2.0 * time + (way - 2.0 * at) / rate;
        }
        let (mut low, mut high) = (0.0, rate);
        for _ in 0..30 {
            let middle = f64::midpoint(low, high);
            if 2.0 * gather(middle).1 > way {
                high = middle;
            } else {
                low = middle;
            }
        }
        2.0 * gather(low).0
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn it_takes_as_long_as_by_small_steps(
            way in 0.1..20.0_f64,
            rate in 0.5..10.0_f64,
            acceleration in 1.0..30.0_f64,
            jerk in 5.0..300.0_f64,
        ) {
            let b = bounds(rate, acceleration, jerk);
            let (exact, found) = (b.duration(way).unwrap(), stepped(way, b));
            prop_assert!((exact - found).abs() < 5e-3 * exact, "{exact} {found}");
        }
    }

    proptest! {
        #[test]
        fn wider_bounds_never_take_longer(
            way in 0.0..20.0_f64,
            rate in 0.1..10.0_f64,
            acceleration in 0.1..30.0_f64,
            jerk in 0.1..300.0_f64,
            by in 1.0..10.0_f64,
        ) {
            let t = |b: Bounds| b.duration(way).unwrap();
            let base = t(bounds(rate, acceleration, jerk));
            let none = Bounds { jerk: None, ..bounds(rate, acceleration, jerk) };
            for wider in [
                bounds(rate * by, acceleration, jerk),
                bounds(rate, acceleration * by, jerk),
                bounds(rate, acceleration, jerk * by),
                none,
            ] {
                prop_assert!(t(wider) <= base + 1e-9);
            }
            // From far away it is the way over the rate.
            let far = bounds(rate, acceleration * 1e9, jerk * 1e18);
            prop_assert!((t(far) - way / rate).abs() < 1e-3 * (1.0 + way / rate));
            prop_assert!(base >= way / rate - 1e-12);
        }
    }
}

//! Orientations as the quaternions that RAPID reads.
//!
//! A controller refuses a quaternion that is not of length 1 [A-BASIC], and the two quaternions of one rotation are not the
//! same to someone who reads a program. So each is rounded to [`DECIMALS`] places in a way that keeps its length, and takes
//! the sign that is nearer to the one before it.

use vcutc_backend_api::geometry::Orientation;

/// Decimals of each part. A `num` has about seven digits; eight decimals are those that it can hold, and one
/// to spare.
const DECIMALS: usize = 8;

/// One, in units of the last place.
const ONE: i64 = 100_000_000;

/// By how much, in rad, the rounded rotation may be turned against the exact one: three parts are off by half a unit, and
/// the largest, which is at least as large as each of them, by the sum of these and half a unit of its own. The distance of
/// two quaternions is half the angle between their rotations.
pub(crate) const RESOLUTION_RAD: f64 = 5e-8;

/// A unit quaternion rounded to [`DECIMALS`] places, scalar part first, in units of the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Quaternion([i64; 4]);

impl Quaternion {
    /// Rounds an orientation. The largest part is set so that the length is 1 within its own rounding.
    pub(crate) fn rounded(orientation: Orientation) -> Self {
        let exact = orientation.quaternion();
        let mut parts = exact.map(units);
        let largest = (1..4).fold(0, |best: usize, part| {
            if exact[part].abs() > exact[best].abs() {
                part
            } else {
                best
            }
        });
        let others: i64 = (0..4)
            .filter(|part| *part != largest)
            .map(|part| parts[part] * parts[part])
            .sum();
        let left = (ONE * ONE - others).max(0);
        #[expect(clippy::cast_precision_loss, reason = "a root of 53 bits is right to a unit")]
        let length = whole((left as f64).sqrt());
        parts[largest] = if exact[largest] < 0.0 { -length } else { length };
        Self(parts)
    }

    /// Of the two quaternions of the rotation, the one nearer to another.
    pub(crate) fn nearer_to(self, other: Self) -> Self {
        let along: i64 = self.0.iter().zip(other.0).map(|(a, b)| a * b).sum();
        if along < 0 {
            Self(self.0.map(|part| -part))
        } else {
            self
        }
    }

    /// Appends `[q1,q2,q3,q4]`.
    pub(crate) fn push(self, out: &mut Vec<u8>) {
        for (start, part) in [b'[', b',', b',', b','].into_iter().zip(self.0) {
            out.push(start);
            push_part(out, part);
        }
        out.push(b']');
    }
}

/// A part, which is at most 1, in units of the last place.
fn units(part: f64) -> i64 {
    #[expect(clippy::cast_precision_loss, reason = "a power of ten below 2^53")]
    let one = ONE as f64;
    whole((part * one).clamp(-one, one))
}

/// The nearest whole number.
fn whole(value: f64) -> i64 {
    #[expect(clippy::cast_possible_truncation, reason = "of at most ten digits")]
    let whole = value.round() as i64;
    whole
}

fn push_part(out: &mut Vec<u8>, part: i64) {
    if part < 0 {
        out.push(b'-');
    }
    let magnitude = part.unsigned_abs();
    let mut digits = [b'0'; DECIMALS + 1];
    let mut rest = magnitude;
    for digit in digits.iter_mut().rev() {
        *digit = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    let [whole, decimals @ ..] = digits;
    out.push(whole);
    out.push(b'.');
    out.extend_from_slice(&decimals);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use vcutc_backend_api::geometry::Zyx;
    use vcutc_backend_api::units::Angle;

    fn text(quaternion: Quaternion) -> String {
        let mut out = Vec::new();
        quaternion.push(&mut out);
        String::from_utf8(out).unwrap()
    }

    fn parts(text: &str) -> [f64; 4] {
        let inner = text.trim_matches(['[', ']']);
        let parts: Vec<f64> = inner.split(',').map(|part| part.parse().unwrap()).collect();
        parts.try_into().unwrap()
    }

    #[test]
    fn parts_have_eight_decimals_and_no_negative_zero() {
        let identity = Quaternion::rounded(Orientation::IDENTITY);
        assert_eq!(text(identity), "[1.00000000,0.00000000,0.00000000,0.00000000]");
        let back = Quaternion(identity.0.map(|part| -part));
        assert_eq!(text(back), "[-1.00000000,0.00000000,0.00000000,0.00000000]");
        let half = Orientation::from_quaternion(0.5, -0.5, 0.5, -0.5).unwrap();
        assert_eq!(
            text(Quaternion::rounded(half)),
            "[0.50000000,-0.50000000,0.50000000,-0.50000000]"
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]

        /// What is printed, read by the standard library: of length 1, and the same rotation.
        #[test]
        fn rounded_quaternions_keep_length_and_rotation(
            (a, b, c) in (-180.0..180.0_f64, -90.0..90.0_f64, -180.0..180.0_f64),
        ) {
            let exact = Orientation::from_zyx(Zyx {
                a: Angle::deg(a),
                b: Angle::deg(b),
                c: Angle::deg(c),
            });
            let [w, x, y, z] = parts(&text(Quaternion::rounded(exact)));
            let length = (w * w + x * x + y * y + z * z).sqrt();
            prop_assert!((length - 1.0).abs() < 1.1e-8, "{}", length);
            let read = Orientation::from_quaternion(w, x, y, z).unwrap();
            prop_assert!(read.angle_to(exact).to_rad() < RESOLUTION_RAD);
        }

        #[test]
        fn signs_are_continuous(a in -180.0..180.0_f64, b in -180.0..180.0_f64) {
            let about_x = |c: f64| {
                let zero = Angle::ZERO;
                Quaternion::rounded(Orientation::from_zyx(Zyx { a: zero, b: zero, c: Angle::deg(c) }))
            };
            let (first, second) = (about_x(a), about_x(b).nearer_to(about_x(a)));
            let apart: f64 = parts(&text(first))
                .iter()
                .zip(parts(&text(second)))
                .map(|(one, other)| (one - other) * (one - other))
                .sum();
            // At most a rotation of 180 degrees apart, which is a quarter turn of the quaternion.
            prop_assert!(apart <= 2.0 + 1e-6);
        }
    }
}

//! What tracks of a disc leave over a surface, in a plane across them.
//!
//! In a plane `u.X = s` the face of a disc is a segment: with `v` the part of u in the face, at the distance `(s - u.C)/|v|` from
//! its centre, between two points of the rim. As the disc passes, these points draw a curve in the plane, which for a disc that does
//! not turn is an ellipse. What lies above the curves of all tracks is cut away. Each curve is drawn through points at even steps
//! psi of the rim, `u.C + R |v| cos(psi) = s`, each solved for the time at which it passes. The curves are hollow from above, so that
//! chords lie above them, by at most `R (steps of psi)^2/8` times the sine of the lead: below 1e-4 mm for leads to 10 degrees and
//! radii to 50 mm. Of a disc that turns on the way this is not proven, only tested; its axis counts as turning the shortest way.
//!
//! Sections say nothing about places between them.

use crate::disc::Pose;
use crate::envelope::Envelope;
use crate::section::{Section, Upright};
use crate::shadow::Uncovered;
use crate::track::Track;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::vector::{cross, dot};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::height_between;

/// Steps of psi from the front of a disc to its heel.
const STEPS: u32 = 512;

/// Halvings of a move: to the last digit.
const HALVINGS: u32 = 50;

/// Gaps of sections that count as rounding, in mm.
const ROUNDING: f64 = 1e-6;

/// What tracks leave over a section of a surface, along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Remains {
    /// The most that stands above the part.
    pub highest: Length,
    /// Where along the section.
    pub at: Length,
    /// The least; below 0 the part was entered.
    pub lowest: Length,
}

/// Coordinates along a plane, to its left, and up.
fn seen(plane: Upright, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [c, s] = plane.heading();
    [x * c + y * s, y * c - x * s, z]
}

/// The disc on its way from one pose to the next, in the coordinates of a plane.
#[derive(Clone, Copy, Debug)]
struct Way {
    centres: [[f64; 3]; 2],
    axes: [[f64; 3]; 2],
    angle: f64,
}

impl Way {
    fn new(plane: Upright, [a, b]: [Pose; 2]) -> Self {
        Self {
            centres: [a, b].map(|pose| seen(plane, pose.centre.to_array())),
            axes: [a, b].map(|pose| seen(plane, pose.axis.to_array())),
            angle: a.axis.angle_to(b.axis).to_rad(),
        }
    }

    /// Centre and axis at a share of the way.
    fn at(&self, share: f64) -> [[f64; 3]; 2] {
        let sine = libm::sin(self.angle);
        // Small turns are even along the chord.
        let [p, q] = if sine > 1e-9 {
            [1.0 - share, share].map(|share| libm::sin(self.angle * share) / sine)
        } else {
            [1.0 - share, share]
        };
        let centre =
            core::array::from_fn(|i| self.centres[0][i] + (self.centres[1][i] - self.centres[0][i]) * share);
        [
            centre,
            core::array::from_fn(|i| self.axes[0][i] * p + self.axes[1][i] * q),
        ]
    }

    /// How far to the left of the plane's foot the chord of the face lies that is so far, along the face, in front of its centre.
    fn reach(&self, share: f64, ahead: f64) -> f64 {
        let [centre, axis] = self.at(share);
        centre[1] + ahead * (1.0 - axis[1] * axis[1]).max(0.0).sqrt()
    }

    /// When that chord passes an offset.
    fn passes(&self, offset: f64, ahead: f64) -> Option<f64> {
        let before = self.reach(0.0, ahead) - offset;
        let after = self.reach(1.0, ahead) - offset;
        if (before <= 0.0) == (after <= 0.0) {
            return None;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if (self.reach(middle, ahead) - offset <= 0.0) == (before <= 0.0) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(low)
    }

    /// Both ends of that chord, along the plane and up.
    fn chord(&self, share: f64, ahead: f64, half: f64) -> Option<[Point2; 2]> {
        let [centre, axis] = self.at(share);
        let across = cross(axis, [0.0, 1.0, 0.0]);
        let length = dot(across, across).sqrt();
        if length <= 0.0 {
            return None;
        }
        let across = across.map(|part| part / length);
        // In the face, square to the chord, towards the left of the plane.
        let forwards = cross(across, axis);
        let sign = if forwards[1] < 0.0 { -ahead } else { ahead };
        let end = |half: f64| {
            let at = |i: usize| centre[i] + sign * forwards[i] + half * across[i];
            Point2::new(at(0), at(2))
        };
        Some([end(-half), end(half)])
    }
}

/// The curves that a track draws in a plane, as segments.
fn drawn(plane: Upright, offset: f64, track: &Track, radius: f64, out: &mut Vec<[Point2; 2]>) {
    for pair in track.stops.windows(2) {
        let way = Way::new(plane, [pair[0].placed.pose(), pair[1].placed.pose()]);
        let [from, to] = way.centres.map(|centre| centre[1] - offset);
        // The face stays within its radius of its centre.
        if from.min(to) > radius || from.max(to) < -radius {
            continue;
        }
        let psi = |step: u32| core::f64::consts::PI * f64::from(step) / f64::from(STEPS);
        let mut before: Option<[Point2; 2]> = None;
        let chord_at = |angle: f64| {
            let (sine, cosine) = libm::sincos(angle);
            let share = way.passes(offset, radius * cosine)?;
            way.chord(share, radius * cosine, radius * sine)
        };
        for step in 0..=STEPS {
            let chord = chord_at(psi(step));
            if let (Some(a), Some(b)) = (before, chord) {
                out.extend([[a[0], b[0]], [a[1], b[1]]]);
            }
            // All that lies between both ends is cut too.
            out.extend(chord);
            before = chord;
        }
        // Between the last step of one move and the first of the next the curve goes on, at the pose that they share.
        for end in [0.0, 1.0] {
            let [centre, axis] = way.at(end);
            let flat = (1.0 - axis[1] * axis[1]).max(0.0).sqrt();
            let ahead = (offset - centre[1]) / flat;
            if ahead.abs() > radius {
                continue;
            }
            let half = (radius * radius - ahead * ahead).max(0.0).sqrt();
            let angle = libm::atan2(half, ahead);
            let step = (angle / core::f64::consts::PI * f64::from(STEPS)) as u32;
            let Some(own) = way.chord(end, ahead, half) else {
                continue;
            };
            for near in [psi(step), psi((step + 1).min(STEPS))] {
                if let Some(other) = chord_at(near) {
                    out.extend([[own[0], other[0]], [own[1], other[1]]]);
                }
            }
            out.push(own);
        }
    }
}

/// The part of a segment between two x.
fn clipped([a, b]: [Point2; 2], from: f64, to: f64) -> Option<[Point2; 2]> {
    let (a, b) = if a.x <= b.x { (a, b) } else { (b, a) };
    let at = |x: f64| Point2::new(x, height_between(a, b, x));
    let is_over = a.x <= to && b.x >= from;
    is_over.then(|| {
        [
            if a.x < from { at(from) } else { a },
            if b.x > to { at(to) } else { b },
        ]
    })
}

/// What the face of a disc leaves over a section, of which the plane lies across the tracks.
///
/// # Errors
/// Where no track comes over the section.
pub fn remains(section: &Section, tracks: &[Track], radius: Length) -> Result<Remains, Uncovered> {
    let (from, to) = section.profile.span();
    let mut segments = Vec::new();
    for track in tracks {
        drawn(
            section.plane,
            section.plane.offset(),
            track,
            radius.to_mm(),
            &mut segments,
        );
    }
    // The lower envelope is the upper one from below.
    let flipped = segments
        .into_iter()
        .filter_map(|ends| clipped(ends, from, to))
        .map(|ends| ends.map(|point| Point2::new(point.x, -point.z)));
    let envelope = Envelope::of(flipped);
    let ranges = envelope.holes(from, to, ROUNDING);
    let lower = envelope.profile(from, to).filter(|_| ranges.is_empty());
    let Some(lower) = lower else {
        return Err(Uncovered { ranges });
    };
    // Both are linear between the points of both.
    let points = section.profile.points().iter().chain(lower.points());
    let start = Remains {
        highest: Length::mm(f64::NEG_INFINITY),
        at: Length::mm(from),
        lowest: Length::mm(f64::INFINITY),
    };
    let over = points.map(|point| point.x).filter(|x| (from..=to).contains(x));
    Ok(over.fold(start, |remains, x| {
        let height = Length::mm(-lower.height(x) - section.profile.height(x));
        Remains {
            lowest: remains.lowest.min(height),
            ..if height > remains.highest {
                Remains {
                    highest: height,
                    at: Length::mm(x),
                    ..remains
                }
            } else {
                remains
            }
        }
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disc::Disc;
    use crate::drop::Dropper;
    use crate::gouge::Moves;
    use crate::normals::Normals;
    use crate::section::across;
    use crate::surface::Surface;
    use crate::testkit::{FIXED, sampled, surface_over};
    use crate::track::{Demand, Layer};
    use vcutc_backend_api::units::Angle;

    const R: Length = Length::mm(25.0);

    fn demand(lead: f64) -> Demand {
        Demand {
            side: Angle::ZERO,
            least: Angle::deg(lead),
            most: Angle::deg(30.0),
            rate: Angle::deg(0.5),
            lift: Length::mm(0.005),
            gouge: Length::mm(0.02),
            widest: Length::mm(8.0),
            finest: Length::mm(0.1),
            beyond: Length::mm(26.0),
        }
    }

    /// Tracks at about a step, along a heading, all over a plan.
    fn tracks(surface: &Surface, heading: Angle, step: f64, demand: &Demand) -> Vec<Track> {
        let dropper = Dropper::new(surface);
        let moves = Moves::new(&dropper).unwrap();
        let (normals, disc) = (Normals::new(surface), Disc::new(R, vec![]).unwrap());
        let layer = Layer {
            moves: &moves,
            normals: &normals,
            disc: &disc,
        };
        let planes = across(surface.plan(), heading, Length::mm(step))
            .unwrap()
            .into_iter();
        let sections = planes.filter_map(|plane| surface.section_by(plane).unwrap());
        sections
            .map(|section| layer.track(&section, demand).unwrap())
            .collect()
    }

    #[test]
    fn a_plane_keeps_the_scallop_of_the_closed_form() {
        let height = |x: f64, y: f64| 5.0 + x / 8.0 - y / 10.0;
        let surface = surface_over(&sampled(60.0, 60.0, [1, 1], &height), FIXED, 60.0, 60.0);
        let tracks = tracks(&surface, Angle::deg(90.0), 10.0, &demand(5.0));
        assert_eq!(tracks.len(), 6);
        // Along the normal, with tracks so far apart along the plane, square to the feed.
        let tangent = [(1.0 + 1.0 / 64.0_f64).sqrt(), 1.0 / 10.0, 1.0 / 8.0];
        let steepness = (1.0 + tangent[1] * tangent[1] + tangent[2] * tangent[2]).sqrt();
        let step = 10.0 * steepness / (1.0 + tangent[1] * tangent[1]).sqrt();
        let expected = crate::scallop::scallop(R, Angle::deg(5.0), 0.0, Length::mm(step)).unwrap();
        for offset in [1.0, 30.0, 59.0] {
            let plane = Upright::new(Angle::ZERO, Length::mm(offset));
            let section = surface.section_by(plane).unwrap().unwrap();
            let remains = remains(&section, &tracks, R).unwrap();
            let along_normal = remains.highest.to_mm() / steepness;
            assert!(
                (along_normal - expected.to_mm()).abs() < 2e-4,
                "{remains:?} {expected:?}"
            );
            assert!(remains.lowest.to_mm().abs() < 1e-6, "{remains:?}");
        }
    }

    #[test]
    fn a_dome_is_covered_and_agrees_with_faces_at_many_times() {
        let height = |x: f64, y: f64| -((x - 40.0) * (x - 40.0) + (y - 40.0) * (y - 40.0)) / 600.0;
        let surface = surface_over(&sampled(80.0, 80.0, [40, 40], &height), FIXED, 80.0, 80.0);
        let tracks = tracks(&surface, Angle::deg(90.0), 8.0, &demand(4.0));
        for offset in [2.3, 41.0] {
            let plane = Upright::new(Angle::ZERO, Length::mm(offset));
            let section = surface.section_by(plane).unwrap().unwrap();
            let remains = remains(&section, &tracks, R).unwrap();
            assert!(
                remains.lowest.to_mm() > -0.02 && remains.highest.to_mm() < 0.2,
                "{remains:?}"
            );
            let found = remains.highest.to_mm();
            let most = (0..160)
                .map(|k| sampled_remains(&section, &tracks, f64::from(k) / 2.0))
                .fold(0.0, f64::max);
            // Tops between sampled places are missed, and times pass a place a little before or after the rim does.
            assert!(found <= most + 4e-3 && found > most - 0.02, "{found} {most}");
            let there = sampled_remains(&section, &tracks, remains.at.to_mm());
            assert!(there >= found - 1e-4 && there < found + 0.02, "{there} {found}");
        }
    }

    /// How far the lowest face over a place of a section stands above it, at many times of each move.
    fn sampled_remains(section: &Section, tracks: &[Track], s: f64) -> f64 {
        let point = section.point(s);
        let mut lowest = f64::INFINITY;
        for pair in tracks.iter().flat_map(|track| track.stops.windows(2)) {
            let ends = [pair[0].placed.pose(), pair[1].placed.pose()];
            for share in (0..40).map(|k| f64::from(k) / 40.0) {
                let between = |a: f64, b: f64| a + (b - a) * share;
                let centre: [f64; 3] = core::array::from_fn(|i| {
                    between(ends[0].centre.to_array()[i], ends[1].centre.to_array()[i])
                });
                // Axes so near to each other turn evenly along their chord.
                let axis: [f64; 3] =
                    core::array::from_fn(|i| between(ends[0].axis.to_array()[i], ends[1].axis.to_array()[i]));
                let (dx, dy) = (point.x - centre[0], point.y - centre[1]);
                let dz = -(axis[0] * dx + axis[1] * dy) / axis[2];
                if dx * dx + dy * dy + dz * dz <= 625.0 {
                    lowest = lowest.min(centre[2] + dz);
                }
            }
        }
        lowest - point.z
    }

    #[test]
    fn the_widest_step_on_a_dome_leaves_what_is_allowed_and_hardly_less() {
        let (r, limit) = (3000.0, 0.1);
        let step = crate::scallop::widest_step(R, Angle::deg(5.0), -1.0 / r, Length::mm(limit)).unwrap();
        // Steps count in whole micrometres.
        let size = 6.0 * step.to_mm() - 0.01;
        let height = |x: f64, y: f64| {
            let (x, y) = (x - size / 2.0, y - size / 2.0);
            libm::sqrt(r * r - x * x - y * y) - r
        };
        let surface = surface_over(&sampled(size, size, [60, 60], &height), FIXED, size, size);
        let tracks = tracks(&surface, Angle::deg(90.0), step.to_mm(), &demand(5.0));
        assert_eq!(tracks.len(), 6);
        for offset in [0.6 * size, 0.97 * size] {
            let section = surface
                .section_by(Upright::new(Angle::ZERO, Length::mm(offset)))
                .unwrap()
                .unwrap();
            let remains = remains(&section, &tracks, R).unwrap();
            let found = remains.highest.to_mm();
            assert!(found < limit + 0.005 && found > limit - 0.005, "{remains:?}");
            assert!(remains.lowest.to_mm() > -0.02, "{remains:?}");
        }
    }

    #[test]
    fn what_no_track_comes_over_is_an_error() {
        let surface = surface_over(&sampled(60.0, 60.0, [1, 1], &|_, _| 0.0), FIXED, 60.0, 60.0);
        let section = surface
            .section_by(Upright::new(Angle::ZERO, Length::mm(30.0)))
            .unwrap()
            .unwrap();
        assert_eq!(remains(&section, &[], R).unwrap_err().ranges, [[0.0, 60.0]]);
    }
}

//! The blades of a program: their shapes, their bodies, and what spins them.

use super::Cell;
use crate::geometry::Orientation;
use crate::units::{Angle, AngularSpeed, Length};
use core::f64::consts::FRAC_PI_2;
use serde::{Deserialize, Serialize};

/// A blade.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Blade {
    /// Its name in the job.
    pub name: String,
    /// What it is.
    pub shape: Shape,
    /// The body above the edge, where the job states it: round stages about the tool axis, from the edge up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<Vec<BodyStage>>,
}

/// What a blade is. The origin of its frame T is its tip: of a straight blade the point where the edges meet, of the others the
/// centre of the circle of their edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// Its edges meet in the tip; it vibrates along its axis.
    Straight(Straight),
    /// A thin circular knife, which vibrates and spins.
    Disc(Disc),
    /// A body that shreds what the edge at its lower rim parts; it spins.
    Crusher(Crusher),
}

/// A straight blade.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Straight {
    /// Usable edge length from the tip; positive.
    pub cutting_length: Length,
    /// Half the apex angle, between edge and tool axis; at least 0 and below 90 degrees.
    pub half_apex: Angle,
    /// Thickness square to the blade plane; zero or more.
    pub thickness: Length,
    /// Which sides cut.
    pub edges: Edges,
}

/// A thin circular knife.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Disc {
    /// Radius of the edge; positive.
    pub radius: Length,
    /// Thickness along the axis; positive.
    pub thickness: Length,
    /// How fast it turns about its axis; positive.
    pub spin: AngularSpeed,
}

/// A body that shreds what the edge at its lower rim parts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Crusher {
    /// Radius of the edge; positive.
    pub radius: Length,
    /// How far up from the edge it shreds; positive.
    pub height: Length,
    /// How fast it turns about its axis; positive.
    pub spin: AngularSpeed,
    /// The steepest way down into the material; above 0 and below 90 degrees.
    pub ramp: Angle,
}

/// A round part of a blade's body about the tool axis. It continues up to the next one, the last one without end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BodyStage {
    /// Height above the tip at which it begins, along the tool axis.
    pub from: Length,
    /// Its radius.
    pub radius: Length,
}

/// Which sides of a blade cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Edges {
    /// Only the side towards `+x_t`: the blade must be turned half round to cut the other way.
    Single,
    /// Both sides.
    Double,
}

/// What spins a blade.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Spindle {
    /// The control's own spindle, which the program gives the speed of the blade.
    Own,
    /// A drive that this digital output runs, at a speed of its own.
    Output(u32),
}

impl Spindle {
    /// The output that runs it; none of the control's own.
    #[must_use]
    pub const fn output(self) -> Option<u32> {
        match self {
            Self::Own => None,
            Self::Output(output) => Some(output),
        }
    }
}

impl Cell {
    /// The digital outputs that programs switch: of generator and spindle.
    pub fn outputs(&self) -> impl Iterator<Item = u32> {
        let spindle = self.spindle.and_then(Spindle::output);
        self.ultrasonic.into_iter().chain(spindle)
    }
}

/// Corners of the polygon that stands for a circle where only a bound is needed.
const CORNERS: u32 = 64;

impl Blade {
    /// The straight blade that it is; none where it is another one.
    #[must_use]
    pub const fn straight(&self) -> Option<Straight> {
        match self.shape {
            Shape::Straight(straight) => Some(straight),
            Shape::Disc(_) | Shape::Crusher(_) => None,
        }
    }

    /// The same, to be changed.
    #[must_use]
    pub const fn straight_mut(&mut self) -> Option<&mut Straight> {
        match &mut self.shape {
            Shape::Straight(straight) => Some(straight),
            Shape::Disc(_) | Shape::Crusher(_) => None,
        }
    }

    /// Whether it cuts by vibrating.
    #[must_use]
    pub const fn vibrates(&self) -> bool {
        match self.shape {
            Shape::Straight(_) | Shape::Disc(_) => true,
            Shape::Crusher(_) => false,
        }
    }

    /// How fast it turns about its axis; none where it does not.
    #[must_use]
    pub const fn spin(&self) -> Option<AngularSpeed> {
        match self.shape {
            Shape::Straight(_) => None,
            Shape::Disc(Disc { spin, .. }) | Shape::Crusher(Crusher { spin, .. }) => Some(spin),
        }
    }

    /// Points of T, in mm, between which the middle plane of a straight blade lies, and all of another one up to where its body
    /// begins. Those of a circle lie outside of it by 0.2 % of its radius at most.
    #[must_use]
    pub fn hull(&self) -> Vec<[f64; 3]> {
        match self.shape {
            Shape::Straight(straight) => {
                let [right, left] = straight.edge_ends();
                vec![[0.0; 3], left, right]
            }
            Shape::Disc(disc) => ring(disc.radius, [Length::ZERO, disc.thickness]),
            Shape::Crusher(crusher) => ring(crusher.radius, [Length::ZERO, crusher.height]),
        }
    }

    /// The stages of its body, the last one up to a height above the tip.
    #[must_use]
    pub fn stages(&self, top: Length) -> Vec<Stage> {
        Stage::all(self.body.as_deref().unwrap_or_default(), top)
    }

    /// How far it reaches from its tip while it turns from one orientation to another about one axis. Of a straight blade its edges
    /// count, as they lie at both ends of the turn.
    #[must_use]
    pub fn extent(&self, held: [Orientation; 2]) -> Extent {
        match self.shape {
            Shape::Straight(straight) => straight.extent(held[0]).and(straight.extent(held[1])),
            Shape::Disc(disc) => round(disc.radius, disc.thickness, held),
            Shape::Crusher(crusher) => round(crusher.radius, crusher.height, held),
        }
    }
}

/// A stage of a body with both its ends: a cylinder about the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// From and to what height above the tip.
    pub heights: [Length; 2],
    /// Its radius.
    pub radius: Length,
}

impl Stage {
    /// The stages of a body, each up to where the next one begins, and the last one up to a height above the tip. If it begins there
    /// or higher, it is left out.
    #[must_use]
    pub fn all(body: &[BodyStage], top: Length) -> Vec<Self> {
        let ends = body.iter().skip(1).map(|next| next.from).chain([top]);
        let stages = body.iter().zip(ends).map(|(stage, to)| Self {
            heights: [stage.from, to],
            radius: stage.radius,
        });
        stages
            .filter(|stage| stage.heights[0] < stage.heights[1])
            .collect()
    }
}

/// How far a blade reaches from its tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The smallest and the largest coordinate along +x, in mm; none of a straight blade, which leans to either side as it cuts.
    pub x: Option<[f64; 2]>,
    /// The smallest and the largest coordinate along +y, in mm.
    pub y: [f64; 2],
    /// How far down, in mm; zero or more.
    pub down: f64,
}

impl Extent {
    /// Of the tip alone.
    pub const TIP: Self = Self {
        x: None,
        y: [0.0, 0.0],
        down: 0.0,
    };

    /// As far as one of two.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let both = |one: [f64; 2], other: [f64; 2]| [one[0].min(other[0]), one[1].max(other[1])];
        Self {
            x: self.x.zip(other.x).map(|(one, other)| both(one, other)),
            y: both(self.y, other.y),
            down: self.down.max(other.down),
        }
    }
}

impl Straight {
    /// The ends of its two edges seen in T, in mm, that towards `+x_t` first.
    #[must_use]
    pub fn edge_ends(&self) -> [[f64; 3]; 2] {
        let (sine, cosine) = libm::sincos(self.half_apex.to_rad());
        let length = self.cutting_length.to_mm();
        [1.0, -1.0].map(|side| [side * sine * length, 0.0, -cosine * length])
    }

    /// The smallest and the largest coordinate along +x from its tip, in mm, of all between its edges that lies no higher than so
    /// much above its tip, in mm; of all of it where one of its edges ends below that.
    #[must_use]
    pub fn across(&self, held: Orientation, most: f64) -> [f64; 2] {
        let matrix = held.matrix();
        let half = self.thickness.to_mm() / 2.0;
        let [along, aside, down] = matrix[0];
        let aside = aside.abs() * half;
        let ends = self.edge_ends();
        let heights = ends.map(|[ahead, _, up]| matrix[2][0] * ahead + matrix[2][2] * up);
        // A side of the blade may be lower than its middle plane.
        let most = most.max(0.0) + matrix[2][1].abs() * half;
        let share = heights.map(|height| if height > most { most / height } else { 1.0 });
        let is_cut_off = heights.into_iter().all(|height| height > most);
        let [one, other] = [0, 1].map(|edge| {
            let [ahead, _, up] = ends[edge];
            (along * ahead + down * up) * if is_cut_off { share[edge] } else { 1.0 }
        });
        [one.min(other).min(0.0) - aside, one.max(other).max(0.0) + aside]
    }

    /// The tool axis makes an angle with +y; both edges lie half the apex angle off it, in the blade's plane.
    fn extent(&self, held: Orientation) -> Extent {
        let axis = libm::acos((-held.matrix()[1][2]).clamp(-1.0, 1.0));
        let half_apex = self.half_apex.to_rad();
        let [one, other] =
            [axis - half_apex, axis + half_apex].map(|angle| self.cutting_length.to_mm() * libm::cos(angle));
        Extent {
            x: None,
            y: [one.min(other), one.max(other)],
            down: 0.0,
        }
    }
}

/// The corners of two polygons about circles of the same radius, at these heights above the edge.
fn ring(radius: Length, heights: [Length; 2]) -> Vec<[f64; 3]> {
    let step = core::f64::consts::TAU / f64::from(CORNERS);
    let outside = radius.to_mm() / libm::cos(step / 2.0);
    let corner = |(height, number): (Length, u32)| {
        let (sine, cosine) = libm::sincos(f64::from(number) * step);
        [outside * cosine, outside * sine, -height.to_mm()]
    };
    let numbers = |height| (0..CORNERS).map(move |number| (height, number));
    heights.into_iter().flat_map(numbers).map(corner).collect()
}

/// How far a cylinder above its edge reaches while it turns. Its axis is off x, y and z by no less than at one of both ends, but
/// for half of the turn.
fn round(radius: Length, height: Length, held: [Orientation; 2]) -> Extent {
    let half_turn = held[0].angle_to(held[1]).to_rad() / 2.0;
    let (radius, height) = (radius.to_mm(), height.to_mm());
    let [one, other] = held.map(|held| held.matrix());
    // How steeply the axis rises from the tip along y, and from the horizontal: -90 to 90 degrees, in rad.
    let rise = |row: usize| [one, other].map(|m| libm::asin((-m[row][2]).clamp(-1.0, 1.0)));
    let [along_x, along_y, upwards] = [rise(0), rise(1), rise(2)].map(|[one, other]| Rise {
        low: (one.min(other) - half_turn).max(-FRAC_PI_2),
        high: (one.max(other) + half_turn).min(FRAC_PI_2),
    });
    let reach = |along: Rise| {
        let across = radius * along.most_across();
        [
            (height * libm::sin(along.low)).min(0.0) - across,
            (height * libm::sin(along.high)).max(0.0) + across,
        ]
    };
    Extent {
        x: Some(reach(along_x)),
        y: reach(along_y),
        down: (-height * libm::sin(upwards.low)).max(0.0) + radius * upwards.most_across(),
    }
}

/// From where to where an axis rises over a plane, in rad.
#[derive(Clone, Copy)]
struct Rise {
    low: f64,
    high: f64,
}

impl Rise {
    /// How much of a circle about the axis reaches along the normal of the plane at most, by its radius.
    fn most_across(self) -> f64 {
        libm::cos(if self.low <= 0.0 && self.high >= 0.0 {
            0.0
        } else {
            self.low.abs().min(self.high.abs())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc() -> Blade {
        Blade {
            name: "wheel".to_owned(),
            shape: Shape::Disc(Disc {
                radius: Length::mm(25.0),
                thickness: Length::mm(1.5),
                spin: AngularSpeed::rad_per_s(300.0),
            }),
            body: None,
        }
    }

    /// The end of a stage is where the next one begins, wherever the flange is; only the last one has none of its own.
    #[test]
    fn the_last_stage_ends_where_it_is_cut_off() {
        let body = [(10.0, 4.0), (50.0, 9.0)].map(|(from, radius)| BodyStage {
            from: Length::mm(from),
            radius: Length::mm(radius),
        });
        let ends = |top: f64| -> Vec<[f64; 2]> {
            let stages = Stage::all(&body, Length::mm(top));
            stages
                .iter()
                .map(|stage| stage.heights.map(Length::to_mm))
                .collect()
        };
        assert_eq!(ends(200.0), [[10.0, 50.0], [50.0, 200.0]]);
        assert_eq!(ends(30.0), [[10.0, 50.0]]);
    }

    /// A disc that leads by 3 degrees along +y: out of the edge is down, and back by the lead.
    fn leading(lead: f64) -> Orientation {
        let (sine, cosine) = libm::sincos((180.0 - lead).to_radians() / 2.0);
        Orientation::from_quaternion(cosine, sine, 0.0, 0.0).unwrap()
    }

    #[test]
    fn a_disc_reaches_as_far_as_its_circle() {
        let extent = disc().extent([leading(3.0); 2]);
        // Of a radius of 25 mm, 25 cos 3 deg and 25 sin 3 deg.
        assert!((extent.y[0] + 24.9657).abs() < 1e-4, "{extent:?}");
        assert!((extent.down - 1.3084).abs() < 1e-4, "{extent:?}");
    }

    /// The rim of a turning disc, sampled.
    #[test]
    fn a_disc_that_turns_stays_within_its_extent() {
        for (from, to) in [(3.0, -3.0), (1.0, 8.0), (60.0, 20.0), (-30.0, -89.0)] {
            let held = [leading(from), leading(to)];
            let extent = disc().extent(held);
            for step in 0..=20_u32 {
                let m = held[0].towards(held[1], f64::from(step) / 20.0).matrix();
                for corner in 0..90_u32 {
                    let (sine, cosine) = libm::sincos(f64::from(corner * 4).to_radians());
                    for up in [0.0, 1.5] {
                        let at = |row: usize| 25.0 * (m[row][0] * cosine + m[row][1] * sine) - up * m[row][2];
                        assert!(at(1) >= extent.y[0] - 1e-9 && at(1) <= extent.y[1] + 1e-9);
                        let [low, high] = extent.x.unwrap();
                        assert!(at(0) >= low - 1e-9 && at(0) <= high + 1e-9);
                        assert!(-at(2) <= extent.down + 1e-9);
                    }
                }
            }
        }
    }

    #[test]
    fn the_hull_holds_the_circle_and_little_more() {
        for [x, y, _] in disc().hull() {
            let radius = libm::hypot(x, y);
            assert!((25.0..25.05).contains(&radius), "{radius}");
        }
    }
}

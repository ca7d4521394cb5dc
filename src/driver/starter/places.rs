//! Where the work of a first job may stand, and how the blade may be mounted.

use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::{AxisKind, MachineKind};
use vcutc_backend_api::units::Angle;
use vcutc_machine::Model;
use vcutc_machine::kinematics::Joints;
use vcutc_machine::kinematics::pose::Pose;

/// How the blade is mounted, and the rake at which it cuts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tool {
    /// From the flange to the tip, in mm.
    pub(super) length: f64,
    /// Turn about the shank, in degrees.
    pub(super) turn: i32,
    /// Angle between tool axis and feed, in degrees.
    pub(super) rake: u32,
    /// The block, in mm: across the cuts, along them, up.
    pub(super) block: [u32; 3],
}

impl Tool {
    /// The blade seen from the flange.
    pub(super) fn frame(self) -> Frame {
        Frame {
            origin: Point3::new(0.0, 0.0, self.length),
            orientation: about_z(self.turn),
        }
    }

    /// Whether the blade does not lean along the cut.
    pub(super) const fn is_upright(self) -> bool {
        self.rake == UPRIGHT
    }

    /// The blade leaning along the cut; none where it does.
    pub(super) const fn leaning(self) -> Option<Self> {
        match self.is_upright() {
            true => Some(Self { rake: RAKE, ..self }),
            false => None,
        }
    }
}

/// A place of the work, in mm and whole degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    x: f64,
    y: f64,
    z: f64,
    turn: i32,
}

impl Place {
    /// The machine's root.
    pub(super) const ROOT: Self = Self {
        x: 0.0,
        y: 0.0,
        z: 0.0,
        turn: 0,
    };

    /// The place that has the middle of the block's bottom there, to ten millimetres.
    fn with_middle([x, y, z]: [f64; 3], turn: i32, block: [u32; 3]) -> Self {
        let tens = |value: f64| (value / 10.0).round() * 10.0;
        let (sin, cos) = libm::sincos(f64::from(turn).to_radians());
        let (across, along) = (f64::from(block[0]) / 2.0, f64::from(block[1]) / 2.0);
        Self {
            x: tens(x - cos * across + sin * along),
            y: tens(y - sin * across - cos * along),
            z: tens(z),
            turn,
        }
    }
}

impl From<Place> for Frame {
    fn from(place: Place) -> Self {
        Self {
            origin: Point3::new(place.x, place.y, place.z),
            orientation: about_z(place.turn),
        }
    }
}

fn about_z(degrees: i32) -> Orientation {
    Orientation::from_zyx(Zyx {
        a: Angle::deg(f64::from(degrees)),
        b: Angle::ZERO,
        c: Angle::ZERO,
    })
}

/// Size of the block, in mm: across the cuts, along them, up.
pub(super) const BLOCK: [u32; 3] = [200, 150, 45];
/// A block for the smallest arms.
const SMALL_BLOCK: [u32; 3] = [100, 80, 45];
/// Arms that reach less far than this carry a short blade, in mm.
const SMALL_ARM: f64 = 1300.0;
/// The rake of the examples.
const RAKE: u32 = 60;
/// A blade that does not lean along the cut. Heads in which C carries A or B hold it without an orientable spindle.
const UPRIGHT: u32 = 90;

/// Ways to mount the blade, the usual one first.
pub(super) fn tools(model: &Model) -> Vec<Tool> {
    let tool = |length, turn, rake| Tool {
        length,
        turn,
        rake,
        block: BLOCK,
    };
    match model.kind() {
        MachineKind::Robot if model.reach() < SMALL_ARM => {
            let short = tool(120.0, 0, RAKE);
            vec![
                short,
                Tool {
                    block: SMALL_BLOCK,
                    ..short
                },
            ]
        }
        MachineKind::Robot => vec![tool(310.0, 0, RAKE)],
        // A leading side that points along Y of an upright head stands in the middle of its postures.
        MachineKind::FiveAxis => vec![
            tool(160.0, -90, RAKE),
            tool(160.0, -90, UPRIGHT),
            tool(160.0, 0, UPRIGHT),
        ],
    }
}

/// Places in front of a robot, or over the mount of a five-axis machine.
pub(super) fn around(model: &Model, block: [u32; 3]) -> Vec<Place> {
    match model.kind() {
        MachineKind::Robot => before_the_arm(model, block),
        MachineKind::FiveAxis => over_the_mount(model, block),
    }
}

/// Distances of the block's middle from the first axis, as shares of the reach.
const AWAY: [f64; 6] = [0.35, 0.42, 0.5, 0.58, 0.66, 0.74];
/// Heights of the block's bottom over the foot, as shares of the reach.
const HEIGHTS: [f64; 6] = [-0.1, 0.0, 0.1, 0.2, 0.3, 0.4];
/// Turns of the work about z, in degrees: first those with cuts along x and y of the root.
const TURNS: [i32; 8] = [90, 0, -90, 180, 45, -45, 135, -135];

fn before_the_arm(model: &Model, block: [u32; 3]) -> Vec<Place> {
    let reach = model.reach();
    let mut places = Vec::with_capacity(AWAY.len() * HEIGHTS.len() * TURNS.len());
    for turn in TURNS {
        for height in HEIGHTS {
            places.extend(
                AWAY.map(|away| Place::with_middle([away * reach, 0.0, height * reach], turn, block)),
            );
        }
    }
    places
}

/// Heights of the block's bottom over the mount, in mm.
const OVER_THE_MOUNT: [f64; 7] = [100.0, 0.0, 50.0, 200.0, 300.0, 400.0, 500.0];

/// Turns of the work, in degrees: machines of this kind have their axes along the work.
const QUARTERS: [i32; 4] = [0, 90, -90, 180];

fn over_the_mount(model: &Model, block: [u32; 3]) -> Vec<Place> {
    let mut middle = Joints::default();
    for (joint, axis) in middle.iter_mut().zip(&model.axes) {
        *joint = match axis.kind {
            AxisKind::Linear => (axis.min + axis.max) / 2.0,
            AxisKind::Rotary => 0.0,
        };
    }
    let nose: Pose = model.mechanism.flange_in_root(&middle);
    let nose = Frame::from(nose).origin;
    let mut places = Vec::with_capacity(OVER_THE_MOUNT.len() * QUARTERS.len());
    for turn in QUARTERS {
        places.extend(OVER_THE_MOUNT.map(|z| Place::with_middle([nose.x, nose.y, z], turn, block)));
    }
    places
}

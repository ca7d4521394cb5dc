//! Programs made from a few numbers.

use super::pretend;
use super::pretend_five_axis::five_axes;
use crate::geometry::{Frame, Orientation, Point3, Zyx};
use crate::ir::{
    Action, AxisValues, Blade, Cell, Edges, FeedId, Flank, IR_VERSION, Load, MachineKind, Maker, Op,
    Operation, OperationId, OperationKind, OrientationId, PlacedFrame, Program, Purpose, RateId, Ready,
    Registered, Shape, Site, SourceRef, Stock, Straight, Switch, Tool, ToolId, Tools,
};
use crate::units::{Angle, AngularSpeed, Duration, Length, Mass, Speed};
use core::num::NonZeroU32;

/// The kind of the operations of recipes.
const ROUGH_VCUT: OperationKind = OperationKind::named("rough_vcut").unwrap();

/// In which order the flanks of a layer are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passes {
    /// Both flanks of a V one after the other, turning behind the stock.
    Point,
    /// All left flanks of a layer, then all right ones.
    Layer,
}

/// How the blade gets from one operation to the next, above the stock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// On a straight line.
    Straight,
    /// By a move of all axes, which may change the branch.
    ByAxes,
}

/// A program in a few numbers. All positive values up to the named limits give a program without faults.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe {
    /// The job's name.
    pub name: String,
    /// How many operations, each with all layers.
    pub operations: u16,
    /// Layers of each operation; none gives a program that goes home and no further.
    pub layers: u32,
    /// V-cuts of each layer.
    pub cuts: u32,
    /// Order of the flanks. A blade with a single edge cuts every flank towards +y and returns through the air.
    pub passes: Passes,
    /// Edges of the blade.
    pub edges: Edges,
    /// Swing of the V, up to 60 degrees.
    pub swing: Angle,
    /// Rake of the blade, 45 to 90 degrees.
    pub rake: Angle,
    /// Distance between cuts.
    pub step: Length,
    /// Distance between layers.
    pub layer: Length,
    /// Distance kept from the stock.
    pub clearance: Length,
    /// Size of the stock.
    pub stock: Stock,
    /// Tip speed while cutting.
    pub cut_feed: Speed,
    /// Tip speed in the air.
    pub travel_feed: Speed,
    /// Rate of reorientation.
    pub rate: AngularSpeed,
    /// The way from one operation to the next.
    pub crossing: Crossing,
    /// A wait before each operation.
    pub dwell: Option<Duration>,
    /// The machine.
    pub cell: CellRecipe,
}

/// The machine of a [`Recipe`].
#[derive(Clone, Debug, PartialEq)]
pub struct CellRecipe {
    /// Which of the pretend machines.
    pub kind: MachineKind,
    /// Who made the controller.
    pub maker: Maker,
    /// Blade frame seen from the flange.
    pub tool: PlacedFrame,
    /// Workpiece frame seen from the world.
    pub base: PlacedFrame,
    /// What the flange carries.
    pub load: Option<Registered<Load>>,
    /// Home angles.
    pub home: AxisValues,
    /// Output of the generator.
    pub ultrasonic: Option<u32>,
    /// How its readiness is known.
    pub ready: Ready,
}

impl Default for CellRecipe {
    fn default() -> Self {
        let frame = |x, y, z, c| Frame {
            origin: Point3::new(x, y, z),
            orientation: Orientation::from_zyx(Zyx {
                a: Angle::ZERO,
                b: Angle::ZERO,
                c: Angle::deg(c),
            }),
        };
        Self {
            kind: MachineKind::Robot,
            maker: Maker::Kuka,
            tool: PlacedFrame {
                frame: frame(0.0, 0.0, 310.0, 0.0),
                number: None,
            },
            base: PlacedFrame {
                frame: frame(1800.0, -25.0, 700.0, 90.0),
                number: None,
            },
            load: Some(Registered::Value(Load {
                mass: Mass::kg(12.5),
                centre: Point3::new(0.0, 0.0, 140.0),
                inertia: None,
            })),
            home: AxisValues([0.0, -90.0, 90.0, 0.0, 45.0, 0.0].map(f64::to_radians)),
            ultrasonic: Some(12),
            ready: Ready::After(Duration::s(0.5)),
        }
    }
}

impl CellRecipe {
    /// The pretend five-axis machine, on whose table the work lies a little askew.
    #[must_use]
    pub fn five_axis() -> Self {
        Self {
            kind: MachineKind::FiveAxis,
            maker: Maker::Other,
            base: PlacedFrame {
                frame: Frame {
                    origin: Point3::new(-120.0, 80.0, 45.5),
                    orientation: Orientation::from_zyx(Zyx {
                        a: Angle::deg(3.0),
                        b: Angle::ZERO,
                        c: Angle::ZERO,
                    }),
                },
                number: None,
            },
            load: None,
            home: AxisValues([0.0, 0.0, 900.0, 0.0, 0.0, 0.0]),
            ..Self::default()
        }
    }
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            name: "sample".to_owned(),
            operations: 1,
            layers: 2,
            cuts: 3,
            passes: Passes::Point,
            edges: Edges::Double,
            swing: Angle::deg(34.16),
            rake: Angle::deg(60.0),
            step: Length::mm(5.97),
            layer: Length::mm(4.4),
            clearance: Length::mm(10.0),
            stock: Stock {
                width: Length::mm(85.0),
                depth: Length::mm(50.0),
                height: Length::mm(50.0),
            },
            cut_feed: Speed::mm_per_s(200.0),
            travel_feed: Speed::mm_per_s(500.0),
            rate: AngularSpeed::deg_per_s(90.0),
            crossing: Crossing::Straight,
            dwell: None,
            cell: CellRecipe::default(),
        }
    }
}

/// Entries of the program's tables.
const CUT_FEED: FeedId = FeedId(0);
const TRAVEL_FEED: FeedId = FeedId(1);
const RATE: RateId = RateId(0);
const LEFT_FORWARD: OrientationId = OrientationId(0);
const RIGHT_BACKWARD: OrientationId = OrientationId(1);
const RIGHT_FORWARD: OrientationId = OrientationId(2);

/// Usable edge and half apex angle of the blade [Cui II.A].
const EDGE: Length = Length::mm(10.0);
const HALF_APEX: Angle = Angle::deg(7.13);

impl Recipe {
    /// The program, not yet verified.
    #[must_use]
    pub fn program(&self) -> Program {
        let mut writer = Writer {
            recipe: self,
            ops: Vec::new(),
        };
        writer.program();
        Program {
            version: IR_VERSION,
            name: self.name.clone(),
            purpose: Purpose::Work,
            head: None,
            stock: self.stock,
            cell: Some(self.cell()),
            blades: vec![self.blade()],
            operations: vec![Self::operation(); usize::from(self.operations)],
            orientations: vec![
                posture(-self.swing, self.rake, 1.0),
                posture(self.swing, self.rake, -1.0),
                posture(self.swing, self.rake, 1.0),
            ],
            feeds: vec![self.cut_feed, self.travel_feed],
            rates: vec![self.rate],
            vias: Vec::new(),
            blend: Length::ZERO,
            ops: writer.ops,
        }
    }

    fn cell(&self) -> Cell {
        let CellRecipe {
            kind,
            maker,
            tool,
            base,
            load,
            home,
            ultrasonic,
            ready,
        } = self.cell;
        Cell {
            name: "cell".to_owned(),
            kind,
            maker,
            model: "pretend".to_owned(),
            axes: match kind {
                MachineKind::Robot => pretend::axes(),
                MachineKind::FiveAxis => five_axes(),
            },
            tools: Tools::one(Tool {
                frame: tool,
                load,
                place: None,
            }),
            base,
            home: Some(home),
            change: None,
            ultrasonic,
            spindle: None,
            ready,
        }
    }

    fn blade(&self) -> Blade {
        Blade {
            name: "dagger".to_owned(),
            shape: Shape::Straight(Straight {
                cutting_length: EDGE,
                half_apex: HALF_APEX,
                thickness: Length::mm(1.5),
                edges: self.edges,
            }),
            body: None,
        }
    }

    fn operation() -> Operation {
        Operation {
            kind: ROUGH_VCUT,
            tools: vec![ToolId::FIRST],
            source: SourceRef {
                file: "sample.vcut".to_owned(),
                start: 0,
                end: 0,
            },
            compensation: None,
            openings: Vec::new(),
        }
    }

    /// Where the tip turns: far enough that the edge clears the stock [Cui 5].
    fn extension(&self) -> f64 {
        let overhang = EDGE.to_mm() * libm::cos((self.rake - HALF_APEX).to_rad().max(0.0));
        overhang + self.clearance.to_mm()
    }

    fn front(&self) -> f64 {
        -self.extension()
    }

    fn back(&self) -> f64 {
        self.stock.depth.to_mm() + self.extension()
    }

    fn safe_height(&self) -> f64 {
        self.stock.height.to_mm() + self.clearance.to_mm()
    }
}

struct Writer<'r> {
    recipe: &'r Recipe,
    ops: Vec<Op>,
}

/// One V-cut to be.
#[derive(Clone, Copy)]
struct Place {
    site: Site,
    x: f64,
    z: f64,
}

impl Writer<'_> {
    fn push(&mut self, site: Site, action: Action) {
        self.ops.push(Op { site, action });
    }

    fn program(&mut self) {
        self.push(Site::Program, Action::Home);
        if self.recipe.layers == 0 || self.recipe.cuts == 0 {
            return;
        }
        for operation in (0..self.recipe.operations).map(OperationId) {
            self.operation(operation);
        }
        if self.recipe.operations > 0 {
            self.push(Site::Program, Action::Home);
        }
    }

    fn operation(&mut self, operation: OperationId) {
        let site = Site::Operation(operation);
        if let Some(time) = self.recipe.dwell {
            self.push(site, Action::Dwell { time });
        }
        self.arrive(site, operation);
        self.generator(site, Switch::On);
        for layer in (1..=self.recipe.layers).filter_map(NonZeroU32::new) {
            self.layer(operation, layer);
        }
        self.generator(site, Switch::Off);
    }

    /// From home, or from where the operation before this one ended.
    fn arrive(&mut self, site: Site, operation: OperationId) {
        let front = self.recipe.front();
        match (operation, self.recipe.crossing) {
            (OperationId(0), _) | (_, Crossing::ByAxes) => self.push(
                site,
                Action::AxisTravel {
                    to: Point3::new(0.0, front, self.recipe.safe_height()),
                    orientation: LEFT_FORWARD,
                },
            ),
            (_, Crossing::Straight) => self.travel(site, 0.0, front, LEFT_FORWARD),
        }
    }

    fn generator(&mut self, site: Site, state: Switch) {
        if self.recipe.cell.ultrasonic.is_none() {
            return;
        }
        self.push(site, Action::Ultrasonic { state });
        match state {
            Switch::On => self.push(site, Action::AwaitReady),
            Switch::Off => {}
        }
    }

    fn layer(&mut self, operation: OperationId, layer: NonZeroU32) {
        let z = self.recipe.stock.height.to_mm() - f64::from(layer.get()) * self.recipe.layer.to_mm();
        let places: Vec<Place> = (1..=self.recipe.cuts)
            .filter_map(NonZeroU32::new)
            .map(|cut| Place {
                site: Site::Cut {
                    operation,
                    layer,
                    cut,
                },
                x: (f64::from(cut.get()) - 0.5) * self.recipe.step.to_mm(),
                z,
            })
            .collect();
        match (self.recipe.passes, self.recipe.edges) {
            (Passes::Point, Edges::Double) => {
                for place in places {
                    self.there_and_back(place);
                }
            }
            (Passes::Point, Edges::Single) => {
                for place in places {
                    self.forward(place, Flank::Left, LEFT_FORWARD);
                    self.forward(place, Flank::Right, RIGHT_FORWARD);
                }
            }
            (Passes::Layer, Edges::Double | Edges::Single) => {
                for &place in &places {
                    self.forward(place, Flank::Left, LEFT_FORWARD);
                }
                for place in places {
                    self.forward(place, Flank::Right, RIGHT_FORWARD);
                }
            }
        }
    }

    /// Left flank forward, turn, right flank backward [Cui fig. 3].
    fn there_and_back(&mut self, place: Place) {
        let (front, back) = (self.recipe.front(), self.recipe.back());
        self.enter(place, LEFT_FORWARD);
        self.cut(place, Flank::Left, back);
        self.push(
            place.site,
            Action::Turn {
                to: RIGHT_BACKWARD,
                rate: RATE,
            },
        );
        self.cut(place, Flank::Right, front);
        self.leave(place, front);
    }

    /// One flank forward; the way back is through the air.
    fn forward(&mut self, place: Place, flank: Flank, held: OrientationId) {
        self.enter(place, held);
        self.cut(place, flank, self.recipe.back());
        self.leave(place, self.recipe.back());
    }

    fn enter(&mut self, place: Place, held: OrientationId) {
        let front = self.recipe.front();
        self.travel(place.site, place.x, front, held);
        self.push(
            place.site,
            Action::Approach {
                to: Point3::new(place.x, front, place.z),
                feed: TRAVEL_FEED,
            },
        );
    }

    fn cut(&mut self, place: Place, flank: Flank, y: f64) {
        self.push(
            place.site,
            Action::Cut {
                flank,
                to: Point3::new(place.x, y, place.z),
                feed: CUT_FEED,
            },
        );
    }

    fn leave(&mut self, place: Place, y: f64) {
        self.push(
            place.site,
            Action::Retract {
                to: Point3::new(place.x, y, self.recipe.safe_height()),
                feed: TRAVEL_FEED,
            },
        );
    }

    fn travel(&mut self, site: Site, x: f64, y: f64, orientation: OrientationId) {
        self.push(
            site,
            Action::Travel {
                to: Point3::new(x, y, self.recipe.safe_height()),
                orientation,
                feed: TRAVEL_FEED,
                rate: RATE,
            },
        );
    }
}

/// `R = Ry(swing) Rx(-sense (90 deg - rake)) R0` with `R0 = [+Y +X -Z]`, the posture of a straight blade.
pub(super) fn posture(swing: Angle, rake: Angle, sense: f64) -> Orientation {
    let (sin_swing, cos_swing) = libm::sincos(swing.to_rad() / 2.0);
    let lean = -sense * (Angle::deg(90.0) - rake).to_rad() / 2.0;
    let (sin_lean, cos_lean) = libm::sincos(lean);
    let half = core::f64::consts::FRAC_1_SQRT_2;
    let turn = product([cos_swing, 0.0, sin_swing, 0.0], [cos_lean, sin_lean, 0.0, 0.0]);
    let [w, x, y, z] = product(turn, [0.0, half, half, 0.0]);
    Orientation::from_quaternion(w, x, y, z).unwrap_or(Orientation::IDENTITY)
}

/// Product of two quaternions, scalar part first.
pub(super) fn product([aw, ax, ay, az]: [f64; 4], [bw, bx, by, bz]: [f64; 4]) -> [f64; 4] {
    [
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::verify;
    use proptest::prelude::*;

    /// The matrix of `docs/process.md`, "Frames and posture", worked out for u = -z_t and x_t.
    #[test]
    fn the_posture_follows_its_formula() {
        let (swing, rake) = (Angle::deg(34.16), Angle::deg(60.0));
        for sense in [1.0, -1.0] {
            let m = posture(swing, rake, sense).matrix();
            let shank = [-m[0][2], -m[1][2], -m[2][2]];
            let expected = [
                rake.sin() * swing.sin(),
                sense * rake.cos(),
                rake.sin() * swing.cos(),
            ];
            for (got, want) in shank.into_iter().zip(expected) {
                assert!((got - want).abs() < 1e-12, "{shank:?} {expected:?}");
            }
            assert!(m[1][0] > 0.0, "x_t points to +y");
            assert!(m[1][1].abs() < 1e-12, "the blade plane holds the feed");
        }
    }

    proptest! {
        #[test]
        fn recipes_give_programs_without_faults(
            counts in (0..3_u16, 0..4_u32, 0..4_u32),
            swing in 5.0..60.0_f64,
            rake in 45.0..90.0_f64,
            layer_pass in any::<bool>(),
            single in any::<bool>(),
            clearance in 0.5..30.0_f64,
        ) {
            let recipe = Recipe {
                operations: counts.0,
                layers: counts.1,
                cuts: counts.2,
                swing: Angle::deg(swing),
                rake: Angle::deg(rake),
                passes: if layer_pass { Passes::Layer } else { Passes::Point },
                edges: if single { Edges::Single } else { Edges::Double },
                clearance: Length::mm(clearance),
                ..Recipe::default()
            };
            let faults = verify(recipe.program()).err();
            prop_assert_eq!(faults, None);
        }
    }
}

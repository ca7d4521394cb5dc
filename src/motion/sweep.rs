//! What the blade sweeps where a five-axis machine turns it, compared with what is left of the stock.
//!
//! A robot turns the blade about one fixed axis, and the extension of the cuts is planned for that. Rotary axes that go each at a
//! constant rate ([`super::path::five_axis`]) turn it on another way: a C axis carries a tilted blade round a cone, and in the
//! middle of the turn it may lie farther over the work than at both ends. So every motion that changes how the blade is held is
//! looked at with the axes that carry it out. Pieces of chains are not: they lead through the work, and [`super::stray`] proves
//! that the axes hold the blade on them as the program does.
//!
//! **The blade** is a triangle between its tip and the ends of both edges, and above it a strip as wide as the edges are apart; a
//! round one its two rims, and above them two such strips square to each other. Strips end where a stated body begins, whose stages
//! are cylinders, the last one as far up as the spindle is away; else at the spindle. **The work** is the stock as far along y as it is deep, below the
//! surface that the cuts before have left. At one place of the motion both are compared exactly. What lies in planes is clipped to
//! the sides of the work, and what remains has to lie above the corners of the surface and above the surface with its own corners;
//! of cylinders [`body::meets`] has the shadow.
//!
//! **Proof.** With rotary axes that change by `c_i` during the motion, the blade turns by at most `w = sum |c_i|` (angular
//! velocities of axes that carry one another add up), so a point at the distance `r` from the tip moves by at most
//! `(|way| + w r) h` while the part `h` of the motion is done. A stretch of the motion is clear if in its middle the blade is
//! farther from the work than its points move until the stretch's ends. Stretches are halved until they are clear, or until
//! that is less than [`FINE`]: then the blade may be in the work, and the motion is refused. Nothing enters the
//! work by more than [`GRAZE`] unseen.

use super::moves::{numbered, paths};
use super::rig::Rig;
use super::rigs::Rigs;
use glam::{DMat3, DVec3};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Blade, OpId, Program, Shape, Stage, Stock};
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_geometry::curve::Point2;
use vcutc_machine::kinematics::Joints;
use vcutc_simulation::surface::Surface;
use vcutc_simulation::{body, prove};

/// How far (mm) the blade may be in the work and count as touching it: planned extensions let an edge come up to it.
pub const GRAZE: f64 = 0.01;
/// Stretches are not divided any further when what they ask for beside the blade itself is this small, in mm.
const FINE: f64 = GRAZE / 2.0;
/// Into how many parts a turn is divided to find out how upright the blade stays.
const UPRIGHT_STEPS: u32 = 64;
/// Least z of the blade's direction that makes it upright enough to say from which height on it is above the work.
const LEAST_UPRIGHT: f64 = 0.05;
/// How far (mm) the tip is moved at most to see whether the blade then is clear.
const FARTHEST: f64 = 500.0;
/// To how much (mm) that distance is found.
const ROOM_STEP: f64 = 0.01;

/// A motion that sweeps the blade through the work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    pub op: OpId,
    /// Where on its way the blade is in the work, from 0 to 1.
    pub at: f64,
    /// What of the blade is.
    pub part: BladePart,
    /// A place in W where it is.
    pub place: [f64; 3],
    /// What would clear this motion and all others of the program.
    pub cure: Cure,
}

/// A part of the blade.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BladePart {
    /// An edge, within the cutting length.
    Edge,
    /// The body above it.
    Body,
}

/// What would clear a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cure {
    /// The tip farther beside the work, by this.
    FartherOut(Length),
    /// The tip higher above the work, by this.
    HigherUp(Length),
    /// Neither, as far as was looked.
    Unknown,
}

/// Proves that no motion which turns the blade sweeps it through the work. `ends` are the axes at the end of every op, and the
/// rig's rotary axes go evenly between them.
///
/// # Errors
/// The first motion that does.
pub(super) fn clear(program: &VerifiedProgram, rigs: &Rigs<'_>, ends: &[Joints]) -> Result<(), Sweep> {
    let paths = paths(program.program());
    let mut turns = numbered(&paths)
        .filter_map(|(op, path)| {
            let blade = program.program().blade(rigs.tool_during(op))?;
            Turn::of(program.program(), (rigs.during(op), blade), ends, op, path)
        })
        .peekable();
    let mut found: Option<Sweep> = None;
    prove::accompanied(program, &[], &mut |op, surface| {
        if let Some(turn) = turns.next_if(|turn| turn.op == op) {
            judge(&turn, surface, &mut found);
        }
    });
    match found {
        None => Ok(()),
        Some(first) => Err(first),
    }
}

/// Notes the first motion that is not clear. Of those after it, only how much more room they need.
fn judge(turn: &Turn<'_, '_>, surface: &mut Surface, found: &mut Option<Sweep>) {
    let work = turn.work(surface);
    let stands = turn.stands();
    match found {
        None => {
            if let Err(hit) = turn.prove(&work, DVec3::ZERO) {
                *found = Some(Sweep {
                    op: turn.op,
                    at: hit.at,
                    part: hit.part,
                    place: hit.place.to_array(),
                    cure: turn.cure(&work, 0.0),
                });
            }
        }
        Some(first) => {
            let so_far = match (first.cure, stands) {
                (Cure::FartherOut(by), Stands::Beside(_)) | (Cure::HigherUp(by), Stands::Above) => by.to_mm(),
                (Cure::FartherOut(_) | Cure::HigherUp(_) | Cure::Unknown, _) => return,
            };
            if turn.prove(&work, stands.outwards() * so_far).is_err() {
                first.cure = turn.cure(&work, so_far);
            }
        }
    }
}

/// Where a blade is that turns.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stands {
    /// Beside the work, which is in the other direction along y.
    Beside(f64),
    Above,
}

impl Stands {
    const fn outwards(self) -> DVec3 {
        match self {
            Self::Beside(y) => DVec3::new(0.0, y, 0.0),
            Self::Above => DVec3::Z,
        }
    }
}

/// A motion that changes how the blade is held.
struct Turn<'t, 'm> {
    op: OpId,
    rig: &'t Rig<'m>,
    stock: Stock,
    /// The tip, from and to, in W.
    tip: [DVec3; 2],
    axes: [Joints; 2],
    /// By how much the blade turns at most, in rad.
    angle: f64,
    blade: Outline,
}

/// The blade in its frame: plane pieces of its edge, how far they lie from its axis at most, their height above the tip, and what is
/// above them.
#[derive(Clone, Debug)]
struct Outline {
    edges: Vec<Vec<DVec3>>,
    /// To one side, for each plane with a strip above the edges.
    sides: Vec<DVec3>,
    half_width: f64,
    edge_height: f64,
    /// Up to where the strips go.
    strip_height: f64,
    /// Above them, where the body is stated.
    stages: Vec<Stage>,
}

impl Outline {
    fn of(blade: &Blade, rig: &Rig<'_>) -> Self {
        let spindle = rig.flange_in_blade.position;
        let stages = blade.stages(Length::mm(spindle.length()));
        let strip_height = match &blade.body {
            Some(body) => body.first().map_or(0.0, |first| first.from.to_mm()),
            None => -spindle.z,
        };
        let bare = match blade.shape {
            Shape::Straight(straight) => {
                let [[half_width, _, low], _] = straight.edge_ends();
                Self::straight(half_width, -low, strip_height)
            }
            Shape::Disc(_) | Shape::Crusher(_) => Self::round(blade, strip_height),
        };
        Self { stages, ..bare }
    }

    fn straight(half_width: f64, edge_height: f64, strip_height: f64) -> Self {
        let side = DVec3::X * half_width;
        let up = DVec3::Z * -edge_height;
        Self {
            edges: vec![vec![DVec3::ZERO, up - side, up + side]],
            sides: vec![side],
            half_width,
            edge_height,
            strip_height,
            stages: Vec::new(),
        }
    }

    /// The rims of its edge and of what lies above it.
    fn round(blade: &Blade, strip_height: f64) -> Self {
        let hull: Vec<DVec3> = blade.hull().into_iter().map(DVec3::from_array).collect();
        let half_width = hull.iter().map(|point| libm::hypot(point.x, point.y));
        let half_width = half_width.fold(0.0, f64::max);
        let edge_height = hull.iter().map(|point| -point.z).fold(0.0, f64::max);
        let (lower, upper) = hull.split_at(hull.len() / 2);
        Self {
            edges: vec![lower.to_vec(), upper.to_vec()],
            sides: [DVec3::X, DVec3::Y].map(|side| side * half_width).to_vec(),
            half_width,
            edge_height,
            strip_height,
            stages: Vec::new(),
        }
    }

    /// How far its points are from the tip at most.
    fn reach(&self) -> f64 {
        let stages = self.stages.iter().map(|stage| Piece::Stage(*stage).reach());
        stages.fold(
            self.strip_height.max(self.edge_height) + self.half_width,
            f64::max,
        )
    }

    /// How far from its axis anything of it is at most.
    fn girth(&self) -> f64 {
        let radii = self.stages.iter().map(|stage| stage.radius.to_mm());
        radii.fold(self.half_width, f64::max)
    }

    fn edges(&self) -> impl Iterator<Item = Piece> {
        self.edges.iter().map(|corners| Piece::Edge(corners.clone()))
    }

    /// What is above the edges, up to a height.
    fn body(&self, height: f64) -> impl Iterator<Item = Piece> {
        let top = height.min(self.strip_height);
        let is_above = top > self.edge_height;
        let up = [-self.edge_height, -top].map(|z| DVec3::new(0.0, 0.0, z));
        let strips = self.sides.iter().filter(move |_| is_above);
        let strips =
            strips.map(move |&side| Piece::Strip([up[0] - side, up[0] + side, up[1] + side, up[1] - side]));
        let stages = self.stages.iter().filter_map(move |&Stage { heights, radius }| {
            let heights = [heights[0], heights[1].min(Length::mm(height))];
            (heights[0] < heights[1]).then_some(Piece::Stage(Stage { heights, radius }))
        });
        strips.chain(stages)
    }
}

/// A convex piece of the blade, in T.
enum Piece {
    Edge(Vec<DVec3>),
    Strip([DVec3; 4]),
    Stage(Stage),
}

impl Piece {
    const fn part(&self) -> BladePart {
        match self {
            Self::Edge(_) => BladePart::Edge,
            Self::Strip(_) | Self::Stage(_) => BladePart::Body,
        }
    }

    /// How far its points are from the tip at most.
    fn reach(&self) -> f64 {
        let farthest = |corners: &[DVec3]| {
            let lengths = corners.iter().map(|corner| corner.length());
            lengths.fold(0.0, f64::max)
        };
        match self {
            Self::Edge(corners) => farthest(corners),
            Self::Strip(corners) => farthest(corners),
            Self::Stage(stage) => libm::hypot(stage.heights[1].to_mm(), stage.radius.to_mm()),
        }
    }

    /// A place where it may meet the work if it moves by that much any way, with the blade held like this.
    fn meets(&self, work: &Work, (held, tip): (DMat3, DVec3), moves: f64) -> Option<DVec3> {
        let flat = |corners: &[DVec3]| {
            let corners: Vec<DVec3> = corners.iter().map(|&corner| held * corner + tip).collect();
            work.meets(&corners, moves)
        };
        match self {
            Self::Edge(corners) => flat(corners),
            Self::Strip(corners) => flat(corners),
            Self::Stage(stage) => work.meets_stage(*stage, (held, tip), moves),
        }
    }
}

/// Where the blade is in the work.
struct Hit {
    at: f64,
    part: BladePart,
    place: DVec3,
}

impl<'t, 'm> Turn<'t, 'm> {
    /// The motion of an op, if it changes how the blade is held.
    fn of(
        program: &Program,
        (rig, blade): (&'t Rig<'m>, &Blade),
        ends: &[Joints],
        op: OpId,
        path: &Path,
    ) -> Option<Self> {
        let LinearSegment { from, to, .. } = path.line().filter(|line| line.turns())?;
        let index = op.0 as usize;
        let axes = [*ends.get(index.checked_sub(1)?)?, *ends.get(index)?];
        let found = program.op(op)?;
        if matches!(found.action, Action::Follow { .. }) {
            return None;
        }
        Some(Self {
            op,
            rig,
            stock: program.stock,
            tip: [from.tip, to.tip].map(|tip| DVec3::new(tip.x, tip.y, tip.z)),
            axes,
            angle: axes[0]
                .iter()
                .zip(axes[1])
                .skip(3)
                .map(|(from, to)| (to - from).abs())
                .sum(),
            blade: Outline::of(blade, rig),
        })
    }

    /// How the blade is turned at a place of the motion.
    fn held(&self, place: f64) -> DMat3 {
        let [start, end] = &self.axes;
        let joints = core::array::from_fn(|axis| start[axis] + (end[axis] - start[axis]) * place);
        self.rig.blade_in_work(&joints).rotation
    }

    /// The work that the blade may meet.
    fn work(&self, surface: &mut Surface) -> Work {
        let reach = self.blade.reach();
        let (left, right) = (self.tip[0].x.min(self.tip[1].x), self.tip[0].x.max(self.tip[1].x));
        Work::of(surface, self.stock, left - reach, right + reach)
    }

    /// From which height above its tip on the blade stays above a height above the lower tip. (Its sides hang lower than its axis
    /// by what they are away from it at most.)
    fn above(&self, height: f64) -> f64 {
        let half_step = self.angle / f64::from(2 * UPRIGHT_STEPS);
        let least = (0..UPRIGHT_STEPS)
            .map(|step| {
                -self
                    .held((f64::from(step) + 0.5) / f64::from(UPRIGHT_STEPS))
                    .z_axis
                    .z
            })
            .fold(f64::INFINITY, f64::min)
            - half_step;
        if least > LEAST_UPRIGHT {
            ((height + self.blade.girth()) / least).max(0.0)
        } else {
            f64::INFINITY
        }
    }

    /// Proves that the blade is clear of the work when its tip runs so far from where it does.
    fn prove(&self, work: &Work, moved: DVec3) -> Result<(), Hit> {
        let lowest = self.tip[0].z.min(self.tip[1].z) + moved.z;
        let body = self.blade.body(self.above(work.highest() - lowest));
        for piece in self.blade.edges().chain(body) {
            self.prove_piece(&piece, work, moved)?;
        }
        Ok(())
    }

    fn prove_piece(&self, piece: &Piece, work: &Work, moved: DVec3) -> Result<(), Hit> {
        let way = self.tip[1] - self.tip[0];
        let fastest = way.length() + self.angle * piece.reach();
        let mut rest = vec![(0.0, 1.0)];
        while let Some((from, to)) = rest.pop() {
            let middle = f64::midpoint(from, to);
            let moves = fastest * (to - from) / 2.0;
            let (held, tip) = (self.held(middle), self.tip[0] + way * middle + moved);
            if let Some(place) = piece.meets(work, (held, tip), moves) {
                if moves * (1.0 + work.steepest) <= FINE {
                    return Err(Hit {
                        at: middle,
                        part: piece.part(),
                        place,
                    });
                }
                rest.extend([(middle, to), (from, middle)]);
            }
        }
        Ok(())
    }

    fn stands(&self) -> Stands {
        let depth = self.stock.depth.to_mm();
        if self.tip.iter().all(|tip| tip.y <= 0.0) {
            Stands::Beside(-1.0)
        } else if self.tip.iter().all(|tip| tip.y >= depth) {
            Stands::Beside(1.0)
        } else {
            Stands::Above
        }
    }

    /// What clears it, at least so far from where it is.
    fn cure(&self, work: &Work, at_least: f64) -> Cure {
        let stands = self.stands();
        let is_clear = |by: f64| self.prove(work, stands.outwards() * by).is_ok();
        let mut enough = at_least + 1.0;
        while !is_clear(enough) {
            if enough >= FARTHEST {
                return Cure::Unknown;
            }
            enough *= 2.0;
        }
        let mut too_little = at_least;
        while enough - too_little > ROOM_STEP {
            let middle = f64::midpoint(too_little, enough);
            if is_clear(middle) {
                enough = middle;
            } else {
                too_little = middle;
            }
        }
        match stands {
            Stands::Beside(_) => Cure::FartherOut(Length::mm(enough)),
            Stands::Above => Cure::HigherUp(Length::mm(enough)),
        }
    }
}

/// What is left of the stock about a place: a prism along y.
struct Work {
    stock: Stock,
    width: f64,
    depth: f64,
    /// The surface from left to right; at least one corner.
    corners: Vec<Point2>,
    /// Rise over x of its steepest flank, walls left out.
    steepest: f64,
    /// The heads of its walls.
    walls: Vec<Point2>,
}

impl Work {
    fn of(surface: &mut Surface, stock: Stock, from: f64, to: f64) -> Self {
        let width = surface.width();
        let (from, to) = (from.clamp(0.0, width), to.clamp(0.0, width));
        let end = |surface: &mut Surface, x: f64| Point2 {
            x,
            z: surface.height(x),
        };
        let right = end(surface, to);
        let mut corners = vec![end(surface, from)];
        corners.extend(surface.corners_between(from, to));
        corners.push(right);
        let rise = |pair: &[Point2]| match pair {
            [a, b] if b.x - a.x > LEVEL => ((b.z - a.z) / (b.x - a.x)).abs(),
            _ => 0.0,
        };
        let steepest = corners.windows(2).map(rise).fold(0.0, f64::max);
        let wall = |pair: &[Point2]| match pair {
            [a, b] if b.x - a.x <= LEVEL && (b.z - a.z).abs() > LEVEL => {
                Some(if a.z > b.z { *a } else { *b })
            }
            _ => None,
        };
        let walls = corners.windows(2).filter_map(wall).collect();
        Self {
            stock,
            width,
            depth: stock.depth.to_mm(),
            corners,
            steepest,
            walls,
        }
    }

    fn highest(&self) -> f64 {
        self.corners
            .iter()
            .map(|corner| corner.z)
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Height at x; beyond the ends that of the end.
    fn height(&self, x: f64) -> f64 {
        let next = self.corners.partition_point(|corner| corner.x < x);
        match (
            next.checked_sub(1).and_then(|before| self.corners.get(before)),
            self.corners.get(next),
        ) {
            (Some(a), Some(b)) if b.x - a.x > LEVEL => a.z + (b.z - a.z) * ((x - a.x) / (b.x - a.x)),
            (Some(a), Some(b)) => a.z.max(b.z),
            (Some(a), None) | (None, Some(a)) => a.z,
            (None, None) => f64::NEG_INFINITY,
        }
    }

    /// A place where a convex polygon that moves by that much any way may meet the work, by more than [`GRAZE`].
    fn meets(&self, polygon: &[DVec3], moves: f64) -> Option<DVec3> {
        let beyond = moves - GRAZE;
        let sides = [
            (DVec3::Y, -beyond),
            (DVec3::NEG_Y, -self.depth - beyond),
            (DVec3::X, -beyond),
            (DVec3::NEG_X, -self.width - beyond),
            (DVec3::NEG_Z, -self.highest() - beyond),
        ];
        let mut inside = polygon.to_vec();
        for (inwards, least) in sides {
            inside = clipped(&inside, inwards, least);
            if inside.is_empty() {
                return None;
            }
        }
        // A point that moves aside meets the surface there, which is higher by no more than its steepest flank makes it.
        let room = beyond + self.steepest * moves;
        let is_low = |point: &DVec3| point.z < self.height(point.x) + room;
        if let Some(&low) = inside.iter().find(|point| is_low(point)) {
            return Some(low);
        }
        let over_corner = self.corners.iter().find_map(|corner| {
            let lowest = lowest_at(&inside, corner.x)?;
            (lowest.z < corner.z + room).then_some(lowest)
        });
        // Beside a wall it meets the wall there.
        let beside_wall = |wall: &Point2| {
            let from_left = clipped(&inside, DVec3::X, wall.x - moves);
            let beside = clipped(&from_left, DVec3::NEG_X, -wall.x - moves);
            beside.into_iter().find(|point| point.z < wall.z + room)
        };
        over_corner.or_else(|| self.walls.iter().find_map(beside_wall))
    }

    /// A place where a stage that moves by that much any way may meet the work, by more than [`GRAZE`].
    fn meets_stage(&self, stage: Stage, (held, tip): (DMat3, DVec3), moves: f64) -> Option<DVec3> {
        let axis = -held.z_axis;
        let at = (Point3::new(tip.x, tip.y, tip.z), axis.to_array());
        // A rim goes deeper than the cylinder that lies so deep in the stage, by the square root of two at most.
        let by = moves - GRAZE * core::f64::consts::FRAC_1_SQRT_2;
        let place = body::meets(stage, by, at, self.stock, &self.corners)?;
        let middle = stage.heights.map(Length::to_mm);
        let along = tip.y + axis.y * f64::midpoint(middle[0], middle[1]);
        Some(DVec3::new(place.x, along.clamp(0.0, self.depth), place.z))
    }
}

/// Corners of the surface this close (mm) are one: there is no flank between them.
const LEVEL: f64 = 1e-5;

/// The part of a convex polygon in the half-space where `inwards . p >= least`.
fn clipped(polygon: &[DVec3], inwards: DVec3, least: f64) -> Vec<DVec3> {
    let depth = |point: DVec3| inwards.dot(point) - least;
    let before = polygon.iter().cycle().skip(polygon.len().saturating_sub(1));
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (&from, &to) in before.zip(polygon) {
        let (a, b) = (depth(from), depth(to));
        if (a < 0.0) != (b < 0.0) {
            kept.push(from + (to - from) * (a / (a - b)));
        }
        if b >= 0.0 {
            kept.push(to);
        }
    }
    kept
}

/// The lowest point of a convex polygon at x.
fn lowest_at(polygon: &[DVec3], x: f64) -> Option<DVec3> {
    let before = polygon.iter().cycle().skip(polygon.len().saturating_sub(1));
    let crossings = before.zip(polygon).filter_map(|(&from, &to)| {
        let (a, b) = (from.x - x, to.x - x);
        ((a < 0.0) != (b < 0.0)).then(|| from + (to - from) * (a / (a - b)))
    });
    crossings.min_by(|a, b| a.z.total_cmp(&b.z))
}

#[cfg(test)]
mod tests;

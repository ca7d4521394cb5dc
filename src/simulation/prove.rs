//! The proof that a program cuts every chip free and never enters the part.
//!
//! The cuts are read back from the program's own poses: where the tip runs, which way the shank leans, and so how steep
//! the flank is and how much of the edge is left for it. They are replayed in the program's order. A flank is measured
//! against the surface as it is when it is cut; when the second flank of a V is cut its chip is taken out. A chip that is
//! not freed is taken out all the same after it has been noted, so that each finding stands for itself and not for those
//! before. A cut of a single flank takes out what that flank closes off together with the surface, as soon as it is cut; if
//! its tip lies in the material there is nothing to take out, and that is noted as a chip that no edge frees.
//!
//! Beside the surface that all cuts leave together, each operation has one of its own: what its cuts alone would leave of
//! the stock, made by the blade's side towards the part, which lies a standoff deeper than its middle plane. That one must
//! stay out of the part and the operation's allowance everywhere (a later operation may come closer to the part than an
//! earlier one). They are compared corner by corner at the end; between corners both are straight.
//!
//! Tracks of a disc that change along y are judged elsewhere, where the surface is known that they follow ([`Tracks`]), and so are
//! passes over a region of the plan ([`Cleared`]): here they take nothing off.
//!
//! Tips that are offset against forces are replayed where the blade is while these push ([`Compensation`]).
//!
//! On a piece of a chain the blade itself is followed, with its thickness and the chain's blend ([`piece`]).

mod along;
mod blocked;
mod cleared;
mod columns;
mod compensation;
mod edge;
mod entry;
mod findings;
mod flank;
mod half_done;
mod overcut;
mod piece;
mod slit;
mod strip;
#[cfg(test)]
mod tests;

use super::by_layer::ByLayer;
use super::course::Course;
use super::cross_section::{CrossSection, Guard, Taken};
use super::disc::PassFault;
use super::sides::ThickFlank;
use super::surface::{Side, Single, Surface, Vee};
use along::AlongSpine;
pub use cleared::{Cleared, ClearingFault, Standing};
use columns::AlongColumns;
pub use columns::{ColumnsBound, Made};
pub use compensation::{Compensation, VNumber};
use core::num::NonZeroU32;
pub use edge::UsedEdge;
pub use entry::below_top;
pub(super) use entry::merge_heights;
pub use findings::Findings;
use findings::note;
use flank::{FlankGeometry, flanks};
use half_done::HalfDone;
use piece::Piece;
pub use slit::{Slit, SlitFault};
use std::collections::BTreeMap;
use strip::Through;
pub use strip::{Across, Passes, Skin, Strips, Tracked, Tracks};
use vcutc_backend_api::ir::{
    Action, CutKind, Flank, Joint, Op, OpId, OperationId, OrientationId, Program, Site, ToolId,
};
use vcutc_backend_api::segments::Segment;
use vcutc_backend_api::state::{State, TipPose};
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_geometry::columns::Column;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_geometry::spine::Spine;

/// What an operation must stay out of.
#[derive(Clone, Copy, Debug)]
pub struct Bound<'p> {
    /// The part with its allowance.
    pub part: &'p Profile,
    /// How much deeper the blade's side towards the part lies than its middle plane, measured along z.
    pub drop: Length,
    /// The longest edge that a cut may use, where that is less than the blade has.
    pub edge: Option<Length>,
    /// How far the sides of the blade are from its middle plane, beside slits and flanks that are narrower than their operation's.
    pub aside: Length,
    /// What discs of the operation are taken for; none where it has none.
    pub passes: Option<Passes>,
    /// What its cuts follow, with which taken off the part is what it is here; none where they are level.
    pub spine: Option<&'p Spine>,
    /// The columns that its cuts keep to, of which the part is the section of lower ends; none where they do not. No other operation may
    /// have cuts then.
    pub columns: Option<ColumnsBound<'p>>,
    /// How much lower than their tips say flanks of level cuts have to come out.
    pub lower: Length,
    /// How far its tips are offset against forces: it is replayed as it cuts under these. None where they are not, or where it is
    /// replayed as it cuts while nothing pushes the blade.
    pub compensation: Option<&'p Compensation>,
}

/// Something wrong with a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    pub operation: OperationId,
    /// Its layer, from the top.
    pub layer: NonZeroU32,
    /// What it cuts.
    pub kind: CutKind,
    /// The cut in its layer.
    pub cut: NonZeroU32,
    /// Where its tip runs.
    pub tip: Point2,
    /// The y of that, in mm; none where it is the same at every y.
    pub y: Option<f64>,
    /// What is wrong.
    pub fault: CutFault,
}

impl<'p> Bound<'p> {
    /// A part that the middle plane of the blade may touch.
    #[must_use]
    pub const fn of(part: &'p Profile) -> Self {
        Self {
            part,
            drop: Length::ZERO,
            edge: None,
            aside: Length::ZERO,
            passes: None,
            spine: None,
            columns: None,
            lower: Length::ZERO,
            compensation: None,
        }
    }
}

/// What can be wrong with a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CutFault {
    /// A flank does not come out within the cutting length, or a chain leads more of the edge through the work.
    NotFreed {
        /// Edge length that would do; infinite for a single flank whose tip lies in the material, which no edge
        /// frees.
        needed: Length,
        /// Edge length that may be used: what the blade has, or less.
        available: Length,
    },
    /// Beyond the point where the flank comes out, material stands in the way of the blade's body.
    Blocked {
        /// The corner that stands highest above the flank.
        at: Point2,
        /// How far it stands above the flank, along z.
        by: Length,
    },
    /// The cut enters the part or its allowance.
    Overcut {
        /// Where it goes deepest.
        at: Point2,
        /// How deep, along z.
        depth: Length,
    },
    /// A cut leaves the spine or the line that it is to follow.
    Strays {
        /// Where along y.
        y: Length,
        /// How far the tip is off, or the end of the edge.
        by: Length,
    },
    /// A pass of a disc does not do what it is for.
    Strip(PassFault),
    /// A pass over a region does what it must not, or not what it is for.
    Clearing(ClearingFault),
    /// A slit along a wall does.
    Slit(SlitFault),
    /// More stays on the part beside a track than may.
    Stays {
        /// Where that is the most.
        at: Point2,
        /// How far from the part.
        height: Length,
        /// The limit.
        limit: Length,
    },
}

/// What a replay shows.
#[derive(Clone, Debug)]
pub struct Replay {
    /// The machined surface.
    pub surface: Surface,
    /// What is wrong.
    pub findings: Findings,
    /// The longest edge that any cut uses.
    pub longest_edge: Length,
    /// How much edge or rim cuts use, in the program's order, as far as it is measured cut by cut.
    pub edges: Vec<UsedEdge>,
    /// How far the tips of its operations are offset, operation by operation; none of those that are not compensated.
    pub compensations: Vec<Option<Compensation>>,
    /// The columns whose Vs make up the machined surface; none where cuts follow none.
    pub columns: Vec<Column>,
    /// Cuts of each layer of each operation, in order.
    pub layers: Vec<(OperationId, usize)>,
    /// What tracks on a surface do, operation by operation; empty until they are judged where the surface is known.
    pub tracked: Vec<Tracked>,
    /// What passes over regions do, operation by operation; empty until they are judged where the regions are known.
    pub cleared: Vec<Cleared>,
    /// What slits along walls do, likewise.
    pub slit: Vec<Slit>,
}

/// Replays a program's cuts. `bounds` are the operations' own, in order.
#[must_use]
pub fn replay(program: &VerifiedProgram, bounds: &[Bound<'_>]) -> Replay {
    let untouched = Surface::untouched(program.program().stock);
    replay_on(untouched, program, bounds)
}

/// Replays the cuts of a program on what others have left of the stock.
#[must_use]
pub fn replay_on(surface: Surface, program: &VerifiedProgram, bounds: &[Bound<'_>]) -> Replay {
    let mut player = Player::new(surface, program.program(), bounds);
    player.play(program, &mut |_, _| {});
    player.finish()
}

/// Whether an op is a piece of a chain.
const fn is_piece(op: &Op) -> bool {
    matches!(op.action, Action::Follow { .. })
}

/// Shows the surface before every op as the cuts before it have left it. A chip counts as material until all of its flanks are
/// cut; so do those of cuts along spines that `bounds` do not know.
pub fn accompanied(
    program: &VerifiedProgram,
    bounds: &[Bound<'_>],
    show: &mut dyn FnMut(OpId, &mut Surface),
) {
    let untouched = Surface::untouched(program.program().stock);
    let mut player = Player::new(untouched, program.program(), needed(bounds));
    player.play(program, &mut |op, section| show(op, section.surface()));
}

/// As [`accompanied`], with what each op takes: before an op `show` sees what the one before it has taken. Returns what the last
/// one takes, and the machined surface.
pub fn watched(
    program: &VerifiedProgram,
    bounds: &[Bound<'_>],
    show: &mut dyn FnMut(OpId, &mut Surface, Vec<Taken>),
) -> (Vec<Taken>, Surface) {
    let untouched = Surface::untouched(program.program().stock);
    let mut player = Player::new(untouched, program.program(), needed(bounds));
    player.section.keep_taken();
    player.play(program, &mut |op, section| {
        let taken = section.taken();
        show(op, section.surface(), taken);
    });
    (player.section.taken(), player.section.into_surface())
}

/// What is needed of the bounds to see what cuts take: where none follows a spine or a column and none is compensated, nothing.
fn needed<'b, 'p>(bounds: &'b [Bound<'p>]) -> &'b [Bound<'p>] {
    let moves_cuts =
        |bound: &Bound<'_>| bound.spine.is_some() || bound.columns.is_some() || bound.compensation.is_some();
    if bounds.iter().any(moves_cuts) {
        bounds
    } else {
        &[]
    }
}

/// Depth below which an overcut is rounding: a nanometre.
const OVERCUT: f64 = 1e-6;

/// A cut of one flank, as the program states it.
#[derive(Clone, Debug)]
struct Cut {
    operation: OperationId,
    layer: NonZeroU32,
    cut: NonZeroU32,
    flank: Flank,
    /// Where the tip runs.
    tip: Point2,
    held: OrientationId,
    tool: ToolId,
}

impl Cut {
    /// The cuts of a program, in its order.
    fn all(program: &Program) -> impl Iterator<Item = (OpId, Self)> {
        let ends = program.ends();
        ends.filter_map(|(id, op, after)| Some((id, Self::of(op, &after)?)))
    }

    const fn side(&self) -> Side {
        match self.flank {
            Flank::Left => Side::Left,
            Flank::Right => Side::Right,
        }
    }

    /// The cut that an op is, with the state after it.
    fn of(op: &Op, after: &State) -> Option<Self> {
        let Action::Cut { flank, .. } = op.action else {
            return None;
        };
        let Site::Cut {
            operation,
            layer,
            cut,
        } = op.site
        else {
            return None;
        };
        let TipPose { tip, orientation } = after.place.pose()?;
        Some(Self {
            operation,
            layer,
            cut,
            flank,
            tip: Point2 { x: tip.x, z: tip.z },
            held: orientation,
            tool: after.tool,
        })
    }

    fn finding(&self, program: &Program, fault: CutFault) -> Finding {
        Finding {
            operation: self.operation,
            layer: self.layer,
            kind: program.cut_kind(self.operation, self.tool),
            cut: self.cut,
            tip: self.tip,
            y: None,
            fault,
        }
    }
}

struct Player<'p> {
    program: &'p Program,
    bounds: &'p [Bound<'p>],
    section: CrossSection,
    /// What each operation's cuts alone leave, on the blade's side towards the part; in step with `bounds`.
    guards: Vec<Surface>,
    /// Geometry of each orientation with the blade at hand.
    flanks: Vec<FlankGeometry>,
    /// The operation and the blade at hand.
    at_work: Option<(OperationId, ToolId)>,
    /// How much edge its cuts may use, in mm; none of a blade without one.
    usable_edge: Option<f64>,
    half_done: HalfDone,
    findings: Findings,
    /// The deepest entry into the part of what leaves no trace in a surface, slits and chains, and how deep that is.
    traceless: Option<(Finding, f64)>,
    longest_edge: f64,
    /// The op that is played.
    playing: OpId,
    edges: Vec<UsedEdge>,
    /// The cut of the chain that was counted last: it may stop on its way.
    counted: Option<Site>,
    /// How many cuts each layer has.
    layers: ByLayer<usize>,
    /// Slits, and what to report of them if they free nothing.
    slits: Vec<(f64, Finding)>,
    /// The part of each operation that has slits or passes.
    kept: BTreeMap<OperationId, Guard<'p>>,
    /// The part that each operation with chains or narrow flanks must stay out of, up to the stock's top.
    parts: BTreeMap<OperationId, Vec<Point2>>,
    /// Cuts along a spine.
    along: AlongSpine,
    /// Cuts along columns.
    columns: AlongColumns,
}

impl<'p> Player<'p> {
    fn new(surface: Surface, program: &'p Program, bounds: &'p [Bound<'p>]) -> Self {
        let untouched = Surface::untouched(program.stock);
        Self {
            program,
            bounds,
            guards: vec![untouched; bounds.len()],
            section: CrossSection::new(surface),
            flanks: Vec::new(),
            at_work: None,
            usable_edge: None,
            half_done: HalfDone::default(),
            findings: Findings::default(),
            traceless: None,
            slits: Vec::new(),
            kept: BTreeMap::new(),
            parts: BTreeMap::new(),
            longest_edge: 0.0,
            playing: OpId(0),
            // Nearly every other op is a cut.
            edges: Vec::with_capacity(program.ops.len() / 2),
            counted: None,
            layers: ByLayer::default(),
            along: AlongSpine::default(),
            columns: AlongColumns::default(),
        }
    }

    /// Plays all cuts. `show` sees the section before every op.
    fn play(&mut self, verified: &VerifiedProgram, show: &mut dyn FnMut(OpId, &mut CrossSection)) {
        // Looked at where there is one, so that programs without chains take no time for them.
        let mut pieces = self.program.segments().filter(|segment| is_piece(segment.op));
        self.program.show_ends(|id, op, after| {
            show(id, &mut self.section);
            self.playing = id;
            if let Some(cut) = Cut::of(op, after) {
                let cut = self.under_load(cut);
                self.cut(&cut, verified.is_single(id));
            } else if is_piece(op)
                && let Some(segment) = pieces.next()
            {
                self.piece(&segment);
            }
        });
    }

    /// `is_single` says that the cut has no other flank.
    fn cut(&mut self, cut: &Cut, is_single: bool) {
        self.enter(cut.operation, cut.tool);
        let Some(&geometry) = self.flanks.get(cut.held.0 as usize) else {
            return;
        };
        let side = cut.side();
        let bounds = self.bounds;
        let bound = bounds.get(usize::from(cut.operation.0));
        if let Some(spine) = bound.and_then(|bound| bound.spine) {
            self.note_level(cut, spine);
            return;
        }
        if let Some(columns) = bound.and_then(|bound| bound.columns) {
            self.level_for_column(cut, geometry, columns, side);
            return;
        }
        if is_single {
            self.single(cut, geometry);
            return;
        }
        let lower = bound.map_or(0.0, |bound| bound.lower.to_mm());
        let least = match bound.and_then(|bound| bound.compensation) {
            Some(_) => self.edge_under_load(cut, geometry, lower),
            None => 0.0,
        };
        self.come_out(cut, side, geometry, (lower, least));
        // The verifier has made sure that both flanks are there, once each.
        match self.half_done.other_of(cut, geometry.slope) {
            None => self.count(cut),
            Some(other) => {
                let vee = Vee::one(cut.tip, side, geometry.slope).with(side.opposite(), other);
                self.release(cut, vee, Length::ZERO);
            }
        }
    }

    /// Where a flank that may lie so much lower comes out. It is taken to be no less high than `least`, in mm.
    #[inline]
    fn come_out(&mut self, cut: &Cut, side: Side, geometry: FlankGeometry, (lower, least): (f64, f64)) {
        let tip = Point2 {
            z: cut.tip.z - lower,
            ..cut.tip
        };
        let surface = self.section.surface();
        let blocked_at = if let Some(run) = surface.flank_from(tip, side, geometry.slope) {
            self.use_edge(run.reach.max(least) * geometry.edge_per_height, cut);
            run.blocked_at
        } else {
            surface.obstacle(Vee::one(tip, side, geometry.slope))
        };
        self.note_blocked(blocked_at, tip, geometry, cut);
    }

    /// A cut of one flank.
    fn single(&mut self, cut: &Cut, geometry: FlankGeometry) {
        let program = self.program;
        let vee = Vee::one(cut.tip, cut.side(), geometry.slope);
        self.count(cut);
        match self.section.single(vee) {
            Single::Inside if !geometry.slope.is_finite() => {
                self.slit(cut, geometry);
                return;
            }
            Single::Inside => {
                // Its slit is cut all the same.
                let run = self.section.surface().flank(vee, cut.side());
                self.measure_edge(run.reach * geometry.edge_per_height);
                self.note_blocked(run.blocked_at, cut.tip, geometry, cut);
                self.note_edge(f64::INFINITY, |fault| cut.finding(program, fault));
            }
            Single::Outside => {}
            Single::Frees(run) => {
                self.use_edge(run.reach * geometry.edge_per_height, cut);
                self.note_blocked(run.blocked_at, cut.tip, geometry, cut);
            }
        }
        self.release(cut, vee, Length::ZERO);
    }

    /// Counts a cut in its layer.
    fn count(&mut self, cut: &Cut) {
        *self.layers.of((cut.operation, cut.layer)) += 1;
    }

    /// Takes the chip of a cut out, all of whose flanks are cut, each up to `below` lower than it says.
    fn release(&mut self, cut: &Cut, vee: Vee, below: Length) {
        self.section.release(vee);
        let released = vee;
        let index = usize::from(cut.operation.0);
        let (Some(guard), Some(bound)) = (self.guards.get_mut(index), self.bounds.get(index)) else {
            return;
        };
        let vee = Vee {
            tip: Point2 {
                z: vee.tip.z - (bound.drop + below).to_mm(),
                ..vee.tip
            },
            ..vee
        };
        // A flank that frees nothing spoils what it enters all the same.
        let stuck = vee.is_single() && guard.single(vee) == Single::Inside;
        guard.release(if stuck { vee.walled() } else { vee });
        if vee.walled().is_slit() {
            self.note_slit(vee.tip, bound, cut);
        }
        self.note_narrow_flanks(released, cut);
    }

    /// Notes where flanks of a V enter the part whose sides lie deeper than the operation's own, so that its guard, which takes all
    /// of them for as deep, does not show it.
    fn note_narrow_flanks(&mut self, vee: Vee, cut: &Cut) {
        let program = self.program;
        let Some(bound) = self.bounds.get(usize::from(cut.operation.0)) else {
            return;
        };
        let [Some(left), Some(right)] = [vee.left, vee.right] else {
            return;
        };
        let flanks = [(Side::Left, left), (Side::Right, right)].map(|(side, slope)| ThickFlank {
            tip: vee.tip,
            side,
            slope,
            half: bound.aside.to_mm(),
        });
        if flanks
            .iter()
            .all(|flank| flank.drop() <= bound.drop.to_mm() + OVERCUT)
        {
            return;
        }
        let part = self.part_below_top(cut.operation, bound.part);
        let nearest = flanks.map(|flank| flank.nearest(part));
        for (at, gap) in nearest.into_iter().flatten() {
            self.note_entry(at, -gap, |fault| cut.finding(program, fault));
        }
    }

    /// A part up to the stock's top.
    fn part_below_top(&mut self, operation: OperationId, part: &Profile) -> &[Point2] {
        let top = self.program.stock.height.to_mm();
        let kept = self.parts.entry(operation);
        kept.or_insert_with(|| below_top(part, top))
    }

    /// Notes a slit, which leaves no trace in a surface, where it enters the part.
    fn note_slit(&mut self, tip: Point2, bound: &Bound<'_>, cut: &Cut) {
        let program = self.program;
        let (start, end) = bound.part.span();
        let part = bound.part.height(tip.x).min(self.section.surface().top());
        if (start..=end).contains(&tip.x) {
            self.note_entry(tip, part - tip.z, |fault| cut.finding(program, fault));
        }
    }

    /// Notes an entry into the part that leaves no trace in a surface.
    fn note_entry(&mut self, at: Point2, depth: f64, finding: impl Fn(CutFault) -> Finding) {
        let deepest = self.traceless.map_or(OVERCUT, |(_, known)| known);
        if depth > deepest {
            let fault = CutFault::Overcut {
                at,
                depth: Length::mm(depth),
            };
            self.traceless = Some((finding(fault), depth));
        }
    }

    /// A piece of a chain.
    fn piece(&mut self, segment: &Segment<'_>) {
        let (
            Site::Cut {
                operation,
                layer,
                cut,
            },
            Action::Follow { to, joint, .. },
        ) = (segment.op.site, segment.op.action)
        else {
            return;
        };
        self.enter(operation, segment.before.tool);
        let blade = self.program.blade(segment.before.tool);
        let (Some(course), Some(blade)) = (Course::of(self.program, segment), blade) else {
            return;
        };
        let program = self.program;
        let finding = |fault| Finding {
            operation,
            layer,
            kind: program.cut_kind(operation, segment.before.tool),
            cut,
            tip: Point2 { x: to.x, z: to.z },
            y: None,
            fault,
        };
        if joint == Joint::Stop && self.counted.replace(segment.op.site) != Some(segment.op.site) {
            *self.layers.of((operation, layer)) += 1;
        }
        let bound = self.bounds.get(usize::from(operation.0));
        if let (Some(spine), Some(straight)) = (bound.and_then(|bound| bound.spine), blade.straight()) {
            self.follow(segment, spine, straight);
            return;
        }
        if let (Some(columns), Some(straight)) = (bound.and_then(|bound| bound.columns), blade.straight()) {
            self.follow_column(segment, columns, straight);
            return;
        }
        let passes = bound.and_then(|bound| bound.passes);
        if let Some(Passes::Tracks(_) | Passes::Region) = passes {
            return;
        }
        if let Some(through) = Through::of(self.program, segment, passes) {
            self.pass(&through, operation, finding);
            return;
        }
        let piece = Piece::new(course, blade, self.program.stock);
        if let Some(used) = piece.edge_used(self.section.surface()) {
            self.note_edge(used, finding);
            self.measure_edge(used);
        }
        let Some(bound) = self.bounds.get(usize::from(operation.0)) else {
            return;
        };
        let part = self.part_below_top(operation, bound.part);
        if let Some(entry) = piece.entry(part) {
            self.note_entry(entry.at, entry.depth, finding);
        }
    }

    /// The next op is of this operation, with this blade.
    #[inline]
    fn enter(&mut self, operation: OperationId, tool: ToolId) {
        if self.at_work != Some((operation, tool)) {
            self.change_over(operation, tool);
        }
    }

    fn change_over(&mut self, operation: OperationId, tool: ToolId) {
        let before = self.at_work.replace((operation, tool));
        self.flanks = flanks(self.program, tool);
        self.usable_edge = self.edge_at_hand();
        if before.is_none_or(|(before, _)| before != operation) {
            self.note_half_done();
            self.note_half_done_of_columns();
        }
    }

    fn finish(mut self) -> Replay {
        self.note_half_done();
        self.note_half_done_of_columns();
        self.note_idle_slits();
        let (overcut, traceless) = (self.overcut(), self.traceless);
        let deepest = match (overcut, traceless) {
            (Some((_, depth)), Some((_, deeper))) if deeper > depth => traceless,
            (Some(_), _) => overcut,
            (None, _) => traceless,
        };
        self.findings.overcut = deepest.map(|(finding, _)| finding);
        Replay {
            surface: self.section.into_surface(),
            findings: self.findings,
            longest_edge: Length::mm(self.longest_edge),
            edges: self.edges,
            columns: self.columns.into_columns(),
            compensations: self
                .bounds
                .iter()
                .map(|bound| bound.compensation.cloned())
                .collect(),
            layers: self
                .layers
                .into_all()
                .map(|((operation, _), cuts)| (operation, cuts))
                .collect(),
            tracked: Vec::new(),
            cleared: Vec::new(),
            slit: Vec::new(),
        }
    }
}

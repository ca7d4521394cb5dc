//! What the open parameters come out as.
//!
//! This is the one place where `auto` is decided: lattice, swing, layer, step and overlap by optimisation
//! ([`optimum`]), its result rounded to the grid ([`search`]); extension and standoff from the blade. What
//! a job gives is kept as it is, whatever the result: the proof says what is wrong with it.

mod complaints;
mod grid_forms;
mod infeasible;
pub mod said;
mod search;
mod swung;

pub use grid_forms::largest_layers;
pub use search::widest_swing;
pub use swung::Swung;

use super::blade_reach::{self, Flanks};
use super::optimum::{self, Bound, Problem};
use super::refusal::Refused;
use super::time_model::TimeModel;
use crate::asked::{Avoid, Lattice, RoughVcut};
use grid_forms::{fits, widest_step};
use search::Chosen;
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::number::show;
use vcutc_geometry::columns::Columns;
use vcutc_geometry::grid;
use vcutc_job::{Auto, Direction, PlanningJob};
use vcutc_process::posture::Holder;

/// The parameters of one V-cutting operation, all decided.
#[derive(Clone, Debug, PartialEq)]
pub struct VcutParameters {
    /// How tips are laid out.
    pub lattice: Lattice,
    /// Overlap by which an open step follows from the layer.
    pub overlap: f64,
    /// Half the opening angle of the V.
    pub swing: Angle,
    /// Layer spacing.
    pub layer: Length,
    /// Spacing of tips in a layer; free layouts use a little less where that spreads tips evenly over a stretch.
    pub step: Length,
    /// How far cuts run out beyond the stock.
    pub extension: Length,
    /// Distance of the blade's middle plane from the material that stays.
    pub standoff: Length,
    /// How much higher the tip runs than the lowest V that its material side may make: `standoff / sin(swing)`, and along a spine
    /// more ([`VcutParameters::below`]).
    pub drop: Length,
    /// How far flanks that follow a spine may lie below the Vs of their tips.
    pub below: Length,
    /// No tip lies lower than this, where cuts go on down beyond the stock.
    pub lowest: Length,
    /// Slope and reach of the flanks.
    pub flanks: Flanks,
    /// How high above the tip material may stand while the blade moves or turns beside it: the blade leans over the work.
    pub clear_height: Length,
    /// Bounds that the choice of open parameters came up against.
    pub binding: Vec<Bound>,
    /// How the limit on scallop was compared with them.
    pub scallop_by: ScallopBy,
}

/// What is compared with a limit on scallop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScallopBy {
    /// The lattice's bound [Cui 12].
    Bound,
    /// What the simulated program leaves.
    Simulation,
}

/// A parameter that was left to the compiler, and what it came out as.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Its name in the language.
    pub name: &'static str,
    /// Its value with unit.
    pub value: String,
}

impl VcutParameters {
    /// Whether the blade reaches what the lattice needs far from the part.
    #[must_use]
    pub fn lattice_fits(&self) -> bool {
        fits(self.lattice, self.layer, self.step, &self.flanks)
    }

    /// What was left open and how it was decided, in the order of the language reference.
    #[must_use]
    pub fn choices(&self, asked: &RoughVcut) -> Vec<Choice> {
        let length = |name, open: Auto<Length>, value: Length| match open {
            Auto::Auto => Some(Choice {
                name,
                value: format!("{} mm", show(value.to_mm())),
            }),
            Auto::Given(_) => None,
        };
        let lattice = match asked.lattice.value {
            Auto::Auto => Some(Choice {
                name: "lattice",
                value: self.lattice.word().to_owned(),
            }),
            Auto::Given(_) => None,
        };
        let swing = match asked.swing.value {
            Auto::Auto => Some(Choice {
                name: "swing",
                value: format!("{} deg", show(self.swing.to_deg())),
            }),
            Auto::Given(_) => None,
        };
        let overlap = match (asked.overlap.value, asked.step.value) {
            // How wide the last row is, the step says.
            (Auto::Auto, Auto::Auto) if self.lattice != Lattice::Fitted => Some(Choice {
                name: "overlap",
                value: format!("{} %", show(self.overlap * 100.0)),
            }),
            (Auto::Given(_) | Auto::Auto, _) => None,
        };
        [
            lattice,
            swing,
            length("layer", asked.layer.value, self.layer),
            length("step", asked.step.value, self.step),
            overlap,
            length("extension", asked.setup.extension().value, self.extension),
            length("standoff", asked.standoff.value, self.standoff),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// What the open parameters came up against, in words: why they are not better. Empty where nothing bound them.
    #[must_use]
    pub fn reasons(&self, asked: &RoughVcut) -> Vec<&'static str> {
        let mut words: Vec<&'static str> = self
            .binding
            .iter()
            .map(|bound| match (bound, self.scallop_by) {
                (Bound::Scallop, ScallopBy::Simulation) => "the limit on scallop as simulated",
                (bound, ScallopBy::Bound | ScallopBy::Simulation) => bound_in_words(asked, *bound),
            })
            .collect();
        words.dedup();
        words
    }

    /// What the lattice leaves on the part at most by its bound, with the allowance and the standoff.
    #[must_use]
    pub fn scallop_bound(&self, asked: &RoughVcut) -> Length {
        blade_reach::scallop_bound(self.lattice, self.layer, self.step, self.flanks.slope)
            + asked.allowance.value
            + self.drop
    }

    /// Whether the limit on scallop kept the open parameters from coming out better.
    #[must_use]
    pub fn is_bound_by_scallop(&self) -> bool {
        self.binding.contains(&Bound::Scallop)
    }

    /// The same, found by simulation: where the lattice's bound breaks the limit on scallop, simulation has held it.
    #[must_use]
    pub fn found_by_simulation(self, asked: &RoughVcut) -> Self {
        let bound = self.scallop_bound(asked);
        // Fitted tips keep the limit by how they are found, whatever the bound.
        let is_broken =
            self.lattice == Lattice::Fitted || asked.limits.scallop.is_some_and(|limit| bound > limit.value);
        Self {
            scallop_by: if is_broken {
                ScallopBy::Simulation
            } else {
                self.scallop_by
            },
            ..self
        }
    }

    /// The mean-value estimate of the time [Cui 11].
    #[must_use]
    pub fn estimate(&self, job: &PlanningJob<'_>, asked: &RoughVcut) -> Duration {
        let model = self.time_model(job, asked);
        model.estimate(self.swing, self.layer, self.step_of_rows())
    }

    /// The same for so many Vs in so many layers.
    #[must_use]
    pub fn time_of(&self, job: &PlanningJob<'_>, asked: &RoughVcut, cuts: usize, layers: usize) -> Duration {
        let model = self.time_model(job, asked);
        let layers = layers.max(1) as f64;
        let (points, step) = (
            cuts as f64 / layers,
            model.width * (layers / (cuts.max(1) as f64)),
        );
        model.of_cuts(self.swing, (self.layer, step), points, layers)
    }

    /// How many Vs that estimate is made for.
    #[must_use]
    pub fn estimated_cuts(&self, job: &PlanningJob<'_>, asked: &RoughVcut) -> f64 {
        self.time_model(job, asked).cuts(self.layer, self.step_of_rows())
    }

    /// The step of all rows; of fitted lattices, of those above the last one.
    fn step_of_rows(&self) -> Length {
        match self.lattice {
            Lattice::Orthogonal | Lattice::Interlaced | Lattice::Free => self.step,
            Lattice::Fitted => self.layer * (2.0 / self.flanks.slope),
        }
    }

    /// The mean-value model of the paper for a job cut with these parameters.
    #[must_use]
    pub fn time_model(&self, job: &PlanningJob<'_>, asked: &RoughVcut) -> TimeModel {
        let stock = job.stock;
        TimeModel {
            width: stock.width,
            depth: stock.depth,
            area: job.area_to_remove(),
            clearance: asked.setup.clearance.value,
            extension: self.extension,
            rake: asked.setup.rake.value,
            cut_feed: asked.setup.cut_feed.value,
            travel_feed: asked.setup.travel_feed.value,
            reorient_rate: asked.setup.reorient_rate.value,
        }
    }
}

const fn bound_in_words(asked: &RoughVcut, bound: Bound) -> &'static str {
    let limits = &asked.limits;
    match bound {
        Bound::SwingLeast if limits.swing.least.is_none() => "the smallest swing considered",
        Bound::SwingMost if limits.swing.most.is_none() => "the largest swing considered",
        Bound::SwingLeast | Bound::SwingMost => "the limit on swing",
        Bound::LayerMost if limits.layer.most.is_none() => "the depth of the work",
        Bound::LayerLeast | Bound::LayerMost => "the limit on layer",
        Bound::StepMost if limits.step.most.is_none() => "the width of the stock",
        Bound::StepLeast | Bound::StepMost => "the limit on step",
        Bound::OverlapLeast => "Vs that just meet",
        Bound::OverlapMost => "the largest overlap considered",
        Bound::Scallop => "the limit on scallop",
        Bound::Edge if limits.edge.is_none() => "the blade's edge",
        Bound::Edge => "the limit on edge",
        Bound::Time => "the limit on time",
        Bound::Cuts => "the limit on cuts",
    }
}

/// What is known before the open parameters are chosen.
struct Resolution {
    /// Lattices to choose from.
    lattices: Vec<Lattice>,
    /// Distance of the blade's middle plane from the material that stays.
    standoff: Length,
}

/// Why nothing was decided, before anybody asks for the words: to find those takes many times as long.
#[derive(Clone, Debug)]
pub enum Refusal {
    /// The operation contradicts itself.
    Contradiction(Vec<Refused>),
    /// No parameters keep the limits of this problem.
    Conflict(Box<Problem>),
    /// Nothing stops the objective from falling.
    Unbounded,
    /// Some do, but none on the grid.
    OffGrid,
}

impl Refusal {
    /// Whether it is limits that cannot be kept together.
    #[must_use]
    pub const fn is_conflict(&self) -> bool {
        match self {
            Self::Conflict(_) | Self::OffGrid => true,
            Self::Contradiction(_) | Self::Unbounded => false,
        }
    }

    /// In the user's words.
    #[must_use]
    pub fn in_words(self, asked: &RoughVcut) -> Vec<Refused> {
        match self {
            Self::Contradiction(refused) => refused,
            Self::Conflict(problem) => {
                let bounds = optimum::conflicting(&problem);
                vec![infeasible::conflict(asked, &problem, &bounds)]
            }
            Self::Unbounded => vec![complaints::nothing_holds_the_layer(asked, &[])],
            Self::OffGrid => vec![infeasible::off_grid(asked).into()],
        }
    }
}

/// That nothing holds the layer, with limits on time that are likely to be kept.
#[must_use]
pub fn nothing_holds_the_layer(asked: &RoughVcut, times: &[Duration]) -> Refused {
    complaints::nothing_holds_the_layer(asked, times)
}

/// Decides what is open.
///
/// # Errors
/// When the operation contradicts itself, or nothing keeps its limits.
pub fn resolve(job: &PlanningJob<'_>, asked: &RoughVcut) -> Result<VcutParameters, Refusal> {
    resolve_on(job, asked, search::lattices(asked))
}

/// Decides what is open, with the lattice one of these.
///
/// # Errors
/// As for [`resolve`].
pub fn resolve_on(
    job: &PlanningJob<'_>,
    asked: &RoughVcut,
    lattices: Vec<Lattice>,
) -> Result<VcutParameters, Refusal> {
    let contradiction = |diagnostics: Vec<Diagnostic>| {
        Refusal::Contradiction(diagnostics.into_iter().map(Refused::from).collect())
    };
    let resolution = consider(asked, lattices).map_err(contradiction)?;
    let chosen = decide(job, asked, &resolution)?;
    let edge = edge_overhang(asked, chosen.swing);
    let mut diagnostics = Vec::new();
    complete(asked, resolution.standoff, edge, chosen, &mut diagnostics)
        .ok_or_else(|| contradiction(diagnostics))
}

/// What is known before.
///
/// # Errors
/// What to report where the operation contradicts itself.
fn consider(asked: &RoughVcut, lattices: Vec<Lattice>) -> Result<Resolution, Vec<Diagnostic>> {
    let mut diagnostics = Vec::new();
    complaints::check_rake(asked, &mut diagnostics);
    complaints::check_standing(asked, &mut diagnostics);
    complaints::check_given(asked, &mut diagnostics);
    let standoff = resolve_standoff(asked, &mut diagnostics);
    if diagnostics.is_empty() {
        Ok(Resolution { lattices, standoff })
    } else {
        Err(diagnostics)
    }
}

/// The lattices that are open, in the order of the language reference.
#[must_use]
pub fn open_lattices(asked: &RoughVcut) -> Vec<Lattice> {
    search::lattices(asked)
}

/// The optimisation problem that an operation poses. None when its rake or its standoff contradict its blade.
#[must_use]
pub fn problem(job: &PlanningJob<'_>, asked: &RoughVcut) -> Option<Problem> {
    let mut diagnostics = Vec::new();
    complaints::check_rake(asked, &mut diagnostics);
    let standoff = resolve_standoff(asked, &mut diagnostics);
    diagnostics
        .is_empty()
        .then(|| search::problem(job, asked, search::lattices(asked), standoff))
}

/// Lattice, swing, layer and step.
fn decide(job: &PlanningJob<'_>, asked: &RoughVcut, resolution: &Resolution) -> Result<Chosen, Refusal> {
    if let Auto::Auto = asked.layer.value
        && let Some(complaint) =
            complaints::no_room_for_scallops(asked, least_drop(asked, resolution.standoff))
    {
        return Err(Refusal::Contradiction(vec![complaint]));
    }
    search::choose(job, asked, resolution.lattices.clone(), resolution.standoff)
        .or_else(|refusal| as_given(asked, resolution, &refusal).ok_or(refusal))
}

/// The least that the standoff raises the tip by, whatever the swing.
fn least_drop(asked: &RoughVcut, standoff: Length) -> Length {
    let widest = asked
        .limits
        .swing
        .most
        .map_or(Angle::deg(90.0), |limit| limit.value);
    standoff / asked.swing.value.or(widest).sin()
}

/// Swing and layer as they are given, where the proof reports better what they conflict with: which chip is
/// not cut free, how much the contour really leaves, and how long it takes.
fn as_given(asked: &RoughVcut, resolution: &Resolution, why: &Refusal) -> Option<Chosen> {
    let (Auto::Given(swing), Auto::Given(layer)) = (asked.swing.value, asked.layer.value) else {
        return None;
    };
    if !why.is_conflict() {
        return None;
    }
    let overlap = asked.overlap.value.or(0.0);
    let flanks = flanks_at(asked, swing);
    let choices = resolution.lattices.iter().map(|&lattice| Chosen {
        lattice,
        swing,
        layer,
        step: asked.step.value.or(widest_step(lattice, layer, overlap, &flanks)),
        overlap,
        binding: Vec::new(),
    });
    let needs =
        |chosen: &Chosen| blade_reach::needed_reach(chosen.lattice, chosen.layer, chosen.step, flanks.slope);
    choices.min_by(|one, two| needs(one).total_cmp(&needs(two)))
}

/// The length of edge that may be used.
pub(super) fn usable_edge(asked: &RoughVcut) -> Length {
    let blade = asked.blade.cutting_length.value;
    asked.limits.edge.map_or(blade, |limit| limit.value.min(blade))
}

fn flanks_at(asked: &RoughVcut, swing: Angle) -> Flanks {
    let flanks = Flanks::new(
        usable_edge(asked),
        asked.blade.half_apex.value,
        asked.setup.rake.value,
        swing,
    );
    let lower = asked
        .along
        .as_ref()
        .map_or(0.0, |along| along.lower(flanks.slope));
    Flanks {
        lower: Length::mm(lower),
        ..flanks
    }
}

/// How far flanks at a slope lie below the Vs of their tips, where they follow a spine.
fn below(asked: &RoughVcut, flanks: &Flanks) -> Length {
    let along = asked.along.as_ref();
    Length::mm(along.map_or(0.0, |along| along.deviation(flanks.slope).below))
}

/// How much higher the tip runs than the V that its material side may make.
fn drop_at(asked: &RoughVcut, standoff: Length, flanks: &Flanks, swing: Angle) -> Length {
    match &asked.along {
        None => standoff / swing.sin(),
        Some(along) => standoff * along.steepness() / swing.sin() + below(asked, flanks),
    }
}

/// What follows from lattice, swing, layer and step, and from the overhang of the edge at that swing.
fn complete(
    asked: &RoughVcut,
    standoff: Length,
    edge: Length,
    chosen: Chosen,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<VcutParameters> {
    let Chosen {
        lattice,
        swing,
        layer,
        step,
        overlap,
        binding,
    } = chosen;
    let flanks = flanks_at(asked, swing);
    let lean = Lean::new(asked, swing);
    // Between the tips of the layer above, teeth stand up to this much above the tips of this one.
    let teeth = match lattice {
        Lattice::Orthogonal | Lattice::Interlaced | Lattice::Free => layer + step * (flanks.slope / 2.0),
        // Chips stand as high as both flanks reach.
        Lattice::Fitted => layer * 2.0,
    };
    let extension = resolve_extension(asked, edge, lean.overhang(teeth), diagnostics)?;
    let beyond = Beyond::of(asked, extension);
    // A job with a shorter extension than the teeth need, as in [Cui 5], accepts that the blade brushes them.
    let clear_height = (lean.clear_height(extension) - beyond.falls).max(teeth);
    Some(VcutParameters {
        lattice,
        overlap,
        swing,
        layer,
        step,
        extension,
        standoff,
        drop: drop_at(asked, standoff, &flanks, swing),
        below: below(asked, &flanks),
        lowest: beyond.sinks,
        flanks,
        clear_height,
        binding,
        scallop_by: ScallopBy::Bound,
    })
}

/// How far the edge lies over the work while it cuts [Cui 5] and while it turns beside it; the whole cutting length, as deep
/// cuts use it.
fn edge_overhang(asked: &RoughVcut, swing: Angle) -> Length {
    let (length, half_apex) = (asked.blade.cutting_length.value, asked.blade.half_apex.value);
    // Pitched, an edge reaches farther by as much of it as stands up.
    let pitched = length * pitch(asked).sin();
    let cutting = length * (asked.setup.rake.value - half_apex).cos() + pitched;
    match asked.setup.direction().value {
        Direction::Alternate => {
            let holder = Holder {
                swing: pitched_swing(asked, swing),
                rake: asked.setup.rake.value,
                edges: asked.blade.edges,
            };
            let turning = match asked.avoid.value {
                Avoid::Lift => holder.turning_overhang(length, half_apex),
                Avoid::Swing => holder.overhang_up_to_its_swing(length, half_apex),
            };
            cutting.max(turning + pitched)
        }
        // The blade turns above the work only.
        Direction::Forward | Direction::Backward => cutting,
    }
}

/// How far cuts along a spine go down beyond the stock.
#[derive(Clone, Copy, Default)]
struct Beyond {
    /// From the side of the stock on.
    falls: Length,
    /// Below the lowest place of the spine over the stock.
    sinks: Length,
}

impl Beyond {
    fn of(asked: &RoughVcut, extension: Length) -> Self {
        let Some(along) = &asked.along else {
            return Self::default();
        };
        let [falls, sinks] = along.guide.down_beyond(extension.to_mm()).map(Length::mm);
        Self {
            falls,
            // Rounded to the grid.
            sinks: sinks + Length::mm(2.0 * grid::SPACING),
        }
    }
}

/// How the blade leans over the work while its tip is beside it. Above the cutting length it is taken to go on along the tool
/// axis as wide as it is there.
struct Lean {
    /// Half the blade's width at its full cutting length, measured along y: `L sin(beta) / sin(theta)`.
    half_width: Length,
    /// How far the tool axis leans along y for each millimetre of height: `cot(theta) / cos(alpha)`.
    per_height: f64,
}

impl Lean {
    fn new(asked: &RoughVcut, swing: Angle) -> Self {
        let (blade, rake) = (&asked.blade, asked.setup.rake.value);
        let level = Self {
            half_width: blade.cutting_length.value * (blade.half_apex.value.sin() / rake.sin()),
            per_height: rake.cos().max(0.0) / (rake.sin() * swing.cos()),
        };
        let pitch = pitch(asked);
        if pitch == Angle::ZERO {
            return level;
        }
        // Pitched towards the work, by less than 90 degrees in all: STEEPEST is 45 and rakes of daggers are above that.
        let lean = Angle::rad(libm::atan(level.per_height)) + pitch;
        let most = Angle::deg(85.0);
        let lean = lean.min(most);
        Self {
            half_width: level.half_width / lean.cos(),
            per_height: lean.tan(),
        }
    }

    /// How far the blade lies over the work at a height above the tip.
    fn overhang(&self, height: Length) -> Length {
        self.half_width + height * self.per_height
    }

    /// The height up to which the blade is clear of the work with its tip that far beside it.
    fn clear_height(&self, extension: Length) -> Length {
        let upright = 1e-9;
        Length::mm((extension - self.half_width).to_mm().max(0.0) / self.per_height.max(upright))
    }
}

/// How high the end of a shank of 1 mm stands above its tip at least.
const STANDS: f64 = 0.05;

/// The widest swing, in whole thousandths of a degree, at which a shank stands up on slopes up to that, as it is held by a rake. Where a
/// cut falls by `mu` the shank rises by `sin(rake) cos(a') cos(mu) - cos(rake) sin(mu)`, with `tan(a') = tan(swing) / cos(mu)`. None
/// where it stands at no swing.
#[must_use]
pub fn widest_standing(rake: Angle, steepest: f64) -> Option<Angle> {
    let mu = Angle::rad(libm::atan(steepest));
    let least = (STANDS + rake.cos() * mu.sin()) / (rake.sin() * mu.cos());
    let opened = Angle::rad(libm::acos(least.clamp(-1.0, 1.0)));
    let widest = Angle::rad(libm::atan(opened.tan() * mu.cos()));
    let thousandths = (widest.to_deg() * 1000.0).floor();
    (least < 1.0 && thousandths > 0.0).then(|| Angle::deg(thousandths / 1000.0))
}

/// How many times as steeply as columns shear flanks rise at least whose swing is chosen, so that they pass above older tips
/// a few steps away. A judgement, from no source.
const STEEPER_THAN_SHEAR: f64 = 3.0;

/// The least of the widest swings along columns: what twists more does so on a few places only.
const WIDE_IN_ANY_COLUMNS: Angle = Angle::deg(35.0);

/// The widest swing to choose along columns, in whole thousandths of a degree.
#[must_use]
pub fn widest_in_columns(columns: &Columns) -> Angle {
    let widest = libm::atan(1.0 / (STEEPER_THAN_SHEAR * columns.shear()));
    let widest = Angle::rad(widest).max(WIDE_IN_ANY_COLUMNS);
    Angle::deg((widest.to_deg() * 1000.0).floor() / 1000.0)
}

/// The steepest pitch of the blade at the sides of the stock.
fn pitch(asked: &RoughVcut) -> Angle {
    let Some(along) = &asked.along else {
        return Angle::ZERO;
    };
    Angle::rad(libm::atan(along.guide.steepest_at_sides()))
}

/// Half the angle of a V, seen along a pitched way, that has this swing seen along y: `tan(a) = tan(swing) / cos(pitch)`.
fn pitched_swing(asked: &RoughVcut, swing: Angle) -> Angle {
    let pitch = pitch(asked);
    if pitch == Angle::ZERO {
        swing
    } else {
        Angle::rad(libm::atan(swing.tan() / pitch.cos()))
    }
}

/// Half the blade's thickness, or what is given: less would let the blade's side enter the part.
fn resolve_standoff(asked: &RoughVcut, diagnostics: &mut Vec<Diagnostic>) -> Length {
    let least = asked.blade.thickness.value / 2.0;
    match asked.standoff.value {
        Auto::Auto => least,
        Auto::Given(standoff) => {
            if standoff < least {
                diagnostics.push(complaints::standoff_too_small(asked, standoff));
            }
            standoff
        }
    }
}

/// The extension on the grid. The blade lies over the work by its edge, and above the edge by its body up to the teeth of
/// the layer above; given extensions need only clear the edge.
fn resolve_extension(
    asked: &RoughVcut,
    edge: Length,
    body_overhang: Length,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Length> {
    let on_grid = |extension: Length| Length::mm(grid::up(extension.to_mm()));
    match asked.setup.extension().value {
        Auto::Auto => Some(on_grid(body_overhang.max(edge) + asked.setup.run_out.value)),
        Auto::Given(extension) if on_grid(extension) >= on_grid(edge) => Some(on_grid(extension)),
        Auto::Given(extension) => {
            diagnostics.push(complaints::extension_too_short(asked, extension, on_grid(edge)));
            None
        }
    }
}

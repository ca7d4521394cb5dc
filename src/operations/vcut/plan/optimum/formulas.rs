//! The formulas of the problem at given swing and overlap, for numbers and for boxes of numbers.
//!
//! With `t = tan(swing)`, `rho = 1 - overlap` and `u = rho t` a step is `s = 2 u h` [Cui 6, 7], so for given `t` and `rho` all
//! lengths grow with the layer `h`: the reach it needs is `kappa h`, the scallop it leaves `sigma h`. Every bound is then a
//! bound on `h`, and the time falls with `h` (`docs/process.md`, "The optimum"), so the thickest layer is the best.

use super::problem::{Extension, Problem, Range};
use crate::asked::{Formulas, Lattice};
use vcutc_backend_api::units::Length;
use vcutc_geometry::number::Scalar;

/// Shares this close below a jump of the reach count as the jump: the same nanometre in a millimetre that simulation grants.
const AT_JUMP: f64 = 1e-9;

/// Layers and steps are kept between a picometre and a kilometre.
const LENGTHS: [f64; 2] = [1e-9, 1e6];

/// Steps wider than this many stocks are not considered unless asked for: the model's way between layers would turn negative.
const WIDEST: f64 = 6.0;

/// Where in the lattice's shape: `t`, `rho` and `u`, of which two decide the third.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape<N> {
    /// Tangent of the swing.
    pub(super) tangent: N,
    /// Share of the widest step: one less the overlap.
    pub(super) share: N,
    /// Half the step over the layer.
    pub(super) aspect: N,
}

/// How many older tips a flank passes under, one more: the step of the reach's saw-tooth that a share lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tooth {
    /// One reach whatever the share.
    Any,
    /// The flank comes out beyond the tip of this number.
    Beyond(u32),
    /// Beyond the tip of this number or a later one.
    Later(u32),
}

/// Which of the bounds that come with the shape a layer is taken as thick as. Without one of them it comes out thicker, and
/// what it costs no larger: a bound from below, and smooth where the whole has a kink.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keeping {
    Both,
    Reach,
    Scallop,
    Neither,
}

/// What asks for a least layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asked {
    Layer,
    Step,
}

/// How flanks stand in the lattice.
#[derive(Clone, Copy, Debug)]
struct Flank<N> {
    /// Secant of the swing.
    secant: N,
    /// Reach for each millimetre of layer.
    factor: N,
}

/// What the layer of a shape is bounded by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds<N> {
    flank: Flank<N>,
    pub(super) by_reach: N,
    pub(super) by_scallop: Option<N>,
    /// The least layer that is asked for, and the largest.
    pub(super) least: N,
    most: N,
}

/// What the cost of cuts is made of, each as tightly as it is known.
struct Cut<N> {
    layer: N,
    half_step: N,
    /// Steps in the stock's width.
    points: N,
    /// Layers in its mean depth.
    layers: N,
    extension: N,
    turn: N,
}

/// What a shape costs with some layer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cost<N> {
    layer: N,
    pub(super) time: N,
    pub(super) cuts: N,
}

/// What the layer is bounded by, and what it costs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outcome<N> {
    /// The thickest layer.
    pub(super) layer: N,
    /// By how much the bounds are kept, as shares of them: all are positive or nothing where the bounds can be kept.
    pub(super) slack: [N; 4],
    /// Time by the model, in s.
    pub(super) time: N,
    /// Cuts by the model.
    pub(super) cuts: N,
}

/// The problem in plain numbers (mm, s, rad), for one lattice.
#[derive(Clone, Debug)]
pub(super) struct Model {
    lattice: Lattice,
    formulas: Formulas,
    width: f64,
    /// Mean depth of what is to be removed: A / W.
    depth: f64,
    /// What of the way to the next layer does not depend on the parameters, in mm.
    change: f64,
    /// What of the time of a cut does not depend on the parameters: 2 D / v1.
    pass: f64,
    cut_feed: f64,
    travel_feed: f64,
    rate: f64,
    sin_rake: f64,
    cos_rake: f64,
    /// Reach of an upright edge of the longest allowed length.
    upright_reach: f64,
    /// Of an edge, the part along y over the part across: cot(rake - half apex).
    along: f64,
    sin_lead: f64,
    /// Half the blade's width at its full length, along y.
    half_width: f64,
    extension: Extension,
    standoff: f64,
    allowance: f64,
    pub(super) scallop: Option<f64>,
    pub(super) time: Option<f64>,
    pub(super) cuts: Option<f64>,
    /// Whether less time for thicker layers is certain as far as reach or scallop alone allow them, so that the largest layer
    /// and step need no look.
    tame: bool,
    /// Layers thicker than this are only considered where the bounds ask for them.
    pub(super) thickest: f64,
    pub(super) layer: [f64; 2],
    pub(super) step: [f64; 2],
    /// Ranges of tangent, share and aspect.
    pub(super) ranges: Shape<[f64; 2]>,
}

fn millimetres(range: Range<Length>) -> [f64; 2] {
    [range.least.to_mm(), range.most.to_mm()].map(|value| value.clamp(LENGTHS[0], LENGTHS[1]))
}

impl Model {
    pub(super) fn new(problem: &Problem, lattice: Lattice) -> Self {
        let work = &problem.work;
        let lead = work.rake - work.half_apex;
        let longest = problem
            .edge
            .map_or(work.cutting_length, |edge| edge.min(work.cutting_length));
        let (width, depth) = (work.width.to_mm(), work.area.to_mm2() / work.width.to_mm());
        let layer = millimetres(problem.layer);
        let [narrowest, widest] = millimetres(problem.step);
        let step = [narrowest, widest.min((WIDEST * width).max(narrowest))];
        let (steepest, share) = (Self::tangents(problem), Self::shares(problem));
        Self {
            lattice,
            formulas: problem.formulas,
            width,
            depth,
            change: 2.0 * work.clearance.to_mm() + 2.0 * depth + width,
            pass: 2.0 * work.depth.to_mm() / work.cut_feed.to_mm_per_s(),
            cut_feed: work.cut_feed.to_mm_per_s(),
            travel_feed: work.travel_feed.to_mm_per_s(),
            rate: work.reorient_rate.to_rad_per_s(),
            sin_rake: work.rake.sin(),
            cos_rake: work.rake.cos(),
            upright_reach: longest.to_mm() * lead.sin(),
            along: lead.cos() / lead.sin(),
            sin_lead: lead.sin(),
            half_width: work.cutting_length.to_mm() * work.half_apex.sin() / work.rake.sin(),
            extension: work.extension,
            standoff: work.standoff.to_mm(),
            allowance: work.allowance.to_mm(),
            scallop: problem.scallop.map(Length::to_mm),
            time: problem.time.map(vcutc_backend_api::units::Duration::to_s),
            cuts: problem.cuts,
            tame: false,
            thickest: f64::INFINITY,
            layer,
            step,
            ranges: Shape {
                tangent: steepest,
                share,
                aspect: [step[0] / (2.0 * layer[1]), step[1] / (2.0 * layer[0])],
            },
        }
        .no_thicker_than_pays(work.depth.to_mm())
    }

    fn tangents(problem: &Problem) -> [f64; 2] {
        // Within a thousandth of a degree of flat and of upright nothing is cut.
        [problem.swing.least, problem.swing.most].map(|swing| swing.tan().clamp(2e-5, 5e4))
    }

    fn shares(problem: &Problem) -> [f64; 2] {
        [problem.overlap.most, problem.overlap.least].map(|overlap| (1.0 - overlap).max(1e-3))
    }

    /// Where fewer than one layer is counted as one, a thicker layer still saves steps, but asks for a longer extension.
    /// That pays for certain where the extension is no longer than the stock is along the cuts, in proportion to its
    /// steps; elsewhere the layer stays at one that is counted as one.
    fn no_thicker_than_pays(mut self, along: f64) -> Self {
        let edge = self.upright_reach * self.along;
        let grows = match self.extension {
            Extension::Fixed(_) => 0.0,
            Extension::EdgeInUse => edge,
            Extension::Leaning { .. } => 2.0 * self.upright_reach * self.cos_rake.abs() / self.sin_rake,
        };
        let [flattest, steepest] = self.ranges.tangent;
        let thickest = self.layer[1].min(self.upright_reach / (1.0 + flattest * flattest).sqrt());
        let widest = self.step[1].min(2.0 * self.ranges.share[1] * steepest * thickest);
        if self.width * along < widest * grows {
            self.thickest = self.depth / 1.5;
        }
        let by_reach = 2.0 * self.ranges.share[1] * steepest * self.upright_reach;
        let alone = by_reach.max(self.scallop.map_or(0.0, |scallop| 2.0 * scallop));
        self.tame = self.width * along >= alone.max(widest) * grows && alone <= WIDEST * self.width;
        self
    }

    /// The first step of the saw-tooth within the range of shares, and the rest.
    pub(super) fn teeth(&self) -> impl Iterator<Item = Tooth> + use<> {
        let teeth = match (self.formulas, self.lattice) {
            (
                Formulas::Paper,
                Lattice::Orthogonal | Lattice::Interlaced | Lattice::Free | Lattice::Fitted,
            )
            | (Formulas::Exact, Lattice::Free) => [Some(Tooth::Any), None],
            (Formulas::Exact, Lattice::Orthogonal | Lattice::Interlaced | Lattice::Fitted) => {
                let first = self.beyond(self.ranges.share[1]);
                let later = (self.beyond(self.ranges.share[0]) > first).then(|| Tooth::Later(first + 1));
                [Some(Tooth::Beyond(first)), later]
            }
        };
        teeth.into_iter().flatten()
    }

    /// The number of the tip beyond which a flank comes out.
    pub(super) fn beyond(&self, share: f64) -> u32 {
        let number = match self.lattice {
            Lattice::Orthogonal => past_jump(0.5 / share),
            Lattice::Interlaced | Lattice::Fitted => past_jump(0.5 / share + 0.5),
            Lattice::Free => 1.0,
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at least 1, at most half of one over the least share"
        )]
        {
            number as u32
        }
    }

    /// The least share at which flanks come out beyond the tip of that number, and in which distance of one
    /// layer's steps that tip is.
    fn jump(&self, number: u32) -> (f64, f64) {
        let number = f64::from(number);
        let steps = match self.lattice {
            Lattice::Orthogonal | Lattice::Free => number,
            Lattice::Interlaced | Lattice::Fitted => number - 0.5,
        };
        (0.5 / steps, steps)
    }

    /// The shares of a step of the saw-tooth, as far as they are allowed.
    pub(super) fn shares_of(&self, tooth: Tooth) -> [f64; 2] {
        let [least, most] = self.ranges.share;
        let above = |number: u32| {
            if number > 1 {
                self.jump(number - 1).0.min(most)
            } else {
                most
            }
        };
        let [low, high] = match tooth {
            Tooth::Any => [least, most],
            Tooth::Beyond(number) => [self.jump(number).0.max(least), above(number)],
            Tooth::Later(number) => [least, above(number)],
        };
        // At a jump but for rounding.
        [low.min(high), high]
    }

    /// A wider stretch of the saw-tooth as its first step and the rest.
    pub(super) fn divided(&self, tooth: Tooth) -> Option<[Tooth; 2]> {
        match tooth {
            Tooth::Any | Tooth::Beyond(_) => None,
            Tooth::Later(number) => {
                let last = self.beyond(self.ranges.share[0]);
                let rest = if number + 1 < last {
                    Tooth::Later(number + 1)
                } else {
                    Tooth::Beyond(number + 1)
                };
                Some([Tooth::Beyond(number), rest])
            }
        }
    }

    /// Reach for each millimetre of layer: [Cui II.B], or what is derived in `plan::blade_reach`.
    pub(super) fn reach_factor(&self, share: f64) -> f64 {
        self.factor(share, Tooth::Beyond(self.beyond(share)))
    }

    fn factor<N: Scalar>(&self, share: N, tooth: Tooth) -> N {
        match (self.formulas, self.lattice, tooth) {
            (Formulas::Paper, Lattice::Orthogonal, _) => N::constant(1.5),
            (Formulas::Paper, Lattice::Interlaced | Lattice::Fitted, _) => N::constant(1.0),
            (Formulas::Paper, Lattice::Free, _) => N::constant(2.0),
            (Formulas::Exact, Lattice::Free, _) | (Formulas::Exact, _, Tooth::Any) => share.plus(1.0),
            (
                Formulas::Exact,
                Lattice::Orthogonal | Lattice::Interlaced | Lattice::Fitted,
                Tooth::Beyond(number),
            ) => {
                let (_, steps) = self.jump(number);
                share.times(steps).plus(0.5).greater(N::constant(1.0))
            }
            (
                Formulas::Exact,
                Lattice::Orthogonal | Lattice::Interlaced | Lattice::Fitted,
                Tooth::Later(_),
            ) => share.plus(1.0).or_down_to_one(),
        }
    }

    /// Scallop for each millimetre of layer: [Cui 12], or what is derived in `docs/process.md`, "Scallop".
    pub(super) fn scallop_factor<N: Scalar>(&self, shape: Shape<N>) -> N {
        let drop = shape.share.plus(1.0);
        match self.lattice {
            Lattice::Orthogonal | Lattice::Free => (shape.aspect * shape.aspect + drop * drop).root(),
            Lattice::Interlaced | Lattice::Fitted => match self.formulas {
                Formulas::Paper => drop,
                Formulas::Exact => drop.greater((shape.aspect * shape.aspect).plus(1.0).root()),
            },
        }
    }

    /// What stays on the part whatever the lattice: allowance and drop of the tip.
    pub(super) fn stays(&self, tangent: f64) -> f64 {
        self.allowance + self.drop(tangent)
    }

    fn drop<N: Scalar>(&self, tangent: N) -> N {
        tangent.over_hypotenuse(1.0).under(self.standoff)
    }

    /// The edge in use.
    pub(super) fn edge(&self, shape: Shape<f64>, layer: f64) -> f64 {
        self.reach_factor(shape.share) * layer * (1.0 + shape.tangent * shape.tangent).sqrt() / self.sin_lead
    }

    fn flank<N: Scalar>(&self, shape: Shape<N>, tooth: Tooth) -> Flank<N> {
        Flank {
            secant: shape.tangent.hypotenuse(1.0),
            factor: self.factor(shape.share, tooth),
        }
    }

    /// The layer that the blade reaches.
    fn by_reach<N: Scalar>(&self, flank: Flank<N>) -> N {
        (flank.secant * flank.factor).under(self.upright_reach)
    }

    /// What bounds the layer of a shape.
    pub(super) fn bounds<N: Scalar>(&self, shape: Shape<N>, tooth: Tooth) -> Bounds<N> {
        let flank = self.flank(shape, tooth);
        let by_reach = self.by_reach(flank);
        let room = self.scallop.map(|scallop| {
            let room = N::constant(scallop - self.allowance);
            if self.standoff > 0.0 {
                room - self.drop(shape.tangent)
            } else {
                room
            }
        });
        let by_scallop = room.map(|room| room / self.scallop_factor(shape));
        let least = N::constant(self.layer[0]).greater(shape.aspect.under(0.5 * self.step[0]));
        let most = N::constant(self.layer[1]).lesser(shape.aspect.under(0.5 * self.step[1]));
        Bounds {
            flank,
            by_reach,
            by_scallop,
            least,
            most: most.lesser(N::constant(self.thickest)),
        }
    }

    /// The layer that is asked for at least.
    pub(super) fn asked<N: Scalar>(&self, shape: Shape<N>, asked: Asked) -> N {
        match asked {
            Asked::Layer => N::constant(self.layer[0]),
            Asked::Step => shape.aspect.under(0.5 * self.step[0]),
        }
    }

    /// The layer that some of the bounds allow.
    fn layer<N: Scalar>(&self, bounds: &Bounds<N>, keeping: Keeping) -> N {
        if self.given() {
            return bounds.least;
        }
        let asked = |cap: N, layer: N| {
            // Where the bounds do not allow the least layer nothing is kept, and what it would cost says nothing.
            layer.greater(bounds.least).lesser(cap)
        };
        let capped = |cap: N| {
            if self.tame {
                cap
            } else {
                asked(cap, cap.lesser(bounds.most))
            }
        };
        // Where the scallop has no room at all, some layer that is valid.
        let floor = N::constant(self.layer[0]);
        match (keeping, bounds.by_scallop.map(|most| most.greater(floor))) {
            (Keeping::Both, Some(by_scallop)) => {
                let cap = bounds.by_reach.lesser(by_scallop);
                asked(cap, cap.lesser(bounds.most))
            }
            (Keeping::Both, None) => asked(bounds.by_reach, bounds.by_reach.lesser(bounds.most)),
            (Keeping::Reach, _) => capped(bounds.by_reach),
            (Keeping::Scallop, Some(by_scallop)) => capped(by_scallop),
            (Keeping::Scallop, None) | (Keeping::Neither, _) => bounds.most.greater(bounds.least),
        }
    }

    /// What a shape costs with the layer that some of the bounds allow.
    pub(super) fn cost<N: Scalar>(&self, shape: Shape<N>, bounds: &Bounds<N>, keeping: Keeping) -> Cost<N> {
        let layer = self.layer(bounds, keeping);
        let reached = match keeping {
            Keeping::Both | Keeping::Reach if !self.given() => self.reached(shape, bounds.flank),
            Keeping::Both | Keeping::Reach | Keeping::Scallop | Keeping::Neither => f64::INFINITY,
        };
        let half_step = (shape.aspect * layer).known_below(reached);
        self.cost_of(&Cut {
            layer,
            half_step,
            points: half_step.under(0.5 * self.width),
            layers: layer.under(self.depth),
            extension: self.extension(shape, bounds.flank, layer),
            turn: self.turn(shape.tangent),
        })
    }

    /// The widest half step that the blade reaches in a box: `rho t h` is `rho` times the sine of the swing and the length of
    /// edge that `h` is of, which says more of wide boxes than the product of their highest values does.
    fn reached<N: Scalar>(&self, shape: Shape<N>, flank: Flank<N>) -> f64 {
        let longest = self.upright_reach / flank.factor.lowest();
        // For roundings, and for what still counts as reached.
        shape.share.highest() * shape.tangent.highest().over_hypotenuse(1.0) * longest * (1.0 + 1e-10)
    }

    /// What cuts cost [Cui 8-11]: two passes with their run-outs, the turn between them, and the turn or the step to the next
    /// cut, whichever takes longer.
    fn cost_of<N: Scalar>(&self, cut: &Cut<N>) -> Cost<N> {
        let layers = cut.layers.plus(-0.5).greater(N::constant(1.0));
        let cuts = cut.points.plus(0.5) * layers;
        let sideways = cut.half_step.times(2.0 / self.travel_feed);
        let each =
            cut.extension.times(4.0 / self.cut_feed).plus(self.pass) + cut.turn + cut.turn.greater(sideways);
        let change = (cut.layer + cut.half_step).times(-1.0).plus(self.change);
        Cost {
            layer: cut.layer,
            time: cuts * each + (layers * change).times(1.0 / self.travel_feed),
            cuts,
        }
    }

    /// The result of a shape.
    pub(super) fn outcome<N: Scalar>(&self, shape: Shape<N>, tooth: Tooth, keeping: Keeping) -> Outcome<N> {
        let bounds = self.bounds(shape, tooth);
        let cost = self.cost(shape, &bounds, keeping);
        let one = N::constant(1.0);
        // Not `limit / value - 1`: over a wide box the enclosure of the time reaches below nothing.
        let kept =
            |limit: Option<f64>, value: N| limit.map_or(one, |limit| value.times(-1.0 / limit).plus(1.0));
        Outcome {
            layer: cost.layer,
            slack: [
                bounds.by_reach / bounds.least - one,
                bounds
                    .by_scallop
                    .map_or(one, |by_scallop| by_scallop / bounds.least - one),
                kept(self.time, cost.time),
                kept(self.cuts, cost.cuts),
            ],
            time: cost.time,
            cuts: cost.cuts,
        }
    }

    /// Whether no shape costs less than its swing does [`at_widest`](Self::at_widest): thicker layers cost less where the model
    /// is tame, and on one layer wider steps do as long as the overlap changes neither the reach nor the extension
    /// (`docs/process.md`, "The optimum").
    pub(super) fn is_least_at_widest(&self) -> bool {
        let reaches_alike = match self.formulas {
            Formulas::Paper => true,
            Formulas::Exact => false,
        };
        let runs_out_alike = match self.extension {
            Extension::Fixed(_) | Extension::EdgeInUse => true,
            Extension::Leaning { .. } => false,
        };
        reaches_alike && runs_out_alike && self.tame && !self.given()
    }

    /// The shape of a swing with the widest step.
    pub(super) fn widest(&self, tangent: f64) -> Shape<f64> {
        let share = self.ranges.share[1];
        Shape {
            tangent,
            share,
            aspect: tangent * share,
        }
    }

    /// What a swing costs with the thickest layer that the blade reaches and the widest step, whatever else is bounded. All of
    /// the edge is in use then, so the extension is the same for all swings.
    pub(super) fn at_widest<N: Scalar>(&self, tangent: N) -> Cost<N> {
        let share = self.ranges.share[1];
        let upright = self.upright_reach / self.reach_factor(share);
        let (secant, sine) = (tangent.hypotenuse(1.0), tangent.over_hypotenuse(1.0));
        let extension = match self.extension {
            Extension::Fixed(length) => length.to_mm(),
            Extension::EdgeInUse | Extension::Leaning { .. } => self.upright_reach * self.along,
        };
        self.cost_of(&Cut {
            layer: secant.under(upright),
            half_step: sine.times(share * upright),
            points: sine.under(0.5 * self.width / (share * upright)),
            layers: secant.times(self.depth / upright),
            extension: N::constant(extension),
            turn: self.turn(tangent),
        })
    }

    /// Whether layer or step is one value: the shape then decides both.
    pub(super) fn given(&self) -> bool {
        self.layer[0] >= self.layer[1] || self.step[0] >= self.step[1]
    }

    /// Time of a turn: phi = 2 acos(cos(alpha) sin(theta)), of which the arc is half.
    fn turn<N: Scalar>(&self, tangent: N) -> N {
        tangent
            .hypotenuse(self.cos_rake)
            .times(1.0 / self.sin_rake)
            .arc_tangent()
            .times(2.0 / self.rate)
    }

    /// How far a cut runs out.
    fn extension<N: Scalar>(&self, shape: Shape<N>, flank: Flank<N>, layer: N) -> N {
        match self.extension {
            Extension::Fixed(length) => N::constant(length.to_mm()),
            Extension::EdgeInUse => (flank.factor * layer * flank.secant).times(self.along),
            Extension::Leaning { edge, run_out } => {
                let teeth = layer * shape.share.plus(1.0);
                let per_height = flank.secant.times(self.cos_rake.max(0.0) / self.sin_rake);
                (teeth * per_height)
                    .plus(self.half_width)
                    .greater(N::constant(edge.to_mm()))
                    .plus(run_out.to_mm())
            }
        }
    }
}

/// Rounded up, but at a jump but for rounding errors to the jump; at least 1.
fn past_jump(number: f64) -> f64 {
    (number * (1.0 - AT_JUMP)).ceil().max(1.0)
}

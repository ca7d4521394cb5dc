//! Cuts that follow a part: jobs for them, and what their programs do to the stock, by the blade in space and by dexels, which know neither
//! spines nor columns nor sections.

use crate::pipeline::{Files, compile};
use vcutc::diagnostics::Code;
use vcutc::driver::Outcome;
use vcutc::job::PlannedJob;
use vcutc::process::verdict::replay;
use vcutc::simulation::prove::Findings;
use vcutc_backend_api::ir::{Action, Joint, Op, Program, Site, Straight};
use vcutc_backend_api::verify::verify;

pub(crate) const WIDTH: f64 = 100.0;
pub(crate) const DEPTH: f64 = 150.0;
pub(crate) const HEIGHT: f64 = 70.0;
pub(crate) const ALLOWANCE: f64 = 0.4;

pub(crate) const REST: &str = "job \"shell\"
stock { size = (100 mm, 150 mm, 70 mm) }
blade dagger {
  cutting_length = 25 mm
  half_apex      = 7.13 deg
  thickness      = 1.2 mm
  edges          = double
}
";

pub(crate) fn rough(more: &str) -> String {
    format!(
        "rough vcut {{
  blade     = dagger
  rake      = 60 deg
  allowance = {ALLOWANCE} mm
  feed      {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
  clearance = 10 mm
  {more}
}}
"
    )
}

/// Everything given, so that nothing is searched.
pub(crate) const GIVEN: &str = "lattice = orthogonal\n  swing = 40 deg\n  layer = 8 mm\n  step = 9 mm\n  order = point\n  sequence = rows\n  \
                     residual = mixed";

pub(crate) fn compiled(surface: &str, more: &str) -> Outcome {
    let text = format!("{REST}surface {{ {surface} }}\n{}", rough(more));
    compile("job.vcut", &Files::default().with("job.vcut", text))
}

/// The formula of a part: the sum of a wave across and one along, a twist, which straight lines follow, and a warp, which bends it along y the
/// one way on one side and the other way on the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    pub(crate) middle: f64,
    pub(crate) across: f64,
    pub(crate) along: f64,
    pub(crate) slope: f64,
    pub(crate) twist: f64,
    pub(crate) warp: f64,
}

/// A measure of parts that do not bend so.
pub(crate) const NONE: f64 = 1e9;

impl Part {
    pub(crate) const LEVEL: Self = Self {
        middle: 38.0,
        across: NONE,
        along: NONE,
        slope: 0.0,
        twist: NONE,
        warp: NONE,
    };

    pub(crate) fn height(self, x: f64, y: f64) -> f64 {
        let (u, v) = (x - WIDTH / 2.0, y - DEPTH / 2.0);
        let sum = self.middle - u * u / self.across - v * v / self.along + v * self.slope;
        sum + u * v / self.twist + u * v * v / self.warp
    }

    pub(crate) fn surface(self) -> String {
        let [u, v] = ["(x - 50 mm)", "(y - 75 mm)"];
        let Self {
            middle,
            across,
            along,
            slope,
            twist,
            warp,
        } = self;
        format!(
            "z(x, y) = {middle} mm - {u}^2 / ({across} mm) - {v}^2 / ({along} mm) + {v} * ({slope}) + {u} * {v} / ({twist} mm) \
             + {u} * {v}^2 / ({warp} mm * 1 mm)"
        )
    }
}

/// A rough operation with a lattice of these measures, everything given.
pub(crate) fn laid_out(lattice: [f64; 3], residual: &str, follow: &str) -> String {
    let [swing, layer, step] = lattice;
    rough(&format!(
        "lattice = orthogonal\n  swing = {swing:.3} deg\n  layer = {layer:.3} mm\n  step = {step:.3} mm\n  order = point\n  \
         sequence = rows\n  residual = {residual}\n  follow = {follow}"
    ))
}

/// A program of a job that is proven or refused; with a blade of one edge or of two.
pub(crate) fn outcome_of(part: Part, is_single: bool, rough: &str) -> Outcome {
    let edges = if is_single { "single" } else { "double" };
    let text = format!(
        "{}surface {{ {} }}\n{rough}",
        REST.replace("double", edges),
        part.surface()
    );
    compile("job.vcut", &Files::default().with("job.vcut", text))
}

/// Whether a lattice asks for more than the blade has, which the proof says.
pub(crate) fn is_refused(outcome: &Outcome) -> bool {
    codes(outcome)
        .iter()
        .any(|code| matches!(code, Code::ChipNotFreed | Code::BladeBlocked | Code::NothingToCut))
}

/// The blade in a place: its tip, its two edges (of unit length), and the normal of its plane.
#[derive(Clone, Copy)]
struct Held {
    tip: [f64; 3],
    edges: [[f64; 3]; 2],
    normal: [f64; 3],
}

impl Held {
    fn at(&self, [lead, share]: [f64; 2], aside: f64) -> [f64; 3] {
        let [one, other] = self.edges;
        core::array::from_fn(|i| {
            self.tip[i] + lead * (share * one[i] + (1.0 - share) * other[i]) + aside * self.normal[i]
        })
    }
}

/// One flank of a V: the blade from one end of its cut to the other, as a controller takes it from place to place.
pub(crate) struct Flank {
    site: Site,
    held: Vec<Held>,
}

pub(crate) fn program_of(outcome: &Outcome) -> &Program {
    outcome.compiled.as_ref().unwrap().program.verified().program()
}

pub(crate) fn codes(outcome: &Outcome) -> Vec<Code> {
    outcome.diagnostics.iter().map(|found| found.code).collect()
}

pub(crate) fn blade_of(program: &Program) -> Straight {
    program.blades[0].straight().unwrap()
}

pub(crate) fn flanks(program: &Program, apart: f64) -> Vec<Flank> {
    let ends = blade_of(program).edge_ends();
    let long = blade_of(program).cutting_length.to_mm();
    let mut flanks: Vec<Flank> = Vec::new();
    let mut goes_on = false;
    for segment in program.segments() {
        let (Action::Follow { joint, .. }, Some(line)) = (segment.op.action, segment.line()) else {
            continue;
        };
        if !goes_on {
            flanks.push(Flank {
                site: segment.op.site,
                held: Vec::new(),
            });
        }
        goes_on = joint == Joint::Through;
        let count = ((line.to.tip.y - line.from.tip.y).abs() / apart).ceil().max(1.0);
        for step in 0..=(count as u32) {
            let frame = line.frame_at(program, f64::from(step) / count).unwrap();
            let matrix = frame.orientation.matrix();
            let seen = |vector: [f64; 3]| matrix.map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum());
            flanks.last_mut().unwrap().held.push(Held {
                tip: frame.origin.to_array(),
                edges: ends.map(|end| seen(end.map(|part| part / long))),
                normal: matrix.map(|row| row[1]),
            });
        }
    }
    flanks
}

/// How far above the part the blade stays, where it is over the stock: along z, at points of both its sides.
pub(crate) fn least_gap(flanks: &[Flank], blade: Straight, height: &dyn Fn(f64, f64) -> f64) -> f64 {
    let (long, half) = (blade.cutting_length.to_mm(), blade.thickness.to_mm() / 2.0);
    let mut least = f64::INFINITY;
    for held in flanks.iter().flat_map(|flank| &flank.held) {
        for lead in (0..=10).map(|i| long * f64::from(i) / 10.0) {
            for share in [0.0, 0.5, 1.0] {
                for aside in [-half, half] {
                    let [x, y, z] = held.at([lead, share], aside);
                    if (0.0..=WIDTH).contains(&x) && (0.0..=DEPTH).contains(&y) {
                        least = least.min(z - height(x, y));
                    }
                }
            }
        }
    }
    least
}

/// Where the leading edge cuts a section, from the tip to the end of the edge.
fn cut_in(flank: &Flank, y: f64, long: f64) -> Vec<[f64; 2]> {
    let (first, last) = (flank.held.first().unwrap(), flank.held.last().unwrap());
    let sense = (last.tip[1] - first.tip[1]).signum();
    let ahead = |held: &Held| usize::from(held.edges[1][1] * sense > held.edges[0][1] * sense);
    let place = |held: &Held, lead: f64| {
        let edge = held.edges[ahead(held)];
        let point: [f64; 3] = core::array::from_fn(|i| held.tip[i] + lead * edge[i]);
        point
    };
    let count = (long / 0.1).round() as u32;
    let leads = (0..=count).map(|i| long * f64::from(i) / f64::from(count));
    let cut = leads.map(|lead| {
        let next = flank
            .held
            .partition_point(|held| place(held, lead)[1] * sense < y * sense)
            .clamp(1, flank.held.len() - 1);
        let [a, b] = [&flank.held[next - 1], &flank.held[next]].map(|held| place(held, lead));
        let share = ((y - a[1]) / (b[1] - a[1])).clamp(0.0, 1.0);
        [a[0] + (b[0] - a[0]) * share, a[2] + (b[2] - a[2]) * share]
    });
    cut.collect()
}

pub(crate) const DEXEL: f64 = 0.1;

/// A section of the stock in columns.
pub(crate) struct Dexels(Vec<f64>);

impl Dexels {
    fn new() -> Self {
        Self(vec![HEIGHT; (WIDTH / DEXEL).round() as usize + 1])
    }

    pub(crate) fn height(&self, x: f64) -> f64 {
        let column = (x / DEXEL).round();
        if column < 0.0 || column as usize >= self.0.len() {
            return f64::NEG_INFINITY;
        }
        self.0[column as usize]
    }

    /// How much more edge a flank would have needed to come out, at least along z; and where it does come out: next to the surface.
    fn exit(&self, cut: &[[f64; 2]], near: f64) -> (f64, usize) {
        let room = |[x, z]: [f64; 2]| self.height(x) - z;
        let last = cut.len() - 1;
        match cut.iter().position(|&point| room(point) <= near) {
            Some(out) => (0.0, out),
            None => (room(cut[last]), last),
        }
    }

    /// Takes out what lies above two flanks up to where they come out.
    fn release(&mut self, sides: [&[[f64; 2]]; 2]) {
        for side in sides {
            for pair in side.windows(2) {
                let [[a, low], [b, high]] = [pair[0], pair[1]];
                let (from, to) = (a.min(b), a.max(b));
                for column in (from / DEXEL).ceil() as i64..=(to / DEXEL).floor() as i64 {
                    let Ok(column) = usize::try_from(column) else {
                        continue;
                    };
                    let x = column as f64 * DEXEL;
                    let z = low + (high - low) * (x - a) / (b - a);
                    if let Some(top) = self.0.get_mut(column) {
                        *top = top.min(z);
                    }
                }
            }
        }
    }
}

/// What is left in a section after all cuts; fails where a flank does not come out. Where less than `near` is left above one, it is out.
pub(crate) fn left_in(flanks: &[Flank], y: f64, blade: Straight, near: f64) -> Dexels {
    let long = blade.cutting_length.to_mm();
    let mut dexels = Dexels::new();
    let mut half: Vec<(Site, Vec<[f64; 2]>)> = Vec::new();
    for flank in flanks {
        let mut cut = cut_in(flank, y, long);
        let (missing, out) = dexels.exit(&cut, near);
        assert!(missing <= 0.0, "{:?} lacks {missing} mm at y {y}", flank.site);
        cut.truncate(out + 1);
        match half.iter().position(|(site, _)| *site == flank.site) {
            Some(other) => {
                let (_, other) = half.swap_remove(other);
                dexels.release([&other, &cut]);
            }
            None => half.push((flank.site, cut)),
        }
    }
    assert!(half.is_empty());
    dexels
}

pub(crate) fn findings(plan: &PlannedJob, program: &Program) -> Findings {
    let program = verify(program.clone()).unwrap_or_else(|faults| panic!("{faults:?}"));
    replay(plan, &program).findings
}

/// The ops of one cut.
pub(crate) fn of_cut(op: &Op, layer: u32, cut: u32) -> bool {
    matches!(op.site, Site::Cut { layer: l, cut: c, .. } if (l.get(), c.get()) == (layer, cut))
}

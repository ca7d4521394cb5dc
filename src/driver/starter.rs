//! `vcutc init`: the text of a first job, and for a machine a set-up that was compiled before anybody gets it.
//!
//! The cuts do not depend on the machine, so the job is planned without one first. Then places for the work in front of
//! the machine are judged by the poses that this program teaches, the best of them are asked whether the axes are fast
//! enough, and the job is compiled with the first few of these until one passes. Nothing here is a table of machines:
//! what works for the catalogue works for a sheet of the user's own.

mod places;
mod text;

use crate::{self as driver, Request, SearchEffort, Typed};
use places::{Place, Tool};
use std::collections::BTreeMap;
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{Axis, AxisValues, MachineKind, Program};
use vcutc_diagnostics::overlay::Overlay;
use vcutc_diagnostics::source::{Loader, SourceMap};
use vcutc_diagnostics::{Diagnostic, has_errors};
use vcutc_job::sema::kind::Operations;
use vcutc_machine::Model;
use vcutc_motion::critical::margin::Judge;
use vcutc_motion::critical::motions::CriticalMotions;
use vcutc_motion::critical::poses::TaughtPoses;
use vcutc_motion::moves::above_first_pose;
use vcutc_motion::rig::Rig;
use vcutc_remedy::wording;
use vcutc_syntax::format;

/// Rates of turning the blade that are tried, in deg/s, the usual one first.
const REORIENT: [u32; 3] = [60, 40, 20];
/// How many poses beside the outermost ones judge a place.
const SPREAD: usize = 4;
/// Most places for each tool and rate that the axes are asked about.
const MOST_ASKED: usize = 24;
/// Most set-ups for each tool and rate that are compiled.
const MOST_COMPILED: usize = 3;
/// How far above the first pose of the program the blade is at home, in mm.
const RAISED: f64 = 100.0;

/// What a first job is asked for.
pub struct Asked<'a> {
    pub name: &'a str,
    /// Its path, as it will be called.
    pub path: &'a str,
    /// The machine that it is cut on.
    pub model: Option<&'a Model>,
    /// Where the files of machines come from.
    pub loader: &'a dyn Loader,
    /// The operations of the language.
    pub operations: Operations,
    /// The targets whose options the machine may hold.
    pub targets: &'a [&'static dyn Backend],
}

/// Why there is no job.
#[derive(Debug)]
pub enum Refusal {
    /// The job's name cannot be one.
    Name(Vec<Diagnostic>, SourceMap),
    /// None of the set-ups that were tried works on the machine.
    NoPlace,
}

/// How the machine is set up.
#[derive(Clone, Debug)]
struct Setup {
    tool: Tool,
    base: Frame,
    home: AxisValues,
    reorient: u32,
}

impl Setup {
    /// The same set-up with a blade that leans along the cut; none where it does.
    fn leaning(&self) -> Option<Self> {
        self.tool.leaning().map(|tool| Self { tool, ..self.clone() })
    }
}

/// The text of a first job. With a machine it has been compiled, home, frames and all.
///
/// # Errors
/// When the name is not valid for a job, or the machine cannot cut what the job cuts.
pub fn job(asked: &Asked<'_>) -> Result<String, Refusal> {
    let Some(model) = asked.model else {
        let text = text::without_machine(asked.name);
        return match compiled(asked, &text) {
            Ok(_) => Ok(laid_out(text)),
            Err((diagnostics, sources)) => Err(Refusal::Name(diagnostics, sources)),
        };
    };
    let mut upright = None;
    for (tool, reorient) in ways(model) {
        if tool.is_upright() && upright.is_some() {
            continue;
        }
        match with_tool(asked, model, (tool, reorient))? {
            Some(Found::Leaning(text)) => return Ok(text),
            Some(Found::Upright(text)) => upright = Some(text),
            None => {}
        }
    }
    upright.ok_or(Refusal::NoPlace)
}

/// How the blade may be mounted and how fast it may turn, in the order in which that is tried. On a five-axis machine upright
/// blades come between the rates of leaning ones: most find their place at once, and there a leaning one may do, too.
fn ways(model: &Model) -> Vec<(Tool, u32)> {
    let tools = places::tools(model);
    match model.kind() {
        MachineKind::Robot => {
            let ways = tools.iter().flat_map(|&tool| REORIENT.map(|rate| (tool, rate)));
            ways.collect()
        }
        MachineKind::FiveAxis => {
            let ways = REORIENT
                .iter()
                .flat_map(|&rate| tools.iter().map(move |&tool| (tool, rate)));
            ways.collect()
        }
    }
}

/// The text of a set-up that compiles.
enum Found {
    /// The blade leans along the cut.
    Leaning(String),
    /// It stands upright, and a leaning one does not do in its place.
    Upright(String),
}

/// The text of the first set-up with a tool that compiles.
fn with_tool(
    asked: &Asked<'_>,
    model: &Model,
    (tool, reorient): (Tool, u32),
) -> Result<Option<Found>, Refusal> {
    let draft = text::cuts(asked.name, tool.rake, reorient, tool.block);
    let outcome = compiled(asked, &draft).map_err(|(found, sources)| Refusal::Name(found, sources))?;
    let Some(planned) = outcome.compiled else {
        return Ok(None);
    };
    let verified = planned.program.verified();
    let setups = setups(
        model,
        tool,
        reorient,
        verified.program(),
        &TaughtPoses::of(verified),
    );
    let written = |setup: &Setup| {
        let text = text::with_machine(asked.name, model, setup, asked.targets);
        Some(laid_out(text)).filter(|text| compiled(asked, text).is_ok())
    };
    let mut tried = setups.iter().map(|setup| (setup, written(setup)));
    let Some((setup, Some(text))) = tried.find(|(_, text)| text.is_some()) else {
        return Ok(None);
    };
    Ok(Some(match setup.leaning() {
        None => Found::Leaning(text),
        // The job of an upright blade says that a leaning one does not do here, so that is tried.
        Some(leaning) => written(&leaning).map_or(Found::Upright(text), Found::Leaning),
    }))
}

/// The result of a text, or what is wrong with it.
fn compiled(asked: &Asked<'_>, text: &str) -> Result<driver::Outcome, (Vec<Diagnostic>, SourceMap)> {
    let texts = BTreeMap::from([(asked.path.to_owned(), text)]);
    let draft = Overlay {
        texts: &texts,
        below: asked.loader,
    };
    let request = Request {
        path: asked.path,
        loader: &draft,
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: asked.operations,
        targets: asked.targets,
    };
    match driver::compile_unhelped(request) {
        Ok(outcome) if has_errors(&outcome.diagnostics) => Err((outcome.diagnostics, outcome.sources)),
        Ok(outcome) => Ok(outcome),
        // The draft is in memory: it can always be read.
        Err(driver::RequestError::Unreadable(_)) => Err((Vec::new(), SourceMap::default())),
    }
}

/// The text in the layout of all job files.
fn laid_out(text: String) -> String {
    let mut sources = SourceMap::default();
    let file = sources.add("", text.clone());
    format::format(file, &text).unwrap_or(text)
}

/// Set-ups that are likely to work, the one with the most room first.
fn setups(model: &Model, tool: Tool, reorient: u32, program: &Program, taught: &TaughtPoses) -> Vec<Setup> {
    let rig = Rig::new(model, tool.frame(), Frame::from(Place::ROOT));
    let judge = Judge::new(&rig, taught.outermost(SPREAD));
    let mut scored: Vec<_> = places::around(model, tool.block)
        .into_iter()
        .map(|place| (judge.score(&Frame::from(place).into()), place))
        .filter(|(score, _)| score.reached().is_some())
        .collect();
    // Stable, so that of equals the first stays first.
    scored.sort_by(|(a, _), (b, _)| b.better(a));
    let motions = CriticalMotions::of(program);
    let setup = |(_, place): (_, Place)| {
        let base = Frame::from(place);
        let rig = Rig::new(model, tool.frame(), base);
        let home = motions.are_followed(&rig).then(|| home(&rig, program))??;
        Some(Setup {
            tool,
            base,
            home,
            reorient,
        })
    };
    scored
        .into_iter()
        .take(MOST_ASKED)
        .filter_map(setup)
        .take(MOST_COMPILED)
        .collect()
}

/// Axis values above the first pose of a program, in whole degrees and millimetres: of all ways to stand there the one that
/// keeps farthest from the limits.
fn home(rig: &Rig<'_>, program: &Program) -> Option<AxisValues> {
    let above = above_first_pose(program, RAISED)?;
    let ways = rig.mechanism.all(&rig.flange_in_root(&above));
    let room = |values: &AxisValues| {
        let pairs = rig.axes.iter().zip(values.0);
        pairs
            .map(|(axis, value)| share_left(axis, value))
            .fold(f64::INFINITY, f64::min)
    };
    ways.iter()
        .map(|way| wording::rounded_home(rig.axes, &AxisValues(way.joints)))
        .filter(|values| room(values) > 0.0)
        .max_by(|a, b| room(a).total_cmp(&room(b)))
}

/// How much of its range an axis has left towards the nearer limit.
fn share_left(axis: &Axis, value: f64) -> f64 {
    (value - axis.min).min(axis.max - value) / (axis.max - axis.min)
}

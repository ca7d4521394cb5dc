//! Compiling with a memory against compiling afresh, over random edits of a job: outcome and files must be the same to the byte.

use super::*;
use crate::{
    Outcome, Request, RequestError, Run, SearchEffort, Stage, Typed, Unhurried, compile, compile_in, write,
};
use proptest::prelude::*;
use vcutc_backend_api::backend::Backend;
use vcutc_cancellation::{Needless, Wanted};
use vcutc_diagnostics::source::{LoadError, Loader};
use vcutc_job::sema::kind::Operations;
use vcutc_registry as registry;

/// A job file, and what it says at each of the places that are edited.
struct Text([usize; PLACES.len()]);

/// What may stand at a place of the job.
const PLACES: [&[&str]; 12] = [
    &["", "// a comment\n", "// another one\n\n\n"],
    &["70", "64"],
    &["12", "9.5"],
    &["35 deg", "auto", "52 deg"],
    &["auto", "4 mm", "40 mm"],
    &["", "limits { scallop <= 6 mm }", "limits { scallop <= 0.01 mm }"],
    &["auto", "lift", "discard"],
    &["auto", "point", "layer"],
    &["200", "150"],
    &["200", "160", "180000"],
    &["1700", "1760", "4000"],
    &[
        "",
        "krl { lines_per_part = 1000 }",
        "krl { lines_per_part = 1200 }",
        "krl { nonsense = 1 }",
    ],
];

impl Text {
    fn at(&self, place: usize) -> &'static str {
        let words = PLACES[place];
        words[self.0[place] % words.len()]
    }

    fn text(&self) -> String {
        let [
            comment,
            width,
            low,
            swing,
            layer,
            limits,
            residual,
            order,
            cut,
            travel,
            base,
            options,
        ] = core::array::from_fn(|place| self.at(place));
        format!(
            r#"{comment}job "part"
stock {{ size = ({width} mm, 40 mm, 34 mm) }}
profile {{ start (0 mm, {low} mm)  line to (20 mm, 18 mm)  line to ({width} mm, 14 mm) }}
{comment}blade dagger {{ cutting_length = 12 mm  half_apex = 7 deg  thickness = 1 mm  edges = double }}
rough vcut {{
  blade = dagger  lattice = orthogonal  rake = 60 deg  swing = {swing}  layer = {layer}  step = auto
  {limits}
  residual = {residual}  order = {order}
  feed {{ cut = {cut} mm/s, travel = {travel} mm/s, reorient = 90 deg/s }}
  clearance = 10 mm
}}
machine cell = robot "kuka/kr210_r3100_ultra" {{
  tool = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base = frame(x = {base} mm, y = -25 mm, z = 900 mm, a = 120 deg, b = 0 deg, c = 0 deg)
  home = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  load = load(mass = 14.5 kg, x = 0 mm, y = 0 mm, z = 140 mm)
  ultrasonic = output(12)
  {options}
}}
"#
        )
    }
}

impl Loader for Text {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        match path {
            "part.vcut" => Ok(self.text().into_bytes()),
            _ => Err(LoadError::NotFound),
        }
    }
}

fn request<'a>(text: &'a Text, targets: &'a [&'static dyn Backend]) -> Request<'a> {
    Request {
        path: "part.vcut",
        loader: text,
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: Operations(&[&vcutc_vcut::Vcut]),
        targets,
    }
}

/// The whole result of a job, and its files, as text.
fn all_of(outcome: &crate::Outcome) -> (String, String) {
    let files = registry::backends()
        .iter()
        .map(|backend| write(outcome, *backend))
        .collect::<Vec<_>>();
    (format!("{outcome:#?}"), format!("{files:?}"))
}

/// An edit: at which place, and to which of its words.
fn edits() -> impl Strategy<Value = Vec<(usize, usize)>> {
    // Often those that change nothing about the cuts.
    let place =
        prop_oneof![3 => 0..PLACES.len(), 1 => Just(0_usize), 1 => Just(11_usize), 1 => Just(8_usize)];
    prop::collection::vec((place, 0..4_usize), 6..10)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10))]

    #[test]
    fn what_is_kept_changes_nothing(start in prop::array::uniform12(0..4_usize), edits in edits(), room in prop_oneof![3 => Just(ROOM), 1 => 300..2000_usize]) {
        let targets = registry::backends();
        let mut text = Text(start);
        // Sound to begin with, mostly.
        for (place, bad) in [(4, 2), (5, 2), (9, 2), (10, 2), (11, 3)] {
            if text.0[place] == bad {
                text.0[place] = 0;
            }
        }
        let mut memory = Memory::with_room(room, None);
        for (place, word) in edits {
            text.0[place] = word;
            let again = compile_again(request(&text, &targets), &mut memory);
            let fresh = compile(request(&text, &targets), &mut |_| ()).unwrap();
            let ((outcome, files), (expected, expected_files)) = (all_of(&again), all_of(&fresh));
            prop_assert!(outcome == expected, "{}", text.text());
            prop_assert!(files == expected_files, "{}", text.text());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    /// Wherever a run is given up, its result is not given out, and the next run is not misled by what it
    /// left.
    #[test]
    fn what_is_given_up_leaves_nothing_wrong(
        start in prop::array::uniform12(0..4_usize),
        stage in 0..4_usize,
        micros in 0..40_000_u64,
    ) {
        let targets = registry::backends();
        let mut text = Text(start);
        // Swing and layer are open, and the machine may be out of reach: all that takes long.
        (text.0[3], text.0[4], text.0[5], text.0[11]) = (1, 0, 1, 0);
        let mut memory = Memory::of_some_runs();
        let (wanted, interest) = Wanted::while_held();
        let mut interest = Some(interest);
        let mut entered = 0;
        let given_up = std::thread::scope(|scope| {
            compile_while(request(&text, &targets), &mut memory, &wanted, &mut |_| {
                entered += 1;
                if entered > stage
                    && let Some(interest) = interest.take()
                {
                    // In the middle of the stage, wherever that is.
                    scope.spawn(move || {
                        std::thread::sleep(core::time::Duration::from_micros(micros));
                        drop(interest);
                    });
                }
            })
        });
        let fresh = compile(request(&text, &targets), &mut |_| ()).unwrap();
        if let Ok(answered) = given_up {
            prop_assert!(all_of(&answered.unwrap()) == all_of(&fresh), "{}", text.text());
        }
        let again = compile_again(request(&text, &targets), &mut memory);
        prop_assert!(all_of(&again) == all_of(&fresh), "{}", text.text());
    }
}

#[test]
fn what_was_cut_short_is_not_kept() {
    let targets = registry::backends();
    let mut text = Text([0; PLACES.len()]);
    (text.0[3], text.0[5]) = (1, 1);
    for stage in [Stage::Planning, Stage::Proving, Stage::Reaching] {
        let mut memory = Memory::of_some_runs();
        let (wanted, interest) = Wanted::while_held();
        let mut interest = Some(interest);
        let given_up = compile_while(request(&text, &targets), &mut memory, &wanted, &mut |entered| {
            if entered == stage {
                interest = None;
            }
        });
        assert_eq!(given_up.map(|_| ()), Err(Needless), "{stage:?}");
        let plans = usize::from(stage != Stage::Planning);
        assert_eq!(
            (memory.plans.count(), memory.motions.count()),
            (plans, 0),
            "{stage:?}"
        );
    }
}

fn compile_again(request: Request<'_>, memory: &mut Memory) -> Outcome {
    let answer = compile_while(request, memory, &Wanted::ALWAYS, &mut |_| ());
    answer.unwrap().unwrap()
}

fn compile_while(
    request: Request<'_>,
    memory: &mut Memory,
    wanted: &Wanted,
    progress: &mut dyn FnMut(Stage),
) -> Result<Result<Outcome, RequestError>, Needless> {
    let run = Run {
        memory,
        wanted,
        patience: &mut Unhurried,
    };
    wanted.answer(|| compile_in(run, request, progress))
}

/// The stages that were asked of a memory and answered by it.
fn is_kept(memory: &mut Memory, text: &Text) -> bool {
    let targets = registry::backends();
    let before = (memory.plans.count(), memory.motions.count());
    let outcome = compile_again(request(text, &targets), memory);
    assert!(outcome.compiled.is_some(), "{:#?}", outcome.diagnostics);
    before == (memory.plans.count(), memory.motions.count())
}

#[test]
fn comments_and_options_of_targets_are_answered_from_memory_and_speeds_are_not() {
    let mut memory = Memory::of_some_runs();
    let mut text = Text([0; PLACES.len()]);
    assert!(!is_kept(&mut memory, &text));
    for (place, word) in [(0, 1), (0, 2), (11, 1), (11, 2), (0, 0)] {
        text.0[place] = word;
        assert!(is_kept(&mut memory, &text), "{place}");
    }
    text.0[8] = 1;
    assert!(!is_kept(&mut memory, &text));
    text.0[8] = 0;
    assert!(is_kept(&mut memory, &text), "an edit taken back");
}

#[test]
fn a_memory_without_room_keeps_nothing() {
    let mut memory = Memory::none();
    let targets = registry::backends();
    let text = Text([0; PLACES.len()]);
    compile_again(request(&text, &targets), &mut memory);
    assert_eq!((memory.plans.count(), memory.motions.count()), (0, 0));
}

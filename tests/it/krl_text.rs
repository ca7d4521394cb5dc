//! Programs read back from their text, by the reader that the target's own tests use: written from the manuals, not from
//! the writer.

#[path = "../../backends/krl/tests/it/support/expected.rs"]
pub(crate) mod expected;
#[path = "../../backends/krl/tests/it/support/reader.rs"]
pub(crate) mod reader;

use expected::{Rounding, compare, poses_agree, steps};
use reader::{Event, Pose, Setting};
use vcutc::driver::Outcome;
use vcutc::job::GivenValue;
use vcutc::machine::kinematics::Mechanism;
use vcutc::machine::kinematics::opw::Opw;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::{Action, AxisValues, PlacedFrame};

/// Asserts that the text of a job's program does what its ops say, within rounding, in the frames of its machine and on the
/// branch that its axes are on.
pub(crate) fn check(outcome: &Outcome, bundle: &Bundle) {
    let program = &outcome
        .compiled
        .as_ref()
        .unwrap()
        .program
        .reached()
        .unwrap()
        .program;
    let model = &outcome.job.as_ref().unwrap().machine.as_ref().unwrap().model;
    #[allow(irrefutable_let_patterns, reason = "KRL drives no other mechanism")]
    let Mechanism::OrthoParallel(arm) = &model.mechanism else {
        panic!("{}: not an arm of KUKA's", model.name)
    };
    let status = |axes: &AxisValues| status(arm, axes);
    let name = &program.program().name;
    let main = bundle.files()[0].0.trim_end_matches(".src");
    let got = reader::run(bundle, main).unwrap_or_else(|problem| panic!("{name}: {problem}"));
    let rounding = Rounding::of_decimals(decimals(outcome));
    compare(&got, &steps(program, &status), rounding).unwrap_or_else(|problem| panic!("{name}: {problem}"));
    let cell = program.program().cell.as_ref().unwrap();
    let mut changes = program.program().ops.iter().filter_map(|op| match op.action {
        Action::ToolChange { tool } => Some(tool),
        _ => None,
    });
    let mut at_hand = *cell.tools.first();
    for event in &got {
        match event {
            Event::Tool(setting) => assert_frame(setting, at_hand.frame, rounding),
            Event::Change(_) => at_hand = *cell.tools.get(changes.next().unwrap()).unwrap(),
            Event::Base(setting) => assert_frame(setting, cell.base, rounding),
            Event::Axes(_)
            | Event::Point { .. }
            | Event::Line { .. }
            | Event::Output(..)
            | Event::Await(_)
            | Event::Wait(_)
            | Event::Module(_) => {}
        }
    }
}

/// `S` from the axes alone, by its definition: where the wrist centre is, seen from axis 1 and from the line through axes
/// 2 and 3, and the sign of axis 5.
#[expect(clippy::disallowed_methods, reason = "another sine than the compiler's")]
pub(crate) fn status(arm: &Opw, axes: &AxisValues) -> u32 {
    let [_, a2, a3, _, a5, _] = axes.0;
    // Both lean forward from upright; A2 is counted from the upper arm lying forward.
    let upper = a2 + std::f64::consts::FRAC_PI_2;
    let fore = upper + a3;
    let wrist_x = arm.a1 + arm.c2 * upper.sin() + arm.c3 * fore.sin() + arm.a2 * fore.cos();
    let stretched = -(arm.a2 / arm.c3).atan();
    let bits = [wrist_x < 0.0, a3 > stretched, a5 < 0.0];
    bits.into_iter()
        .rev()
        .fold(0, |bits, bit| 2 * bits + u32::from(bit))
}

fn assert_frame(got: &Setting, want: PlacedFrame, rounding: Rounding) {
    let agrees = match (*got, want.number) {
        (Setting::Number(got), Some(want)) => got == want,
        (Setting::Value(got), None) => {
            let want = Pose {
                tip: [want.frame.origin.x, want.frame.origin.y, want.frame.origin.z],
                axes: want.frame.orientation.matrix(),
            };
            poses_agree(&got, &want, rounding)
        }
        (Setting::Number(_) | Setting::Value(_), _) => false,
    };
    assert!(agrees, "{got:?} instead of {want:?}");
}

/// How many decimals the job asks for; three when it does not.
fn decimals(outcome: &Outcome) -> i32 {
    let machine = outcome.job.as_ref().and_then(|job| job.machine.as_ref()).unwrap();
    let given = machine.targets.iter().flat_map(|target| &target.given);
    let mut decimals = given
        .filter(|option| option.key == "decimals")
        .map(|option| &option.value);
    decimals.next_back().map_or(3, |value| match value {
        GivenValue::Ratio(number) => format!("{number}").parse().unwrap(),
        GivenValue::Length(_) | GivenValue::Texts(_) | GivenValue::Word(_) | GivenValue::Default => {
            panic!("{value:?}")
        }
    })
}

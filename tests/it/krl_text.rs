//! Programs read back from their text, by the reader that the target's own tests use: written from the manuals, not from
//! the writer.

#[path = "../../backends/krl/tests/support/expected.rs"]
mod expected;
#[path = "../../backends/krl/tests/support/reader.rs"]
mod reader;

use expected::{Rounding, compare, events, poses_agree};
use reader::{Event, Pose, Setting};
use vcutc::driver::Outcome;
use vcutc::job::GivenValue;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::Registered;

/// Asserts that the text of a job's program does what its ops say, within rounding, in the frames of its machine.
pub(crate) fn check(outcome: &Outcome, bundle: &Bundle) {
    let program = &outcome.compiled.as_ref().unwrap().program;
    let name = &program.program().name;
    let main = bundle.files()[0].0.trim_end_matches(".src");
    let got = reader::run(bundle, main).unwrap_or_else(|problem| panic!("{name}: {problem}"));
    let rounding = Rounding::of_decimals(decimals(outcome));
    compare(&got, &events(program), rounding).unwrap_or_else(|problem| panic!("{name}: {problem}"));
    let cell = program.program().cell.as_ref().unwrap();
    for event in &got {
        match event {
            Event::Tool(setting) => assert_frame(setting, cell.tool, rounding),
            Event::Base(setting) => assert_frame(setting, cell.base, rounding),
            Event::Axes(_)
            | Event::Line { .. }
            | Event::Output(..)
            | Event::Await(_)
            | Event::Wait(_)
            | Event::Module(_) => {}
        }
    }
}

fn assert_frame(got: &Setting, want: Registered<Frame>, rounding: Rounding) {
    let agrees = match (*got, want) {
        (Setting::Number(got), Registered::Number(want)) => got == want,
        (Setting::Value(got), Registered::Value(want)) => {
            let want = Pose {
                tip: [want.origin.x, want.origin.y, want.origin.z],
                axes: want.orientation.matrix(),
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
    let decimals = given
        .filter(|option| option.key == "decimals")
        .map(|option| &option.value);
    decimals.last().map_or(3, |value| match value {
        GivenValue::Ratio(number) => format!("{number}").parse().unwrap(),
        GivenValue::Length(_) | GivenValue::Texts(_) | GivenValue::Word(_) => panic!("{value:?}"),
    })
}

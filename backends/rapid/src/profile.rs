//! Lines of a machine's profile, which stand in `main` as they are.
//!
//! What they may be is a short list, and all else is refused: a list of what could move the robot, shift its frames, leave out
//! lines or switch the generator would never be complete. `SetDO`, `WaitDI` and `WaitTime` are not on it, although harmless
//! with other signals: programs are read back by them.

use crate::options::Settings;
use crate::read::{Sentence, Value, sentences};
use vcutc_backend_api::ir::{Cell, Ready};

/// What a line may be, for messages.
const ALLOWED: &str = "a comment, `TPWrite \"...\";`, `TPErase;`, or `Set`, `Reset`, `SetAO` or `PulseDO` of a signal that is not \
                       the program's own";

/// What speaks against a line.
pub(crate) fn objection(line: &str, settings: &Settings<'_>, cell: &Cell) -> Option<String> {
    let is_fine = sentences(line).is_some_and(|all| all.iter().all(|one| is_harmless(one, settings, cell)));
    (!is_fine).then(|| {
        format!(
            "`{}` may change what the program does; a line may be {ALLOWED}",
            line.trim()
        )
    })
}

fn is_harmless(sentence: &Sentence, settings: &Settings<'_>, cell: &Cell) -> bool {
    let Sentence::Instruction {
        name,
        required,
        optional,
    } = sentence
    else {
        return false;
    };
    let is_literal = |value: &Value| matches!(value, Value::Number(_) | Value::Text(_));
    let is_plain = optional
        .iter()
        .all(|one| one.value.as_ref().is_none_or(is_literal));
    let is_right = match (name.as_str(), required.as_slice()) {
        ("TPERASE", []) | ("TPWRITE", [Value::Text(_)]) => true,
        ("SET" | "RESET" | "PULSEDO", [Value::Name(signal)])
        | ("SETAO", [Value::Name(signal), Value::Number(_)]) => !is_own(signal, settings, cell),
        _ => false,
    };
    is_plain && is_right
}

/// Whether a signal is that of generator or spindle, or of their readiness.
fn is_own(signal: &str, settings: &Settings<'_>, cell: &Cell) -> bool {
    let outputs = cell.outputs().map(|number| settings.output(cell, number));
    let input = match cell.ready {
        Ready::Input(number) => Some(settings.input(number)),
        Ready::After(_) => None,
    };
    let mut own = outputs.chain(input);
    own.any(|own| own.eq_ignore_ascii_case(signal))
}

//! The exchange form: a program and, where it is known how a machine carries it out, that motion beside it.
//!
//! This is what `--emit ir` writes and what `docs/ir.md` describes. The fields of the program stand at the top, as they
//! would without a motion.

use crate::ir::Program;
use crate::motion::Motion;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// A program, and its motion when there is one. Borrowed for writing, owned when read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Exchange<'a> {
    /// The program.
    #[serde(flatten)]
    pub program: Cow<'a, Program>,
    /// Where the axes of the program's machine are at the end of every op.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Cow<'a, Motion>>,
}

impl<'a> Exchange<'a> {
    /// The form of a program and its motion.
    #[must_use]
    pub const fn of(program: &'a Program, motion: Option<&'a Motion>) -> Self {
        Self {
            program: Cow::Borrowed(program),
            motion: match motion {
                Some(motion) => Some(Cow::Borrowed(motion)),
                None => None,
            },
        }
    }
}

#[cfg(test)]
#[cfg(feature = "testkit")]
mod tests {
    use super::*;
    use crate::ir::Changer;
    use crate::testkit::{Recipe, samples, two_blades};

    #[test]
    fn samples_come_back_from_json() {
        for (name, program) in samples().unwrap() {
            for motion in [Some(program.motion()), None] {
                let form = Exchange::of(program.program(), motion);
                let text = serde_json::to_string(&form).unwrap();
                let read: Exchange<'_> = serde_json::from_str(&text).unwrap();
                assert_eq!(read, form, "{name}");
            }
        }
    }

    /// Who reads programs need not know of motions.
    #[test]
    fn a_program_can_be_read_from_it_alone() {
        for (name, program) in samples().unwrap() {
            let form = Exchange::of(program.program(), Some(program.motion()));
            let read: Program = serde_json::from_str(&serde_json::to_string(&form).unwrap()).unwrap();
            assert_eq!(read, *program.program(), "{name}");
        }
    }

    #[test]
    fn a_cell_without_tools_is_not_a_program() {
        let program = two_blades(Recipe::default().program(), Changer::Hand);
        let form = serde_json::to_value(Exchange::of(&program, None)).unwrap();
        let mut none = form.clone();
        none["cell"]["tools"] = serde_json::json!([]);
        let error = serde_json::from_value::<Exchange<'_>>(none).unwrap_err();
        assert!(error.to_string().contains("at least one tool"), "{error}");
        for number in [-1, 65_536] {
            let mut wrong = form.clone();
            wrong["operations"][0]["tools"] = serde_json::json!([number]);
            assert!(serde_json::from_value::<Exchange<'_>>(wrong).is_err());
        }
    }
}

//! The tool and the base that targets are stated in.
//!
//! One of each for all passes is the job's own frame, whichever it is. A change between them is not followed, so what counts is
//! whether the frames of a motion are those of the first straight one. They may be set as `$TOOL` and `$BASE`, by number with
//! `BAS`, or by the point's data (`FDAT`) of the pendant's inline forms; the same number in another way is the same frame.

use super::Reader;
use crate::complaints;
use crate::milling::Way;
use std::collections::BTreeMap;
use vcutc_backend_api::readback::normalized;
use vcutc_backend_krl::interpreter::Context;
use vcutc_backend_krl::syntax::{
    Component, Declaration, Field, Setting, SettingValue, Tail, Value, Variable, is_same_name,
};
use vcutc_diagnostics::source::Span;

/// Variables that set up motions, and those that inline forms of the pendant leave behind.
#[rustfmt::skip]
pub(crate) const SETUP: [&str; 27] = [
    "$VEL", "$ACC", "$APO", "$ORI_TYPE", "$CIRC_TYPE", "$ADVANCE", "$TOOL", "$BASE", "$LOAD", "$IPO_MODE", "$ACT_TOOL",
    "$ACT_BASE", "$VEL_AXIS", "$ACC_AXIS", "$BWDSTART", "$H_POS", "$JERK", "$GEAR_JERK", "PDAT_ACT", "LDAT_ACT", "FDAT_ACT",
    "TOOL_DATA", "BASE_DATA", "LOAD_DATA", "$SPL_VEL_MODE", "$SPL_ORI_JOINT_AUTO", "$COLLMON_TOL_PRO",
];

/// What sets a frame: as a variable, as a command of `BAS`; and what it is called here.
const WORDS: [(&str, &str); 7] = [
    ("$TOOL", "tool"),
    ("TOOL", "tool"),
    ("$BASE", "base"),
    ("BASE", "base"),
    ("$IPO_MODE", "side"),
    ("TOOL_DATA", "tools"),
    ("BASE_DATA", "bases"),
];

/// What was said of the tool, the base, and which of both moves: what each is called, with its field if only that was said.
type Said = BTreeMap<String, String>;

/// The frames of a program, as far as it has been carried out.
#[derive(Default)]
pub(crate) struct Frames {
    said: Said,
    /// Where something of it changed last.
    changed: Option<Span>,
    /// Those of the first straight motion.
    first: Option<Said>,
    /// What the data of points says, by module and name in upper case.
    points: BTreeMap<(String, String), Said>,
}

impl Frames {
    /// Keeps the data of a point.
    pub(crate) fn declare(&mut self, context: Context<'_>, declaration: &Declaration<'_>) {
        if let (true, Some(Value::Structure(fields))) =
            (is_same_name(declaration.kind, "FDAT"), &declaration.value)
        {
            self.points
                .insert(key(context, declaration.name.name), of_point(fields));
        }
    }

    /// What the data of a point says; where it is not known, its name stands for it.
    fn point(&self, context: Context<'_>, name: &str) -> Said {
        let known = self.points.get(&key(context, name)).cloned();
        known.unwrap_or_else(|| {
            let unknown = |what: &str| (what.to_owned(), name.to_ascii_uppercase());
            Said::from([unknown("tool"), unknown("base")])
        })
    }
}

fn key(context: Context<'_>, name: &str) -> (String, String) {
    (context.module.to_ascii_uppercase(), name.to_ascii_uppercase())
}

/// `{TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE}`.
fn of_point(fields: &[Field<'_>]) -> Said {
    let said = |field: &Field<'_>| {
        let what = [("TOOL_NO", "tool"), ("BASE_NO", "base"), ("IPO_FRAME", "side")]
            .into_iter()
            .find_map(|(name, what)| is_same_name(field.name, name).then_some(what))?;
        let value = match &field.value {
            Value::Number(number) => number.to_string(),
            Value::Enum(word) => side(word),
            _ => return None,
        };
        Some((what.to_owned(), value))
    };
    fields.iter().filter_map(said).collect()
}

fn side(word: &str) -> String {
    format!("#{}", word.to_ascii_uppercase())
}

/// A value as it is compared: `TOOL_DATA[3]` is the number 3, all else its text.
fn compared(text: &str) -> String {
    let text = normalized(text).to_ascii_uppercase();
    let text = text.split_once('=').map_or(text.as_str(), |(_, value)| value);
    ["TOOL_DATA[", "BASE_DATA["]
        .into_iter()
        .find_map(|table| text.strip_prefix(table)?.strip_suffix(']'))
        .unwrap_or(text)
        .to_owned()
}

/// What a word sets, if it sets a frame.
fn set_by(word: &str) -> Option<&'static str> {
    WORDS
        .into_iter()
        .find_map(|(name, what)| is_same_name(word, name).then_some(what))
}

/// Replaces what was stated before by what was stated last.
fn put(said: &mut Said, what: &str, part: &str, value: String) {
    if part.is_empty() {
        said.retain(|known, _| known.split('.').next() != Some(what));
        said.insert(what.to_owned(), value);
    } else {
        said.insert(format!("{what}.{part}"), value);
    }
}

impl Reader<'_> {
    /// Takes what sets a frame by a word; other words set none.
    pub(crate) fn frame(&mut self, word: &str, value: &str, place: Span) {
        if let Some(what) = set_by(word) {
            let mut said = self.frames.said.clone();
            put(&mut said, what, "", compared(value));
            self.reframe(said, place);
        }
    }

    /// Takes an assignment, if it sets a frame.
    pub(crate) fn framed(&mut self, context: Context<'_>, to: &Variable<'_>, value: &Value<'_>, place: Span) {
        let mut said = self.frames.said.clone();
        if is_same_name(to.name, "FDAT_ACT") {
            let point = match value {
                Value::Structure(fields) => of_point(fields),
                Value::Variable(variable) => self.frames.point(context, variable.name),
                _ => return,
            };
            for (what, value) in point {
                put(&mut said, &what, "", value);
            }
        } else if let Some(what) = set_by(to.name) {
            let index = to.index.map_or(String::new(), |index| index.to_string());
            let part = format!("{index}{}", to.field.unwrap_or_default().to_ascii_uppercase());
            let known = match value {
                Value::Variable(variable) => self.state.variables.get(context, variable),
                _ => None,
            };
            let text = match known.map(|known| (known.all(Component::TIP), known.all(Component::ANGLES))) {
                Some((Some(tip), Some(angles))) => format!("{tip:?}{angles:?}"),
                Some(_) | None => compared(self.files.said(place)),
            };
            put(&mut said, what, &part, text);
        } else {
            return;
        }
        self.reframe(said, place);
    }

    fn reframe(&mut self, said: Said, place: Span) {
        if self.frames.said == said {
            return;
        }
        if self.frames.first.is_none() {
            // Positions stated in other frames are not positions in these.
            for made in &mut self.milling.moves {
                made.to = None;
            }
        }
        self.frames.said = said;
        self.frames.changed = Some(place);
    }

    /// Whether a motion, with what holds for it alone, has the frames of the first straight one. A straight motion that has not
    /// is reported, once for every change.
    pub(crate) fn frames_of(
        &mut self,
        context: Context<'_>,
        tail: &Tail<'_>,
        way: Way,
        place: Span,
    ) -> Framing {
        let own = tail.with.iter().any(|setting| set_by(setting.to.name).is_some());
        if !own && self.frames.first.as_ref() == Some(&self.frames.said) {
            return Framing::Same;
        }
        let mut said = self.frames.said.clone();
        for setting in &tail.with {
            self.with_frame(context, setting, &mut said);
        }
        let is_other = self.frames.first.as_ref().is_some_and(|first| *first != said);
        match (way, is_other) {
            (Way::Joint, true) => return Framing::Other,
            (Way::Joint, false) => return Framing::Same,
            (Way::Straight | Way::Arc { .. }, false) => {}
            (Way::Straight | Way::Arc { .. }, true) => {
                let changed = self.frames.changed.take().filter(|_| !own).unwrap_or(place);
                self.push(complaints::frame_changes(changed));
            }
        }
        self.frames.first = Some(said);
        Framing::Same
    }

    /// `WITH $TOOL=STOOL2(FP1), $BASE=SBASE(FP1.BASE_NO)`.
    fn with_frame(&self, context: Context<'_>, setting: &Setting<'_>, said: &mut Said) {
        let Some(what) = set_by(setting.to.name) else {
            return;
        };
        let value = match &setting.value {
            SettingValue::Function { arguments, .. } => {
                let point = arguments.split('.').next().unwrap_or_default().trim();
                let known = self.frames.point(context, point);
                known
                    .get(what)
                    .cloned()
                    .unwrap_or_else(|| point.to_ascii_uppercase())
            }
            SettingValue::Plain(_) => compared(setting.text),
        };
        put(said, what, "", value);
    }
}

/// Whether a motion is stated in the frames of the first straight one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Framing {
    /// It is, or there is none so far.
    Same,
    /// It is not: where it ends is not known in those.
    Other,
}

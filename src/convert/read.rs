//! From the text of a KRL program to its motions.
//!
//! What a controller does is for the interpreter of the KRL crate: which statement comes next, what names stand for, and where
//! targets lead. Here programs are accepted from any source, and become motions ([`motions`]) or messages.
//! Statements that decide which motions are made (`IF`, `LOOP`, `GOTO` and their like) are not followed: with
//! a motion inside they are refused. So are calls of routines that no file given holds, for their motions
//! would be missing.

mod frames;
mod motions;

use super::complaints;
use super::milling::{Milling, Written};
use frames::Frames;
use motions::ExternalAxes;
use vcutc_backend_api::readback::{ProgramFile, normalized};
use vcutc_backend_krl::interpreter::speeds::{Velocity, velocities};
use vcutc_backend_krl::interpreter::variables::Outcome;
use vcutc_backend_krl::interpreter::{BreaksOff, Context, Execution, Line, State};
use vcutc_backend_krl::syntax::{
    Phrase, Span as Bytes, Statement, Statements, Value, Variable, is_same_name,
};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::{FileId, SourceMap, Span};

/// Most motions of a program.
const MOST_MOVES: usize = 4_000_000;

/// Most statements that are carried out, those of routines that are called several times counted each time.
const MOST_STATEMENTS: usize = 40_000_000;

/// How deep routines may call one another.
const DEEPEST: usize = 65;

/// Most complaints about single statements.
const MOST_COMPLAINTS: usize = 20;

/// The files of a program among the sources, in order.
pub(super) struct Files<'t> {
    pub(super) files: &'t [ProgramFile],
    pub(super) ids: Vec<FileId>,
    /// Where the first of them begins.
    pub(super) start: Span,
}

impl<'t> Files<'t> {
    /// None without files.
    pub(super) fn add(files: &'t [ProgramFile], sources: &mut SourceMap) -> Option<Self> {
        let add = |file: &ProgramFile| sources.add(file.name.clone(), file.text.clone());
        let ids: Vec<FileId> = files.iter().map(add).collect();
        let start = Span::of_bytes(*ids.first()?, 0..0);
        Some(Self { files, ids, start })
    }

    fn span(&self, file: usize, bytes: Bytes) -> Span {
        let id = self.ids.get(file).copied().unwrap_or(self.start.file);
        Span::of_bytes(id, bytes.start..bytes.end)
    }

    /// What stands at a place.
    pub(super) fn said(&self, place: Span) -> &'t str {
        let at = self.ids.iter().position(|&id| id == place.file);
        let text = at
            .and_then(|file| self.files.get(file))
            .map_or("", |file| &file.text);
        text.get(place.bytes()).unwrap_or_default().trim()
    }
}

/// The motions of a program.
///
/// # Errors
/// What cannot be followed.
pub(super) fn read(files: &Files<'_>) -> Result<Milling, Vec<Diagnostic>> {
    let mut execution = Execution::of(files.files);
    let mut reader = Reader {
        files,
        state: State::default(),
        milling: Milling::empty(files.start),
        external: ExternalAxes::default(),
        speed: None,
        forks: Vec::new(),
        frames: Frames::default(),
        complaints: Vec::new(),
        statements: 0,
    };
    for (file, _, line) in execution.outside() {
        match line.phrase {
            Phrase::Mark(_) => {}
            _ => reader.push(complaints::outside(files.span(file, line.span))),
        }
    }
    for (file, context, lines) in execution.data_lists() {
        reader.data(file, context, lines);
    }
    match execution.main() {
        Some(main) => {
            execution.enter(main);
            reader.follow(&mut execution);
        }
        None => reader.complaints.push(complaints::no_routine(files.start)),
    }
    reader.never_called(&execution);
    reader.milling.external = reader.external.standing();
    if reader.complaints.is_empty() {
        Ok(reader.milling)
    } else {
        Err(reader.complaints)
    }
}

/// Goes through a program.
pub(super) struct Reader<'a> {
    pub(super) files: &'a Files<'a>,
    pub(super) state: State,
    pub(super) milling: Milling,
    pub(super) external: ExternalAxes,
    pub(super) speed: Option<Written>,
    /// Statements that decide what is made, and are open; each with whether a motion in it was reported.
    pub(super) forks: Vec<Fork>,
    pub(super) frames: Frames,
    complaints: Vec<Diagnostic>,
    statements: usize,
}

/// A statement that decides what is made.
pub(super) struct Fork {
    pub(super) place: Span,
    pub(super) reported: Reported,
}

/// Whether a motion that depends on a statement was reported.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Reported {
    Not,
    Once,
}

/// What to do after a statement.
enum Next {
    GoOn,
    Enter(usize),
    Return,
}

impl Reader<'_> {
    fn data(&mut self, file: usize, context: Context<'_>, lines: Statements<'_>) {
        for line in lines {
            match &line.phrase {
                Phrase::Declaration(declaration) => {
                    self.state.variables.declare(context, declaration);
                    self.frames.declare(context, declaration);
                }
                Phrase::Assignment { to, value } => {
                    self.state.variables.assign(context, to, value);
                }
                Phrase::Unreadable { expected } => self.unreadable(file, &line, expected),
                _ => {}
            }
        }
    }

    fn follow(&mut self, execution: &mut Execution<'_>) {
        while let Some(step) = execution.next() {
            let line = match step {
                Ok(line) => line,
                Err(BreaksOff { file, last, .. }) => {
                    let place = last.unwrap_or(Bytes { start: 0, end: 0 });
                    self.milling.ends_early.push(self.files.span(file, place));
                    continue;
                }
            };
            let place = self.files.span(line.file, line.statement.span);
            self.statements += 1;
            let is_endless = self.statements > MOST_STATEMENTS
                || self.milling.moves.len() > MOST_MOVES
                || execution.depth() > DEEPEST;
            if is_endless {
                return self.push(complaints::endless(place));
            }
            match self.step(execution, &line, place) {
                Next::GoOn => {}
                Next::Enter(routine) => execution.enter(routine),
                Next::Return => execution.leave(),
            }
        }
    }

    fn unreadable(&mut self, file: usize, line: &Statement<'_>, expected: &str) {
        self.push(complaints::unreadable(self.files.span(file, line.span), expected));
    }

    /// Routines with motions that have not been called.
    fn never_called(&mut self, execution: &Execution<'_>) {
        for (file, mut lines) in execution.never_called() {
            let head = lines.next();
            let moves = lines.any(|line| matches!(line.phrase, Phrase::Motion(_) | Phrase::Arc(_)));
            if let (true, Some(head)) = (moves, head) {
                self.milling.uncalled.push(self.files.span(file, head.span));
            }
        }
    }

    /// Carries out a statement.
    fn step(&mut self, execution: &Execution<'_>, line: &Line<'_>, place: Span) -> Next {
        let context = line.context;
        match &line.statement.phrase {
            Phrase::Mark(_) | Phrase::Def { .. } | Phrase::Ext { .. } => {}
            Phrase::End => return Next::Return,
            Phrase::Declaration(declaration) => {
                self.state.variables.declare(context, declaration);
                self.frames.declare(context, declaration);
            }
            Phrase::Motion(motion) => self.motion(context, motion, place),
            Phrase::Arc(arc) => self.arc(context, arc, place),
            Phrase::Assignment { to, value } => self.assign(context, to, value, place),
            Phrase::Bas { command, value } => self.bas(command, *value, place),
            Phrase::Call { name, arguments } => {
                return self.call(execution.find(line.file, name), name, arguments, place);
            }
            Phrase::Other(word) => return self.other(context, word, place),
            Phrase::WaitSec(_) | Phrase::WaitFor(_) | Phrase::Halt => self.milling.left_out.push(place),
            Phrase::DefDat { .. } | Phrase::EndDat => {
                self.push(complaints::unreadable(place, "an instruction, or `END`"));
            }
            Phrase::Unreadable { .. } if execution.is_at_end() => self.push(complaints::cut_short(place)),
            Phrase::Unreadable { expected } => self.push(complaints::unreadable(place, expected)),
        }
        Next::GoOn
    }

    fn call(&mut self, routine: Option<usize>, name: &str, arguments: &str, place: Span) -> Next {
        match routine {
            Some(routine) if arguments.is_empty() => return Next::Enter(routine),
            Some(_) => self.push(complaints::arguments(place, name)),
            None if MOTIONLESS.iter().any(|known| is_same_name(name, known)) => {
                self.milling.left_out.push(place);
            }
            None => {
                let first = self.files.files.first().map_or("", |file| &file.name);
                self.push(complaints::missing_routine(place, name, first));
            }
        }
        Next::GoOn
    }

    /// A statement that the syntax does not describe.
    fn other(&mut self, context: Context<'_>, word: &str, place: Span) -> Next {
        let is = |names: &[&str]| names.iter().any(|name| is_same_name(word, name));
        if is(&["CIRC", "CIRC_REL", "SCIRC", "SCIRC_REL", "SPL", "SPL_REL"]) {
            self.push(complaints::curve(place, word));
        } else if is(&[
            "LIN", "PTP", "SLIN", "SPTP", "LIN_REL", "PTP_REL", "SLIN_REL", "SPTP_REL",
        ]) {
            self.push(complaints::unknown_motion(place, self.files.said(place)));
        } else if is(&["RETURN"]) && self.forks.is_empty() && is_same_name(self.files.said(place), word) {
            return Next::Return;
        } else if is(&["GOTO", "RETURN", "RESUME"]) {
            self.push(complaints::jump(place, word));
        } else if is(&["IF", "FOR", "LOOP", "WHILE", "REPEAT", "SWITCH"]) {
            let reported = Reported::Not;
            self.forks.push(Fork { place, reported });
            self.milling.left_out.push(place);
        } else if is(&["ENDIF", "ENDFOR", "ENDLOOP", "ENDWHILE", "UNTIL", "ENDSWITCH"]) {
            self.forks.pop();
            self.milling.left_out.push(place);
        } else if is(&["SPLINE", "PTP_SPLINE", "ENDSPLINE", "CONTINUE"]) {
            let mut words = self.files.said(place).split_ascii_whitespace().skip(1);
            if words.next().is_some_and(|second| is_same_name(second, "WITH")) {
                self.push(complaints::block_with(place, word));
            }
            self.milling.settings.push(place);
        } else {
            self.unknown_value(context, word, place);
        }
        Next::GoOn
    }

    /// A statement that may give something a value that is worked out while the program runs.
    fn unknown_value(&mut self, context: Context<'_>, word: &str, place: Span) {
        let said = normalized(self.files.said(place)).to_ascii_uppercase();
        if is_same_name(word, "$VEL") || said.starts_with("BAS(#VEL_CP") || said.starts_with("BAS(#CP_PARAMS")
        {
            self.speed = None;
        } else if let Some(frame) = said.strip_prefix("BAS(#") {
            let name = frame.split([',', ')']).next().unwrap_or_default();
            // Another one each time, for all that is known.
            self.frame(name, &format!("{said}#{}", self.statements), place);
        } else {
            self.frame(word, &format!("{said}#{}", self.statements), place);
        }
        self.state.variables.forget(context, word);
        self.milling.left_out.push(place);
    }

    pub(super) fn push(&mut self, complaint: Diagnostic) {
        if self.complaints.len() < MOST_COMPLAINTS {
            self.complaints.push(complaint);
        }
    }

    fn assign(&mut self, context: Context<'_>, to: &Variable<'_>, value: &Value<'_>, place: Span) {
        for (velocity, number) in velocities(to, value).into_iter().flatten() {
            match velocity {
                Some(Velocity::Path) => self.drive(number, place),
                Some(Velocity::Swivel) if self.forks.is_empty() => {
                    self.milling.turning = number.or(self.milling.turning);
                }
                Some(Velocity::Swivel | Velocity::Twist) | None => {}
            }
        }
        self.framed(context, to, value, place);
        let is_followed = is_setting(to.name)
            || self.forks.is_empty() && self.state.variables.assign(context, to, value) == Outcome::Known;
        if is_followed {
            self.milling.settings.push(place);
        } else {
            // A motion there now goes to a place that is not known.
            self.state.variables.forget(context, to.name);
            self.milling.left_out.push(place);
        }
    }

    /// Takes a speed over. One that is worked out while the program runs, or set on one of several ways through it, is not
    /// known: what needs it has to state it.
    fn drive(&mut self, value: Option<f64>, place: Span) {
        let value = value.filter(|_| self.forks.is_empty());
        self.speed = value.map(|value| Written { value, place });
    }

    /// `BAS (#command,value)`, a routine of every controller.
    fn bas(&mut self, command: &str, value: Option<f64>, place: Span) {
        let is = |name| is_same_name(command, name);
        match value {
            Some(value) if is("VEL_CP") || is("CP_PARAMS") => self.drive(Some(value), place),
            Some(number) => self.frame(command, &number.to_string(), place),
            None => {}
        }
        self.milling.settings.push(place);
    }
}

/// Routines of every controller that are called from programs and move nothing.
const MOTIONLESS: [&str; 10] = [
    "A10_INI",
    "APPLICATION_INI",
    "IR_STOPM",
    "MSGDIALOG",
    "MSGNOTIFY",
    "MSGQUIT",
    "P00",
    "SET_CD_PARAMS",
    "USERSPOT",
    "USER_GRP",
];

/// Variables that set up motions, and those that inline forms of the pendant leave behind.
fn is_setting(variable: &str) -> bool {
    frames::SETUP.iter().any(|name| is_same_name(variable, name))
}

//! From the text of a KRL program to its motions.
//!
//! Statements, routines and named positions are those of the KRL crate. Routines are followed from call to call; where a
//! motion leads is for [`motions`]. Statements that decide which motions are made (`IF`, `LOOP`, `GOTO` and their
//! like) are not followed: with a motion inside they are refused. So are calls of routines that no file given holds, for
//! their motions would be missing.

mod frames;
mod motions;

use super::complaints;
use super::milling::{Milling, Written};
use frames::Frames;
use motions::Tool;
use vcutc_backend_api::readback::{ProgramFile, essence};
use vcutc_backend_krl::read::index::{FileKind, Index, stem};
use vcutc_backend_krl::read::syntax::{
    Phrase, Span as Bytes, Statement, Statements, Value, Variable, is_same_name, statements,
};
use vcutc_backend_krl::read::variables::{Asker, Outcome, Variables};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::{FileId, SourceMap, Span};

/// Most motions of a program.
const MOST_MOVES: usize = 4_000_000;

/// Most statements that are carried out, those of routines that are called several times counted each time.
const MOST_STATEMENTS: usize = 40_000_000;

/// How deep routines may call one another.
const DEEPEST: usize = 64;

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

    fn span(&self, file: usize, bytes: Bytes) -> Option<Span> {
        let id = *self.ids.get(file)?;
        Some(Span::of_bytes(id, bytes.start..bytes.end))
    }

    /// What stands at a place.
    pub(super) fn said(&self, place: Span) -> &'t str {
        let at = self.ids.iter().position(|&id| id == place.file);
        let text = at.map_or("", |file| self.text(file));
        text.get(place.bytes()).unwrap_or_default().trim()
    }

    fn text(&self, file: usize) -> &'t str {
        self.files.get(file).map_or("", |file| &file.text)
    }
}

/// The motions of a program.
///
/// # Errors
/// What cannot be followed.
pub(super) fn read(files: &Files<'_>) -> Result<Milling, Vec<Diagnostic>> {
    let index = Index::of(files.files);
    let mut reader = Reader {
        files,
        index: &index,
        variables: Variables::default(),
        milling: Milling::empty(files.start),
        tool: Tool::default(),
        speed: None,
        forks: Vec::new(),
        frames: Frames::default(),
        entered: vec![false; index.routines.len()],
        complaints: Vec::new(),
        statements: 0,
    };
    reader.outside();
    for (file, source) in files.files.iter().enumerate() {
        match FileKind::of(source) {
            FileKind::Data => reader.data(file, source),
            FileKind::Source => {}
        }
    }
    match index.main() {
        Some(main) => reader.follow(main),
        None => reader.complaints.push(complaints::no_routine(files.start)),
    }
    reader.never_called();
    reader.milling.external = reader.tool.external();
    if reader.complaints.is_empty() {
        Ok(reader.milling)
    } else {
        Err(reader.complaints)
    }
}

/// Goes through a program.
pub(super) struct Reader<'t, 'i> {
    pub(super) files: &'i Files<'t>,
    index: &'i Index<'t>,
    pub(super) variables: Variables,
    pub(super) milling: Milling,
    pub(super) tool: Tool,
    pub(super) speed: Option<Written>,
    /// Statements that decide what is made, and are open; each with whether a motion in it was told.
    pub(super) forks: Vec<Fork>,
    pub(super) frames: Frames,
    /// Which routines have been carried out.
    entered: Vec<bool>,
    complaints: Vec<Diagnostic>,
    statements: usize,
}

/// A statement that decides what is made.
pub(super) struct Fork {
    pub(super) place: Span,
    pub(super) told: Told,
}

/// Whether a motion that depends on a statement was told.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Told {
    Not,
    Once,
}

/// A routine that is being carried out.
struct Call<'t> {
    file: usize,
    routine: usize,
    lines: Statements<'t>,
    /// The statement before the one that comes next.
    last: Option<Span>,
}

/// Whether to go on with a routine.
enum Next {
    GoOn,
    Enter(usize),
    Return,
    Stop,
}

impl<'t> Reader<'t, '_> {
    fn data(&mut self, file: usize, source: &'t ProgramFile) {
        let asker = Asker {
            routine: None,
            module: stem(&source.name).0,
        };
        for line in statements(&source.text) {
            match &line.phrase {
                Phrase::Declaration(declaration) => {
                    self.variables.declare(asker, declaration);
                    self.frames.declare(asker, declaration);
                }
                Phrase::Assignment { to, value } => {
                    self.variables.assign(asker, to, value);
                }
                Phrase::Unreadable { expected } => self.unreadable(file, &line, expected),
                Phrase::Mark(_)
                | Phrase::Def { .. }
                | Phrase::End
                | Phrase::DefDat { .. }
                | Phrase::EndDat
                | Phrase::Ext { .. }
                | Phrase::Motion(_)
                | Phrase::Arc(_)
                | Phrase::Bas { .. }
                | Phrase::Call { .. }
                | Phrase::WaitSec(_)
                | Phrase::WaitFor(_)
                | Phrase::Halt
                | Phrase::Other(_) => {}
            }
        }
    }

    fn call(&self, routine: usize) -> Option<Call<'t>> {
        let found = self.index.routines.get(routine)?;
        Some(Call {
            file: found.file,
            routine,
            lines: Statements::within(self.files.text(found.file), found.span),
            last: None,
        })
    }

    fn follow(&mut self, main: usize) {
        if let Some(entered) = self.entered.get_mut(main) {
            *entered = true;
        }
        let mut calls: Vec<Call<'t>> = self.call(main).into_iter().collect();
        while let Some(mut call) = calls.pop() {
            let Some(line) = call.lines.next() else {
                let nothing = self.files.span(call.file, Bytes { start: 0, end: 0 });
                self.milling.ends_early.extend(call.last.or(nothing));
                continue;
            };
            self.statements += 1;
            let is_endless = self.statements > MOST_STATEMENTS
                || self.milling.moves.len() > MOST_MOVES
                || calls.len() > DEEPEST;
            if is_endless {
                self.complain(call.file, &line, complaints::endless);
                return;
            }
            call.last = self.files.span(call.file, line.span);
            match self.step(&call, &line) {
                Next::GoOn => calls.push(call),
                Next::Enter(routine) => {
                    calls.push(call);
                    calls.extend(self.call(routine));
                }
                Next::Return => {}
                Next::Stop => return,
            }
        }
    }

    fn complain(&mut self, file: usize, line: &Statement<'_>, words: impl Fn(Span) -> Diagnostic) {
        if let Some(place) = self.files.span(file, line.span)
            && self.complaints.len() < MOST_COMPLAINTS
        {
            self.complaints.push(words(place));
        }
    }

    fn unreadable(&mut self, file: usize, line: &Statement<'_>, expected: &str) {
        self.complain(file, line, |place| complaints::unreadable(place, expected));
    }

    /// What stands outside of routines belongs to none, and no controller carries it out.
    fn outside(&mut self) {
        for &(file, span) in &self.index.gaps {
            for line in Statements::within(self.files.text(file), span) {
                match line.phrase {
                    Phrase::Mark(_) => {}
                    _ => self.complain(file, &line, complaints::outside),
                }
            }
        }
    }

    /// Routines with motions that nobody has called.
    fn never_called(&mut self) {
        let routines = self.index.routines.iter().zip(&self.entered);
        for (routine, _) in routines.filter(|(_, entered)| !**entered) {
            let mut lines = Statements::within(self.files.text(routine.file), routine.span);
            let head = lines.next();
            let moves = lines.any(|line| matches!(line.phrase, Phrase::Motion(_) | Phrase::Arc(_)));
            if let (true, Some(head)) = (moves, head) {
                self.milling
                    .uncalled
                    .extend(self.files.span(routine.file, head.span));
            }
        }
    }

    /// Carries out a statement.
    fn step(&mut self, call: &Call<'t>, line: &Statement<'t>) -> Next {
        let Some(place) = self.files.span(call.file, line.span) else {
            return Next::Stop;
        };
        let asker = Asker {
            routine: Some(call.routine),
            module: self.module(call.file),
        };
        match &line.phrase {
            Phrase::Mark(_) | Phrase::Def { .. } | Phrase::Ext { .. } => {}
            Phrase::End => return Next::Return,
            Phrase::Declaration(declaration) => {
                self.variables.declare(asker, declaration);
                self.frames.declare(asker, declaration);
            }
            Phrase::Motion(motion) => self.motion(asker, motion, place),
            Phrase::Arc(arc) => self.arc(asker, arc, place),
            Phrase::Assignment { to, value } => self.assign(asker, to, value, place),
            Phrase::Bas { command, value } => self.bas(command, *value, place),
            Phrase::Call { name, arguments } => return self.enter(call.file, name, arguments, place),
            Phrase::Other(word) => return self.other(asker, word, place),
            Phrase::WaitSec(_) | Phrase::WaitFor(_) | Phrase::Halt => self.milling.left_out.push(place),
            Phrase::DefDat { .. } | Phrase::EndDat => {
                self.unreadable(call.file, line, "an instruction, or `END`")
            }
            Phrase::Unreadable { .. } if call.lines.clone().next().is_none() => {
                self.push(complaints::cut_short(place));
            }
            Phrase::Unreadable { expected } => self.unreadable(call.file, line, expected),
        }
        Next::GoOn
    }

    fn module(&self, file: usize) -> &'t str {
        self.files.files.get(file).map_or("", |file| stem(&file.name).0)
    }

    fn enter(&mut self, file: usize, name: &str, arguments: &str, place: Span) -> Next {
        match self.index.find(file, name) {
            Some(routine) if arguments.is_empty() => {
                if let Some(entered) = self.entered.get_mut(routine) {
                    *entered = true;
                }
                return Next::Enter(routine);
            }
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
    fn other(&mut self, asker: Asker<'_>, word: &str, place: Span) -> Next {
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
            let told = Told::Not;
            self.forks.push(Fork { place, told });
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
            self.unknown_value(asker, word, place);
        }
        Next::GoOn
    }

    /// A statement that may give something a value that is worked out while the program runs.
    fn unknown_value(&mut self, asker: Asker<'_>, word: &str, place: Span) {
        let said = essence(self.files.said(place)).to_ascii_uppercase();
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
        self.variables.forget(asker, word);
        self.milling.left_out.push(place);
    }

    pub(super) fn push(&mut self, complaint: Diagnostic) {
        if self.complaints.len() < MOST_COMPLAINTS {
            self.complaints.push(complaint);
        }
    }

    fn assign(&mut self, asker: Asker<'_>, to: &Variable<'_>, value: &Value<'_>, place: Span) {
        let number = match value {
            Value::Number(number) => Some(*number),
            Value::Bool(_)
            | Value::Enum(_)
            | Value::Text(_)
            | Value::Coordinates(_)
            | Value::Structure(_)
            | Value::Variable(_) => None,
        };
        if to.is_field("$VEL", "CP") {
            self.drive(number, place);
        } else if let (true, Value::Structure(fields)) = (to.is("$VEL"), value) {
            for field in fields {
                if let (true, Value::Number(value)) = (is_same_name(field.name, "CP"), &field.value) {
                    self.drive(Some(*value), place);
                }
            }
        } else if to.is_field("$VEL", "ORI1") && self.forks.is_empty() {
            self.milling.turning = number.or(self.milling.turning);
        }
        self.framed(asker, to, value, place);
        let is_followed = is_setting(to)
            || self.forks.is_empty() && self.variables.assign(asker, to, value) == Outcome::Known;
        if is_followed {
            self.milling.settings.push(place);
        } else {
            // Whoever moves there now goes to a place that is not known.
            self.variables.forget(asker, to.name);
            self.milling.left_out.push(place);
        }
    }

    /// Takes a speed over. One that is worked out while the program runs, or set on one of several ways through it, is not
    /// known: whoever needs it has to say it.
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
fn is_setting(variable: &Variable<'_>) -> bool {
    frames::SETUP.iter().any(|name| is_same_name(variable.name, name))
}

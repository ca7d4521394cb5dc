//! From the text of a KRL program to its motions.
//!
//! Statements, routines and named positions are those of the KRL crate. Routines are followed from call to call. What a
//! target leaves out keeps the value that it had. Statements that decide which motions are made (`IF`, `LOOP`, `GOTO` and
//! their like) are not followed: with a motion inside they are refused.

use super::complaints;
use super::milling::{Milling, Move, Way, Written};
use crate::diag::Diagnostic;
use crate::source::{FileId, SourceMap, Span};
use std::collections::BTreeMap;
use vcutc_backend_api::geometry::{Orientation, Zyx};
use vcutc_backend_api::readback::ProgramFile;
use vcutc_backend_api::units::Angle;
use vcutc_backend_krl::read::index::{FileKind, Index, stem};
use vcutc_backend_krl::read::syntax::{
    Component, Coordinates, Motion, MotionWord, Phrase, Span as Bytes, Statement, Statements, Target, Value,
    Variable, is_same_name, statements,
};
use vcutc_backend_krl::read::variables::{Asker, Outcome, Variables};

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
    fn said(&self, place: Span) -> &'t str {
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
        last: Coordinates::default(),
        speed: None,
        forks: Vec::new(),
        frames: BTreeMap::new(),
        reframed: None,
        complaints: Vec::new(),
        statements: 0,
    };
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
    if reader.complaints.is_empty() {
        Ok(reader.milling)
    } else {
        Err(reader.complaints)
    }
}

/// Goes through a program.
struct Reader<'t, 'i> {
    files: &'i Files<'t>,
    index: &'i Index<'t>,
    variables: Variables,
    milling: Milling,
    /// What targets have said so far.
    last: Coordinates,
    speed: Option<Written>,
    /// Statements that decide what is made, and are open.
    forks: Vec<Span>,
    /// What sets the tool and the base, by its name in capitals: how it was said last.
    frames: BTreeMap<String, &'t str>,
    /// Where one of them was said that was not so before, if no straight motion has followed yet.
    reframed: Option<Span>,
    complaints: Vec<Diagnostic>,
    statements: usize,
}

/// A routine that is being carried out.
struct Call<'t> {
    file: usize,
    routine: usize,
    lines: Statements<'t>,
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
        })
    }

    fn follow(&mut self, main: usize) {
        let mut calls: Vec<Call<'t>> = self.call(main).into_iter().collect();
        while let Some(mut call) = calls.pop() {
            let Some(line) = call.lines.next() else { continue };
            self.statements += 1;
            let is_endless = self.statements > MOST_STATEMENTS
                || self.milling.moves.len() > MOST_MOVES
                || calls.len() > DEEPEST;
            if is_endless {
                self.complain(call.file, &line, complaints::endless);
                return;
            }
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

    /// Carries out a statement.
    fn step(&mut self, call: &Call<'t>, line: &Statement<'t>) -> Next {
        let Some(place) = self.files.span(call.file, line.span) else {
            return Next::Stop;
        };
        let module = self
            .files
            .files
            .get(call.file)
            .map_or("", |file| stem(&file.name).0);
        let asker = Asker {
            routine: Some(call.routine),
            module,
        };
        match &line.phrase {
            Phrase::Mark(_) | Phrase::Def { .. } | Phrase::Ext { .. } => {}
            Phrase::End => return Next::Return,
            Phrase::Declaration(declaration) => {
                self.variables.declare(asker, declaration);
            }
            Phrase::Motion(motion) => self.motion(asker, motion, place),
            Phrase::Assignment { to, value } => self.assign(asker, to, value, place),
            Phrase::Bas { command, value } => {
                if let (true, Some(value)) = (is_same_name(command, "VEL_CP"), *value) {
                    self.speed = Some(Written { value, place });
                }
                if is_frame(command) {
                    self.frame(&command.to_ascii_uppercase(), place);
                }
                self.milling.settings.push(place);
            }
            Phrase::Call { name, arguments } => return self.enter(call.file, name, arguments, place),
            Phrase::Other(word) => return self.other(word, place),
            Phrase::WaitSec(_) | Phrase::WaitFor(_) | Phrase::Halt => self.milling.left_out.push(place),
            Phrase::DefDat { .. } | Phrase::EndDat => {
                self.unreadable(call.file, line, "an instruction, or `END`")
            }
            Phrase::Unreadable { expected } => self.unreadable(call.file, line, expected),
        }
        Next::GoOn
    }

    fn enter(&mut self, file: usize, name: &str, arguments: &str, place: Span) -> Next {
        match self.index.find(file, name) {
            Some(routine) if arguments.is_empty() => Next::Enter(routine),
            Some(_) => {
                self.push(complaints::arguments(place, name));
                Next::GoOn
            }
            None => {
                self.milling.left_out.push(place);
                Next::GoOn
            }
        }
    }

    /// A statement that the syntax does not describe.
    fn other(&mut self, word: &str, place: Span) -> Next {
        let is = |names: &[&str]| names.iter().any(|name| is_same_name(word, name));
        if is(&["CIRC", "CIRC_REL", "SCIRC", "SCIRC_REL", "SPL", "SPL_REL"]) {
            self.push(complaints::arc(place, word));
        } else if is(&[
            "LIN", "PTP", "SLIN", "SPTP", "LIN_REL", "PTP_REL", "SLIN_REL", "SPTP_REL",
        ]) {
            self.push(complaints::unknown_motion(place));
        } else if is(&["GOTO", "RETURN", "RESUME"]) {
            self.push(complaints::jump(place, word));
        } else if is(&["IF", "FOR", "LOOP", "WHILE", "REPEAT", "SWITCH"]) {
            self.forks.push(place);
            self.milling.left_out.push(place);
        } else if is(&["ENDIF", "ENDFOR", "ENDLOOP", "ENDWHILE", "UNTIL", "ENDSWITCH"]) {
            self.forks.pop();
            self.milling.left_out.push(place);
        } else if is(&["SPLINE", "ENDSPLINE", "GLOBAL", "INTERRUPT", "CONTINUE"]) {
            self.milling.settings.push(place);
        } else {
            self.milling.left_out.push(place);
        }
        Next::GoOn
    }

    fn push(&mut self, complaint: Diagnostic) {
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
            match number {
                Some(value) => self.speed = Some(Written { value, place }),
                // Worked out while the program runs: whoever needs it has to say it.
                None => self.speed = None,
            }
        } else if let (true, Value::Structure(fields)) = (to.is("$VEL"), value) {
            for field in fields {
                if let (true, Value::Number(value)) = (is_same_name(field.name, "CP"), &field.value) {
                    self.speed = Some(Written { value: *value, place });
                }
            }
        } else if to.is_field("$VEL", "ORI1") {
            self.milling.turning = number.or(self.milling.turning);
        }
        if is_frame(to.name) {
            self.frame(&to.name.to_ascii_uppercase(), place);
        }
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

    /// Takes what sets the tool or the base. One for all passes is the job's own frame; a change between them is not followed.
    fn frame(&mut self, what: &str, place: Span) {
        let said = self.files.said(place);
        if self.frames.insert(what.to_owned(), said) != Some(said) {
            self.reframed = Some(place);
        }
    }

    fn motion(&mut self, asker: Asker<'_>, motion: &Motion<'_>, place: Span) {
        if let Some(&fork) = self.forks.last() {
            self.push(complaints::fork(place, fork));
            return;
        }
        let (way, is_relative) = match motion.word {
            MotionWord::Lin | MotionWord::Slin => (Way::Straight, false),
            MotionWord::Ptp | MotionWord::Sptp => (Way::Joint, false),
            MotionWord::LinRel | MotionWord::SlinRel => (Way::Straight, true),
            MotionWord::PtpRel | MotionWord::SptpRel => (Way::Joint, true),
        };
        if let (Some(changed), Way::Straight) = (self.reframed, way) {
            self.reframed = None;
            if self.milling.moves.iter().any(|made| made.way == Way::Straight) {
                self.push(complaints::frame_changes(changed));
            }
        }
        let target = match motion.target {
            Target::Literal(coordinates) => Some(coordinates),
            Target::Variable(variable) => self.variables.get(asker, &variable),
        };
        let Some(target) = target.filter(|target| !target.has_any(&Component::AXES)) else {
            return self.elsewhere(way, target.is_some(), place);
        };
        for component in Component::TIP.into_iter().chain(Component::ANGLES) {
            if let Some(value) = target.get(component) {
                let before = if is_relative {
                    self.last.get(component).unwrap_or(0.0)
                } else {
                    0.0
                };
                self.last.set(component, before + value);
            }
        }
        let to = self.last.all(Component::TIP);
        if to.is_none() && way == Way::Straight {
            self.push(complaints::unknown_end(
                place,
                "not all of X, Y and Z have been said so far",
            ));
        }
        let attitude = self.last.all(Component::ANGLES).map(|[a, b, c]| {
            Orientation::from_zyx(Zyx {
                a: Angle::deg(a),
                b: Angle::deg(b),
                c: Angle::deg(c),
            })
        });
        self.milling.moves.push(Move {
            place,
            way,
            to,
            attitude,
            speed: self.speed,
        });
    }

    /// A motion to axis values, or to a position that nobody knows.
    fn elsewhere(&mut self, way: Way, has_axes: bool, place: Span) {
        self.last = Coordinates::default();
        if has_axes || way == Way::Joint {
            self.milling.axis_moves += 1;
            self.milling.settings.push(place);
            self.milling.moves.push(Move {
                place,
                way: Way::Joint,
                to: None,
                attitude: None,
                speed: self.speed,
            });
        } else {
            self.push(complaints::unknown_end(
                place,
                "no position of this name is declared in the files given, or it was changed in a way that is not followed",
            ));
        }
    }
}

/// What sets the frames that targets are told in: variables, and commands of `BAS`.
fn is_frame(name: &str) -> bool {
    ["$TOOL", "$BASE", "TOOL", "BASE"]
        .iter()
        .any(|frame| is_same_name(frame, name))
}

/// Variables that set up motions, and those that inline forms of the pendant leave behind.
fn is_setting(variable: &Variable<'_>) -> bool {
    const SYSTEM: [&str; 21] = [
        "$VEL",
        "$ACC",
        "$APO",
        "$ORI_TYPE",
        "$CIRC_TYPE",
        "$ADVANCE",
        "$TOOL",
        "$BASE",
        "$LOAD",
        "$IPO_MODE",
        "$ACT_TOOL",
        "$ACT_BASE",
        "$VEL_AXIS",
        "$ACC_AXIS",
        "$BWDSTART",
        "$H_POS",
        "$JERK",
        "$GEAR_JERK",
        "PDAT_ACT",
        "LDAT_ACT",
        "FDAT_ACT",
    ];
    SYSTEM.iter().any(|name| is_same_name(variable.name, name))
}

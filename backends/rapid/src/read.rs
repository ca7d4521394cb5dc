//! Reads programs of RAPID back: modules, the data they declare, and what `main` does with them.
//!
//! The way of a text: [`mod@lex`] finds words and signs, [`piece`] the stretches of statements, [`program`] the modules with
//! their data and routines. Then the routines are followed from `main` on, call by call; every statement on the way is read by
//! [`mod@sentence`] and reported in the terms of [`instruction`]. The list of modules ([`mod@list`]) says
//! what is loaded.
//!
//! Understood is the part of the language that programs for cutting need, in any layout, with literal or named data. All
//! else is reported as unknown: conditions, loops, arithmetic, other tools, other modes. A routine that is
//! called a second time is unknown too, since its statements would be carried out twice.

mod data;
mod instruction;
mod lex;
mod list;
mod piece;
mod program;
mod sentence;

pub(crate) use sentence::{Sentence, Value};

use crate::options::Settings;
use crate::orient::RESOLUTION_RAD;
use data::{View, seen_from};
use instruction::{Instruction, Known, Machine, Modes};
use piece::{Piece, PieceKind, pieces};
use program::Program;
use sentence::sentence;
use std::collections::BTreeSet;
use vcutc_backend_api::backend::Options;
use vcutc_backend_api::confdata::confdata;
use vcutc_backend_api::ir::{AxisValues, ToolId};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::readback::{
    Command, Configuration, Effect, FrameRole, FrameSetting, Frames, Place, Reader, Resolution, Sources,
    Statement, has_extension, normalized,
};
use vcutc_backend_api::script::TRIMMED;
use vcutc_backend_api::units::{Angle, AngularSpeed, Duration, Length, Speed};

/// Extensions of modules and lists.
const EXTENSIONS: [&str; 5] = ["mod", "modx", "sys", "sysx", "pgf"];

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RapidReader;

impl Reader for RapidReader {
    fn recognises(&self, file: &str) -> bool {
        has_extension(file, &EXTENSIONS)
    }

    fn resolution(&self, options: &Options) -> Resolution {
        let settings = Settings::read(options);
        let trimmed = TRIMMED.half_unit();
        Resolution {
            length: Length::mm(settings.common.lengths.half_unit()),
            attitude: Angle::rad(RESOLUTION_RAD),
            axis: Angle::deg(settings.angles.half_unit()),
            speed: Speed::mm_per_s(trimmed),
            rate: AngularSpeed::deg_per_s(trimmed),
            per_minute: trimmed,
            time: Duration::s(trimmed),
        }
    }

    /// Every move names its frames, and those that the program declares are reported once, for all of its
    /// parts.
    fn frames(&self) -> Frames {
        Frames::OnMachine
    }

    fn configuration(&self, branch: Branch, axes: AxisValues) -> Option<Configuration> {
        confdata(branch, &axes).map(Configuration)
    }

    fn states_waypoints(&self) -> bool {
        true
    }

    fn read(&self, sources: Sources<'_>, visit: &mut dyn FnMut(Statement)) {
        let settings = Settings::read(sources.options);
        let machine = Machine {
            cell: sources.cell,
            settings: &settings,
        };
        let program = Program::of(sources.files, machine);
        let reported = program
            .modules
            .iter()
            .map(|module| vec![Reported::Not; module.pieces.len()]);
        let mut interpreter = Interpreter {
            reported: reported.collect(),
            at_hand: None,
            own: lines_of(settings.common.profile),
            machine,
            program,
            visit,
        };
        interpreter.known_beforehand();
        interpreter.follow();
        interpreter.never_carried_out();
    }
}

/// The statements that the profile of the machine puts into programs, without their layout.
fn lines_of(profile: &Profile) -> BTreeSet<String> {
    let lines = profile.header.iter().chain(&profile.footer);
    lines
        .flat_map(|line| {
            let all = pieces(line).all.into_iter();
            all.map(|piece| normalized(piece.text(line))).collect::<Vec<_>>()
        })
        .collect()
}

/// The statements of a line that stands by itself. None when it has anything else, such as control flow.
pub(crate) fn sentences(line: &str) -> Option<Vec<Sentence>> {
    let all = pieces(line).all.into_iter();
    all.map(|piece| match piece.kind {
        PieceKind::Statement => sentence(piece.text(line)).ok(),
        _ => None,
    })
    .collect()
}

/// Whether a piece was reported.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reported {
    Not,
    Already,
}

/// A routine that is being followed.
struct Running {
    routine: usize,
    /// The piece to come, in its module.
    next: usize,
}

struct Interpreter<'a, 'h> {
    program: Program<'a>,
    machine: Machine<'a>,
    /// Which pieces were reported, by module.
    reported: Vec<Vec<Reported>>,
    /// The tool of the move before, where there are several.
    at_hand: Option<ToolId>,
    /// Statements of the machine's profile.
    own: BTreeSet<String>,
    visit: &'h mut dyn FnMut(Statement),
}

impl Interpreter<'_, '_> {
    /// Reports a piece of a file.
    fn place(&mut self, file: u32, piece: Piece, effect: Effect) {
        let Piece { start, end, .. } = piece;
        (self.visit)(Statement {
            place: Place { file, start, end },
            effect,
        });
    }

    /// Reports a piece of a module. Returns whether it had not been reported before.
    fn report(&mut self, module: usize, piece: usize, effect: Effect) -> bool {
        let flag = self
            .reported
            .get_mut(module)
            .and_then(|reported| reported.get_mut(piece));
        let is_new = flag.is_some_and(|flag| core::mem::replace(flag, Reported::Already) == Reported::Not);
        if is_new && let Some(of) = self.program.modules.get(module) {
            let file = of.file;
            if let Some(&stretch) = of.pieces.get(piece) {
                self.place(file, stretch, effect);
            }
        }
        is_new
    }

    /// Lists, declarations, and the frames of modules.
    fn known_beforehand(&mut self) {
        for list in core::mem::take(&mut self.program.lists) {
            for (piece, effect) in list.statements {
                self.place(list.file, piece, effect);
            }
        }
        for module in 0..self.program.modules.len() {
            let effect = self
                .program
                .modules
                .get_mut(module)
                .map(|module| core::mem::take(&mut module.effect));
            for (piece, effect) in effect.into_iter().flatten() {
                self.report(module, piece, effect);
            }
        }
    }

    /// Follows the program from its entry to its end.
    fn follow(&mut self) {
        let mut modes = Modes::default();
        let mut stack = Vec::new();
        if let Some(main) = self.program.main() {
            stack.extend(self.enter(main, Effect::Setting));
        }
        while let Some(running) = stack.last_mut() {
            let Some(routine) = self.program.routines.get(running.routine) else {
                break;
            };
            let (module, number, place) = (routine.module, running.routine, running.next);
            if place >= routine.pieces.end {
                stack.pop();
                continue;
            }
            running.next += 1;
            if let Some(called) = self.step(module, number, place, &mut modes) {
                modes = Modes::default();
                stack.extend(self.enter(called, Effect::PartBegins));
            }
        }
    }

    /// Reports the header of a routine. Returns what to follow, unless it was followed before.
    fn enter(&mut self, routine: usize, effect: Effect) -> Option<Running> {
        let of = self.program.routines.get(routine)?;
        let (module, header) = (of.module, of.pieces.start);
        let next = header + 1;
        self.report(module, header, effect)
            .then_some(Running { routine, next })
    }

    /// Whether a routine can be followed from here.
    fn is_fresh(&self, routine: usize) -> bool {
        let fresh = self.program.routines.get(routine).and_then(|of| {
            let reported = self.reported.get(of.module)?.get(of.pieces.start)?;
            Some(of.plain && !of.pieces.is_empty() && *reported == Reported::Not)
        });
        fresh == Some(true)
    }

    /// Reports a piece of a routine. Returns the routine that it calls.
    fn step(&mut self, module: usize, routine: usize, place: usize, modes: &mut Modes) -> Option<usize> {
        let of = self.program.modules.get(module)?;
        let piece = *of.pieces.get(place)?;
        let text = piece.text(of.text);
        let mut called = None;
        let mut takes = None;
        let effect = match piece.kind {
            PieceKind::EndRoutine => Effect::Setting,
            PieceKind::Broken => Effect::expected("`;`"),
            PieceKind::Statement => match sentence(text) {
                Ok(Sentence::Declaration { .. }) => Effect::Setting,
                Ok(Sentence::Assignment { name }) => {
                    self.program.data.forget(seen_from(module, Some(routine)), &name);
                    Effect::Unknown
                }
                Ok(Sentence::Instruction {
                    name,
                    required,
                    optional,
                }) => match self.program.routine(&name, module) {
                    Some(other) if self.is_fresh(other) && required.is_empty() && optional.is_empty() => {
                        called = Some(other);
                        Effect::Setting
                    }
                    Some(_) => Effect::Unknown,
                    None => {
                        let view = View {
                            data: &self.program.data,
                            module,
                            routine: Some(routine),
                        };
                        let instruction = Instruction {
                            name: &name,
                            required: &required,
                            optional: &optional,
                        };
                        let moves = self.machine.moves_with(instruction, view);
                        let found = self.machine.effect(instruction, view, modes);
                        if let (Some(moves), Effect::Command(_)) = (moves, &found.0) {
                            takes = self.takes(moves);
                        }
                        if let Effect::Command(Command::ChangeTool(_)) = found.0 {
                            // The next move states again which tool is at hand.
                            self.at_hand = None;
                        }
                        match found {
                            (_, Known::No) => self.own_or_unknown(text),
                            (effect, Known::Yes) => effect,
                        }
                    }
                },
                Err(expected) => Effect::Unreadable { expected },
            },
            PieceKind::Control => self.own_or_unknown(text),
            PieceKind::OldHead
            | PieceKind::Module
            | PieceKind::EndModule
            | PieceKind::Routine
            | PieceKind::OtherRoutine => Effect::Unknown,
        };
        if let (Some(setting), Some(file)) = (takes, self.program.modules.get(module).map(|of| of.file)) {
            self.place(file, piece, Effect::Frame(FrameRole::Tool, setting));
        }
        self.report(module, place, effect);
        called
    }

    /// The frame that a move takes, where it names another tool than the move before it.
    fn takes(&mut self, (tool, setting): (ToolId, FrameSetting)) -> Option<FrameSetting> {
        let is_known = !self.machine.cell.tools.are_several() || self.at_hand == Some(tool);
        self.at_hand = Some(tool);
        (!is_known).then_some(setting)
    }

    /// What the machine's profile puts into programs is known; nothing else is.
    fn own_or_unknown(&self, text: &str) -> Effect {
        if self.own.contains(&normalized(text)) {
            Effect::Setting
        } else {
            Effect::Unknown
        }
    }

    /// Routines that are never called, and modules that are not loaded.
    fn never_carried_out(&mut self) {
        for module in 0..self.reported.len() {
            let count = self.reported.get(module).map_or(0, Vec::len);
            for piece in 0..count {
                let kind = self
                    .program
                    .modules
                    .get(module)
                    .and_then(|of| of.pieces.get(piece));
                let effect = match kind.map(|piece| piece.kind) {
                    Some(PieceKind::Broken) => Effect::expected("`;`"),
                    Some(_) | None => Effect::Setting,
                };
                self.report(module, piece, effect);
            }
        }
    }
}

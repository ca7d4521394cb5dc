//! A program as its modules: which are loaded, what data they declare, and which routines they have.

use super::data::{Data, Datum, Scope, View};
use super::instruction::Machine;
use super::list::{Entry, entries};
use super::piece::{Piece, PieceKind, Pieces, pieces};
use super::sentence::{Sentence, Value, sentence};
use crate::names::MAIN;
use core::ops::Range;
use std::collections::{BTreeMap, BTreeSet};
use vcutc_backend_api::ir::{Inertia, Load, Registered, Tool, ToolId};
use vcutc_backend_api::readback::{Effect, FrameRole, FrameSetting, ProgramFile, has_extension, stem};
use vcutc_backend_api::script::TRIMMED;

/// A file with a module.
#[derive(Debug)]
pub(super) struct Module<'t> {
    pub(super) file: u32,
    pub(super) text: &'t str,
    pub(super) pieces: Vec<Piece>,
    /// What pieces say that are known before the program runs.
    pub(super) effect: BTreeMap<usize, Effect>,
}

/// A procedure.
#[derive(Debug)]
pub(super) struct Routine {
    pub(super) module: usize,
    /// Whether other modules cannot call it.
    pub(super) local: bool,
    /// Whether it takes no arguments.
    pub(super) plain: bool,
    /// Its place in the module's pieces, header and end included.
    pub(super) pieces: Range<usize>,
}

/// A file with a list of modules.
#[derive(Debug)]
pub(super) struct List {
    pub(super) file: u32,
    pub(super) statements: Vec<(Piece, Effect)>,
}

#[derive(Debug, Default)]
pub(super) struct Program<'t> {
    pub(super) lists: Vec<List>,
    pub(super) modules: Vec<Module<'t>>,
    pub(super) routines: Vec<Routine>,
    /// Places in that list, by name.
    named: BTreeMap<String, Vec<usize>>,
    pub(super) data: Data,
    /// Names that moves use for tools and work objects.
    used: BTreeSet<String>,
    /// Names of modules seen so far.
    names: BTreeSet<String>,
}

/// What is being read.
#[derive(Clone, Copy)]
enum Within {
    Nothing,
    Module,
    Routine { index: Option<usize>, start: usize },
}

/// Whether a routine ends.
#[derive(Clone, Copy)]
enum Ends {
    Here,
    Later,
}

impl<'t> Program<'t> {
    /// Reads the files of a program.
    pub(super) fn of(files: &'t [ProgramFile], machine: Machine<'_>) -> Self {
        let mut program = Self::default();
        let loaded = program.lists(files);
        for (number, file) in (0..).zip(files).filter(|(_, file)| !is_list(&file.name)) {
            let Pieces { all, used } = pieces(&file.text);
            let mut module = Module {
                file: number,
                text: &file.text,
                pieces: all,
                effect: BTreeMap::new(),
            };
            let (stem, _) = stem(&file.name);
            if loaded
                .as_ref()
                .is_none_or(|names| names.contains(&file.name.to_ascii_uppercase()))
            {
                program.used.extend(used);
                program.structure(&mut module, stem);
            }
            program.modules.push(module);
        }
        program.frames(machine);
        program
    }

    /// Reads the lists; the files that they name, in upper case. Without a list all files are loaded.
    fn lists(&mut self, files: &[ProgramFile]) -> Option<BTreeSet<String>> {
        let there: BTreeSet<String> = files.iter().map(|file| file.name.to_ascii_uppercase()).collect();
        let mut named: Option<BTreeSet<String>> = None;
        for (number, file) in (0..).zip(files).filter(|(_, file)| is_list(&file.name)) {
            let is_first = named.is_none();
            let names = named.get_or_insert_default();
            let mut effect = |entry: &Entry| match (entry.piece.kind, &entry.module) {
                (PieceKind::Broken, _) => {
                    Effect::expected("a list of modules, `<Program> <Module>NAME.mod</Module> </Program>`")
                }
                _ if !is_first => Effect::Unknown,
                (_, Some(module)) => {
                    let name = module.to_ascii_uppercase();
                    let is_there = there.contains(&name) && names.insert(name);
                    if is_there {
                        Effect::Setting
                    } else {
                        Effect::Unknown
                    }
                }
                (_, None) => Effect::Setting,
            };
            let statements = entries(&file.text).into_iter();
            let statements = statements.map(|entry| (entry.piece, effect(&entry))).collect();
            self.lists.push(List {
                file: number,
                statements,
            });
        }
        named
    }

    /// Finds the routines and data of a module that is loaded.
    fn structure(&mut self, module: &mut Module<'t>, stem: &str) {
        let mut within = Within::Nothing;
        let mut header = None;
        for (place, &piece) in module.pieces.iter().enumerate() {
            let text = piece.text(module.text);
            let (effect, next) = match within {
                Within::Nothing => match piece.kind {
                    PieceKind::OldHead if place == 0 => (Some(Effect::Setting), within),
                    PieceKind::Module if header.is_none() => {
                        header = Some(place);
                        (Some(self.module_header(text, stem)), Within::Module)
                    }
                    _ => (
                        Some(Effect::expected("MODULE, and nothing before or after it")),
                        within,
                    ),
                },
                Within::Module => self.in_module(piece.kind, text, place),
                Within::Routine { index, start } => {
                    let (effect, ends) = self.in_routine(piece.kind, text, index);
                    match (ends, index.and_then(|index| self.routines.get_mut(index))) {
                        (Ends::Here, Some(routine)) => routine.pieces = start..place + 1,
                        (Ends::Here, None) | (Ends::Later, _) => {}
                    }
                    let next = match ends {
                        Ends::Here => Within::Module,
                        Ends::Later => within,
                    };
                    (effect, next)
                }
            };
            if let Some(effect) = effect {
                module.effect.insert(place, effect);
            }
            within = next;
        }
        match (within, header) {
            (Within::Nothing, Some(_)) | (_, None) => {}
            (_, Some(header)) => {
                let missing = Effect::expected("ENDMODULE at the end of this module");
                module.effect.insert(header, missing);
            }
        }
    }

    /// A piece between the head and the end of the module that comes next, and where the piece after it is.
    fn in_module(&mut self, kind: PieceKind, text: &str, start: usize) -> (Option<Effect>, Within) {
        let module = self.modules.len();
        match kind {
            PieceKind::EndModule => (Some(Effect::Setting), Within::Nothing),
            PieceKind::Routine => {
                let (effect, index) = self.routine_header(text, module);
                (effect, Within::Routine { index, start })
            }
            PieceKind::OtherRoutine => (Some(Effect::Setting), Within::Routine { index: None, start }),
            PieceKind::Statement => (
                Some(self.declaration(text, Scope::Module(module))),
                Within::Module,
            ),
            PieceKind::Control => (Some(Effect::Unknown), Within::Module),
            PieceKind::Broken => (Some(Effect::expected("`;`")), Within::Module),
            PieceKind::OldHead | PieceKind::Module | PieceKind::EndRoutine => (
                Some(Effect::expected("a declaration, PROC or ENDMODULE")),
                Within::Module,
            ),
        }
    }

    /// A piece of a routine, and whether the routine ends with it.
    fn in_routine(&mut self, kind: PieceKind, text: &str, routine: Option<usize>) -> (Option<Effect>, Ends) {
        match (kind, routine) {
            (PieceKind::EndRoutine, _) => (None, Ends::Here),
            (
                PieceKind::OldHead
                | PieceKind::Module
                | PieceKind::EndModule
                | PieceKind::Routine
                | PieceKind::OtherRoutine,
                _,
            ) => (Some(Effect::expected("ENDPROC")), Ends::Later),
            (PieceKind::Statement, Some(routine)) => (self.local_declaration(text, routine), Ends::Later),
            (PieceKind::Statement | PieceKind::Control | PieceKind::Broken, _) => (None, Ends::Later),
        }
    }

    /// A module must be called like its file, and no two alike.
    fn module_header(&mut self, text: &str, stem: &str) -> Effect {
        let words: Vec<&str> = text
            .split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
            .collect();
        let name = words.iter().filter(|word| !word.is_empty()).nth(1);
        let name = name.map(|name| name.to_ascii_uppercase()).unwrap_or_default();
        if name == stem.to_ascii_uppercase() && self.names.insert(name) {
            Effect::Setting
        } else {
            Effect::Unknown
        }
    }

    /// A routine's header; its number, if it can be called. A routine that has a name twice is not.
    fn routine_header(&mut self, text: &str, module: usize) -> (Option<Effect>, Option<usize>) {
        let upper = text.to_ascii_uppercase();
        let (local, rest) = match upper.trim_start().strip_prefix("LOCAL") {
            Some(rest) => (true, rest),
            None => (false, upper.as_str()),
        };
        let rest = rest.trim_start().strip_prefix("PROC").unwrap_or_default();
        let Some((name, parameters)) = rest.split_once('(') else {
            return (Some(Effect::expected("a name and `()`")), None);
        };
        let name = name.trim().to_owned();
        let is_name = !name.is_empty() && name.bytes().all(|c| c.is_ascii_alphanumeric() || c == b'_');
        let clashes = self
            .named(&name)
            .any(|(_, other)| other.module == module || !(other.local || local));
        if !is_name || clashes {
            return (Some(Effect::Unknown), None);
        }
        let number = self.routines.len();
        self.named.entry(name).or_default().push(number);
        let inner = parameters.trim_end().strip_suffix(')');
        self.routines.push(Routine {
            module,
            local,
            plain: inner.is_some_and(|inner| inner.trim().is_empty()),
            pieces: 0..0,
        });
        (None, Some(number))
    }

    /// A declaration of a module.
    fn declaration(&mut self, text: &str, module: Scope) -> Effect {
        match sentence(text) {
            Ok(Sentence::Declaration {
                local,
                kind,
                name,
                value,
            }) => {
                let scope = if local { module } else { Scope::Task };
                self.declare(scope, &kind, name, value)
            }
            Ok(Sentence::Assignment { .. } | Sentence::Instruction { .. }) => {
                Effect::expected("a declaration or PROC")
            }
            Err(what) => Effect::expected(what),
        }
    }

    /// A declaration of a routine; none when the statement is not a declaration.
    fn local_declaration(&mut self, text: &str, routine: usize) -> Option<Effect> {
        let starts = ["CONST", "VAR", "PERS"];
        let begins = |word: &&str| {
            text.get(..word.len())
                .is_some_and(|start| start.eq_ignore_ascii_case(word))
        };
        if !starts.iter().any(begins) {
            return None;
        }
        match sentence(text) {
            Ok(Sentence::Declaration {
                kind, name, value, ..
            }) => Some(self.declare(Scope::Routine(routine), &kind, name, value)),
            Ok(Sentence::Assignment { .. } | Sentence::Instruction { .. }) | Err(_) => None,
        }
    }

    fn declare(&mut self, scope: Scope, kind: &str, name: String, value: Option<Value>) -> Effect {
        let datum = match value {
            Some(value) if KINDS.contains(&kind) => Datum::Value(value),
            Some(_) | None => Datum::Unclear,
        };
        if self.data.declare(scope, &name, datum) {
            Effect::Setting
        } else {
            self.data.declare(scope, &name, Datum::Unclear);
            Effect::Unknown
        }
    }

    /// Reports the frames of the tools and work objects that moves use, where they are declared.
    fn frames(&mut self, machine: Machine<'_>) {
        for index in 0..self.modules.len() {
            let Some(module) = self.modules.get(index) else {
                break;
            };
            let mut found = Vec::new();
            for (&place, effect) in &module.effect {
                let Some(piece) = module.pieces.get(place).filter(|_| *effect == Effect::Setting) else {
                    continue;
                };
                if piece.kind != PieceKind::Statement {
                    continue;
                }
                if let Ok(Sentence::Declaration {
                    local,
                    kind,
                    name,
                    value: Some(value),
                }) = sentence(piece.text(module.text))
                    && self.used.contains(&name)
                {
                    let view = View {
                        data: &self.data,
                        module: index,
                        routine: None,
                    };
                    let scope = if local { Scope::Module(index) } else { Scope::Task };
                    match kind.as_str() {
                        "TOOLDATA" => {
                            let (datum, effect) = match tool(&value, view, machine) {
                                Some((id, effect)) => (Datum::Tool(id), Some(effect)),
                                None => (Datum::Unclear, None),
                            };
                            found.push((place, scope, name, datum, effect));
                        }
                        "WOBJDATA" => {
                            let frame = view.work_object(&value);
                            let effect =
                                frame.map(|frame| Effect::Frame(FrameRole::Base, FrameSetting::Value(frame)));
                            found.push((place, scope, name, Datum::WorkObject, effect));
                        }
                        _ => {}
                    }
                }
            }
            for (place, scope, name, datum, effect) in found {
                let datum = if effect.is_some() { datum } else { Datum::Unclear };
                self.data.declare(scope, &name, datum);
                if let Some(module) = self.modules.get_mut(index) {
                    module.effect.insert(place, effect.unwrap_or(Effect::Unknown));
                }
            }
        }
    }

    /// The routines of a name, in upper case, with their numbers.
    fn named(&self, name: &str) -> impl Iterator<Item = (usize, &Routine)> {
        let numbers = self.named.get(name).into_iter().flatten();
        numbers.filter_map(|&number| Some((number, self.routines.get(number)?)))
    }

    /// The routine that a module calls by a name, in upper case.
    pub(super) fn routine(&self, name: &str, module: usize) -> Option<usize> {
        let own = self.named(name).find(|(_, routine)| routine.module == module);
        let seen = || self.named(name).find(|(_, routine)| !routine.local);
        own.or_else(seen).map(|(number, _)| number)
    }

    /// The routine that a task begins with.
    pub(super) fn main(&self) -> Option<usize> {
        let name = MAIN.to_ascii_uppercase();
        let main = self
            .named(&name)
            .find(|(_, routine)| !routine.local && routine.plain);
        main.map(|(number, _)| number)
    }
}

/// Types whose values are understood, and those of frames, which are looked at once all are known.
const KINDS: [&str; 11] = [
    "NUM",
    "POS",
    "ORIENT",
    "POSE",
    "ROBTARGET",
    "JOINTTARGET",
    "SPEEDDATA",
    "ZONEDATA",
    "LOADDATA",
    "CONFDATA",
    "EXTJOINT",
];

/// Whether a file is a list of modules.
fn is_list(name: &str) -> bool {
    has_extension(name, &["pgf"])
}

/// The frame of a tool that carries what the job says.
///
/// Where there are several, which one moves is known where they name it.
fn tool(value: &Value, view: View<'_>, machine: Machine<'_>) -> Option<(ToolId, Effect)> {
    let (frame, load) = view.tool(value)?;
    let setting = FrameSetting::Value(frame);
    let mut tools = machine.cell.tools.iter();
    if machine.cell.tools.are_several() {
        let is_it = |tool: &Tool| carries(tool, load, machine) && machine.is_frame(&frame, tool);
        let (id, _) = tools.find(|(_, tool)| is_it(tool))?;
        return Some((id, Effect::Setting));
    }
    let first = machine.cell.tools.first();
    carries(first, load, machine).then_some((ToolId::FIRST, Effect::Frame(FrameRole::Tool, setting)))
}

/// Whether a load is the one that the job says.
fn carries(tool: &Tool, load: Load, machine: Machine<'_>) -> bool {
    let Some(Registered::Value(should)) = tool.load else {
        return false;
    };
    let lengths = machine.settings.common.lengths;
    let moments = |load: Load| load.inertia.unwrap_or(Inertia::POINT).to_array();
    let mut pairs = moments(load).into_iter().zip(moments(should));
    pairs.all(|(is, should)| TRIMMED.is_near(is, should))
        && TRIMMED.is_near(load.mass.to_kg(), should.mass.to_kg())
        && lengths.is_near(load.centre.x, should.centre.x)
        && lengths.is_near(load.centre.y, should.centre.y)
        && lengths.is_near(load.centre.z, should.centre.z)
}

//! The way through a program: data lists first, then the main routine, and the others where they are called.

use super::controller::Controller;
use super::index::{FileKind, Index, Rank, Routine, stem};
use super::profile::{Header, footer};
use super::setup::Wanted;
use super::syntax::{Phrase, Span, Statement as Line, Statements, is_same_name, statements};
use super::variables::{Asker, Outcome};
use crate::options::Settings;
use vcutc_backend_api::readback::{Place, ProgramFile, Says, Sources, Statement};

/// Tells all statements of a program.
pub(super) fn read(sources: Sources<'_>, heed: &mut dyn FnMut(Statement)) {
    let settings = Settings::read(sources.options);
    let mut teller = Teller {
        files: sources.files,
        heed,
    };
    if let Some(file) = sources
        .files
        .iter()
        .position(|file| u32::try_from(file.text.len()).is_err())
    {
        let nowhere = Span { start: 0, end: 0 };
        return teller.tell(file, nowhere, Says::expected("a file of less than 4 GiB"));
    }
    let index = Index::of(sources.files);
    let profile = sources.options.profile();
    let mut controller = Controller::new(Wanted {
        cell: sources.cell,
        settings: &settings,
    });
    for (place, file) in sources.files.iter().enumerate() {
        match FileKind::of(file) {
            FileKind::Data => data(place, file, &mut controller, &mut teller),
            FileKind::Source => {}
        }
    }
    for &(file, span) in &index.gaps {
        outside(file, span, &mut teller);
    }
    let mut walk = Walk {
        index: &index,
        entered: vec![false; index.routines.len()],
        calls: Vec::new(),
        header: Header::new(&profile.header),
    };
    if let Some(main) = index.main() {
        walk.enter(main, &profile.footer, &teller);
    }
    walk.follow(&mut controller, &mut teller);
    walk.never_called(&mut teller);
}

struct Teller<'t, 'h> {
    files: &'t [ProgramFile],
    heed: &'h mut dyn FnMut(Statement),
}

impl<'t> Teller<'t, '_> {
    fn tell(&mut self, file: usize, span: Span, says: Says) {
        let place = Place::of(file, span.start..span.end);
        (self.heed)(Statement { place, says });
    }

    fn text(&self, file: usize) -> &'t str {
        self.files.get(file).map_or("", |file| &file.text)
    }

    /// The module that a file is, or belongs to.
    fn module(&self, file: usize) -> &'t str {
        self.files.get(file).map_or("", |file| stem(&file.name).0)
    }
}

/// Where a data list is read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Before,
    Inside,
    Behind,
}

/// A data list: its variables are there before anything is carried out.
fn data(file: usize, source: &ProgramFile, controller: &mut Controller<'_>, teller: &mut Teller<'_, '_>) {
    let asker = Asker {
        routine: None,
        module: teller.module(file),
    };
    let mut part = Part::Before;
    for line in statements(&source.text) {
        let says = match (part, &line.phrase) {
            (Part::Before, Phrase::Mark(_)) => continue,
            (Part::Before, Phrase::DefDat { name, .. }) => {
                part = Part::Inside;
                named_as_file(name, asker.module)
            }
            (Part::Before, _) => Says::expected("`DEFDAT` with the name of the file"),
            (Part::Inside, Phrase::EndDat) => {
                part = Part::Behind;
                Says::Setting
            }
            (Part::Inside, Phrase::Ext { .. }) => Says::Setting,
            (Part::Inside, Phrase::Declaration(declaration)) => {
                said(controller.variables.declare(asker, declaration))
            }
            (Part::Inside, Phrase::Assignment { to, value }) => {
                said(controller.variables.assign(asker, to, value))
            }
            (Part::Inside, Phrase::Other(_)) => Says::Unknown,
            (Part::Inside, Phrase::Unreadable { expected }) => Says::expected(*expected),
            (Part::Inside, _) => Says::expected("a declaration, or `ENDDAT`"),
            (Part::Behind, _) => Says::expected("nothing after `ENDDAT`"),
        };
        teller.tell(file, line.span, says);
    }
    match part {
        Part::Inside => missing(file, source.text.len(), "`ENDDAT`", teller),
        Part::Before | Part::Behind => {}
    }
}

/// Tells what is missing where a text ends.
fn missing(file: usize, end: usize, what: &str, teller: &mut Teller<'_, '_>) {
    teller.tell(file, Span { start: end, end }, Says::expected(what));
}

fn said(outcome: Outcome) -> Says {
    match outcome {
        Outcome::Known => Says::Setting,
        Outcome::Unknown => Says::Unknown,
    }
}

/// A controller knows a module by the name of its file, and takes no other name inside.
fn named_as_file(name: &str, module: &str) -> Says {
    if is_same_name(name, module) {
        Says::Setting
    } else {
        Says::expected(format!("`{module}`, the name of the file"))
    }
}

/// What stands outside of routines should be nothing but records of the editor, and those in front of the first.
fn outside(file: usize, span: Span, teller: &mut Teller<'_, '_>) {
    for line in Statements::within(teller.text(file), span) {
        match line.phrase {
            Phrase::Mark(_) if span.start == 0 => {}
            _ => teller.tell(file, line.span, Says::expected("`DEF` of a routine")),
        }
    }
}

/// Routines on their way.
struct Walk<'t, 'i> {
    index: &'i Index<'t>,
    /// Which routines have been carried out, or are about to.
    entered: Vec<bool>,
    calls: Vec<Call<'t>>,
    header: Header,
}

/// A routine that is carried out.
struct Call<'t> {
    routine: Routine<'t>,
    asker: Asker<'t>,
    lines: Statements<'t>,
    stage: Stage,
    role: Role,
}

/// Whether a routine has lines of the profile.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    /// It has, and those at its end begin here.
    Main {
        footer: Option<usize>,
    },
    Called,
}

/// How far a routine is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    Head,
    Declarations,
    Instructions,
}

enum Next {
    GoOn,
    Enter(usize),
    Return,
}

impl<'t> Walk<'t, '_> {
    fn enter(&mut self, place: usize, last_lines: &[String], teller: &Teller<'t, '_>) {
        let role = match self.index.routines.get(place) {
            Some(routine) if self.calls.is_empty() => Role::Main {
                footer: footer(teller.text(routine.file), routine.span, last_lines),
            },
            Some(_) | None => Role::Called,
        };
        let Some(&routine) = self.index.routines.get(place) else {
            return;
        };
        if let Some(entered) = self.entered.get_mut(place) {
            *entered = true;
        }
        self.calls.push(Call {
            routine,
            asker: Asker {
                routine: Some(place),
                module: teller.module(routine.file),
            },
            lines: Statements::within(teller.text(routine.file), routine.span),
            stage: Stage::Head,
            role,
        });
    }

    /// Carries out what was entered. Every routine is entered once at most, so this ends.
    fn follow(&mut self, controller: &mut Controller<'_>, teller: &mut Teller<'t, '_>) {
        while let Some(mut call) = self.calls.pop() {
            let file = call.routine.file;
            let next = loop {
                let Some(line) = call.lines.next() else {
                    missing(file, call.routine.span.end, "`END`", teller);
                    break Next::Return;
                };
                let (says, next) = self.step(&mut call, &line, controller);
                teller.tell(file, line.span, says);
                match next {
                    Next::GoOn => {}
                    Next::Enter(_) | Next::Return => break next,
                }
            };
            match next {
                Next::Enter(place) => {
                    self.calls.push(call);
                    self.enter(place, &[], teller);
                }
                Next::GoOn | Next::Return => {}
            }
        }
    }

    /// Carries out a line of a routine.
    fn step(
        &mut self,
        call: &mut Call<'t>,
        line: &Line<'_>,
        controller: &mut Controller<'_>,
    ) -> (Says, Next) {
        let stage = call.stage;
        if self.is_of_profile(call, line) {
            return (Says::Setting, Next::GoOn);
        }
        call.stage = Stage::Instructions;
        let says = match (stage, &line.phrase) {
            (Stage::Head, Phrase::Def { name, .. }) => {
                call.stage = Stage::Declarations;
                match call.routine.rank {
                    Rank::First => named_as_file(name, call.asker.module),
                    Rank::Further => Says::Setting,
                }
            }
            (Stage::Declarations, Phrase::Ext { .. }) => {
                call.stage = stage;
                Says::Setting
            }
            (Stage::Declarations, Phrase::Declaration(declaration)) => {
                call.stage = stage;
                said(controller.variables.declare(call.asker, declaration))
            }
            (Stage::Instructions, Phrase::Ext { .. } | Phrase::Declaration(_)) => {
                Says::expected("declarations in front of the first instruction")
            }
            (
                Stage::Declarations,
                Phrase::Bas {
                    command,
                    value: Some(0.0),
                },
            ) if is_same_name(command, "INITMOV") => {
                controller.begin();
                Says::PartBegins
            }
            (_, Phrase::End) => return (Says::Setting, Next::Return),
            (_, Phrase::Call { name, arguments }) => return self.call(call.routine.file, name, arguments),
            (_, phrase) => controller.carry_out(call.asker, phrase),
        };
        (says, Next::GoOn)
    }

    fn call(&self, file: usize, name: &str, arguments: &str) -> (Says, Next) {
        let routine = self.index.find(file, name);
        match routine {
            Some(place) if arguments.is_empty() && self.entered.get(place) == Some(&false) => {
                (Says::Setting, Next::Enter(place))
            }
            Some(_) | None => (Says::Unknown, Next::GoOn),
        }
    }

    fn is_of_profile(&mut self, call: &Call<'_>, line: &Line<'_>) -> bool {
        match (call.role, call.stage) {
            (Role::Called, _) | (_, Stage::Head) => false,
            (Role::Main { .. }, Stage::Declarations) if self.header.takes(line.text) => true,
            (Role::Main { footer }, Stage::Declarations | Stage::Instructions) => {
                footer.is_some_and(|from| line.span.start >= from) && line.phrase != Phrase::End
            }
        }
    }

    /// Tells the routines that nobody calls: not understood, as someone must have meant them to do something.
    fn never_called(&self, teller: &mut Teller<'t, '_>) {
        let routines = self.index.routines.iter().zip(&self.entered);
        for (routine, _) in routines.filter(|(_, entered)| !**entered) {
            let mut head = true;
            for line in Statements::within(teller.text(routine.file), routine.span) {
                let says = match line.phrase {
                    Phrase::Unreadable { expected } => Says::expected(expected),
                    _ if head => Says::Unknown,
                    _ => Says::Setting,
                };
                head = false;
                teller.tell(routine.file, line.span, says);
            }
        }
    }
}

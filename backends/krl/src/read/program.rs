//! A whole program: data lists first, then the main routine, and the others where they are called.

use super::controller::Controller;
use super::profile::{Header, footer};
use super::setup::Wanted;
use crate::interpreter::index::Rank;
use crate::interpreter::variables::Outcome;
use crate::interpreter::{BreaksOff, Context, Execution, Line};
use crate::options::Settings;
use crate::syntax::{Phrase, Span, Statement as Syntax, Statements, is_same_name};
use vcutc_backend_api::readback::{Place, Says, Sources, Statement};

/// Tells all statements of a program.
pub(super) fn read(sources: Sources<'_>, heed: &mut dyn FnMut(Statement)) {
    let settings = Settings::read(sources.options);
    let mut files = sources.files.iter();
    if let Some(file) = files.position(|file| u32::try_from(file.text.len()).is_err()) {
        return tell(
            heed,
            file,
            END_OF_NOTHING,
            Says::expected("a file of less than 4 GiB"),
        );
    }
    let mut execution = Execution::of(sources.files);
    let profile = sources.options.profile();
    let main = execution.main();
    let last_lines = main.and_then(|main| {
        let routine = execution.routine(main)?;
        footer(
            &sources.files.get(routine.file)?.text,
            routine.span,
            &profile.footer,
        )
    });
    let mut reading = Reading {
        controller: Controller::new(Wanted {
            cell: sources.cell,
            settings: &settings,
        }),
        heed,
        header: Header::new(&profile.header),
        footer: last_lines,
        stages: Vec::new(),
    };
    for (file, context, lines) in execution.data_lists() {
        reading.data(file, context, lines);
    }
    for (file, gap, line) in execution.outside() {
        match line.phrase {
            // Records of the editor stand in front of the first routine.
            Phrase::Mark(_) if gap == 0 => {}
            _ => reading.tell(file, line.span, Says::expected("`DEF` of a routine")),
        }
    }
    if let Some(main) = main {
        reading.enter(&mut execution, main);
    }
    reading.follow(&mut execution);
    reading.never_called(&execution);
}

const END_OF_NOTHING: Span = Span { start: 0, end: 0 };

fn tell(heed: &mut dyn FnMut(Statement), file: usize, span: Span, says: Says) {
    let place = Place::of(file, span.start..span.end);
    heed(Statement { place, says });
}

/// A program that is read.
struct Reading<'a, 'h> {
    controller: Controller<'a>,
    heed: &'h mut dyn FnMut(Statement),
    /// The lines of the profile at the head of the main routine.
    header: Header,
    /// Where those at its end begin.
    footer: Option<usize>,
    /// How far each of the open routines is; the main routine is the first.
    stages: Vec<Stage>,
}

/// Where a data list is read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Before,
    Inside,
    After,
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

impl Reading<'_, '_> {
    fn tell(&mut self, file: usize, span: Span, says: Says) {
        tell(self.heed, file, span, says);
    }

    /// Tells what is missing where a text ends.
    fn missing(&mut self, file: usize, end: usize, what: &str) {
        self.tell(file, Span { start: end, end }, Says::expected(what));
    }

    /// A data list: its variables are there before anything is carried out.
    fn data(&mut self, file: usize, context: Context<'_>, lines: Statements<'_>) {
        let mut part = Part::Before;
        let end = lines.end();
        for line in lines {
            let variables = &mut self.controller.state.variables;
            let says = match (part, &line.phrase) {
                (Part::Before, Phrase::Mark(_)) => continue,
                (Part::Before, Phrase::DefDat { name, .. }) => {
                    part = Part::Inside;
                    named_as_file(name, context.module)
                }
                (Part::Before, _) => Says::expected("`DEFDAT` with the name of the file"),
                (Part::Inside, Phrase::EndDat) => {
                    part = Part::After;
                    Says::Setting
                }
                (Part::Inside, Phrase::Ext { .. }) => Says::Setting,
                (Part::Inside, Phrase::Declaration(declaration)) => {
                    said(variables.declare(context, declaration))
                }
                (Part::Inside, Phrase::Assignment { to, value }) => {
                    said(variables.assign(context, to, value))
                }
                (Part::Inside, Phrase::Other(_)) => Says::Unknown,
                (Part::Inside, Phrase::Unreadable { expected }) => Says::expected(*expected),
                (Part::Inside, _) => Says::expected("a declaration, or `ENDDAT`"),
                (Part::After, _) => Says::expected("nothing after `ENDDAT`"),
            };
            self.tell(file, line.span, says);
        }
        if part == Part::Inside {
            self.missing(file, end, "`ENDDAT`");
        }
    }

    fn enter(&mut self, execution: &mut Execution<'_>, routine: usize) {
        execution.enter(routine);
        self.stages.push(Stage::Head);
    }

    /// Carries out what was entered. Every routine is entered once at most, so this ends.
    fn follow(&mut self, execution: &mut Execution<'_>) {
        while let Some(step) = execution.next() {
            let line = match step {
                Ok(line) => line,
                Err(BreaksOff { file, end, .. }) => {
                    self.missing(file, end, "`END`");
                    self.stages.pop();
                    continue;
                }
            };
            let (says, next) = self.step(execution, &line);
            self.tell(line.file, line.statement.span, says);
            match next {
                Next::GoOn => {}
                Next::Enter(routine) => self.enter(execution, routine),
                Next::Return => {
                    execution.leave();
                    self.stages.pop();
                }
            }
        }
    }

    /// Carries out a line of a routine.
    fn step(&mut self, execution: &Execution<'_>, line: &Line<'_>) -> (Says, Next) {
        let stage = self.stages.last().copied().unwrap_or(Stage::Instructions);
        if self.is_of_profile(stage, &line.statement) {
            return (Says::Setting, Next::GoOn);
        }
        let mut after = Stage::Instructions;
        let says = match (stage, &line.statement.phrase) {
            (Stage::Head, Phrase::Def { name, .. }) => {
                after = Stage::Declarations;
                match line.rank {
                    Rank::First => named_as_file(name, line.context.module),
                    Rank::Further => Says::Setting,
                }
            }
            (Stage::Declarations, Phrase::Ext { .. }) => {
                after = stage;
                Says::Setting
            }
            (Stage::Declarations, Phrase::Declaration(declaration)) => {
                after = stage;
                said(self.controller.state.variables.declare(line.context, declaration))
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
                self.controller.begin();
                Says::PartBegins
            }
            (_, Phrase::End) => return (Says::Setting, Next::Return),
            (_, Phrase::Call { name, arguments }) => {
                self.set_stage(after);
                let routine = execution.find(line.file, name);
                let routine = routine.filter(|&routine| !execution.has_entered(routine));
                return match routine.filter(|_| arguments.is_empty()) {
                    Some(routine) => (Says::Setting, Next::Enter(routine)),
                    None => (Says::Unknown, Next::GoOn),
                };
            }
            (_, phrase) => self.controller.carry_out(line.context, phrase),
        };
        self.set_stage(after);
        (says, Next::GoOn)
    }

    fn set_stage(&mut self, after: Stage) {
        if let Some(stage) = self.stages.last_mut() {
            *stage = after;
        }
    }

    fn is_of_profile(&mut self, stage: Stage, line: &Syntax<'_>) -> bool {
        if self.stages.len() > 1 || stage == Stage::Head {
            return false;
        }
        (stage == Stage::Declarations && self.header.takes(line.text))
            || self.footer.is_some_and(|from| line.span.start >= from) && line.phrase != Phrase::End
    }

    /// Tells the routines that nobody calls: not understood, as someone must have meant them to do something.
    fn never_called(&mut self, execution: &Execution<'_>) {
        for (file, lines) in execution.never_called() {
            for (place, line) in lines.enumerate() {
                let says = match line.phrase {
                    Phrase::Unreadable { expected } => Says::expected(expected),
                    _ if place == 0 => Says::Unknown,
                    _ => Says::Setting,
                };
                self.tell(file, line.span, says);
            }
        }
    }
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

//! A whole program: data lists first, then the main routine, and the others where they are called.

use super::controller::Controller;
use super::profile::{Header, footer};
use super::setup::Wanted;
use crate::interpreter::index::Rank;
use crate::interpreter::variables::Outcome;
use crate::interpreter::{BreaksOff, Context, Execution, Line};
use crate::options::Settings;
use crate::syntax::{Phrase, Span, Statement as Syntax, Statements, is_same_name};
use vcutc_backend_api::ir::ToolId;
use vcutc_backend_api::readback::{Effect, Place, Sources, Statement};

/// Reports all statements of a program.
pub(super) fn read(sources: Sources<'_>, visit: &mut dyn FnMut(Statement)) {
    let settings = Settings::read(sources.options);
    let mut files = sources.files.iter();
    if let Some(file) = files.position(|file| u32::try_from(file.text.len()).is_err()) {
        return report(
            visit,
            file,
            END_OF_NOTHING,
            Effect::expected("a file of less than 4 GiB"),
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
            tool: Some(ToolId::FIRST),
        }),
        visit,
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
            _ => reading.report(file, line.span, Effect::expected("`DEF` of a routine")),
        }
    }
    if let Some(main) = main {
        reading.enter(&mut execution, main);
    }
    reading.follow(&mut execution);
    reading.never_called(&execution);
}

const END_OF_NOTHING: Span = Span { start: 0, end: 0 };

fn report(visit: &mut dyn FnMut(Statement), file: usize, span: Span, effect: Effect) {
    let place = Place::of(file, span.start..span.end);
    visit(Statement { place, effect });
}

/// A program that is read.
struct Reading<'a, 'h> {
    controller: Controller<'a>,
    visit: &'h mut dyn FnMut(Statement),
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
    fn report(&mut self, file: usize, span: Span, effect: Effect) {
        report(self.visit, file, span, effect);
    }

    /// Reports what is missing where a text ends.
    fn missing(&mut self, file: usize, end: usize, what: &str) {
        self.report(file, Span { start: end, end }, Effect::expected(what));
    }

    /// A data list: its variables are there before anything is carried out.
    fn data(&mut self, file: usize, context: Context<'_>, lines: Statements<'_>) {
        let mut part = Part::Before;
        let end = lines.end();
        for line in lines {
            let variables = &mut self.controller.state.variables;
            let effect = match (part, &line.phrase) {
                (Part::Before, Phrase::Mark(_)) => continue,
                (Part::Before, Phrase::DefDat { name, .. }) => {
                    part = Part::Inside;
                    named_as_file(name, context.module)
                }
                (Part::Before, _) => Effect::expected("`DEFDAT` with the name of the file"),
                (Part::Inside, Phrase::EndDat) => {
                    part = Part::After;
                    Effect::Setting
                }
                (Part::Inside, Phrase::Ext { .. }) => Effect::Setting,
                (Part::Inside, Phrase::Declaration(declaration)) => {
                    said(variables.declare(context, declaration))
                }
                (Part::Inside, Phrase::Assignment { to, value }) => {
                    said(variables.assign(context, to, value))
                }
                (Part::Inside, Phrase::Other(_)) => Effect::Unknown,
                (Part::Inside, Phrase::Unreadable { expected }) => Effect::expected(*expected),
                (Part::Inside, _) => Effect::expected("a declaration, or `ENDDAT`"),
                (Part::After, _) => Effect::expected("nothing after `ENDDAT`"),
            };
            self.report(file, line.span, effect);
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
            let (effect, next) = self.step(execution, &line);
            self.report(line.file, line.statement.span, effect);
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
    fn step(&mut self, execution: &Execution<'_>, line: &Line<'_>) -> (Effect, Next) {
        let stage = self.stages.last().copied().unwrap_or(Stage::Instructions);
        if self.is_of_profile(stage, &line.statement) {
            return (Effect::Setting, Next::GoOn);
        }
        let mut after = Stage::Instructions;
        let effect = match (stage, &line.statement.phrase) {
            (Stage::Head, Phrase::Def { name, .. }) => {
                after = Stage::Declarations;
                match line.rank {
                    Rank::First => named_as_file(name, line.context.module),
                    Rank::Further => Effect::Setting,
                }
            }
            (Stage::Declarations, Phrase::Ext { .. }) => {
                after = stage;
                Effect::Setting
            }
            (Stage::Declarations, Phrase::Declaration(declaration)) => {
                after = stage;
                said(self.controller.state.variables.declare(line.context, declaration))
            }
            (Stage::Instructions, Phrase::Ext { .. } | Phrase::Declaration(_)) => {
                Effect::expected("declarations in front of the first instruction")
            }
            (
                Stage::Declarations,
                Phrase::Bas {
                    command,
                    value: Some(0.0),
                },
            ) if is_same_name(command, "INITMOV") => {
                self.controller.begin();
                Effect::PartBegins
            }
            (_, Phrase::End) => return (Effect::Setting, Next::Return),
            (_, Phrase::Call { name, arguments }) => {
                self.set_stage(after);
                if let Some(effect) = self.controller.call(name, arguments) {
                    return (effect, Next::GoOn);
                }
                let routine = execution.find(line.file, name);
                let routine = routine.filter(|&routine| !execution.has_entered(routine));
                return match routine.filter(|_| arguments.is_empty()) {
                    Some(routine) => (Effect::Setting, Next::Enter(routine)),
                    None => (Effect::Unknown, Next::GoOn),
                };
            }
            (_, phrase) => self.controller.carry_out(line.context, phrase),
        };
        self.set_stage(after);
        (effect, Next::GoOn)
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

    /// Reports the routines that are never called. They are not understood: they must be meant to
    /// do something.
    fn never_called(&mut self, execution: &Execution<'_>) {
        for (file, lines) in execution.never_called() {
            for (place, line) in lines.enumerate() {
                let effect = match line.phrase {
                    Phrase::Unreadable { expected } => Effect::expected(expected),
                    _ if place == 0 => Effect::Unknown,
                    _ => Effect::Setting,
                };
                self.report(file, line.span, effect);
            }
        }
    }
}

fn said(outcome: Outcome) -> Effect {
    match outcome {
        Outcome::Known => Effect::Setting,
        Outcome::Unknown => Effect::Unknown,
    }
}

/// A controller knows a module by the name of its file, and takes no other name inside.
fn named_as_file(name: &str, module: &str) -> Effect {
    if is_same_name(name, module) {
        Effect::Setting
    } else {
        Effect::expected(format!("`{module}`, the name of the file"))
    }
}

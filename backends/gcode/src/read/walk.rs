//! The statements of all files in the order in which a control carries them out.

use super::codes::{Found, Given};
use super::context::Context;
use super::control::{Control, given};
use super::profile::{OfProfile, Stage};
use super::scripts::{self, Directory, Line, Script};
use crate::axes;
use crate::codes::Role;
use crate::controller::Heads;
use crate::options::Settings;
use crate::statement::{Flow, Order, Parsed, ReadError, Routine, expected};
use vcutc_backend_api::readback::{Command, Effect, Place, Sources, Statement};

/// Reports all statements of a program.
pub(super) fn read(sources: Sources<'_>, visit: &mut dyn FnMut(Statement)) {
    let settings = Settings::read(sources.options);
    // Without words every coordinate is unknown, which is what it is.
    let words = axes::words(sources.cell, settings.spindle_letter).unwrap_or_default();
    let context = Context {
        cell: sources.cell,
        settings: &settings,
        words: &words,
    };
    let scripts: Vec<Script<'_>> = (0..)
        .zip(sources.files)
        .map(|(place, file)| Script::new(place, file, context))
        .collect();
    let directory = Directory::new(&scripts);
    let main = scripts::main(&scripts, &directory, context);
    let mut interpreter = Interpreter {
        context,
        control: Control::new(context),
        given: Given::new(settings.codes, settings.facts().style),
        profile: OfProfile::new(&settings, settings.facts().style),
        scripts,
        directory,
        stack: Vec::new(),
        visit,
    };
    if let Some(main) = main {
        interpreter.enter(main);
    }
    interpreter.follow();
    interpreter.never_called();
}

struct Interpreter<'t, 'h> {
    context: Context<'t>,
    control: Control<'t>,
    given: Given,
    profile: OfProfile,
    scripts: Vec<Script<'t>>,
    directory: Directory<'t>,
    /// The files that are being carried out, the main program first.
    stack: Vec<usize>,
    visit: &'h mut dyn FnMut(Statement),
}

/// How things go on after a statement.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Onward {
    Next,
    Enter(usize),
    Leave,
    Over,
}

impl<'t> Interpreter<'t, '_> {
    fn report(&mut self, place: Place, effect: Effect) {
        (self.visit)(Statement { place, effect });
    }

    fn enter(&mut self, script: usize) {
        if let Some(entered) = self.scripts.get_mut(script) {
            entered.entered = true;
            self.stack.push(script);
        }
    }

    fn follow(&mut self) {
        while let Some(&script) = self.stack.last() {
            let style = self.context.settings.facts().style;
            let Some(current) = self.scripts.get_mut(script) else {
                return;
            };
            let Some(line) = current.next(style) else {
                let place = current.end();
                self.ends_too_soon(place);
                continue;
            };
            let (effect, onward) = self.statement(script, &line);
            self.report(line.place, effect);
            match onward {
                Onward::Next => {}
                Onward::Enter(part) => self.enter(part),
                Onward::Leave => self.leave(),
                Onward::Over => {
                    while !self.stack.is_empty() {
                        self.leave()
                    }
                }
            }
        }
    }

    /// A file has no more lines, but nothing said that the program or part ends.
    fn ends_too_soon(&mut self, place: Place) {
        let [of_main, of_part] = self.context.settings.facts().endings;
        let missing = if self.stack.len() > 1 { of_part } else { of_main };
        self.report(place, Effect::expected(format!("`{missing}` at the end")));
        self.stack.pop();
    }

    /// Reports the rest of the file, which is not carried out, and returns to the caller.
    fn leave(&mut self) {
        let Some(script) = self.stack.pop() else { return };
        while let Some(line) = self.next_of(script) {
            let order = line.code.ok().and_then(|code| {
                self.context
                    .settings
                    .controller
                    .order(code, self.context.scope())
                    .ok()
            });
            let is_end = match order.and_then(|order| order.flow) {
                Some(Flow::Tape | Flow::End) => true,
                Some(Flow::Close(routine)) => self.is_own(script, routine),
                Some(
                    Flow::Head(_) | Flow::PartHead(_) | Flow::Call(_) | Flow::Return | Flow::ReturnFrom(_),
                )
                | None => false,
            };
            self.report(line.place, if is_end { Effect::Setting } else { Effect::Unknown });
        }
    }

    /// Whether a routine is that of a file.
    fn is_own(&self, script: usize, routine: Routine<'_>) -> bool {
        let own = self.scripts.get(script).and_then(|script| script.routine);
        own.is_some_and(|own| own.is(routine))
    }

    fn next_of(&mut self, script: usize) -> Option<Line<'t>> {
        let style = self.context.settings.facts().style;
        self.scripts.get_mut(script)?.next(style)
    }

    /// Files that are never called: their first statement is not understood, and the others do nothing.
    fn never_called(&mut self) {
        for script in 0..self.scripts.len() {
            if self.scripts.get(script).is_some_and(|script| script.entered) {
                continue;
            }
            let mut effect = Effect::Unknown;
            while let Some(line) = self.next_of(script) {
                self.report(line.place, core::mem::replace(&mut effect, Effect::Setting));
            }
        }
    }

    fn statement(&mut self, script: usize, line: &Line<'t>) -> (Effect, Onward) {
        let longest = self.context.settings.facts().longest_line;
        let understood = match &line.code {
            Err(error) => Err(error.clone()),
            Ok(_) if line.length > longest => expected(format!("a line of at most {longest} characters")),
            Ok(code) => self.understood(script, line.place, code),
        };
        let is_main = self.stack.len() == 1;
        let is_setting = matches!(&understood, Ok((Effect::Setting, _)));
        let is_motion = understood
            .as_ref()
            .is_ok_and(|(effect, _)| effect.command().is_some_and(Command::is_motion));
        let taken = match &line.code {
            Ok(code) if is_main && !is_setting && !is_motion => self.profile.takes(code),
            Ok(_) | Err(_) => false,
        };
        if taken {
            return (Effect::Setting, Onward::Next);
        }
        match understood {
            Ok((effect, onward)) => (self.in_its_stage(effect), onward),
            Err(error) => {
                self.control.forget();
                let effect = match error {
                    ReadError::Unknown => Effect::Unknown,
                    ReadError::Expected(expected) => Effect::expected(expected),
                };
                (effect, Onward::Next)
            }
        }
    }

    /// Nothing is done after the lines at the end.
    fn in_its_stage(&mut self, effect: Effect) -> Effect {
        match (&effect, self.profile.stage) {
            (Effect::Command(_) | Effect::PartBegins, Stage::Foot) => {
                Effect::expected("the end of the program")
            }
            (Effect::Command(_) | Effect::PartBegins, Stage::Head | Stage::Body) => {
                self.profile.stage = Stage::Body;
                effect
            }
            (Effect::Setting | Effect::Frame(..) | Effect::Unknown | Effect::Unreadable { .. }, _) => effect,
        }
    }

    fn understood(&mut self, script: usize, place: Place, code: &'t str) -> Parsed<(Effect, Onward)> {
        let order = match self.given.visit(code) {
            Found::Part(Role::TcpOn | Role::TcpOff) => {
                self.control.switch_tcp(None);
                return Ok((Effect::Setting, Onward::Next));
            }
            Found::Part(Role::On | Role::Off | Role::Ready) => return Ok((Effect::Setting, Onward::Next)),
            Found::Whole(role) => given(role),
            Found::Nothing => self
                .context
                .settings
                .controller
                .order(code, self.context.scope())?,
        };
        let begun = self.scripts.get_mut(script).map(|script| {
            let is_tape = order.flow == Some(Flow::Tape);
            let before = script.begun || (is_tape && !script.is_first(place));
            script.begun |= !is_tape;
            before
        });
        let effect = self.control.carry_out(&order)?;
        let is_main = self.stack.len() == 1;
        let needs_head = match self.context.settings.facts().heads {
            Heads::None => false,
            Heads::OfParts => !is_main,
            Heads::All => true,
        };
        match order.flow {
            Some(Flow::Tape | Flow::Head(_) | Flow::PartHead(_)) => {}
            Some(Flow::Call(_) | Flow::Return | Flow::ReturnFrom(_) | Flow::Close(_) | Flow::End) | None => {
                if needs_head && begun == Some(false) {
                    return expected("the name of the file, at its beginning");
                }
            }
        }
        match order.flow {
            None => Ok((effect, Onward::Next)),
            Some(flow) => self.flow(script, flow, begun.unwrap_or(true), &order),
        }
    }

    fn flow(
        &mut self,
        script: usize,
        flow: Flow<'_>,
        begun: bool,
        order: &Order<'_>,
    ) -> Parsed<(Effect, Onward)> {
        let is_main = self.stack.len() == 1;
        let is_own = |routine: Routine<'_>| self.is_own(script, routine);
        if order.feed.is_some() {
            return expected("nothing else in the block");
        }
        match flow {
            Flow::Tape if !begun => Ok((Effect::Setting, Onward::Next)),
            Flow::Tape => expected("the end of the program before `%`"),
            Flow::Head(routine) if !begun && is_own(routine) => Ok((Effect::Setting, Onward::Next)),
            Flow::PartHead(routine) if !begun && is_own(routine) && !is_main => {
                Ok((Effect::Setting, Onward::Next))
            }
            Flow::Head(_) | Flow::PartHead(_) => expected("the name of the file, at its beginning"),
            Flow::Call(routine) => {
                let to = self.directory.find(routine);
                let to = to.filter(|&to| self.scripts.get(to).is_some_and(|to| !to.entered));
                match to {
                    Some(to) => {
                        self.control.restart();
                        Ok((Effect::PartBegins, Onward::Enter(to)))
                    }
                    None => Err(ReadError::Expected(
                        self.context.settings.controller.callable(routine),
                    )),
                }
            }
            Flow::Return if !is_main => Ok((Effect::Setting, Onward::Leave)),
            Flow::ReturnFrom(routine) if !is_main && is_own(routine) => Ok((Effect::Setting, Onward::Leave)),
            Flow::Return | Flow::ReturnFrom(_) => Err(ReadError::Unknown),
            Flow::Close(routine) if !is_own(routine) => expected("the name of the file"),
            Flow::Close(_) if is_main => Ok((Effect::Setting, Onward::Over)),
            Flow::Close(_) => Ok((Effect::Setting, Onward::Leave)),
            Flow::End => Ok((Effect::Setting, Onward::Over)),
        }
    }
}

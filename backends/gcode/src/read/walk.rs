//! The statements of all files in the order in which a control carries them out.

use super::codes::{Found, Given, Role, essences};
use super::control::{Control, given};
use super::lines::{self, Code, Span, Style};
use super::order::{Context, Flow, Order, Routine, Trouble};
use super::tongue::{self, Heads, Tongue};
use crate::axes;
use crate::options::Settings;
use vcutc_backend_api::readback::{Deed, Place, ProgramFile, Says, Sources, Statement, essence};

/// Tells all statements of a program.
pub(super) fn read(sources: Sources<'_>, heed: &mut dyn FnMut(Statement)) {
    let settings = Settings::read(sources.options);
    // Without words every coordinate is unknown, which is what it is.
    let words = axes::words(sources.cell, &settings).unwrap_or_default();
    let tongue = tongue::of(sources.options);
    let context = Context {
        cell: sources.cell,
        settings: &settings,
        words: &words,
    };
    let scripts: Vec<Script<'_>> = (0..)
        .zip(sources.files)
        .map(|(place, file)| Script::new(place, file, tongue))
        .collect();
    let main = main(&scripts, tongue, context);
    let mut walk = Walk {
        tongue,
        context,
        control: Control::new(tongue, context),
        given: Given::new(settings.codes, tongue.style()),
        profile: OfProfile::new(&settings, tongue.style()),
        scripts,
        stack: Vec::new(),
        heed,
    };
    if let Some(main) = main {
        walk.enter(main);
    }
    walk.follow();
    walk.never_called();
}

/// A file on the way.
struct Script<'t> {
    file: u32,
    text: &'t str,
    routine: Option<Routine<'t>>,
    /// Where the next statement is looked for.
    at: usize,
    entered: bool,
    /// Whether a statement has been carried out, but for the mark of a tape.
    begun: bool,
}

impl<'t> Script<'t> {
    fn new(file: u32, source: &'t ProgramFile, tongue: &dyn Tongue) -> Self {
        let text = source.text.as_str();
        Self {
            file,
            text,
            routine: tongue.routine(&source.name, text),
            at: 0,
            entered: false,
            begun: false,
        }
    }

    /// The next statement.
    fn next(&mut self, style: Style) -> Option<Line<'t>> {
        loop {
            let (line, next) = lines::line(self.text, self.at)?;
            let code = style.code(line, self.at);
            self.at = next;
            let (span, code) = match code {
                Code::None => continue,
                Code::Is(span, code) => (span, Ok(code)),
                Code::Open(span) => (span, Err(Trouble::Expected("the end of the comment".to_owned()))),
                Code::Active(span) => (span, Err(Trouble::Unknown)),
            };
            return Some(Line {
                place: self.place(span),
                length: line.len(),
                code,
            });
        }
    }

    fn place(&self, span: Span) -> Place {
        let byte = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        Place {
            file: self.file,
            start: byte(span.start),
            end: byte(span.end),
        }
    }

    fn end(&self) -> Place {
        let end = self.text.len();
        self.place(Span { start: end, end })
    }
}

/// A line with a statement.
struct Line<'t> {
    place: Place,
    /// Bytes of the whole line.
    length: usize,
    /// The statement, or why there is none to be read.
    code: Result<&'t str, Trouble>,
}

/// The first file that no other calls.
fn main(scripts: &[Script<'_>], tongue: &dyn Tongue, context: Context<'_>) -> Option<usize> {
    if scripts.len() < 2 {
        return (!scripts.is_empty()).then_some(0);
    }
    let mut called = vec![false; scripts.len()];
    for (place, script) in scripts.iter().enumerate() {
        for routine in calls(script, tongue, context) {
            let to = scripts
                .iter()
                .position(|to| to.routine.is_some_and(|of| of.is(routine)));
            match to.and_then(|to| Some((to, called.get_mut(to)?))) {
                Some((to, called)) if to != place => *called = true,
                Some(_) | None => {}
            }
        }
    }
    Some(called.iter().position(|called| !called).unwrap_or(0))
}

/// Longest call that is looked for: names are shorter than 100 characters.
const LONGEST_CALL: usize = 128;

/// The parts that a file calls.
fn calls<'t>(script: &Script<'t>, tongue: &dyn Tongue, context: Context<'_>) -> Vec<Routine<'t>> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some((line, next)) = lines::line(script.text, at) {
        if let Code::Is(_, code) = tongue.style().code(line, at)
            && code.len() <= LONGEST_CALL
            && may_be_call(code)
            && let Ok(order) = tongue.order(code, context)
            && let Some(Flow::Call(routine)) = order.flow
        {
            found.push(routine);
        }
        at = next;
    }
    found
}

/// Most statements are coordinates behind a G code or `L`.
fn may_be_call(code: &str) -> bool {
    match code.as_bytes() {
        [b'G' | b'g' | b'L' | b'l' | b'X' | b'x', second, ..] => {
            second.is_ascii_alphabetic() || *second == b'_'
        }
        [_, ..] => true,
        [] => false,
    }
}

/// Lines of the machine's profile, which stand in the program as they are.
struct OfProfile {
    header: Vec<String>,
    footer: Vec<String>,
    stage: Stage,
}

/// How far the program is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// Nothing has been done.
    Head,
    /// Between the first thing done and the lines at the end.
    Body,
    /// A line at the end has been read.
    Foot,
}

impl OfProfile {
    fn new(settings: &Settings<'_>, style: Style) -> Self {
        Self {
            header: essences(&settings.profile.header, style),
            footer: essences(&settings.profile.footer, style),
            stage: Stage::Head,
        }
    }

    /// Whether a statement of the main program is one of them; then it is used up.
    fn takes(&mut self, code: &str) -> bool {
        let take = |lines: &mut Vec<String>| {
            let is = lines.iter().position(|line| *line == essence(code));
            is.map(|at| lines.remove(at)).is_some()
        };
        if self.stage == Stage::Head && take(&mut self.header) {
            return true;
        }
        let is_foot = take(&mut self.footer);
        if is_foot {
            self.stage = Stage::Foot;
        }
        is_foot
    }
}

struct Walk<'t, 'h> {
    tongue: &'static dyn Tongue,
    context: Context<'t>,
    control: Control<'t>,
    given: Given,
    profile: OfProfile,
    scripts: Vec<Script<'t>>,
    /// The files that are being carried out, the main program first.
    stack: Vec<usize>,
    heed: &'h mut dyn FnMut(Statement),
}

/// How things go on behind a statement.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Onward {
    Next,
    Enter(usize),
    Leave,
    Over,
}

impl<'t> Walk<'t, '_> {
    fn tell(&mut self, place: Place, says: Says) {
        (self.heed)(Statement { place, says });
    }

    fn enter(&mut self, script: usize) {
        if let Some(entered) = self.scripts.get_mut(script) {
            entered.entered = true;
            self.stack.push(script);
        }
    }

    fn follow(&mut self) {
        while let Some(&script) = self.stack.last() {
            let style = self.tongue.style();
            let Some(current) = self.scripts.get_mut(script) else {
                return;
            };
            let Some(line) = current.next(style) else {
                let place = current.end();
                self.ends_too_soon(place);
                continue;
            };
            let (says, onward) = self.statement(script, &line);
            self.tell(line.place, says);
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
        let [of_main, of_part] = self.tongue.endings();
        let missing = if self.stack.len() > 1 { of_part } else { of_main };
        let expected = format!("`{missing}` at the end");
        self.tell(place, Says::Unreadable { expected });
        self.stack.pop();
    }

    /// Tells the rest of the file, which is not carried out, and goes back to who called.
    fn leave(&mut self) {
        let Some(script) = self.stack.pop() else { return };
        while let Some(line) = self.next_of(script) {
            let order = line
                .code
                .ok()
                .and_then(|code| self.tongue.order(code, self.context).ok());
            let is_end = match order.and_then(|order| order.flow) {
                Some(Flow::Tape | Flow::End) => true,
                Some(Flow::Close(routine)) => self.is_own(script, routine),
                Some(
                    Flow::Head(_) | Flow::PartHead(_) | Flow::Call(_) | Flow::Return | Flow::ReturnFrom(_),
                )
                | None => false,
            };
            self.tell(line.place, if is_end { Says::Setting } else { Says::Unknown });
        }
    }

    /// Whether a routine is that of a file.
    fn is_own(&self, script: usize, routine: Routine<'_>) -> bool {
        let own = self.scripts.get(script).and_then(|script| script.routine);
        own.is_some_and(|own| own.is(routine))
    }

    fn next_of(&mut self, script: usize) -> Option<Line<'t>> {
        let style = self.tongue.style();
        self.scripts.get_mut(script)?.next(style)
    }

    /// Files that nobody calls: their first statement is not understood, and the others do nothing.
    fn never_called(&mut self) {
        for script in 0..self.scripts.len() {
            if self.scripts.get(script).is_some_and(|script| script.entered) {
                continue;
            }
            let mut says = Says::Unknown;
            while let Some(line) = self.next_of(script) {
                self.tell(line.place, core::mem::replace(&mut says, Says::Setting));
            }
        }
    }

    fn statement(&mut self, script: usize, line: &Line<'t>) -> (Says, Onward) {
        let longest = self.context.settings.dialect.longest_line();
        let understood = match &line.code {
            Err(trouble) => Err(trouble.clone()),
            Ok(_) if line.length > longest => Err(Trouble::Expected(format!(
                "a line of at most {longest} characters"
            ))),
            Ok(code) => self.understood(script, code),
        };
        let is_main = self.stack.len() == 1;
        let is_setting = matches!(&understood, Ok((Says::Setting, _)));
        let taken = match &line.code {
            Ok(code) if is_main && !is_setting && !is_motion(&understood) => self.profile.takes(code),
            Ok(_) | Err(_) => false,
        };
        if taken {
            return (Says::Setting, Onward::Next);
        }
        match understood {
            Ok((says, onward)) => (self.in_its_stage(says), onward),
            Err(trouble) => {
                self.control.forget();
                let says = match trouble {
                    Trouble::Unknown => Says::Unknown,
                    Trouble::Expected(expected) => Says::Unreadable { expected },
                };
                (says, Onward::Next)
            }
        }
    }

    /// Nothing is done behind the lines at the end.
    fn in_its_stage(&mut self, says: Says) -> Says {
        match (&says, self.profile.stage) {
            (Says::Deed(_) | Says::PartBegins, Stage::Foot) => Says::Unreadable {
                expected: "the end of the program".to_owned(),
            },
            (Says::Deed(_) | Says::PartBegins, Stage::Head | Stage::Body) => {
                self.profile.stage = Stage::Body;
                says
            }
            (Says::Setting | Says::Frame(..) | Says::Unknown | Says::Unreadable { .. }, _) => says,
        }
    }

    fn understood(&mut self, script: usize, code: &'t str) -> Result<(Says, Onward), Trouble> {
        let order = match self.given.heed(code) {
            Found::Part(Role::TcpOn | Role::TcpOff) => {
                self.control.switch_tcp(None);
                return Ok((Says::Setting, Onward::Next));
            }
            Found::Part(Role::On | Role::Off | Role::Ready) => return Ok((Says::Setting, Onward::Next)),
            Found::Whole(role) => given(role),
            Found::Nothing => self.tongue.order(code, self.context)?,
        };
        let begun = self.scripts.get_mut(script).map(|script| {
            let before = script.begun;
            script.begun |= order.flow != Some(Flow::Tape);
            before
        });
        let says = self.control.carry_out(&order)?;
        let is_main = self.stack.len() == 1;
        let needs_head = match self.tongue.heads() {
            Heads::None => false,
            Heads::OfParts => !is_main,
            Heads::All => true,
        };
        match order.flow {
            Some(Flow::Tape | Flow::Head(_) | Flow::PartHead(_)) => {}
            Some(Flow::Call(_) | Flow::Return | Flow::ReturnFrom(_) | Flow::Close(_) | Flow::End) | None => {
                if needs_head && begun == Some(false) {
                    return Err(Trouble::Expected(
                        "the name of the file, at its beginning".to_owned(),
                    ));
                }
            }
        }
        match order.flow {
            None => Ok((says, Onward::Next)),
            Some(flow) => self.flow(script, flow, begun.unwrap_or(true), &order),
        }
    }

    fn flow(
        &mut self,
        script: usize,
        flow: Flow<'_>,
        begun: bool,
        order: &Order<'_>,
    ) -> Result<(Says, Onward), Trouble> {
        let is_main = self.stack.len() == 1;
        let is_own = |routine: Routine<'_>| self.is_own(script, routine);
        if order.feed.is_some() {
            return Err(Trouble::Expected("nothing else in the block".to_owned()));
        }
        match flow {
            Flow::Tape if !begun => Ok((Says::Setting, Onward::Next)),
            Flow::Tape => Err(Trouble::Expected("the end of the program before `%`".to_owned())),
            Flow::Head(routine) if !begun && is_own(routine) => Ok((Says::Setting, Onward::Next)),
            Flow::PartHead(routine) if !begun && is_own(routine) && !is_main => {
                Ok((Says::Setting, Onward::Next))
            }
            Flow::Head(_) | Flow::PartHead(_) => Err(Trouble::Expected(
                "the name of the file, at its beginning".to_owned(),
            )),
            Flow::Call(routine) => {
                let mut scripts = self.scripts.iter();
                let to = scripts.position(|to| !to.entered && to.routine.is_some_and(|of| of.is(routine)));
                match to {
                    Some(to) => {
                        self.control.restart();
                        Ok((Says::PartBegins, Onward::Enter(to)))
                    }
                    None => Err(Trouble::Expected("the name of a part, called once".to_owned())),
                }
            }
            Flow::Return if !is_main => Ok((Says::Setting, Onward::Leave)),
            Flow::ReturnFrom(routine) if !is_main && is_own(routine) => Ok((Says::Setting, Onward::Leave)),
            Flow::Return | Flow::ReturnFrom(_) => Err(Trouble::Unknown),
            Flow::Close(routine) if !is_own(routine) => {
                Err(Trouble::Expected("the name of the file".to_owned()))
            }
            Flow::Close(_) if is_main => Ok((Says::Setting, Onward::Over)),
            Flow::Close(_) => Ok((Says::Setting, Onward::Leave)),
            Flow::End => Ok((Says::Setting, Onward::Over)),
        }
    }
}

fn is_motion(understood: &Result<(Says, Onward), Trouble>) -> bool {
    match understood {
        Ok((Says::Deed(deed), _)) => match deed {
            Deed::Axes(_) | Deed::AxesToPose(_) | Deed::Straight { .. } => true,
            Deed::Switch { .. } | Deed::AwaitInput(_) | Deed::Wait(_) => false,
        },
        Ok(_) | Err(_) => false,
    }
}

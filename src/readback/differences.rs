//! The steps between two programs as diagnostics: at their places in the given program, with the place in the job that
//! asks for something else.

use super::comparison::Comparison;
use super::edits::{Edits, Parts};
use super::listing::{Listing, skeleton};
use super::meaning::says_the_same;
use super::steps::Step;
use super::wording::{command_words, kind_words, mismatch_words, op_words, pace_words};
use vcutc_backend_api::ir::{Action, OpId, Registered};
use vcutc_backend_api::readback::{Command, Effect, FrameRole, Mismatch, Moment, normalized};
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic, Label};
use vcutc_job::{HeldTool, Machine};

/// So many differences are reported one by one.
const MOST_IN_FULL: usize = 20;

/// Most characters of a statement that a message repeats.
const LONGEST_QUOTE: usize = 120;

pub(super) struct Differences {
    /// The first of them in full.
    pub(super) diagnostics: Vec<Diagnostic>,
    /// How many there are of each code.
    pub(super) counts: Vec<(Code, usize)>,
}

impl Differences {
    pub(super) fn count(&self) -> usize {
        self.counts.iter().map(|(_, count)| count).sum()
    }
}

/// Puts what differs into words.
pub(super) fn differences(comparison: &Comparison<'_>, edits: &Edits) -> Differences {
    let mut reporter = Reporter {
        comparison,
        moments: comparison.moments(),
        diagnostics: Vec::new(),
        counts: Vec::new(),
        after_effects: AfterEffects::default(),
    };
    match edits.parts {
        Parts::AsWritten => {}
        Parts::Otherwise => reporter.other_parts(),
    }
    for &step in &edits.steps {
        reporter.step(step);
    }
    reporter.settle();
    if comparison.given.beyond > 0 {
        reporter.too_long();
    }
    reporter.count_the_rest();
    Differences {
        diagnostics: reporter.diagnostics,
        counts: reporter.counts,
    }
}

struct Reporter<'s> {
    comparison: &'s Comparison<'s>,
    moments: Vec<Moment>,
    diagnostics: Vec<Diagnostic>,
    counts: Vec<(Code, usize)>,
    after_effects: AfterEffects,
}

/// Statements that read the same and do something else, because of a difference before them: the setting that
/// was reported last, or if there was none, whatever was reported last.
#[derive(Default)]
struct AfterEffects {
    /// The diagnostic of the cause, as far as it is reported in full.
    cause: Option<usize>,
    is_setting: bool,
    count: usize,
    first: Option<String>,
    /// Where the job says what the first of them should be.
    asked: Option<Span>,
    /// How many of them are not understood any more.
    lost: usize,
    /// Whether anything was reported that they can follow from.
    follow: Follow,
}

/// Whether what reads otherwise can be an after-effect.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum Follow {
    /// Nothing was reported before.
    #[default]
    Nothing,
    Cause,
}

impl Reporter<'_> {
    fn step(&mut self, step: Step) {
        let diagnostic = match step {
            Step::Same { fresh, given } => return self.same(fresh, given),
            Step::OfPart { .. } => return,
            Step::Changed { fresh, given } => self.changed(fresh, given),
            Step::Moved { fresh, given } => self.moved(fresh, given),
            Step::Missing { fresh, given } => self.missing(fresh, given),
            Step::Added { given, .. } => self.added(given),
        };
        self.report(diagnostic);
    }

    /// That the program is split in another way. What the parts do is compared all the same.
    fn other_parts(&mut self) {
        let begins = |listing: &Listing<'_>| {
            let statements = listing.statements.iter().enumerate();
            let begins = statements.filter(|(_, statement)| statement.effect == Effect::PartBegins);
            begins.map(|(index, _)| index).collect::<Vec<_>>()
        };
        let (is, should) = (begins(self.comparison.given), begins(self.comparison.fresh));
        let parts = |count: usize| counted(count, "part");
        let has_none = is.is_empty() && !should.is_empty();
        let (label, help) = match has_none {
            true => ("no part begins in this file", "compile the job again"),
            false => (
                "the first part begins here",
                "give the options that the program was written with, such as --option lines_per_part=N, or compile the job again",
            ),
        };
        let message = if has_none {
            "the beginning of the program is missing".to_owned()
        } else if is.len() == should.len() {
            format!(
                "the {} begin at other places than in the compiled program",
                parts(is.len().max(1))
            )
        } else {
            format!(
                "the program is split differently: {}, the compiler writes {}",
                parts(is.len().max(1)),
                parts(should.len().max(1))
            )
        };
        let span = self.span(is.first().copied().unwrap_or_default());
        self.report(
            Diagnostic::new(Code::OtherSetting, message, span, label)
                .and(self.comparison.job.name_span, "the job")
                .note("the effect of the parts is still compared; what each part sets up and restates does not count as a difference")
                .help(help),
        );
        // How a program is split changes nothing of what its statements do.
        self.after_effects = AfterEffects::default();
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        let is_setting = diagnostic.code == Code::OtherSetting;
        match self.counts.iter_mut().find(|(code, _)| *code == diagnostic.code) {
            Some((_, count)) => *count += 1,
            None => self.counts.push((diagnostic.code, 1)),
        }
        let is_shown = self.reported() <= MOST_IN_FULL;
        if is_setting || !self.after_effects.is_setting {
            self.settle();
            self.after_effects = AfterEffects {
                cause: is_shown.then_some(self.diagnostics.len()),
                is_setting,
                follow: Follow::Cause,
                ..AfterEffects::default()
            };
        }
        if is_shown {
            self.diagnostics.push(diagnostic);
        }
    }

    fn reported(&self) -> usize {
        self.counts.iter().map(|(_, count)| count).sum()
    }

    /// Adds to a difference what it brings about.
    fn settle(&mut self) {
        let effects = core::mem::take(&mut self.after_effects);
        let cause = effects.cause.and_then(|cause| self.diagnostics.get_mut(cause));
        let Some(cause) = cause else {
            return;
        };
        if effects.is_setting
            && cause.secondary.is_empty()
            && let Some(asked) = effects.asked
        {
            cause.secondary.push(Label {
                span: asked,
                text: "asked for here".to_owned(),
            });
        }
        match effects.lost {
            0 => {}
            1 => cause
                .notes
                .push("1 statement after it depends on it: its effect is now unknown".to_owned()),
            lost => cause.notes.push(format!(
                "{lost} statements after it depend on it: their effect is now unknown"
            )),
        }
        let Some(first) = effects.first else {
            return;
        };
        let others = match effects.count {
            1 => String::new(),
            2 => ", and one more line is affected".to_owned(),
            count => format!(", and {} more lines are affected", count - 1),
        };
        cause
            .notes
            .push(format!("this changes what follows: {first}{others}"));
    }

    fn same(&mut self, fresh: usize, given: usize) {
        let (Some(should), Some(is)) = (
            self.comparison.fresh.effect(fresh),
            self.comparison.given.effect(given),
        ) else {
            return;
        };
        if says_the_same(should, is) {
            return;
        }
        // What is at fault stands before it; where nothing was reported before it, this is reported, and the
        // rest follows from it.
        match (self.after_effects.follow, is) {
            (Follow::Nothing, _) => {
                let diagnostic = self.changed(fresh, given);
                self.report(diagnostic);
            }
            (Follow::Cause, Effect::Unknown | Effect::Unreadable { .. }) => self.after_effects.lost += 1,
            (
                Follow::Cause,
                Effect::Command(_) | Effect::Frame(..) | Effect::Setting | Effect::PartBegins,
            ) => {
                self.after_effects.count += 1;
                if self.after_effects.first.is_none() {
                    self.after_effects.first = Some(self.after_effect(fresh, should, is));
                    self.after_effects.asked = self.asked_of_effect(fresh, is);
                }
            }
        }
    }

    /// The field of the job that says what an after-effect should be, such as a feed; at least its operation.
    fn asked_of_effect(&self, fresh: usize, is: &Effect) -> Option<Span> {
        let op = self.comparison.owner(fresh)?;
        let mismatches = self.mismatches(fresh, is);
        Some(self.speed_or(self.asked(Some(op)), op, mismatches.first()))
    }

    fn after_effect(&self, fresh: usize, should: &Effect, is: &Effect) -> String {
        let words = self.comparison.owner(fresh).map_or_else(
            || kind_words(should).to_owned(),
            |op| op_words(self.comparison.program(), op),
        );
        let what = match (should, is, self.mismatches(fresh, is).first()) {
            (_, _, Some(mismatch)) => Some(self.in_words(mismatch)),
            (Effect::Command(should), Effect::Command(is), None) => {
                match (pace_words(is), pace_words(should)) {
                    (Some(is), Some(should)) if is != should => Some(format!("{is} instead of {should}")),
                    (_, _) => None,
                }
            }
            (_, _, None) => None,
        };
        match what {
            Some(what) => format!("{words}: {what}"),
            None => format!("{words} has changed"),
        }
    }

    /// The op that a statement of the fresh program, or the first one after it that says an op, says.
    fn next_owner(&self, fresh: usize) -> Option<OpId> {
        self.comparison.owners.iter().skip(fresh).find_map(|owner| *owner)
    }

    fn changed(&self, fresh: usize, given: usize) -> Diagnostic {
        let (should, is) = (
            self.comparison.fresh.effect(fresh),
            self.comparison.given.effect(given),
        );
        let span = self.span(given);
        let owner = self.comparison.owner(fresh);
        let asked = self.asked(owner);
        let diagnostic = match (is, should, owner) {
            (Some(is @ (Effect::Unknown | Effect::Unreadable { .. })), Some(should), _)
                if is_setting(should) && self.is_of_one_kind(fresh, given) =>
            {
                self.other_setting(should, is, (fresh, given))
            }
            (Some(Effect::Unknown), _, _) => self.not_understood(given),
            (Some(Effect::Unreadable { expected }), _, _) => self.unreadable(given, expected),
            (Some(is), Some(Effect::Command(_)), Some(op)) => {
                let program = self.comparison.program();
                let mismatches = self.mismatches(fresh, is);
                let what = match (mismatches.first(), is) {
                    (Some(Mismatch::Kind), Effect::Command(command)) => {
                        format!("instead, {}", command_words(command))
                    }
                    (Some(mismatch), Effect::Command(_)) => self.in_words(mismatch),
                    (None, Effect::Command(_)) => {
                        "agrees to within rounding in place, attitude and speed, but is not what the compiler writes"
                            .to_owned()
                    }
                    (_, Effect::Frame(..) | Effect::Setting | Effect::PartBegins) => {
                        format!("{} is there instead", kind_words(is))
                    }
                    (_, Effect::Unknown | Effect::Unreadable { .. }) => "not understood".to_owned(),
                };
                let message = format!("{}: {what}", op_words(program, op));
                let more = mismatches.iter().skip(1);
                let diagnostic =
                    Diagnostic::new(Code::ChangedOperation, message, span, "not what the job asks for")
                        .and(self.speed_or(asked, op, mismatches.first()), "asked for here");
                more.fold(diagnostic, |diagnostic, mismatch| {
                    diagnostic.note(self.in_words(mismatch))
                })
            }
            (Some(is), Some(should), _) => {
                let code = match should.command() {
                    Some(_) => Code::ChangedOperation,
                    None => Code::OtherSetting,
                };
                let what = match (should, is) {
                    (Effect::Command(Command::Straight { .. }), Effect::Command(command)) => {
                        // A point between the two ends of an op, where a wrist turns far.
                        let program = self.comparison.program();
                        let of = self
                            .next_owner(fresh)
                            .map_or_else(|| "a motion".to_owned(), |op| op_words(program, op));
                        format!("at a point on the way of {of}: {}", command_words(command))
                    }
                    (Effect::Command(_), Effect::Command(command)) => {
                        format!("where a part restates what holds, {}", command_words(command))
                    }
                    (_, _) => format!("{} differs from what the compiler writes", kind_words(should)),
                };
                let diagnostic = Diagnostic::new(code, what, span, "reads differently");
                match self.frame_span(should, fresh) {
                    Some(frame) => diagnostic.and(frame, OWN_VALUE),
                    None => diagnostic,
                }
            }
            (None, _, _) | (_, None, _) => self.added(given),
        };
        let texts = [
            self.comparison.fresh.text(fresh),
            self.comparison.given.text(given),
        ];
        if let [should, is] = texts.map(normalized)
            && should == is
        {
            return diagnostic.help("the line itself is as it should be: fix what it depends on");
        }
        diagnostic.fix(
            "restore the compiler's line, or change the job to match",
            span,
            self.comparison.fresh.text(fresh),
        )
    }

    /// Whether two statements differ in their numbers only.
    fn is_of_one_kind(&self, fresh: usize, given: usize) -> bool {
        skeleton(self.comparison.fresh.text(fresh)) == skeleton(self.comparison.given.text(given))
    }

    /// A setting with another value, whose meaning is not known.
    fn other_setting(&self, should: &Effect, is: &Effect, (fresh, given): (usize, usize)) -> Diagnostic {
        let message = format!("{} differs from what the compiler writes", kind_words(should));
        let diagnostic = Diagnostic::new(Code::OtherSetting, message, self.span(given), "reads differently");
        let diagnostic = match (self.field(should, (fresh, given)), &self.comparison.job.machine) {
            (Some(field), _) => diagnostic.and(field, OWN_VALUE),
            (None, Some(machine)) => diagnostic.and(machine.head_span, "the machine that it is written for"),
            (None, None) => diagnostic,
        };
        match is {
            Effect::Unreadable { expected } => diagnostic.note(format!("{expected} is expected")),
            _ => diagnostic,
        }
    }

    /// The field of the job's machine that a setting follows from, where that is known.
    fn field(&self, should: &Effect, (fresh, given): (usize, usize)) -> Option<Span> {
        let machine = self.comparison.job.machine.as_ref()?;
        let texts = [
            self.comparison.fresh.text(fresh),
            self.comparison.given.text(given),
        ];
        let [should_be, are] = texts.map(|text| {
            let numbers = text.split(|c: char| !c.is_ascii_digit() && c != '.');
            numbers.filter_map(|number| number.parse::<f64>().ok())
        });
        let load = self
            .tool_in_hand(machine, fresh)
            .load
            .and_then(|load| match load.value {
                Registered::Value(value) => Some((value.mass.to_kg(), load.span)),
                Registered::Number(_) => None,
            });
        let Some((mass, load)) = load else {
            return self.frame_span(should, fresh);
        };
        let names_load = should_be.zip(are).any(|(should, is)| {
            let is_mass = (should - mass).abs() < SAME_MASS;
            is_mass && (is - mass).abs() >= SAME_MASS
        });
        if names_load {
            load
        } else {
            self.frame_span(should, fresh)
        }
    }

    fn moved(&self, fresh: usize, given: usize) -> Diagnostic {
        let program = self.comparison.program();
        let what = match (self.comparison.owner(fresh), self.comparison.fresh.effect(fresh)) {
            (Some(op), _) => op_words(program, op),
            (None, Some(effect)) => kind_words(effect).to_owned(),
            (None, None) => "a statement".to_owned(),
        };
        let diagnostic = Diagnostic::new(
            Code::OtherOrder,
            format!("{what} is in another place"),
            self.span(given),
            "the compiler writes this elsewhere",
        )
        .and(
            self.asked(self.comparison.owner(fresh)),
            "the order follows from this",
        );
        let diagnostic = match fresh.checked_sub(1) {
            Some(before) => {
                let before = quote(self.comparison.fresh.text(before));
                diagnostic.note(format!("it belongs after `{before}`"))
            }
            None => diagnostic.note("it belongs first"),
        };
        diagnostic.help("move the line back, or compile the job again")
    }

    fn missing(&self, fresh: usize, given: usize) -> Diagnostic {
        let text = quote(self.comparison.fresh.text(fresh));
        let program = self.comparison.program();
        let owner = self.comparison.owner(fresh);
        let (code, what) = match (owner, self.comparison.fresh.effect(fresh)) {
            (Some(op), _) => (Code::MissingOperation, op_words(program, op)),
            (None, Some(Effect::Command(command))) => (Code::MissingOperation, command_words(command)),
            (None, Some(effect)) => (Code::OtherSetting, kind_words(effect).to_owned()),
            (None, None) => (Code::OtherSetting, "a statement".to_owned()),
        };
        let (span, label) = match self.comparison.given.statements.get(given) {
            Some(_) => (self.span(given), "it belongs before this"),
            None => (self.span(given), "the program ends here"),
        };
        Diagnostic::new(code, format!("{what} is missing"), span, label)
            .and(self.asked(owner), "asked for here")
            .note(format!("the compiler writes `{text}` here"))
            .help(format!(
                "restore `{text}`, or change the job so that it is not needed"
            ))
    }

    fn added(&self, given: usize) -> Diagnostic {
        let span = self.span(given);
        match self.comparison.given.effect(given) {
            Some(Effect::Unknown) => self.not_understood(given),
            Some(Effect::Unreadable { expected }) => self.unreadable(given, expected),
            Some(Effect::Command(command)) => Diagnostic::new(
                Code::AddedOperation,
                format!("the job does not ask for this: {}", command_words(command)),
                span,
                "added to the program",
            )
            .and(self.comparison.job.name_span, "the job")
            .help("delete this line, or change the job to match"),
            Some(effect) => Diagnostic::new(
                Code::OtherSetting,
                format!("{} that the compiler does not write", kind_words(effect)),
                span,
                "added to the program",
            )
            .help("delete this line"),
            None => Diagnostic::new(Code::OtherSetting, "an additional statement", span, "here"),
        }
    }

    fn not_understood(&self, given: usize) -> Diagnostic {
        Diagnostic::new(
            Code::UnknownStatement,
            format!(
                "the effect of `{}` is unknown",
                quote(self.comparison.given.text(given))
            ),
            self.span(given),
            "not a statement that the compiler writes or knows",
        )
        .help("delete it, or move it into a separate program that calls this one")
    }

    fn unreadable(&self, given: usize, expected: &str) -> Diagnostic {
        Diagnostic::new(
            Code::UnreadableStatement,
            format!("this is not a statement of the target's language: {expected} is expected"),
            self.span(given),
            format!("expected {expected}"),
        )
        .help("fix the line, or compile the job again")
    }

    fn too_long(&mut self) {
        let given = self.comparison.given.statements.len().saturating_sub(1);
        let (held, beyond) = (
            self.comparison.given.statements.len(),
            self.comparison.given.beyond,
        );
        let diagnostic = Diagnostic::new(
            Code::AddedOperation,
            format!("the program continues for {beyond} statements that no program of this job has"),
            self.span(given),
            format!("compared up to here, {held} statements"),
        )
        .help("give the files of one program of this job only");
        self.report(diagnostic);
    }

    /// Says how many differences are not reported one by one.
    fn count_the_rest(&mut self) {
        let more = self.reported().saturating_sub(MOST_IN_FULL);
        if more == 0 {
            return;
        }
        let counts: Vec<_> = self
            .counts
            .iter()
            .map(|(code, count)| format!("{count} of {}", code.number()))
            .collect();
        if let Some(last) = self.diagnostics.last_mut() {
            last.notes.push(format!(
                "{more} more differences are not shown; in all there are {}",
                counts.join(", ")
            ));
        }
    }

    /// In what a statement is not the op that a fresh one says.
    fn mismatches(&self, fresh: usize, is: &Effect) -> Vec<Mismatch> {
        let (Some(op), Effect::Command(command)) = (self.comparison.owner(fresh), is) else {
            return Vec::new();
        };
        let moment = self.moments.get(op.0 as usize);
        moment.map_or_else(Vec::new, |moment| {
            self.comparison.comparator.mismatches(*moment, command)
        })
    }

    fn in_words(&self, mismatch: &Mismatch) -> String {
        mismatch_words(mismatch, self.comparison.program().cell.as_ref())
    }

    /// Where a statement of the given program stands; after the last one where there is none.
    fn span(&self, given: usize) -> Span {
        self.comparison.span(given)
    }

    /// Where in the job an op is asked for.
    fn asked(&self, op: Option<OpId>) -> Span {
        self.comparison.asked(self.comparison.program(), op)
    }

    /// Where the job says a speed, if that is what differs.
    fn speed_or(&self, asked: Span, op: OpId, mismatch: Option<&Mismatch>) -> Span {
        let program = self.comparison.program();
        let machine = self.comparison.job.machine.as_ref();
        let Some(found) = program.op(op) else {
            return asked;
        };
        let operation = found.site.operation();
        let operation = operation.and_then(|id| self.comparison.job.operations.get(usize::from(id.0)));
        let setup = operation.map(|operation| operation.setup());
        let span = match (mismatch, found.action) {
            (Some(Mismatch::Feed { .. }), Action::Cut { .. }) => setup.and_then(|setup| setup.cut_feed.span),
            (Some(Mismatch::Feed { .. }), _) => setup.and_then(|setup| setup.travel_feed.span),
            (Some(Mismatch::Rate { .. }), _) => setup.and_then(|setup| setup.reorient_rate.span),
            (Some(Mismatch::Output { .. }), Action::Ultrasonic { .. }) => machine
                .and_then(|machine| machine.ultrasonic)
                .and_then(|output| output.span),
            (_, Action::Spin { .. }) => machine
                .and_then(|machine| machine.spindle)
                .and_then(|spindle| spindle.span),
            (Some(Mismatch::Input { .. }), _) | (_, Action::AwaitReady) => {
                machine.and_then(|machine| machine.ready.span)
            }
            (_, Action::ChangePlace | Action::ToolChange { .. }) => machine
                .and_then(|machine| machine.change)
                .map(|change| change.span),
            (_, Action::Home) => machine
                .and_then(|machine| machine.home)
                .and_then(|home| home.span),
            (_, _) => None,
        };
        span.unwrap_or(asked)
    }

    fn frame_span(&self, effect: &Effect, fresh: usize) -> Option<Span> {
        let machine = self.comparison.job.machine.as_ref()?;
        match effect {
            Effect::Frame(FrameRole::Tool, _) => self.tool_in_hand(machine, fresh).frame.span,
            Effect::Frame(FrameRole::Base, _) => machine.base.span,
            _ => None,
        }
    }

    /// The tool of the machine that is at hand where the fresh program has a statement.
    fn tool_in_hand<'m>(&self, machine: &'m Machine, fresh: usize) -> &'m HeldTool {
        let program = self.comparison.program();
        let op = self.next_owner(fresh).and_then(|op| usize::try_from(op.0).ok());
        let before = op.and_then(|op| program.ops.get(..=op)).unwrap_or_default();
        let tool = before.iter().rev().find_map(|op| match op.action {
            Action::ToolChange { tool } => Some(tool),
            _ => None,
        });
        let blade = tool.and_then(|tool| program.blade(tool));
        let held = blade.and_then(|blade| machine.tools.holding(&blade.name));
        held.unwrap_or_else(|| machine.tools.first())
    }
}

/// Whether a statement sets something for those after it.
const fn is_setting(effect: &Effect) -> bool {
    matches!(effect, Effect::Frame(..) | Effect::Setting)
}

/// Masses nearer than this are the same, in kg.
const SAME_MASS: f64 = 1e-6;

/// What a job's field is to a setting.
const OWN_VALUE: &str = "the job's own value";

/// A statement as messages repeat it: on one line, and not too long.
fn quote(text: &str) -> String {
    let line: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(LONGEST_QUOTE) {
        Some((end, _)) => format!("{}...", line.get(..end).unwrap_or_default()),
        None => line,
    }
}

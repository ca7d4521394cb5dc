//! What is known of a root file: a job, or a library that no open job uses.
//!
//! Text and meaning are checked as soon as a text changes. What `auto` becomes and whether the machine follows takes
//! longer, so it is a [`Task`] that is done beside and handed back. The analysis holds the interest in it: a text that changes
//! has another analysis, and the task for the one before ends early. An answer that came all the same is thrown away, because
//! the analysis it belongs to is not there any more.

use super::text::Text;
use std::collections::BTreeMap;
use vcutc_backend_api::backend::Backend;
use vcutc_cancellation::{Interest, Needless, Wanted};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::overlay::Overlay;
use vcutc_diagnostics::source::{FileId, Loader, SourceMap};
use vcutc_driver::hints::{Hint, hints};
use vcutc_driver::memory::Memory;
use vcutc_driver::{
    self as driver, Outcome, Patience, Request, RequestError, Run, SearchEffort, Typed, Unhurried,
};
use vcutc_job::PlannedJob;
use vcutc_job::sema::kept_surfaces::Surfaces;
use vcutc_job::sema::kind::Operations;
use vcutc_job::sema::study::{Study, study};
use vcutc_job::sema::{Choices, Part};
use vcutc_syntax::ast::{Ast, Item};

/// The texts of open documents, by their paths. They replace the files.
pub(super) type OpenTexts = BTreeMap<String, Text>;

/// What is known of a root file.
#[derive(Debug)]
pub(super) struct Analysis {
    /// The path of the root file.
    pub(super) root: String,
    /// As what it was checked.
    pub(super) part: Part,
    /// The number of this analysis, which is unique.
    pub(super) stamp: u64,
    /// All texts, as they were checked.
    pub(super) sources: SourceMap,
    /// Diagnostics about text and meaning.
    pub(super) diagnostics: Vec<Diagnostic>,
    /// Trees, names and the job.
    pub(super) study: Study,
    /// The result of planning.
    pub(super) planning: Planning,
}

#[derive(Debug)]
pub(super) enum Planning {
    /// There is nothing to plan: a library, or a job with errors.
    Needless,
    /// To be done.
    Due,
    /// Running, until this is dropped.
    UnderWay(Interest),
    /// Refused, or made slow by its machine, and suggestions are searched until this is dropped.
    Helping(
        #[expect(dead_code, reason = "it is held, and ends when it is dropped")] Interest,
        Box<Planned>,
    ),
    Done(Box<Planned>),
}

/// The result of planning and proving.
#[derive(Clone, Debug)]
pub(super) struct Planned {
    /// All texts, as they were planned.
    pub(super) sources: SourceMap,
    /// All diagnostics of the job.
    pub(super) diagnostics: Vec<Diagnostic>,
    /// The plan, when one could be made.
    pub(super) plan: Option<PlannedJob>,
    /// The figures of the program, when the job is right.
    pub(super) summary: Vec<String>,
    /// Changes that make the job faster, where its machine made it slow.
    pub(super) hints: Vec<Hint>,
}

/// Whether a file is a job or a library: a library defines names and holds nothing that belongs to one job only. A file
/// without anything is a job that has not begun.
pub(super) fn part_of(ast: &Ast, operations: Operations) -> Part {
    let mut defines = false;
    for item in &ast.items {
        match item {
            Item::Job { .. } => return Part::Job,
            Item::Use { .. } | Item::Let { .. } => defines = true,
            Item::Block(block) => match vcutc_job::sema::vocabulary::standing(block, operations) {
                Some(Part::Job) => return Part::Job,
                Some(Part::Library) => defines = true,
                None => {}
            },
        }
    }
    if defines { Part::Library } else { Part::Job }
}

impl Analysis {
    /// Looks at text and meaning. None when the root file cannot be read.
    pub(super) fn of(
        root: &str,
        stamp: u64,
        loader: &dyn Loader,
        (operations, surfaces): (Operations, &Surfaces),
    ) -> Option<Self> {
        let (sources, diagnostics, study) = studied(root, Part::Job, loader, (operations, surfaces))?;
        let part = study
            .files
            .first()
            .map_or(Part::Job, |file| part_of(&file.ast, operations));
        let (sources, diagnostics, study) = match part {
            Part::Job => (sources, diagnostics, study),
            Part::Library => studied(root, part, loader, (operations, surfaces))?,
        };
        let planning = match &study.job {
            Some(_) => Planning::Due,
            None => Planning::Needless,
        };
        Some(Self {
            root: root.to_owned(),
            part,
            stamp,
            sources,
            diagnostics,
            study,
            planning,
        })
    }

    /// Takes over what is known, or is being found out, of a job that says the same: its number, too.
    pub(super) fn inheriting(mut self, earlier: Option<Self>) -> Self {
        let is_same = |earlier: &Self| earlier.sources == self.sources && earlier.study.job == self.study.job;
        if let Some(earlier) = earlier.filter(is_same) {
            self.stamp = earlier.stamp;
            self.planning = earlier.planning;
        }
        self
    }

    /// Whether a file of that path was read, or looked for.
    pub(super) fn concerns(&self, path: &str) -> bool {
        self.sources.iter().any(|(_, file)| file.name == path)
    }

    /// The number and the tree of a file of the language.
    pub(super) fn file(&self, path: &str) -> Option<(FileId, &Ast)> {
        let mut files = self.study.files.iter();
        let file = files.find(|file| self.sources.name(file.id) == path)?;
        Some((file.id, &file.ast))
    }

    /// The latest diagnostics, with the texts that they are about.
    pub(super) fn reported(&self) -> (&SourceMap, &[Diagnostic]) {
        match &self.planning {
            Planning::Done(planned) | Planning::Helping(_, planned) => {
                (&planned.sources, &planned.diagnostics)
            }
            Planning::Needless | Planning::Due | Planning::UnderWay(_) => (&self.sources, &self.diagnostics),
        }
    }

    /// Changes that make the job faster, as far as they are known.
    pub(super) fn hints(&self) -> &[Hint] {
        self.planned().map_or(&[], |planned| &planned.hints)
    }

    /// The plan, if it is there.
    pub(super) fn planned(&self) -> Option<&Planned> {
        match &self.planning {
            Planning::Done(planned) | Planning::Helping(_, planned) => Some(planned),
            Planning::Needless | Planning::Due | Planning::UnderWay(_) => None,
        }
    }
}

/// What a file and all that it uses say as a job or a library. None when it cannot be read.
fn studied(
    root: &str,
    part: Part,
    loader: &dyn Loader,
    (operations, surfaces): (Operations, &Surfaces),
) -> Option<(SourceMap, Vec<Diagnostic>, Study)> {
    let (mut sources, mut diagnostics) = (SourceMap::default(), Vec::new());
    let choices = Choices {
        operations,
        surfaces: Some(surfaces),
        ..Choices::default()
    };
    let study = study(root, part, loader, choices, &mut sources, &mut diagnostics).ok()?;
    Some((sources, diagnostics, study))
}

/// A job to be planned: a piece of work that needs nothing of the server, so that another thread can do it.
#[derive(Debug)]
pub struct Task {
    pub(super) root: String,
    pub(super) operations: Operations,
    pub(super) stamp: u64,
    pub(super) open: OpenTexts,
    pub(super) wanted: Wanted,
}

/// A task that is over.
#[derive(Debug)]
pub struct Done {
    pub(super) root: String,
    pub(super) stamp: u64,
    pub(super) result: Finding,
}

/// The result of a task.
#[derive(Debug)]
pub(super) enum Finding {
    /// The job was planned.
    Planned(Box<Planned>),
    /// This much is known of the job, which is refused, or slower than it need be; help is looked for, and the task continues.
    AtOnce(Box<Planned>),
    /// It could not be read.
    Unreadable,
    /// The answer was not wanted any more.
    Needless,
}

impl Task {
    /// Plans the job and proves the plan, with what is kept of plans before. It ends early when the text has changed.
    #[must_use]
    pub fn run(self, files: &dyn Loader, targets: &[&'static dyn Backend], memory: &mut Memory) -> Done {
        self.run_reporting(files, targets, memory, (&mut Unhurried, &mut |_| ()))
    }

    /// As [`Self::run`]; what is known of a job is published at once, before suggestions are searched.
    #[must_use]
    pub fn run_reporting(
        self,
        files: &dyn Loader,
        targets: &[&'static dyn Backend],
        memory: &mut Memory,
        (patience, report): (&mut dyn Patience, &mut dyn FnMut(Done)),
    ) -> Done {
        let overlay = Overlay {
            texts: &self.open,
            below: files,
        };
        let request = Request {
            path: &self.root,
            loader: &overlay,
            overrides: &[],
            machine: None,
            options: Typed::default(),
            effort: SearchEffort::Normal,
            operations: self.operations,
            targets,
        };
        let mut early = Early {
            root: &self.root,
            stamp: self.stamp,
            patience,
            report,
        };
        let run = Run {
            memory,
            wanted: &self.wanted,
            patience: &mut early,
        };
        let result = match self
            .wanted
            .answer(|| driver::compile_in(run, request, &mut |_| ()))
        {
            Ok(Ok(outcome)) => early.helped(outcome, &self.wanted),
            Ok(Err(RequestError::Unreadable(_))) => Finding::Unreadable,
            Err(Needless) => Finding::Needless,
        };
        Done {
            root: self.root,
            stamp: self.stamp,
            result,
        }
    }
}

/// Reports what is known of a job before help is looked for.
struct Early<'e> {
    root: &'e str,
    stamp: u64,
    patience: &'e mut dyn Patience,
    report: &'e mut dyn FnMut(Done),
}

impl Early<'_> {
    /// The result of a job, with changes that make it faster where its machine made it slow.
    fn helped(&mut self, outcome: Outcome, wanted: &Wanted) -> Finding {
        let Outcome {
            sources,
            diagnostics,
            job,
            plan,
            compiled,
            ..
        } = outcome;
        let mut planned = Planned {
            sources,
            diagnostics,
            plan,
            summary: compiled
                .as_ref()
                .map(|compiled| compiled.summary.clone())
                .unwrap_or_default(),
            hints: Vec::new(),
        };
        if let (Some(job), Some(compiled)) = (&job, &compiled)
            && compiled.not_followed.is_some()
        {
            self.report_at_once(planned.clone());
            planned.hints = hints(job, compiled, &wanted.and(&self.patience.slowed()));
        }
        if wanted.is_needless() {
            return Finding::Needless;
        }
        Finding::Planned(Box::new(planned))
    }

    fn report_at_once(&mut self, planned: Planned) {
        (self.report)(Done {
            root: self.root.to_owned(),
            stamp: self.stamp,
            result: Finding::AtOnce(Box::new(planned)),
        });
    }
}

impl Patience for Early<'_> {
    fn refused(&mut self, diagnostics: &[Diagnostic], sources: &SourceMap) -> Wanted {
        let planned = Planned {
            sources: sources.clone(),
            diagnostics: diagnostics.to_vec(),
            plan: None,
            summary: Vec::new(),
            hints: Vec::new(),
        };
        self.report_at_once(planned);
        self.patience.refused(diagnostics, sources)
    }

    fn cut_short(&self) -> Option<String> {
        self.patience.cut_short()
    }

    fn slowed(&mut self) -> Wanted {
        self.patience.slowed()
    }
}

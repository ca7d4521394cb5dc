//! A job with everything that was learnt on the way to its meaning, for answers about its text.
//!
//! [`check`](super::check) keeps the meaning and forgets the rest; editors ask for the trees of all files, for what each name
//! stands for, and for the value of an expression in the middle of a job that is not yet right.

use super::dimension::Dimension;
use super::eval::{Scope, walk};
use super::files::{self, File};
use super::gather::Definitions;
use super::kind::Operations;
use super::names::{Names, Thing};
use super::overrides::{self, keep_fixes_to_files};
use super::quantity::{Quantity, number};
use super::report::{Checked, Reports};
use super::session::Session;
use super::{Choices, Part, Said, cell, cut_short, options, understand, units};
use crate::search::SearchEffort;
use crate::{BladeKind, CheckedJob};
use vcutc_diagnostics::source::{FileId, LoadError, Loader, SourceMap, Spanned};
use vcutc_diagnostics::{Diagnostic, has_errors};
use vcutc_syntax::ast::{Ast, Expr};

/// What is known of a job, or of a library.
#[derive(Debug)]
pub struct Study {
    /// The files, the root first.
    pub files: Vec<StudiedFile>,
    /// The names that they define; of names that are defined twice the first definition.
    pub definitions: Vec<Definition>,
    /// The job, when it is one and has no errors of meaning.
    pub job: Option<CheckedJob>,
    /// The operations that the language has.
    pub operations: Operations,
}

/// A file and its tree.
#[derive(Debug)]
pub struct StudiedFile {
    pub id: FileId,
    pub ast: Ast,
}

/// A name and what it stands for.
#[derive(Clone, Debug)]
pub struct Definition {
    /// The name, where it is defined.
    pub name: Spanned<String>,
    pub meaning: Meaning,
}

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meaning {
    /// A value; none if it could not be worked out.
    Value(Option<Value>),
    Blade(BladeKind),
    Region,
    Machine,
}

/// The value of an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value(Quantity);

/// Loads a job or a library and everything it uses, and finds out what can be known of it.
///
/// Diagnostics go to `diagnostics` in the order of the source, file by file; all texts go to `sources`.
///
/// # Errors
/// When the root file cannot be loaded.
pub fn study(
    root: &str,
    part: Part,
    loader: &dyn Loader,
    choices: Choices<'_>,
    sources: &mut SourceMap,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Study, LoadError> {
    let mut session = Session::new(loader, sources);
    session.surfaces = choices.surfaces;
    let files = files::load(root, &mut session)?;
    let overrides = overrides::read(choices.overrides, choices.options.given, &mut session);
    let wanted = cell::wanted(choices.machine, &mut session);
    if choices.effort == SearchEffort::High {
        // Part of what a program was made from.
        session.sources.add("--effort high".to_owned(), "high".to_owned());
    }
    let (job, definitions) = match files.first() {
        Some(root) => {
            let said = Said {
                overrides: &overrides,
                machine: wanted.as_ref(),
                options: options::Said {
                    typed: choices.options,
                    read: &overrides.options,
                },
                operations: choices.operations,
                effort: choices.effort,
            };
            understand(root, &files, part, said, &mut session)
        }
        None => (None, Vec::new()),
    };
    let mut found = session.reports.into_vec();
    found.sort_by_key(|diagnostic| (diagnostic.primary.span.file, diagnostic.primary.span.start));
    let job = job.filter(|_| !has_errors(&found));
    cut_short(&mut found);
    for diagnostic in &mut found {
        overrides.keep_fixes_to_files(diagnostic);
        if let Some(wanted) = &wanted {
            keep_fixes_to_files(diagnostic, |file| file == wanted.span.file);
        }
    }
    diagnostics.append(&mut found);
    Ok(Study {
        files: files
            .into_iter()
            .map(|File { id, ast, .. }| StudiedFile { id, ast })
            .collect(),
        definitions,
        job,
        operations: choices.operations,
    })
}

/// The names that are defined, with their values.
pub(super) fn definitions(all: &Definitions<'_>, values: &[Option<Checked<Quantity>>]) -> Vec<Definition> {
    let lets = all.lets.iter().enumerate().map(|(index, subject)| {
        let value = values.get(index).copied().flatten().and_then(Result::ok);
        let meaning = Meaning::Value(value.map(Value));
        (subject.name.clone(), Thing::Let(index), meaning)
    });
    let blades = all.blades.iter().enumerate().map(|(index, (head, _))| {
        let name = head.name.map(str::to_owned);
        (name, Thing::Blade(index), Meaning::Blade(head.kind))
    });
    let regions = all
        .regions
        .iter()
        .enumerate()
        .map(|(index, (name, _))| (name.map(str::to_owned), Thing::Region(index), Meaning::Region));
    let machines = all.machines.iter().enumerate().map(|(index, machine)| {
        let name = machine.head.name.map(str::to_owned);
        (name, Thing::Machine(index), Meaning::Machine)
    });
    lets.chain(blades)
        .chain(regions)
        .chain(machines)
        .filter(|(name, thing, _)| {
            all.names
                .get(&name.node)
                .is_some_and(|known| known.thing == *thing)
        })
        .map(|(name, _, meaning)| Definition { name, meaning })
        .collect()
}

impl Study {
    /// What a name stands for.
    #[must_use]
    pub fn definition(&self, name: &str) -> Option<&Definition> {
        self.definitions
            .iter()
            .find(|definition| definition.name.node == name)
    }

    /// To work out expressions of this job's files.
    #[must_use]
    pub fn evaluator(&self) -> Evaluator<'_> {
        let mut names = Names::default();
        let mut values = Vec::new();
        for Definition { name, meaning } in &self.definitions {
            if let Meaning::Value(Some(Value(value))) = meaning {
                let thing = Thing::Let(values.len());
                names.define(
                    Spanned::new(&name.node, name.span),
                    thing,
                    &mut Reports::default(),
                );
                values.push(Some(Ok(*value)));
            }
        }
        Evaluator { names, values }
    }
}

/// Works out expressions by the values that a study found.
#[derive(Debug)]
pub struct Evaluator<'a> {
    names: Names<'a>,
    values: Vec<Option<Checked<Quantity>>>,
}

impl Evaluator<'_> {
    /// The value of an expression; none if it has none.
    #[must_use]
    pub fn value(&self, expr: &Spanned<Expr>) -> Option<Value> {
        let scope = Scope {
            names: &self.names,
            lets: &[],
            values: &self.values,
            variables: &[],
        };
        scope.evaluate(expr, &mut Reports::default()).ok().map(Value)
    }
}

impl Value {
    /// In the unit that people use for it: `34.16 deg`.
    #[must_use]
    pub fn text(self) -> String {
        self.0.text()
    }

    /// In every unit that matters to a reader of the expression: the unit that it begins with, the one that
    /// people use, and the one that the compiler computes with.
    #[must_use]
    pub fn texts(self, expr: &Spanned<Expr>) -> Vec<String> {
        let written = walk(expr).find_map(|part| self.in_unit_of(&part.node));
        let mut texts: Vec<String> = written.into_iter().collect();
        texts.push(self.text());
        if self.0.dimension.angle != 0 {
            texts.push(number(self.0.value) + " " + &self.base_unit());
        }
        let mut shown: Vec<String> = Vec::new();
        for text in texts {
            if !shown.contains(&text) {
                shown.push(text);
            }
        }
        shown
    }

    /// In the unit of a number with one, if it is a unit for this value.
    fn in_unit_of(self, part: &Expr) -> Option<String> {
        let Expr::Number { unit: Some(unit), .. } = part else {
            return None;
        };
        let one = units::quantity(1.0, &unit.node)?;
        let fits = one.dimension == self.0.dimension && one.dimension != Dimension::PURE;
        fits.then(|| {
            let count = number(self.0.value / one.value);
            format!("{count} {}", unit.node)
        })
    }

    /// The unit in which values of this kind are stored: mm, rad, s, kg.
    fn base_unit(self) -> String {
        self.0.dimension.unit().replace("deg", "rad")
    }

    pub const fn dimension(self) -> Dimension {
        self.0.dimension
    }

    /// What kind of quantity it is, with article: `a length`.
    #[must_use]
    pub fn kind(self) -> String {
        self.0.dimension.words()
    }
}

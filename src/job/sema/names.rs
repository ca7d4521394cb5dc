//! Names: what the files define, gathered before anything is evaluated, so that order does not matter.
//!
//! `let`s, blades, regions and machines share one space of names over all files: a reader of `dagger`
//! anywhere in a job knows that it means one thing.

use super::report::{Reported, Reports};
use super::units;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
pub use vcutc_diagnostics::schema::faults::did_you_mean;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};

/// What a name stands for, with its place in the list of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Thing {
    /// A `let`.
    Let(usize),
    Blade(usize),
    Region(usize),
    Machine(usize),
}

impl Thing {
    /// With article.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Let(_) => "a value",
            Self::Blade(_) => "a blade",
            Self::Region(_) => "a region",
            Self::Machine(_) => "a machine",
        }
    }
}

/// A name's definition.
#[derive(Clone, Copy, Debug)]
pub struct Definition {
    pub thing: Thing,
    /// Where the name is defined.
    pub span: Span,
}

/// All names of a job.
#[derive(Debug, Default)]
pub struct Names<'a> {
    table: BTreeMap<&'a str, Definition>,
    /// Set when definitions may be missing for a reason that has been reported.
    pub incomplete: Option<Reported>,
}

/// Most names that an unknown one is compared with.
const MOST_COMPARED: usize = 20_000;

/// Words with a meaning of their own in values.
pub const RESERVED: &[&str] = &["auto", "pi"];

impl<'a> Names<'a> {
    /// Defines a name, or reports why it cannot be defined.
    pub fn define(&mut self, name: Spanned<&'a str>, thing: Thing, reports: &mut Reports) {
        let Spanned { node: name, span } = name;
        let fault = if RESERVED.contains(&name) {
            Diagnostic::new(
                Code::DefinedTwice,
                format!("`{name}` is reserved by the language"),
                span,
                "cannot be redefined",
            )
            .help(format!("choose another name, such as `my_{name}`"))
        } else {
            match self.table.entry(name) {
                Entry::Vacant(entry) => {
                    entry.insert(Definition { thing, span });
                    return;
                }
                Entry::Occupied(entry) => twice(name, span, entry.get().span),
            }
        };
        reports.push(fault);
    }

    /// The definition of a name.
    pub fn get(&self, name: &str) -> Option<Definition> {
        self.table.get(name).copied()
    }

    /// Names of one kind.
    fn of_kind(&self, is_wanted: fn(Thing) -> bool) -> impl Iterator<Item = &'a str> {
        self.table
            .iter()
            .filter(move |(_, definition)| is_wanted(definition.thing))
            .map(|(name, _)| *name)
    }

    /// Names of `let`s that are near a wanted one.
    pub fn lets_near(&self, wanted: &str) -> Vec<&'a str> {
        nearest(wanted, self.of_kind(|thing| matches!(thing, Thing::Let(_))))
    }

    /// All names of a kind, for a help line; none when there are none, or too many to read.
    pub fn list(&self, is_wanted: fn(Thing) -> bool) -> Option<String> {
        let names: Vec<String> = self
            .of_kind(is_wanted)
            .take(13)
            .map(|name| format!("`{name}`"))
            .collect();
        (1..=12).contains(&names.len()).then(|| names.join(", "))
    }

    /// Reports a name that is not one of the kind wanted.
    pub fn not_a(
        &self,
        what: &str,
        name: &str,
        span: Span,
        is_wanted: fn(Thing) -> bool,
        reports: &mut Reports,
    ) -> Reported {
        match (self.get(name), self.incomplete) {
            (Some(definition), _) => {
                let diagnostic = Diagnostic::new(
                    Code::WrongKind,
                    format!("`{name}` is {}, not a {what}", definition.thing.words()),
                    span,
                    format!("expected a {what} here"),
                );
                reports.push(diagnostic.and(definition.span, "defined here"))
            }
            // Its definition may be in text that could not be read, unless it looks like a slip of a known name.
            (None, Some(reported)) if self.near(what, name, is_wanted, reports).is_empty() => reported,
            (None, Some(_) | None) => {
                let fault = self.unknown(what, name, span, is_wanted, reports);
                reports.push(fault)
            }
        }
    }

    /// Names of a kind that are near a wanted one.
    fn near(&self, what: &str, name: &str, is_wanted: fn(Thing) -> bool, reports: &Reports) -> Vec<&'a str> {
        // Comparing every name with every other one would take too long where both are many.
        if reports.are_many() || self.table.len() > MOST_COMPARED {
            return Vec::new();
        }
        nearest(
            name,
            self.of_kind(is_wanted).chain(what.eq("value").then_some("pi")),
        )
    }

    /// The diagnostic for a name of some kind that is defined nowhere.
    fn unknown(
        &self,
        what: &str,
        name: &str,
        span: Span,
        is_wanted: fn(Thing) -> bool,
        reports: &Reports,
    ) -> Diagnostic {
        let mut diagnostic = Diagnostic::new(
            Code::UnknownName,
            format!("there is no {what} named `{name}`"),
            span,
            "not defined in this file or in any that it uses",
        );
        if what == "value" && units::is_unit(name) {
            return diagnostic
                .note(format!(
                    "`{name}` is a unit, which goes after a number: `1 {name}`"
                ))
                .help("a unit has one `/` at most, as in `mm/s`");
        }
        let near = self.near(what, name, is_wanted, reports);
        diagnostic = did_you_mean(diagnostic, span, &near);
        if near.is_empty() {
            diagnostic = match self.list(is_wanted) {
                Some(list) => diagnostic.help(format!("the names defined are {list}")),
                None if what == "blade" => diagnostic.help(format!(
                    "define it with the figures of your blade, such as `blade {name} {{ cutting_length = 30 mm, half_apex = 8 deg, \
                     thickness = 1.5 mm, edges = double }}`, or `use` the file that does"
                )),
                None => diagnostic.help("define it, or `use` the file that does"),
            };
        }
        diagnostic
    }
}

/// The diagnostic for a name that is defined twice.
pub fn twice(name: &str, second: Span, first: Span) -> Diagnostic {
    again(name, second, first).help("delete one of the two, or give it another name")
}

/// The diagnostic for what a job has once and no other name can be given to.
pub fn more_than_one(what: &str, second: Span, first: Span) -> Diagnostic {
    again(what, second, first).help(format!("delete one of the two: a job has one `{what}`"))
}

fn again(name: &str, second: Span, first: Span) -> Diagnostic {
    let place = if first.file == second.file {
        ""
    } else {
        ", in another file"
    };
    Diagnostic::new(
        Code::DefinedTwice,
        format!("`{name}` is defined twice"),
        second,
        "defined again here",
    )
    .and(first, format!("first defined here{place}"))
}

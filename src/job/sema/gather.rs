//! First look at the files: what is defined where, before anything is evaluated.

use super::fields::{Place, head_span};
use super::files::Files;
use super::heads::{BladeHead, Head, Kind, classify};
use super::kind::{Kind as OperationKind, Operations};
use super::names::{Names, Thing, did_you_mean, more_than_one};
use super::overrides::Overrides;
use super::report::{Reported, Reports};
use super::scope::Let;
use super::session::Session;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::{Block, Expr, Item};

/// A block and where it is.
#[derive(Clone, Copy)]
pub(crate) struct Placed<'a> {
    pub(crate) block: &'a Block,
    pub(crate) place: Place,
}

/// A file's standing in the job.
#[derive(Clone, Copy)]
pub(crate) enum Standing {
    /// The job's own file.
    Root,
    /// A file that is used, by the `use` at this place.
    Used(Option<Span>),
}

pub(crate) struct MachineBlock<'a> {
    pub(crate) head: Head<'a>,
    /// The block.
    pub(crate) placed: Placed<'a>,
    /// Where its file is.
    pub(crate) standing: Standing,
}

/// All that a job's files define.
#[derive(Default)]
pub(crate) struct Definitions<'a> {
    pub(crate) names: Names<'a>,
    /// `let`s of all files.
    pub(crate) lets: Vec<Let<'a>>,
    /// Blades of all files.
    pub(crate) blades: Vec<(BladeHead<'a>, Placed<'a>)>,
    /// Regions, each with its name.
    pub(crate) regions: Vec<(Spanned<&'a str>, Placed<'a>)>,
    /// Machines of all files.
    pub(crate) machines: Vec<MachineBlock<'a>>,
    /// The job's name.
    pub(crate) job: Option<&'a Spanned<String>>,
    pub(crate) stock: Option<Placed<'a>>,
    pub(crate) profile: Option<Placed<'a>>,
    pub(crate) surface: Option<Placed<'a>>,
    /// The choice of the machine.
    pub(crate) cell: Option<Placed<'a>>,
    /// Operations, in order.
    pub(crate) operations: Vec<(&'static dyn OperationKind, Placed<'a>)>,
    /// Set when a block could not be made out: it may be any that seems to be missing.
    pub(crate) doubtful: Option<Reported>,
}

/// Looks through all files.
pub(crate) fn gather<'a>(
    files: &'a Files,
    overrides: &'a Overrides,
    operations: Operations,
    session: &mut Session<'_>,
) -> Definitions<'a> {
    let mut all = Definitions::default();
    // The job's own file comes last: where names clash, it is the job that defines what the library has already.
    let root = files.iter().take(1).map(|file| (file, Standing::Root));
    let used = files
        .iter()
        .skip(1)
        .map(|file| (file, Standing::Used(file.used_at)));
    for (file, standing) in used.chain(root) {
        for item in &file.ast.items {
            all.item(item, standing, (overrides, operations), &mut session.reports);
        }
    }
    // A block that could not be made out may define the name that seems to be missing.
    all.names.incomplete = session.incomplete().or(all.doubtful);
    if session.incomplete().is_none() {
        all.check_overrides(overrides, &mut session.reports);
    }
    all
}

impl<'a> Definitions<'a> {
    fn item(
        &mut self,
        item: &'a Item,
        standing: Standing,
        (overrides, operations): (&'a Overrides, Operations),
        reports: &mut Reports,
    ) {
        match item {
            Item::Use { .. } => {}
            Item::Let { name, value, .. } => self.add_let(name, value, overrides, reports),
            Item::Job { name, span } => {
                if is_allowed("job", *span, standing, reports) {
                    if !name.node.chars().any(char::is_alphanumeric) {
                        reports.push(nameless(name.span));
                    }
                    match self.job {
                        None => self.job = Some(name),
                        Some(first) => {
                            reports.push(more_than_one("job", name.span, first.span));
                        }
                    }
                }
            }
            Item::Block(block) => match classify(block, operations) {
                Ok(kind) => self.block(kind, block, standing, reports),
                Err(fault) => {
                    self.doubtful = Some(reports.push(*fault));
                }
            },
        }
    }

    fn add_let(
        &mut self,
        name: &'a Spanned<String>,
        value: &'a Spanned<Expr>,
        overrides: &'a Overrides,
        reports: &mut Reports,
    ) {
        let thing = Thing::Let(self.lets.len());
        self.names
            .define(Spanned::new(&name.node, name.span), thing, reports);
        self.lets.push(match overrides.by_name.get(&name.node) {
            Some(given) => Let {
                name,
                value: &given.value,
                original: Some(value),
            },
            None => Let {
                name,
                value,
                original: None,
            },
        });
    }

    fn block(&mut self, kind: Kind<'a>, block: &'a Block, standing: Standing, reports: &mut Reports) {
        let place = Place {
            head: head_span(block),
            whole: block.span,
        };
        let placed = Placed { block, place };
        match kind {
            Kind::Stock => single(&mut self.stock, "stock", placed, standing, reports),
            Kind::Profile => single(&mut self.profile, "profile", placed, standing, reports),
            Kind::Surface => single(&mut self.surface, "surface", placed, standing, reports),
            Kind::Cell => single(&mut self.cell, "cell", placed, standing, reports),
            Kind::Operation(kind) => {
                if is_allowed(kind.head(), place.head, standing, reports) {
                    self.operations.push((kind, placed));
                }
            }
            Kind::Blade(head) => {
                self.names
                    .define(head.name, Thing::Blade(self.blades.len()), reports);
                self.blades.push((head, placed));
            }
            Kind::Region(name) => {
                if is_allowed("region", place.head, standing, reports) {
                    let thing = Thing::Region(self.regions.len());
                    self.names.define(name, thing, reports);
                    self.regions.push((name, placed));
                }
            }
            Kind::Machine(head) => {
                self.names
                    .define(head.name, Thing::Machine(self.machines.len()), reports);
                self.machines.push(MachineBlock {
                    head,
                    placed,
                    standing,
                });
            }
        }
    }

    /// Every value from the command line must meet a `let`.
    fn check_overrides(&self, overrides: &Overrides, reports: &mut Reports) {
        for (name, given) in &overrides.by_name {
            let thing = self.names.get(name).map(|definition| definition.thing);
            let label = match thing {
                Some(Thing::Let(_)) => continue,
                Some(other @ (Thing::Blade(_) | Thing::Region(_) | Thing::Machine(_))) => {
                    format!("`{name}` is {}", other.words())
                }
                None => "no `let` of this name in any file".to_owned(),
            };
            let diagnostic = Diagnostic::new(
                Code::BadOverride,
                format!("the job has no `let {name}` for `--set`"),
                given.name.span,
                label,
            );
            let near = self.names.lets_near(name);
            let diagnostic = did_you_mean(diagnostic, given.name.span, &near);
            let diagnostic = match self.names.list(|thing| matches!(thing, Thing::Let(_))) {
                Some(list) => diagnostic.help(format!("names that can be set are {list}")),
                None => diagnostic.help(format!(
                    "write `let {name} = ...` in the job, and use `{name}` where it is needed"
                )),
            };
            reports.push(diagnostic);
        }
    }
}

/// Takes a block of which there is one at most.
fn single<'a>(
    slot: &mut Option<Placed<'a>>,
    name: &str,
    placed: Placed<'a>,
    standing: Standing,
    reports: &mut Reports,
) {
    if !is_allowed(name, placed.place.head, standing, reports) {
        return;
    }
    match slot {
        None => *slot = Some(placed),
        Some(first) => {
            reports.push(more_than_one(name, placed.place.head, first.place.head));
        }
    }
}

/// What belongs to one job only cannot be in a file that is used.
fn is_allowed(what: &str, span: Span, standing: Standing, reports: &mut Reports) -> bool {
    let used_at = match standing {
        Standing::Root => return true,
        Standing::Used(used_at) => used_at,
    };
    let diagnostic = Diagnostic::new(
        Code::Misplaced,
        format!("`{what}` does not belong in a file that is used"),
        span,
        "belongs in the job's own file",
    );
    let diagnostic = match used_at {
        Some(place) => diagnostic.and(place, "the file is used here"),
        None => diagnostic,
    };
    reports.push(
        diagnostic
            .note("a used file contains `use`, `let`, `blade` and `machine`")
            .help("move it into the job"),
    );
    false
}

/// Program files are named after the job, so a name needs something to be read.
fn nameless(span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::OutOfRange,
        "a job's name needs a letter or a digit",
        span,
        "nothing to name a program after",
    )
    .help("give it the name of the part, such as `job \"spoiler_rib_12\"`")
}

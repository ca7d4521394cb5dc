//! Meaning: from trees to a checked job.
//!
//! Files are loaded (`files`), their definitions gathered (`gather`), `let`s worked out in whatever order they
//! need each other (`lets`), and then every block is read against the table of its fields. Every check reports what
//! it finds and hands back a token instead of a value (`report::Reported`); code that needs the value passes
//! the token on. So one run shows all faults, and none of their consequences.

mod arguments;
mod blade;
pub mod both;
mod cell;
mod decimal_comma;
mod described;
pub mod eval;
pub mod families;
pub mod field_ranges;
pub mod fields;
mod files;
mod follow;
mod frame;
mod functions;
mod gather;
mod heads;
pub mod hole;
mod home;
pub mod kept_surfaces;
pub mod kind;
mod lets;
mod load;
mod machine;
mod mismatch;
mod missing;
mod model;
pub mod names;
mod near_files;
mod options;
mod overrides;
pub(crate) mod part;
pub mod point;
mod profile;
pub mod quantity;
pub mod read;
pub mod region;
pub mod report;
mod scope;
pub mod session;
pub mod setup;
mod stock;
pub mod study;
pub mod surface;
mod tools;
pub mod units;
pub mod vocabulary;
pub mod written;

use crate::search::SearchEffort;
use crate::ways::{OpenChoice, Ways};
use crate::{Blade, BladeRef, CheckedJob, Machine, NamedRegion};
use eval::Scope;
use files::{File, Files};
use gather::Definitions;
use kept_surfaces::Surfaces;
use kind::Operations;
use missing::Missing;
use overrides::Overrides;
use report::Checked;
use session::Session;
use vcutc_backend_api::ir::Stock;
use vcutc_diagnostics::Diagnostic;
pub use vcutc_diagnostics::schema::dimension;
use vcutc_diagnostics::source::{LoadError, Loader, SourceMap, Spanned};
use vcutc_syntax::ast::Ast;
use written::Written;

/// What the command line says about a job, over what the job's files say.
#[derive(Clone, Copy, Debug, Default)]
pub struct Choices<'a> {
    /// Texts of the form `name=value` that replace `let`s.
    pub overrides: &'a [String],
    /// The name of the machine to cut on.
    pub machine: Option<&'a str>,
    /// Options of a target, over those of its block in the machine.
    pub options: Typed<'a>,
    /// How hard the best is searched for.
    pub effort: SearchEffort,
    /// The operations of the language.
    pub operations: Operations,
    /// Surfaces of files that runs before have read, where there are such runs.
    pub surfaces: Option<&'a Surfaces>,
}

/// Options of a target as the command line gives them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Typed<'a> {
    /// The target that they are for.
    pub target: &'a str,
    /// Texts of the form `key=value`.
    pub given: &'a [String],
    /// The file that names of files in them are relative to; empty for the current folder.
    pub beside: &'a str,
}

/// Loads a job and everything it uses, and works out what it means.
///
/// Gives the root file's tree, and the job when it is without errors of meaning. Diagnostics go to
/// `diagnostics` in the order of the source, file by file; all texts go to `sources`.
///
/// # Errors
/// When the root file cannot be loaded.
pub fn check(
    root: &str,
    loader: &dyn Loader,
    choices: Choices<'_>,
    sources: &mut SourceMap,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(Option<Ast>, Option<CheckedJob>), LoadError> {
    let study = study::study(root, Part::Job, loader, choices, sources, diagnostics)?;
    Ok((study.files.into_iter().next().map(|file| file.ast), study.job))
}

/// What a root file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A job, of which nothing may be missing.
    Job,
    /// A file that jobs use: names only.
    Library,
}

/// Most diagnostics of one run. More are not read, and a broken file may have a million.
const MOST_SHOWN: usize = 500;

/// Keeps the first diagnostics, and says that there are more.
fn cut_short(found: &mut Vec<Diagnostic>) {
    let rest = found.len().saturating_sub(MOST_SHOWN);
    found.truncate(MOST_SHOWN);
    if let Some(last) = found.last_mut().filter(|_| rest > 0) {
        last.notes.push(format!(
            "there are {rest} more faults like these; fix the first ones, then run again"
        ));
    }
}

/// What the command line says, read.
#[derive(Clone, Copy)]
struct Said<'a> {
    overrides: &'a Overrides,
    machine: Option<&'a Spanned<String>>,
    options: options::Said<'a>,
    operations: Operations,
    effort: SearchEffort,
}

/// What the files define, and what it is worth.
fn understand(
    root: &File,
    files: &Files,
    part: Part,
    said: Said<'_>,
    session: &mut Session<'_>,
) -> (Option<CheckedJob>, Vec<study::Definition>) {
    let all = gather::gather(files, said.overrides, said.operations, session);
    let values = lets::evaluate(&all.lets, &all.names, &mut session.reports);
    let scope = Scope {
        names: &all.names,
        lets: &all.lets,
        values: &values,
        variables: &[],
    };
    let job = match part {
        Part::Job => whole(root, &all, said, scope, session).ok(),
        Part::Library => {
            named_things(&all, scope, session);
            None
        }
    };
    (job, study::definitions(&all, &values))
}

/// The blades and the machines, which a job and a library have alike.
fn named_things(
    all: &Definitions<'_>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> (Vec<Checked<Blade>>, Vec<Checked<Machine>>) {
    let blades = all
        .blades
        .iter()
        .map(|(head, placed)| blade::check(*head, placed.block, placed.place, scope, session))
        .collect();
    let machines = all
        .machines
        .iter()
        .map(|machine| {
            machine::check(
                &machine.head,
                machine.placed.block,
                machine.placed.place,
                scope,
                session,
            )
        })
        .collect();
    (blades, machines)
}

/// The whole job.
fn whole(
    root: &File,
    all: &Definitions<'_>,
    said: Said<'_>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<CheckedJob> {
    let (blades, machines) = named_things(all, scope, session);
    let missing = Missing::of(root, all, said.operations, session);
    let name = match all.job {
        Some(name) => Ok(name),
        None => Err(missing.job(session)),
    };
    let stock = match all.stock {
        Some(placed) => stock::check(placed.block, placed.place, scope, session),
        None => Err(missing.stock(session)),
    };
    let (stock, cell_size) = match stock {
        Ok(stock) => (Ok(stock.size), stock.cell_size),
        Err(reported) => (Err(reported), None),
    };
    let regions = all
        .regions
        .iter()
        .map(|(name, placed)| region::check(*name, placed.block, placed.place, scope, session));
    let regions: Vec<Checked<NamedRegion>> = regions.collect();
    let part = part_of(all, stock, &missing, scope, session);
    let ways = all.operations.iter().map(|(kind, placed)| {
        let written = Written {
            block: placed.block,
            place: placed.place,
            scope,
            blades: &blades,
            regions: &regions,
            stock: stock.ok(),
        };
        kind.ways(written, session)
    });
    let ways: Vec<Checked<Ways>> = ways.collect();
    let ways: Checked<Vec<Ways>> = if ways.is_empty() {
        Err(missing.operation(session))
    } else {
        ways.into_iter().collect()
    };
    let machine = cell::choose(
        cell::Said {
            on_the_command_line: said.machine,
            in_the_job: all.cell,
        },
        &all.machines,
        &machines,
        missing.anchor(),
        scope,
        session,
    );
    let machine = set_up(machine, &ways, said.options, scope, session);
    let (name, stock) = (name?, stock?);
    let mut ways = ways?;
    let place = all
        .profile
        .or(all.surface)
        .map_or(stock.span, |placed| placed.place.whole);
    let machine = machine?;
    let asked = follow::Asked {
        part: part?,
        place,
        stock: stock.node,
        machine: machine.as_ref(),
    };
    let follow::Decided { part, families } = follow::decide(asked, &mut ways, &mut session.reports)?;
    let open = ways.iter().enumerate().filter(|(_, ways)| ways.are_several());
    let open = open.map(|(operation, ways)| OpenChoice {
        operation,
        ways: ways.clone(),
    });
    Ok(CheckedJob {
        name: name.node.clone(),
        name_span: name.span,
        stock: stock.node,
        stock_span: stock.span,
        cell_size,
        part,
        profile_span: place,
        effort: said.effort,
        open: open.collect(),
        families,
        operations: ways.into_iter().map(|ways| ways.into_first().operation).collect(),
        machine,
    })
}

/// The part: a profile or a surface; without either, where no operation needs one, the whole stock.
fn part_of(
    all: &Definitions<'_>,
    stock: Checked<Spanned<Stock>>,
    missing: &Missing,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<part::Part> {
    let needs_part = all.operations.is_empty() || all.operations.iter().any(|(kind, _)| kind.needs_part());
    match (all.profile, all.surface) {
        (Some(placed), None) => profile::check(placed.block, placed.place, stock, scope, session),
        (None, Some(placed)) => surface::check(placed.block, placed.place, stock, scope, session),
        (Some(profile), Some(surface)) => {
            let fault = surface::beside_a_profile(surface.place, profile.place);
            Err(session.reports.push(fault))
        }
        (None, None) if needs_part => Err(missing.part(stock.ok(), session)),
        (None, None) => stock.map(|stock| part::Part::whole(stock.node)),
    }
}

/// The machine with the options of the command line, and with the tools of the job's blades.
fn set_up(
    machine: Checked<Option<Machine>>,
    ways: &Checked<Vec<Ways>>,
    options: options::Said<'_>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Option<Machine>> {
    let Some(machine) = machine? else {
        return Ok(None);
    };
    let machine = options::over(machine, options, scope, session)?;
    let Ok(ways) = ways else {
        return Ok(Some(machine));
    };
    let ways = ways.iter().flat_map(Ways::iter);
    let blades: Vec<BladeRef<'_>> = ways.flat_map(|way| way.operation.blades()).collect();
    tools::used(machine, &blades)
        .map(Some)
        .map_err(|fault| session.reports.push(*fault))
}

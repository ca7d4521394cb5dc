//! `rough auto { ... }`: roughing by V cuts or by slits and strips, whichever is faster [Yu 2019].
//!
//! The block says what both processes share; blocks `vcut` and `rect` within it say what else one of them
//! needs, or has otherwise. Each process is then read as if it had a block of its own with all of that, so it
//! takes the fields that it takes elsewhere and gives the same messages. The result is two operations,
//! between which the job leaves the choice (`src/job/ways.rs`); the compiler compiles both and takes the
//! faster (`src/driver/ways.rs`).

mod merge;

use merge::with;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::Operation;
use vcutc_job::sema::field_ranges::{DISTANCE, LONGEST_TIME, SIZE};
use vcutc_job::sema::fields::{BlockSpec, Fields, Inner, Place, Takes, block, limit, value};
use vcutc_job::sema::kind::Kind;
use vcutc_job::sema::report::{Checked, Reported};
use vcutc_job::sema::session::Session;
use vcutc_job::sema::setup::{self, inner_place};
use vcutc_job::sema::written::Written;
use vcutc_job::ways::{Way, Ways};
use vcutc_rect::Rect;
use vcutc_syntax::ast::Block;
use vcutc_vcut::Vcut;

/// The block of V cuts.
const VCUT: &str = "vcut";
/// The block of slits and strips.
const RECT: &str = "rect";

const SPEC: BlockSpec = BlockSpec {
    title: "`rough auto`",
    fields: &[
        setup::BLADE,
        setup::RAKE_FIELD,
        block("limits", "{ scallop <= 10 mm }")
            .required()
            .takes(Takes::Fields(&LIMITS)),
        value("allowance", "0.5 mm").within(DISTANCE),
        setup::FEED,
        setup::CLEARANCE,
        setup::RUN_OUT_FIELD,
        value("standoff", "auto").within(DISTANCE).or_auto(),
        block(VCUT, "{ lattice = auto }").takes(Takes::Fields(&vcutc_vcut::SPEC)),
        block(RECT, "{ disc = wheel, feed { free = 100 mm/s } }")
            .required()
            .takes(Takes::Fields(&vcutc_rect::SPEC)),
    ],
    inner: Inner::Refused,
};

/// Limits that both processes keep. That on the scallop must be there: of two processes that leave different amounts, neither
/// is the faster one.
const LIMITS: BlockSpec = BlockSpec {
    title: "`limits` of `rough auto`",
    fields: &[
        limit("scallop", "10 mm").within(SIZE),
        limit("time", "10 min").within(LONGEST_TIME),
    ],
    inner: Inner::Refused,
};

/// `rough auto`.
#[derive(Clone, Copy, Debug)]
pub struct Auto;

impl Kind for Auto {
    fn head(&self) -> &'static str {
        "rough auto"
    }

    fn mistaken_for(&self) -> &'static [&'static str] {
        &["automatic", "fastest"]
    }

    fn spec(&self) -> &'static BlockSpec {
        &SPEC
    }

    fn check(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Box<dyn Operation>> {
        Ok(self.ways(written, session)?.into_first().operation)
    }

    fn ways(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Ways> {
        ways(written, session)
    }
}

fn ways(written: Written<'_>, session: &mut Session<'_>) -> Checked<Ways> {
    let Shared { entries, vcut, rect } = shared(written, session)?;
    let place_of = |inner: Option<&Block>| inner.map_or(written.place, inner_place);
    let (in_v, in_strips) = (place_of(vcut), place_of(Some(rect)));
    let none: &[_] = &[];
    let vcut = Block {
        entries: with(&entries, vcut.map_or(none, |inner| &inner.entries)),
        ..written.block.clone()
    };
    let rect = Block {
        entries: with(&entries, &rect.entries),
        ..written.block.clone()
    };
    let vcut = checked(&Vcut, &vcut, in_v, written, session);
    // What is wrong with a field that both share is found twice.
    let found = core::mem::take(&mut session.reports);
    let rect = checked(&Rect, &rect, in_strips, written, session);
    let again = core::mem::replace(&mut session.reports, found);
    session.reports.append_new(again);
    Ok(Ways::of(vcut?, vec![rect?]))
}

fn checked(
    kind: &'static dyn Kind,
    block: &Block,
    place: Place,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<Way> {
    let written = Written {
        block,
        place,
        ..written
    };
    Ok(Way {
        word: kind.words()[1],
        operation: kind.check(written, session)?,
    })
}

/// A block as it is written, taken apart.
struct Shared<'b> {
    /// What both processes share.
    entries: Vec<vcutc_syntax::ast::Entry>,
    vcut: Option<&'b Block>,
    rect: &'b Block,
}

/// Takes a block apart, and finds what is wrong with its names.
fn shared<'b>(written: Written<'b>, session: &mut Session<'_>) -> Checked<Shared<'b>> {
    let before = core::mem::take(&mut session.reports);
    let shared = sorted(written, session);
    let found = core::mem::replace(&mut session.reports, before).into_vec();
    match session.reports.append(found) {
        Some(reported) => Err(reported),
        None => shared,
    }
}

/// Reports that nothing says how fast the disc is fed. Both processes share the other feeds, so this one is offered where it belongs.
fn without_free(rect: &Block, session: &mut Session<'_>) -> Reported {
    let place = inner_place(rect);
    // What is wrong with its fields is found when they are checked.
    let before = core::mem::take(&mut session.reports);
    let fields = Fields::sort(&vcutc_rect::SPEC, place, &rect.entries, session);
    session.reports = before;
    let diagnostic = Diagnostic::new(
        Code::MissingField,
        "`rect` of `rough auto` needs `feed { free = ... }`, the speed of the disc in the material",
        place.head,
        "here",
    );
    let sample = "feed { free = 100 mm/s }";
    let diagnostic = fields.offer(diagnostic, "add it, for example", sample);
    session.reports.push(diagnostic)
}

fn sorted<'b>(written: Written<'b>, session: &mut Session<'_>) -> Checked<Shared<'b>> {
    let Written { block, place, .. } = written;
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    let limits = fields.required_block("limits", &mut session.reports);
    if let Ok(limits) = limits {
        let inner = Fields::sort(&LIMITS, inner_place(limits), &limits.entries, session);
        let _ = inner.required_value("scallop", &mut session.reports);
    }
    for required in [setup::BLADE, setup::RAKE_FIELD, setup::CLEARANCE] {
        let _ = fields.required_value(required.name, &mut session.reports);
    }
    let feed = fields.required_block(setup::FEED.name, &mut session.reports);
    let rect = fields.required_block(RECT, &mut session.reports);
    let vcut = fields.block(VCUT);
    if let Ok(rect) = rect
        && !rect
            .entries
            .iter()
            .any(|entry| merge::is_block(entry, &[setup::FEED.name]))
    {
        let _ = without_free(rect, session);
    }
    let entries = block.entries.iter();
    let entries = entries.filter(|entry| !merge::is_block(entry, &[VCUT, RECT]));
    let entries = entries.cloned().collect();
    match (limits, feed, vcut, rect) {
        (Ok(_), Ok(_), Ok(vcut), Ok(rect)) => Ok(Shared { entries, vcut, rect }),
        (Err(reported), ..) | (_, Err(reported), ..) | (_, _, Err(reported), _) | (.., Err(reported)) => {
            Err(reported)
        }
    }
}

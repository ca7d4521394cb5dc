//! The fields that all operations have: rake, direction, speeds, and the distances kept from the stock.
//!
//! An operation names them in its own table of fields, in the order in which people write them, and reads them here.

mod blade;

pub use blade::{BLADE, blade};

use super::field_ranges::{DISTANCE, RAKE, SIZE, SPEED, TURNING_RATE};
use super::fields::{BlockSpec, FieldSpec, Fields, Inner, Place, Takes, block, head_span, value};
use super::read::{Reader, default, words_of};
use super::report::Checked;
use super::session::Session;
use super::written::Written;
use crate::{Direction, Setup, Sourced};
use vcutc_backend_api::units::{Angle, AngularSpeed, Length, Speed};
use vcutc_syntax::ast::Block;

/// `rake = 60 deg`.
pub const RAKE_FIELD: FieldSpec = value("rake", "60 deg").required().within(RAKE);
/// `direction = alternate`.
pub const DIRECTION: FieldSpec =
    value("direction", "alternate").takes(Takes::Words(|| words_of(Direction::WORDS)));
/// `feed { ... }`.
pub const FEED: FieldSpec = block(
    "feed",
    "{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }",
)
.required()
.takes(Takes::Fields(&FEEDS));
/// `clearance = 10 mm`.
pub const CLEARANCE: FieldSpec = value("clearance", "10 mm").required().within(SIZE);
/// `extension = auto`.
pub const EXTENSION: FieldSpec = value("extension", "auto").within(DISTANCE).or_auto();
/// `run_out = 2 mm`.
pub const RUN_OUT_FIELD: FieldSpec = value("run_out", "2 mm").within(DISTANCE);

/// `feed { ... }` of an operation with a straight blade and a disc.
pub const FEED_OF_TWO: FieldSpec = block(
    "feed",
    "{ cut = 150 mm/s, free = 100 mm/s, travel = 200 mm/s, reorient = 90 deg/s }",
)
.required()
.takes(Takes::Fields(&FEEDS_OF_TWO));

const FEEDS_OF_TWO: BlockSpec = BlockSpec {
    title: "`feed`",
    fields: &[
        value("cut", "150 mm/s").required().within(SPEED),
        value("free", "100 mm/s").required().within(SPEED),
        TRAVEL,
        REORIENT,
    ],
    inner: Inner::Refused,
};

/// `feed { ... }` of an operation whose blade goes down into the material.
pub const FEED_WITH_PLUNGE: FieldSpec = block(
    "feed",
    "{ cut = 75 mm/s, plunge = 20 mm/s, travel = 200 mm/s, reorient = 90 deg/s }",
)
.required()
.takes(Takes::Fields(&FEEDS_WITH_PLUNGE));

const FEEDS_WITH_PLUNGE: BlockSpec = BlockSpec {
    title: "`feed`",
    fields: &[
        value("cut", "75 mm/s").required().within(SPEED),
        value("plunge", "20 mm/s").required().within(SPEED),
        TRAVEL,
        REORIENT,
    ],
    inner: Inner::Refused,
};

/// `feed { ... }` of an operation whose straight blade goes down into the material, and whose disc frees what it has slit.
pub const FEED_TO_FREE: FieldSpec = block(
    "feed",
    "{ cut = 150 mm/s, free = 75 mm/s, plunge = 20 mm/s, travel = 200 mm/s, reorient = 90 deg/s }",
)
.required()
.takes(Takes::Fields(&FEEDS_TO_FREE));

const FEEDS_TO_FREE: BlockSpec = BlockSpec {
    title: "`feed`",
    fields: &[
        value("cut", "150 mm/s").required().within(SPEED),
        value("free", "75 mm/s").required().within(SPEED),
        value("plunge", "20 mm/s").required().within(SPEED),
        TRAVEL,
        REORIENT,
    ],
    inner: Inner::Refused,
};

const FEEDS: BlockSpec = BlockSpec {
    title: "`feed`",
    fields: &[
        value("cut", "200 mm/s").required().within(SPEED),
        TRAVEL,
        REORIENT,
    ],
    inner: Inner::Refused,
};

const TRAVEL: FieldSpec = value("travel", "200 mm/s").required().within(SPEED);
const REORIENT: FieldSpec = value("reorient", "90 deg/s").required().within(TURNING_RATE);

/// Air between the blade and the stock where it turns, when the job does not say: a usual value for the errors of stock and
/// robot together, from no source.
const RUN_OUT: Length = Length::mm(2.0);

/// Reads them.
pub fn check(fields: &Fields<'_>, written: Written<'_>, session: &mut Session<'_>) -> Checked<Setup> {
    let feeds = fields
        .required_block("feed", &mut session.reports)
        .and_then(|inner| feeds(&FEEDS, inner, written, session));
    with_feeds(
        feeds.map(|(feeds, _)| feeds),
        Blades::Straight,
        fields,
        written,
        session,
    )
}

/// The same of an operation whose blade has no rake, because it is round.
pub fn check_without_rake(
    fields: &Fields<'_>,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<Setup> {
    let feeds = fields
        .required_block("feed", &mut session.reports)
        .and_then(|inner| feeds(&FEEDS, inner, written, session));
    with_feeds(
        feeds.map(|(feeds, _)| feeds),
        Blades::Round,
        fields,
        written,
        session,
    )
}

/// The blades of an operation, which decide what it states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Blades {
    /// A straight one: the operation states its rake, how far its cuts run out, and their direction.
    Straight,
    /// A straight one and a disc: the operation states the rake, and cuts to and fro.
    Both,
    /// A disc: the operation states the direction; the axis is taken to be square to the feed.
    Round,
}

/// The same of an operation with [`FEED_OF_TWO`], with the speed of its disc in the material.
pub fn check_of_two(
    fields: &Fields<'_>,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<(Setup, Sourced<Speed>)> {
    with_speed((&FEEDS_OF_TWO, "free"), Blades::Both, fields, written, session)
}

/// The same of an operation with [`FEED_WITH_PLUNGE`], with the speed of its way down.
pub fn check_with_plunge(
    fields: &Fields<'_>,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<(Setup, Sourced<Speed>)> {
    with_speed(
        (&FEEDS_WITH_PLUNGE, "plunge"),
        Blades::Round,
        fields,
        written,
        session,
    )
}

/// The same of an operation with [`FEED_TO_FREE`], with the speeds of its disc and of its way down.
pub fn check_to_free(
    fields: &Fields<'_>,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<(Setup, [Sourced<Speed>; 2])> {
    with_speeds(
        (&FEEDS_TO_FREE, ["free", "plunge"]),
        Blades::Round,
        fields,
        written,
        session,
    )
}

/// The setup, and one more speed of its block of feeds.
fn with_speed(
    (spec, name): (&'static BlockSpec, &str),
    blades: Blades,
    fields: &Fields<'_>,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<(Setup, Sourced<Speed>)> {
    let (setup, [speed]) = with_speeds((spec, [name]), blades, fields, written, session)?;
    Ok((setup, speed))
}

/// The setup, and more speeds of its block of feeds.
fn with_speeds<const N: usize>(
    (spec, names): (&'static BlockSpec, [&str; N]),
    blades: Blades,
    fields: &Fields<'_>,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<(Setup, [Sourced<Speed>; N])> {
    let both = fields
        .required_block("feed", &mut session.reports)
        .and_then(|inner| {
            let (feeds, fields) = feeds(spec, inner, written, session)?;
            let mut reader = Reader::new(written.scope, &mut session.reports);
            let mut speeds = [feeds.cut; N];
            for (speed, name) in speeds.iter_mut().zip(names) {
                *speed = reader.required(&fields, name)?;
            }
            Ok((feeds, speeds))
        });
    let (feeds, speeds) = match both {
        Ok((feeds, speeds)) => (Ok(feeds), Ok(speeds)),
        Err(reported) => (Err(reported), Err(reported)),
    };
    let setup = with_feeds(feeds, blades, fields, written, session);
    Ok((setup?, speeds?))
}

// The block of feeds comes first: it needs the session, of which the reader holds a part.
fn with_feeds(
    feeds: Checked<Feeds>,
    blades: Blades,
    fields: &Fields<'_>,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<Setup> {
    let scope = written.scope;
    let mut reader = Reader::new(scope, &mut session.reports);
    let rake = match blades {
        Blades::Straight | Blades::Both => reader.required(fields, "rake"),
        Blades::Round => Ok(default(Angle::deg(90.0))),
    };
    let direction = match blades {
        Blades::Straight | Blades::Round => {
            let asked = reader.choice(fields, "direction", Direction::WORDS);
            asked.map(|asked| Some(asked.unwrap_or(default(Direction::Alternate))))
        }
        Blades::Both => Ok(None),
    };
    let clearance = reader.required(fields, "clearance");
    let extension = match blades {
        Blades::Straight => reader.auto(fields, "extension").map(Some),
        Blades::Both | Blades::Round => Ok(None),
    };
    let run_out = reader.defaulted(fields, "run_out", RUN_OUT);
    let feeds = feeds?;
    Ok(Setup {
        head_span: written.place.head,
        rake: rake?,
        direction: direction?,
        cut_feed: feeds.cut,
        travel_feed: feeds.travel,
        reorient_rate: feeds.reorient,
        clearance: clearance?,
        extension: extension?,
        run_out: run_out?,
    })
}

/// The place of a block within an operation.
#[must_use]
pub fn inner_place(inner: &Block) -> Place {
    Place {
        head: head_span(inner),
        whole: inner.span,
    }
}

/// Speeds of the operation.
struct Feeds {
    cut: Sourced<Speed>,
    travel: Sourced<Speed>,
    reorient: Sourced<AngularSpeed>,
}

fn feeds<'b>(
    spec: &'static BlockSpec,
    inner: &'b Block,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<(Feeds, Fields<'b>)> {
    let fields = Fields::sort(spec, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(written.scope, &mut session.reports);
    let cut = reader.required(&fields, "cut");
    let travel = reader.required(&fields, "travel");
    let reorient = reader.required(&fields, "reorient");
    let feeds = Feeds {
        cut: cut?,
        travel: travel?,
        reorient: reorient?,
    };
    Ok((feeds, fields))
}

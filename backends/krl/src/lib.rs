//! KUKA KRL output (KSS 5 to 8).
//!
//! # The dialect
//!
//! A KRL program is a *module*: `NAME.src` holds the instructions of a routine `DEF NAME( )`, `NAME.dat` its data. All
//! declarations stand in the `.dat`, because one after an instruction of the `.src` does not compile. All
//! modules of a controller share one name space; names have at most 24 characters and do not mind case.
//!
//! `BAS (#INITMOV,0 )` resets everything motions depend on; tool, base, load, interpolation mode and speeds are set
//! after it. The first motion is `PTP` to the axis values of home. Every other `PTP` goes to a pose and says
//! by status and turn (the module `configuration`) which of the ways to hold it is meant; all `LIN` after it
//! keep the status of where they start. `LIN` moves the tip on a straight line while A, B and C change along;
//! with the same X, Y, Z it turns the blade about its still tip, timed by `$VEL.ORI1` and `.ORI2` instead of
//! `$VEL.CP`. What an aggregate leaves out stays as programmed before, so every target here names all six.
//!
//! A move ends at a standstill unless a word such as `C_DIS` follows it. That word appears only in the air, only when
//! the job asks for it, and only where the shortcut stays beside the stock. `$OUT[n]=TRUE` stops the advance run, so
//! the output switches where it stands; `CONTINUE`, which would let it switch early, is never written.
//!
//! # How an op is written
//!
//! | op | KRL |
//! |---|---|
//! | `Home` | `PTP XVC_HOME`, the angles being in the `.dat` |
//! | `AxisTravel` | `PTP {X ..,Y ..,Z ..,A ..,B ..,C ..,S n,T n}` |
//! | `Travel`, `Approach`, `Retract`, `Cut` | `LIN {X ..,Y ..,Z ..,A ..,B ..,C ..}` |
//! | `Follow` | `LIN {..}` or `CIRC {..},{..}`, with `C_DIS` where the chain continues |
//! | `Turn` | the same with the X, Y, Z of the move before |
//! | `Ultrasonic` | `$OUT[n]=TRUE`, `$OUT[n]=FALSE` |
//! | `AwaitReady` | `WAIT FOR $IN[n]` or `WAIT SEC t` |
//! | `Dwell` | `WAIT SEC t` |
//! | `ChangePlace` | `PTP XVC_CHANGE`, likewise |
//! | `ToolChange` | the cell's routine `NAME(n)` with the place of the tool, or `HALT`; then `$TOOL` and `$LOAD` again |
//!
//! `$VEL.CP` and the rates of swivel and twist, `$VEL.ORI1` and `$VEL.ORI2`, are written where they change. With the option `motion = spline` the words
//! are `SPTP`, `SLIN` and `C_SPL`; the two planners are never mixed in one program.
//!
//! # Chains
//!
//! A blade that follows an arc stands in the plane of its way from end to end. `$CIRC_TYPE=#PATH` says just that: the controller
//! leads the orientation relative to the way, and relative to it nothing changes but the rake. With `#BASE` it would swivel the
//! tool's direction along a great circle and twist about it at the same time, as in a `LIN`, which for a leaning blade is another
//! turn than that about the axis of the arc. As nothing says whether `$VEL.ORI1` limits a turn that belongs to the way, `$VEL.CP`
//! is so low on arcs that it takes its time without.
//!
//! Where a chain continues, `C_DIS` with the blend as `$APO.CDIS` lets the robot leave the one piece before its end and join the next
//! as far after its beginning. Between them the tip stays as near to both.
//!
//! # Long programs
//!
//! The pendant's editor becomes unusable with some thousands of lines, so a long program is a main module that calls
//! parts `NAME_p001( )`, `NAME_p002( )`, ... one after the other ([`vcutc_backend_api::script::split`] has the rule). Each part sets everything up
//! again, and repeats the pose and the state of the generator that the part before it ended with. The pose is repeated by
//! `PTP` with status and turn: called from the main module it leads nowhere, and a part that is started alone gets there
//! on the branch that its straight moves are proven on, which a `LIN` from wherever the arm stands would not.
//! It is a pose and not axis values, so that with frames that the controller keeps it is the pose of the part before it.
//!
//! # Reading
//!
//! [`read::KrlReader`] says what a program of this crate does, and nothing about what it does not know. It is
//! built on what serves other readers of KRL as well, such as `vcutc convert`: [`syntax`] has the statements
//! of a text with their places, [`interpreter`] carries them out.
//!
//! # Machines
//!
//! KUKA robots with six rotary axes and a spherical wrist: S and T are defined for those.
//!
//! # Sources
//!
//! * [K-QG] KUKA, Quickguide KRL-Syntax, KSS 8.x (2012)
//! * [K-SI] KUKA, KSS 8.3 Operating and Programming Instructions for System Integrators (2015)
//! * [K-SYS] KUKA, System Variables for KSS 8.1 to 8.4 (2016)
//! * [K-FOLD], [K-LINES], [K-EXT] articles on industrialmonitordirect.com on folders, file lengths and `EXT`
//!
//! No output of this crate has been run on a controller by its authors; `docs/backends/krl.md` says what to check first.

mod attitude;
mod change;
mod configuration;
mod dialect;
mod files;
pub mod interpreter;
mod limits;
mod names;
mod options;
mod profile;
pub mod read;
pub mod syntax;
mod turns;

use crate::attitude::Attitudes;
use crate::dialect::{Arcs, KrlDialect, Said};
use crate::names::{MOST_PARTS, main_name};
use crate::options::{OPTIONS, Settings};
use crate::read::KrlReader;
use crate::turns::Turns;
use vcutc_backend_api::arm::foreign;
use vcutc_backend_api::backend::{Backend, BackendIssue, Emission, MachineMismatch, OptionSpec, Options};
use vcutc_backend_api::chains::has_arcs;
use vcutc_backend_api::ir::{MachineKind, Maker, Program};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::Reader;
use vcutc_backend_api::script::{Borders, CAPABILITIES, Layout, Source, Text, emission, split, write};
use vcutc_backend_api::verify::{Capabilities, Capability};

/// Lines end as those that the controller's own editor writes (it runs on Windows). With `;FOLD` and indentation a line stays
/// below 132 characters, which every release reads; only `SCIRC` is longer, and its releases write longer
/// lines themselves. After a `;` the pendant reads `;%` as the start of its own marks.
const LAYOUT: Layout = Layout {
    line_end: b"\r\n",
    longest_comment: 110,
    kept_out_of_comments: b"%",
};

/// The KRL backend.
#[derive(Clone, Copy, Debug, Default)]
pub struct Krl;

impl Backend for Krl {
    fn id(&self) -> &'static str {
        "krl"
    }

    fn summary(&self) -> &'static str {
        "KUKA KRL: NAME.src and NAME.dat, in parts when long (KSS 5 to 8)"
    }

    fn capabilities(&self) -> Capabilities {
        CAPABILITIES.with(Capability::ToolChange).with(Capability::Chain)
    }

    fn options(&self) -> &'static [OptionSpec] {
        OPTIONS
    }

    fn mismatch(&self, kind: MachineKind, maker: Maker) -> Option<MachineMismatch> {
        foreign(kind, maker, Maker::Kuka)
    }

    fn reader(&self) -> Option<&dyn Reader> {
        Some(&KrlReader)
    }

    fn check<'p>(
        &self,
        program: &'p ReachableProgram,
        options: &'p Options,
    ) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>> {
        let settings = Settings::read(options);
        let turns = Turns::of(program.program());
        let parts = split(
            &program.program().ops,
            settings.common.lines_per_part,
            Borders::BetweenCuts,
            &|index, lead| turns.lines(index, lead),
        );
        let issues = profile::issues(options.profile(), program.program().cell.as_ref());
        let cell = match limits::check(program, &parts, &settings) {
            Ok(cell) if issues.is_empty() => cell,
            Ok(_) => return Err(issues),
            Err(more) => return Err(more.into_iter().chain(issues).collect()),
        };
        let source = Source {
            reachable: program,
            cell,
        };
        emission(parts, MOST_PARTS, move |parts, sink| {
            let Program {
                name, orientations, ..
            } = source.program();
            let main = main_name(name, parts.len(), &settings.common.profile.reserved);
            let mut krl = KrlDialect {
                source,
                settings: &settings,
                attitudes: &Attitudes::new(orientations, settings.angles)?,
                turns: &turns,
                arcs: if has_arcs(source.program()) {
                    Arcs::Some
                } else {
                    Arcs::None
                },
                text: &mut Text::new(sink, LAYOUT),
                said: Said::default(),
            };
            write(&mut krl, source, &settings.common, &main, parts)
        })
    }
}

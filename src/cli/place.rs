//! `vcutc place JOB`: the base frame that leaves the machine the most room.

use super::args::{Arguments, MessageFormat, PlaceArgs};
use super::console::{Console, Failure};
use super::files::Disk;
use super::output::{Destination, Output};
use super::progress::Progress;
use super::{Exit, Targets};
use crate::driver::Request;
use crate::placement::{self, Asked, Placement, Refusal, report};
use std::path::Path;
use vcutc_backend_api::bundle::Sink;

/// Places one job.
pub(super) fn place(args: &PlaceArgs, targets: &Targets, console: &Console) -> Exit {
    let disk = Disk::around(&args.job);
    let mut progress = Progress::start(console.shows_progress());
    let request = Request {
        path: disk.job(),
        loader: &disk,
        overrides: &args.overrides.set,
        targets,
    };
    let asked = Asked {
        x: args.x.as_deref(),
        y: args.y.as_deref(),
        z: args.z.as_deref(),
        yaw: args.yaw.as_deref(),
    };
    let placed = placement::place(request, &asked, &mut |stage| progress.enter(stage));
    progress.finish();
    match placed {
        Ok(placement) => tell(&placement, args.output.as_deref(), console),
        Err(Refusal::Unreadable(reason)) => console.failure(&Failure::new(format!(
            "cannot read the job {}: {reason}",
            args.job
        ))),
        Err(Refusal::BadBounds(bad)) => console.failure(&Failure::new(bad.to_string())),
        Err(Refusal::Diagnostics(diagnostics, sources)) => {
            console.diagnostics(&diagnostics, &sources);
            Exit::JobHasErrors
        }
    }
}

//! `vcutc place JOB`: the base frame that leaves the machine the most room, or with which its cuts deviate least.

use super::args::PlaceArgs;
use super::console::{Console, Failure};
use super::files::Disk;
use super::output::one_file;
use super::progress::Progress;
use super::{Exit, Targets};
use std::path::Path;
use vcutc_place::{self as place, Asked, Placement, Refusal, report};

/// Places one job.
pub(super) fn place(args: &PlaceArgs, targets: &Targets, console: &Console) -> Exit {
    let disk = Disk::around(&args.job);
    let mut progress = Progress::start(console.shows_progress());
    let request = args.overrides.request(&disk, targets);
    let asked = Asked {
        x: args.x.as_deref(),
        y: args.y.as_deref(),
        z: args.z.as_deref(),
        yaw: args.yaw.as_deref(),
        objective: args.objective.into(),
    };
    if let Some(path) = args.output.as_deref()
        && !path.to_ascii_lowercase().ends_with(".svg")
    {
        return console.failure(&Failure::new(format!(
            "the map is a picture in SVG: give `-o` the name of a file that ends in .svg, not {path}"
        )));
    }
    let placed = place::place(request, &asked, &mut |stage| progress.enter(stage));
    progress.finish();
    match placed {
        Ok(placement) => report_placement(&placement, args.output.as_deref(), &disk, console),
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

fn report_placement(placement: &Placement, map: Option<&str>, disk: &Disk, console: &Console) -> Exit {
    let write = |path| {
        let path = Path::new(path);
        disk.spares(path)?;
        one_file(path, placement.svg().as_bytes())
    };
    let written = match map.map(write).transpose() {
        Ok(files) => files.unwrap_or_default(),
        Err(reason) => return console.failure(&Failure::new(reason)),
    };
    let mut text = report::text(placement);
    for file in &written {
        text += &format!("\nwrote {}\n", file.path());
    }
    match console.answer("placement", &text, report::body(placement)) {
        Exit::Success if placement.best.is_none() && placement.now.room.is_err() => Exit::JobHasErrors,
        exit => exit,
    }
}

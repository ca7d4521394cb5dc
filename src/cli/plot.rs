//! `vcutc plot JOB`: pictures of a job, one of them or all.

use super::args::{PlotArgs, What};
use super::console::{Console, Failure};
use super::failures::{unreadable, without_machine, without_masses};
use super::files::{Disk, stem};
use super::output::{Destination, Output, Placed, one_file};
use super::patience;
use super::progress::Progress;
use super::{Exit, Targets};
use clap::ValueEnum;
use std::path::Path;
use vcutc_backend_api::bundle::Sink;
use vcutc_driver::RequestError;
use vcutc_driver::memory::Memory;
use vcutc_driver::summary::is_of_regions;
use vcutc_picture::Prefix;
use vcutc_report::{Material, pictures};

/// Where pictures go.
enum To<'a> {
    /// One to standard output.
    Stdout(What),
    /// One into a file.
    File(What, &'a Path),
    /// All into a folder.
    Folder(&'a Path),
}

/// Draws one picture of a job, or all.
pub(super) fn plot(args: &PlotArgs, targets: &Targets, console: &Console) -> Exit {
    let to = match To::of(args) {
        Ok(to) => to,
        Err(failure) => return console.failure(&failure),
    };
    let disk = Disk::around(&args.job);
    let mut progress = Progress::start(console.shows_progress());
    let request = args.overrides.request(&disk, targets);
    let budget = console.help_budget();
    let compiled = patience::compile(request, &mut Memory::none(), budget, &mut progress);
    progress.finish();
    let outcome = match compiled {
        Ok(outcome) => outcome,
        Err(RequestError::Unreadable(reason)) => return console.failure(&unreadable(&args.job, &reason)),
    };
    console.diagnostics(&outcome.diagnostics, &outcome.sources);
    let Some(material) = Material::of(&outcome) else {
        console.made(disk.job(), &outcome.diagnostics, &[], Some("nothing was drawn"));
        return Exit::JobHasErrors;
    };
    let placed = match to {
        To::Stdout(what) => {
            return match picture(what, &material) {
                Some(svg) => console.document(&svg),
                None => console.failure(&without(what, &material)),
            };
        }
        To::File(what, path) => match picture(what, &material) {
            Some(svg) => disk.spares(path).and_then(|()| one_file(path, svg.as_bytes())),
            None => return console.failure(&without(what, &material)),
        },
        To::Folder(folder) => all(folder, &material, &disk),
    };
    match placed {
        Ok(placed) => {
            console.made(disk.job(), &outcome.diagnostics, &placed, None);
            Exit::Success
        }
        Err(reason) => console.failure(&Failure::new(reason)),
    }
}

/// Draws every picture that the job has into a folder: `rib_contour.svg` and so on, all or none.
fn all(folder: &Path, material: &Material<'_>, disk: &Disk) -> Result<Vec<Placed>, String> {
    let mut output = Output::to(&Destination::Folder(folder.to_owned()));
    for what in What::value_variants() {
        let (Some(svg), Some(word)) = (picture(*what, material), what.to_possible_value()) else {
            continue;
        };
        let name = format!("{}_{}.svg", stem(disk.job()), word.get_name());
        disk.spares(&folder.join(&name))?;
        let taken = output.file(&name).and_then(|()| output.write(svg.as_bytes()));
        taken.map_err(|error| error.to_string())?;
    }
    output.publish()
}

impl<'a> To<'a> {
    fn of(args: &'a PlotArgs) -> Result<Self, Failure> {
        match (args.what, args.output.as_deref()) {
            (Some(what), None | Some("-")) => Ok(Self::Stdout(what)),
            (Some(what), Some(path)) if path.to_ascii_lowercase().ends_with(".svg") => {
                Ok(Self::File(what, Path::new(path)))
            }
            (Some(_), Some(path)) => Err(Failure::new(format!(
                "pictures are in SVG: give `-o` the name of a file that ends in .svg, not {path}"
            ))),
            (None, None) => Ok(Self::Folder(Path::new("."))),
            (None, Some("-")) => Err(Failure::new("standard output takes one picture")
                .help("choose one, such as `--what contour`, or give a folder with `-o`")),
            (None, Some(path)) if path.to_ascii_lowercase().ends_with(".svg") => {
                Err(Failure::new(format!("{path} takes one picture"))
                    .help("choose one, such as `--what contour`, or give a folder with `-o`"))
            }
            (None, Some(folder)) => Ok(Self::Folder(Path::new(folder))),
        }
    }
}

/// Why there is no such picture.
fn without(what: What, material: &Material<'_>) -> Failure {
    match what {
        What::Surface | What::Residual if material.job.part.surface().is_some() => {
            Failure::new("too many triangles of the surface lie over each other to draw it")
        }
        What::Finished | What::Tilt | What::Tracks => without_finishing(what, material),
        What::Curvature | What::Class if material.job.part.surface().is_some() => {
            Failure::new("the part has edges everywhere, and no place with a curvature")
        }
        What::Surface | What::Curvature | What::Class | What::Residual => Failure::new(
            "the part is a profile, the same at every y, so there is nothing to show from above",
        )
        .help("draw `--what contour` or `--what deviation`, or write `surface { ... }` instead of `profile`"),
        What::Process => Failure::new("the job leaves no choice between two processes that both compile")
            .help("write `rough auto { ... }` with blocks `vcut` and `rect`"),
        What::Field => Failure::new("no pocket of the job is cleared along a sound field")
            .help("write `pattern = field` in `clear pocket`"),
        What::Passes => Failure::new("the job works in no region of the plan")
            .help("write `region NAME { ... }`, and `clear pocket`, `free pocket` or `slit walls` with `region = NAME`"),
        What::Torques => match &material.job.machine {
            Some(_) => without_masses(),
            None => without_machine(),
        },
        What::DeviationByForces if is_of_regions(material.plan) => Failure::new(
            "the picture shows flanks along the profile, and the job works in regions of the plan",
        )
        .help("`vcutc check -v` states how far walls are off"),
        What::DeviationByForces => Failure::new(
            "how far the forces of the blade push the cuts off is not known, or the job has no profile",
        )
        .help(
            "state `forces { ... }` in the blade, and take an arm whose stiffness is known (docs/reach.md)",
        ),
        What::Lattice | What::Contour | What::Deviation | What::Correlation | What::Joints | What::Time => {
            without_machine()
        }
    }
}

/// Why there is no picture of finishing: what the job lacks for it.
fn without_finishing(what: What, material: &Material<'_>) -> Failure {
    let finish = "write `finish disc { ... }` after the roughing";
    let surface = "write `surface { ... }` instead of `profile`";
    let has_surface = material.job.part.surface().is_some();
    if is_of_regions(material.plan) {
        return Failure::new("the job works in regions of the plan, and no operation finishes with a disc")
            .help("draw `--what passes`");
    }
    match (pictures::has_tracks(material), has_surface) {
        (false, false) if what != What::Tracks => {
            Failure::new("the part is a profile, and no operation finishes it with a disc")
                .help(format!("{surface}, and {finish}"))
        }
        (false, _) => Failure::new("no operation finishes the part with a disc").help(finish),
        (true, false) if what == What::Tilt => Failure::new(
            "the part is a profile, from whose normal the disc leans by the same angle on all tracks",
        )
        .help(format!("draw `--what tracks`, or {surface}")),
        (true, false) => Failure::new(
            "the part is a profile, the same at every y, so there is no map of what finishing leaves",
        )
        .help(format!("draw `--what contour`, or {surface}")),
        (true, true) => Failure::new("the tracks have too many poses to draw them"),
    }
}

/// The picture; none where it is about the machine and the job has none, about a choice that it does not leave, or about a
/// surface or finishing, and there is none.
fn picture(what: What, material: &Material<'_>) -> Option<String> {
    let ids = Prefix::NONE;
    match what {
        What::Lattice => Some(pictures::lattice(material, ids)),
        What::Contour => Some(pictures::contour(material, ids)),
        What::Deviation => Some(pictures::deviation(material, ids)),
        What::Correlation => Some(pictures::correlation(material, ids)),
        What::Joints => pictures::joints(material, ids),
        What::Torques => {
            let [picture] = pictures::torques(material, [ids])?.pictures;
            Some(picture)
        }
        What::DeviationByForces => {
            let [picture] = pictures::by_forces(material, [ids])?;
            Some(picture)
        }
        What::Time => Some(pictures::time(material, ids)),
        What::Process => pictures::process(material, ids),
        What::Surface => pictures::surface(material, ids),
        What::Curvature => pictures::curvature(material, ids),
        What::Class => pictures::class(material, ids),
        What::Residual => pictures::residual(material, ids).or_else(|| pictures::ground(material, ids)),
        What::Finished => pictures::finished(material, ids),
        What::Tilt => pictures::tilt(material, ids),
        What::Tracks => pictures::tracks(material, ids),
        What::Passes => pictures::passes(material, ids),
        What::Field => pictures::wave(material, ids),
    }
}

//! `vcutc optimize JOB`: what the job comes to, what binds it, and what time other limits cost.

use super::args::OptimizeArgs;
use super::console::{Console, Failure};
use super::files::Disk;
use super::output::{Destination, Output, Placed};
use super::progress::Progress;
use super::{Exit, Targets};
use std::path::{Path, PathBuf};
use vcutc_backend_api::bundle::Sink;
use vcutc_optimize::{Optimisation, Refusal, Wanted, json, report};

/// Optimises one job.
pub(super) fn optimize(args: &OptimizeArgs, targets: &Targets, console: &Console) -> Exit {
    let picture = match args.output.as_deref().map(Picture::named).transpose() {
        Ok(picture) => picture,
        Err(failure) => return console.failure(&failure),
    };
    let disk = Disk::around(&args.job);
    let mut progress = Progress::start(console.shows_progress());
    let request = args.overrides.request(&disk, targets);
    let wanted = Wanted {
        against: args.against.into(),
        points: args.points,
    };
    let optimised = vcutc_optimize::optimise(request, wanted, &mut |stage| progress.enter(stage));
    progress.finish();
    match optimised {
        Ok(optimisation) => tell(&optimisation, picture.as_ref(), console),
        Err(Refusal::Unreadable(reason)) => console.failure(&Failure::new(format!(
            "cannot read the job {}: {reason}",
            args.job
        ))),
        Err(Refusal::Diagnostics(diagnostics, sources)) => {
            console.diagnostics(&diagnostics, &sources);
            Exit::JobHasErrors
        }
    }
}

fn tell(optimisation: &Optimisation, picture: Option<&Picture>, console: &Console) -> Exit {
    console.diagnostics(&optimisation.warnings, &optimisation.sources);
    let written = match picture.map(|picture| picture.write(optimisation)).transpose() {
        Ok(files) => files.unwrap_or_default(),
        Err(reason) => return console.failure(&Failure::new(reason)),
    };
    let mut text = report::text(optimisation);
    if !written.is_empty() {
        text.push('\n');
    }
    for file in &written {
        text += &format!("wrote {}\n", file.path());
    }
    if picture.is_some() && written.is_empty() {
        text += "\nno picture: no operation has a trade-off to draw\n";
    }
    console.answer("optimisation", &text, json::body(optimisation))
}

/// Where Pareto pictures go.
struct Picture {
    folder: PathBuf,
    /// The file's name without its ending.
    stem: String,
}

impl Picture {
    /// By the path that `-o` gives.
    fn named(path: &str) -> Result<Self, Failure> {
        let file = Path::new(path);
        let is_picture = file
            .extension()
            .is_some_and(|ending| ending.eq_ignore_ascii_case("svg"));
        let stem = file.file_stem().and_then(|stem| stem.to_str());
        let (true, Some(stem)) = (is_picture, stem) else {
            return Err(Failure::new(format!(
                "the trade-off is drawn in SVG: give `-o` the name of a file that ends in .svg, not {path}"
            )));
        };
        let folder = match file.parent() {
            Some(parent) if parent != Path::new("") => parent.to_owned(),
            Some(_) | None => PathBuf::from("."),
        };
        Ok(Self {
            folder,
            stem: stem.to_owned(),
        })
    }

    /// Writes the picture of each operation, all or none; those of several have their numbers after the name.
    fn write(&self, optimisation: &Optimisation) -> Result<Vec<Placed>, String> {
        let mut output = Output::to(&Destination::Folder(self.folder.clone()));
        let pictures = optimisation.pictures();
        let alone = pictures.len() == 1;
        for (number, svg) in pictures {
            let stem = &self.stem;
            let name = if alone {
                format!("{stem}.svg")
            } else {
                format!("{stem}_{number}.svg")
            };
            output.file(&name).map_err(|error| error.to_string())?;
            output.write(svg.as_bytes()).map_err(|error| error.to_string())?;
        }
        output.publish()
    }
}

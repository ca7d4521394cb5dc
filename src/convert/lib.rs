//! `vcutc convert`: a milling program of three axes as a job of V-cuts [Cui III].
//!
//! The paper's post processor turns every reciprocating pass of a milling program into a left tilt, a cut, a right tilt and a
//! cut back. Here the passes become the tips of a job (`tips` in `docs/language.md`), in their order, and everything else is
//! the compiler's: the same intermediate program, the same proofs, the same targets. So there are two steps and no third way
//! to a program: text of a program to text of a job, and that job as any other.
//!
//! 1. [`read`](self) follows the statements of the program to its motions ([`milling`]), by the syntax of the KRL crate; `motions`
//!    says where they lead, `frames` in which tool and base.
//! 2. `runs` puts together what leads along one axis, [`place`] finds out along which one and where the blank lies, [`raster`]
//!    which runs are passes, [`plunges`] what goes into the blank without one; `left_out` says what is not a
//!    pass, `offers` tries the options that would settle what is open.
//! 3. `feeds` and `part` take speeds, the part and the least edge from the passes where the user gives none.
//! 4. [`mod@write`] writes the job, and knows for every tip the line of the program that it stands for.
//!
//! What is not said by the user is taken from the program only where that leaves one possibility, and reported
//! ([`Inference`]).

pub mod asked;
mod attitude;
pub mod axes;
mod complaints;
mod feeds;
mod left_out;
pub mod milling;
mod offers;
mod part;
pub mod place;
pub mod plunges;
pub mod raster;
mod read;
mod runs;
pub mod types;
pub mod write;

use asked::Asked;
use axes::Axes;
use core::fmt;
use milling::Milling;
use offers::{Choice, Offer, Unsettled};
use raster::Raster;
use read::Files;
use serde::Serialize;
use types::{Blank, Pass, SAME};
use vcutc_backend_api::readback::ProgramFile;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::{FileId, SourceMap, Span};
use vcutc_diagnostics::{Diagnostic, Label};
use vcutc_geometry::grid;
use vcutc_vcut::plan::blade_reach::Flanks;
use write::{Blade, JobText, Material, Part, ProfileFile};

/// Half the apex angle of the blade of [Cui 2020], table 1, for a blade that is not described.
pub(crate) const HALF_APEX: Angle = Angle::deg(7.13);

/// What to convert.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// All files of one program; at least one.
    pub files: &'a [ProgramFile],
    /// What the user says.
    pub asked: &'a Asked,
    /// The job's name.
    pub name: &'a str,
    /// The file of the shop that the job uses, seen from the job.
    pub cell: Option<&'a str>,
    /// The machine of that file.
    pub machine: Option<&'a str>,
    /// The blade of that file.
    pub blade: Option<&'a str>,
    /// A file with the part's profile.
    pub profile: Option<&'a ProfileFile>,
}

/// A program as a job.
#[derive(Debug)]
pub struct Conversion {
    pub job: JobText,
    /// The passes.
    pub raster: Raster,
    /// What was taken from the program, a line each.
    pub inferences: Vec<Inference>,
    /// What is not carried over.
    pub warnings: Vec<Diagnostic>,
    /// The texts of the program, which places point into.
    pub sources: SourceMap,
    /// The files of the program among them.
    pub files: Vec<FileId>,
}

/// Why there is no job.
#[derive(Debug)]
pub struct Refused {
    /// Why.
    pub diagnostics: Vec<Diagnostic>,
    /// The texts of the program.
    pub sources: SourceMap,
}

/// Something that was taken from the program because the user did not say it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Inference {
    /// What it is about, in a word.
    pub subject: &'static str,
    /// What was taken.
    pub what: String,
    pub why: String,
}

impl Inference {
    fn new(subject: &'static str, what: String, why: impl Into<String>) -> Self {
        Self {
            subject,
            what,
            why: why.into(),
        }
    }
}

impl fmt::Display for Inference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "  {:<10} {} ({})", self.subject, self.what, self.why)
    }
}

/// Makes messages about the job of a conversion point at the lines of the program that its tips stand for. The texts of the
/// program join those of the job.
pub fn point_back(
    conversion: &Conversion,
    job: &str,
    sources: &mut SourceMap,
    diagnostics: &mut [Diagnostic],
) {
    let Some((job, _)) = sources.iter().find(|(_, file)| file.name == job) else {
        return;
    };
    let mut moved: Vec<(FileId, FileId)> = Vec::new();
    for &file in &conversion.files {
        if let Some(text) = conversion.sources.get(file) {
            moved.push((file, sources.add(text.name.clone(), text.text.clone())));
        }
    }
    for diagnostic in diagnostics {
        let primary = diagnostic.primary.span;
        let origins = &conversion.job.origins;
        let tip = origins.partition_point(|origin| origin.at.end <= primary.start as usize);
        let Some(origin) = origins
            .get(tip)
            .filter(|origin| primary.file == job && origin.at.contains(&(primary.start as usize)))
        else {
            continue;
        };
        if let Some(&(_, file)) = moved.iter().find(|(known, _)| *known == origin.said.file) {
            let span = Span { file, ..origin.said };
            diagnostic.secondary.push(Label {
                span,
                text: "the pass that it comes from".to_owned(),
            });
        }
    }
}

/// Converts a program.
///
/// # Errors
/// What keeps it from being a raster of passes, and what the user has to say in its place.
pub fn convert(request: Request<'_>) -> Result<Conversion, Refused> {
    let mut sources = SourceMap::default();
    let stripped: Vec<ProgramFile> = request
        .files
        .iter()
        .map(|file| ProgramFile {
            name: file.name.clone(),
            text: without_marks(&file.text).to_owned(),
        })
        .collect();
    let Some(files) = Files::add(&stripped, &mut sources) else {
        let diagnostics = Vec::new();
        return Err(Refused { diagnostics, sources });
    };
    match understood(request, &files, &sources) {
        Ok(found) => Ok(Conversion {
            warnings: found.warnings,
            job: found.job,
            raster: found.raster,
            inferences: found.inferences,
            files: files.ids,
            sources,
        }),
        Err(diagnostics) => Err(Refused { diagnostics, sources }),
    }
}

/// A text without the mark of UTF-8 at its head, and without the marks of DOS (Ctrl-Z) at its end: they are
/// not statements.
fn without_marks(text: &str) -> &str {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let trimmed = text.trim_end_matches(|c: char| c == END_OF_FILE || c.is_whitespace());
    let after = text.get(trimmed.len()..).unwrap_or_default();
    if after.contains(END_OF_FILE) {
        trimmed
    } else {
        text
    }
}

/// Ctrl-Z, with which DOS ends texts.
const END_OF_FILE: char = '\u{1a}';

/// What a program came to.
struct Found {
    job: JobText,
    raster: Raster,
    inferences: Vec<Inference>,
    warnings: Vec<Diagnostic>,
}

fn understood(
    request: Request<'_>,
    files: &Files<'_>,
    sources: &SourceMap,
) -> Result<Found, Vec<Diagnostic>> {
    let one = |diagnostic: Box<Diagnostic>| vec![*diagnostic];
    let asked = request.asked;
    let milling = read::read(files)?;
    let Settled {
        blank,
        raster,
        mut inferences,
        clearance,
    } = settled(&milling, asked).map_err(|unsettled| unsettled.tried(&milling, asked))?;
    inferences.push(in_passes(&milling, &raster));
    inferences.extend(noise(&raster, asked));
    inferences.extend(standing(&milling));
    let feeds = feeds::feeds(&milling, &raster, asked, &mut inferences).map_err(one)?;
    let clearance = clearance.said(&mut inferences);
    let blade = blade(request, &raster, blank, &mut inferences);
    let part = part(request, &raster, blank, &blade, &mut inferences);
    let job = write::job(&Material {
        name: request.name,
        cell: request.cell,
        machine: request.machine,
        milling: &milling,
        raster: &raster,
        blank,
        part,
        blade,
        angles: [asked.rake, asked.swing],
        extension: asked.extension,
        clearance,
        feeds,
        sources,
    });
    Ok(Found {
        job,
        inferences,
        warnings: left_out::warnings(&milling, &raster, sources),
        raster,
    })
}

/// A program as passes over a blank, below a safe plane.
struct Settled {
    blank: Blank,
    raster: Raster,
    inferences: Vec<Inference>,
    clearance: Clearance,
}

fn settled(milling: &Milling, asked: &Asked) -> Result<Settled, Unsettled> {
    let mut inferences = Vec::new();
    let axes = place::axes(milling, asked, &mut inferences)?;
    let blank = place::blank(milling, axes, asked, &mut inferences)?;
    let tolerance = asked.tolerance.to_mm();
    if let Some(refused) = attitude::leaning(milling, axes, blank, tolerance) {
        return Err(Unsettled::from(Box::new(refused)).offering(place::other_ways_up(asked)));
    }
    let raster =
        raster::recognise(milling, axes, blank, (tolerance, asked.swing)).map_err(|diagnostics| {
            Unsettled {
                diagnostics,
                offers: Vec::new(),
            }
        })?;
    check(milling, &raster, (axes, blank), asked)?;
    let clearance = match asked.clearance {
        Some(said) => Clearance::Said(said),
        None => safe_plane(milling, &raster, (axes, blank), asked)?,
    };
    Ok(Settled {
        blank,
        raster,
        inferences,
        clearance,
    })
}

/// There are passes, and all of them run through the blank.
fn check(
    milling: &Milling,
    raster: &Raster,
    (axes, blank): (Axes, Blank),
    asked: &Asked,
) -> Result<(), Unsettled> {
    let Some(lowest) = raster
        .passes
        .iter()
        .reduce(|one, other| if other.z < one.z { other } else { one })
    else {
        return Err(complaints::no_passes(milling, None, blank.corner[2] + blank.height).into());
    };
    if lowest.z < 0.0 {
        let lower = place::lower(axes, blank, -lowest.z, asked);
        return Err(Unsettled::from(complaints::below_the_blank(lowest)).offering(lower));
    }
    let ends_within = |pass: &&Pass| pass.y[0] > SAME || pass.y[1] < blank.depth - SAME;
    match raster.passes.iter().find(ends_within) {
        Some(pass) => Err(complaints::too_short_pass(pass, blank.depth).into()),
        None => Ok(()),
    }
}

fn in_passes(milling: &Milling, raster: &Raster) -> Inference {
    let count = raster.passes.len();
    let what = format!(
        "{count} V-cuts, two passes each, from {} motions",
        milling.moves.len()
    );
    let mut others = vec![format!(
        "{} motions beside or above the blank are planned again",
        raster.other_moves
    )];
    if raster.arcs > 0 {
        others.push(format!("{} of them are arcs in the air", raster.arcs));
    }
    if milling.axis_moves > 0 {
        others.push(format!("axis moves to `home`: {}", milling.axis_moves));
    }
    if raster.repeated > 0 {
        others.push(format!(
            "{} passes repeat the one before and are one with it",
            raster.repeated
        ));
    }
    let joint = raster
        .passes
        .iter()
        .filter(|pass| pass.way == milling::Way::Joint)
        .count();
    if joint > 0 {
        others.push(format!("{joint} passes by `PTP` are taken as straight"));
    }
    Inference::new("passes", what, others.join("; "))
}

/// How far points of passes lie from them, where they do: the noise of a post that rounds.
fn noise(raster: &Raster, asked: &Asked) -> Option<Inference> {
    (raster.stray > grid::SPACING / 10.0).then(|| {
        Inference::new(
            "tolerance",
            format!(
                "{} pieces of passes are put together, and stray by up to {} mm from their lines",
                raster.pieces,
                show(raster.stray)
            ),
            format!(
                "points of a pass lie within {} mm of one another; its tip lies in the middle",
                show(asked.tolerance.to_mm())
            ),
        )
    })
}

/// External axes, which no job moves.
fn standing(milling: &Milling) -> Option<Inference> {
    let stands = |(name, value): &(&str, f64)| format!("{name} at {}", show(*value));
    let stands: Vec<String> = milling.external.iter().map(stands).collect();
    (!stands.is_empty()).then(|| {
        Inference::new(
            "external",
            format!("external axes do not move: {}", stands.join(", ")),
            "all along the program; the job does not move them",
        )
    })
}

/// How high the safe plane lies above the blank, and what says so.
#[derive(Clone, Copy)]
enum Clearance {
    Said(Length),
    /// As high as the program goes.
    OfTheProgram(Length),
}

impl Clearance {
    fn said(self, inferences: &mut Vec<Inference>) -> Length {
        match self {
            Self::Said(height) => height,
            Self::OfTheProgram(height) => {
                inferences.push(Inference::new(
                    "clearance",
                    format!("{} mm", show(height.to_mm())),
                    "the highest place of the file, above the blank",
                ));
                height
            }
        }
    }
}

/// Above the blank where only the safe plane is missing.
const SAFE: Length = Length::mm(10.0);

/// The safe plane: as high above the blank as the program goes. Where it never goes above the blank, that may lie lower.
fn safe_plane(
    milling: &Milling,
    raster: &Raster,
    (axes, blank): (Axes, Blank),
    asked: &Asked,
) -> Result<Clearance, Unsettled> {
    let above = raster
        .highest
        .map_or(0.0, |highest| grid::up(highest - blank.height));
    if above > SAME {
        return Ok(Clearance::OfTheProgram(Length::mm(above)));
    }
    let (when, others) = match asked.origin {
        Some(_) => ("to give its height above the blank", Vec::new()),
        None => (
            "if the blank lies there all the same, and the program goes around it",
            place::other_heights(milling, axes, blank, asked),
        ),
    };
    let anyway = Offer {
        when: when.to_owned(),
        option: Choice::Clearance(SAFE),
    };
    let top = blank.corner[2] + blank.height;
    Err(Unsettled::from(complaints::no_clearance(milling, axes, top))
        .offering(others)
        .offering([anyway]))
}

/// The blade: one of the shop's, or its description, with the shortest edge that frees all chips.
fn blade(request: Request<'_>, raster: &Raster, blank: Blank, inferences: &mut Vec<Inference>) -> Blade {
    if let Some(name) = request.blade {
        return Blade::Named(name.to_owned());
    }
    let asked = request.asked;
    let mut assume = |what: String, why: &str| inferences.push(Inference::new("blade", what, why));
    let half_apex = asked.half_apex.unwrap_or_else(|| {
        assume(
            format!("half_apex = {} deg", show(HALF_APEX.to_deg())),
            "assumed, as that of [Cui 2020]",
        );
        HALF_APEX
    });
    let thickness = asked.thickness.unwrap_or_else(|| {
        assume("thickness = 0 mm".to_owned(), "assumed");
        Length::ZERO
    });
    let cutting_length = asked.edge.unwrap_or_else(|| {
        let flanks = Flanks::new(Length::mm(1.0), half_apex, asked.rake, asked.swing);
        let edge = part::least_edge(&raster.passes, &flanks, [blank.width, blank.height]);
        assume(
            format!("cutting_length = {} mm", show(edge.to_mm())),
            "the least that frees every chip",
        );
        edge
    });
    Blade::Own {
        cutting_length,
        half_apex,
        thickness,
    }
}

/// The part: in a file, or below the lowest passes.
fn part(
    request: Request<'_>,
    raster: &Raster,
    blank: Blank,
    blade: &Blade,
    inferences: &mut Vec<Inference>,
) -> Part {
    if let Some(file) = request.profile {
        return Part::File(file.clone());
    }
    let asked = request.asked;
    let thickness = match blade {
        Blade::Named(_) => asked.thickness.unwrap_or(Length::ZERO),
        Blade::Own { thickness, .. } => *thickness,
    };
    let drop = thickness / (2.0 * asked.swing.sin());
    let points = part::profile(&raster.passes, 1.0 / asked.swing.tan(), drop, blank.width);
    let lowest = points.iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
    inferences.push(Inference::new(
        "profile",
        format!(
            "a polyline of {} points, lowest at z {} mm",
            points.len(),
            show(lowest)
        ),
        "the envelope of all passes",
    ));
    Part::Polyline(points)
}

//! The job that stands for a milling program, as text.

use super::feeds::Feeds;
use super::milling::Milling;
use super::raster::Raster;
use super::types::{Blank, Pass};
use core::ops::Range;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::{FileId, SourceMap, Span};
use vcutc_geometry::curve::Point2;
use vcutc_syntax::ast::{Entry, Item, Point};
use vcutc_syntax::format::format;
use vcutc_syntax::parse;

/// A job's text.
#[derive(Clone, Debug, PartialEq)]
pub struct JobText {
    pub text: String,
    /// Where its tips stand in it, each with the pass that it comes from.
    pub origins: Vec<Origin>,
}

/// A tip of the job's text, and the motions of the program that it stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// Bytes of the job's text.
    pub at: Range<usize>,
    /// The first motion of the pass.
    pub said: Span,
}

/// The blade of the job.
#[derive(Clone, Debug, PartialEq)]
pub enum Blade {
    /// One that a file of the shop defines.
    Named(String),
    /// One of the job's own.
    Own {
        /// Usable edge.
        cutting_length: Length,
        half_apex: Angle,
        thickness: Length,
    },
}

/// A file with a profile, as a job names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProfileFile {
    pub form: ProfileForm,
    /// Where it lies, seen from the job.
    pub path: String,
    /// The fields after its name, without the braces.
    pub fields: String,
}

/// Kinds of files that the language takes profiles from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProfileForm {
    /// Points, x and z.
    Points,
    /// An airfoil, in the layout of Selig or Lednicer.
    Airfoil,
    /// A drawing in DXF.
    Dxf,
    /// A drawing in SVG.
    Svg,
}

impl ProfileForm {
    /// By the ending of a file's name: what has another one than the rest is a file of points.
    #[must_use]
    pub fn of_ending(ending: &str) -> Self {
        let forms = [("dat", Self::Airfoil), ("dxf", Self::Dxf), ("svg", Self::Svg)];
        let found = forms
            .into_iter()
            .find_map(|(known, form)| ending.eq_ignore_ascii_case(known).then_some(form));
        found.unwrap_or(Self::Points)
    }

    /// The word of the language.
    const fn word(self) -> &'static str {
        match self {
            Self::Points => "points",
            Self::Airfoil => "airfoil",
            Self::Dxf => "dxf",
            Self::Svg => "svg",
        }
    }
}

/// The part of the job.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// Its profile is in a file.
    File(ProfileFile),
    Polyline(Vec<Point2>),
}

/// What a job is written from.
pub(super) struct Material<'a> {
    pub(super) name: &'a str,
    pub(super) cell: Option<&'a str>,
    pub(super) machine: Option<&'a str>,
    pub(super) milling: &'a Milling,
    pub(super) raster: &'a Raster,
    pub(super) blank: Blank,
    pub(super) part: Part,
    pub(super) blade: Blade,
    pub(super) angles: [Angle; 2],
    pub(super) extension: Length,
    pub(super) clearance: Length,
    pub(super) feeds: Feeds,
    pub(super) sources: &'a SourceMap,
}

/// The text of the job, in the layout of all job files.
pub(super) fn job(material: &Material<'_>) -> JobText {
    let mut writer = Writer {
        sources: material.sources,
        lines: Numbered::of(material.sources),
        text: String::new(),
    };
    writer.head(material);
    writer.scene(material);
    writer.operation(material);
    let mut scratch = SourceMap::default();
    let file = scratch.add(String::new(), String::new());
    // What cannot be laid out is as it was written, and its mistakes are reported when it is compiled.
    let text = format(file, &writer.text).unwrap_or(writer.text);
    let origins = origins(file, &text, &material.raster.passes);
    JobText { text, origins }
}

/// Where the tips of a job stand, which are those of the passes, in their order.
fn origins(file: FileId, text: &str, passes: &[Pass]) -> Vec<Origin> {
    let ast = parse(file, text, &mut Vec::new());
    let blocks = ast.items.iter().filter_map(|item| match item {
        Item::Block(block) => Some(block),
        Item::Job { .. } | Item::Use { .. } | Item::Let { .. } => None,
    });
    let rows = blocks
        .flat_map(|block| &block.entries)
        .filter_map(|entry| match entry {
            Entry::Row { points, .. } => Some(points),
            Entry::Field { .. }
            | Entry::Limit { .. }
            | Entry::Formula { .. }
            | Entry::Curve { .. }
            | Entry::ControlRow { .. }
            | Entry::SurfaceFile { .. }
            | Entry::Station { .. }
            | Entry::Block(_) => None,
        });
    let origin = |(point, pass): (&Point, &Pass)| Origin {
        at: point.span.bytes(),
        said: pass.places[0],
    };
    rows.flatten().zip(passes).map(origin).collect()
}

/// A value in degrees, to a millionth: what was typed in degrees comes out as that.
fn deg(angle: Angle) -> String {
    let text = format!("{:.6}", angle.to_deg());
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn mm(value: f64) -> String {
    format!("{} mm", show(value))
}

fn point(point: Point2) -> String {
    format!("({}, {})", mm(point.x), mm(point.z))
}

/// A text in quotes of the language.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

struct Writer<'a> {
    sources: &'a SourceMap,
    lines: Numbered,
    text: String,
}

impl Writer<'_> {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// `NAME.src:12`.
    fn named(&self, place: Span) -> String {
        // Names of files may hold anything, line ends too, which would end the comment.
        let name = self.sources.name(place.file).replace(char::is_control, " ");
        format!("{name}:{}", self.lines.line(place))
    }

    fn head(&mut self, material: &Material<'_>) {
        self.line(&format!(
            "// {} passes of a milling program as V-cuts, in its order.",
            material.raster.passes.len()
        ));
        let left_out = &material.milling.left_out;
        if !left_out.is_empty() {
            self.line("// Statements of it that have no place in a job:");
        }
        for &place in left_out.iter().take(MOST_LISTED) {
            let said = self.sources.slice(place).replace(['\r', '\n'], " ");
            self.line(&format!("//   {}: {said}", self.named(place)));
        }
        if let Some(more) = left_out.len().checked_sub(MOST_LISTED).filter(|&more| more > 0) {
            self.line(&format!("//   and {more} more"));
        }
        self.line("");
        if let Some(cell) = material.cell {
            self.line(&format!("use {}\n", quoted(cell)));
        }
        self.line(&format!("job {}\n", quoted(material.name)));
        if let Some(machine) = material.machine {
            self.line(&format!("cell {{ machine = {machine} }}\n"));
        }
    }

    fn scene(&mut self, material: &Material<'_>) {
        let blank = material.blank;
        let sizes = [blank.width, blank.depth, blank.height].map(mm);
        self.line(&format!("stock {{ size = ({}) }}\n", sizes.join(", ")));
        self.line("profile {");
        match &material.part {
            Part::File(file) => self.profile_file(file),
            Part::Polyline(points) => self.polyline(points),
        }
        self.line("}\n");
        if let Blade::Own {
            cutting_length,
            half_apex,
            thickness,
        } = &material.blade
        {
            self.line(&format!("blade {OWN} {{"));
            self.line(&format!("  cutting_length = {}", mm(cutting_length.to_mm())));
            self.line(&format!("  half_apex      = {} deg", deg(*half_apex)));
            self.line(&format!("  thickness      = {}", mm(thickness.to_mm())));
            self.line("  edges          = double\n}\n");
        }
    }

    fn profile_file(&mut self, file: &ProfileFile) {
        let fields = match file.fields.trim() {
            "" => String::new(),
            fields => format!(" {{ {fields} }}"),
        };
        self.line(&format!("  {} {}{fields}", file.form.word(), quoted(&file.path)));
    }

    fn polyline(&mut self, points: &[Point2]) {
        let [first, inner @ .., last] = points else { return };
        self.line(&format!("  start {}", point(*first)));
        if inner.is_empty() {
            self.line(&format!("  line to {}", point(*last)));
            return;
        }
        self.line("  polyline");
        for corner in inner {
            self.line(&format!("    {}", point(*corner)));
        }
        self.line(&format!("    to {}", point(*last)));
    }

    fn operation(&mut self, material: &Material<'_>) {
        let blade = match &material.blade {
            Blade::Named(name) => name,
            Blade::Own { .. } => OWN,
        };
        let [rake, swing] = material.angles.map(deg);
        let feeds = &material.feeds;
        self.line("rough vcut {");
        self.line(&format!("  blade     = {blade}"));
        self.line(&format!("  rake      = {rake} deg"));
        self.line(&format!("  swing     = {swing} deg"));
        self.line(&format!("  extension = {}", mm(material.extension.to_mm())));
        self.line("  order     = point");
        self.line(&format!("  clearance = {}", mm(material.clearance.to_mm())));
        self.line(&format!(
            "  feed {{ cut = {} mm/s, travel = {} mm/s, reorient = {} deg/s }}",
            show(feeds.cut.to_mm_per_s()),
            show(feeds.travel.to_mm_per_s()),
            show(feeds.reorient.to_deg_per_s())
        ));
        self.line("  tips");
        self.tips(material);
        self.line("}");
    }

    fn tips(&mut self, material: &Material<'_>) {
        let mut height = None;
        for pass in &material.raster.passes {
            if height != Some(pass.z) {
                height = Some(pass.z);
                let [first, _] = pass.places;
                self.line(&format!("    // from {}", self.named(first)));
            }
            let tip = Point2 { x: pass.x, z: pass.z };
            self.line(&format!("    {}", point(tip)));
        }
    }
}

/// Most statements that are listed at the head of a job.
const MOST_LISTED: usize = 200;

/// The name of a blade of the job's own.
const OWN: &str = "converted";

/// Where the lines of the texts end, to number places.
pub(super) struct Numbered {
    ends: Vec<(FileId, Vec<u32>)>,
}

impl Numbered {
    pub(super) fn of(sources: &SourceMap) -> Self {
        let ends = |text: &str| {
            let at = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
            at.map(|(at, _)| u32::try_from(at).unwrap_or(u32::MAX)).collect()
        };
        Self {
            ends: sources.iter().map(|(id, file)| (id, ends(&file.text))).collect(),
        }
    }

    /// The line that a place begins on, from 1.
    pub(super) fn line(&self, place: Span) -> usize {
        let file = self.ends.iter().find(|(id, _)| *id == place.file);
        1 + file.map_or(0, |(_, ends)| ends.partition_point(|&end| end < place.start))
    }
}

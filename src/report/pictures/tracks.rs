//! The tracks of a disc from above, as the program states them.

use crate::Material;
use vcutc_backend_api::ir::{Action, OperationId, Program, Site};
use vcutc_backend_api::segments::LinearSegment;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::words::counted;
use vcutc_job::PlannedOperation;
use vcutc_job::planned::CutShape;
use vcutc_picture::Prefix;
use vcutc_picture::tracks::{self, Heading, Tracks};

/// The tracks of all operations that finish the part with a disc (`picture::tracks`); none of a job without one.
#[must_use]
pub fn tracks(material: &Material<'_>, ids: Prefix) -> Option<String> {
    Some(DiscTracks::of(material)?.draw(ids))
}

/// Whether an operation of the job finishes the part with a disc, in tracks.
#[must_use]
pub fn has_tracks(material: &Material<'_>) -> bool {
    material
        .plan
        .operations
        .iter()
        .any(|planned| is_in_tracks(&**planned))
}

fn is_in_tracks(planned: &dyn PlannedOperation) -> bool {
    let tips = planned.tips();
    tips.iter().any(|tip| match tip.shape {
        CutShape::Track { .. } => true,
        CutShape::Plain | CutShape::Narrowed { .. } | CutShape::Slit { .. } | CutShape::Strip(_) => false,
    })
}

/// Tracks that are gathered once and drawn in several places.
#[derive(Clone, Debug)]
pub struct DiscTracks {
    title: String,
    size: [f64; 2],
    ways: Ways,
}

impl DiscTracks {
    /// None of a job that finishes nothing with a disc.
    #[must_use]
    pub fn of(material: &Material<'_>) -> Option<Self> {
        let program = material.compiled.program.verified().program();
        let mut ways = Ways::default();
        let operations = (0..).map(OperationId).zip(&material.plan.operations);
        for (operation, _) in operations.filter(|(_, planned)| is_in_tracks(&***planned)) {
            ways.add(program, operation);
        }
        let stock = material.plan.stock;
        (!ways.tracks.is_empty()).then(|| Self {
            title: format!("{}: tracks of the disc", material.plan.name),
            size: [stock.width, stock.depth].map(Length::to_mm),
            ways,
        })
    }

    /// How many there are, and how long they are, in words.
    #[must_use]
    pub fn figures(&self) -> String {
        let Ways {
            tracks,
            cut,
            through_air,
            ..
        } = &self.ways;
        let [cut, through_air] = [cut, through_air].map(|way| way.to_mm() / 1000.0);
        format!(
            "{}, {cut:.2} m in all; {through_air:.2} m through the air between them",
            counted(tracks.len(), "track")
        )
    }

    /// Writes them as SVG.
    #[must_use]
    pub fn draw(&self, ids: Prefix) -> String {
        tracks::draw(&Tracks {
            heading: Heading {
                ids,
                title: &self.title,
                subtitle: &self.figures(),
            },
            size: self.size,
            tracks: &self.ways.tracks,
            links: &self.ways.links,
        })
    }
}

/// The ways of the middle of the disc's edge, in plan.
#[derive(Clone, Debug, Default)]
struct Ways {
    tracks: Vec<Vec<[f64; 2]>>,
    /// From the end of a track to the beginning of the next one.
    links: Vec<Vec<[f64; 2]>>,
    /// How long all tracks are.
    cut: Length,
    /// How long all links are.
    through_air: Length,
}

impl Ways {
    /// Adds the tracks of an operation.
    fn add(&mut self, program: &Program, operation: OperationId) {
        let mut track = None;
        // A way through the air counts when a track comes after it.
        let (mut link, mut long) = (Vec::new(), Length::ZERO);
        for segment in program.segments() {
            let Some(line) = segment
                .line()
                .filter(|_| segment.op.site.operation() == Some(operation))
            else {
                continue;
            };
            let (Action::Follow { .. }, Site::Cut { layer, cut, .. }) = (segment.op.action, segment.op.site)
            else {
                if track.is_some() {
                    go_on(&mut link, &line);
                    long += line.length();
                }
                continue;
            };
            if track != Some((layer, cut)) {
                track = Some((layer, cut));
                self.tracks.push(Vec::new());
                self.through_air += core::mem::take(&mut long);
                let link = core::mem::take(&mut link);
                self.links.extend((!link.is_empty()).then_some(link));
            }
            if let Some(way) = self.tracks.last_mut() {
                go_on(way, &line);
            }
            self.cut += line.length();
        }
    }
}

/// Adds a line to a way in plan, unless it leads straight up or down.
fn go_on(way: &mut Vec<[f64; 2]>, line: &LinearSegment) {
    for place in [line.from, line.to].map(|pose| [pose.tip.x, pose.tip.y]) {
        if way.last() != Some(&place) {
            way.push(place);
        }
    }
}

//! The proof of tracks on a surface, from the poses of a finished program.
//!
//! Nothing of it comes from the plan but the part and what the operation is held to ([`Tracks`]). What was roughed is that which the
//! replay of the other cuts leaves.

use super::entry::{deepest, solid, turns};
use super::sections::{Sections, Skimmed};
use super::way::{Way, pose_of};
use core::num::NonZeroU32;
use std::collections::BTreeMap;
use std::sync::Arc;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{OperationId, Program, ToolId};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_job::operation::judged::Judged;
use vcutc_process::chains::{ChainPiece, pieces};
use vcutc_simulation::prove::{CutFault, Finding, Findings, Replay, Tracked, Tracks};
use vcutc_simulation::surface::Surface;
use vcutc_surface::disc::Pose;
use vcutc_surface::drop::Dropper;
use vcutc_surface::gouge::Moves;

/// How far a bound may be above its limit by rounding of the numbers of a program.
const ROUNDING: Length = Length::mm(2e-4);

/// A track as a program states it.
struct Stated {
    layer: NonZeroU32,
    cut: NonZeroU32,
    tool: ToolId,
    poses: Vec<Pose>,
    /// How the tool is held in each of them.
    held: Vec<Orientation>,
    /// How far its arcs lie beside their chords, at most.
    bow: Length,
    /// Whether one of its poses has no axis that points up.
    is_upright: bool,
}

/// Judges the tracks of a program, over what its other cuts leave: adds what is wrong, and what they do.
pub(super) fn judge(tracks: Tracks, judged: Judged<'_>, replay: &mut Replay) {
    let (plan, program) = (judged.plan, judged.program);
    let Some(part) = plan.surface.as_ref().map(|part| part.surface()) else {
        return;
    };
    let dropper = Dropper::new(part);
    // Checking a job refuses surfaces that are too tangled, or have no height somewhere.
    let spine = plan.operations.iter().find_map(|planned| planned.bound().spine);
    let spine = spine.map(|spine| (spine, spine.left_above(program.longest_edge(), program.blend)));
    let (Ok(moves), Ok(sections)) = (Moves::new(&dropper), Sections::of(part, spine)) else {
        return;
    };
    let judge = Judge {
        moves: &moves,
        sections: &sections,
        program,
        operation: judged.operation,
        tracks,
        findings: &mut replay.findings,
    };
    replay.tracked.extend(judge.all(&replay.surface));
}

struct Judge<'j, 'd, 's> {
    moves: &'j Moves<'d, 's>,
    sections: &'j Sections,
    program: &'j Program,
    operation: OperationId,
    tracks: Tracks,
    findings: &'j mut Findings,
}

impl Judge<'_, '_, '_> {
    fn all(mut self, before: &Surface) -> Option<Tracked> {
        let stated = stated(self.program, self.operation);
        let first = stated.first()?;
        let mut done = Tracked {
            operation: self.operation,
            tracks: stated.len(),
            poses: 0,
            leads: [Angle::deg(90.0), Angle::deg(-90.0)],
            entry: Length::ZERO,
            sections: self.sections.count(),
            left: Length::ZERO,
            at: [0.0; 3],
            mean: Length::ZERO,
            across: Arc::default(),
        };
        let mut ways = Vec::with_capacity(stated.len());
        for track in &stated {
            done.poses += track.poses.len();
            done.entry = done.entry.max(self.entry(track));
            match Way::new(track.poses.clone()).filter(|_| track.is_upright) {
                Some(way) => {
                    let [least, most] = way.leads().unwrap_or(done.leads);
                    done.leads = [done.leads[0].min(least), done.leads[1].max(most)];
                    ways.push(way);
                }
                None => self.note_turning_back(track),
            }
        }
        let blade = self.program.blade(first.tool)?;
        if ways.len() == stated.len()
            && let Some(disc) = self.tracks.disc(blade)
        {
            let ways: Vec<&Way> = ways.iter().collect();
            let skimmed = self.sections.skim(before, &ways, &disc, self.tracks.skin);
            self.note_skimmed(&skimmed, &stated);
            if let Some(most) = skimmed.most() {
                (done.left, done.at) = (most.height, [most.at.x, most.y, most.at.z]);
            }
            done.mean = skimmed.mean();
            done.across = skimmed.across.into();
        }
        Some(done)
    }

    /// How deep a track enters the part at most; noted where that is more than may be.
    fn entry(&mut self, track: &Stated) -> Length {
        let blade = self.program.blade(track.tool);
        let aside = self.program.blend + track.bow;
        let limits = [self.tracks.gouge * 0.5, aside];
        let found = blade
            .and_then(solid)
            .and_then(|disc| deepest(self.moves, &disc, &track.poses, &turns(&track.held), limits));
        let Some(found) = found else {
            self.note_turning_back(track);
            return Length::ZERO;
        };
        if found.depth > self.tracks.gouge + ROUNDING {
            let centre = found.pose.centre;
            let fault = CutFault::Overcut {
                at: Point2::new(centre.x, centre.z),
                depth: found.depth,
            };
            let finding = self.finding(track, centre, fault);
            let is_deeper = |known: &Finding| match known.fault {
                CutFault::Overcut { depth, .. } => found.depth > depth,
                _ => true,
            };
            if self.findings.overcut.as_ref().is_none_or(is_deeper) {
                self.findings.overcut = Some(finding);
            }
        }
        found.depth
    }

    /// A track that does not lead along y throughout, or holds the disc with its face upwards, frees nothing that is known.
    fn note_turning_back(&mut self, track: &Stated) {
        let centre = track
            .poses
            .first()
            .map_or(Point3::new(0.0, 0.0, 0.0), |pose| pose.centre);
        let needed = Length::mm(f64::INFINITY);
        let fault = CutFault::NotFreed {
            needed,
            available: Length::ZERO,
        };
        let finding = self.finding(track, centre, fault);
        count(&mut self.findings.not_freed, finding);
    }

    fn note_skimmed(&mut self, skimmed: &Skimmed, stated: &[Stated]) {
        for found in &skimmed.faults {
            if let Some(track) = stated.get(found.track) {
                let finding = Finding {
                    y: Some(found.y),
                    ..self.finding(track, found.centre, CutFault::Strip(found.fault))
                };
                count(&mut self.findings.strips, finding);
            }
        }
        // What hangs on stays, too; that has been noted.
        if !skimmed.faults.is_empty() {
            return;
        }
        let limit = self.tracks.scallop;
        let over = skimmed.left.iter().filter(|left| left.height > limit + ROUNDING);
        for left in over {
            let nearest = stated.iter().min_by(|a, b| {
                let aside = |track: &Stated| {
                    track
                        .poses
                        .first()
                        .map_or(f64::INFINITY, |pose| (pose.centre.x - left.at.x).abs())
                };
                aside(a).total_cmp(&aside(b))
            });
            let Some(track) = nearest else { continue };
            let fault = CutFault::Stays {
                at: left.at,
                height: left.height,
                limit,
            };
            let centre = Point3::new(left.at.x, left.y, left.at.z);
            let finding = self.finding(track, centre, fault);
            let is_more = |known: &Finding| match known.fault {
                CutFault::Stays { height, .. } => left.height > height,
                _ => true,
            };
            match &mut self.findings.stays {
                Some((count, known)) => {
                    *count += 1;
                    if is_more(known) {
                        *known = finding;
                    }
                }
                None => self.findings.stays = Some((1, finding)),
            }
        }
    }

    fn finding(&self, track: &Stated, place: Point3, fault: CutFault) -> Finding {
        Finding {
            operation: self.operation,
            layer: track.layer,
            kind: self.program.cut_kind(self.operation, track.tool),
            cut: track.cut,
            tip: Point2::new(place.x, place.z),
            y: Some(place.y),
            fault,
        }
    }
}

/// Counts a finding and keeps the first one.
fn count(kept: &mut Option<(usize, Finding)>, finding: Finding) {
    match kept {
        Some((count, _)) => *count += 1,
        None => *kept = Some((1, finding)),
    }
}

/// The tracks of an operation, in the order of the program.
fn stated(program: &Program, operation: OperationId) -> Vec<Stated> {
    let mut tracks: Vec<Stated> = Vec::new();
    let mut places: BTreeMap<(NonZeroU32, NonZeroU32), usize> = BTreeMap::new();
    for piece in pieces(program, operation) {
        let ChainPiece { layer, cut, tool, .. } = piece;
        let place = *places.entry((layer, cut)).or_insert(tracks.len());
        if place == tracks.len() {
            tracks.push(Stated {
                layer,
                cut,
                tool,
                poses: Vec::new(),
                held: Vec::new(),
                bow: Length::ZERO,
                is_upright: true,
            });
        }
        if let Some(track) = tracks.get_mut(place) {
            track.go_on(&piece);
        }
    }
    tracks
}

impl Stated {
    fn go_on(&mut self, piece: &ChainPiece) {
        let line = &piece.line;
        let ends = [line.from, line.to].into_iter().zip(piece.held);
        let goes_on = self.poses.last().is_some_and(|last| last.centre == line.from.tip);
        for (end, held) in ends.skip(usize::from(goes_on)) {
            match pose_of(end.tip, held) {
                Some(pose) => {
                    self.poses.push(pose);
                    self.held.push(held);
                }
                None => self.is_upright = false,
            }
        }
        if let Some(arc) = line.arc() {
            // Between its ends it is nowhere farther from its chord than across.
            self.bow = self.bow.max(arc.length());
        }
    }
}

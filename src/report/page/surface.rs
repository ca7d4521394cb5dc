//! A part that changes along y from above: how high it is, what roughing and finishing leave above it, and how a disc goes over it.

use super::figure::{Ids, Zoom, figure, slide};
use super::{Section, Subject};
use crate::html::Html;
use crate::pictures::{Curved, DiscTracks, SurfaceMap, SurfaceSections};
use crate::space::{self, Shown};
use vcutc_job::follow::Guide;

/// What roughing is followed by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Then {
    Finishing,
    Nothing,
}

/// The section; none of a part that is a profile.
pub(super) fn section(subject: Subject<'_>) -> Option<Section> {
    let material = &subject.material;
    let part = SurfaceMap::of_part(material)?;
    let residual = SurfaceMap::of_residual(material)?;
    let finished = SurfaceMap::of_finished(material);
    let leaning = SurfaceMap::of_tilt(material);
    let tracks = leaning.as_ref().and_then(|_| DiscTracks::of(material));
    let curved = Curved::of(material);
    let sections = SurfaceSections::of(material);
    let then = if material.compiled.report.tracked.is_empty() {
        Then::Nothing
    } else {
        Then::Finishing
    };
    let mut maps = Vec::new();
    if let Some(Curved { curvature, class }) = &curved {
        maps.extend([Shown::Values(curvature), Shown::Classes(class)]);
    }
    let others = [Some(&residual), finished.as_ref(), leaning.as_ref()];
    maps.extend(others.into_iter().flatten().map(Shown::Values));
    let figures = [
        space::figure(material, &part, &maps),
        Some(heights(&part)),
        curved.as_ref().map(bends),
        Some(left(&residual, material.job.part.guide(), then)),
        finished.as_ref().map(after),
        leaning.as_ref().map(tilt),
        tracks.as_ref().map(ways),
        sections.map(|sections| slider(&sections, material.job.part.guide(), then)),
    ];
    Some(Section {
        id: "surface",
        title: "Surface",
        body: figures
            .into_iter()
            .flatten()
            .reduce(|body, figure| body + figure)?,
    })
}

fn heights(part: &SurfaceMap) -> Html {
    figure(
        &Ids {
            page: "surface-",
            phone: "surface-phone-",
        },
        Zoom::Free,
        &format!("The height of the part: {}.", part.figures()),
        &|ids| part.draw(ids),
    )
}

/// What all cuts leave, or those before finishing.
fn left(residual: &SurfaceMap, guide: Option<&Guide>, then: Then) -> Html {
    let alike = match guide {
        None => "The cuts are the same at every y",
        Some(Guide::Columns(columns)) if columns.is_fan() => {
            "Every cut is straight and has a slope of its own"
        }
        Some(Guide::Columns(_)) => "Every cut rises and falls along a curve of its own",
        Some(Guide::Spine(_)) => {
            "The cuts rise and fall along one spine, and seen along it they are the same at every y"
        }
    };
    let (cuts, next) = match then {
        Then::Finishing => ("roughing", " The next map shows what finishing leaves."),
        Then::Nothing => ("all cuts", ""),
    };
    figure(
        &Ids {
            page: "residual-",
            phone: "residual-phone-",
        },
        Zoom::Free,
        &format!(
            "How high material stands straight above the part after {cuts}: {}. {alike}: in addition \
             to scallops, material stays where the part lies below its shadow.{next}",
            residual.figures(),
        ),
        &|ids| residual.draw(ids),
    )
}

/// What finishing leaves.
fn after(finished: &SurfaceMap) -> Html {
    figure(
        &Ids {
            page: "finished-",
            phone: "finished-phone-",
        },
        Zoom::Free,
        &format!(
            "How high material stands straight above the part after finishing, in sections across the tracks: {}. A cell has \
             the highest place of the sections in it and next to it. The limit on the scallop applies to the distance from \
             the part, which is less where that is steep.",
            finished.figures()
        ),
        &|ids| finished.draw(ids),
    )
}

/// How far the disc leans.
fn tilt(leaning: &SurfaceMap) -> Html {
    figure(
        &Ids {
            page: "tilt-",
            phone: "tilt-phone-",
        },
        Zoom::Free,
        &format!(
            "How far the axis of the disc leans from the normal of the part where it touches it, by its lead and side tilt: \
             {}{}. A place belongs to the nearest track. A cell has the largest tilt in it.",
            leaning.figures(),
            leaning
                .limit()
                .map_or_else(String::new, |limit| format!(" ({limit})"))
        ),
        &|ids| leaning.draw(ids),
    )
}

/// How the disc goes.
fn ways(tracks: &DiscTracks) -> Html {
    figure(
        &Ids {
            page: "tracks-",
            phone: "tracks-phone-",
        },
        Zoom::Free,
        &format!(
            "The ways of the centre of the disc's edge on its tracks, from above: {}. Heads of arrows show where tracks end.",
            tracks.figures()
        ),
        &|ids| tracks.draw(ids),
    )
}

/// The section at the y of a slider.
fn slider(sections: &SurfaceSections, guide: Option<&Guide>, then: Then) -> Html {
    let off = match guide {
        Some(Guide::Spine(_)) => ", with the spine of the cuts taken off",
        Some(Guide::Columns(_)) | None => "",
    };
    let contour = match (sections.are_alike(), then) {
        (true, Then::Finishing) => {
            ". The contour after roughing is the same at every y and lies above the shadow, the greatest height of the part along y."
        }
        (true, Then::Nothing) => {
            ". The contour of the cuts is the same at every y and lies above the shadow, the greatest height of the part along y."
        }
        (false, _) => ", with the contour that the cuts leave there.",
    };
    let next = match then {
        Then::Finishing => " Finishing follows the part.",
        Then::Nothing => "",
    };
    slide(
        &Ids {
            page: "sections-",
            phone: "sections-phone-",
        },
        &sections.places().collect::<Vec<_>>(),
        sections.shown(),
        &format!("The section of the part at the y of the slider{off}{contour}{next}"),
        &|ids| sections.draw(ids),
    )
}

/// How the part bends, in two maps.
fn bends(Curved { curvature, class }: &Curved) -> Html {
    let greatest = figure(
        &Ids {
            page: "curvature-",
            phone: "curvature-phone-",
        },
        Zoom::Free,
        &format!(
            "The greatest curvature of the part over all directions, at the middle of each cell, positive where the part is hollow: {}. A \
             disc of the radius R needs a tilt whose sine is R times the curvature. On a part that no formula gives, these are estimates.",
            curvature.figures()
        ),
        &|ids| curvature.draw(ids),
    );
    let classes = figure(
        &Ids {
            page: "class-",
            phone: "class-phone-",
        },
        Zoom::Free,
        &format!(
            "The class of the part at the middle of each cell: {}. A bowl is hollow in all directions, a trough in one; a saddle is hollow \
             in one direction and convex in another; a ridge is convex in one direction, a dome in all.",
            class.figures()
        ),
        &|ids| class.draw(ids),
    );
    greatest + classes
}

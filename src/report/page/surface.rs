//! A part that changes along y from above: how high it is, what roughing and finishing leave above it, and how a disc goes over it.

use super::figure::{Ids, Zoom, figure, slide};
use super::{Section, Subject};
use crate::html::Html;
use crate::pictures::{Curved, DiscTracks, SurfaceMap, SurfaceSections};
use crate::space::{self, Shown};
use vcutc_job::follow::Guide;

/// The section; none of a part that is a profile.
pub(super) fn section(subject: Subject<'_>) -> Option<Section> {
    let part = SurfaceMap::of_part(&subject.material)?;
    let residual = SurfaceMap::of_residual(&subject.material)?;
    let finished = SurfaceMap::of_finished(&subject.material);
    let alike = match subject.material.job.part.guide() {
        None => "The cuts are the same at every y",
        Some(Guide::Columns(columns)) if columns.is_fan() => {
            "Every cut is straight and has a slope of its own"
        }
        Some(Guide::Columns(_)) => "Every cut rises and falls along a curve of its own",
        Some(Guide::Spine(_)) => {
            "The cuts rise and fall along one spine, and seen along it they are the same at every y"
        }
    };
    let is_finished = !subject.material.compiled.report.tracked.is_empty();
    let heights = figure(
        &Ids {
            page: "surface-",
            phone: "surface-phone-",
        },
        Zoom::Free,
        &format!("The height of the part: {}.", part.figures()),
        &|ids| part.draw(ids),
    );
    let left = figure(
        &Ids {
            page: "residual-",
            phone: "residual-phone-",
        },
        Zoom::Free,
        &format!(
            "How high material stands straight above the part after {}: {}. {}: in addition \
             to scallops, material stays where the part lies below its shadow.{}",
            if is_finished { "roughing" } else { "all cuts" },
            residual.figures(),
            alike,
            if is_finished {
                " The next map shows what finishing leaves."
            } else {
                ""
            }
        ),
        &|ids| residual.draw(ids),
    );
    let after = finished.as_ref().map(|finished| {
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
    });
    let leaning = SurfaceMap::of_tilt(&subject.material);
    let tilt = leaning.as_ref().map(|tilt| {
        figure(
            &Ids {
                page: "tilt-",
                phone: "tilt-phone-",
            },
            Zoom::Free,
            &format!(
                "How far the axis of the disc leans from the normal of the part where it touches it, by its lead and side tilt: \
                 {}{}. A place belongs to the nearest track. A cell has the largest tilt in it.",
                tilt.figures(),
                tilt.limit().map_or_else(String::new, |limit| format!(" ({limit})"))
            ),
            &|ids| tilt.draw(ids),
        )
    });
    let tracks = tilt.as_ref().and_then(|_| DiscTracks::of(&subject.material));
    let tracks = tracks.map(|tracks| {
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
    });
    let off = match subject.material.job.part.spine() {
        None => "",
        Some(_) => ", with the spine of the cuts taken off",
    };
    let sections = SurfaceSections::of(&subject.material).map(|sections| {
        let places: Vec<f64> = sections.places().collect();
        slide(
            &Ids {
                page: "sections-",
                phone: "sections-phone-",
            },
            &places,
            sections.shown(),
            &format!(
                "The section of the part at the y of the slider{off}{}{}",
                match (sections.are_alike(), is_finished) {
                    (true, true) => ". The contour after roughing is the same at every y and lies above the shadow, the greatest height \
                                     of the part along y.",
                    (true, false) => ". The contour of the cuts is the same at every y and lies above the shadow, the greatest height of \
                                      the part along y.",
                    (false, _) => ", with the contour that the cuts leave there.",
                },
                if is_finished {
                    " Finishing follows the part."
                } else {
                    ""
                }
            ),
            &|ids| sections.draw(ids),
        )
    });
    let curved = Curved::of(&subject.material);
    let mut maps = Vec::new();
    if let Some(Curved { curvature, class }) = &curved {
        maps.extend([Shown::Values(curvature), Shown::Classes(class)]);
    }
    let others = [Some(&residual), finished.as_ref(), leaning.as_ref()];
    maps.extend(others.into_iter().flatten().map(Shown::Values));
    let mut body = space::figure(&subject.material, &part, &maps).unwrap_or_default() + heights;
    if let Some(curved) = &curved {
        body += bends(curved);
    }
    body += left;
    for figure in [after, tilt, tracks].into_iter().flatten() {
        body += figure;
    }
    Some(Section {
        id: "surface",
        title: "Surface",
        body: match sections {
            Some(sections) => body + sections,
            None => body,
        },
    })
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

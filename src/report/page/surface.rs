//! A part that changes along y from above: how high it is, and what the cuts leave above it.

use super::figure::{Ids, Zoom, figure, slide};
use super::{Section, Subject};
use crate::pictures::{SurfaceMap, SurfaceSections};

/// The section; none of a part that is a profile.
pub(super) fn section(subject: Subject<'_>) -> Option<Section> {
    let part = SurfaceMap::of_part(&subject.material)?;
    let residual = SurfaceMap::of_residual(&subject.material)?;
    let alike = match subject.material.job.part.spine() {
        None => "The cuts are the same at every y",
        Some(_) => "The cuts rise and fall along one spine, and seen along it they are the same at every y",
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
                " What the tracks of finishing take off of that is not shown; the figures of the deviation say what they leave."
            } else {
                ""
            }
        ),
        &|ids| residual.draw(ids),
    );
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
                "The section of the part at the y of the slider{off}. The machined contour is the same at every y and lies above the \
                 shadow, the greatest height of the part along y."
            ),
            &|ids| sections.draw(ids),
        )
    });
    let body = heights + left;
    Some(Section {
        id: "surface",
        title: "Surface",
        body: match sections {
            Some(sections) => body + sections,
            None => body,
        },
    })
}

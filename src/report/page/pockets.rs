//! The pockets of a job: passes and slits along walls from above, and what they clear.

use super::figure::{Ids, Zoom, figure};
use super::{Section, Subject};
use crate::pictures;

/// The section; none of a job without pockets.
pub(super) fn section(subject: Subject<'_>) -> Option<Section> {
    let material = &subject.material;
    let report = &material.compiled.report;
    let (has_passes, has_slits) = (!report.cleared.is_empty(), !report.slit.is_empty());
    if !has_passes && !has_slits {
        return None;
    }
    let figures = pictures::pocket_figures(material);
    let mut words = if has_passes {
        format!(
            "The passes of the first layer of each pocket: {figures}. The angle of the tool's rim in the material is largest at \
             corners, and where the tool opens uncut ground."
        )
    } else {
        format!("Slits along the walls: {figures}.")
    };
    if has_slits {
        words.push_str(
            " A straight blade stands in the plane of each slit. At inward corners one of its edges stands upright; in hollow \
             arcs its corners touch the wall at the top.",
        );
    }
    Some(Section {
        id: "pockets",
        title: "Pockets",
        body: figure(
            &Ids {
                page: "passes-",
                phone: "passes-phone-",
            },
            Zoom::Free,
            &words,
            &|ids| pictures::passes(material, ids).unwrap_or_default(),
        ),
    })
}

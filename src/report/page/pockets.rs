//! The pockets of a job: passes from above, and what they clear.

use super::figure::{Ids, Zoom, figure};
use super::{Section, Subject};
use crate::pictures;

/// The section; none of a job without pockets.
pub(super) fn section(subject: Subject<'_>) -> Option<Section> {
    let material = &subject.material;
    if material.compiled.report.cleared.is_empty() {
        return None;
    }
    let words = format!(
        "The passes of the first layer of each pocket: {}. The angle of the tool's rim in the material is largest at corners, \
         and where the tool opens uncut ground.",
        pictures::pocket_figures(material)
    );
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

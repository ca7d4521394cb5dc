//! The cross-section: where the tips run and what they leave.

use super::figure::{Ids, Zoom, figure};
use super::{Section, Subject, cuts};
use crate::pictures;

pub(super) fn section(subject: Subject<'_>) -> Section {
    let material = &subject.material;
    let contour = figure(
        &Ids {
            page: "contour-",
            phone: "contour-phone-",
        },
        Zoom::Free,
        &format!(
            "What the cuts leave of the stock above the part: {}.",
            pictures::scallops(material)
        ),
        &|ids| pictures::contour(material, ids),
    );
    let lattice = figure(
        &Ids {
            page: "lattice-",
            phone: "lattice-phone-",
        },
        Zoom::Free,
        &format!("The path of the blade's tip: {}.", pictures::laid_out(material)),
        &|ids| pictures::lattice(material, ids),
    );
    Section {
        id: "cross-section",
        title: "Cut",
        body: contour + lattice + cuts::table_of_cuts(material),
    }
}

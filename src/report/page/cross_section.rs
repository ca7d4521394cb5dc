//! The cross-section: where the tips run and what they leave.

use super::figure::{Zoom, figure};
use super::{Section, Subject};
use crate::picture::Prefix;
use crate::report::pictures;

/// The section.
pub(super) fn section(subject: Subject<'_>) -> Section {
    let material = &subject.material;
    let contour = figure(
        &pictures::contour(material, Prefix::new("contour-")),
        Zoom::Free,
        "What the cuts leave of the stock, chip by chip, above the part.",
    );
    let lattice = figure(
        &pictures::lattice(material, Prefix::new("lattice-")),
        Zoom::Free,
        "Where the blade's tip runs and the V of each cut.",
    );
    Section {
        id: "cross-section",
        title: "Cross-section",
        body: contour + &lattice,
    }
}

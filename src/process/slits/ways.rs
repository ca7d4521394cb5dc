//! Slits of a straight blade, as plans show them.

use vcutc_job::planned::{PlannedWay, WayEntry, WayKind};
use vcutc_region::slits::{Begin, Slit};

/// The slits of a layer by the first blade of an operation, with its bottom and its top, in mm.
#[must_use]
pub fn ways(slits: &[Slit], layer: u32, heights: [f64; 2]) -> Vec<PlannedWay> {
    let slits = (1_u32..).zip(slits);
    slits
        .filter_map(|(number, slit)| {
            let from = slit.pieces.first()?.way.from;
            Some(PlannedWay {
                layer,
                number,
                kind: WayKind::Slit,
                blade: 0,
                from: [from.x, from.y],
                heights,
                length: slit.pieces.iter().map(|piece| piece.way.length()).sum(),
                entry: match slit.begins {
                    Begin::Within => WayEntry::Plunge,
                    Begin::Beside => WayEntry::Open,
                },
            })
        })
        .collect()
}

//! What is written is read back as the program it was written from, in every dialect.

use crate::support::{DIALECTS, needed, options};
use vcutc_backend_api::testkit::{conformance_with, five_axis_samples};
use vcutc_backend_gcode::Gcode;

#[test]
fn every_dialect_keeps_what_the_trait_promises() {
    let samples = five_axis_samples().unwrap();
    for dialect in DIALECTS {
        conformance_with(&Gcode, &samples, &options(&needed(dialect))).unwrap();
    }
}

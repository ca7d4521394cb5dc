//! The test programs that every dialect should be covered by, one by one.

use vcutc_backend_api::ir::Maker;
use vcutc_backend_api::testkit::{conformance, samples_for};
use vcutc_backend_rapid::Rapid;

#[test]
fn the_backend_keeps_the_promises_of_all_backends() {
    assert_eq!(conformance(&Rapid, &samples_for(Maker::Abb).unwrap()), Ok(()));
}

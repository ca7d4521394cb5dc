//! Rows over regions, against areas.

use super::*;
use crate::testkit::{circle, rectangle};
use proptest::prelude::*;

fn pieces(ring: &crate::region::Loop) -> Vec<Piece> {
    ring.iter().map(|edge| edge.piece).collect()
}

#[test]
fn rows_over_a_rectangle() {
    let bounds = pieces(&rectangle(10.0, 5.0, 30.0, 20.0));
    let front = Front::of(bounds[1]);
    assert!((front.deepest(&bounds) - 30.0).abs() < 1e-9);
    // A row beside a side, and one that ends in corners.
    for depth in [4.0, 30.0 - 1e-7] {
        let rows = front.row(&bounds, depth);
        assert_eq!(rows.len(), 1);
        assert!((rows[0][1] - rows[0][0] - 20.0).abs() < 1e-6);
    }
    assert!(front.row(&bounds, 30.1).is_empty());
    assert!(Front::holds(
        &bounds,
        Piece::line(front.place(5.0, 3.0), front.place(5.0, 20.0))
    ));
    assert!(!Front::holds(
        &bounds,
        Piece::line(front.place(5.0, -3.0), front.place(5.0, 20.0))
    ));
}

proptest! {
    /// A row through a circle is its chord.
    #[test]
    fn rows_are_chords(radius in 1.0..50.0_f64, share in -0.99..0.99_f64) {
        let bounds = pieces(&circle(3.0, 4.0, radius));
        let side = Piece::line(Place::new(3.0, -100.0), Place::new(3.0, 100.0));
        let front = Front::of(side);
        let rows = front.row(&bounds, share * radius);
        prop_assert_eq!(rows.len(), 1);
        let chord = 2.0 * radius * (1.0 - share * share).sqrt();
        prop_assert!((rows[0][1] - rows[0][0] - chord).abs() < 1e-4);
        prop_assert!((front.deepest(&bounds) - radius).abs() < 1e-9);
    }
}

//! Links over ground that is cut, and over ground that is not.

use super::*;
use crate::testkit::passes::{open, rectangle, rings};
use core::f64::consts::{FRAC_PI_2, PI};

#[test]
fn a_way_back_along_a_pass_is_free() {
    let region = rectangle(100.0, 40.0);
    let pass = [open(&[[10.0, 20.0], [90.0, 20.0]])];
    let (from, to) = (Place::new(90.0, 20.0), Place::new(10.0, 20.0));
    let found = link(&region, &pass, 5.0, (from, to), 0.0).unwrap().unwrap();
    assert_eq!(found.engagement, 0.0);
    assert_eq!(found.piece, Piece::line(from, to));
    // Onwards half of the rim works, and from a place off the pass nothing is known.
    let onwards = Place::new(95.0, 20.0);
    let ahead = link(&region, &pass, 5.0, (from, onwards), PI).unwrap().unwrap();
    assert!((ahead.engagement - PI).abs() < 1e-9);
    assert_eq!(link(&region, &pass, 5.0, (from, onwards), 3.0).unwrap(), None);
    let off = Place::new(50.0, 20.1);
    assert_eq!(link(&region, &pass, 5.0, (off, to), PI).unwrap(), None);
}

#[test]
fn walls_refuse_links_that_come_near() {
    let region = rectangle(100.0, 40.0);
    let pass = [open(&[[10.0, 5.0], [90.0, 5.0]])];
    let from = Place::new(90.0, 5.0);
    let to = |y: f64| Place::new(10.0, y);
    assert!(link(&region, &pass, 5.0, (from, to(5.0)), 0.0).unwrap().is_some());
    let near = to(4.999);
    assert_eq!(link(&region, &pass, 5.0, (from, near), PI).unwrap(), None);
}

#[test]
fn the_way_to_the_next_ring_works_as_deep_as_it_goes() {
    let region = rectangle(100.0, 80.0);
    let mut passes = rings(100.0, 80.0, 5.0, 4.0);
    passes.reverse();
    let (cut, next) = (passes.len() - 1, passes.len());
    let mut links = Links::new(&region, &passes, 5.0, 5.0);
    // Straight out, what lies to both sides of the way ahead: twice that of a pass.
    let (from, to) = (Place::new(50.0, 9.0), Place::new(50.0, 5.0));
    let found = links.link(cut, from, to, PI).unwrap().unwrap();
    let exact = 2.0 * libm::acos(1.0 - 4.0 / 5.0);
    assert!(
        found.engagement >= exact - 1e-9 && found.engagement < exact + 0.06,
        "{found:?}"
    );
    assert_eq!(links.link(cut, from, to, FRAC_PI_2).unwrap(), None);
    // With that ring cut too, every way between both is free but for the slack of the bound.
    let found = links
        .link(next, from, Place::new(55.0, 9.0), PI)
        .unwrap()
        .unwrap();
    assert!(found.engagement < 1e-9, "{found:?}");
}

//! Where the tool goes into the blank without a pass: straight down, or from a place that is not known.
//!
//! V-cuts come from beside the blank, so a job has no such motion. What that means depends on the passes. Where those before it
//! have cut already, the motion is one through the air. Where a pass cuts later, no part of the shape is missing, and the motion
//! is listed. Where none does, the job would leave standing what the program cuts, and the motion is refused. What has been cut
//! is measured on the surface that the V-cuts leave, the one by which they are planned.

use super::types::Plunge;
use super::types::{Blank, Pass, SAME};
use vcutc_geometry::curve::Point2;
use vcutc_simulation::surface::{Surface, Vee};

/// Plunges into uncut material.
pub(super) struct Sorted {
    /// Where a pass cuts later.
    pub(super) cut_later: Vec<Plunge>,
    pub(super) alone: Vec<Plunge>,
}

/// Sorts plunges, in the order of the program, by what the passes cut before them and after them. `slope` is
/// the rise of the V-cuts' flanks over x.
pub(super) fn sorted(plunges: &[Plunge], passes: &[Pass], blank: Blank, slope: f64) -> Sorted {
    let mut sorted = Sorted {
        cut_later: Vec::new(),
        alone: Vec::new(),
    };
    if plunges.is_empty() {
        return sorted;
    }
    let mut surface = Surface::flat(blank.width, blank.height);
    let vee = |pass: &Pass| Vee::even(Point2 { x: pass.x, z: pass.z }, slope);
    let stands = |surface: &mut Surface, plunge: &Plunge| {
        let [x, _, z] = plunge.low;
        surface.covers(Point2 { x, z: z + SAME })
    };
    let mut uncut: Vec<Plunge> = Vec::new();
    let mut done = 0;
    for plunge in plunges {
        for pass in passes.get(done..plunge.before).unwrap_or_default() {
            surface.release(vee(pass));
        }
        done = done.max(plunge.before);
        if stands(&mut surface, plunge) {
            uncut.push(*plunge);
        }
    }
    for pass in passes.get(done..).unwrap_or_default() {
        surface.release(vee(pass));
    }
    for plunge in uncut {
        if stands(&mut surface, &plunge) {
            sorted.alone.push(plunge);
        } else {
            sorted.cut_later.push(plunge);
        }
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::milling::Way;
    use crate::types::Start;
    use proptest::prelude::*;
    use vcutc_diagnostics::source::SourceMap;
    use vcutc_diagnostics::source::Span;

    const BLANK: Blank = Blank {
        width: 80.0,
        depth: 50.0,
        height: 50.0,
        corner: [0.0; 3],
    };

    fn place() -> Span {
        let file = SourceMap::default().add("a.src".to_owned(), String::new());
        Span::of_bytes(file, 0..0)
    }

    fn pass((x, z): (f64, f64)) -> Pass {
        Pass {
            x,
            z,
            y: [0.0, 50.0],
            places: [place(); 2],
            speed: None,
            second_speed: None,
            way: Way::Straight,
        }
    }

    /// The height that Vs have left over x, by the definition: the lowest of the top and of all flanks.
    fn left(passes: &[Pass], x: f64, slope: f64) -> f64 {
        let flanks = passes.iter().map(|pass| pass.z + slope * (x - pass.x).abs());
        flanks.fold(BLANK.height, f64::min)
    }

    proptest! {
        #[test]
        fn plunges_are_sorted_as_the_definition_says(
            tips in prop::collection::vec((0.0..80.0_f64, 0.0..50.0_f64), 0..30),
            lows in prop::collection::vec((0.0..80.0_f64, 0.0..50.0_f64, 0.0..1.0_f64), 0..20),
            slope in 0.3..3.0_f64,
        ) {
            let passes: Vec<Pass> = tips.into_iter().map(pass).collect();
            let mut plunges: Vec<Plunge> = lows
                .into_iter()
                .map(|(x, z, share)| Plunge {
                    place: place(),
                    start: Start::Above,
                    low: [x, 25.0, z],
                    before: (share * passes.len() as f64) as usize,
                })
                .collect();
            plunges.sort_by_key(|plunge| plunge.before);
            let sorted = sorted(&plunges, &passes, BLANK, slope);
            for plunge in &plunges {
                let [x, _, z] = plunge.low;
                let (so_far, at_last) = (left(&passes[..plunge.before], x, slope), left(&passes, x, slope));
                // Within a hair of a flank either answer is right.
                prop_assume!((so_far - z - SAME).abs() > 1e-5 && (at_last - z - SAME).abs() > 1e-5);
                let stands = |height: f64| height > z + SAME;
                prop_assert_eq!(sorted.alone.contains(plunge), stands(at_last));
                prop_assert_eq!(sorted.cut_later.contains(plunge), stands(so_far) && !stands(at_last));
            }
        }
    }
}

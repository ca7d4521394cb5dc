//! Arcs as a control carries them out.

use crate::controller::Arcs;
use crate::options::Settings;
use crate::statement::{Order, Parsed, Plane, Sense, expected};

/// By how much the ends of an arc may be at other distances from its centre, in mm: less than any control takes, and more than
/// printing makes of it.
const LARGEST_SPIRAL: f64 = 0.005;

/// The centre of an arc, and the axis about which it goes by the rule of the right hand.
pub(super) struct About {
    pub(super) centre: [f64; 3],
    pub(super) axis: [f64; 3],
}

/// What, apart from its block, says where an arc lies.
#[derive(Clone, Copy)]
pub(super) struct Said {
    pub(super) plane: Option<Plane>,
    pub(super) pole: Option<[f64; 2]>,
}

/// The arc of a block from one point to another, in the frame of the work offset.
pub(super) fn about(
    order: &Order<'_>,
    (sense, said): (Sense, Said),
    settings: &Settings<'_>,
    [from, to]: [[f64; 3]; 2],
) -> Parsed<About> {
    let (plane, centre) = match settings.facts().arcs {
        Arcs::AboutPole => match said.pole {
            Some([x, y]) if !order.has_arc() => (Plane::Xy, [x, y, from[2]]),
            Some(_) => return expected("no centre in the block of an arc, for `CC` says it"),
            None => return expected("`CC` before an arc"),
        },
        Arcs::InPlanes | Arcs::InAnyPlane => {
            let Some(plane) = said.plane else {
                return expected("`G17`, `G18` or `G19` before an arc");
            };
            (plane, offset(order, plane, from)?)
        }
    };
    let radius = |point: [f64; 3]| {
        let arm = plane.within([point[0] - centre[0], point[1] - centre[1], point[2] - centre[2]]);
        arm.iter().map(|along| along * along).sum::<f64>().sqrt()
    };
    if (radius(from) - radius(to)).abs() > LARGEST_SPIRAL {
        return expected("an arc whose ends are equally far from its centre");
    }
    let across = |point: [f64; 3]| point.get(plane.normal()).copied().unwrap_or_default();
    // A helix; what is printed may differ by a unit.
    if (across(from) - across(to)).abs() > 1.5 * settings.common.lengths.unit() {
        return expected(format!("both ends of an arc in one plane of `{}`", plane.word()));
    }
    // Without a way between its ends it is a full circle to the control.
    if plane.within(from) == plane.within(to) {
        return expected("an arc that ends elsewhere than it begins");
    }
    let axis = sense.axis(plane);
    Ok(About { centre, axis })
}

/// The centre that I, J and K lead to. One that is left out is 0, but not all of them.
fn offset(order: &Order<'_>, plane: Plane, from: [f64; 3]) -> Parsed<[f64; 3]> {
    let across = order.centre.get(plane.normal()).copied().flatten();
    if across.is_some() || order.via.iter().any(Option::is_some) {
        return expected(format!("no centre across the plane of `{}`", plane.word()));
    }
    if !order.has_arc() {
        return expected("the centre of an arc, by I, J or K");
    }
    let mut centre = from;
    for (value, said) in centre.iter_mut().zip(order.centre) {
        *value += said.unwrap_or_default();
    }
    Ok(centre)
}

/// The point of a block through which an arc leads.
pub(super) fn via(order: &Order<'_>) -> Parsed<[f64; 3]> {
    match (order.via, order.centre) {
        ([Some(x), Some(y), Some(z)], [None, None, None]) => Ok([x, y, z]),
        (_, _) => expected("all of I1, J1 and K1 after `CIP`"),
    }
}

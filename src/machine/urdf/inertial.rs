//! The `<inertial>` of a link: its mass, where its centre is, and its inertia about that.

use super::elements::{Element, Link, Read, both, fault, one, refuse, shortened};
use crate::body::Body;
use crate::ranges::{INERTIA, MASS};
use glam::{DMat3, DVec3};
use vcutc_diagnostics::schema::range::Range;

impl<'t> Link<'t> {
    /// What it weighs, in its frame; none where the file does not say.
    pub(super) fn body(&self) -> Read<Option<Body>> {
        let Some(inertial) = self.inertial() else {
            return Ok(None);
        };
        let centre = inertial.origin("the centre of mass", "its link");
        let (centre, (mass, inertia)) = both(centre, both(mass(inertial), inertia(inertial)))?;
        let body = Body {
            mass,
            centre: DVec3::ZERO,
            inertia,
        };
        Ok(Some(body.moved(&centre)))
    }

    pub(super) fn has_mass(&self) -> bool {
        self.inertial().is_some()
    }

    fn inertial(&self) -> Option<Element<'t>> {
        self.element.child("inertial")
    }
}

/// In kg.
fn mass(inertial: Element<'_>) -> Read<f64> {
    number(inertial.required_child("mass")?, ["mass", "value"], MASS)
}

/// The matrix, in kg m2, along the axes of the frame of the centre.
fn inertia(inertial: Element<'_>) -> Read<DMat3> {
    let Some(element) = inertial.child("inertia") else {
        return Ok(DMat3::ZERO);
    };
    let entry = |name| number(element, ["inertia", name], INERTIA);
    let (xx, (yy, zz)) = both(entry("ixx"), both(entry("iyy"), entry("izz")))?;
    let (xy, (xz, yz)) = both(entry("ixy"), both(entry("ixz"), entry("iyz")))?;
    Ok(DMat3::from_cols(
        DVec3::new(xx, xy, xz),
        DVec3::new(xy, yy, yz),
        DVec3::new(xz, yz, zz),
    ))
}

fn number(element: Element<'_>, [what, name]: [&'static str; 2], range: Range) -> Read<f64> {
    let written = element.required(name)?;
    let number = one(written)?;
    if range.holds_number(number) {
        return Ok(number);
    }
    let message = format!("`{name}` of `{what}` is {}", shortened(written.node));
    let label = format!("{} is expected", range.words());
    let fault = fault(written.span, message, label);
    refuse(fault.help("write it in kg or kg m2, or delete `<inertial>` if the mass is not known"))
}

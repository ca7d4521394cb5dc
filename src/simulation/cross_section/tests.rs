//! Strips, one by one, against the numbers of the field; then random programs against an arrangement of lines.

mod arrangement;
mod bodies;
mod columns;
mod engaged;
mod skin;
mod strips;

use super::{CrossSection, Guard};
use crate::disc::{Disc, DiscPass};
use crate::surface::{Side, Surface};
use vcutc_backend_api::ir::BodyStage;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;

const fn at(x: f64, z: f64) -> Point2 {
    Point2::new(x, z)
}

fn block(width: f64, top: f64) -> CrossSection {
    CrossSection::new(Surface::flat(width, top))
}

fn corners(section: &mut CrossSection) -> Vec<(f64, f64)> {
    section
        .surface()
        .corners()
        .map(|corner| (corner.x, corner.z))
        .collect()
}

fn level(width: f64, z: f64) -> Profile {
    Profile::new(vec![at(0.0, z), at(width, z)]).unwrap()
}

/// Without a body.
fn disc(radius: f64) -> Disc {
    Disc {
        radius: Length::mm(radius),
        depth: None,
        width: None,
        body: Vec::new(),
    }
}

/// R 25 with a shank of 8 mm.
fn wheel() -> Disc {
    let stage = |from, radius| BodyStage {
        from: Length::mm(from),
        radius: Length::mm(radius),
    };
    Disc {
        depth: Some(Length::mm(10.0)),
        width: Some(Length::mm(12.0)),
        body: vec![stage(0.0, 8.0), stage(60.0, 25.0)],
        ..disc(25.0)
    }
}

/// With its centre there, and the strip on a side. The rim goes half a millimetre beyond.
fn pass(centre: Point2, side: Side, lead: f64) -> DiscPass {
    DiscPass {
        centre,
        lead: Angle::deg(lead),
        side,
        beyond: Length::mm(0.5),
        shave: None,
        clearance: Length::mm(1.0),
    }
}

/// For a strip that ends at x, on a floor.
fn beside(disc: &Disc, x: f64, z: f64, side: Side) -> DiscPass {
    let inset = disc.radius.to_mm() - 0.5;
    let centre = match side {
        Side::Left => x + inset,
        Side::Right => x - inset,
    };
    pass(at(centre, z), side, 0.0)
}

/// Guards nothing.
fn air(width: f64) -> Profile {
    level(width, -1000.0)
}

/// Passes where nothing is to be guarded.
fn free(section: &mut CrossSection, disc: &Disc, pass: DiscPass) -> crate::disc::PassOutcome {
    let part = air(1000.0);
    section.pass(disc, &pass, &Guard::new(&part))
}

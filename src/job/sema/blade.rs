//! `blade NAME { ... }` and `blade NAME = KIND { ... }`.

mod body;
mod forces;
mod kinds;

pub(crate) use kinds::spec;

use super::eval::Scope;
use super::fields::{Fields, Place};
use super::heads::BladeHead;
use super::read::Reader;
use super::report::Checked;
use super::session::Session;
use crate::forces::{EdgeForces, RimForces, TeethForces};
use crate::{Blade, BladeKind, Crusher, Disc, Sourced, StraightBlade};
use body::Edge;
use kinds::EDGES;
use vcutc_backend_api::units::Length;
use vcutc_syntax::ast::Block;

/// A blade.
pub(crate) fn check(
    head: BladeHead<'_>,
    block: &Block,
    place: Place,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Blade> {
    let fields = Fields::sort(spec(head.kind), place, &block.entries, session);
    let span = fields.place_of("forces").unwrap_or(place.head);
    let forces = forces::Given { span, scope };
    match head.kind {
        BladeKind::Straight => {
            let forces = forces.check(&fields, session, forces::of_edge);
            let mut reader = Reader::new(scope, &mut session.reports);
            straight(head, &fields, forces, &mut reader).map(Blade::Straight)
        }
        BladeKind::Disc => {
            let forces = forces.check(&fields, session, forces::of_rim);
            let mut reader = Reader::new(scope, &mut session.reports);
            disc(head, &fields, forces, &mut reader).map(Blade::Disc)
        }
        BladeKind::Crusher => {
            let forces = forces.check(&fields, session, forces::of_teeth);
            let mut reader = Reader::new(scope, &mut session.reports);
            crusher(head, &fields, forces, &mut reader).map(Blade::Crusher)
        }
    }
}

fn straight(
    head: BladeHead<'_>,
    fields: &Fields<'_>,
    forces: Checked<Option<EdgeForces>>,
    reader: &mut Reader<'_>,
) -> Checked<StraightBlade> {
    let cutting_length = reader.required(fields, "cutting_length");
    let half_apex = reader.required(fields, "half_apex");
    let thickness = reader.required(fields, "thickness");
    let edges = fields
        .required_value("edges", reader.reports)
        .and_then(|expr| reader.word("edges", expr, EDGES));
    let body = body::check(fields, cutting_length.ok().map(Edge::UpTo), reader);
    Ok(StraightBlade {
        name: head.name.node.to_owned(),
        span: head.name.span,
        cutting_length: cutting_length?,
        half_apex: half_apex?,
        thickness: thickness?,
        edges: edges?.value,
        body: body?,
        forces: forces?,
    })
}

fn disc(
    head: BladeHead<'_>,
    fields: &Fields<'_>,
    forces: Checked<Option<RimForces>>,
    reader: &mut Reader<'_>,
) -> Checked<Disc> {
    let radius: Checked<Sourced<Length>> = reader.required(fields, "radius");
    let thickness = reader.required(fields, "thickness");
    let depth = reader.required(fields, "depth");
    let width = reader.required(fields, "width");
    let spin = reader.required(fields, "spin");
    let rim = match (radius, thickness) {
        (Ok(radius), Ok(thickness)) => Some(Edge::Rim { radius, thickness }),
        _ => None,
    };
    let body = body::required(fields, rim, reader);
    Ok(Disc {
        name: head.name.node.to_owned(),
        span: head.name.span,
        radius: radius?,
        thickness: thickness?,
        depth: depth?,
        width: width?,
        spin: spin?,
        body: body?,
        forces: forces?,
    })
}

fn crusher(
    head: BladeHead<'_>,
    fields: &Fields<'_>,
    forces: Checked<Option<TeethForces>>,
    reader: &mut Reader<'_>,
) -> Checked<Crusher> {
    let radius = reader.required(fields, "radius");
    let height = reader.required(fields, "height");
    let spin = reader.required(fields, "spin");
    let ramp = reader.required(fields, "ramp");
    let body = body::check(fields, height.ok().map(Edge::UpTo), reader);
    Ok(Crusher {
        name: head.name.node.to_owned(),
        span: head.name.span,
        radius: radius?,
        height: height?,
        spin: spin?,
        ramp: ramp?,
        body: body?,
        forces: forces?,
    })
}

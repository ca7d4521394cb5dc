//! `region NAME { ... }`: an area of the plan, drawn in x and y.
//!
//! The pieces form one closed loop, which a straight wall closes where the last piece does not end at the start. Islands are
//! loops of their own. Arcs stay arcs. Or a drawing is all of the region ([`drawing`]).

pub(crate) mod drawing;
mod faults;
mod named;
mod stock;

pub use named::region;
pub use stock::beyond_stock;

use super::dimension::Dimension;
use super::eval::Scope;
use super::fields::Place;
use super::point::place;
use super::profile::impossible;
use super::report::Checked;
use super::session::Session;
use super::setup::inner_place;
use crate::NamedRegion;
use drawing::Named;
use faults::{misplaced, of_a_profile};
use std::sync::Arc;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_geometry::curve::{Curve as Shape, CurveError, Point2};
use vcutc_region::piece::Piece;
use vcutc_region::place::Place as At;
use vcutc_region::region::{Edge, EdgeName, Loop, Region, RegionFault, Side};
use vcutc_syntax::ast::{ArcBy, Block, Curve, Entry, Expr, HeadPart, Point};

/// A region and where it is drawn.
pub(crate) fn check(
    name: Spanned<&str>,
    block: &Block,
    place: Place,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<NamedRegion> {
    let drawing = block.entries.iter().find_map(Named::of);
    let drawn_in_the_job = drawing.is_none();
    let drawn = match drawing {
        Some(drawing) => a_drawing(drawing, &block.entries, scope, session)?,
        None => pieces(block, place, scope, session)?,
    };
    if let Some(reported) = session.damage_at(place.whole) {
        return Err(reported);
    }
    let region = match Region::new(drawn.loops.clone()) {
        Ok(region) => region,
        Err(found) => return Err(session.reports.push(drawn.fault(found, place))),
    };
    // The loops of a drawing may nest: several outlines are one region there.
    if drawn_in_the_job && let Some(island) = drawn.misplaced_island(&region) {
        let places = drawn.places.get(island).and_then(|places| places.first());
        let at = places.copied().unwrap_or(place.head);
        return Err(session.reports.push(faults::island_elsewhere(at)));
    }
    Ok(NamedRegion {
        name: name.node.to_owned(),
        span: name.span,
        region: Arc::new(region),
    })
}

/// A drawing, which is all of its region.
fn a_drawing(
    drawing: Named<'_>,
    entries: &[Entry],
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Drawn> {
    let mut places = entries.iter().map(faults::place_of);
    if let Some(other) = places.find(|other| *other != drawing.piece) {
        let fault = faults::beside_a_drawing(drawing.piece, other);
        return Err(session.reports.push(fault));
    }
    let (loops, places) = drawing.read(scope, session)?;
    Ok(Drawn {
        loops,
        places,
        drawing: Some(drawing.path.span),
    })
}

/// An outline and its islands.
fn pieces(block: &Block, place: Place, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<Drawn> {
    let mut drawn = Drawn::default();
    let outline = drawn.a_loop(&block.entries, place, scope, session);
    let mut fault = outline.err();
    for entry in &block.entries {
        if let Entry::Block(inner) = entry
            && is_island(inner)
        {
            let island = drawn.a_loop(&inner.entries, inner_place(inner), scope, session);
            fault = fault.or(island.err());
        }
    }
    fault.map_or(Ok(drawn), Err)
}

fn is_island(inner: &Block) -> bool {
    matches!(inner.head.as_slice(), [head] if head.node == HeadPart::Word("island".to_owned()))
}

/// The loops of a region, and where each edge is written.
#[derive(Default)]
struct Drawn {
    loops: Vec<Loop>,
    places: Vec<Vec<Span>>,
    /// Where the job names the drawing that they stand in.
    drawing: Option<Span>,
}

impl Drawn {
    /// Draws one loop.
    fn a_loop(
        &mut self,
        entries: &[Entry],
        place: Place,
        scope: Scope<'_>,
        session: &mut Session<'_>,
    ) -> Checked<()> {
        let mut pen = Pen {
            scope,
            first: None,
            at: None,
            edges: Vec::new(),
            places: Vec::new(),
        };
        let mut fault = None;
        for entry in entries {
            let drawn = match entry {
                Entry::Curve { curve, span } => pen.draw(curve, *span, session),
                Entry::Block(inner) if is_island(inner) => Ok(()),
                other => Err(session.reports.push(misplaced(other))),
            };
            fault = fault.or(drawn.err());
        }
        if let Some(reported) = fault {
            return Err(reported);
        }
        if let Some(reported) = session.damage_at(place.whole) {
            return Err(reported);
        }
        if pen.edges.is_empty() {
            return Err(session.reports.push(faults::empty(place)));
        }
        pen.close(place);
        self.loops.push(pen.edges);
        self.places.push(pen.places);
        Ok(())
    }
}

/// Areas that should be equal may differ by this, in mm2.
const SAME_AREA: f64 = 1e-3;

/// Positive where the loop goes round to the left.
fn signed_area(edges: &[Edge]) -> f64 {
    let twice: f64 = edges.iter().map(|edge| edge.piece.twice_area()).sum();
    twice / 2.0
}

fn area(edges: &[Edge]) -> f64 {
    signed_area(edges).abs()
}

/// Whether two loops go the same way: they enclose equal areas and have a corner in common.
fn is_same(one: &[Edge], other: &[Edge]) -> bool {
    let corner = other.first().map(|edge| edge.piece.from);
    let is_corner = |edge: &Edge| corner.is_some_and(|corner| edge.piece.from.distance(corner) < COINCIDENT);
    (area(one) - area(other)).abs() <= SAME_AREA && one.iter().any(is_corner)
}

impl Drawn {
    /// An invalid island, if there is one: the region is then not the outline less its islands.
    ///
    /// An island as large as the outline is the outline again, or lies around it. What else lies outside of the outline or in
    /// another island is an outline of the region, as which it goes round to the left. Islands that are drawn twice count once.
    fn misplaced_island(&self, region: &Region) -> Option<usize> {
        let (outline, islands) = self.loops.split_first()?;
        let largest = area(outline) - SAME_AREA;
        let is_large = |island: &Loop| area(island) >= largest;
        let is_outline = |edges: &&Loop| signed_area(edges) > 0.0 && !is_same(edges, outline);
        let found = islands.iter().position(is_large).or_else(|| {
            let other = region.loops().iter().find(is_outline)?;
            let island = islands.iter().position(|island| is_same(island, other));
            Some(island.unwrap_or(islands.len().saturating_sub(1)))
        });
        found.map(|island| island + 1)
    }

    /// Where an edge is written.
    fn place(&self, name: EdgeName, place: Place) -> Span {
        let edge = self.places.get(name.ring).and_then(|edges| edges.get(name.edge));
        edge.copied().unwrap_or(place.head)
    }

    /// The loops bound no region.
    fn fault(&self, fault: RegionFault, place: Place) -> Diagnostic {
        let at = |name| self.place(name, place);
        let diagnostic = match fault {
            RegionFault::Crosses {
                one,
                other,
                at: there,
            } => faults::meeting([at(one), at(other)], there, "cross"),
            RegionFault::Overlaps {
                one,
                other,
                at: there,
            } => faults::meeting([at(one), at(other)], there, "lie on each other"),
            RegionFault::Unsound(name) => faults::unsound(at(name)),
            RegionFault::Open { edge, .. } => faults::flat(at(edge)),
            RegionFault::Flat { ring } => faults::flat(at(EdgeName { ring, edge: 0 })),
            RegionFault::Empty => faults::flat(place.head),
            RegionFault::TooMany { edges, most } => faults::too_many(place.head, edges, most),
            RegionFault::Dense => faults::dense(place.head),
        };
        match self.drawing {
            Some(named) => diagnostic.and(named, "the drawing is named here"),
            None => diagnostic,
        }
    }
}

/// A place of the plan where curves see the plane of their own: what holds of arcs there holds here.
const fn in_plane(at: At) -> Point2 {
    Point2::new(at.x, at.y)
}

/// The shorter arc of a radius, to the left where it is positive.
fn by_radius(from: At, to: At, radius: f64) -> Result<Option<Angle>, CurveError> {
    let arc = Shape::arc_by_radius(in_plane(from), in_plane(to), Length::mm(radius))?;
    let turn = arc
        .sweep()
        .map(|sweep| Angle::rad(sweep.to_rad().abs() * radius.signum()));
    Ok(turn)
}

/// Draws a loop piece by piece.
struct Pen<'s> {
    scope: Scope<'s>,
    /// Where the loop begins, and where that is written.
    first: Option<(At, Span)>,
    /// Where the next piece begins; a fault where that could not be worked out.
    at: Option<Checked<At>>,
    edges: Vec<Edge>,
    places: Vec<Span>,
}

impl Pen<'_> {
    fn draw(&mut self, curve: &Curve, span: Span, session: &mut Session<'_>) -> Checked<()> {
        match curve {
            Curve::Start(start) => self.start(start, span, session),
            Curve::Line { to } => self.straight(to, Side::Wall, (curve, span), session),
            Curve::Open { to } => self.straight(to, Side::Open, (curve, span), session),
            Curve::Polyline { through, to } => {
                for corner in through.iter().chain([to]) {
                    self.straight(corner, Side::Wall, (curve, corner.span), session)?;
                }
                Ok(())
            }
            Curve::Arc { to, by } => self.arc(to, by, (curve, span), session),
            Curve::Circle { center, radius } => self.circle(center, radius, span, session),
            Curve::Bezier { .. } | Curve::Spline { .. } | Curve::Points { .. } | Curve::Airfoil { .. } => {
                Err(session.reports.push(of_a_profile(curve, span)))
            }
            Curve::Dxf { .. } | Curve::Svg { .. } => {
                Err(session.reports.push(faults::in_an_island(curve, span)))
            }
        }
    }

    fn start(&mut self, start: &Point, span: Span, session: &mut Session<'_>) -> Checked<()> {
        if let Some((_, first)) = self.first {
            return Err(session.reports.push(faults::second_start(span, first)));
        }
        if let Some(first) = self.places.first() {
            return Err(session.reports.push(faults::beside_a_circle(span, *first)));
        }
        let at = place(start, &self.scope, &mut session.reports);
        self.at = Some(at);
        self.first = Some((at?, span));
        Ok(())
    }

    /// Where a piece begins.
    fn begin(&self, (curve, span): (&Curve, Span), session: &mut Session<'_>) -> Checked<At> {
        match self.at {
            Some(at) => at,
            None => Err(session.reports.push(faults::without_start(curve, span))),
        }
    }

    fn straight(
        &mut self,
        to: &Point,
        side: Side,
        (curve, span): (&Curve, Span),
        session: &mut Session<'_>,
    ) -> Checked<()> {
        let from = self.begin((curve, span), session);
        let to = place(to, &self.scope, &mut session.reports);
        self.at = Some(to);
        self.add(Piece::line(from?, to?), side, span, session)
    }

    fn arc(
        &mut self,
        to: &Point,
        by: &ArcBy,
        (curve, span): (&Curve, Span),
        session: &mut Session<'_>,
    ) -> Checked<()> {
        let from = self.begin((curve, span), session);
        let end = place(to, &self.scope, &mut session.reports);
        self.at = Some(end);
        let (arc, at) = match by {
            ArcBy::Radius(radius) => {
                let (scope, reports) = (&self.scope, &mut session.reports);
                let length = scope.expect(radius, Dimension::LENGTH, "`radius`", Some("100 mm"), reports);
                (by_radius(from?, end?, length?), radius.span)
            }
            ArcBy::Center(center) => {
                let middle = place(center, &self.scope, &mut session.reports);
                let arc = Shape::arc_by_center(in_plane(from?), in_plane(end?), in_plane(middle?));
                (arc.map(|arc| arc.sweep()), center.span)
            }
            ArcBy::Through(through) => {
                let middle = place(through, &self.scope, &mut session.reports);
                let arc = Shape::arc_through(in_plane(from?), in_plane(middle?), in_plane(end?));
                (arc.map(|arc| arc.sweep()), through.span)
            }
        };
        match arc {
            Ok(sweep) => {
                let sweep = sweep.map_or(0.0, Angle::to_rad);
                self.add(Piece::arc(from?, end?, sweep), Side::Wall, span, session)
            }
            Err(error) => {
                let fault = impossible((curve, span), error, &[span, at, to.span]);
                Err(session.reports.push(fault))
            }
        }
    }

    fn circle(
        &mut self,
        center: &Point,
        radius: &Spanned<Expr>,
        span: Span,
        session: &mut Session<'_>,
    ) -> Checked<()> {
        if let Some(first) = self.first.map(|(_, at)| at).or(self.places.first().copied()) {
            return Err(session.reports.push(faults::beside_a_circle(span, first)));
        }
        let center = place(center, &self.scope, &mut session.reports);
        let (scope, reports) = (&self.scope, &mut session.reports);
        let length = scope.expect(radius, Dimension::LENGTH, "`radius`", Some("10 mm"), reports);
        let (center, length) = (center?, length?);
        if length <= 0.0 {
            return Err(session.reports.push(faults::no_radius(radius.span)));
        }
        let [left, right] = [-length, length].map(|by| At::new(center.x + by, center.y));
        let half = core::f64::consts::PI;
        for piece in [Piece::arc(right, left, half), Piece::arc(left, right, half)] {
            self.edges.push(Edge {
                piece,
                side: Side::Wall,
            });
            self.places.push(span);
        }
        Ok(())
    }

    fn add(&mut self, piece: Piece, side: Side, span: Span, session: &mut Session<'_>) -> Checked<()> {
        if piece.from.distance(piece.to) < COINCIDENT {
            return Err(session.reports.push(faults::of_no_length(span)));
        }
        self.edges.push(Edge { piece, side });
        self.places.push(span);
        Ok(())
    }

    /// A straight wall back to the start, where the loop does not end there.
    fn close(&mut self, place: Place) {
        let (Some((first, _)), Some(last)) = (self.first, self.edges.last_mut()) else {
            return;
        };
        if last.piece.to.distance(first) < COINCIDENT {
            last.piece.to = first;
            return;
        }
        let piece = Piece::line(last.piece.to, first);
        self.edges.push(Edge {
            piece,
            side: Side::Wall,
        });
        self.places.push(place.head);
    }
}

/// Places closer than this are one, in mm.
const COINCIDENT: f64 = 1e-6;

//! The blades of a job: straight ones, discs and crushers.
//!
//! An operation takes the kind that it cuts with, such as [`StraightBlade`], so nothing after the check asks which kind it has.

use super::Sourced;
use super::forces::{BladeForces, EdgeForces, RimForces, TeethForces};
use vcutc_backend_api::ir::{self, Edges, Shape, Straight};
use vcutc_backend_api::units::{Angle, AngularSpeed, Length};
use vcutc_diagnostics::source::Span;

/// A blade of any kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Blade {
    Straight(StraightBlade),
    Disc(Disc),
    Crusher(Crusher),
}

/// One of the blades of an operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BladeRef<'b> {
    Straight(&'b StraightBlade),
    Disc(&'b Disc),
    Crusher(&'b Crusher),
}

/// A blade of a known kind.
pub trait OfKind: Clone {
    /// Which.
    const KIND: BladeKind;

    /// The blade, if it is of this kind.
    fn of(blade: &Blade) -> Option<&Self>;
}

/// The kinds of blades.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BladeKind {
    /// Its edges meet in the tip; it vibrates along its axis.
    Straight,
    /// A thin circular knife, which vibrates and spins.
    Disc,
    /// A body that shreds what the edge at its lower rim parts; it spins.
    Crusher,
}

crate::words! {
    BladeKind { Straight = "straight", Disc = "disc", Crusher = "crusher" }
}

impl BladeKind {
    /// With article.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Straight => "a straight blade",
            Self::Disc => "a disc",
            Self::Crusher => "a crusher",
        }
    }

    /// As the end of "which is".
    #[must_use]
    pub const fn said_of(self) -> &'static str {
        match self {
            Self::Straight => "straight",
            Self::Disc => "a disc",
            Self::Crusher => "a crusher",
        }
    }

    /// Of several.
    #[must_use]
    pub const fn plural(self) -> &'static str {
        match self {
            Self::Straight => "straight blades",
            Self::Disc => "discs",
            Self::Crusher => "crushers",
        }
    }
}

/// A straight blade.
#[derive(Clone, Debug, PartialEq)]
pub struct StraightBlade {
    pub name: String,
    /// Where it is defined.
    pub span: Span,
    /// Usable edge length from the tip; positive.
    pub cutting_length: Sourced<Length>,
    /// Half the apex angle; at least 0 and below 90 degrees.
    pub half_apex: Sourced<Angle>,
    /// Thickness; zero or more.
    pub thickness: Sourced<Length>,
    /// Which sides cut.
    pub edges: Edges,
    /// The body above the edge; none if the job does not state it.
    pub body: Option<Body>,
    /// What its edge pushes with; none if the job does not state it.
    pub forces: Option<EdgeForces>,
}

/// A thin circular knife. Its heights count from the plane of its edge, along the axis towards the shank.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    pub name: String,
    /// Where it is defined.
    pub span: Span,
    /// Radius of the edge; positive.
    pub radius: Sourced<Length>,
    /// Thickness along the axis; positive.
    pub thickness: Sourced<Length>,
    /// The thickest chip that it takes; positive.
    pub depth: Sourced<Length>,
    /// The widest strip that it takes; positive.
    pub width: Sourced<Length>,
    /// How fast it turns about its axis; positive.
    pub spin: Sourced<AngularSpeed>,
    /// Hub, shank and holder: they decide what comes free.
    pub body: Body,
    /// What its rim pushes with; none if the job does not state it.
    pub forces: Option<RimForces>,
}

/// A body that shreds what the edge at its lower rim parts. Its heights count from that edge, along the axis towards the shank.
#[derive(Clone, Debug, PartialEq)]
pub struct Crusher {
    pub name: String,
    /// Where it is defined.
    pub span: Span,
    /// Radius of the edge; positive.
    pub radius: Sourced<Length>,
    /// How far up from the edge it shreds; positive.
    pub height: Sourced<Length>,
    /// How fast it turns about its axis; positive.
    pub spin: Sourced<AngularSpeed>,
    /// The steepest way down into the material; above 0 and below 90 degrees.
    pub ramp: Sourced<Angle>,
    /// What is above; none if the job does not state it.
    pub body: Option<Body>,
    /// What its teeth push with; none if the job does not state it.
    pub forces: Option<TeethForces>,
}

/// The body of a blade above its edge: round stages about its axis, from the edge up. Each continues up to the next one, the last
/// one without end.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Where it is given.
    pub span: Span,
    /// At least one; the heights rise.
    pub stages: Vec<BodyStage>,
}

/// A stage of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyStage {
    /// Height at which it begins, along the axis: of a straight blade above the tip, at least the cutting length; of others above
    /// the plane of the edge.
    pub from: Sourced<Length>,
    /// Its radius; positive.
    pub radius: Sourced<Length>,
}

impl Body {
    /// Its stages as programs have them.
    #[must_use]
    pub fn in_program(&self) -> Vec<ir::BodyStage> {
        let stages = self.stages.iter();
        stages
            .map(|stage| ir::BodyStage {
                from: stage.from.value,
                radius: stage.radius.value,
            })
            .collect()
    }

    fn forget_places(&mut self, place: Span) {
        self.span = place;
        for stage in &mut self.stages {
            stage.from.forget_place(place);
            stage.radius.forget_place(place);
        }
    }
}

impl Blade {
    /// Itself, for those to whom its kind matters little.
    #[must_use]
    pub const fn by_ref(&self) -> BladeRef<'_> {
        match self {
            Self::Straight(blade) => BladeRef::Straight(blade),
            Self::Disc(disc) => BladeRef::Disc(disc),
            Self::Crusher(crusher) => BladeRef::Crusher(crusher),
        }
    }
}

impl<'b> BladeRef<'b> {
    /// The length of its edge from the tip; none of a round one.
    #[must_use]
    pub const fn edge(self) -> Option<Length> {
        match self {
            Self::Straight(blade) => Some(blade.cutting_length.value),
            Self::Disc(_) | Self::Crusher(_) => None,
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'b str {
        match self {
            Self::Straight(blade) => &blade.name,
            Self::Disc(disc) => &disc.name,
            Self::Crusher(crusher) => &crusher.name,
        }
    }

    /// Where it is defined.
    #[must_use]
    pub const fn span(self) -> Span {
        match self {
            Self::Straight(blade) => blade.span,
            Self::Disc(disc) => disc.span,
            Self::Crusher(crusher) => crusher.span,
        }
    }

    /// Its kind.
    #[must_use]
    pub const fn kind(self) -> BladeKind {
        match self {
            Self::Straight(_) => BladeKind::Straight,
            Self::Disc(_) => BladeKind::Disc,
            Self::Crusher(_) => BladeKind::Crusher,
        }
    }

    /// Its body; none if the job does not state it.
    #[must_use]
    pub const fn body(self) -> Option<&'b Body> {
        match self {
            Self::Straight(blade) => blade.body.as_ref(),
            Self::Disc(disc) => Some(&disc.body),
            Self::Crusher(crusher) => crusher.body.as_ref(),
        }
    }

    /// What it pushes with; none if the job does not state it.
    #[must_use]
    pub fn forces(self) -> Option<BladeForces<'b>> {
        match self {
            Self::Straight(blade) => blade.forces.as_ref().map(BladeForces::Edge),
            Self::Disc(disc) => disc.forces.as_ref().map(BladeForces::Rim),
            Self::Crusher(crusher) => crusher.forces.as_ref().map(BladeForces::Teeth),
        }
    }

    /// How fast it turns about its axis, if it does.
    #[must_use]
    pub const fn spin(self) -> Option<Sourced<AngularSpeed>> {
        match self {
            Self::Straight(_) => None,
            Self::Disc(disc) => Some(disc.spin),
            Self::Crusher(crusher) => Some(crusher.spin),
        }
    }

    /// How far what it cuts with reaches from its tip.
    #[must_use]
    pub fn reach(self) -> Length {
        match self {
            Self::Straight(blade) => blade.cutting_length.value,
            Self::Disc(disc) => disc.radius.value,
            Self::Crusher(crusher) => crusher.height.value.max(crusher.radius.value),
        }
    }

    /// The blade as programs have it.
    #[must_use]
    pub fn in_program(self) -> ir::Blade {
        match self {
            Self::Straight(blade) => blade.in_program(),
            Self::Disc(disc) => disc.in_program(),
            Self::Crusher(crusher) => crusher.in_program(),
        }
    }
}

impl OfKind for StraightBlade {
    const KIND: BladeKind = BladeKind::Straight;

    fn of(blade: &Blade) -> Option<&Self> {
        match blade {
            Blade::Straight(blade) => Some(blade),
            Blade::Disc(_) | Blade::Crusher(_) => None,
        }
    }
}

impl OfKind for Disc {
    const KIND: BladeKind = BladeKind::Disc;

    fn of(blade: &Blade) -> Option<&Self> {
        match blade {
            Blade::Disc(disc) => Some(disc),
            Blade::Straight(_) | Blade::Crusher(_) => None,
        }
    }
}

impl OfKind for Crusher {
    const KIND: BladeKind = BladeKind::Crusher;

    fn of(blade: &Blade) -> Option<&Self> {
        match blade {
            Blade::Crusher(crusher) => Some(crusher),
            Blade::Straight(_) | Blade::Disc(_) => None,
        }
    }
}

impl Disc {
    /// The disc as programs have it.
    #[must_use]
    pub fn in_program(&self) -> ir::Blade {
        ir::Blade {
            name: self.name.clone(),
            shape: Shape::Disc(ir::Disc {
                radius: self.radius.value,
                thickness: self.thickness.value,
                spin: self.spin.value,
            }),
            body: Some(self.body.in_program()),
        }
    }

    /// Replaces the places where it is written by this one.
    pub fn forget_places(&mut self, place: Span) {
        self.span = place;
        self.radius.forget_place(place);
        self.thickness.forget_place(place);
        self.depth.forget_place(place);
        self.width.forget_place(place);
        self.spin.forget_place(place);
        self.body.forget_places(place);
        if let Some(forces) = &mut self.forces {
            forces.forget_places(place);
        }
    }
}

impl Crusher {
    /// The crusher as programs have it.
    #[must_use]
    pub fn in_program(&self) -> ir::Blade {
        ir::Blade {
            name: self.name.clone(),
            shape: Shape::Crusher(ir::Crusher {
                radius: self.radius.value,
                height: self.height.value,
                spin: self.spin.value,
                ramp: self.ramp.value,
            }),
            body: self.body.as_ref().map(Body::in_program),
        }
    }

    /// Replaces the places where it is written by this one.
    pub fn forget_places(&mut self, place: Span) {
        self.span = place;
        self.radius.forget_place(place);
        self.height.forget_place(place);
        self.spin.forget_place(place);
        self.ramp.forget_place(place);
        if let Some(body) = &mut self.body {
            body.forget_places(place);
        }
        if let Some(forces) = &mut self.forces {
            forces.forget_places(place);
        }
    }
}

impl StraightBlade {
    /// The blade as programs have it.
    #[must_use]
    pub fn in_program(&self) -> ir::Blade {
        ir::Blade {
            name: self.name.clone(),
            shape: Shape::Straight(Straight {
                cutting_length: self.cutting_length.value,
                half_apex: self.half_apex.value,
                thickness: self.thickness.value,
                edges: self.edges,
            }),
            body: self.body.as_ref().map(Body::in_program),
        }
    }

    /// Replaces the places where it is written by this one.
    pub fn forget_places(&mut self, place: Span) {
        self.span = place;
        self.cutting_length.forget_place(place);
        self.half_apex.forget_place(place);
        self.thickness.forget_place(place);
        if let Some(body) = &mut self.body {
            body.forget_places(place);
        }
        if let Some(forces) = &mut self.forces {
            forces.forget_places(place);
        }
    }
}

//! The blades of a job: straight ones, discs and crushers.
//!
//! An operation takes the kind that it cuts with, such as [`StraightBlade`], so nothing after the check asks which kind it has.

use super::Sourced;
use vcutc_backend_api::ir::{self, Edges};
use vcutc_backend_api::units::{Angle, AngularSpeed, Length};
use vcutc_diagnostics::source::Span;

/// A blade of any kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Blade {
    Straight(StraightBlade),
    Disc(Disc),
    Crusher(Crusher),
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
}

/// The body of a blade above its edge: round stages about its axis, from the edge up. Each goes on up to the next one, the last
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
}

impl Blade {
    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Straight(blade) => &blade.name,
            Self::Disc(disc) => &disc.name,
            Self::Crusher(crusher) => &crusher.name,
        }
    }

    /// Where it is defined.
    #[must_use]
    pub const fn span(&self) -> Span {
        match self {
            Self::Straight(blade) => blade.span,
            Self::Disc(disc) => disc.span,
            Self::Crusher(crusher) => crusher.span,
        }
    }

    /// Its kind.
    #[must_use]
    pub const fn kind(&self) -> BladeKind {
        match self {
            Self::Straight(_) => BladeKind::Straight,
            Self::Disc(_) => BladeKind::Disc,
            Self::Crusher(_) => BladeKind::Crusher,
        }
    }
}

impl StraightBlade {
    /// The blade as programs have it.
    #[must_use]
    pub fn in_program(&self) -> ir::Blade {
        ir::Blade {
            name: self.name.clone(),
            cutting_length: self.cutting_length.value,
            half_apex: self.half_apex.value,
            thickness: self.thickness.value,
            edges: self.edges,
            body: self.body.as_ref().map(Body::in_program),
        }
    }
}

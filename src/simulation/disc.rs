//! A disc and how it passes: what a pass needs to know, and what it reports.

use super::rim::{Drift, Rim, axis};
use super::surface::Side;
use vcutc_backend_api::ir::BodyStage;
use vcutc_backend_api::units::{Angle, Area, Length};
use vcutc_geometry::curve::Point2;

/// A disc that frees strips. Its tip is the centre of its edge.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    /// Of its edge.
    pub radius: Length,
    /// The thickest chip that it takes.
    pub depth: Option<Length>,
    /// The widest one.
    pub width: Option<Length>,
    /// Shank and holder, from the edge up.
    pub body: Vec<BodyStage>,
}

/// A straight way of a disc along y through all of the stock, without swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscPass {
    /// The centre of the edge, in mm.
    pub centre: Point2,
    /// How far the axis leans along the feed.
    pub lead: Angle,
    /// On which side of the centre the strip lies.
    pub side: Side,
    /// How far the rim may go on below what stands beside the strip.
    pub beyond: Length,
    /// The thickest sliver that the pass may take off in addition to its strip; none where it is what the
    /// lead shaves.
    pub shave: Option<Length>,
    /// Air around the body.
    pub clearance: Length,
}

impl DiscPass {
    /// What its edge covers.
    #[must_use]
    pub fn rim(&self, disc: &Disc) -> Rim {
        Rim::new(self.centre, disc.radius, self.lead)
    }
}

/// A straight way of a disc along y that takes the skin off the part: what roughing has left, wherever the rim comes out of it. The
/// axis leans along the feed by a lead above 0, and is rolled about the feed to stand on the part. A way that drifts is seen along
/// itself in the section through the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinPass {
    /// The centre of the edge, in mm.
    pub centre: Point2,
    /// The x at which the disc stands on the part, in mm: what stands there has to come free.
    pub contact: f64,
    /// How far the axis leans along y, in the sense of the feed: on a way that does not drift the lead.
    pub lead: Angle,
    /// By how much it leans towards -x.
    pub roll: Angle,
    /// How the way leads aside and up.
    pub drift: Drift,
    /// How thick a strip may be that runs over the body of the disc; at least as thick as there is room below the body.
    pub over_hub: Length,
    /// Air around the body.
    pub clearance: Length,
}

impl SkinPass {
    /// What its edge covers.
    #[must_use]
    pub fn rim(&self, disc: &Disc) -> Rim {
        Rim::swept(self.centre, disc.radius, [self.lead, self.roll], self.drift)
    }

    /// How far ahead of the centre, along y in the sense of the feed, the edge is where its rim lies over an x, in mm. Beyond its
    /// cover that of its end.
    #[must_use]
    pub fn ahead(&self, disc: &Disc, x: f64) -> f64 {
        let [aside, along, up] = axis(self.lead, self.roll);
        let right = self.drift.right;
        let rest = self.drift.width_square(aside, along);
        let half = disc.radius.to_mm() * rest.sqrt();
        let off = (x - self.centre.x).max(-half).min(half);
        // As the ellipse of `Rim::swept`, in plan; the lower half of the rim is the leading one.
        let turned = right + (aside - right * along) * along;
        (up * (half * half - off * off).max(0.0).sqrt() - turned * off) / rest
    }
}

/// What a pass has done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassOutcome {
    /// What came free, from left to right.
    pub freed: Vec<Freed>,
    /// What the rim cuts below the neighbour of the strip.
    pub undercut: Option<Stretch>,
    /// What is wrong with it.
    pub faults: Vec<PassFault>,
}

/// A column that came free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Freed {
    /// Over what, and how thick it is.
    pub stretch: Stretch,
    /// Of its section.
    pub area: Area,
}

/// What stands above a rim without a break.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Its left end, in mm.
    pub from: f64,
    /// Its right end, in mm.
    pub to: f64,
    /// The greatest height above the rim.
    pub height: Length,
    /// Where that is, in mm.
    pub highest: f64,
}

/// Something wrong with a pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PassFault {
    /// The strip is not cut free.
    Attached {
        /// All that hangs together above the rim.
        stretch: Stretch,
        /// What holds it.
        hold: Hold,
    },
    /// The rim meets more than its strip. This comes off where it is among what was freed, and stands otherwise.
    Meets(Stretch),
    /// The rim enters the part.
    EntersPart {
        /// The deepest place of the rim.
        at: Point2,
        /// How deep, along z.
        depth: Length,
    },
    /// The body, with its clearance, meets the section as it is before the pass.
    Body {
        /// The stage, from the edge.
        stage: usize,
        /// The point of the section that is farthest in.
        at: Point2,
        /// How far, along z.
        depth: Length,
    },
    /// The strip is thicker than the disc takes, or than there is room for below its body.
    TooThick {
        /// The strip.
        stretch: Stretch,
        /// The largest thickness.
        limit: Length,
    },
    /// The strip runs over the body and is thicker than has room there.
    OverBody {
        /// The strip.
        stretch: Stretch,
        /// The largest thickness.
        limit: Length,
    },
    /// The strip is wider than the disc takes.
    TooWide {
        /// The strip.
        stretch: Stretch,
        /// How much of it counts: what is thicker than a sliver.
        width: Length,
        /// The largest width.
        limit: Length,
    },
}

/// Why a strip stays attached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hold {
    /// A slit ends above the rim.
    SlitShort {
        /// Where, in mm.
        x: f64,
        /// How far above.
        above: Length,
    },
    /// The rim ends before the slit, the wall, or the side of the stock at which the strip ends.
    RimShort {
        /// Where that is, in mm.
        x: f64,
        /// How far beyond the rim.
        by: Length,
    },
    /// The rim ends in the material: what stands there would have to be that much lower.
    Buried {
        /// The height of the surface above the end of the rim.
        missing: Length,
    },
    /// The strip has no end on a side: nothing is open there.
    Closed,
}

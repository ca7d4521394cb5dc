//! What the two blades reach: how deep a slit goes, which strips a disc frees, and where its edge runs.
//!
//! A disc leans along its feed by the *lead*. Swept along y, its edge shows in the x-z plane as the lower half of an ellipse with
//! the semi-axes `R` and `R sin(lead)` about its centre *(derived here)*:
//!
//! ```text
//! E(x) = z_c - sin(lead) sqrt(R^2 - (x - x_c)^2)
//! ```
//!
//! So the pass is lowest under the centre, by the *sink* `R sin(lead)`. A strip lies between its open side and the rim, which
//! goes `beyond` its far slit. The edge is highest over the strip at that slit: the *rise* above its lowest point.

use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::{Auto, Disc, StraightBlade};
use vcutc_simulation::surface::Side;

/// Lengths this close are equal, in mm: a nanometre, as the surface takes it.
pub(crate) const TOUCH: f64 = 1e-6;

/// The straight blade as slits need it. It stands upright across the feed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knife {
    /// The edge that a slit may use, measured along it; positive.
    pub edge: Length,
    /// Half the apex angle; zero or more and less than the rake.
    pub half_apex: Angle,
    /// Angle between tool axis and feed; above 0 and at most 90 degrees.
    pub rake: Angle,
    /// Distance of its middle plane from the material that stays; zero or more.
    pub standoff: Length,
    /// What its edge must cover.
    pub covers: Cover,
}

/// What the edge of the straight blade must cover of what stands beside a slit. Beside a wall that slits above it have cut, only
/// the lower side is still to be cut; the blade slides along the rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cover {
    /// All that stands on either side, so that nothing but the edge comes near it.
    Standing,
    /// What is still to be cut. Whether the body of the blade has room beside the wall is for the proof to say.
    Uncut,
}

impl Knife {
    /// A straight blade of a job, held with this rake. Its standoff is half its thickness where none is given.
    #[must_use]
    pub fn of(blade: &StraightBlade, rake: Angle, standoff: Auto<Length>, covers: Cover) -> Self {
        Self {
            edge: blade.cutting_length.value,
            half_apex: blade.half_apex.value,
            rake,
            standoff: standoff.or(blade.thickness.value * 0.5),
            covers,
        }
    }

    /// How deep a slit may be: `L sin(theta - beta)` [Cui 2].
    #[must_use]
    pub fn deepest(&self) -> Length {
        self.edge * self.leading().sin()
    }

    /// The edge that a slit so deep uses.
    #[must_use]
    pub fn edge_for(&self, depth: Length) -> Length {
        depth * (1.0 / self.leading().sin())
    }

    /// How far the blade overhangs its tip along the feed: `L cos(theta - beta)` [Cui 5].
    #[must_use]
    pub fn overhang(&self) -> Length {
        self.edge * self.leading().cos()
    }

    /// How far it turns between a slit and the next one, back: its shank leans along the feed.
    #[must_use]
    pub fn turn(&self) -> Angle {
        Angle::deg(180.0) - 2.0 * self.rake
    }

    /// Angle between the leading edge and the feed.
    fn leading(&self) -> Angle {
        self.rake - self.half_apex
    }
}

/// A stage of the disc's body: a round shaft from a height on, up to the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaft {
    /// Where it begins above the plane of the edge, along the axis; zero or more.
    pub from: Length,
    /// Its radius; positive.
    pub radius: Length,
}

/// The disc as strips need it.
#[derive(Clone, Debug, PartialEq)]
pub struct Wheel {
    /// Radius of the edge; positive.
    pub radius: Length,
    /// The thickest chip that it takes; positive.
    pub depth: Length,
    /// The widest strip that it takes; positive.
    pub width: Length,
    /// Its body, from the edge up.
    pub body: Vec<Shaft>,
    /// How far its rim runs beyond the slit of a strip; zero or more and less than the radius.
    pub beyond: Length,
    /// Air that its body keeps from what stands, sideways; zero or more.
    pub clearance: Length,
    /// How far its axis leans along the feed; 0 to below 90 degrees.
    pub lead: Angle,
}

/// What bounds the width of strips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WidthBound {
    /// The widest strip that the disc takes.
    Disc,
    /// Its body, which must not stand where the strip does.
    Body {
        /// The stage, counted from 0 at the edge.
        stage: usize,
    },
}

/// A strip before it is cut: a rectangle over the lowest point of its pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extent {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) floor: f64,
}

/// How an operation holds its disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    /// How far its axis leans along the feed; 0 to below 90 degrees.
    pub lead: Angle,
    /// How far its rim runs beyond the slit of a strip.
    pub beyond: Length,
    /// Air that its body keeps from what stands, sideways.
    pub clearance: Length,
}

impl Wheel {
    /// A disc of a job, held like this.
    #[must_use]
    pub fn of(disc: &Disc, hold: Hold) -> Self {
        let stages = disc.body.stages.iter();
        let body = stages.map(|stage| Shaft {
            from: stage.from.value,
            radius: stage.radius.value,
        });
        Self {
            radius: disc.radius.value,
            depth: disc.depth.value,
            width: disc.width.value,
            body: body.collect(),
            beyond: hold.beyond,
            clearance: hold.clearance,
            lead: hold.lead,
        }
    }

    /// How far the edge dips below its centre: `R sin(lead)`.
    #[must_use]
    pub fn sink(&self) -> Length {
        self.radius * self.lead.sin()
    }

    /// How far above the lowest point of a pass its edge is at the slit of the strip, the highest place over the strip.
    #[must_use]
    pub fn rise(&self) -> Length {
        self.rise_within(self.beyond)
    }

    /// How far above the lowest point of a pass its edge is so far within the rim.
    pub(crate) fn rise_within(&self, within: Length) -> Length {
        let (radius, within) = (self.radius.to_mm(), within.to_mm());
        let chord = (within * (2.0 * radius - within)).max(0.0).sqrt();
        Length::mm((radius - chord) * self.lead.sin())
    }

    /// How much deeper than what a strip leaves its slits may go, where the centre of the disc is rounded by so much: close to its
    /// end the rim rises steeply.
    pub(crate) fn slit_excess(&self, rounding: Length) -> Length {
        self.rise() - self.rise_within(self.beyond + rounding)
    }

    /// How far the disc extends from its centre along the feed: `R cos(lead)`.
    #[must_use]
    pub fn overhang(&self) -> Length {
        self.radius * self.lead.cos()
    }

    /// The thickest layer whose chips it takes: its lead makes them thicker.
    #[must_use]
    pub fn thickest_layer(&self) -> Length {
        self.depth - self.sink()
    }

    /// The widest strip that it frees out of a layer so thick, and what bounds it. At most zero where the body leaves no room.
    #[must_use]
    pub fn widest_strip(&self, layer: Length) -> (Length, WidthBound) {
        let room = self.radius - self.beyond - self.clearance;
        // The strip stands that high above the centre before its pass.
        let strip = layer + self.rise() - self.sink();
        let stages = self.body.iter().enumerate();
        let by_body = stages
            .filter(|(_, shaft)| self.underside(**shaft) < strip - Length::mm(TOUCH))
            .map(|(stage, shaft)| (room - shaft.radius, WidthBound::Body { stage }));
        let all = by_body.chain([(self.width, WidthBound::Disc)]);
        all.min_by(|(one, _), (other, _)| one.total_cmp(other))
            .unwrap_or((self.width, WidthBound::Disc))
    }

    /// How high above the disc's centre what stands beside it may reach below a stage of its body. The first stage stands on the
    /// disc, which has been wherever it comes.
    pub(crate) fn underside(&self, shaft: Shaft) -> Length {
        if shaft.from.to_mm() > TOUCH {
            shaft.from * self.lead.cos() - shaft.radius * self.lead.sin()
        } else {
            Length::ZERO
        }
    }

    /// Where the centre of the disc runs over a strip that is open on one side.
    pub(crate) fn centre_over(&self, strip: Extent, open: Side) -> Point2 {
        let (radius, beyond) = (self.radius.to_mm(), self.beyond.to_mm());
        let x = match open {
            Side::Left => strip.right + beyond - radius,
            Side::Right => strip.left - beyond + radius,
        };
        Point2::new(x, strip.floor + self.sink().to_mm())
    }

    /// How far the part reaches above the edge of a pass, in mm; negative infinity where they do not meet.
    ///
    /// Over a segment of slope `m` the edge is lowest against it at `x_c + R m / sqrt(m^2 + sin^2(lead))` *(derived here)*.
    #[must_use]
    pub fn entry(&self, part: &Profile, centre: Point2) -> f64 {
        let (radius, sine) = (self.radius.to_mm(), self.lead.sin());
        let (from, to) = (centre.x - radius, centre.x + radius);
        let points = part.points();
        let first = points.partition_point(|point| point.x <= from).saturating_sub(1);
        let last = points.partition_point(|point| point.x < to) + 1;
        let within = points.get(first..last.min(points.len())).unwrap_or_default();
        let mut deepest = f64::NEG_INFINITY;
        for pair in within.windows(2) {
            let [one, other] = pair else { continue };
            let (start, end) = (one.x.max(from), other.x.min(to));
            if start > end {
                continue;
            }
            let slope = (other.z - one.z) / (other.x - one.x);
            let steepness = (slope * slope + sine * sine).sqrt();
            let lowest = if steepness > 0.0 {
                centre.x + radius * slope / steepness
            } else {
                centre.x
            };
            for x in [start, lowest.clamp(start, end), end] {
                let off = x - centre.x;
                let edge = centre.z - sine * (radius * radius - off * off).max(0.0).sqrt();
                deepest = deepest.max(part.height(x) - edge);
            }
        }
        deepest
    }
}

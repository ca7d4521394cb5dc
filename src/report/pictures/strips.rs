//! Cuts of a plan as the picture of a lattice shows them: tips by origin, slits, strips, and the disc at one strip of each layer.

use super::pair;
use vcutc_geometry::curve::Point2;
use vcutc_job::PlannedJob;
use vcutc_job::planned::{CutShape, PlannedStrip, PlannedTip, TipOrigin};
use vcutc_picture::lattice::{Origin, Tip};
use vcutc_picture::strips::{Access, Disc, Slit, Strip, Strips};
use vcutc_simulation::surface::Side;

/// The cuts.
#[derive(Default)]
pub(super) struct Rectangles {
    /// Tips, and of strips the marks of their origin.
    pub(super) tips: Vec<Tip>,
    slits: Vec<Slit>,
    strips: Vec<Strip>,
    discs: Vec<Disc>,
}

/// How high in its strip the mark of its origin is.
const MARK: f64 = 0.2;

impl Rectangles {
    pub(super) fn of(plan: &PlannedJob) -> Self {
        let mut all = Self::default();
        for planned in &plan.operations {
            for layer in planned.tips().chunk_by(|a, b| a.layer == b.layer) {
                all.layer(layer, plan.stock.width.to_mm());
            }
        }
        all
    }

    pub(super) fn shown(&self) -> Strips<'_> {
        Strips {
            slits: &self.slits,
            strips: &self.strips,
            discs: &self.discs,
        }
    }

    fn layer(&mut self, cuts: &[PlannedTip], width: f64) {
        for (number, cut) in (1..).zip(cuts) {
            let mut origin = origin(cut.origin);
            let at = match cut.shape {
                CutShape::Plain | CutShape::Narrowed { .. } => cut.tip,
                CutShape::Track { contact, .. } => {
                    origin = Origin::Track;
                    contact
                }
                CutShape::Slit { top } => {
                    self.slits.push(Slit {
                        x: cut.tip.x,
                        z: [cut.tip.z, top],
                    });
                    continue;
                }
                CutShape::Strip(strip) => {
                    self.strips.push(shown(cut.layer, number, &strip));
                    marked(&strip)
                }
            };
            self.tips.push(Tip { at: pair(at), origin });
        }
        self.discs.extend(disc(cuts, width));
    }
}

const fn origin(origin: TipOrigin) -> Origin {
    match origin {
        TipOrigin::Lattice | TipOrigin::Given => Origin::Lattice,
        TipOrigin::Lifted => Origin::Lifted,
        TipOrigin::Shifted => Origin::Shifted,
        TipOrigin::Relieved => Origin::Relieved,
    }
}

fn shown(layer: u32, number: u32, strip: &PlannedStrip) -> Strip {
    Strip {
        layer,
        number,
        low: pair(strip.low),
        high: pair(strip.high),
        access: match strip.open {
            Side::Left => Access::Left,
            Side::Right => Access::Right,
        },
    }
}

fn marked(strip: &PlannedStrip) -> Point2 {
    let PlannedStrip { low, high, .. } = *strip;
    Point2::new(low.x.midpoint(high.x), low.z + (high.z - low.z) * MARK)
}

/// The disc at the strip of a layer at which its centre is nearest to the middle of the stock.
fn disc(cuts: &[PlannedTip], width: f64) -> Option<Disc> {
    let strips = cuts.iter().filter_map(|cut| match cut.shape {
        CutShape::Strip(strip) => Some((cut.tip, strip)),
        CutShape::Plain | CutShape::Narrowed { .. } | CutShape::Slit { .. } | CutShape::Track { .. } => None,
    });
    let off = |tip: Point2| (tip.x - width / 2.0).abs();
    let (centre, strip) = strips.min_by(|(one, _), (other, _)| off(*one).total_cmp(&off(*other)))?;
    Some(Disc {
        centre: pair(centre),
        half: [strip.radius, (centre.z - strip.low.z).max(0.0)],
    })
}

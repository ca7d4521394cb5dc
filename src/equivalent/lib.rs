//! Equivalent tools: bodies of revolution that stand for the blades of a job in programs for milling.
//!
//! CAM and its simulations know tools that turn about their axis. A straight blade does not turn, and a disc has no body that
//! crushes the chip, so each is replaced by a solid that sweeps what matters of it:
//!
//! | Blade | Stands in its place | Source |
//! | --- | --- | --- |
//! | straight | a cylinder as wide as the blade's bottom edge, `L0 = 2 L sin(beta)`, and as high as its edges, `L cos(beta)` | [Yang fig. 1] |
//! | straight, in V cuts | a cone of twice the swing, as high as the V that the whole edge cuts, `L sin(theta - beta) cos(alpha)` | [Cui II.D] for the angle; the height from [Cui 2] |
//! | disc | a cylinder of the disc's diameter that crushes up to `depth` | [Yang fig. 2] |
//! | crusher | itself: it is a cylinder | |
//!
//! The tip of a tool is its lowest point on the axis, and heights count from there along the axis: of a straight blade from the
//! point where its edges meet, of the others from the plane of their edge. Lengths in mm, angles in deg where they are written.

pub mod apt;
pub mod facets;
pub mod table;
pub mod tool_bit;

use vcutc_backend_api::units::{Angle, AngularSpeed, Length};
use vcutc_job::{BladeRef, Body, PlannedJob, StraightBlade};

/// A solid about the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solid {
    /// With a flat end.
    Cylinder {
        /// Positive.
        radius: Length,
        /// Positive.
        height: Length,
    },
    /// With its apex in the tip.
    Cone {
        /// Half the apex angle; above 0 and below 90 degrees.
        half_angle: Angle,
        /// Positive.
        height: Length,
    },
}

impl Solid {
    /// The largest radius.
    #[must_use]
    pub fn radius(self) -> Length {
        match self {
            Self::Cylinder { radius, .. } => radius,
            Self::Cone { half_angle, height } => height * half_angle.tan(),
        }
    }

    /// From the tip along the axis.
    #[must_use]
    pub const fn height(self) -> Length {
        match self {
            Self::Cylinder { height, .. } | Self::Cone { height, .. } => height,
        }
    }
}

/// What a solid stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A straight blade, for interference checks and for removal as far as a milling program shows it.
    Dagger,
    /// The V that a straight blade cuts in an operation, counted from 1.
    Groove {
        /// The operation.
        operation: usize,
    },
    /// A disc, with what it lifts off crushed.
    Disc,
    /// A crusher, as it is.
    Crusher,
}

impl Role {
    /// Where the rule is from.
    #[must_use]
    pub const fn source(self) -> &'static str {
        match self {
            Self::Dagger => "[Yang fig. 1]",
            Self::Groove { .. } => "[Cui II.D]",
            Self::Disc => "[Yang fig. 2]",
            Self::Crusher => "the blade itself",
        }
    }

    /// What the solid does not say of the blade.
    #[must_use]
    pub const fn note(self) -> Option<&'static str> {
        match self {
            Self::Dagger => Some(
                "the cylinder lacks the plane of the blade: a path for it does not say which way the blade is turned",
            ),
            Self::Groove { .. } => {
                Some("it cuts both flanks of the V at once, upright; the blade cuts one, leaning")
            }
            Self::Disc => Some("it crushes what the disc lifts off whole"),
            Self::Crusher => None,
        }
    }
}

/// A tool that stands for a blade.
#[derive(Clone, Debug, PartialEq)]
pub struct Equivalent {
    /// Its name, of the blade's and of what it is.
    pub name: String,
    /// The blade.
    pub blade: String,
    pub solid: Solid,
    pub role: Role,
    /// What carries it, where the job states the body of the blade.
    pub shank: Option<Shank>,
    /// How fast the blade spins; none where it does not.
    pub spin: Option<AngularSpeed>,
}

/// What carries a tool: the stage of the blade's body above its solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shank {
    /// Positive.
    pub radius: Length,
    /// Where the last stage of the body begins, above the tip: the holder, where there are several stages.
    pub holder: Option<Length>,
}

/// The tools of a job.
#[derive(Clone, Debug, PartialEq)]
pub struct Equivalents {
    /// In the order in which the job's operations take the blades.
    pub tools: Vec<Equivalent>,
    /// Blades without a width, which no body of revolution stands for.
    pub flat: Vec<String>,
}

/// The tools that stand for the blades of a job. A cone needs the swing that was planned.
#[must_use]
pub fn of(plan: &PlannedJob) -> Equivalents {
    let mut all = Equivalents {
        tools: Vec::new(),
        flat: Vec::new(),
    };
    for (number, planned) in (1..).zip(&plan.operations) {
        for blade in planned.asked().blades() {
            match blade {
                BladeRef::Straight(straight) => {
                    all.add_dagger(straight);
                    let held = Held {
                        rake: planned.asked().setup().rake.value,
                        swing: planned.swing(),
                    };
                    all.add_groove(straight, held, number);
                }
                BladeRef::Disc(disc) => {
                    let solid = Solid::Cylinder {
                        radius: disc.radius.value,
                        height: disc.depth.value,
                    };
                    all.add(Equivalent {
                        name: format!("{}_crushing", disc.name),
                        blade: disc.name.clone(),
                        solid,
                        role: Role::Disc,
                        shank: shank(Some(&disc.body), solid),
                        spin: Some(disc.spin.value),
                    });
                }
                BladeRef::Crusher(crusher) => {
                    let solid = Solid::Cylinder {
                        radius: crusher.radius.value,
                        height: crusher.height.value,
                    };
                    all.add(Equivalent {
                        name: crusher.name.clone(),
                        blade: crusher.name.clone(),
                        solid,
                        role: Role::Crusher,
                        shank: shank(crusher.body.as_ref(), solid),
                        spin: Some(crusher.spin.value),
                    });
                }
            }
        }
    }
    all
}

/// How an operation holds a straight blade.
#[derive(Clone, Copy)]
struct Held {
    rake: Angle,
    swing: Angle,
}

impl Equivalents {
    fn add_dagger(&mut self, blade: &StraightBlade) {
        let Some(solid) = dagger(blade.cutting_length.value, blade.half_apex.value) else {
            if !self.flat.contains(&blade.name) {
                self.flat.push(blade.name.clone());
            }
            return;
        };
        self.add(Equivalent {
            name: format!("{}_cylinder", blade.name),
            blade: blade.name.clone(),
            solid,
            role: Role::Dagger,
            shank: shank(blade.body.as_ref(), solid),
            spin: None,
        });
    }

    /// Operations that hold the blade alike share a cone, and slits have none.
    fn add_groove(&mut self, blade: &StraightBlade, held: Held, operation: usize) {
        let Some(solid) = groove(blade.cutting_length.value, blade.half_apex.value, held) else {
            return;
        };
        let is_there = |tool: &Equivalent| tool.blade == blade.name && tool.solid == solid;
        if self.tools.iter().any(is_there) {
            return;
        }
        self.add(Equivalent {
            name: format!("{}_cone_{operation}", blade.name),
            blade: blade.name.clone(),
            solid,
            role: Role::Groove { operation },
            shank: shank(blade.body.as_ref(), solid),
            spin: None,
        });
    }

    fn add(&mut self, tool: Equivalent) {
        if !self.tools.iter().any(|there| there.name == tool.name) {
            self.tools.push(tool);
        }
    }
}

/// The cylinder of a straight blade [Yang fig. 1]; none where both its edges lie on its axis.
fn dagger(cutting_length: Length, half_apex: Angle) -> Option<Solid> {
    let radius = cutting_length * half_apex.sin();
    (radius > Length::ZERO).then(|| Solid::Cylinder {
        radius,
        height: cutting_length * half_apex.cos(),
    })
}

/// The cone of a V [Cui II.D], as high as the whole edge reaches [Cui 2]; none of a slit.
fn groove(cutting_length: Length, half_apex: Angle, held: Held) -> Option<Solid> {
    let height = cutting_length * ((held.rake - half_apex).sin() * held.swing.cos());
    (held.swing > Angle::ZERO && height > Length::ZERO).then_some(Solid::Cone {
        half_angle: held.swing,
        height,
    })
}

/// The stage of a body that begins highest at or below the top of a solid, or else its first one.
fn shank(body: Option<&Body>, solid: Solid) -> Option<Shank> {
    let stages = &body?.stages;
    let (first, last) = (stages.first()?, stages.last()?);
    let at_top = stages
        .iter()
        .rev()
        .find(|stage| stage.from.value <= solid.height())
        .unwrap_or(first);
    Some(Shank {
        radius: at_top.radius.value,
        holder: (last.from.value > solid.height()).then_some(last.from.value),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const BETA: f64 = 7.13;

    /// The figure of [Yang fig. 1] for an edge of 40 mm: 9.930 mm; as high as the edge is along the axis.
    #[test]
    fn a_dagger_is_as_wide_as_its_bottom_edge() {
        let solid = dagger(Length::mm(40.0), Angle::deg(BETA)).unwrap();
        assert!((2.0 * solid.radius().to_mm() - 9.930).abs() < 5e-4, "{solid:?}");
        // Edge, half width and height are a right triangle.
        let square =
            solid.radius().to_mm() * solid.radius().to_mm() + solid.height().to_mm() * solid.height().to_mm();
        assert!((square - 1600.0).abs() < 1e-9);
    }

    /// The edge of [Yu], 12.543 mm at 60 degrees, reaches 10 mm deep: 8.660 mm at a swing of 30 degrees, 5 mm to each side.
    #[test]
    fn a_groove_is_as_deep_as_the_whole_edge_cuts() {
        let held = Held {
            rake: Angle::deg(60.0),
            swing: Angle::deg(30.0),
        };
        let solid = groove(Length::mm(12.543), Angle::deg(BETA), held).unwrap();
        assert!((solid.height().to_mm() - 8.660).abs() < 1e-3, "{solid:?}");
        assert!((solid.radius().to_mm() - 5.0).abs() < 1e-3, "{solid:?}");
    }

    #[test]
    fn flat_blades_and_slits_have_none() {
        assert_eq!(dagger(Length::mm(40.0), Angle::ZERO), None);
        let slit = Held {
            rake: Angle::deg(60.0),
            swing: Angle::ZERO,
        };
        assert_eq!(groove(Length::mm(40.0), Angle::deg(BETA), slit), None);
    }
}

//! What the axes of an arm need all along the program, in the places of `--emit dynamics`.

use super::clock::Clock;
use crate::Material;
use core::convert::Infallible;
use vcutc_backend_api::ir::OpId;
use vcutc_diagnostics::number::{rounded, show};
use vcutc_driver::dynamics::in_places;
use vcutc_dynamics::figures::{AxisTorque, Cutting, LookedAt, Reliance, TorqueFigures};
use vcutc_dynamics::places::{Place, Places};
use vcutc_motion::trajectory::Spacing;
use vcutc_picture::over_time::COLUMNS;
use vcutc_picture::thin::Thinned;
use vcutc_picture::{Prefix, torques};

/// The same picture for several places of a page, and what of it is proven.
#[derive(Clone, Debug)]
pub struct Torques<const PLACES: usize> {
    pub pictures: [String; PLACES],
    pub caption: String,
}

/// Torques over time (`picture::torques`); none where they are not known.
#[must_use]
pub fn torques<const PLACES: usize>(
    material: &Material<'_>,
    ids: [Prefix; PLACES],
) -> Option<Torques<PLACES>> {
    let figures = material.compiled.dynamics.torques.as_ref()?;
    let reached = material.compiled.program.reached()?;
    let clock = Clock::of(material);
    in_places(material.job, reached, &material.compiled.report, |places| {
        let axes = axes(places, figures, &clock);
        let title = format!("{}: torques over time", material.plan.name);
        let subtitle = format!("{}; {}", places.known().model.name, figures.backing());
        let course = clock.course();
        let draw = |ids| {
            torques::draw(&torques::Torques {
                heading: torques::Heading {
                    ids,
                    title: &title,
                    subtitle: &subtitle,
                },
                course: &course,
                axes: &axes,
                allowed: figures.allowed,
            })
        };
        Torques {
            pictures: ids.map(draw),
            caption: caption(places, figures, clock.spacing()),
        }
    })
}

fn axes(places: &Places<'_>, figures: &TorqueFigures, clock: &Clock) -> Vec<torques::Axis> {
    let mut curves = Curves::new(figures.axes.len(), clock);
    let taken = places.along(&clock.spacing(), |place| {
        curves.take(place, clock);
        Ok::<(), Infallible>(())
    });
    match taken {
        Ok(()) => {}
        Err(never) => match never {},
    }
    let axes = figures.axes.iter().zip(curves.each);
    axes.map(|(axis, curve)| shown(axis, curve.finish(), figures, clock))
        .collect()
}

fn shown(axis: &AxisTorque, values: Vec<[f64; 2]>, figures: &TorqueFigures, clock: &Clock) -> torques::Axis {
    let most = match figures.looked_at {
        LookedAt::Everywhere | LookedAt::AfterStart => Some(axis.most),
        LookedAt::Places => None,
    };
    let time = axis.done.map(|done| clock.time(OpId(axis.at.op), done));
    torques::Axis {
        name: axis.name.clone(),
        limit: axis.limit,
        values,
        most,
        peak: time
            .zip(most)
            .map(|(time, most)| [time, most.copysign(axis.torque)]),
    }
}

/// What of the picture is proven, and how far one may rely on it.
fn caption(places: &Places<'_>, figures: &TorqueFigures, spacing: Spacing) -> String {
    let forces = match (places.have_forces(), figures.cutting) {
        (false, _) => "the weight of the arm and its motion, without cutting forces",
        (true, Cutting::InPart) => {
            "the weight of the arm, its motion, and the forces of those blades that state them, as stated"
        }
        (true, Cutting::Counted | Cutting::NotKnown) => {
            "the weight of the arm, its motion, and the forces of the blade as stated"
        }
    };
    let proven = match (figures.looked_at, places.have_forces()) {
        (LookedAt::Places, _) => "Nothing is proven between these places.".to_owned(),
        (looked_at, forces) => {
            let start = match looked_at {
                LookedAt::AfterStart => ", but for the first motion, whose start is not known",
                LookedAt::Everywhere | LookedAt::Places => "",
            };
            let spread = if forces {
                ", whatever the forces within their spread"
            } else {
                ""
            };
            format!(
                "The bound (\"at most\", and the mark) is proven: it holds between them, too{start}{spread}."
            )
        }
    };
    let is_coarse = figures.axes.iter().any(|axis| axis.done.is_none());
    let coarse = if is_coarse {
        " Where an axis needs next to nothing, its bound is coarse and has no mark."
    } else {
        ""
    };
    let reliance = match figures.reliance() {
        Reliance::Sound => String::new(),
        Reliance::Indicative => format!(" Indicative: {}.", figures.backing()),
    };
    format!(
        "Torques of the axes at programmed speeds: {forces}. The curve joins places at most {} mm of the tip's way or {} deg of \
         turning apart. {proven}{coarse}{reliance}",
        show(spacing.way),
        show(spacing.turn.to_degrees().round()),
    )
}

/// Curves of all axes under construction, thinned as they grow.
struct Curves {
    each: Vec<Thinned>,
    /// The place before: when that is, and what the axes need to stand still there.
    before: Option<(f64, [f64; 6])>,
}

impl Curves {
    fn new(axes: usize, clock: &Clock) -> Self {
        let curve = |_| Thinned::new(0.0, clock.total(), COLUMNS);
        Self {
            each: (0..axes).map(curve).collect(),
            before: None,
        }
    }

    fn take(&mut self, place: &Place, clock: &Clock) {
        let (op, torques) = (place.sample.op, &place.torques);
        // Where the arm waits between two motions, it stands still.
        let begins = clock.time(op, 0.0);
        if let Some((time, weight)) = self.before.filter(|(time, _)| *time < begins) {
            self.push(time, |axis| weight.get(axis).copied().unwrap_or_default());
            self.push(begins, |axis| weight.get(axis).copied().unwrap_or_default());
        }
        let time = clock.time(op, place.sample.done);
        self.push(time, |axis| torques.of(axis));
        self.before = Some((time, torques.weight));
    }

    fn push(&mut self, time: f64, torque: impl Fn(usize) -> f64) {
        for (axis, curve) in self.each.iter_mut().enumerate() {
            // To a thousandth, as in the table: what is less is noise of the arithmetic.
            curve.push([time, rounded(torque(axis), 1e3)]);
        }
    }
}

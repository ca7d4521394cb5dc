//! Where the axes are all along the program.
//!
//! Within an op the axes are taken to go on evenly in time. Rates are those at the programmed speeds, as the proof of reach
//! takes them: what the axes do between two samples, over the time that the motion takes for it without speeding up and
//! slowing down.

use super::clock::Clock;
use crate::Material;
use core::convert::Infallible;
use vcutc_backend_api::ir::{Axis, AxisKind, OpId};
use vcutc_machine::kinematics::Joints;
use vcutc_motion::axis_range::axis_margin;
use vcutc_motion::figures::AxisFigure;
use vcutc_motion::rigs::Rigs;
use vcutc_motion::summary::margin_words;
use vcutc_motion::trajectory::{Sample, trajectory};
use vcutc_picture::over_time::COLUMNS;
use vcutc_picture::thin::Thinned;
use vcutc_picture::{Prefix, joints};

/// Angles, rates and margins of the axes over time (`picture::joints`); none for a job without a machine.
#[must_use]
pub fn joints(material: &Material<'_>, ids: Prefix) -> Option<String> {
    let [picture] = drawn(material, [ids])?;
    Some(picture)
}

/// The same in two places: the axes are followed once.
#[must_use]
pub fn joints_twice(material: &Material<'_>, ids: [Prefix; 2]) -> Option<[String; 2]> {
    drawn(material, ids)
}

fn drawn<const PLACES: usize>(material: &Material<'_>, places: [Prefix; PLACES]) -> Option<[String; PLACES]> {
    let reached = material.compiled.program.reached()?;
    let program = reached.program.program();
    let (machine, cell) = (material.job.machine.as_ref()?, program.cell.as_ref()?);
    let clock = Clock::of(material);
    let home = cell.home.map(|home| home.0);
    let mut curves = Curves::new(&cell.axes, &clock, home);
    let spacing = clock.spacing();
    let rigs = Rigs::of(&machine.model, cell, program);
    let taken = trajectory(&reached.program, &rigs, &spacing, |sample| {
        curves.take(&sample, &clock);
        Ok::<(), Infallible>(())
    });
    match taken {
        Ok(()) => {}
        Err(never) => match never {},
    }
    let figures = material.compiled.figures.as_ref();
    let (axes, margin) = curves.finish(figures.map_or(&[], |figures| &figures.axes));
    let least = figures.map_or(String::new(), |figures| {
        format!(
            "; least margin {} ({})",
            margin_words(figures.margin),
            figures.least.of
        )
    });
    let title = format!("{}: axes over time", material.plan.name);
    let subtitle = format!("{}{least}", cell.model);
    let course = clock.course();
    let draw = |ids| {
        joints::draw(&joints::Joints {
            heading: joints::Heading {
                ids,
                title: &title,
                subtitle: &subtitle,
            },
            course: &course,
            axes: &axes,
            margin: &margin,
        })
    };
    Some(places.map(draw))
}

/// Curves of all axes under construction, thinned as they grow: programs have millions of samples.
struct Curves<'a> {
    axes: &'a [Axis],
    values: Vec<Thinned>,
    rates: Vec<Thinned>,
    margin: Thinned,
    before: Option<(OpId, f64, Joints)>,
}

impl<'a> Curves<'a> {
    fn new(axes: &'a [Axis], clock: &Clock, home: Option<Joints>) -> Self {
        let curve = || Thinned::new(0.0, clock.total(), COLUMNS);
        let mut curves = Self {
            axes,
            values: axes.iter().map(|_| curve()).collect(),
            rates: axes.iter().map(|_| curve()).collect(),
            margin: curve(),
            before: None,
        };
        if let Some(home) = home {
            curves.place(0.0, &home);
            curves.before = Some((OpId(0), 1.0, home));
        }
        curves
    }

    /// The axes at a time.
    fn place(&mut self, time: f64, values: &Joints) {
        let mut least = 1.0_f64;
        for ((axis, &value), curve) in self.axes.iter().zip(values).zip(&mut self.values) {
            curve.push([time, shown(axis, value)]);
            least = least.min(axis_margin(axis, value, value));
        }
        self.margin.push([time, least]);
    }

    fn take(&mut self, sample: &Sample, clock: &Clock) {
        let (op, done) = (sample.op, sample.done);
        let time = clock.time(op, done);
        let began = match self.before {
            Some((before, done, _)) if before == op => done,
            Some(_) | None => 0.0,
        };
        let programmed = clock.programmed(op);
        let seconds = programmed.map_or(0.0, |seconds| seconds * (done - began));
        if let Some((_, _, from)) = self.before {
            let start = clock.time(op, began);
            for (index, (axis, curve)) in self.axes.iter().zip(&mut self.rates).enumerate() {
                let way = (sample.joints[index] - from[index]).abs();
                if let Some(highest) = axis.rate {
                    let share = if seconds > 0.0 {
                        way / seconds / highest
                    } else {
                        0.0
                    };
                    curve.push([start, share]);
                    curve.push([time, share]);
                }
            }
            // The axes stand still until the op begins.
            if began == 0.0 {
                self.place(start, &from);
            }
        }
        self.place(time, &sample.joints);
        self.before = Some((op, done, sample.joints));
    }

    fn finish(self, figures: &[AxisFigure]) -> (Vec<joints::Axis>, Vec<[f64; 2]>) {
        let curves = self.values.into_iter().zip(self.rates);
        let axes = self
            .axes
            .iter()
            .zip(curves)
            .map(|(axis, (values, rates))| joints::Axis {
                name: axis.name.clone(),
                unit: match axis.kind {
                    AxisKind::Rotary => "deg",
                    AxisKind::Linear => "mm",
                },
                limits: [shown(axis, axis.min), shown(axis, axis.max)],
                values: values.finish(),
                rates: axis.rate.map(|_| rates.finish()),
                highest_rate: figures
                    .iter()
                    .find(|figure| figure.name == axis.name)
                    .and_then(AxisFigure::rate_share)
                    .filter(|share| share.is_finite()),
            });
        (axes.collect(), self.margin.finish())
    }
}

/// A value in deg or mm.
fn shown(axis: &Axis, value: f64) -> f64 {
    match axis.kind {
        AxisKind::Rotary => value.to_degrees(),
        AxisKind::Linear => value,
    }
}

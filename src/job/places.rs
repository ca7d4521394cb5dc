//! A job without the places where it is written: what comes of it is the same wherever that is.
//!
//! All places become one; which values were given and which are defaults stays. Tips keep their places: there are as many of
//! them as cuts.

use super::{
    Blade, Bounds, CheckedJob, GivenOption, Limits, Machine, Operation, RoughVcut, Sourced, TargetOptions,
};
use vcutc_diagnostics::source::{SourceMap, Span};

impl CheckedJob {
    /// The same job, written at one place.
    #[must_use]
    pub fn without_places(&self) -> Self {
        let place = Span::of_bytes(SourceMap::default().add("", ""), 0..0);
        let mut job = self.clone();
        job.name_span = place;
        job.stock_span = place;
        job.profile_span = place;
        for operation in &mut job.operations {
            match operation {
                Operation::RoughVcut(asked) => vcut(asked, place),
            }
        }
        if let Some(on) = &mut job.machine {
            machine(on, place);
        }
        job
    }
}

fn sourced<T>(value: &mut Sourced<T>, place: Span) {
    value.span = value.span.map(|_| place);
}

fn optional<T>(value: &mut Option<Sourced<T>>, place: Span) {
    if let Some(value) = value {
        sourced(value, place);
    }
}

fn vcut(asked: &mut RoughVcut, place: Span) {
    asked.head_span = place;
    blade(&mut asked.blade, place);
    limits(&mut asked.limits, place);
    sourced(&mut asked.lattice, place);
    sourced(&mut asked.rake, place);
    sourced(&mut asked.swing, place);
    sourced(&mut asked.layer, place);
    sourced(&mut asked.step, place);
    sourced(&mut asked.overlap, place);
    sourced(&mut asked.objective, place);
    sourced(&mut asked.formulas, place);
    sourced(&mut asked.allowance, place);
    sourced(&mut asked.residual, place);
    sourced(&mut asked.order, place);
    sourced(&mut asked.sequence, place);
    sourced(&mut asked.direction, place);
    sourced(&mut asked.cut_feed, place);
    sourced(&mut asked.travel_feed, place);
    sourced(&mut asked.reorient_rate, place);
    sourced(&mut asked.clearance, place);
    sourced(&mut asked.extension, place);
    sourced(&mut asked.run_out, place);
    sourced(&mut asked.standoff, place);
}

fn blade(blade: &mut Blade, place: Span) {
    blade.span = place;
    sourced(&mut blade.cutting_length, place);
    sourced(&mut blade.half_apex, place);
    sourced(&mut blade.thickness, place);
}

fn limits(limits: &mut Limits, place: Span) {
    bounds(&mut limits.swing, place);
    bounds(&mut limits.layer, place);
    bounds(&mut limits.step, place);
    optional(&mut limits.scallop, place);
    optional(&mut limits.edge, place);
    optional(&mut limits.time, place);
    optional(&mut limits.cuts, place);
}

fn bounds<T>(bounds: &mut Bounds<T>, place: Span) {
    optional(&mut bounds.least, place);
    optional(&mut bounds.most, place);
}

fn machine(machine: &mut Machine, place: Span) {
    machine.head_span = place;
    machine.model_span = place;
    sourced(&mut machine.tool, place);
    sourced(&mut machine.base, place);
    optional(&mut machine.load, place);
    optional(&mut machine.home, place);
    optional(&mut machine.ultrasonic, place);
    sourced(&mut machine.ready, place);
    for target in &mut machine.targets {
        options(target, place);
    }
}

fn options(target: &mut TargetOptions, place: Span) {
    target.span = place;
    if let Some(profile) = &mut target.profile {
        profile.span = place;
    }
    for GivenOption {
        key_span, value_span, ..
    } in &mut target.given
    {
        (*key_span, *value_span) = (place, place);
    }
}

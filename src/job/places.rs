//! A job without the places where it is written: its result is the same wherever that is.
//!
//! All places become one; which values were given and which are defaults stays. Tips keep their places: there are as many of
//! them as cuts.

use super::{Bounds, CheckedJob, GivenOption, Machine, Setup, Sourced, TargetOptions};
use vcutc_diagnostics::source::{SourceMap, Span};

impl CheckedJob {
    /// The same job, written at one place.
    #[must_use]
    pub fn without_places(&self) -> Self {
        let place = Span::of_bytes(SourceMap::default().add("", ""), 0..0);
        let mut job = self.clone();
        job.name_span = place;
        job.stock_span = place;
        if let Some(size) = &mut job.cell_size {
            size.forget_place(place);
        }
        job.part.forget_places(place);
        job.profile_span = place;
        for operation in &mut job.operations {
            setup(operation.setup_mut(), place);
            operation.forget_places(place);
        }
        for choice in &mut job.open {
            for way in choice.ways.iter_mut() {
                setup(way.operation.setup_mut(), place);
                way.operation.forget_places(place);
            }
        }
        if let Some(on) = &mut job.machine {
            machine(on, place);
        }
        job
    }
}

impl<T> Sourced<T> {
    /// Replaces the place of a value that is written by this one.
    pub fn forget_place(&mut self, place: Span) {
        self.span = self.span.map(|_| place);
    }
}

impl<T> Bounds<T> {
    /// As [`Sourced::forget_place`], for both.
    pub fn forget_places(&mut self, place: Span) {
        optional(&mut self.least, place);
        optional(&mut self.most, place);
    }
}

fn optional<T>(value: &mut Option<Sourced<T>>, place: Span) {
    if let Some(value) = value {
        value.forget_place(place);
    }
}

fn setup(setup: &mut Setup, place: Span) {
    setup.head_span = place;
    setup.rake.forget_place(place);
    optional(&mut setup.direction, place);
    setup.cut_feed.forget_place(place);
    setup.travel_feed.forget_place(place);
    setup.reorient_rate.forget_place(place);
    setup.clearance.forget_place(place);
    optional(&mut setup.extension, place);
    setup.run_out.forget_place(place);
}

fn machine(machine: &mut Machine, place: Span) {
    machine.head_span = place;
    machine.model_span = place;
    machine.limit_spans.clear();
    machine.tools.forget_places(place);
    if let Some(change) = &mut machine.change {
        change.span = place;
    }
    machine.base.forget_place(place);
    optional(&mut machine.home, place);
    optional(&mut machine.ultrasonic, place);
    optional(&mut machine.spindle, place);
    machine.ready.forget_place(place);
    optional(&mut machine.gravity, place);
    optional(&mut machine.torque_limit, place);
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

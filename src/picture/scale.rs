//! How values become places along a direction of a picture, and which values are written beside it.

use super::trace::number;

/// A stretch of values laid along a stretch of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// The values at both ends; the second is greater.
    pub(super) values: [f64; 2],
    /// Where these are in the picture.
    pub(super) places: [f64; 2],
    form: Form,
}

/// What a scale is of, and how its values are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// Numbers, evenly.
    Numbers,
    /// Times in s, evenly, written as on a clock.
    Clock,
    /// Times in s: a time twice as long is always as far away.
    Factors,
}

impl Scale {
    /// Lays values along places. Values that do not ascend are widened.
    pub(super) fn new(values: [f64; 2], places: [f64; 2]) -> Self {
        Self::of_form(Form::Numbers, values, places)
    }

    /// Lays times in s along places.
    pub(super) fn clock(values: [f64; 2], places: [f64; 2]) -> Self {
        Self::of_form(Form::Clock, values, places)
    }

    /// Lays times in s, which are longer than none, along places by factors.
    pub(super) fn factors(values: [f64; 2], places: [f64; 2]) -> Self {
        Self::of_form(Form::Factors, values, places)
    }

    fn of_form(form: Form, [from, to]: [f64; 2], places: [f64; 2]) -> Self {
        let to = if to > from { to } else { from + 1.0 };
        Self {
            values: [from, to],
            places,
            form,
        }
    }

    /// Where a value is.
    pub(super) fn at(&self, value: f64) -> f64 {
        let [from, to] = self.values.map(|value| self.spread(value));
        let share = (self.spread(value) - from) / (to - from);
        self.places[0] + (self.places[1] - self.places[0]) * share
    }

    fn spread(&self, value: f64) -> f64 {
        match self.form {
            Form::Numbers | Form::Clock => value,
            Form::Factors => libm::log(value),
        }
    }

    /// Places to a unit, taken positive.
    pub(super) fn per_unit(&self) -> f64 {
        (self.length() / (self.values[1] - self.values[0])).abs()
    }

    /// How long it is in the picture.
    pub(super) fn length(&self) -> f64 {
        (self.places[1] - self.places[0]).abs()
    }

    /// Round values within that leave each other so much room, and how they are written.
    pub(super) fn ticks(&self, room: f64) -> Vec<(f64, String)> {
        let most = ((self.length() / room) as u32).max(1);
        match self.form {
            Form::Numbers => self.numbers(most),
            Form::Clock => self.times(most),
            Form::Factors => self.apart(room),
        }
    }

    /// What is written beside times.
    pub(super) fn time_label(&self) -> &'static str {
        match self.values[1] {
            most if most <= 60.0 => "time, s",
            most if most < 3600.0 => "time, min:s",
            _ => "time, h:min:s",
        }
    }

    fn numbers(&self, most: u32) -> Vec<(f64, String)> {
        let step = round_step((self.values[1] - self.values[0]) / f64::from(most));
        // Adding zero turns a negative zero into zero.
        let values = self.steps(step.size, most).map(|count| count * step.size + 0.0);
        values.map(|value| (value, step.words(value))).collect()
    }

    /// The multiples of a step within.
    fn steps(&self, step: f64, most: u32) -> impl Iterator<Item = f64> + use<> {
        let [from, to] = self.values;
        let first = (from / step).ceil();
        let counts = (0..=most).map(move |tick| first + f64::from(tick));
        counts.take_while(move |count| count * step <= to + step * 1e-9)
    }

    /// At most this many steps of a round number of seconds, minutes or hours.
    fn times(&self, most: u32) -> Vec<(f64, String)> {
        const STEPS: [f64; 22] = [
            0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 900.0, 1800.0, 3600.0,
            7200.0, 14_400.0, 28_800.0, 86_400.0, 172_800.0, 432_000.0,
        ];
        let [from, to] = self.values;
        let least = (to - from) / f64::from(most) * (1.0 - 1e-9);
        match STEPS.into_iter().find(|step| *step >= least) {
            Some(step) if to > 60.0 => {
                let shown = |count: f64| (count * step, clock_words(count * step, to >= 3600.0));
                self.steps(step, most).map(shown).collect()
            }
            Some(_) | None => self.numbers(most),
        }
    }

    /// Round times that do not come too close to each other: those of the roundest kind come first.
    fn apart(&self, room: f64) -> Vec<(f64, String)> {
        const ROUND: [f64; 47] = [
            0.1, 1.0, 10.0, 60.0, 600.0, 3600.0, 36e3, 36e4, 36e5, 36e6, 36e7, //
            0.5, 5.0, 30.0, 300.0, 1800.0, 18e3, 18e4, 18e5, 18e6, 18e7, //
            0.2, 2.0, 20.0, 120.0, 1200.0, 7200.0, 72e3, 72e4, 72e5, 72e6, //
            0.3, 3.0, 15.0, 40.0, 90.0, 180.0, 240.0, 420.0, 900.0, 2400.0, 10_800.0, 14_400.0, 28_800.0,
            108e3, 144e3, 108e4,
        ];
        let mut ticks: Vec<f64> = Vec::new();
        for time in ROUND {
            let is_apart = |other: &f64| (self.at(*other) - self.at(time)).abs() >= room;
            if (self.values[0]..=self.values[1]).contains(&time) && ticks.iter().all(is_apart) {
                ticks.push(time);
            }
        }
        ticks.sort_by(f64::total_cmp);
        ticks.into_iter().map(|time| (time, time_words(time))).collect()
    }
}

/// A round time as people say it: `30 s`, `2 min`, `5 h`.
fn time_words(seconds: f64) -> String {
    match seconds {
        hours if hours >= 3600.0 => format!("{} h", number(hours / 3600.0)),
        minutes if minutes >= 60.0 => format!("{} min", number(minutes / 60.0)),
        seconds => format!("{} s", number(seconds)),
    }
}

/// `2:30`, or `1:02:30` where there are hours.
fn clock_words(seconds: f64, has_hours: bool) -> String {
    let whole = seconds.round() as u64;
    let (hours, minutes, rest) = (whole / 3600, whole / 60 % 60, whole % 60);
    if has_hours {
        format!("{hours}:{minutes:02}:{rest:02}")
    } else {
        format!("{minutes}:{rest:02}")
    }
}

/// A round step: 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// Its size.
    pub(super) size: f64,
    decimals: usize,
}

impl Step {
    /// A multiple of it, with as many decimals as it has itself.
    pub(super) fn words(self, value: f64) -> String {
        let decimals = self.decimals;
        // Adding zero turns a negative zero into zero.
        format!("{:.decimals$}", value + 0.0)
    }
}

/// Powers of ten, of which the first six have decimals.
const POWERS: [f64; 16] = [
    1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9,
];

/// The least round step that is no smaller than a value.
pub(super) fn round_step(least: f64) -> Step {
    let steps = POWERS.into_iter().enumerate().flat_map(|(index, power)| {
        [1.0, 2.0, 5.0].map(|digit| Step {
            size: digit * power,
            decimals: 6_usize.saturating_sub(index),
        })
    });
    let mut fitting = steps.filter(|step| step.size >= least * (1.0 - 1e-9));
    fitting.next().unwrap_or(Step {
        size: 1e9,
        decimals: 0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(scale: &Scale, most: u32) -> Vec<String> {
        let ticks = scale.ticks(scale.length() / f64::from(most));
        ticks.into_iter().map(|(_, text)| text).collect()
    }

    fn shown(values: [f64; 2], most: u32) -> Vec<String> {
        words(&Scale::new(values, [0.0, 100.0]), most)
    }

    #[test]
    fn ticks_are_round_and_few() {
        assert_eq!(shown([0.0, 85.0], 6), ["0", "20", "40", "60", "80"]);
        assert_eq!(shown([0.0, 0.5], 5), ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(shown([-185.0, 185.0], 4), ["-100", "0", "100"]);
        assert_eq!(shown([3.0, 3.0], 2), ["3.0", "3.5", "4.0"]);
        assert_eq!(shown([0.0, 12_345.0], 5), ["0", "5000", "10000"]);
    }

    #[test]
    fn times_are_written_as_on_a_clock() {
        let shown = |to, most| {
            let clock = Scale::clock([0.0, to], [0.0, 100.0]);
            (words(&clock, most).join(" "), clock.time_label())
        };
        assert_eq!(shown(45.0, 3), ("0 20 40".to_owned(), "time, s"));
        assert_eq!(shown(150.0, 3), ("0:00 1:00 2:00".to_owned(), "time, min:s"));
        assert_eq!(
            shown(211.0, 8),
            (
                "0:00 0:30 1:00 1:30 2:00 2:30 3:00 3:30".to_owned(),
                "time, min:s"
            )
        );
        assert_eq!(
            shown(13_356.0, 4),
            ("0:00:00 1:00:00 2:00:00 3:00:00".to_owned(), "time, h:min:s")
        );
    }

    #[test]
    fn values_are_laid_along_places() {
        let upwards = Scale::new([0.0, 50.0], [300.0, 100.0]);
        assert_eq!(
            (upwards.at(0.0), upwards.at(25.0), upwards.per_unit()),
            (300.0, 200.0, 4.0)
        );
    }

    #[test]
    fn times_of_every_size_have_words_beside_them() {
        const APART: f64 = 24.0;
        let ticks = |least: f64, most: f64| {
            let scale = Scale::factors([least, most], [0.0, 340.0]);
            let ticks = scale.ticks(APART);
            let places: Vec<f64> = ticks.iter().map(|(time, _)| scale.at(*time)).collect();
            let are_apart = |pair: &[f64]| pair[1] - pair[0] >= APART - 1e-9;
            assert!(places.windows(2).all(are_apart));
            assert!(!ticks.is_empty(), "{least} to {most}: {ticks:?}");
            ticks
                .into_iter()
                .map(|(_, words)| words)
                .collect::<Vec<_>>()
                .join(", ")
        };
        assert_eq!(
            ticks(179.0, 311_000.0),
            "5 min, 10 min, 30 min, 1 h, 2 h, 5 h, 10 h, 20 h, 50 h"
        );
        let mut least = 0.5;
        while least < 1e6 {
            for factor in [2.6, 7.0, 1e3] {
                let _ = ticks(least / 1.1, least * factor);
            }
            least *= 1.7;
        }
    }

    #[test]
    fn a_time_twice_as_long_is_always_as_far_away() {
        let scale = Scale::factors([10.0, 10_000.0], [0.0, 1.0]);
        let step = scale.at(20.0) - scale.at(10.0);
        for time in [15.0, 100.0, 4000.0] {
            assert!((scale.at(2.0 * time) - scale.at(time) - step).abs() < 1e-12);
        }
    }
}

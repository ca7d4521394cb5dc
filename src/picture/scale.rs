//! How values become places along a direction of a picture, and which values are written beside it.

/// A stretch of values laid along a stretch of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// The values at both ends; the second is greater.
    pub(super) values: [f64; 2],
    /// Where these are in the picture.
    pub(super) places: [f64; 2],
}

impl Scale {
    /// Lays values along places. Values that do not ascend are widened.
    pub(super) fn new([from, to]: [f64; 2], places: [f64; 2]) -> Self {
        let to = if to > from { to } else { from + 1.0 };
        Self {
            values: [from, to],
            places,
        }
    }

    pub(super) fn at(&self, value: f64) -> f64 {
        let share = (value - self.values[0]) / (self.values[1] - self.values[0]);
        self.places[0] + (self.places[1] - self.places[0]) * share
    }

    /// Places to a unit, taken positive.
    pub(super) fn per_unit(&self) -> f64 {
        ((self.places[1] - self.places[0]) / (self.values[1] - self.values[0])).abs()
    }

    /// Values in s as times: at most this many steps of a round number of seconds, minutes or hours.
    pub(super) fn clock(&self, most: u32) -> Clock {
        const STEPS: [f64; 22] = [
            0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 900.0, 1800.0, 3600.0,
            7200.0, 14_400.0, 28_800.0, 86_400.0, 172_800.0, 432_000.0,
        ];
        let [from, to] = self.values;
        let least = (to - from) / f64::from(most.max(1));
        let step = STEPS.into_iter().find(|step| *step >= least * (1.0 - 1e-9));
        if to <= 60.0 || step.is_none() {
            return Clock {
                ticks: self.ticks(most),
                label: "time, s",
            };
        }
        let (step, has_hours) = (step.unwrap_or(least), to >= 3600.0);
        let first = (from / step).ceil();
        let ticks = (0..=most)
            .map(|tick| (first + f64::from(tick)) * step)
            .take_while(|value| *value <= to + step * 1e-9);
        Clock {
            ticks: ticks
                .map(|value| (value, clock_words(value, has_hours)))
                .collect(),
            label: if has_hours { "time, h:min:s" } else { "time, min:s" },
        }
    }

    /// Round values within, at most this many steps of them, and how they are written.
    pub(super) fn ticks(&self, most: u32) -> Vec<(f64, String)> {
        let [from, to] = self.values;
        let step = round_step((to - from) / f64::from(most.max(1)));
        let first = (from / step.size()).ceil();
        (0..=most)
            .map(|tick| first + f64::from(tick))
            .map(|count| (count * step.size(), step.shown(count)))
            .take_while(|(value, _)| *value <= to + step.size() * 1e-9)
            .collect()
    }
}

/// Times beside an axis.
pub(super) struct Clock {
    /// Each in s, and as it is written.
    pub(super) ticks: Vec<(f64, String)>,
    /// What they are, with their unit.
    pub(super) label: &'static str,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Step {
    digit: u8,
    power: i8,
}

/// The least round step that is no smaller than a value.
pub(super) fn round_step(least: f64) -> Step {
    let all = (-6..=9_i8).flat_map(|power| [1, 2, 5].map(|digit| Step { digit, power }));
    let mut fitting = all.filter(|step| step.size() >= least * (1.0 - 1e-9));
    fitting.next().unwrap_or(Step { digit: 1, power: 9 })
}

impl Step {
    pub(super) fn size(self) -> f64 {
        let ten = (0..self.power.unsigned_abs()).fold(1.0, |ten, _| ten * 10.0);
        let digit = f64::from(self.digit);
        if self.power < 0 { digit / ten } else { digit * ten }
    }

    /// So many steps, with as many decimals as the step has.
    fn shown(self, count: f64) -> String {
        let decimals = if self.power < 0 {
            self.power.unsigned_abs()
        } else {
            0
        };
        // Adding zero turns a negative zero into zero.
        format!("{:.*}", usize::from(decimals), count * self.size() + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(values: [f64; 2], most: u32) -> Vec<String> {
        let ticks = Scale::new(values, [0.0, 100.0]).ticks(most);
        ticks.into_iter().map(|(_, text)| text).collect()
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
            let clock = Scale::new([0.0, to], [0.0, 100.0]).clock(most);
            let words = clock.ticks.into_iter().map(|(_, text)| text);
            (words.collect::<Vec<_>>().join(" "), clock.label)
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
}

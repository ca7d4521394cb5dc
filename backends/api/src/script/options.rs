//! The options that every dialect takes, under the same keys and within the same bounds: how exact numbers are written, where
//! a program is split, what stands at its head, and how far corners in the air are rounded. A dialect puts them into its
//! table in its own words, because what they mean to people differs.

use crate::backend::{OptionKind, OptionSpec, Options};
use crate::number::FixedDecimal;
use crate::profile::Profile;
use crate::readback::End;
use crate::script::text::TRIMMED;
use crate::units::Length;
use core::num::NonZeroU32;

/// Key of [`decimals`].
pub const DECIMALS: &str = "decimals";
/// Key of [`lines_per_part`].
pub const LINES_PER_PART: &str = "lines_per_part";
/// Key of [`header`].
pub const HEADER: &str = "header";
/// Key of [`approximation`].
pub const APPROXIMATION: &str = "approximation";

/// Decimals of lengths in mm. The plan lies on a grid of a micrometre, so three print it exactly.
#[must_use]
pub const fn decimals(help: &'static str) -> OptionSpec {
    OptionSpec::integer(DECIMALS, (3, 6), 3, help)
}

/// Lines after which a program is split; 0 never splits.
#[must_use]
pub const fn lines_per_part(default: u32, help: &'static str) -> OptionSpec {
    OptionSpec::integer(LINES_PER_PART, (0, 1_000_000), default, help)
}

/// Comment lines at the head of the main program.
#[must_use]
pub const fn header(help: &'static str) -> OptionSpec {
    OptionSpec::lines(HEADER, help)
}

/// How far from a corner in the air it may be rounded; zero stops at every point.
#[must_use]
pub const fn approximation(help: &'static str) -> OptionSpec {
    OptionSpec {
        key: APPROXIMATION,
        kind: OptionKind::Length {
            min: Length::ZERO,
            max: Length::mm(50.0),
            default: Length::ZERO,
        },
        help,
    }
}

/// These options as types.
#[derive(Clone, Copy, Debug)]
pub struct Common<'p> {
    /// Decimals of lengths in mm.
    pub decimals: u8,
    /// Format of lengths in mm.
    pub lengths: FixedDecimal,
    /// Longest body of a part, in lines, when there is a limit.
    pub lines_per_part: Option<NonZeroU32>,
    /// Comment lines at the head.
    pub header: &'p [String],
    /// Rounding of corners in the air, when wanted.
    pub approximation: Option<Length>,
    /// The profile of the machine.
    pub profile: &'p Profile,
}

impl<'p> Common<'p> {
    /// Reads the options of a job.
    #[must_use]
    pub fn read(options: &'p Options) -> Self {
        let decimals = u8::try_from(options.integer(DECIMALS)).unwrap_or(u8::MAX);
        let approximation = options.length(APPROXIMATION);
        Self {
            decimals,
            lengths: FixedDecimal::new(decimals),
            lines_per_part: NonZeroU32::new(options.integer(LINES_PER_PART)),
            header: options.lines(HEADER),
            approximation: (approximation > Length::ZERO).then_some(approximation),
            profile: options.profile(),
        }
    }
}

impl Common<'_> {
    /// How far before a joint of a chain a robot may begin to round it, for a blend. The tip stays within this of both pieces.
    ///
    /// It is rounded down as it is printed, and never the distance of corners in the air: by that [`Self::left`] knows them.
    #[must_use]
    pub fn chain_distance(&self, blend: Length) -> Length {
        let distance = Length::mm(TRIMMED.floored(blend.to_mm()));
        match self.left(distance) {
            End::Rounded => Length::mm(distance.to_mm() - TRIMMED.unit()),
            End::Exact | End::Through { .. } => distance,
        }
    }

    /// How a motion ends that may be left so far before its end: as a corner in the air where that is the approximation of the job, or
    /// else as a joint of a chain.
    #[must_use]
    pub fn left(&self, distance: Length) -> End {
        let in_air = |approximation: Length| TRIMMED.is_near(distance.to_mm(), approximation.to_mm());
        if self.approximation.is_some_and(in_air) {
            End::Rounded
        } else {
            End::Through { within: distance }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::OptionValue;

    const SPECS: &[OptionSpec] = &[
        decimals("decimals"),
        lines_per_part(2500, "lines"),
        header("header"),
        approximation("rounding"),
    ];

    #[test]
    fn nothing_is_rounded_unless_asked_for() {
        let options = Options::defaults(SPECS);
        let common = Common::read(&options);
        assert_eq!(common.approximation, None);
        assert_eq!(common.lengths.decimals(), 3);
        assert_eq!(common.lines_per_part.map(NonZeroU32::get), Some(2500));
    }

    /// Distances of chains differ from those of corners in the air, and are never above the blend.
    #[test]
    fn joints_of_chains_are_not_corners_in_the_air() {
        let mut options = Options::defaults(SPECS);
        let (blend, other) = (Length::mm(2.5), Length::mm(0.123_456_9));
        let through = |within| End::Through { within };
        assert_eq!(Common::read(&options).chain_distance(blend), blend);
        options.set(&SPECS[3], OptionValue::Length(blend)).unwrap();
        let common = Common::read(&options);
        assert_eq!(common.left(blend), End::Rounded);
        let distance = common.chain_distance(blend);
        assert!((2.499_998..2.5).contains(&distance.to_mm()));
        assert_eq!(common.left(distance), through(distance));
        assert_eq!(common.chain_distance(other), Length::mm(0.123_456));
    }

    #[test]
    fn zero_lines_never_split() {
        let mut options = Options::defaults(SPECS);
        options.set(&SPECS[1], OptionValue::Integer(0)).unwrap();
        options
            .set(&SPECS[3], OptionValue::Length(Length::mm(2.5)))
            .unwrap();
        let common = Common::read(&options);
        assert_eq!(common.lines_per_part, None);
        assert_eq!(common.approximation, Some(Length::mm(2.5)));
    }
}

//! What sets the programs of one machine apart from those of others of its kind: data, no logic.
//!
//! A profile cannot add, drop or reorder motions. It stands in a file beside the job (`profile = "shop/gantry.toml"` in the
//! block of a target) and is shared by all jobs of a machine.

use serde::{Deserialize, Serialize};

/// The habits of a machine. What is left open is for the backend, or the options of the job, to say.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct Profile {
    /// Lines put at the head of the main program as they are, behind what the dialect itself demands there.
    #[cfg_attr(
        feature = "schema",
        schemars(inner(length(max = 120), regex(pattern = r"^[ -~]*$")))
    )]
    pub header: Vec<String>,
    /// Lines put at the end of the main program as they are, before the word that ends it.
    #[cfg_attr(
        feature = "schema",
        schemars(inner(length(max = 120), regex(pattern = r"^[ -~]*$")))
    )]
    pub footer: Vec<String>,
    /// Extension of the main program's file, without the dot.
    #[cfg_attr(feature = "schema", schemars(regex(pattern = r"^[A-Za-z0-9]{1,8}$")))]
    pub extension: Option<String>,
    /// Decimals of lengths in mm.
    #[cfg_attr(feature = "schema", schemars(range(min = 3, max = 6)))]
    pub decimals: Option<u8>,
    /// How blocks are numbered, where a dialect numbers them and leaves it open.
    pub line_numbers: Option<LineNumbers>,
    /// Names that programs must not take on this machine, whatever their case.
    #[cfg_attr(
        feature = "schema",
        schemars(inner(regex(pattern = r"^[A-Za-z_][A-Za-z0-9_]{0,63}$")))
    )]
    pub reserved: Vec<String>,
}

/// Numbers of blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LineNumbers {
    /// The first.
    #[cfg_attr(feature = "schema", schemars(range(max = 99_999_999)))]
    pub start: u32,
    /// From one to the next; positive.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 10_000)))]
    pub step: u32,
}

/// Decimals that a profile can ask for.
pub const PROFILE_DECIMALS: core::ops::RangeInclusive<u8> = 3..=6;

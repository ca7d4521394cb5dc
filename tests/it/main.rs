//! Tests across stages, in one binary, one module a subject. Whole programs are mostly those of KRL: without it, what compiles
//! jobs to their end is left out.
#![allow(
    clippy::disallowed_methods,
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    reason = "tests read files, start the compiler, and stop at the first surprise"
)]

mod air;
mod auto;
mod backends_page;
mod blade_changes;
#[cfg(feature = "krl")]
mod ceiling;
mod check;
mod checks;
#[cfg(all(unix, feature = "cli", feature = "gcode", feature = "krl", feature = "rapid"))]
mod chromium;
#[cfg(all(feature = "cli", feature = "krl"))]
mod cli;
mod codes;
#[cfg(feature = "krl")]
mod columns;
#[cfg(all(feature = "cli", feature = "krl"))]
#[path = "../../build/commit.rs"]
mod commit;
#[cfg(all(feature = "krl", feature = "rapid"))]
mod compensation;
mod consistency;
#[cfg(feature = "krl")]
mod convert;
#[cfg(all(feature = "gcode", feature = "krl", feature = "rapid"))]
mod curve;
mod curved;
mod drawn;
mod effort;
#[cfg(feature = "krl")]
mod examples;
mod families;
#[cfg(all(feature = "gcode", feature = "krl", feature = "rapid"))]
mod finish;
#[cfg(all(feature = "gcode", feature = "krl", feature = "rapid"))]
mod finish_surface;
mod fitted;
#[cfg(feature = "krl")]
mod five_axis;
mod fmt;
#[cfg(feature = "krl")]
mod follow;
#[cfg(feature = "krl")]
mod forces;
#[cfg(all(feature = "cli", feature = "krl"))]
mod forces_drawn;
#[cfg(all(feature = "gcode", feature = "krl", feature = "rapid"))]
mod free;
#[cfg(all(feature = "gcode", feature = "krl"))]
mod gcode;
#[cfg(feature = "krl")]
mod help;
#[cfg(feature = "krl")]
mod hostile;
#[cfg(all(feature = "cli", feature = "gcode", feature = "krl", feature = "rapid"))]
mod jobs;
#[cfg(feature = "krl")]
mod kept_surfaces;
mod krl_text;
mod left_out;
#[cfg(all(feature = "krl", feature = "lsp"))]
mod lsp;
#[cfg(feature = "krl")]
mod modes;
#[cfg(feature = "krl")]
mod mutations;
#[cfg(all(feature = "gcode", feature = "krl", feature = "rapid"))]
mod narrower;
mod offers;
mod optimum_table;
mod own_operation;
#[cfg(feature = "krl")]
mod pace;
mod pages;
#[cfg(feature = "krl")]
mod patches;
#[cfg(feature = "krl")]
mod pictures;
#[cfg(feature = "krl")]
mod pipeline;
#[cfg(all(feature = "gcode", feature = "krl", feature = "rapid"))]
mod playback;
mod pocket;
mod pocket_entries;
#[cfg(feature = "krl")]
mod pocket_layers;
mod pocket_traps;
#[cfg(feature = "krl")]
mod process_errors;
mod processes;
#[cfg(feature = "krl")]
mod published;
#[cfg(feature = "krl")]
mod reach;
#[cfg(all(feature = "gcode", feature = "krl", feature = "rapid"))]
mod rect;
mod redundant;
mod referees;
mod repository;
#[cfg(feature = "krl")]
mod round_forces;
mod scallop;
mod schema;
#[cfg(all(feature = "gcode", feature = "krl", feature = "rapid"))]
mod scribe;
mod seen_from_above;
mod segments;
#[cfg(feature = "krl")]
mod serial_arm;
#[cfg(feature = "krl")]
mod shop;
mod skim;
mod slit;
#[cfg(all(feature = "gcode", feature = "krl", feature = "rapid"))]
mod space;
#[cfg(feature = "krl")]
mod spine;
mod status;
#[cfg(feature = "krl")]
mod surfaces;
mod syntax;
#[cfg(feature = "krl")]
mod third_party;
mod tidy;
mod torques;
mod trap;
#[cfg(feature = "krl")]
mod verify;
#[cfg(all(feature = "gcode", feature = "krl", feature = "rapid"))]
mod verify_cells;

//! What the scripts of all dialects have in common: where a program is split into parts, what stands before the line of
//! an op, what the machine is doing between two ops, which corners may be rounded, and the way of text into a sink.
//!
//! A dialect has its own words for all of this, and shares the decisions.

mod dialect;
mod emission;
mod head;
mod listing;
mod options;
mod split;
mod tables;
mod text;
mod writer;

pub use dialect::{Dialect, File, Files, JointMove, JointTarget, LinearMove, Source, ToolChange};
pub use emission::emission;
pub use head::{HeadLine, duration_words, head_lines};
pub use listing::{Layer, Lead, Modal, first_of};
pub use options::{
    APPROXIMATION, Common, DECIMALS, HEADER, LINES_PER_PART, approximation, decimals, header, lines_per_part,
};
pub use split::{Borders, Part, split};
pub use tables::{feed, operation_heading, rate};
pub use text::{Layout, TRIMMED, Text, Written, push_trimmed, trimmed_text};
pub use writer::{CAPABILITIES, write};

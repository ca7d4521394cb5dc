//! What the scripts of all dialects have in common: where a program is split into parts, what stands before the line of
//! an op, what the machine is doing between two ops, which corners may be rounded, and the way of text into a sink.
//!
//! A dialect has its own words for all of this, and shares the decisions.

mod listing;
mod split;
mod state;
mod text;

pub use listing::{Layer, Lead, Modal, first_of, speeds};
pub use split::{Borders, Part, split};
pub use state::{Generator, Place, State, may_round};
pub use text::{Layout, Text, Written, push_trimmed, trimmed_text};

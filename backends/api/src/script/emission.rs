//! A program that a dialect can say, until it is written.

use super::options::LINES_PER_PART;
use super::split::Part;
use super::text::Written;
use crate::backend::{BackendIssue, Emission};
use crate::bundle::Sink;

/// What writes the parts of a program into a sink.
struct PartsWriter<F> {
    parts: Vec<Part>,
    write: F,
}

impl<F: Fn(&[Part], &mut dyn Sink) -> Written> Emission for PartsWriter<F> {
    fn write(&self, sink: &mut dyn Sink) -> Written {
        (self.write)(&self.parts, sink)
    }
}

/// The emission of a program in parts, of which a dialect has names for so many.
///
/// # Errors
/// That there are more.
pub fn emission<'p>(
    parts: Vec<Part>,
    most: usize,
    write: impl Fn(&[Part], &mut dyn Sink) -> Written + 'p,
) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>> {
    if parts.len() > most {
        return Err(vec![BackendIssue::OptionConflict {
            key: LINES_PER_PART,
            why: format!(
                "the program would need {} parts, and part names have room for {most}",
                parts.len()
            ),
        }]);
    }
    Ok(Box::new(PartsWriter { parts, write }))
}

//! Lines of text on their way into a sink.
//!
//! A program of a million cuts is hundreds of megabytes, so bytes are gathered in one buffer of [`CHUNK`] bytes and
//! handed over as it fills. Nothing on the way of an op allocates.

use crate::backend::EmitError;
use crate::bundle::{Sink, SinkError};
use crate::number::{FixedDecimal, NotFinite};

/// Size at which the buffer is handed over.
const CHUNK: usize = 64 * 1024;

/// Room for the line that overruns the chunk.
const SLACK: usize = 512;

/// How a dialect's lines and comments look.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// What ends a line.
    pub line_end: &'static [u8],
    /// Most characters that a comment takes of what people wrote.
    pub longest_comment: usize,
    /// Printable ASCII that must not stand in a comment, because it would end it or mean something else.
    pub kept_out_of_comments: &'static [u8],
}

/// Speeds, times and masses are printed with at most so many decimals, and no further trailing zeros.
pub const TRIMMED: FixedDecimal = FixedDecimal::new(6);

/// Writes lines of the file at hand.
pub struct Text<'s> {
    sink: &'s mut dyn Sink,
    layout: Layout,
    buffer: Vec<u8>,
}

impl<'s> Text<'s> {
    /// Nothing written yet.
    #[must_use]
    pub fn new(sink: &'s mut dyn Sink, layout: Layout) -> Self {
        Self {
            sink,
            layout,
            buffer: Vec::with_capacity(CHUNK + SLACK),
        }
    }

    /// Ends the file at hand and starts another.
    ///
    /// # Errors
    /// When the sink does not take it.
    pub fn file(&mut self, name: &str) -> Result<(), SinkError> {
        self.flush()?;
        self.sink.file(name)
    }

    /// Hands over what is gathered.
    ///
    /// # Errors
    /// When the sink does not take them.
    pub fn flush(&mut self) -> Result<(), SinkError> {
        if !self.buffer.is_empty() {
            self.sink.write(&self.buffer)?;
            self.buffer.clear();
        }
        Ok(())
    }

    /// A whole line.
    ///
    /// # Errors
    /// When the sink does not take it.
    pub fn line(&mut self, line: &str) -> Result<(), SinkError> {
        self.put(line.as_bytes());
        self.end_line()
    }

    /// A line made of a fixed start and text that people wrote.
    ///
    /// # Errors
    /// When the sink does not take it.
    pub fn comment(&mut self, start: &str, words: &str) -> Result<(), SinkError> {
        self.put(start.as_bytes());
        self.words(words);
        self.end_line()
    }

    /// Text that people wrote, within a line.
    pub fn words(&mut self, words: &str) {
        self.buffer.extend(plain(words, self.layout));
    }

    /// Bytes within a line.
    #[inline]
    pub fn put(&mut self, bytes: &[u8]) {
        self.buffer.extend_from_slice(bytes);
    }

    /// What is gathered, to append to it within a line.
    pub fn buffer(&mut self) -> &mut Vec<u8> {
        &mut self.buffer
    }

    /// A number within a line, with all decimals of its format.
    ///
    /// # Errors
    /// When it is not finite.
    #[inline]
    pub fn fixed(&mut self, format: FixedDecimal, value: f64) -> Result<(), NotFinite> {
        format.push(&mut self.buffer, value)
    }

    /// A number within a line, up to six decimals, without trailing zeros but the first.
    ///
    /// # Errors
    /// When it is not finite.
    pub fn trimmed(&mut self, value: f64) -> Result<(), NotFinite> {
        push_trimmed(&mut self.buffer, value)
    }

    /// A whole number within a line.
    #[inline]
    pub fn whole(&mut self, value: u32) {
        self.put(digits(value, &mut [0; 10]));
    }

    /// Ends a line.
    ///
    /// # Errors
    /// When the sink does not take what is gathered.
    #[inline]
    pub fn end_line(&mut self) -> Result<(), SinkError> {
        self.put(self.layout.line_end);
        if self.buffer.len() >= CHUNK {
            self.flush()?;
        }
        Ok(())
    }
}

/// The digits of a whole number.
#[inline]
pub(super) fn digits(value: u32, room: &mut [u8; 10]) -> &[u8] {
    let mut at = room.len();
    let mut rest = value;
    loop {
        at = at.saturating_sub(1);
        if let Some(place) = room.get_mut(at) {
            *place = b'0' + (rest % 10) as u8;
        }
        rest /= 10;
        if rest == 0 {
            break;
        }
    }
    room.get(at..).unwrap_or_default()
}

/// Appends a number with up to six decimals, at least one, and no further trailing zeros.
///
/// # Errors
/// When it is not finite.
pub fn push_trimmed(out: &mut Vec<u8>, value: f64) -> Result<(), NotFinite> {
    TRIMMED.push(out, value)?;
    while out.ends_with(b"0") && !out.ends_with(b".0") {
        out.pop();
    }
    Ok(())
}

/// Such a number as text; what is not a number becomes its name, for messages.
#[must_use]
pub fn trimmed_text(value: f64) -> String {
    let mut digits = Vec::new();
    match push_trimmed(&mut digits, value) {
        Ok(()) => String::from_utf8_lossy(&digits).into_owned(),
        Err(NotFinite) => value.to_string(),
    }
}

/// Text as a comment can hold it: printable ASCII on one line, everything else as `?`.
fn plain(words: &str, layout: Layout) -> impl Iterator<Item = u8> {
    words
        .chars()
        .take(layout.longest_comment)
        .map(move |c| match u8::try_from(c) {
            Ok(byte @ b' '..=b'~') if !layout.kept_out_of_comments.contains(&byte) => byte,
            Ok(_) | Err(_) => b'?',
        })
}

/// What writing comes to: lines in the sink, or why not.
pub type Written = Result<(), EmitError>;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bundle::Bundle;
    use proptest::prelude::*;

    const LAYOUT: Layout = Layout {
        line_end: b"\r\n",
        longest_comment: 110,
        kept_out_of_comments: b"%",
    };

    fn one_line(write: impl FnOnce(&mut Text<'_>)) -> String {
        let mut bundle = Bundle::default();
        let mut text = Text::new(&mut bundle, LAYOUT);
        text.file("a.src").unwrap();
        write(&mut text);
        text.flush().unwrap();
        String::from_utf8(bundle.get("a.src").unwrap().to_vec()).unwrap()
    }

    #[test]
    fn speeds_lose_their_trailing_zeros() {
        for (value, text) in [
            (0.2, "0.2"),
            (90.0, "90.0"),
            (0.0, "0.0"),
            (100.0, "100.0"),
            (0.000_001, "0.000001"),
            (1.05, "1.05"),
        ] {
            assert_eq!(trimmed_text(value), text);
        }
    }

    #[test]
    fn comments_stay_on_one_line_of_ascii() {
        let line = one_line(|text| text.comment("; ", "Flügel\r\nPTP XHOME\t100 %").unwrap());
        assert_eq!(line, "; Fl?gel??PTP XHOME?100 ?\r\n");
    }

    #[test]
    fn a_comment_is_cut_to_length() {
        let line = one_line(|text| text.comment("; ", &"ä".repeat(1000)).unwrap());
        assert!(line.len() < 132, "{}", line.len());
    }

    #[test]
    fn chunks_join_without_loss() {
        let lines = 3 * CHUNK / 12;
        let all = one_line(|text| {
            for _ in 0..lines {
                text.line("0123456789").unwrap();
            }
        });
        assert_eq!(all, "0123456789\r\n".repeat(lines));
    }

    proptest! {
        #[test]
        fn whole_numbers_are_decimal(value in any::<u32>()) {
            prop_assert_eq!(one_line(|text| text.whole(value)), value.to_string());
        }

        #[test]
        fn trimming_keeps_the_value(millionths in 0_u32..1_000_000_000) {
            let value = f64::from(millionths) / 1e6;
            let read: f64 = trimmed_text(value).parse().unwrap();
            prop_assert!((read - value).abs() < 1e-9);
        }
    }
}

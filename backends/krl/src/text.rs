//! Lines of text on their way into a sink.
//!
//! A program of a million cuts is hundreds of megabytes, so bytes are gathered in one buffer of [`CHUNK`] bytes and
//! handed over as it fills. Nothing on the way of an op allocates.

use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::bundle::{Sink, SinkError};
use vcutc_backend_api::number::{FixedDecimal, NotFinite};

/// Size at which the buffer is handed over.
const CHUNK: usize = 64 * 1024;

/// Room for the line that overruns the chunk.
const SLACK: usize = 512;

/// Lines end as those that the controller's own editor writes (it runs on Windows).
const LINE_END: &[u8] = b"\r\n";

/// Longest comment: with `;FOLD` and indentation a line stays below 132 characters, which every release reads.
const LONGEST_COMMENT: usize = 110;

/// Speeds, times and masses are printed with at most so many decimals.
const FINE: FixedDecimal = FixedDecimal::new(6);

/// Writes lines of the file at hand.
pub(crate) struct Text<'s> {
    sink: &'s mut dyn Sink,
    buffer: Vec<u8>,
}

impl<'s> Text<'s> {
    /// Nothing written yet.
    pub(crate) fn new(sink: &'s mut dyn Sink) -> Self {
        Self {
            sink,
            buffer: Vec::with_capacity(CHUNK + SLACK),
        }
    }

    /// Ends the file at hand and starts another.
    pub(crate) fn file(&mut self, name: &str, extension: &str) -> Result<(), SinkError> {
        self.flush()?;
        self.sink.file(&format!("{name}.{extension}"))
    }

    /// Hands over what is gathered.
    pub(crate) fn flush(&mut self) -> Result<(), SinkError> {
        if !self.buffer.is_empty() {
            self.sink.write(&self.buffer)?;
            self.buffer.clear();
        }
        Ok(())
    }

    /// A whole line.
    pub(crate) fn line(&mut self, line: &str) -> Result<(), SinkError> {
        self.put(line.as_bytes());
        self.end_line()
    }

    /// A line made of a fixed start and text that people wrote.
    pub(crate) fn comment(&mut self, start: &str, words: &str) -> Result<(), SinkError> {
        self.put(start.as_bytes());
        self.buffer.extend(plain(words));
        self.end_line()
    }

    /// Bytes within a line.
    pub(crate) fn put(&mut self, bytes: &[u8]) {
        self.buffer.extend_from_slice(bytes);
    }

    /// A number within a line, with all decimals of its format.
    pub(crate) fn fixed(&mut self, format: FixedDecimal, value: f64) -> Result<(), NotFinite> {
        format.push(&mut self.buffer, value)
    }

    /// A number within a line, up to six decimals, without trailing zeros but the first.
    pub(crate) fn trimmed(&mut self, value: f64) -> Result<(), NotFinite> {
        push_trimmed(&mut self.buffer, value)
    }

    /// A whole number within a line.
    pub(crate) fn whole(&mut self, value: u32) {
        let mut digits = [0; 10];
        let mut at = digits.len();
        let mut rest = value;
        loop {
            at = at.saturating_sub(1);
            if let Some(place) = digits.get_mut(at) {
                *place = b'0' + (rest % 10) as u8;
            }
            rest /= 10;
            if rest == 0 {
                break;
            }
        }
        self.put(digits.get(at..).unwrap_or_default());
    }

    /// Ends a line.
    pub(crate) fn end_line(&mut self) -> Result<(), SinkError> {
        self.put(LINE_END);
        if self.buffer.len() >= CHUNK {
            self.flush()?;
        }
        Ok(())
    }
}

/// Appends a number with up to six decimals, at least one, and no further trailing zeros.
pub(crate) fn push_trimmed(out: &mut Vec<u8>, value: f64) -> Result<(), NotFinite> {
    FINE.push(out, value)?;
    while out.ends_with(b"0") && !out.ends_with(b".0") {
        out.pop();
    }
    Ok(())
}

/// Such a number as text; what is no number becomes its name, for messages.
pub(crate) fn trimmed_text(value: f64) -> String {
    let mut digits = Vec::new();
    match push_trimmed(&mut digits, value) {
        Ok(()) => String::from_utf8_lossy(&digits).into_owned(),
        Err(NotFinite) => value.to_string(),
    }
}

/// Text as a comment can hold it: printable ASCII on one line, everything else as `?`. `%` is left out because behind
/// a `;` the pendant reads `;%` as the start of its own marks.
fn plain(words: &str) -> impl Iterator<Item = u8> {
    words.chars().take(LONGEST_COMMENT).map(|c| match c {
        '%' => b'?',
        ' '..='~' => c as u8,
        _ => b'?',
    })
}

/// What writing comes to: lines in the sink, or why not.
pub(crate) type Written = Result<(), EmitError>;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use vcutc_backend_api::bundle::Bundle;

    fn one_line(write: impl FnOnce(&mut Text<'_>)) -> String {
        let mut bundle = Bundle::default();
        let mut text = Text::new(&mut bundle);
        text.file("a", "src").unwrap();
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

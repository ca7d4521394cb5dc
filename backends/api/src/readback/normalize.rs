//! A statement without its layout.

/// The text of a statement with one way of writing what has several: letters in upper case, no blanks but between two
/// words, no zeros that a number does not need. What stands in double quotes stays as it is.
///
/// Not for dialects that distinguish small letters from capitals outside of quotes; none of ours does.
#[must_use]
pub fn normalized(statement: &str) -> String {
    let mut writer = Writer {
        out: String::with_capacity(statement.len()),
        last: Last::Other,
    };
    let mut rest = statement;
    while let Some(c) = rest.chars().next() {
        let taken = if c == '"' {
            writer.quoted(rest)
        } else if c.is_ascii_digit() || c == '.' {
            writer.number(rest)
        } else if is_of_word(c) {
            writer.word(rest)
        } else {
            if !c.is_whitespace() {
                writer.out.push(c);
                writer.last = Last::Other;
            }
            c.len_utf8()
        };
        rest = rest.get(taken..).unwrap_or_default();
    }
    writer.out
}

/// What was written last.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Last {
    /// A single letter, whose number may follow without a blank: `X10`.
    Letter,
    /// A longer word.
    Word,
    /// A number.
    Number,
    /// Anything else.
    Other,
}

struct Writer {
    out: String,
    last: Last,
}

impl Writer {
    fn quoted(&mut self, rest: &str) -> usize {
        let end = rest.get(1..).and_then(|inner| inner.find('"'));
        let end = end.map_or(rest.len(), |at| at + 2);
        self.out.push_str(rest.get(..end).unwrap_or_default());
        self.last = Last::Other;
        end
    }

    /// A word. In `X10Y20` a number follows a single letter; in `XP12` and `p_001` digits are part of the name.
    fn word(&mut self, rest: &str) -> usize {
        let end = rest.find(|c| !is_of_word(c)).unwrap_or(rest.len());
        let name = rest.get(..end).unwrap_or_default();
        let letters = name.chars().take_while(|c| !c.is_ascii_digit());
        let (end, last) = match letters.count() {
            1 => (name.chars().next().map_or(end, char::len_utf8), Last::Letter),
            _ => (end, Last::Word),
        };
        if self.last != Last::Other {
            self.out.push(' ');
        }
        let name = rest.get(..end).unwrap_or_default();
        self.out.extend(name.chars().flat_map(char::to_uppercase));
        self.last = last;
        end
    }

    /// A number without sign. An exponent right after it is part of it, so that `9E9` and `9E+09` are the
    /// same; after a single letter it is the next word (`M68E3`).
    fn number(&mut self, rest: &str) -> usize {
        let whole = digits(rest);
        let after = rest.get(whole..).unwrap_or_default();
        let fraction = after.strip_prefix('.').map_or(0, |after| 1 + digits(after));
        let whole_digits = rest.get(..whole).unwrap_or_default().trim_start_matches('0');
        let fraction_digits = rest.get(whole + fraction.min(1)..whole + fraction);
        let fraction_digits = fraction_digits.unwrap_or_default().trim_end_matches('0');
        let of_a_letter = self.last == Last::Letter;
        if matches!(self.last, Last::Number | Last::Word) {
            self.out.push(' ');
        }
        self.out.push_str(if whole_digits.is_empty() {
            "0"
        } else {
            whole_digits
        });
        if !fraction_digits.is_empty() {
            self.out.push('.');
            self.out.push_str(fraction_digits);
        }
        self.last = Last::Number;
        let taken = whole + fraction;
        if of_a_letter {
            taken
        } else {
            taken + self.exponent(rest.get(taken..).unwrap_or_default())
        }
    }

    /// The exponent of the number that was written last, if it has one.
    fn exponent(&mut self, rest: &str) -> usize {
        let Some(after) = rest.strip_prefix(['e', 'E']) else {
            return 0;
        };
        let (sign, power) = match after.strip_prefix(['+', '-']) {
            Some(power) => (1, power),
            None => (0, after),
        };
        let count = digits(power);
        if count == 0 {
            return 0;
        }
        self.out.push('E');
        if after.starts_with('-') {
            self.out.push('-');
        }
        let power = power.get(..count).unwrap_or_default().trim_start_matches('0');
        self.out.push_str(if power.is_empty() { "0" } else { power });
        1 + sign + count
    }
}

fn is_of_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_' || c == '$'
}

fn digits(text: &str) -> usize {
    text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn layout_makes_no_difference() {
        for (one, other) in [
            ("LIN {X 1.500,Y -0.50}", "lin { x 1.5 , y -.5 }"),
            ("$VEL.CP=0.20", "$vel.cp = .2"),
            ("N10 G1 X10. Y2.50 F100", "n010 g01x10y2.5f100.0"),
            ("MoveL p1, v10, fine, tool0;", "MOVEL p1,v10,fine,tool0 ;"),
            ("[9E9,9E9]", "[9e+09, 9.0E+9]"),
            ("m68e3q1.0", "M68 E3 Q1"),
        ] {
            assert_eq!(normalized(one), normalized(other));
        }
    }

    #[test]
    fn meaning_does() {
        for (one, other) in [
            ("X 1.5", "X 1.05"),
            ("X 10", "X 1"),
            ("A1 0", "A 10"),
            ("WAIT SEC 1", "WAITSEC 1"),
            ("X -1", "X 1"),
            ("\"a b\"", "\"ab\""),
            ("\"a\"", "\"A\""),
            ("X1 2", "X12"),
            ("1E9", "1E8"),
            ("1E-9", "1E9"),
        ] {
            assert_ne!(normalized(one), normalized(other), "{one} {other}");
        }
    }

    proptest! {
        #[test]
        fn an_essence_is_its_own(text in "[ -~]{0,40}") {
            let once = normalized(&text);
            prop_assert_eq!(normalized(&once), once);
        }

        #[test]
        fn any_text_has_one(text in any::<String>()) {
            let _ = normalized(&text);
        }

        #[test]
        fn other_numbers_are_other_statements(a in 0_u32..10_000_000, b in 0_u32..10_000_000) {
            let text = |n: u32| format!("LIN {{X {}.{:03}}}", n / 1000, n % 1000);
            prop_assert_eq!(normalized(&text(a)) == normalized(&text(b)), a == b);
        }
    }
}

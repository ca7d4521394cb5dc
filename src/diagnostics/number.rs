//! Numbers as people read them.

/// A number for people: up to three decimals, without trailing zeros.
#[must_use]
pub fn show(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// A number rounded to the nearest of so many steps to one. What rounds to zero has no sign.
#[must_use]
pub fn rounded(value: f64, steps: f64) -> f64 {
    // Adding nothing takes the sign from a zero.
    (value * steps).round() / steps + 0.0
}

/// A number to six digits, without trailing zeros.
#[must_use]
pub fn number(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude == 0.0 {
        return "0".to_owned();
    }
    if !(1e-4..1e10).contains(&magnitude) {
        return format!("{value:.2e}");
    }
    #[expect(clippy::cast_possible_truncation, reason = "between -4 and 10")]
    let before_point = libm::floor(libm::log10(magnitude)) as i32;
    let decimals = usize::try_from(5 - before_point).unwrap_or(0);
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(0.0), "0");
        assert_eq!(number(4.0), "4");
        assert_eq!(number(-0.5), "-0.5");
        assert_eq!(number(1.0 / 3.0), "0.333333");
        assert_eq!(number(100_000.0), "100000");
        assert_eq!(number(123_456.7), "123457");
        assert_eq!(number(1.5e-7), "1.50e-7");
        assert_eq!(number(9.999_999_9), "10");
    }
}

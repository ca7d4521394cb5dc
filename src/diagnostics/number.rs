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

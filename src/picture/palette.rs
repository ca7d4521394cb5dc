//! Colours of pictures, and their partners where the page is dark.
//!
//! A picture says its colours itself, so that it is the same in any viewer. A page that follows the setting of its reader has
//! rules for each of them, which are stronger than what a picture says.

/// The colour of letters and axes.
pub(super) const INK: &str = "#2b2a27";
pub(super) const BLUE: &str = "#0072b2";
pub(super) const VERMILION: &str = "#d55e00";
pub(super) const GREEN: &str = "#009e73";
pub(super) const ORANGE: &str = "#e69f00";
/// Sky blue.
pub(super) const SKY: &str = "#56b4e9";
pub(super) const PURPLE: &str = "#cc79a7";

/// What odd and even layers take.
pub(super) const SHADES: [&str; 2] = ["#f7f2e4", "#e8dec4"];
/// Outlines of chips.
pub(super) const EDGE: &str = "#8f7f57";

/// Colours on a light ground, and on a dark one: what is light becomes dark, what stands out stands out.
const PARTNERS: [(&str, &str); 42] = [
    // Ground, letters, plots, grid.
    ("#fbfaf7", "#1c2126"),
    ("#2b2a27", "#e3e5e8"),
    ("#ffffff", "#14181c"),
    ("#dcd6c8", "#353d45"),
    // Blue, vermilion, green, orange, sky blue, purple [Okabe 2008].
    ("#0072b2", "#5aaee6"),
    ("#d55e00", "#ff8a3d"),
    ("#009e73", "#35c79b"),
    ("#e69f00", "#f0b43c"),
    ("#56b4e9", "#8ecbf0"),
    ("#cc79a7", "#e3a1c6"),
    // Stock and chips.
    ("#f6f1e2", "#3b3728"),
    ("#f7f2e4", "#2b2a22"),
    ("#e8dec4", "#38342a"),
    ("#8f7f57", "#8c8265"),
    ("#9c8a5c", "#a39672"),
    ("#e4dcc3", "#45402f"),
    // The part.
    ("#b7c6d3", "#41566a"),
    ("#3d5a73", "#9dbad3"),
    // The highest scallop.
    ("#a3005c", "#ff7ab8"),
    // Rates and ranges of axes.
    ("#f3f0fa", "#1f1c2b"),
    ("#6d5a8c", "#a893cf"),
    ("#8a8577", "#8f8b80"),
    // The sketch of the set-up.
    ("#efe7d0", "#3b3728"),
    ("#c62828", "#ff7b72"),
    ("#2e7d32", "#6fcf74"),
    ("#1565c0", "#6cb2ff"),
    ("#57606a", "#a6adb5"),
    ("#d0d4d9", "#3a424b"),
    // The blade in the hand: the work, the shank, the flat, the blade that leans.
    ("#e9e6df", "#343a41"),
    ("#b9b3a3", "#7a766a"),
    ("#dfe7ee", "#4d5a66"),
    ("#8a857a", "#9a958a"),
    // Maps: their best and highest places. Their scale stays, light is much.
    ("#c2185b", "#ff6fa3"),
    ("#440154", "#440154"),
    ("#472d7b", "#472d7b"),
    ("#3b528b", "#3b528b"),
    ("#2c728e", "#2c728e"),
    ("#21918c", "#21918c"),
    ("#28ae80", "#28ae80"),
    ("#5ec962", "#5ec962"),
    ("#addc30", "#addc30"),
    ("#fde725", "#fde725"),
];

/// Rules of style for pictures below `within`, for a page on a dark ground.
pub fn dark(within: &str) -> String {
    let rule = |(light, dark): (&str, &str)| {
        format!(
            "{within} [fill=\"{light}\"] {{ fill: {dark}; }}\n{within} [stroke=\"{light}\"] {{ stroke: {dark}; }}\n"
        )
    };
    PARTNERS.into_iter().map(rule).collect()
}

/// The line of a limit that the job sets.
pub(super) fn job_limit() -> String {
    format!("fill=\"none\" stroke=\"{VERMILION}\" stroke-width=\"2\" stroke-dasharray=\"9 4\"")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// The relative luminance of WCAG 2.2.
    fn luminance(colour: &str) -> f64 {
        let part = |at: usize| {
            let value = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
            if value <= 0.04045 {
                value / 12.92
            } else {
                libm::pow((value + 0.055) / 1.055, 2.4)
            }
        };
        0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
    }

    fn contrast(a: &str, b: &str) -> f64 {
        let [a, b] = [luminance(a), luminance(b)];
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn no_colour_has_two_partners() {
        let lights: BTreeSet<&str> = PARTNERS.iter().map(|(light, _)| *light).collect();
        assert_eq!(lights.len(), PARTNERS.len());
    }

    #[test]
    fn letters_and_curves_stand_out_from_a_dark_ground() {
        let [(_, ground), (_, ink), (_, plot), ..] = PARTNERS;
        assert!(contrast(ink, ground) > 12.0 && contrast(ink, plot) > 12.0);
        for (light, dark) in &PARTNERS[4..10] {
            assert!(contrast(dark, plot) > 4.5, "{light} as {dark}");
        }
    }
}

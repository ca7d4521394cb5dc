//! A picture in its frame: it can be enlarged and moved by mouse, touch and keyboard (`src/report/assets/page.js`).
//!
//! Each is drawn twice, for wide screens and paper and for telephones, so that its words can be read without scrolling on both;
//! style shows the one that fits.

use crate::html::{Html, unbroken};
use vcutc_diagnostics::number::show;
use vcutc_picture::Prefix;

/// Whether a picture can be enlarged.
#[derive(Clone, Copy)]
pub(super) enum Zoom {
    /// It can.
    Free,
    /// It cannot; there is nothing small in it.
    Fixed,
}

/// Where the two drawings of a picture are shown, and what their ids begin with.
pub(super) struct Ids {
    /// On wide screens and paper.
    pub(super) page: &'static str,
    /// On telephones.
    pub(super) phone: &'static str,
}

/// A picture with a caption.
pub(super) fn figure(ids: &Ids, zoom: Zoom, caption: &str, draw: &dyn Fn(Prefix) -> String) -> Html {
    let page = draw(Prefix::new(ids.page));
    let phone = draw(Prefix::for_phones(ids.phone));
    framed(page, "for-page", zoom, caption) + framed(phone, "for-phones", zoom, caption)
}

/// A picture of several sections, of which a slider shows one. `places` are their y in mm.
pub(super) fn slide(
    ids: &Ids,
    places: &[f64],
    shown: usize,
    caption: &str,
    draw: &dyn Fn(Prefix) -> String,
) -> Html {
    let last = places.len().saturating_sub(1);
    let y = places.get(shown).map_or_else(String::new, |y| show(*y));
    let one = |prefix: Prefix, class: &str| {
        html!(
            "figure_slide.html",
            class = class,
            last = last.to_string(),
            shown = shown.to_string(),
            y = y,
            svg = Html::trusted(draw(prefix)),
            caption = unbroken(caption)
        )
    };
    one(Prefix::new(ids.page), "for-page") + one(Prefix::for_phones(ids.phone), "for-phones")
}

/// An SVG text in its frame.
pub(super) fn framed(svg: String, class: &str, zoom: Zoom, caption: &str) -> Html {
    let (svg, words) = (Html::trusted(svg), unbroken(caption));
    match zoom {
        Zoom::Fixed => html!("figure.html", class = class, svg = svg, caption = words),
        Zoom::Free => html!(
            "figure_zoom.html",
            class = class,
            words = caption,
            svg = svg,
            caption = words
        ),
    }
}

//! A picture in its frame: it can be enlarged and moved by mouse, touch and keyboard (`src/report/assets/page.js`).
//!
//! Each is drawn twice, for wide screens and paper and for telephones, so that its words can be read without scrolling on both;
//! style shows the one that fits.

use super::html::{escaped, unbroken};
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
pub(super) fn figure(ids: &Ids, zoom: Zoom, caption: &str, draw: &dyn Fn(Prefix) -> String) -> String {
    let page = draw(Prefix::new(ids.page));
    let phone = draw(Prefix::for_phones(ids.phone));
    framed(&page, "for-page", zoom, caption) + &framed(&phone, "for-phones", zoom, caption)
}

/// An SVG text in its frame.
pub(super) fn framed(svg: &str, class: &str, zoom: Zoom, caption: &str) -> String {
    let (words, caption) = (escaped(caption), unbroken(caption));
    match zoom {
        Zoom::Fixed => format!(
            "<figure class=\"{class}\">\n<div class=\"view\">\n{svg}</div>\n<figcaption>{caption}</figcaption>\n</figure>\n"
        ),
        Zoom::Free => format!(
            "<figure class=\"{class}\" data-zoom>\n<div class=\"tools\" role=\"group\" aria-label=\"Size of the picture\">\
             <button type=\"button\" data-do=\"in\" aria-label=\"Larger\">+</button>\
             <button type=\"button\" data-do=\"out\" aria-label=\"Smaller\">&#8722;</button>\
             <button type=\"button\" data-do=\"all\">All</button></div>\n\
             <div class=\"view\" tabindex=\"0\" role=\"group\" aria-label=\"{words} Plus and minus enlarge and reduce, arrows move, \
             0 shows all.\">\n{svg}</div>\n<figcaption>{caption}</figcaption>\n</figure>\n"
        ),
    }
}

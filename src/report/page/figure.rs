//! A picture in its frame: it can be enlarged and moved by mouse, touch and keyboard (`src/report/assets/page.js`).

use super::html::escaped;

/// Whether a picture can be enlarged.
#[derive(Clone, Copy)]
pub(super) enum Zoom {
    /// It can.
    Free,
    /// It cannot; there is nothing small in it.
    Fixed,
}

/// An SVG text with a caption.
pub(super) fn figure(svg: &str, zoom: Zoom, caption: &str) -> String {
    let caption = escaped(caption);
    match zoom {
        Zoom::Fixed => format!(
            "<figure>\n<div class=\"view\">\n{svg}</div>\n<figcaption>{caption}</figcaption>\n</figure>\n"
        ),
        Zoom::Free => format!(
            "<figure data-zoom>\n<div class=\"tools\" role=\"group\" aria-label=\"Size of the picture\">\
             <button type=\"button\" data-do=\"in\" aria-label=\"Larger\">+</button>\
             <button type=\"button\" data-do=\"out\" aria-label=\"Smaller\">&#8722;</button>\
             <button type=\"button\" data-do=\"all\">All</button></div>\n\
             <div class=\"view\" tabindex=\"0\" role=\"group\" aria-label=\"{caption} Plus and minus enlarge and reduce, arrows move, \
             0 shows all.\">\n{svg}</div>\n<figcaption>{caption}</figcaption>\n</figure>\n"
        ),
    }
}

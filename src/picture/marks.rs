//! Marks of single points: light under dark, so that they stand out on every ground.

use super::svg::{Svg, number};

/// A ring around a point.
pub(super) fn ring(svg: &mut Svg, (x, y): (f64, f64)) {
    let (x, y) = (number(x), number(y));
    for paint in [
        "stroke=\"#ffffff\" stroke-width=\"6\"",
        "stroke=\"#2b2a27\" stroke-width=\"2.5\"",
    ] {
        svg.line(&format!(
            "  <circle cx=\"{x}\" cy=\"{y}\" r=\"7\" fill=\"none\" {paint}/>"
        ));
    }
}

/// A cross over a point.
pub(super) fn cross(svg: &mut Svg, (x, y): (f64, f64)) {
    let path = format!("M{} {}l14 14m0 -14l-14 14", number(x - 7.0), number(y - 7.0));
    for paint in [
        "stroke=\"#ffffff\" stroke-width=\"7\"",
        "stroke=\"#c2185b\" stroke-width=\"3.5\"",
    ] {
        svg.path(&path, &format!("fill=\"none\" stroke-linecap=\"round\" {paint}"));
    }
}

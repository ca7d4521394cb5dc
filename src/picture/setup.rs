//! Sketches for who sets a machine up: where the work's zero is on the stock, and how the axes of the blade lie.

use super::palette::INK;
use super::projection::{View, corners};
use super::sheet::HALO;
use super::svg::{Anchor, Mark, Svg};
use super::trace::{Trace, number};
use super::{Point, Prefix};
use vcutc_backend_api::ir::Edges;

const WIDTH: f64 = 430.0;
const HEIGHT: f64 = 240.0;
const FONT: u32 = 14;
/// Colours of the axes x, y and z.
const AXES: [(&str, &str); 3] = [("x", "#c62828"), ("y", "#2e7d32"), ("z", "#1565c0")];
const SOFT: &str = "#57606a";
const SOLID: &str = "fill=\"#efe7d0\" stroke=\"#8f7f57\" stroke-linejoin=\"round\"";

/// Draws a stock of these lengths along x, y and z in mm, and the frame of the work at its corner.
#[must_use]
pub fn stock(ids: Prefix, size: [f64; 3]) -> String {
    let [width, depth, height] = size;
    let corners = corners(size);
    let view = View::of(
        corners.into_iter(),
        [95.0, HEIGHT - 62.0],
        [WIDTH - 190.0, HEIGHT - 110.0],
    );
    let description = format!(
        "A block {width:.1} mm long in x, {depth:.1} mm in y and {height:.1} mm high in z. The zero of the work is its lowest corner, \
         where x, y and z are least; the axes run along the edges."
    );
    let title = "The stock and the work's zero";
    let mut svg = Svg::new([WIDTH, HEIGHT], FONT, ids, title, &description);
    let mut faces = Trace::default();
    for face in [[0, 1, 5, 4], [1, 3, 7, 5], [4, 5, 7, 6]] {
        faces.closed(face.map(|number| view.at(corners[number])));
    }
    svg.path(faces.text(), SOLID);
    let zero = view.at([0.0; 3]);
    // Long enough to be seen, whatever the block's shape.
    let reach = 46.0 / view.scale;
    let ends = [[reach, 0.0, 0.0], [0.0, reach, 0.0], [0.0, 0.0, reach]];
    for ((name, colour), end) in AXES.into_iter().zip(ends) {
        axis(&mut svg, zero, view.at(end), colour, name);
    }
    svg.mark(zero, Mark::ORIGIN);
    let bold = format!("font-weight=\"bold\" {HALO}");
    svg.text([zero[0] - 9.0, zero[1] + 20.0], Anchor::End, &bold, "zero");
    let lengths = [
        ([width / 2.0, 0.0, 0.0], [4.0, 20.0], Anchor::Middle, width),
        ([width, depth / 2.0, 0.0], [10.0, 16.0], Anchor::Start, depth),
        ([width, depth, height / 2.0], [10.0, 5.0], Anchor::Start, height),
    ];
    for (place, [aside, down], anchor, length) in lengths {
        let [x, y] = view.at(place);
        let words = format!("{} mm", number(length));
        svg.text([x + aside, y + down], anchor, HALO, &words);
    }
    svg.finish()
}

/// An arrow with a name at its end.
fn axis(svg: &mut Svg, from: Point, to: Point, colour: &str, name: &str) {
    svg.arrow(from, to, colour);
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let length = libm::hypot(x, y).max(f64::MIN_POSITIVE);
    let beyond = [to[0] + x / length * 11.0, to[1] + y / length * 11.0 + 5.0];
    let bold = format!("font-weight=\"bold\" {HALO}");
    svg.coloured(beyond, Anchor::Middle, colour, &bold, name);
}

/// Draws a blade seen on its flat, tip down, with its frame: x to the edge, y out of the paper, z out of the tip. Its edge is so
/// many mm long, and leaves the axis at half the angle of its apex, in rad.
#[must_use]
pub fn blade(ids: Prefix, edges: Edges, edge: f64, half_apex: f64) -> String {
    let description = "The blade seen on its flat, its tip down. z leads out of the tip, away from the shank; x lies in the flat, towards \
                       the edge; y is square to the flat and comes towards the reader.";
    let title = "The blade and its axes";
    let mut svg = Svg::new([WIDTH, HEIGHT], FONT, ids, title, description);
    let tip = [WIDTH / 2.0, HEIGHT - 62.0];
    // From the tip: to the right, and up.
    let at = |right: f64, up: f64| [tip[0] + right, tip[1] - up];
    let length = 96.0;
    let half = (length * libm::tan(half_apex)).clamp(9.0, 48.0);
    let sharp = format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"3\"");
    let back = match edges {
        Edges::Single => 0.0,
        Edges::Double => -half,
    };
    let neck = length + 14.0;
    let body = [
        tip,
        at(half, length),
        at(half, neck),
        at(back, neck),
        at(back, length),
    ];
    svg.closed(body, SOLID);
    let shank = half.max(12.0) * 0.8;
    let [left, top] = at(-shank, length + 52.0);
    svg.rect(
        [left, top, 2.0 * shank, 38.0],
        "fill=\"#d0d4d9\" stroke=\"#57606a\"",
    );
    match edges {
        Edges::Single => svg.open([tip, at(half, length)], &sharp),
        Edges::Double => svg.open([at(-half, length), tip, at(half, length)], &sharp),
    }
    let [(x, red), (y, green), (z, blue)] = AXES;
    axis(&mut svg, tip, at(58.0, 0.0), red, x);
    axis(&mut svg, tip, at(0.0, -44.0), blue, z);
    svg.towards_the_eye(tip, green);
    let bold = format!("font-weight=\"bold\" {HALO}");
    svg.coloured(at(-14.0, -16.0), Anchor::End, green, &bold, y);
    let edge = format!("{} mm of edge", number(edge));
    let words = [
        (at(half + 10.0, length * 0.65), Anchor::Start, "edge"),
        (at(shank + 10.0, length + 28.0), Anchor::Start, "shank"),
        (at(-24.0, -34.0), Anchor::End, "square to the flat"),
        (
            at(back.min(-8.0) - 10.0, length * 0.65),
            Anchor::End,
            edge.as_str(),
        ),
    ];
    for (place, anchor, words) in words {
        svg.coloured(place, anchor, SOFT, HALO, words);
    }
    svg.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_any_shape_fit_and_their_lengths_are_named() {
        for size in [[300.0, 500.0, 40.0], [10.0, 2000.0, 30.0], [50.0, 50.0, 900.0]] {
            let sketch = stock(Prefix::NONE, size);
            for length in size {
                assert!(sketch.contains(&format!(">{} mm<", number(length))), "{size:?}");
            }
            let (_, rest) = sketch.split_once("translate(").unwrap();
            for value in rest.split(')').next().unwrap().split(' ') {
                let value: f64 = value.parse().unwrap();
                assert!((10.0..WIDTH - 10.0).contains(&value), "{size:?}: {value}");
            }
        }
    }
}

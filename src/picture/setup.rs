//! Sketches for who sets a machine up: where the work's zero is on the stock, and how the axes of the blade lie.

use super::Prefix;
use super::palette::INK;
use super::sheet::HALO;
use super::svg::{Anchor, Svg, number};
use super::trace::Trace;

/// The stock with its zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stock {
    /// What the ids of the sketch begin with.
    pub ids: Prefix,
    /// Lengths along x, y and z, in mm.
    pub size: [f64; 3],
}

/// A blade with its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blade {
    /// What the ids of the sketch begin with.
    pub ids: Prefix,
    /// Length of its edge, in mm.
    pub length: f64,
    /// Half the angle at its tip, in rad, and its tangent.
    pub tangent: f64,
    /// On how many sides it cuts.
    pub edges: Edges,
}

/// On how many sides a blade cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edges {
    /// On the side of x.
    One,
    Two,
}

const WIDTH: f64 = 430.0;
const HEIGHT: f64 = 240.0;
const FONT: u32 = 14;
/// Colours of the axes x, y and z.
const AXES: [(&str, &str); 3] = [("x", "#c62828"), ("y", "#2e7d32"), ("z", "#1565c0")];
const SOFT: &str = "#57606a";
const SOLID: &str = "fill=\"#efe7d0\" stroke=\"#8f7f57\" stroke-linejoin=\"round\"";

/// A parallel projection: x to the right and down a little, y to the right and up, z up.
const RIGHTWARDS: [f64; 3] = [0.866_025, 0.5, 0.0];
const UPWARDS: [f64; 3] = [-0.211_309, 0.366_000, 0.906_308];

fn projected(point: [f64; 3]) -> [f64; 2] {
    let along = |axis: [f64; 3]| {
        axis.iter()
            .zip(point)
            .map(|(axis, value)| axis * value)
            .sum::<f64>()
    };
    [along(RIGHTWARDS), along(UPWARDS)]
}

/// Draws the stock, its lengths, and the frame of the work at its corner.
#[must_use]
pub fn stock(stock: &Stock) -> String {
    let [width, depth, height] = stock.size;
    let corner = |number: usize| {
        let along = |bit: usize, length: f64| if number >> bit & 1 == 1 { length } else { 0.0 };
        [along(0, width), along(1, depth), along(2, height)]
    };
    let places: Vec<[f64; 2]> = (0..8).map(|number| projected(corner(number))).collect();
    let span = |axis: usize| {
        let values = places.iter().map(|place| place[axis]);
        let low = values.clone().fold(f64::INFINITY, f64::min);
        [low, values.fold(f64::NEG_INFINITY, f64::max)]
    };
    let ([left, right], [low, high]) = (span(0), span(1));
    let scale = ((WIDTH - 190.0) / (right - left)).min((HEIGHT - 110.0) / (high - low));
    let at = |point: [f64; 3]| {
        let [x, y] = projected(point);
        [
            95.0 + ((WIDTH - 190.0) - (right - left) * scale) / 2.0 + (x - left) * scale,
            HEIGHT - 62.0 - (y - low) * scale,
        ]
    };
    let description = format!(
        "A block {width:.1} mm long in x, {depth:.1} mm in y and {height:.1} mm high in z. The zero of the work is its lowest corner, \
         where x, y and z are least; the axes run along the edges."
    );
    let mut svg = Svg::new(
        [WIDTH, HEIGHT],
        FONT,
        stock.ids,
        "The stock and the work's zero",
        &description,
    );
    let faces = [[0, 1, 5, 4], [1, 3, 7, 5], [4, 5, 7, 6]];
    let mut faces_of = Trace::default();
    for face in faces {
        faces_of.closed(face.map(|number| at(corner(number))));
    }
    svg.path(faces_of.text(), SOLID);
    let zero = at([0.0; 3]);
    // Long enough to be seen, whatever the block's shape.
    let reach = 46.0 / scale;
    for (axis, (name, colour)) in AXES.iter().enumerate() {
        let mut to = [0.0; 3];
        if let Some(value) = to.get_mut(axis) {
            *value = reach;
        }
        arrow(&mut svg, zero, at(to), colour, name);
    }
    let [x, y] = zero;
    svg.line(&format!(
        "  <circle cx=\"{}\" cy=\"{}\" r=\"5\" fill=\"{INK}\" stroke=\"#ffffff\" stroke-width=\"1.5\"/>",
        number(x),
        number(y)
    ));
    let bold = format!("font-weight=\"bold\" {HALO}");
    svg.text((x - 9.0, y + 20.0), Anchor::End, &bold, "zero");
    let lengths = [
        ([width / 2.0, 0.0, 0.0], [4.0, 20.0], Anchor::Middle, width),
        ([width, depth / 2.0, 0.0], [10.0, 16.0], Anchor::Start, depth),
        ([width, depth, height / 2.0], [10.0, 5.0], Anchor::Start, height),
    ];
    for (place, [aside, down], anchor, length) in lengths {
        let [x, y] = at(place);
        svg.text(
            (x + aside, y + down),
            anchor,
            HALO,
            &format!("{} mm", number(length)),
        );
    }
    svg.finish()
}

/// An arrow with a name at its end.
fn arrow(svg: &mut Svg, from: [f64; 2], to: [f64; 2], colour: &str, name: &str) {
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = (way[0] * way[0] + way[1] * way[1]).sqrt().max(f64::MIN_POSITIVE);
    let [dx, dy] = way.map(|part| part / length);
    let back = [to[0] - dx * 9.0, to[1] - dy * 9.0];
    let mut line = Trace::default();
    line.open([from, back]);
    svg.path(
        line.text(),
        &format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"2.5\""),
    );
    let mut head = Trace::default();
    head.closed([
        to,
        [back[0] - dy * 4.5, back[1] + dx * 4.5],
        [back[0] + dy * 4.5, back[1] - dx * 4.5],
    ]);
    svg.path(head.text(), &format!("fill=\"{colour}\""));
    let at = (to[0] + dx * 11.0, to[1] + dy * 11.0 + 5.0);
    let style = format!("font-weight=\"bold\" {HALO}");
    svg.coloured(at, Anchor::Middle, colour, &style, name);
}

/// Draws a blade seen on its flat, tip down, with its frame: x to the edge, y out of the paper, z out of the tip.
#[must_use]
pub fn blade(blade: &Blade) -> String {
    let description = "The blade seen on its flat, its tip down. z leads out of the tip, away from the shank; x lies in the flat, towards \
                       the edge; y is square to the flat and comes towards the reader.";
    let mut svg = Svg::new(
        [WIDTH, HEIGHT],
        FONT,
        blade.ids,
        "The blade and its axes",
        description,
    );
    let tip = [WIDTH / 2.0, HEIGHT - 62.0];
    let length = 96.0;
    let half = (length * blade.tangent).clamp(9.0, 48.0);
    let back = match blade.edges {
        Edges::One => 0.0,
        Edges::Two => -half,
    };
    let neck = tip[1] - length;
    let mut body = Trace::default();
    body.closed([
        tip,
        [tip[0] + half, neck],
        [tip[0] + half, neck - 14.0],
        [tip[0] + back, neck - 14.0],
        [tip[0] + back, neck],
    ]);
    svg.path(body.text(), SOLID);
    let shank = half.max(12.0) * 0.8;
    svg.rect(
        [tip[0] - shank, neck - 52.0, 2.0 * shank, 38.0],
        "fill=\"#d0d4d9\" stroke=\"#57606a\"",
    );
    let mut edges = Trace::default();
    edges.open([tip, [tip[0] + half, neck]]);
    match blade.edges {
        Edges::One => {}
        Edges::Two => edges.open([tip, [tip[0] - half, neck]]),
    }
    svg.path(
        edges.text(),
        &format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"3\""),
    );
    let [(x, red), (y, green), (z, blue)] = AXES;
    arrow(&mut svg, tip, [tip[0] + 58.0, tip[1]], red, x);
    arrow(&mut svg, tip, [tip[0], tip[1] + 44.0], blue, z);
    let (cx, cy) = (number(tip[0]), number(tip[1]));
    svg.line(&format!(
        "  <circle cx=\"{cx}\" cy=\"{cy}\" r=\"7\" fill=\"#ffffff\" stroke=\"{green}\" stroke-width=\"2.5\"/>"
    ));
    svg.line(&format!(
        "  <circle cx=\"{cx}\" cy=\"{cy}\" r=\"2.5\" fill=\"{green}\"/>"
    ));
    let bold = format!("font-weight=\"bold\" {HALO}");
    svg.coloured((tip[0] - 14.0, tip[1] + 16.0), Anchor::End, green, &bold, y);
    let words = [
        (
            [tip[0] + half + 10.0, neck + length * 0.35],
            Anchor::Start,
            "edge".to_owned(),
        ),
        (
            [tip[0] + shank + 10.0, neck - 28.0],
            Anchor::Start,
            "shank".to_owned(),
        ),
        (
            [tip[0] - 24.0, tip[1] + 34.0],
            Anchor::End,
            "square to the flat".to_owned(),
        ),
        (
            [tip[0] + back.min(-8.0) - 10.0, neck + length * 0.35],
            Anchor::End,
            format!("{} mm of edge", number(blade.length)),
        ),
    ];
    for (place, anchor, words) in words {
        svg.coloured((place[0], place[1]), anchor, SOFT, HALO, &words);
    }
    svg.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_any_shape_fit_and_their_lengths_are_named() {
        for size in [[300.0, 500.0, 40.0], [10.0, 2000.0, 30.0], [50.0, 50.0, 900.0]] {
            let sketch = stock(&Stock {
                ids: Prefix::NONE,
                size,
            });
            for length in size {
                assert!(sketch.contains(&format!(">{} mm<", number(length))), "{size:?}");
            }
            for place in ["cx", "cy"] {
                let (_, rest) = sketch.split_once(&format!("{place}=\"")).unwrap();
                let value: f64 = rest.split('"').next().unwrap().parse().unwrap();
                assert!((10.0..WIDTH - 10.0).contains(&value), "{size:?}: {place} {value}");
            }
        }
    }
}

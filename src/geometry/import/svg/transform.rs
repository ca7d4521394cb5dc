//! The attribute `transform`: a list of maps, of which the last is applied first (SVG 1.1, 7.6).

use super::super::DataError;
use super::super::drawing::Affine;
use super::scan::Scan;
use super::tree::Text;

/// Most numbers that a map takes.
const MOST_NUMBERS: usize = 6;

/// The map of a transformation.
pub(super) fn transform(text: Text<'_>) -> Result<Affine, DataError> {
    let mut scan = Scan::new(text);
    let mut whole = Affine::IDENTITY;
    while scan.peek().is_some() {
        let name = scan.word();
        if !scan.take('(') {
            return Err(scan.wrong("a map such as `translate(...)`"));
        }
        let mut numbers = Vec::new();
        while !scan.take(')') {
            if numbers.len() == MOST_NUMBERS {
                return Err(scan.wrong("`)`"));
            }
            numbers.push(scan.number()?);
        }
        let Some(map) = map(name, &numbers) else {
            let message = format!(
                "`{}` with {} numbers is not a transformation of SVG",
                super::super::shortened(name),
                numbers.len()
            );
            return Err(text.place(0..text.text.len()).error(message));
        };
        whole = whole.after(map);
        scan.take(',');
    }
    if whole.is_proper() {
        Ok(whole)
    } else {
        Err(text
            .place(0..text.text.len())
            .error("this transformation shrinks its content to nothing"))
    }
}

fn map(name: &str, numbers: &[f64]) -> Option<Affine> {
    let skew = |degrees: f64| {
        let (sin, cos) = super::super::drawing::sincos_degrees(degrees);
        sin / cos
    };
    Some(match (name, numbers) {
        ("matrix", &[a, b, c, d, e, f]) => Affine::new([a, b, c, d, e, f]),
        ("translate", &[x]) => Affine::shift(x, 0.0),
        ("translate", &[x, y]) => Affine::shift(x, y),
        ("scale", &[both]) => Affine::stretch(both, both),
        ("scale", &[x, y]) => Affine::stretch(x, y),
        ("rotate", &[angle]) => Affine::turn(angle),
        ("rotate", &[angle, x, y]) => Affine::shift(x, y)
            .after(Affine::turn(angle))
            .after(Affine::shift(-x, -y)),
        ("skewX", &[angle]) => Affine::new([1.0, 0.0, skew(angle), 1.0, 0.0, 0.0]),
        ("skewY", &[angle]) => Affine::new([1.0, skew(angle), 0.0, 1.0, 0.0, 0.0]),
        _ => return None,
    })
}

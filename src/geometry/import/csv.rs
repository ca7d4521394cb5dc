//! Points as two columns of text.

use super::{DataError, Piece, coordinate, lines, number};
use crate::point::Point2;

/// What stands between the columns of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Separator {
    Semicolon,
    Tab,
    Comma,
    Blank,
}

impl Separator {
    /// The separator of a line. Each line is looked at on its own, so that repaired files can still be read.
    fn of(line: Piece<'_>) -> Self {
        if line.text.contains(';') {
            Self::Semicolon
        } else if line.text.contains('\t') && !line.split(|c| c == '\t').any(|f| f.text.ends_with(',')) {
            Self::Tab
        } else if line.text.contains(',') {
            Self::Comma
        } else {
            Self::Blank
        }
    }

    /// The columns of a line. Repeated tabs and blanks are one separator: they align columns.
    fn columns(self, line: Piece<'_>) -> Vec<Piece<'_>> {
        let filled = |piece: &Piece<'_>| !piece.text.is_empty();
        match self {
            Self::Semicolon => line.split(|c| c == ';').collect(),
            Self::Comma => line.split(|c| c == ',').collect(),
            Self::Tab => line.split(|c| c == '\t').filter(filled).collect(),
            Self::Blank => line.split(|c| c == ' ').filter(filled).collect(),
        }
    }

    /// Whether a comma may stand for the decimal point.
    const fn leaves_the_comma_free(self) -> bool {
        match self {
            Self::Semicolon | Self::Tab => true,
            Self::Comma | Self::Blank => false,
        }
    }

    fn coordinate(self, field: Piece<'_>) -> Result<f64, DataError> {
        if self.leaves_the_comma_free() && !field.text.contains('.') {
            coordinate(field, &field.text.replacen(',', ".", 1))
        } else {
            coordinate(field, field.text)
        }
    }
}

/// Reads points from two columns, x and z, with semicolons, tabs, commas or blanks between them. Between semicolons
/// and tabs the decimal point may be a comma, as European programs write it. One heading, empty lines, and comments
/// from `#` to the end of the line are passed over.
///
/// The numbers are given as they stand; their unit is for the caller to say.
///
/// # Errors
/// Lines of more or fewer than two columns, what is not a number, and fewer than two points.
pub fn csv(text: &str) -> Result<Vec<Point2>, DataError> {
    let mut points = Vec::new();
    let mut heading_may_come = true;
    for line in lines(text) {
        let content = line.text.split('#').next().unwrap_or_default();
        let line = Piece::trimmed(content, line.start);
        if line.text.is_empty() {
            continue;
        }
        let separator = Separator::of(line);
        let columns = separator.columns(line);
        if !(core::mem::take(&mut heading_may_come) && is_heading(&columns)) {
            points.push(point(line, separator, &columns)?);
        }
    }
    if points.len() < 2 {
        let message = format!(
            "a profile takes two points or more, {} found here",
            if points.is_empty() {
                "none is"
            } else {
                "only one is"
            }
        );
        return Err(DataError::new(0..text.len(), message));
    }
    Ok(points)
}

/// A heading has no column that looks like a number.
fn is_heading(columns: &[Piece<'_>]) -> bool {
    columns
        .iter()
        .all(|column| !column.text.is_empty() && number(&column.text.replace(',', ".")).is_none())
}

fn point(line: Piece<'_>, separator: Separator, columns: &[Piece<'_>]) -> Result<Point2, DataError> {
    match columns {
        [x, z] => Ok(Point2::new(separator.coordinate(*x)?, separator.coordinate(*z)?)),
        [_] | [] => Err(DataError::new(
            line.range(),
            "this line has one column where x and z are expected",
        )),
        [_, _, third, ..] if separator == Separator::Comma => Err(DataError::new(
            third.start..line.range().end,
            format!(
                "this line has {} columns where x and z are expected; if its commas are decimal commas, put a \
                 semicolon between the columns",
                columns.len()
            ),
        )),
        [_, _, third, ..] => Err(DataError::new(
            third.start..line.range().end,
            format!(
                "this line has {} columns where x and z are expected; delete the others",
                columns.len()
            ),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> Vec<(f64, f64)> {
        csv(text).unwrap().iter().map(|p| (p.x, p.z)).collect()
    }

    fn complaint(text: &str) -> (&str, String) {
        let error = csv(text).unwrap_err();
        (&text[error.start as usize..error.end as usize], error.message)
    }

    #[test]
    fn all_separators_read_the_same() {
        for text in [
            "0,1\n2.5,-3\n",
            "0;1\n2.5;-3",
            "0\t1\r\n2.5\t-3\r\n",
            "  0   1 \n 2.5  -3 ",
            "0, 1\n2.5,\t-3",
            "0;1\n2,5;-3,0",
            "0\t1\n2,5\t\t-3",
            "\u{feff}x [mm], z [mm]\n# measured\n\n0,1 # start\n2.5,-3",
            "0,1\r2.5,-3\r",
            "+0,1e0\n.25E1,-3.",
        ] {
            assert_eq!(read(text), [(0.0, 1.0), (2.5, -3.0)], "{text:?}");
        }
    }

    #[test]
    fn faults_are_pointed_at() {
        assert_eq!(complaint("0,1\n2,abc\n"), ("abc", "`abc` is not a number".into()));
        assert_eq!(complaint("0,1\n2,\n").1, "a number is missing here");
        assert_eq!(complaint("0,1\nnan,2\n").0, "nan");
        assert_eq!(complaint("0,1\n1e999,2\n").0, "1e999");
        assert_eq!(complaint("0,1\n1e10,2\n").0, "1e10");
        assert_eq!(complaint("0;1\n2;3;4\n").0, "4");
        assert!(complaint("0,5,1,5\n1,5,2,5\n").1.contains("decimal commas"));
        assert_eq!(complaint("0 1\n5\n").0, "5");
        assert_eq!(complaint("x,z\nx,z\n1,2").0, "x");
        assert_eq!(complaint("0;1\n1.234,5;2").0, "1.234,5");
    }

    #[test]
    fn fewer_than_two_points_are_not_a_profile() {
        assert!(complaint("").1.contains("none is found"));
        assert!(complaint("x,z\n1,2\n").1.contains("only one is found"));
    }

    proptest! {
        #[test]
        fn what_was_written_is_read(
            points in prop::collection::vec((-1e6..1e6f64, -1e6..1e6f64), 2..50), european: bool,
        ) {
            let line = |&(x, z): &(f64, f64)| if european {
                format!("{x};{z}\n").replace('.', ",")
            } else {
                format!("{x}, {z}\n")
            };
            let text: String = points.iter().map(line).collect();
            prop_assert_eq!(read(&text), points);
        }

        #[test]
        fn any_text_gives_points_or_a_place_in_it(text in "[-+.,;# \t\n\r0-9eE\u{feff}aµ]{0,80}") {
            if let Err(error) = csv(&text) {
                prop_assert!(text.get(error.start as usize..error.end as usize).is_some());
            }
        }
    }
}

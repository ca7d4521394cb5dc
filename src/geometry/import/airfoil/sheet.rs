//! The points of an airfoil file among whatever else it holds.
//!
//! What XFOIL reads is read: lines that begin with `#` are comments, a line of four or five numbers before the points is the
//! grid of an ISES or MSES file, and `999.0 999.0` separates the elements of the latter (its manual, "Airfoil file
//! formats"). Numbers may have the exponent `D` of Fortran. Comments may begin with `!`, `%` or `//` too, may follow the numbers of
//! a line, and a decimal comma is understood where blanks, tabs or semicolons separate.

use super::{Altered, Range, Repair, Side, Vertex, sides};
use crate::import::{DataError, Piece, coordinate_of, lines, number};
use crate::point::Point2;

/// What stands in a file.
pub(super) struct Sheet {
    pub(super) title: String,
    /// The points in the order written, without the line of counts.
    pub(super) points: Vec<Vertex>,
    rows: Vec<Range<usize>>,
    /// Where the points stand.
    pub(super) range: Range<usize>,
    /// What is not taken as it is written.
    pub(super) repairs: Vec<Repair>,
}

impl Sheet {
    /// Adds a repair at the rows from one to another.
    pub(super) fn repaired(&mut self, first: usize, last: usize, altered: Altered) {
        let place = |row: usize| self.rows.get(row).cloned().unwrap_or(self.range.clone());
        let (first, last) = (place(first.min(last)), place(first.max(last)));
        self.repairs.push(Repair::new(first.start..last.end, altered));
    }

    /// Adds the points of sides that lie inside of their outline.
    pub(super) fn note_inside(&mut self, pair: &sides::Pair) {
        for (side, name) in [(&pair.upper, Side::Upper), (&pair.lower, Side::Lower)] {
            let rows = side.inside.iter().map(|inside| inside.row);
            let deep = side.inside.iter().map(|inside| inside.deep).fold(0.0, f64::max);
            if let (Some(first), Some(last)) = (rows.clone().min(), rows.max()) {
                let count = side.inside.len();
                let chord = pair.end - pair.start;
                self.repaired(
                    first,
                    last,
                    Altered::Inside {
                        side: name,
                        count,
                        deep: deep / chord,
                    },
                );
            }
        }
    }
}

/// Two numbers of a line, and a third if there is one.
#[derive(Clone, Copy)]
struct Row {
    at: Point2,
    third: Option<f64>,
}

/// What has been read so far.
#[derive(Default)]
struct Reading<'a> {
    title: Option<&'a str>,
    points: Vec<Row>,
    rows: Vec<Range<usize>>,
    /// Where the points of an element end, and where the line stands that says so.
    elements: Vec<(usize, Range<usize>)>,
    /// The number of points when the first empty line after one came.
    first_gap: Option<usize>,
    /// Lines of words since the last point.
    words_after: Vec<Piece<'a>>,
    repairs: Vec<Repair>,
}

/// Reads the points of a file.
///
/// # Errors
/// Lines that are not two numbers, and several elements.
pub(super) fn read(text: &str) -> Result<Sheet, DataError> {
    let mut reading = Reading::default();
    for line in lines(text) {
        reading.take(line)?;
    }
    reading.note_trailing();
    reading.without_a_third_column()?;
    reading.one_element()?;
    let counts = reading.take_counts();
    let range = match (reading.rows.first(), reading.rows.last()) {
        (Some(first), Some(last)) => first.start..last.end,
        (None, _) | (_, None) => 0..text.len(),
    };
    let vertex = |(row, point): (usize, &Row)| Vertex { at: point.at, row };
    Ok(Sheet {
        title: reading.title.unwrap_or_default().to_owned(),
        points: reading
            .points
            .iter()
            .enumerate()
            .map(vertex)
            .skip(counts)
            .collect(),
        rows: reading.rows,
        range,
        repairs: reading.repairs,
    })
}

impl<'a> Reading<'a> {
    fn take(&mut self, line: Piece<'a>) -> Result<(), DataError> {
        let plain = without_comment(line);
        if line.text.is_empty() {
            if !self.points.is_empty() {
                self.first_gap.get_or_insert(self.points.len());
            }
            return Ok(());
        }
        if plain.text.is_empty() || (self.points.is_empty() && is_of_a_grid(plain)) {
            return Ok(());
        }
        match row(plain)? {
            Some(point) if is_separator(point) => self.elements.push((self.points.len(), plain.range())),
            Some(point) => {
                self.pass_over_words()?;
                self.points.push(point);
                self.rows.push(plain.range());
            }
            None if self.points.is_empty() && self.title.is_none() => self.title = Some(line.text),
            None if starts_with_number(plain) => return Err(not_a_pair(plain)),
            None if self.points.is_empty() => {}
            None => self.words_after.push(plain),
        }
        Ok(())
    }

    /// Words between points are headings, such as `lower side`. A line with a digit may as well be a point that is written wrong.
    fn pass_over_words(&mut self) -> Result<(), DataError> {
        for words in self.words_after.drain(..) {
            if words.text.bytes().any(|byte| byte.is_ascii_digit()) {
                return Err(not_a_pair(words));
            }
            self.repairs.push(Repair::new(words.range(), Altered::Words));
        }
        Ok(())
    }

    /// Words after the last point are remarks. Those with a digit may as well be points that are written wrong, so they are said.
    fn note_trailing(&mut self) {
        let has_digit = |words: &&Piece<'_>| words.text.bytes().any(|byte| byte.is_ascii_digit());
        let doubtful: Vec<Range<usize>> = self
            .words_after
            .iter()
            .filter(has_digit)
            .map(|words| words.range())
            .collect();
        if let (Some(first), Some(last)) = (doubtful.first(), doubtful.last()) {
            let count = doubtful.len();
            let altered = Altered::Trailing { count };
            self.repairs.push(Repair::new(first.start..last.end, altered));
        }
    }

    /// A third number that is the same in all rows is the constant of a section from a drawing in space.
    fn without_a_third_column(&mut self) -> Result<(), DataError> {
        let Some(odd) = self.points.iter().position(|row| row.third.is_some()) else {
            return Ok(());
        };
        let first = self.points.first().and_then(|row| row.third);
        let is_first = |row: &Row| matches!((row.third, first), (Some(one), Some(other)) if one.total_cmp(&other).is_eq());
        let place = self.rows.get(odd).cloned().unwrap_or_default();
        if !self.points.iter().all(is_first) {
            return Err(DataError::new(place, NOT_A_PAIR));
        }
        let altered = Altered::Column {
            value: first.unwrap_or_default(),
        };
        self.repairs.push(Repair::new(place, altered));
        Ok(())
    }

    /// A file may begin or end with a separator, but a profile is of one element.
    fn one_element(&self) -> Result<(), DataError> {
        let all = self.points.len();
        let within = |(count, _): &&(usize, Range<usize>)| *count > 0 && *count < all;
        let Some((_, place)) = self.elements.iter().find(within) else {
            return Ok(());
        };
        let mut ends: Vec<usize> = self
            .elements
            .iter()
            .filter(within)
            .map(|(count, _)| *count)
            .collect();
        ends.dedup();
        let message = format!(
            "lines like this separate the {} elements of the file: keep the one you need in a separate file",
            ends.len() + 1
        );
        Err(DataError::new(place.clone(), message))
    }

    /// How many rows at the start are not points but say how many there are: 0 or 1.
    fn take_counts(&mut self) -> usize {
        let Some((first, rest)) = self.points.split_first() else {
            return 0;
        };
        let is_count = |value: f64| value >= 2.0 && (value - value.round()).abs() < 1e-9;
        if !is_count(first.at.x) || !is_count(first.at.z) {
            return 0;
        }
        let adds_up = (first.at.x + first.at.z - rest.len() as f64).abs() < 0.5;
        if adds_up {
            return 1;
        }
        // Counts that are wrong are still none of the points when they stand apart from them, by a line or by their size.
        let is_far = rest.len() > 2 && rest.iter().all(|row| row.at.x.abs() <= first.at.x / 2.0);
        if self.first_gap != Some(1) && !is_far {
            return 0;
        }
        let altered = Altered::Counts {
            stated: first.at.x + first.at.z,
            found: rest.len(),
        };
        let place = self.rows.first().cloned().unwrap_or_default();
        self.repairs.push(Repair::new(place, altered));
        1
    }
}

/// A line up to where a comment begins.
fn without_comment(line: Piece<'_>) -> Piece<'_> {
    if line.text.starts_with('%') {
        return Piece::trimmed("", line.start);
    }
    let end = ["#", "!", "//"]
        .iter()
        .filter_map(|mark| line.text.find(mark))
        .min()
        .unwrap_or(line.text.len());
    Piece::trimmed(line.text.get(..end).unwrap_or_default(), line.start)
}

/// The parts of a line between blanks, tabs, commas and semicolons.
fn parts(line: Piece<'_>) -> impl Iterator<Item = Piece<'_>> {
    between(line, |c| matches!(c, ' ' | '\t' | ',' | ';'))
}

fn between(line: Piece<'_>, is_separator: impl Fn(char) -> bool) -> impl Iterator<Item = Piece<'_>> {
    line.split(is_separator).filter(|part| !part.text.is_empty())
}

/// The point on a line that consists of two or three numbers; none on other lines.
fn row(line: Piece<'_>) -> Result<Option<Row>, DataError> {
    if let Some((x, z)) = with_decimal_commas(line) {
        let place = |message| DataError::new(line.range(), message);
        let read = |text: &str| coordinate_of(text, text).map_err(place);
        return Ok(Some(Row {
            at: Point2::new(read(&x)?, read(&z)?),
            third: None,
        }));
    }
    let mut parts = parts(line);
    let (Some(x), Some(z), third, None) = (parts.next(), parts.next(), parts.next(), parts.next()) else {
        return Ok(None);
    };
    let is_number = |part: Piece<'_>| decimal(part.text).is_some();
    if !is_number(x) || !is_number(z) || third.is_some_and(|part| !is_number(part)) {
        return Ok(None);
    }
    Ok(Some(Row {
        at: Point2::new(coordinate(x)?, coordinate(z)?),
        third: third.map(coordinate).transpose()?,
    }))
}

/// The two numbers of a line such as `0,9503 0,0121`, with points instead of commas.
fn with_decimal_commas(line: Piece<'_>) -> Option<(String, String)> {
    let mut parts = between(line, |c| matches!(c, ' ' | '\t' | ';'));
    let (x, z, None) = (parts.next()?, parts.next()?, parts.next()) else {
        return None;
    };
    let has_one = |part: Piece<'_>| {
        let mut halves = part.text.split(',');
        let (Some(_), Some(decimals), None) = (halves.next(), halves.next(), halves.next()) else {
            return false;
        };
        !decimals.is_empty() && !part.text.contains('.') && number(&part.text.replace(',', ".")).is_some()
    };
    (has_one(x) && has_one(z)).then(|| (x.text.replace(',', "."), z.text.replace(',', ".")))
}

/// A number, which may have the exponent of Fortran's double precision.
fn decimal(text: &str) -> Option<f64> {
    number(text).or_else(|| number(&text.replace(['d', 'D'], "e")))
}

fn coordinate(part: Piece<'_>) -> Result<f64, DataError> {
    let text = part.text.replace(['d', 'D'], "e");
    coordinate_of(&text, part.text).map_err(|message| DataError::new(part.range(), message))
}

/// Whether a line has four or five numbers: before the points ISES and MSES, and with them XFOIL, have the ends of a grid there.
fn is_of_a_grid(line: Piece<'_>) -> bool {
    let count = parts(line).count();
    (4..=5).contains(&count)
        && with_decimal_commas(line).is_none()
        && parts(line).all(|part| decimal(part.text).is_some())
}

/// Whether a row is what MSES writes between elements.
fn is_separator(row: Row) -> bool {
    const MARK: f64 = 999.0;
    (row.at.x - MARK).abs() < 1e-9 && (row.at.z - MARK).abs() < 1e-9
}

fn starts_with_number(line: Piece<'_>) -> bool {
    parts(line)
        .next()
        .is_some_and(|part| decimal(part.text).is_some())
}

const NOT_A_PAIR: &str = "a line of airfoil coordinates is two numbers, x and z";

fn not_a_pair(line: Piece<'_>) -> DataError {
    DataError::new(line.range(), NOT_A_PAIR)
}

//! STL: triangles corner by corner, as bytes or as text.
//!
//! The bytes are 80 of a header, the number of triangles, and 50 for each: the normal, three corners, two spare bytes; all
//! numbers little-endian, in single precision. The text is
//! `solid NAME facet normal i j k outer loop vertex x y z (three times) endloop endfacet ... endsolid NAME`. A file is binary if
//! and only if its length fits the number in it: headers of binary files may begin with `solid` too. Normals and spare bytes
//! are not looked at: corners say all.
//!
//! Triangles do not share corners in the file. Equal ones are found by sorting, so that no choice of coordinates makes
//! that slow.

use super::gather::Gather;
use super::words::{Word, Words, lines};
use super::{DataError, ReadMesh, fault};
use crate::mesh::MOST_TRIANGLES;
use vcutc_backend_api::geometry::Point3;
use vcutc_geometry::curve::LARGEST_COORDINATE;

/// Bytes before the first triangle.
const HEAD: usize = 84;

/// Bytes of a triangle.
const TRIANGLE: usize = 50;

/// Reads an STL file, binary or text. Corners with the same coordinates become one.
///
/// # Errors
/// A length that does not fit the number of triangles, coordinates that are not numbers or out of range, and
/// text that is not STL; a file without a triangle that has an area.
pub fn stl(bytes: &[u8]) -> Result<ReadMesh, DataError> {
    let count = bytes
        .get(80..HEAD)
        .and_then(|count| Some(u32::from_le_bytes(count.try_into().ok()?)));
    let promised = count.map(|count| HEAD as u64 + TRIANGLE as u64 * u64::from(count));
    let corners = if promised == Some(bytes.len() as u64) {
        binary(bytes)?
    } else if is_text(bytes) {
        text(bytes)?
    } else if let Some(other) = other_form(bytes) {
        return Err(fault(
            0..bytes.len().min(HEAD),
            format!(
                "these are the contents of a file in {other}: give it a name that ends in `.{}`",
                other.to_ascii_lowercase()
            ),
        ));
    } else if let (Some(count), Some(promised)) = (count, promised) {
        return Err(fault(
            80..HEAD,
            format!(
                "the file promises {count} triangles, which take {promised} bytes; it has {}",
                bytes.len()
            ),
        ));
    } else {
        return Err(fault(
            0..bytes.len(),
            "this is neither a binary STL file nor one of text",
        ));
    };
    welded(&corners).finish(bytes.len())
}

/// Whether a file that is not binary looks like text: it begins with `solid` and a header's length is without zero bytes.
fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.get(..HEAD).unwrap_or(bytes);
    let first = Words::new(start, after_mark(bytes)).next();
    first.is_some_and(|word| word.is("solid")) && !start.contains(&0)
}

/// Where a text begins: some programs put a byte order mark before it.
fn after_mark(bytes: &[u8]) -> usize {
    const MARK: &[u8] = b"\xEF\xBB\xBF";
    if bytes.starts_with(MARK) { MARK.len() } else { 0 }
}

/// The form of a file of triangles that is not STL, if it begins as another one does.
fn other_form(bytes: &[u8]) -> Option<&'static str> {
    const LINES: usize = 100;
    let start = after_mark(bytes);
    let first = |line: Word<'_>| Words::new(bytes.get(..line.range().end)?, line.start).next();
    let mut words = lines(bytes.get(start..)?).take(LINES).filter_map(|line| {
        first(Word {
            start: line.start + start,
            ..line
        })
    });
    let named = words.next()?;
    if named.bytes == b"ply" {
        return Some("PLY");
    }
    let is_corner = |word: Word<'_>| word.bytes == b"v";
    let is_plain = bytes
        .get(..bytes.len().min(HEAD))
        .is_some_and(|head| !head.contains(&0));
    (is_plain && (is_corner(named) || words.any(is_corner))).then_some("OBJ")
}

/// A corner as the file has it.
type Single = [f32; 3];

fn binary(bytes: &[u8]) -> Result<Vec<Single>, DataError> {
    let body = bytes.get(HEAD..).unwrap_or_default();
    check_count(body.len() / TRIANGLE, HEAD)?;
    let mut corners = Vec::with_capacity(body.len() / TRIANGLE * 3);
    for (place, triangle) in (0..).zip(body.chunks_exact(TRIANGLE)) {
        let numbers = triangle.get(12..48).unwrap_or_default();
        for (corner, bytes) in (0..).zip(numbers.chunks_exact(12)) {
            let (parts, _) = bytes.as_chunks::<4>();
            let &[x, y, z] = parts else { continue };
            let point = [x, y, z].map(f32::from_le_bytes);
            // NaN compares as false.
            if !point
                .iter()
                .all(|part| f64::from(part.abs()) <= LARGEST_COORDINATE)
            {
                let start = HEAD + place * TRIANGLE + 12 + corner * 12;
                return Err(fault(
                    start..start + 12,
                    format!(
                        "a corner of triangle {} is not in the range of coordinates",
                        place + 1
                    ),
                ));
            }
            corners.push(point);
        }
    }
    Ok(corners)
}

fn check_count(triangles: usize, at: usize) -> Result<(), DataError> {
    if triangles > MOST_TRIANGLES {
        return Err(fault(
            at..at,
            format!("there are more than {MOST_TRIANGLES} triangles"),
        ));
    }
    Ok(())
}

fn text(bytes: &[u8]) -> Result<Vec<Single>, DataError> {
    let mut corners = Vec::new();
    let mut words = Words::new(bytes, after_mark(bytes));
    while let Some(word) = words.next() {
        if word.is("solid") || word.is("endsolid") {
            // Names may be anything up to the end of the line.
            words.end_line();
        } else if word.is("facet") {
            check_count(corners.len() / 3, word.start)?;
            facet(&mut words, &mut corners)?;
        } else {
            return Err(unexpected(word, "facet"));
        }
    }
    Ok(corners)
}

/// What stands after the word `facet`, up to `endfacet`.
fn facet(words: &mut Words<'_>, corners: &mut Vec<Single>) -> Result<(), DataError> {
    expect(words, "normal")?;
    for _ in 0..3 {
        // Normals that are not numbers occur, on triangles without area.
        some(words)?;
    }
    expect(words, "outer")?;
    expect(words, "loop")?;
    for _ in 0..3 {
        expect(words, "vertex")?;
        let mut point = [0.0; 3];
        for part in &mut point {
            *part = some(words)?.single()?;
        }
        corners.push(point);
    }
    expect(words, "endloop")?;
    expect(words, "endfacet")
}

fn some<'a>(words: &mut Words<'a>) -> Result<Word<'a>, DataError> {
    words
        .next()
        .ok_or_else(|| fault(words.end(), "the file ends within a facet"))
}

fn expect(words: &mut Words<'_>, wanted: &str) -> Result<(), DataError> {
    let word = some(words)?;
    if word.is(wanted) {
        Ok(())
    } else {
        Err(unexpected(word, wanted))
    }
}

fn unexpected(word: Word<'_>, wanted: &str) -> DataError {
    fault(
        word.range(),
        format!("`{}` stands where `{wanted}` is expected", word.shown()),
    )
}

/// Triangles of corners given one after the other, equal ones made one.
fn welded(corners: &[Single]) -> Gather {
    // Coordinates and, in the lowest bits, which corner it is.
    let mut keys: Vec<u128> = (0_u32..)
        .zip(corners)
        .map(|(place, point)| {
            // Both zeros are one place.
            let [x, y, z] = point.map(|part| u128::from((part + 0.0).to_bits()));
            x << 96 | y << 64 | z << 32 | u128::from(place)
        })
        .collect();
    keys.sort_unstable();
    let mut gather = Gather::default();
    let mut numbers = vec![0_u32; corners.len()];
    let mut last = None;
    let mut number = 0;
    for key in keys {
        let (coordinates, place) = (key >> 32, (key & u128::from(u32::MAX)) as u32);
        if last != Some(coordinates) {
            last = Some(coordinates);
            number = gather.corners.len() as u32;
            let part = |shift: u32| f64::from(f32::from_bits((coordinates >> shift) as u32));
            gather.corners.push(Point3::new(part(64), part(32), part(0)));
        }
        if let Some(slot) = numbers.get_mut(place as usize) {
            *slot = number;
        }
    }
    gather.triangles.reserve_exact(numbers.len() / 3);
    let (triangles, _) = numbers.as_chunks::<3>();
    for named in triangles {
        gather.triangle(*named);
    }
    gather
}

//! OBJ: corners, and polygons that name them.
//!
//! Lines `v x y z` and `f a b c ...` are read; an index may be negative (counted back from the last corner so far) and may have
//! further indices after slashes, which belong to textures and normals. A line goes on after a backslash at
//! its end. Every other kind of line is counted and passed over.

use super::gather::Gather;
use super::words::{Word, Words, lines};
use super::{DataError, ReadMesh, fault};

/// Reads the polygons of an OBJ file as fans of triangles.
///
/// # Errors
/// Corners that are not numbers or out of range, faces that name corners which do not exist, that pass a
/// corner twice, or that are concave; a file without a triangle that has an area.
pub fn obj(bytes: &[u8]) -> Result<ReadMesh, DataError> {
    let mut gather = Gather::default();
    let mut named = Vec::new();
    // The face that goes on in the next line, and where it starts.
    let mut face: Option<usize> = None;
    for line in lines(bytes) {
        let content = line.bytes.split(|&b| b == b'#').next().unwrap_or_default();
        let (content, goes_on) = match content.trim_ascii_end().strip_suffix(b"\\") {
            Some(content) => (content, true),
            None => (content, false),
        };
        let end = line.start + content.len();
        let mut words = Words::new(bytes.get(..end).unwrap_or_default(), line.start);
        let start = match face.take() {
            Some(start) => start,
            None => match words.next() {
                None => continue,
                Some(word) if word.bytes == b"f" => word.start,
                Some(word) if word.bytes == b"v" => {
                    gather.corners.push(corner(&mut words, line)?);
                    continue;
                }
                Some(word) => {
                    gather.remarks.pass_over(&word.shown(), 1);
                    continue;
                }
            },
        };
        for word in words {
            named.push(index(word, gather.corners.len())?);
        }
        if goes_on {
            face = Some(start);
        } else {
            gather.polygon(&mut named, start..end)?;
            named.clear();
        }
    }
    match face {
        Some(start) => Err(fault(start..bytes.len(), "the file ends within this face")),
        None => gather.finish(bytes.len()),
    }
}

/// The corner of a line, after its `v`. More numbers than three are weights and colours.
fn corner(words: &mut Words<'_>, line: Word<'_>) -> Result<vcutc_backend_api::geometry::Point3, DataError> {
    let mut parts = [0.0; 3];
    for part in &mut parts {
        let word = words
            .next()
            .ok_or_else(|| fault(line.range(), "a corner takes three numbers"))?;
        *part = word.coordinate()?;
    }
    Ok(parts.into())
}

/// The corner that a word of a face names, among so many.
fn index(word: Word<'_>, corners: usize) -> Result<u32, DataError> {
    let bytes = word.bytes.split(|&b| b == b'/').next().unwrap_or_default();
    let number = Word { bytes, ..word }.whole().ok_or_else(|| {
        fault(
            word.range(),
            format!("`{}` is not the number of a corner", word.shown()),
        )
    })?;
    let count = i64::try_from(corners).unwrap_or(i64::MAX);
    let index = if number < 0 {
        count.saturating_add(number)
    } else {
        number - 1
    };
    u32::try_from(index)
        .ok()
        .filter(|_| index < count)
        .ok_or_else(|| {
            fault(
                word.range(),
                format!("corner {number} is not among the {corners} up to here"),
            )
        })
}

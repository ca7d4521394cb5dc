//! The head of a PLY file.

use super::super::words::{Word, Words, lines};
use super::super::{DataError, fault};
use core::ops::Range;

/// Elements of a file, and properties of all of them together: there are a handful.
const MOST_DECLARED: usize = 1000;

/// How the data is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of(word: Word<'_>) -> Option<Self> {
        Some(match word.bytes {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Its bytes.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

/// What a property consists of.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    Single(Kind),
    List { count: Kind, kind: Kind },
}

#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) shape: Shape,
}

#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    /// Where it is declared.
    pub(super) range: Range<usize>,
}

impl Element {
    /// The bytes that an item takes at least.
    pub(super) fn least_size(&self, form: Form) -> usize {
        let size = |property: &Property| match (form, property.shape) {
            // A digit and a blank.
            (Form::Text, _) => 2,
            (Form::LittleEndian | Form::BigEndian, Shape::Single(kind)) => kind.size(),
            (Form::LittleEndian | Form::BigEndian, Shape::List { count, .. }) => count.size(),
        };
        self.properties.iter().map(size).sum()
    }
}

#[derive(Debug)]
pub(super) struct Head {
    pub(super) form: Form,
    pub(super) elements: Vec<Element>,
    /// Where the data starts.
    pub(super) end: usize,
}

/// Reads the head.
pub(super) fn head(bytes: &[u8]) -> Result<Head, DataError> {
    let mut lines = lines(bytes);
    match lines.next() {
        Some(line) if line.start == 0 && line.bytes.trim_ascii_end() == b"ply" => {}
        _ => {
            let end = bytes.len().min(3);
            return Err(fault(0..end, "a PLY file begins with the line `ply`"));
        }
    }
    let mut form = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut declared = 0;
    for line in lines {
        let mut words = Words::new(bytes.get(..line.range().end).unwrap_or_default(), line.start);
        let Some(keyword) = words.next() else { continue };
        match keyword.bytes {
            b"comment" | b"obj_info" => {}
            b"format" => form = Some(form_of(words.next(), line)?),
            b"element" => {
                declared += 1;
                elements.push(element(words.next(), words.next(), line)?);
            }
            b"property" => {
                declared += 1;
                let property = property(&mut words, line)?;
                match elements.last_mut() {
                    Some(element) => element.properties.push(property),
                    None => return Err(fault(line.range(), "this property belongs to no element")),
                }
            }
            b"end_header" => {
                let form = form.ok_or_else(|| fault(line.range(), "the head has no line `format`"))?;
                let end = after_line(bytes, line.range().end);
                return Ok(Head { form, elements, end });
            }
            _ => {
                let message = format!("`{}` is not a line of the head of a PLY file", keyword.shown());
                return Err(fault(keyword.range(), message));
            }
        }
        if declared > MOST_DECLARED {
            return Err(fault(
                line.range(),
                format!("more than {MOST_DECLARED} elements and properties"),
            ));
        }
    }
    Err(fault(
        bytes.len()..bytes.len(),
        "the file ends before the line `end_header`",
    ))
}

/// Where the line after one begins that ends there. CR LF is one end: bytes that follow are data.
fn after_line(bytes: &[u8], end: usize) -> usize {
    match bytes.get(end..) {
        Some([b'\r', b'\n', ..]) => end + 2,
        _ => end + 1,
    }
}

fn form_of(word: Option<Word<'_>>, line: Word<'_>) -> Result<Form, DataError> {
    match word.map(|word| word.bytes) {
        Some(b"ascii") => Ok(Form::Text),
        Some(b"binary_little_endian") => Ok(Form::LittleEndian),
        Some(b"binary_big_endian") => Ok(Form::BigEndian),
        _ => Err(fault(
            line.range(),
            "the format is `ascii`, `binary_little_endian` or `binary_big_endian`",
        )),
    }
}

fn element(name: Option<Word<'_>>, count: Option<Word<'_>>, line: Word<'_>) -> Result<Element, DataError> {
    let count = count
        .and_then(Word::whole)
        .and_then(|count| u64::try_from(count).ok());
    match (name, count) {
        (Some(name), Some(count)) => Ok(Element {
            name: name.shown(),
            count,
            properties: Vec::new(),
            range: line.range(),
        }),
        _ => Err(fault(line.range(), "an element has a name and a number of items")),
    }
}

fn property(words: &mut Words<'_>, line: Word<'_>) -> Result<Property, DataError> {
    let kind = |word: Option<Word<'_>>| {
        word.and_then(Kind::of)
            .ok_or_else(|| fault(line.range(), "this property has no type that PLY files have"))
    };
    let first = words.next();
    let shape = if first.is_some_and(|word| word.bytes == b"list") {
        Shape::List {
            count: kind(words.next())?,
            kind: kind(words.next())?,
        }
    } else {
        Shape::Single(kind(first)?)
    };
    let name = words
        .next()
        .ok_or_else(|| fault(line.range(), "this property has no name"))?;
    Ok(Property {
        name: name.shown(),
        shape,
    })
}

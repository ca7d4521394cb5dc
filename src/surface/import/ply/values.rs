//! The data of a PLY file, number by number.

use super::super::words::Words;
use super::super::{DataError, fault};
use super::head::{Form, Kind};
use vcutc_geometry::curve::LARGEST_COORDINATE;

/// The order of the bytes of a number.
#[derive(Clone, Copy, Debug)]
pub(super) enum Order {
    Little,
    Big,
}

/// The numbers that follow.
#[derive(Debug)]
pub(super) enum Values<'a> {
    Text {
        words: Words<'a>,
        /// One past the last byte that was read.
        at: usize,
        length: usize,
    },
    Binary {
        bytes: &'a [u8],
        at: usize,
        order: Order,
    },
}

/// The numbers from a byte of the file on.
pub(super) fn values(bytes: &[u8], form: Form, at: usize) -> Values<'_> {
    let binary = |order| Values::Binary { bytes, at, order };
    match form {
        Form::Text => Values::Text {
            words: Words::new(bytes, at),
            at,
            length: bytes.len(),
        },
        Form::LittleEndian => binary(Order::Little),
        Form::BigEndian => binary(Order::Big),
    }
}

impl Values<'_> {
    /// Where the next number starts, or blanks before it.
    pub(super) const fn place(&self) -> usize {
        match self {
            Self::Text { at, .. } | Self::Binary { at, .. } => *at,
        }
    }

    /// How many bytes are left.
    pub(super) const fn left(&self) -> usize {
        let length = match self {
            Self::Text { length, .. } => *length,
            Self::Binary { bytes, .. } => bytes.len(),
        };
        length.saturating_sub(self.place())
    }

    /// The next number, as a coordinate.
    pub(super) fn coordinate(&mut self, kind: Kind) -> Result<f64, DataError> {
        match self {
            Self::Text { words, at, length } => {
                let word = words.next().ok_or_else(|| ends(*length))?;
                *at = word.range().end;
                word.coordinate()
            }
            Self::Binary { bytes, at, order } => {
                let start = *at;
                let value = number(bytes, at, *order, kind)?;
                // NaN compares as false.
                if value.abs() <= LARGEST_COORDINATE {
                    Ok(value)
                } else {
                    Err(fault(
                        start..*at,
                        "this number is not in the range of coordinates",
                    ))
                }
            }
        }
    }

    /// The next number, which must be whole and not negative.
    pub(super) fn whole(&mut self, kind: Kind) -> Result<u64, DataError> {
        let (value, range) = match self {
            Self::Text { words, at, length } => {
                let word = words.next().ok_or_else(|| ends(*length))?;
                *at = word.range().end;
                let value = word.whole().and_then(|value| u64::try_from(value).ok());
                (value, word.range())
            }
            Self::Binary { bytes, at, order } => {
                let start = *at;
                let value = number(bytes, at, *order, kind)?;
                // All whole numbers of these types are exact as doubles, and anything larger counts nothing here.
                let is_whole = (0.0..=f64::from(u32::MAX)).contains(&value) && value.fract() == 0.0;
                (is_whole.then_some(value as u64), start..*at)
            }
        };
        value.ok_or_else(|| fault(range, "a whole number from 0 on is expected here"))
    }

    /// Passes over so many numbers.
    pub(super) fn skip(&mut self, kind: Kind, count: u64) -> Result<(), DataError> {
        match self {
            Self::Text { words, at, length } => {
                for _ in 0..count {
                    let word = words.next().ok_or_else(|| ends(*length))?;
                    *at = word.range().end;
                }
            }
            Self::Binary { bytes, at, .. } => {
                let size = usize::try_from(count)
                    .ok()
                    .and_then(|count| count.checked_mul(kind.size()))
                    .filter(|&size| size <= bytes.len().saturating_sub(*at))
                    .ok_or_else(|| ends(bytes.len()))?;
                *at += size;
            }
        }
        Ok(())
    }
}

fn ends(length: usize) -> DataError {
    fault(length..length, "the file ends before all its elements are there")
}

fn number(bytes: &[u8], at: &mut usize, order: Order, kind: Kind) -> Result<f64, DataError> {
    let rest = bytes.get(*at..).unwrap_or_default();
    macro_rules! read {
        ($type:ty) => {{
            let raw = *rest.first_chunk().ok_or_else(|| ends(bytes.len()))?;
            f64::from(match order {
                Order::Little => <$type>::from_le_bytes(raw),
                Order::Big => <$type>::from_be_bytes(raw),
            })
        }};
    }
    let value = match kind {
        Kind::I8 => read!(i8),
        Kind::U8 => read!(u8),
        Kind::I16 => read!(i16),
        Kind::U16 => read!(u16),
        Kind::I32 => read!(i32),
        Kind::U32 => read!(u32),
        Kind::F32 => read!(f32),
        Kind::F64 => read!(f64),
    };
    *at += kind.size();
    Ok(value)
}

//! Data that a page carries for its scripts: JSON, with columns of numbers as little-endian bytes in base64 (RFC 4648).

use super::base64::base64;
use serde_json::Value;

/// A number that a column can hold.
pub(crate) trait Packed {
    /// Appends its bytes, the least significant first.
    fn pack(&self, bytes: &mut Vec<u8>);
}

macro_rules! packed {
    ($($number:ty),*) => {
        $(impl Packed for $number {
            fn pack(&self, bytes: &mut Vec<u8>) {
                bytes.extend_from_slice(&self.to_le_bytes());
            }
        })*
    };
}

packed!(u8, u16, u32, i32, f64);

#[must_use]
pub(crate) fn column<N: Packed>(numbers: &[N]) -> String {
    let mut bytes = Vec::with_capacity(size_of_val(numbers));
    for number in numbers {
        number.pack(&mut bytes);
    }
    base64(&bytes)
}

/// Data as JSON text. What could end the element that holds it is written as an escape: a `<` can stand in strings only.
#[must_use]
pub(crate) fn document(value: &Value) -> String {
    value
        .to_string()
        .replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('&', "\\u0026")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_come_least_significant_first() {
        assert_eq!(column(&[0x0201_u16, 0x0403]), base64(&[1, 2, 3, 4]));
        assert_eq!(column(&[-1_i32]), base64(&[255; 4]));
    }
}

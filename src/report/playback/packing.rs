//! Columns of numbers as text: little-endian bytes in base64 (RFC 4648).

use crate::base64::base64;

/// A number that a column can hold.
pub(super) trait Packed {
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
pub(super) fn column<N: Packed>(numbers: &[N]) -> String {
    let mut bytes = Vec::with_capacity(size_of_val(numbers));
    for number in numbers {
        number.pack(&mut bytes);
    }
    base64(&bytes)
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

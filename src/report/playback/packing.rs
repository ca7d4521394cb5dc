//! Columns of numbers as text: little-endian bytes in base64 (RFC 4648).

/// The digits of base64.
const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

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

/// A column as text.
#[must_use]
pub(super) fn column<N: Packed>(numbers: &[N]) -> String {
    let mut bytes = Vec::with_capacity(size_of_val(numbers));
    for number in numbers {
        number.pack(&mut bytes);
    }
    base64(&bytes)
}

fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let bits = (0..3).fold(0_u32, |bits, i| {
            bits << 8 | u32::from(three.get(i).copied().unwrap_or(0))
        });
        for digit in 0..4 {
            let place = (bits >> (18 - 6 * digit) & 63) as usize;
            let said = digit <= three.len();
            text.push(if said { char::from(DIGITS[place]) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test vectors of RFC 4648, section 10.
    #[test]
    fn says_what_the_standard_says() {
        let vectors = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (bytes, text) in vectors {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }

    #[test]
    fn bytes_come_least_significant_first() {
        assert_eq!(column(&[0x0201_u16, 0x0403]), base64(&[1, 2, 3, 4]));
        assert_eq!(column(&[-1_i32]), base64(&[255; 4]));
    }
}

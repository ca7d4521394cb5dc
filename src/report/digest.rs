//! SHA-256 of texts and files (FIPS 180-4): scripts are allowed by it, and programs known again.

use hmac_sha256::Hash;

/// The digest of bytes.
pub(super) fn sha256(bytes: &[u8]) -> [u8; 32] {
    Hash::hash(bytes)
}

/// The same as 64 digits, as `sha256sum` prints it.
pub(super) fn hexadecimal(bytes: &[u8]) -> String {
    sha256(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of FIPS 180-4 for one block.
    #[test]
    fn digests_are_those_of_the_standard() {
        assert_eq!(
            hexadecimal(b"abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
    }
}

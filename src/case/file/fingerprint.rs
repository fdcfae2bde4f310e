//! Files known again by their bytes.

use sha2::{Digest, Sha256};

/// The SHA-256 of some bytes in hexadecimal digits, as `sha256sum` prints it: what people compare.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The 64-bit hash of Fowler, Noll and Vo (FNV-1a) of some texts and their lengths, in hexadecimal digits.
pub fn fingerprint(texts: &[&[u8]]) -> String {
    let lengths: Vec<[u8; 8]> = texts.iter().map(|text| (text.len() as u64).to_le_bytes()).collect();
    let bytes = lengths.iter().flatten().chain(texts.iter().copied().flatten());
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    format!("{hash:016x}")
}

/// What a run is to be made of, so that it can refuse anything else: fingerprints of its case file and of its mesh, a file that
/// cannot be read counting as an empty one.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct Inputs {
    /// Fingerprint of the case file.
    pub case: String,
    /// Fingerprint of the mesh file.
    pub mesh: String,
}

impl Inputs {
    /// Of the bytes of both files.
    pub fn of(case: &[u8], mesh: &[u8]) -> Self {
        Self { case: fingerprint(&[case]), mesh: fingerprint(&[mesh]) }
    }

    /// As one word of a command line.
    pub fn word(&self) -> String {
        format!("{}:{}", self.case, self.mesh)
    }

    /// Reads [`word`](Self::word).
    ///
    /// # Errors
    /// It is none.
    pub fn parse(word: &str) -> Result<Self, String> {
        let (case, mesh) = word.split_once(':').ok_or("must be two fingerprints with a colon between them")?;
        Ok(Self { case: case.into(), mesh: mesh.into() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fingerprints_tell_texts_apart() {
        assert_eq!(fingerprint(&[]), "cbf29ce484222325");
        assert_ne!(fingerprint(&[b"ab", b"c"]), fingerprint(&[b"a", b"bc"]));
        assert_ne!(fingerprint(&[b""]), fingerprint(&[b"", b""]));
    }

    #[test]
    fn the_hash_is_that_of_sha256sum() {
        assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }

    #[test]
    fn inputs_are_one_word() {
        let inputs = Inputs::of(b"a case", b"a mesh");
        assert_eq!(Inputs::parse(&inputs.word()), Ok(inputs.clone()));
        assert_ne!(Inputs::of(b"a case", b"another"), inputs);
        assert!(Inputs::parse("1234").is_err());
    }
}

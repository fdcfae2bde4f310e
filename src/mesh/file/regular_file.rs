//! Files that are read as a whole.

use std::fs::File;
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

/// The bytes of a regular file of `most` bytes at most. A pipe might wait for ever, and a device never end.
///
/// # Errors
/// What the operating system says, or words, if it is no such file.
pub fn read_regular(file: &Path, most: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(file)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(refused(&format!("it is larger than {} MB, which such a file never is", most >> 20)));
    }
    Ok(bytes)
}

/// The first bytes of a regular file, `count` of them at most.
///
/// # Errors
/// What the operating system says, or words, if it is no regular file.
pub fn read_start(file: &Path, count: usize) -> Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(count);
    open_regular(file)?.take(count as u64).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn open_regular(file: &Path) -> Result<File> {
    let about = std::fs::metadata(file)?;
    if about.is_dir() {
        return Err(refused("it is a folder"));
    }
    if !about.is_file() {
        return Err(refused("it is no regular file but a pipe or a device; save it as a file"));
    }
    File::open(file)
}

fn refused(words: &str) -> Error {
    Error::new(ErrorKind::InvalidInput, words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pipes_devices_folders_and_long_files_are_refused() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("file");
        std::fs::write(&file, b"12345").expect("a file can be written");
        assert_eq!(read_regular(&file, 5).expect("short enough"), b"12345");
        assert_eq!(read_start(&file, 2).expect("a start"), b"12");
        let refused = |file: &Path, most| read_regular(file, most).expect_err("refused").to_string();
        assert!(refused(&file, 4).contains("larger than"));
        assert!(refused(Path::new("/dev/zero"), 4).contains("no regular file"));
        assert!(refused(folder.path(), 4).contains("folder"));
    }
}

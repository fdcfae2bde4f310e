//! A cursor over the lines and the binary numbers of a mesh file.

use crate::geometry::Quote;
use crate::mesh::{FilePlace, MeshError};
use std::borrow::Cow;
use std::path::Path;
use std::str::FromStr;

/// How numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    /// As text, in lines.
    Text,
    /// As bytes, the lowest first.
    LittleEndian,
    /// As bytes, the highest first.
    BigEndian,
}

/// What has been read of a file, and what comes next.
pub(super) struct Cursor<'a> {
    pub file: &'a Path,
    /// How the sections store their numbers.
    pub encoding: Encoding,
    bytes: &'a [u8],
    /// Where the next byte is.
    at: usize,
    line: usize,
}

impl<'a> Cursor<'a> {
    pub fn new(file: &'a Path, bytes: &'a [u8]) -> Self {
        Self { file, encoding: Encoding::Text, bytes, at: 0, line: 0 }
    }

    pub fn is_text(&self) -> bool {
        self.encoding == Encoding::Text
    }

    /// Where the last line or number was found.
    pub fn place(&self) -> FilePlace {
        if self.is_text() { FilePlace::Line(self.line) } else { FilePlace::Byte(self.at) }
    }

    pub fn error(&self, message: impl Into<String>) -> MeshError {
        MeshError::Syntax { file: self.file.to_path_buf(), place: self.place(), message: message.into() }
    }

    /// Next line that is not blank, or nothing at the end of the file.
    pub fn next_line(&mut self) -> Option<Cow<'a, str>> {
        self.next_bytes().map(String::from_utf8_lossy)
    }

    fn next_bytes(&mut self) -> Option<&'a [u8]> {
        while self.at < self.bytes.len() {
            let rest = &self.bytes[self.at..];
            let length = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
            self.at += (length + 1).min(rest.len());
            self.line += 1;
            let line = rest[..length].trim_ascii();
            if !line.is_empty() {
                return Some(line);
            }
        }
        None
    }

    pub fn line_in(&mut self, section: &str) -> Result<Cow<'a, str>, MeshError> {
        self.next_line().ok_or_else(|| self.cut_off(section))
    }

    fn cut_off(&self, section: &str) -> MeshError {
        self.error(format!("the file ends inside ${section}; it is cut off, save it again"))
    }

    /// The next line as numbers, at least `least` of them.
    pub fn line_of<T: FromStr>(&mut self, section: &str, least: usize) -> Result<Vec<T>, MeshError> {
        let mut values = Vec::new();
        self.line_in_place_of(section, least, &mut values)?;
        Ok(values)
    }

    /// The next line as numbers, at least `least` of them, in the place of those of another line.
    pub fn line_in_place_of<T: FromStr>(&mut self, section: &str, least: usize, values: &mut Vec<T>) -> Result<(), MeshError> {
        let line = self.next_bytes().ok_or_else(|| self.cut_off(section))?;
        values.clear();
        for word in words(line) {
            values.push(number(word).ok_or_else(|| self.numbers_missing(section, least, line))?);
        }
        if values.len() < least { Err(self.numbers_missing(section, least, line)) } else { Ok(()) }
    }

    /// The numbers at the beginning of the next line.
    pub fn line_into<T: FromStr>(&mut self, section: &str, values: &mut [T]) -> Result<(), MeshError> {
        let line = self.next_bytes().ok_or_else(|| self.cut_off(section))?;
        let mut words = words(line);
        for value in values.iter_mut() {
            *value = match words.next().and_then(number) {
                Some(number) => number,
                None => return Err(self.numbers_missing(section, values.len(), line)),
            };
        }
        Ok(())
    }

    /// As [`Cursor::line_in_place_of`], of whole numbers. A line without signs is read digit by digit, without a look for its end and
    /// for its words before.
    pub fn wholes_in_place_of(&mut self, section: &str, least: usize, values: &mut Vec<i64>) -> Result<(), MeshError> {
        match digits(&self.bytes[self.at..], values).filter(|_| values.len() >= least) {
            Some(length) => {
                self.at += length;
                self.line += 1;
                Ok(())
            }
            None => self.line_in_place_of(section, least, values),
        }
    }

    fn numbers_missing(&self, section: &str, least: usize, line: &[u8]) -> MeshError {
        let line = String::from_utf8_lossy(line);
        self.error(format!("in ${section}, expected {least} numbers, found `{}`", Quote(&line)))
    }

    /// The next `N` bytes.
    pub fn bytes<const N: usize>(&mut self, section: &str) -> Result<[u8; N], MeshError> {
        match self.bytes[self.at..].first_chunk::<N>() {
            Some(chunk) => {
                self.at += N;
                Ok(*chunk)
            }
            None => Err(self.cut_off(section)),
        }
    }

    /// The next binary numbers of `WIDTH` bytes, each made of its bytes by the first way if the highest is the first, or by the
    /// second.
    fn numbers<T: Copy + Default, const N: usize, const WIDTH: usize>(
        &mut self,
        section: &str,
        [high_first, low_first]: [fn([u8; WIDTH]) -> T; 2],
    ) -> Result<[T; N], MeshError> {
        let of = if self.encoding == Encoding::BigEndian { high_first } else { low_first };
        let mut values = [T::default(); N];
        for value in &mut values {
            *value = of(self.bytes(section)?);
        }
        Ok(values)
    }

    /// The next binary whole numbers of four bytes.
    pub fn whole<const N: usize>(&mut self, section: &str) -> Result<[i64; N], MeshError> {
        Ok(self.numbers(section, [i32::from_be_bytes, i32::from_le_bytes])?.map(i64::from))
    }

    /// So many binary whole numbers of four bytes.
    pub fn wholes(&mut self, section: &str, count: usize) -> Result<Vec<i64>, MeshError> {
        (0..count).map(|_| self.whole::<1>(section).map(|[number]| number)).collect()
    }

    /// The next binary number of eight bytes that is at least 0: a count, or a tag.
    pub fn size(&mut self, section: &str) -> Result<i64, MeshError> {
        let [number] = self.numbers(section, [u64::from_be_bytes, u64::from_le_bytes])?;
        i64::try_from(number).map_err(|_| self.error(format!("in ${section}, found {number} where a count or a tag stands")))
    }

    /// The next binary floating-point numbers.
    pub fn floats<const N: usize>(&mut self, section: &str) -> Result<[f64; N], MeshError> {
        self.numbers(section, [f64::from_be_bytes, f64::from_le_bytes])
    }

    /// Passes over so many binary numbers of `width` bytes.
    pub fn pass(&mut self, section: &str, count: i64, width: usize) -> Result<(), MeshError> {
        let length = usize::try_from(count).ok().and_then(|count| count.checked_mul(width));
        match length.filter(|&length| length <= self.bytes.len() - self.at) {
            Some(length) => {
                self.at += length;
                Ok(())
            }
            None => Err(self.cut_off(section)),
        }
    }

    /// The line that ends a section.
    pub fn end(&mut self, section: &str) -> Result<(), MeshError> {
        let line = self.line_in(section)?;
        if line.strip_prefix("$End") == Some(section) {
            return Ok(());
        }
        Err(self.error(format!("expected $End{section}, found `{}`", Quote(&line))))
    }

    /// Passes over the rest of a section, whatever it holds.
    pub fn skip(&mut self, section: &str) -> Result<(), MeshError> {
        let end = format!("$End{section}");
        loop {
            let line = self.line_in(section)?;
            // Behind binary numbers the end may stand on the same line.
            if line == end || !self.is_text() && line.ends_with(&end) {
                return Ok(());
            }
        }
    }
}

/// The words of a line.
fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A word as a number.
fn number<T: FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Reads a line of whole numbers, without signs and parted by single spaces, and gives its length; `None` for any other.
fn digits(bytes: &[u8], values: &mut Vec<i64>) -> Option<usize> {
    const MOST_DIGITS: usize = 18;
    values.clear();
    let mut at = 0;
    // Gmsh leaves a space at the end of the lines of elements.
    while *bytes.get(at)? != b'\n' {
        let (start, mut value) = (at, 0i64);
        while let Some(digit) = bytes.get(at).map(|byte| byte.wrapping_sub(b'0')).filter(|&digit| digit < 10) {
            value = value.wrapping_mul(10).wrapping_add(digit.into());
            at += 1;
        }
        if at == start || at - start > MOST_DIGITS {
            return None;
        }
        values.push(value);
        at += usize::from(*bytes.get(at)? == b' ');
    }
    Some(at + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_digits_are_read_and_others_left() {
        let read = |line: &str| {
            let mut values = vec![7; 3];
            digits(line.as_bytes(), &mut values).map(|length| (length, values))
        };
        assert_eq!(read("1 20 300 \n4"), Some((10, vec![1, 20, 300])));
        assert_eq!(read("0 999999999999999999\n"), Some((21, vec![0, 999_999_999_999_999_999])));
        assert_eq!(read("\n1"), Some((1, Vec::new())));
        for other in ["1 -2 3\n", "1  2 3\n", " 1 2 3\n", "1 2 3", "1 2 3.0\n", "1 2 9999999999999999999\n", ""] {
            assert_eq!(read(other), None, "{other:?}");
        }
    }
}

//! Mutations of texts: bytes, lines and words are changed, left out, doubled, and put in from elsewhere.

/// Words that readers have trouble with.
const WORDS: [&str; 48] = [
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e999",
    "nan",
    "inf",
    "-inf",
    "9999999999999999999",
    "1.7",
    "2147483648",
    "4294967295",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "0x10",
    "1_000",
    "\"\"",
    "''",
    "[]",
    "{}",
    "[[",
    "]]",
    "=",
    ".",
    ",",
    "#",
    "\"\"\"",
    "\u{0}",
    "\u{1b}",
    "\u{feff}",
    "ü",
    "\u{202e}",
    "\r\n",
    "\n\n",
    "(",
    ")",
    "^",
    "^-",
    "1/(x-x)",
    "sqrt(-1)",
    "$End",
    "true",
];

/// Longest text that is made (bytes).
const LONGEST: usize = 1 << 16;

/// Random numbers, the same in each run (Steele, Lea, Flood: splitmix).
pub struct Random(pub u64);

impl Random {
    /// A number below `count`, which is not 0.
    pub fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % count as u64) as usize
    }
}

/// One of the texts after one to six mutations.
pub fn mutated(corpus: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut text = corpus[random.below(corpus.len())].clone();
    let most = 1 + random.below(6);
    for _ in 0..=random.below(most) {
        mutate(&mut text, corpus, random);
        text.truncate(LONGEST);
    }
    text
}

fn mutate(text: &mut Vec<u8>, corpus: &[Vec<u8>], random: &mut Random) {
    let word = WORDS[random.below(WORDS.len())].as_bytes();
    let at = random.below(text.len() + 1);
    match random.below(9) {
        0 if at < text.len() => text[at] ^= 1 << random.below(8),
        1 if at < text.len() => text[at] = random.below(256) as u8,
        2 => drop(text.splice(at..at, word.iter().copied())),
        3 | 4 => drop(text.splice(token(text, at), word.iter().copied())),
        5 => drop(text.drain(line(text, at))),
        6 => {
            let doubled = text[line(text, at)].to_vec();
            drop(text.splice(at..at, doubled));
        }
        7 => {
            let other = &corpus[random.below(corpus.len())];
            let taken = other[line(other, random.below(other.len() + 1))].to_vec();
            drop(text.splice(line(text, at), taken));
        }
        _ => text.truncate(at.max(text.len() / 2)),
    }
}

/// The line that holds a place, with its end.
fn line(text: &[u8], at: usize) -> std::ops::Range<usize> {
    let start = text[..at].iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
    let end = text[at..].iter().position(|&byte| byte == b'\n').map_or(text.len(), |end| at + end + 1);
    start..end
}

/// The word that holds a place.
fn token(text: &[u8], at: usize) -> std::ops::Range<usize> {
    let ends = |&byte: &u8| !(byte.is_ascii_alphanumeric() || b"._-+".contains(&byte));
    let start = text[..at].iter().rposition(ends).map_or(0, |end| end + 1);
    let end = text[at..].iter().position(ends).map_or(text.len(), |end| at + end);
    start..end
}

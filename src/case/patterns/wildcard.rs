//! Patterns of names, as in a shell: `*` stands for any letters, `?` for one.

/// Whether a name is a pattern.
pub fn is_pattern(name: &str) -> bool {
    name.contains(['*', '?'])
}

/// Whether a name is a pattern of those that are known, and none of them: that stands for itself.
pub fn is_pattern_of(known: &[String], name: &str) -> bool {
    is_pattern(name) && !known.iter().any(|known| known == name)
}

/// Whether a pattern stands for a name: the letters of both side by side, and back to the last `*` where they differ.
pub fn matches(pattern: &str, name: &str) -> bool {
    let [pattern, name] = [pattern, name].map(|text| text.chars().collect::<Vec<char>>());
    let (mut at, mut letter) = (0, 0);
    let mut star: Option<[usize; 2]> = None;
    while letter < name.len() {
        match pattern.get(at) {
            Some('*') => {
                star = Some([at, letter]);
                at += 1;
            }
            Some(wanted) if *wanted == '?' || *wanted == name[letter] => {
                at += 1;
                letter += 1;
            }
            _ => {
                let Some([before, taken]) = star else { return false };
                star = Some([before, taken + 1]);
                (at, letter) = (before + 1, taken + 1);
            }
        }
    }
    pattern[at..].iter().all(|left| *left == '*')
}

/// Letters of a pattern that stand for themselves: of two patterns the one with more of them says more.
pub fn plain_letters(pattern: &str) -> usize {
    pattern.chars().filter(|letter| !['*', '?'].contains(letter)).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The same, by what a pattern is.
    fn slowly(pattern: &[char], name: &[char]) -> bool {
        match (pattern.split_first(), name.split_first()) {
            (None, None) => true,
            (Some(('*', rest)), None) => slowly(rest, name),
            (Some(('*', rest)), Some((_, others))) => slowly(rest, name) || slowly(pattern, others),
            (Some((wanted, rest)), Some((letter, others))) => (*wanted == '?' || wanted == letter) && slowly(rest, others),
            _ => false,
        }
    }

    #[test]
    fn rollers_are_told_from_plates() {
        for (pattern, name, is_so) in [
            ("roller*", "roller12", true),
            ("roller*", "roller", true),
            ("roller*", "plate", false),
            ("roller?", "roller12", false),
            ("*.rim", "disc.3.rim", true),
            ("r*r?", "roller1", true),
            ("räder*", "räder-ü", true),
            ("", "", true),
        ] {
            assert_eq!(matches(pattern, name), is_so, "{pattern} {name}");
        }
    }

    proptest! {
        #[test]
        fn any_pattern_matches_what_it_says(pattern in "[ab*?]{0,8}", name in "[ab]{0,10}") {
            let [letters, of_name] = [&pattern, &name].map(|text| text.chars().collect::<Vec<char>>());
            prop_assert_eq!(matches(&pattern, &name), slowly(&letters, &of_name));
        }
    }
}

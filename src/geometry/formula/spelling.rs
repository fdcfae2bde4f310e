//! Which characters and words formulas are made of: what can be told of one without reading it.

use super::Formula;
use super::parser::names;

/// Characters that stand for themselves.
const SIGNS: &str = "-+*/^()";

impl Formula {
    /// The regular expression of the texts for which [`Formula::is_spelt`] holds, but for white space that hardly any keyboard has, which is
    /// `\s` in other words in each dialect.
    pub fn pattern(variables: &[&str]) -> String {
        let names: Vec<&str> = names(variables).collect();
        format!("^(?:\\s|[{SIGNS}]|[0-9.](?:[eE][-+]?)?|{})*$", names.join("|"))
    }

    /// Whether a text is made of white space, signs, digits, these variables and known names alone, as every formula is.
    pub fn is_spelt(text: &str, variables: &[&str]) -> bool {
        let names = names(variables);
        let mut ends = vec![false; text.len() + 1];
        ends[0] = true;
        for (at, letter) in text.char_indices() {
            if !ends[at] {
                continue;
            }
            let rest = &text[at..];
            if letter.is_whitespace() || SIGNS.contains(letter) {
                ends[at + letter.len_utf8()] = true;
            }
            if letter.is_ascii_digit() || letter == '.' {
                ends[at + 1] = true;
                let exponent = rest[1..].starts_with(['e', 'E']);
                ends[at + 1 + usize::from(exponent)] = true;
                let signed = exponent && rest[2..].starts_with(['-', '+']);
                ends[at + 1 + usize::from(exponent) + usize::from(signed)] = true;
            }
            names.clone().filter(|name| rest.starts_with(name)).for_each(|name| ends[at + name.len()] = true);
        }
        ends[text.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::Formula;

    #[test]
    fn formulas_are_spelt_by_known_words() {
        for good in ["1 + x", "-2.5e-3*sqrt(x^2 + y^2)", "2E+5", ".5*pi", "exp(exp(x))", "", "x+"] {
            assert!(Formula::is_spelt(good, &["x", "y"]), "{good}");
        }
        for bad in ["z", "x + t", "sqr(x)", "1,5", "2ee", "e5", "x²", "clsoed"] {
            assert!(!Formula::is_spelt(bad, &["x", "y"]), "{bad}");
        }
    }
}

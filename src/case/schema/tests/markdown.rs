//! The tables of keys for people.

use crate::case::keys::{Absent, KeyForm, NumberRange, TableForm, ValueForm};

/// One table of Markdown with all keys of a file.
pub fn markdown(file: &'static TableForm) -> String {
    let mut rows = vec!["| key | value | meaning | default |".to_owned(), "|---|---|---|---|".to_owned()];
    of_table(file, &[], &mut Vec::new(), &mut rows);
    rows.join("\n")
}

/// Rows of a table, then those of the tables in it.
fn of_table(table: &'static TableForm, path: &[&str], inline: &mut Vec<&'static str>, rows: &mut Vec<String>) {
    of_keys(table, "", inline, rows);
    for key in table.all() {
        let Some(inner) = key.value.table().filter(|inner| !inner.inline) else { continue };
        let mut path = [path, &[key.name]].concat();
        let title = match key.value {
            ValueForm::Named(named) => {
                path.push(named.placeholder);
                format!("[{}]", path.join("."))
            }
            ValueForm::Tables(_) => format!("[[{}]]", path.join(".")),
            _ => format!("[{}]", path.join(".")),
        };
        rows.push(format!("| **`{title}`** | | {} | |", inner.sentence));
        of_table(inner, &path, inline, rows);
    }
}

/// Rows of the keys of a table, and below each that stands for a table in braces, once, those of that one.
fn of_keys(table: &'static TableForm, above: &str, inline: &mut Vec<&'static str>, rows: &mut Vec<String>) {
    let all: Vec<&KeyForm> = table.all().filter(|key| !key.sentence.is_empty()).collect();
    for together in all.chunk_by(|a, b| a.sentence == b.sentence && a.absent == b.absent) {
        let names: Vec<String> = together.iter().map(|key| format!("`{above}{}`", key.name)).collect();
        rows.push(row(&names.join(", "), together[0]));
        if let ValueForm::Table(inner) = together[0].value
            && inner.inline
            && !inline.contains(&inner.name)
        {
            inline.push(inner.name);
            of_keys(inner, &format!("{}.", together[0].name), inline, rows);
        }
    }
}

fn row(names: &str, key: &KeyForm) -> String {
    let default = match key.absent {
        Absent::Nothing => String::new(),
        Absent::Refused => "required".into(),
        Absent::Default(toml) => format!("`{toml}`"),
        Absent::Words(words) => words.into(),
    };
    let unit = if key.unit.is_empty() { String::new() } else { format!("; {}", key.unit) };
    format!("| {names} | {}{unit} | {} | {default} |", key.value.words(), key.sentence)
}

impl ValueForm {
    /// What may stand there, in words.
    fn words(&self) -> String {
        match self {
            Self::Text | Self::Name => "string".into(),
            Self::Short(most) => format!("string of at most {most} letters"),
            Self::Names => "string, or a list of them, each once".into(),
            Self::Boolean => "`true` or `false`".into(),
            Self::Yes => "`true`".into(),
            Self::Number(range) => range.words("number"),
            Self::Whole([least, i64::MAX]) => format!("whole number of at least {least}"),
            Self::Whole([least, most]) if least + 1 == *most => format!("{least} or {most}"),
            Self::Whole([least, most]) => format!("whole number from {least} to {most}"),
            Self::Word(words) => words.iter().map(|word| format!("`\"{word}\"`")).collect::<Vec<_>>().join(" or "),
            Self::Formula(variables, range) => format!("{} or formula of {}", range.words("number"), variables.join(", ")),
            Self::List(list) => list.wanted.into(),
            Self::Either(forms, _) => forms.iter().map(Self::words).collect::<Vec<_>>().join(", or "),
            Self::Table(table) => {
                format!("table of {}", table.all().map(|key| format!("`{}`", key.name)).collect::<Vec<_>>().join(", "))
            }
            Self::Named(_) => "tables".into(),
            Self::Tables(_) => "list of tables".into(),
            Self::CaseKeys => "keys of the case with values".into(),
            Self::CaseAxes => "keys of the case with lists of values".into(),
        }
    }
}

/// A number, without many zeros.
fn short(number: f64) -> String {
    let plain = number.to_string();
    if plain.len() > 8 { format!("{number:e}") } else { plain }
}

impl NumberRange {
    fn words(&self, kind: &str) -> String {
        let bounds = match [self.least, self.above, self.most].map(|bound| bound.map(short)) {
            [Some(least), _, Some(most)] => format!(" from {least} to {most}"),
            [_, Some(above), Some(most)] => format!(" > {above}, at most {most}"),
            [_, Some(above), None] => format!(" > {above}"),
            [Some(least), ..] => format!(" of at least {least}"),
            [_, _, Some(most)] => format!(" of at most {most}"),
            _ => String::new(),
        };
        format!("{kind}{bounds}{}", if self.zero { "" } else { " other than 0" })
    }
}

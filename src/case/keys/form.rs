//! What the tables of keys are made of: keys, forms of values, ranges, and which keys stand together.

use toml::Value;

/// A key of a file.
#[derive(Clone, Copy)]
pub struct KeyForm {
    /// Its name.
    pub name: &'static str,
    /// What stands there.
    pub value: ValueForm,
    /// What holds where it is left out.
    pub absent: Absent,
    /// How it is written, in words for a file that lacks it; empty if it is never wanted.
    pub example: &'static str,
    /// Unit of its numbers, in words; empty if they have none.
    pub unit: &'static str,
    /// What it means, in Markdown.
    pub sentence: &'static str,
    /// Words for a value that has not this form, in the place of those of the form; empty if these will do.
    pub refusal: &'static str,
}

/// What holds where a key is left out.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Absent {
    /// Nothing.
    Nothing,
    /// The file is refused.
    Refused,
    /// This value, as TOML.
    Default(&'static str),
    /// What these words say.
    Words(&'static str),
}

/// The form of a value: what can be said without any other key, and without a mesh.
#[derive(Clone, Copy)]
pub enum ValueForm {
    /// A string.
    Text,
    /// A string with something in it.
    Name,
    /// A string with something in it, of so many letters at most.
    Short(usize),
    /// A name, or a list of names, each once.
    Names,
    /// `true` or `false`.
    Boolean,
    /// `true` alone.
    Yes,
    /// A finite number.
    Number(NumberRange),
    /// A whole number, from the first to the second.
    Whole([i64; 2]),
    /// One of these words.
    Word(&'static [&'static str]),
    /// A number, or a formula of these variables.
    Formula(&'static [&'static str], NumberRange),
    /// A list.
    List(ListForm),
    /// One of these forms, no two of which take values of one type, but for words and formulas; and what is wanted, in words.
    Either(&'static [ValueForm], &'static str),
    /// A table.
    Table(&'static TableForm),
    /// A table of tables, each with a name that the user chooses.
    Named(NamedForm),
    /// A list of tables.
    Tables(&'static TableForm),
    /// Keys of a case with a value each.
    CaseKeys,
    /// Keys of a case with a list of values each.
    CaseAxes,
}

/// Which finite numbers are allowed.
#[derive(Clone, Copy, PartialEq)]
pub struct NumberRange {
    /// Smaller ones are not.
    pub least: Option<f64>,
    /// Nor is this one, nor smaller ones.
    pub above: Option<f64>,
    /// Larger ones are not.
    pub most: Option<f64>,
    /// Whether 0 is.
    pub zero: bool,
    /// Words for others; if empty, made of the range.
    pub words: &'static str,
}

/// A list.
#[derive(Clone, Copy)]
pub struct ListForm {
    /// Form of each entry.
    pub of: &'static ValueForm,
    /// Fewest and most entries.
    pub count: [usize; 2],
    /// Whether each entry stands there once.
    pub unique: bool,
    /// What is wanted, in words.
    pub wanted: &'static str,
    /// What its entries are called.
    pub noun: &'static str,
    /// Words for too few of them; if empty, made of `wanted`.
    pub few: &'static str,
}

/// Tables with names that the user chooses.
#[derive(Clone, Copy)]
pub struct NamedForm {
    /// What each of them holds.
    pub table: &'static TableForm,
    /// What the documentation calls their names.
    pub placeholder: &'static str,
    /// How many there are at least.
    pub least: usize,
    /// Whether names are parts of file names, so that not all letters are allowed.
    pub in_files: bool,
}

/// A table with keys that the program knows.
pub struct TableForm {
    /// Its name among the definitions of the schema.
    pub name: &'static str,
    /// What it is, in Markdown; empty where the keys say it.
    pub sentence: &'static str,
    /// Its keys, in groups that other tables may have, too.
    pub keys: &'static [&'static [KeyForm]],
    /// Which keys stand together.
    pub rules: &'static [TableRule],
    /// Whether it is mostly written in braces.
    pub inline: bool,
}

/// Which keys stand together in a table.
pub enum TableRule {
    /// All keys of one of these groups are there, or more.
    OneOf(&'static [&'static [&'static str]]),
    /// Where the first is there, one of the others is, too.
    Beside(&'static str, &'static [&'static str]),
    /// Where the first is there, none of the others is.
    Alone(&'static str, &'static [&'static str]),
}

/// Longest name that is a part of file names (bytes): files take 255, and names of results have more in them.
pub const LONGEST_NAME: usize = 100;
/// Words for a name that cannot be a part of them.
pub const NO_FILE_NAME: &str =
    "its name is part of a file name; use letters, digits, `-`, `_` and `.`, but neither `.` nor `..` alone";

impl KeyForm {
    /// Its default, if that is a value.
    pub fn default(&self) -> Option<Value> {
        match self.absent {
            Absent::Default(text) => Some(text.parse().expect("defaults of the table are TOML")),
            _ => None,
        }
    }
}

impl TableForm {
    /// All keys.
    pub fn all(&self) -> impl Iterator<Item = &'static KeyForm> {
        self.keys.iter().flat_map(|group| group.iter())
    }

    /// The key of a name.
    pub fn key(&self, name: &str) -> Option<&'static KeyForm> {
        self.all().find(|key| key.name == name)
    }
}

impl ValueForm {
    /// The table that may stand there, or each of those that may.
    pub fn table(&self) -> Option<&'static TableForm> {
        match self {
            Self::Table(table) | Self::Tables(table) => Some(table),
            Self::Named(named) => Some(named.table),
            Self::Either(forms, _) => forms.iter().find_map(Self::table),
            _ => None,
        }
    }
}

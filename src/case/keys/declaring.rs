//! How a key is declared: its name, the form of its value, what holds without it, and in the comment on it what it means.
//!
//! ```text
//! declare! {
//!     /// A rigid tool.
//!     static RIGID = table("rigid");
//!     /// Its turn about its reference point.
//!     const ANGLE: f64 = key("angle", NUMBER).or_else("0").unit("radians");
//! }
//! ```
//!
//! The table has all keys below it, in this order; `..SURFACE` takes in those of a group, which several tables have. The comments are
//! the meanings in docs/case.md and the JSON Schema. The form knows the type of its values, so that a reader that asks for `ANGLE`
//! gets a number that was checked.

use std::marker::PhantomData;

use toml::Table;

use super::form::{Absent, KeyForm, ListForm, NamedForm, NumberRange, TableForm, TableRule, ValueForm};
use crate::geometry::Formula;

/// A key whose value is read as a `T`.
pub struct Key<T> {
    /// What the table of keys says of it.
    pub form: KeyForm,
    of: PhantomData<fn() -> T>,
}

/// The form of values that are read as a `T`.
pub struct FormOf<T> {
    /// What the table of keys says of them.
    pub value: ValueForm,
    of: PhantomData<fn() -> T>,
}

/// Words, each of which stands for a value.
pub trait Choice: Copy + PartialEq + 'static {
    /// The words.
    const WORDS: &'static [&'static str];
    /// What each of them stands for.
    const MEANINGS: &'static [Self];

    /// The word for it.
    fn word(self) -> &'static str {
        let at = Self::MEANINGS.iter().position(|meaning| *meaning == self);
        Self::WORDS[at.expect("each meaning has a word")]
    }
}

/// Variables of formulas in the plane.
pub const PLANE: [&str; 2] = ["x", "y"];
/// Any number.
pub const ANY: NumberRange = NumberRange { least: None, above: None, most: None, zero: true, words: "" };
/// Numbers above zero.
pub const POSITIVE: NumberRange = NumberRange { above: Some(0.0), ..ANY };

/// A string.
pub const TEXT: FormOf<String> = of(ValueForm::Text);
/// A string with something in it.
pub const NAME: FormOf<String> = of(ValueForm::Name);
/// A name, or a list of names, each once.
pub const NAMES: FormOf<Vec<String>> = of(ValueForm::Names);
/// `true` or `false`.
pub const BOOLEAN: FormOf<bool> = of(ValueForm::Boolean);
/// `true` alone.
pub const YES: FormOf<bool> = of(ValueForm::Yes);
/// A finite number.
pub const NUMBER: FormOf<f64> = number(ANY);
/// A finite number above zero.
pub const ABOVE_ZERO: FormOf<f64> = number(POSITIVE);
/// A whole number of at least 1.
pub const COUNT: FormOf<usize> = whole(1, i64::MAX);
/// Two numbers.
pub const POINT: FormOf<[f64; 2]> = array(&NUMBER, "two numbers [x, y]");
/// Points, at least one.
pub const POINTS: FormOf<Vec<[f64; 2]>> = list(&POINT, "a list of points [[x, y], ...]");
/// A number or a formula of the place.
pub const IN_PLANE: FormOf<Formula> = formula(&PLANE, ANY);
/// A vector of such formulas.
pub const VECTOR: FormOf<[Formula; 2]> = array(&IN_PLANE, "a list of 2 numbers or formulas of x, y");
/// The word `"auto"`, beside others.
pub const AUTO: ValueForm = ValueForm::Word(&["auto"]);

/// Values of a form that are read as a `T`.
pub const fn of<T>(value: ValueForm) -> FormOf<T> {
    FormOf { value, of: PhantomData }
}

/// A number from the first to the second.
pub const fn within(least: f64, most: f64) -> NumberRange {
    NumberRange { least: Some(least), most: Some(most), ..ANY }
}

/// Numbers of a range.
pub const fn number(range: NumberRange) -> FormOf<f64> {
    of(ValueForm::Number(range))
}

/// Whole numbers from the first to the second.
pub const fn whole<T>(least: i64, most: i64) -> FormOf<T> {
    of(ValueForm::Whole([least, most]))
}

/// The words of a choice.
pub const fn word<T: Choice>() -> FormOf<T> {
    of(ValueForm::Word(T::WORDS))
}

/// A formula of these variables, or a number of a range.
pub const fn formula(variables: &'static [&'static str], range: NumberRange) -> FormOf<Formula> {
    of(ValueForm::Formula(variables, range))
}

/// A list of a known length.
pub const fn array<T, const N: usize>(entry: &'static FormOf<T>, wanted: &'static str) -> FormOf<[T; N]> {
    of(ValueForm::List(ListForm { count: [N, N], ..entries(entry, wanted) }))
}

/// A list of at least one entry.
pub const fn list<T>(entry: &'static FormOf<T>, wanted: &'static str) -> FormOf<Vec<T>> {
    of(ValueForm::List(entries(entry, wanted)))
}

/// A list of at least one entry, each once.
pub const fn set<T>(entry: &'static FormOf<T>, wanted: &'static str) -> FormOf<Vec<T>> {
    of(ValueForm::List(ListForm { unique: true, ..entries(entry, wanted) }))
}

/// What a list holds, at least one of it.
pub const fn entries<T>(entry: &'static FormOf<T>, wanted: &'static str) -> ListForm {
    ListForm { of: &entry.value, count: [1, usize::MAX], unique: false, wanted, noun: "entries", few: "" }
}

/// One of several forms.
pub const fn either<T>(forms: &'static [ValueForm], wanted: &'static str) -> FormOf<T> {
    of(ValueForm::Either(forms, wanted))
}

/// A table.
pub const fn inner(table: &'static TableForm) -> FormOf<Table> {
    of(ValueForm::Table(table))
}

/// Tables with any names, of a kind.
pub const fn named(table: &'static TableForm) -> FormOf<Table> {
    of(ValueForm::Named(of_kind(table)))
}

/// Tables with names that are parts of file names.
pub const fn named_in_files(table: &'static TableForm) -> FormOf<Table> {
    of(ValueForm::Named(NamedForm { in_files: true, ..of_kind(table) }))
}

/// At least one table; the documentation calls its name like this.
pub const fn some_named(table: &'static TableForm, placeholder: &'static str) -> FormOf<Table> {
    of(ValueForm::Named(NamedForm { least: 1, placeholder, ..of_kind(table) }))
}

const fn of_kind(table: &'static TableForm) -> NamedForm {
    NamedForm { table, placeholder: "NAME", least: 0, in_files: false }
}

/// A key that may be left out.
pub const fn key<T>(name: &'static str, value: FormOf<T>) -> Key<T> {
    let absent = Absent::Nothing;
    Key::with(KeyForm { name, value: value.value, absent, example: "", unit: "", sentence: "", refusal: "" })
}

/// A table, by its name among the definitions of the schema.
pub const fn table(name: &'static str) -> TableForm {
    TableForm { name, sentence: "", keys: &[], rules: &[], inline: false }
}

/// Declares the keys of a table, or of a group that several tables have.
macro_rules! declare {
    ($(#[doc = $about:literal])* static $TABLE:ident = $table:expr;
     $(..$first:ident;)*
     $($(#[doc = $line:literal])* const $KEY:ident: $of:ty = $key:expr; $(..$group:ident;)*)*) => {
        $(pub const $KEY: $crate::case::keys::Key<$of> = $key.means(concat!($($line),*));)*
        /// The keys of a table of a file.
        pub static $TABLE: $crate::case::keys::TableForm =
            $table.means(concat!($($about),*)).with(&[$($first,)* $(&[$KEY.form], $($group,)*)*]);
    };
    (group $GROUP:ident; $($(#[doc = $line:literal])* const $KEY:ident: $of:ty = $key:expr;)*) => {
        $(pub const $KEY: $crate::case::keys::Key<$of> = $key.means(concat!($($line),*));)*
        pub const $GROUP: &[$crate::case::keys::KeyForm] = &[$($KEY.form),*];
    };
}
pub(crate) use declare;

/// Tells the words of a choice, and what each of them stands for.
macro_rules! words {
    ($Of:ty: $($word:literal => $Meaning:ident),*) => {
        impl $crate::case::keys::Choice for $Of {
            const WORDS: &'static [&'static str] = &[$($word),*];
            const MEANINGS: &'static [Self] = &[$(Self::$Meaning),*];
        }
    };
}
pub(crate) use words;

impl NumberRange {
    /// Other numbers are refused with these words.
    pub const fn or_words(self, words: &'static str) -> Self {
        Self { words, ..self }
    }
}

impl<T> Key<T> {
    const fn with(form: KeyForm) -> Self {
        Self { form, of: PhantomData }
    }

    /// This is what it means.
    pub const fn means(self, sentence: &'static str) -> Self {
        Self::with(KeyForm { sentence: sentence.trim_ascii(), ..self.form })
    }

    /// It has this default, as TOML.
    pub const fn or(self, default: &'static str) -> Self {
        Self::with(KeyForm { absent: Absent::Default(default), ..self.form })
    }

    /// What holds without it is told by these words.
    pub const fn or_else(self, words: &'static str) -> Self {
        Self::with(KeyForm { absent: Absent::Words(words), ..self.form })
    }

    /// It must be there, written like this.
    pub const fn required(self, example: &'static str) -> Self {
        Self::with(KeyForm { absent: Absent::Refused, example, ..self.form })
    }

    /// Where other keys want it, it is written like this.
    pub const fn like(self, example: &'static str) -> Self {
        Self::with(KeyForm { example, ..self.form })
    }

    /// Its numbers have this unit.
    pub const fn unit(self, unit: &'static str) -> Self {
        Self::with(KeyForm { unit, ..self.form })
    }

    /// Other values are refused with these words.
    pub const fn refused(self, refusal: &'static str) -> Self {
        Self::with(KeyForm { refusal, ..self.form })
    }
}

impl TableForm {
    /// This is what it is.
    pub const fn means(self, sentence: &'static str) -> Self {
        Self { sentence: sentence.trim_ascii(), ..self }
    }

    /// It has these keys.
    pub const fn with(self, keys: &'static [&'static [KeyForm]]) -> Self {
        Self { keys, ..self }
    }

    /// These keys stand together.
    pub const fn rules(self, rules: &'static [TableRule]) -> Self {
        Self { rules, ..self }
    }

    /// It is mostly written in braces.
    pub const fn inline(self) -> Self {
        Self { inline: true, ..self }
    }
}

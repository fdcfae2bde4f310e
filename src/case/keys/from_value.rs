//! Values that have the form of their key, as the types that readers work with.

use toml::{Table, Value};

use super::declaring::Choice;
use super::form::ValueForm;
use super::values::{self, must_be, number, one_or_each};
use crate::geometry::Formula;

/// A type that values of a file are read as.
pub trait FromValue: Sized {
    /// Reads a value that has a form.
    ///
    /// # Errors
    /// Words for what the form does not tell, as of a formula without a finite value.
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String>;
}

impl<T: Choice> FromValue for T {
    fn from_value(value: &Value, _: &ValueForm) -> Result<Self, String> {
        let place = T::WORDS.iter().position(|word| value.as_str() == Some(word));
        let meaning = place.and_then(|place| T::MEANINGS.get(place));
        meaning.copied().ok_or_else(|| must_be("a word that has a meaning here", value))
    }
}

/// The word `"auto"` is none.
impl<T: FromValue> FromValue for Option<T> {
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String> {
        if value.is_str() { Ok(None) } else { T::from_value(value, form).map(Some) }
    }
}

/// A value that is no list is the only entry of one.
impl<T: FromValue> FromValue for Vec<T> {
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String> {
        let of = if let ValueForm::List(list) = form { list.of } else { form };
        one_or_each(value, |value| T::from_value(value, of))
    }
}

/// A value that is no list stands for all entries of one.
impl<T: FromValue + Clone, const N: usize> FromValue for [T; N] {
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String> {
        let mut all = Vec::<T>::from_value(value, form)?;
        if !value.is_array() {
            all.resize(N, all[0].clone());
        }
        all.try_into().map_err(|_| must_be(&format!("a list of {N}"), value))
    }
}

/// A formula without variables has a finite value, one that a number might have.
impl FromValue for Formula {
    fn from_value(value: &Value, form: &ValueForm) -> Result<Self, String> {
        let ValueForm::Formula(variables, range) = form else { return Err("takes no formula".into()) };
        let formula = match value {
            Value::String(text) => Self::parse(text, variables).map_err(|error| error.to_string())?,
            value => Self::constant(number(value)?),
        };
        match formula.as_constant() {
            Some(constant) if !constant.is_finite() => Err("is not finite; correct the formula".into()),
            Some(constant) => range.refusal(constant).map_or(Ok(formula), Err),
            None => Ok(formula),
        }
    }
}

/// Types that are read in one way, whatever the form.
macro_rules! read_by {
    ($($of:ty: $read:expr;)*) => {$(
        impl FromValue for $of {
            fn from_value(value: &Value, _: &ValueForm) -> Result<Self, String> {
                $read(value)
            }
        }
    )*};
}

read_by! {
    bool: values::boolean;
    f64: number;
    usize: values::whole;
    String: values::text;
    Table: values::table;
    Value: |value: &Value| Ok(value.clone());
}

//! Names of units: what axes, colour bars, tables and words say beside numbers. They change no number.

use serde::{Deserialize, Serialize};

/// Units of stress that have a name of their own, by those of length and force. For others the quotient stands.
const STRESSES: [([&str; 2], &str); 2] = [(["mm", "N"], "MPa"), (["m", "N"], "Pa")];

/// The units that a case says it is in; none where it says nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Units {
    /// Of lengths and displacements.
    pub length: Option<String>,
    /// Of forces.
    pub force: Option<String>,
    /// Of stresses and pressures.
    pub stress: Option<String>,
    /// Of the forces of contacts, supports and tools: per thickness, unless they are those of whole bodies.
    pub resultant: Option<String>,
}

/// No units.
static NONE: Units = Units { length: None, force: None, stress: None, resultant: None };

impl Default for &Units {
    fn default() -> Self {
        &NONE
    }
}

/// What a number is, and the name of its unit, if it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit<'a> {
    quantity: &'static str,
    name: Option<&'a str>,
}

impl Units {
    /// Units of a case by those that it names. Resultants are whole forces, or `is_whole` is false and they are per thickness.
    pub fn new(length: Option<&str>, force: Option<&str>, is_whole: bool) -> Self {
        let by = |power: &str| Some(format!("{}/{}{power}", force?, length?));
        let named = STRESSES.iter().find(|(of, _)| [length, force] == of.map(Some)).map(|(_, name)| (*name).to_owned());
        Self {
            length: length.map(String::from),
            force: force.map(String::from),
            stress: named.or_else(|| by("²")),
            resultant: if is_whole { force.map(String::from) } else { by("") },
        }
    }

    /// Whether the case names none.
    pub fn is_none(&self) -> bool {
        *self == NONE
    }

    /// Of lengths and displacements.
    pub fn length(&self) -> Unit<'_> {
        Unit { quantity: "length", name: self.length.as_deref() }
    }

    /// Of stresses and pressures.
    pub fn stress(&self) -> Unit<'_> {
        Unit { quantity: "stress", name: self.stress.as_deref() }
    }

    /// Of the forces of contacts, supports and tools.
    pub fn resultant(&self) -> Unit<'_> {
        Unit { quantity: "force", name: self.resultant.as_deref() }
    }
}

/// Keys of cases and of `summary.json` whose values are lengths, stresses, and forces of contacts or supports.
const LENGTHS: [&str; 9] = ["approach", "depth", "displacement_max", "interference", "length", "radius", "ux", "uy", "width"];
const PRESSURES: [&str; 3] = ["pressure", "pressure_max", "young"];
const RESULTANTS: [&str; 1] = ["force"];

impl Units {
    /// The head of a column that is named by a place in a case or in `summary.json`: `contact.seam.force [N/mm]`. Accuracies and
    /// estimates are shares, whatever they are of.
    pub fn of_place(&self, place: &str) -> String {
        let key = place.rsplit('.').next().unwrap_or_default();
        let is_share = ["accuracy", "estimate", "errors", "balance"].iter().any(|table| place.starts_with(table))
            || key == "force" && place.contains(".zones.");
        match key {
            _ if is_share => place.to_owned(),
            _ if LENGTHS.contains(&key) => self.length().of(place),
            _ if PRESSURES.contains(&key) => self.stress().of(place),
            _ if RESULTANTS.contains(&key) => self.resultant().of(place),
            _ => place.to_owned(),
        }
    }
}

impl Unit<'_> {
    /// Its name: `mm`, or `unit of length`.
    pub fn words(&self) -> String {
        self.name.map_or_else(|| format!("unit of {}", self.quantity), String::from)
    }

    /// A power of ten of it: `10⁻⁴ mm`, or `10⁻⁴ units of length`.
    pub fn times(&self, power: &str) -> String {
        self.name.map_or_else(|| format!("{power} units of {}", self.quantity), |name| format!("{power} {name}"))
    }

    /// What stands after a number: ` mm`, or nothing.
    pub fn after(&self) -> String {
        self.name.map_or(String::new(), |name| format!(" {name}"))
    }

    /// The head of a column: `width [mm]`, or `width`.
    pub fn of(&self, what: &str) -> String {
        self.name.map_or_else(|| what.to_owned(), |name| format!("{what} [{name}]"))
    }

    /// The name of an axis: `width, mm`, or `width, unit of length`; of a force without a unit these `other` words.
    pub fn axis(&self, what: &str, other: Option<&str>) -> String {
        match (self.name, other) {
            (None, Some(other)) => format!("{what}, {other}"),
            _ => format!("{what}, {}", self.words()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_named_by_what_they_hold() {
        let units = Units::new(Some("mm"), Some("N"), false);
        let heads = ["contact.a.force", "body.b.young", "displacement_max", "accuracy.pressure", "balance.force"];
        let told =
            ["contact.a.force [N/mm]", "body.b.young [MPa]", "displacement_max [mm]", "accuracy.pressure", "balance.force"];
        assert_eq!(heads.map(|place| units.of_place(place)), told);
        assert_eq!(heads.map(|place| Units::default().of_place(place)), heads);
    }

    #[test]
    fn stress_and_resultant_follow_from_length_and_force() {
        let of = |length, force, is_whole| {
            let units = Units::new(length, force, is_whole);
            [units.stress, units.resultant].map(Option::unwrap_or_default)
        };
        assert_eq!(of(Some("mm"), Some("N"), false), ["MPa", "N/mm"]);
        assert_eq!(of(Some("m"), Some("N"), true), ["Pa", "N"]);
        assert_eq!(of(Some("in"), Some("lbf"), false), ["lbf/in²", "lbf/in"]);
        assert_eq!(of(Some("mm"), None, true), ["", ""], "nothing is guessed");
        assert_eq!(of(None, Some("kN"), true), ["", "kN"]);
        assert_eq!(Units::new(None, None, false), *<&Units>::default());
    }

    #[test]
    fn without_a_name_the_quantity_is_told() {
        let (named, none) = (Units::new(Some("mm"), Some("N"), false), Units::default());
        assert_eq!([named.length().words(), none.length().words()], ["mm", "unit of length"]);
        assert_eq!([named.stress().times("10⁵"), none.stress().times("10⁵")], ["10⁵ MPa", "10⁵ units of stress"]);
        assert_eq!([named.resultant().after(), none.resultant().after()], [" N/mm", ""]);
        assert_eq!([named.length().of("width"), none.length().of("width")], ["width [mm]", "width"]);
        let force = |units: &Units| units.resultant().axis("force", Some("per thickness"));
        assert_eq!([force(&named), force(&none)], ["force, N/mm", "force, per thickness"]);
        assert_eq!(none.length().axis("width", None), "width, unit of length");
    }
}

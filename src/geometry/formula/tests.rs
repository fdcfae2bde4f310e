use super::Formula;
use crate::geometry::Point;
use proptest::prelude::*;

fn at_x(text: &str, x: f64) -> f64 {
    Formula::parse(text, &["x"]).unwrap().value(&[x])
}

#[test]
fn precedence_is_the_usual_one() {
    let table = [
        ("-x^2", -9.0),
        ("(-x)^2", 9.0),
        ("2^-1", 0.5),
        ("2^3^2", 512.0),
        ("2^-x^2", 1.0 / 512.0),
        ("-2^2", -4.0),
        ("1 - 2 - x", -4.0),
        ("12 / 2 / x", 2.0),
        ("2*-x", -6.0),
        ("--x", 3.0),
        ("+x", 3.0),
        ("1 + 2*x^2", 19.0),
        ("-x*2 + 1", -5.0),
        ("sqrt(x + 1)*cos(0)", 2.0),
        ("exp(0)*x/.5", 6.0),
        ("1.5e+1 + 1E-1*x", 15.3),
        ("cos(pi*x)", -1.0),
    ];
    for (text, expected) in table {
        let value = at_x(text, 3.0);
        assert!((value - expected).abs() < 1e-14 * expected.abs().max(1.0), "{text}: {value} is not {expected}");
    }
}

#[test]
fn errors_name_column_found_and_allowed() {
    let table = [
        ("", "column 1: found `the end`; allowed here: a number, x, y, pi, sqrt, sin, cos, exp, log, - or ("),
        ("tan(x)", "column 1: found `tan`; allowed here: a number, x, y, pi, sqrt"),
        ("x + t", "column 5: found `t`; allowed here"),
        ("2x", "column 2: found `x`; allowed here: + - * / ^ or the end"),
        ("x**2", "column 3: found `*`; allowed here: a number"),
        ("(x + 1", "column 7: found `the end`; allowed here: + - * / ^ or ), which closes the parenthesis of column 1"),
        ("x)", "column 2: found `)`; this parenthesis was never opened"),
        ("sin x", "column 5: found `x`; allowed here: (, as in sin(...)"),
        ("1.2.3", "column 1: found `1.2.3`; allowed here: a finite number"),
        ("1e", "column 1: found `1e`; allowed here: a finite number"),
        ("1e999", "column 1: found `1e999`; allowed here: a finite number"),
        ("x + é", "column 5: found `é`; allowed here"),
        ("{x}", "column 1: found `{`; allowed here"),
        ("e", "column 1: found `e`; allowed here"),
    ];
    for (text, expected) in table {
        let words = Formula::parse(text, &["x", "y"]).unwrap_err().to_string();
        assert!(words.starts_with(expected), "{text}: {words}");
    }
    for deep in ["(".repeat(1000), "-".repeat(1000), "x^".repeat(1000), "x+(".repeat(40)] {
        let words = Formula::parse(&deep, &["x"]).unwrap_err().to_string();
        assert!(words.contains("nested too deeply"), "{words}");
    }
}

#[test]
fn constants_are_known() {
    assert_eq!(Formula::parse("-pi/2 + 2*3", &["x"]).unwrap().as_constant(), Some(6.0 - std::f64::consts::PI / 2.0));
    assert_eq!(Formula::parse("0*x", &["x"]).unwrap().as_constant(), None);
    assert_eq!(Formula::constant(-0.25).as_constant(), Some(-0.25));
    assert_eq!(Formula::constant(-0.25), Formula::parse("-0.25", &[]).unwrap());
}

#[test]
fn slopes_are_exact_at_the_edge_of_a_domain() {
    let slope = |text: &str, by: usize, at: [f64; 2]| Formula::parse(text, &["x", "y"]).unwrap().derivative(by, &at);
    assert_eq!(slope("sqrt(x) + y", 1, [0.0, 1.0]), 1.0);
    assert_eq!(slope("x^2", 0, [-3.0, 0.0]), -6.0);
    assert_eq!(slope("x^1", 0, [0.0, 0.0]), 1.0);
    assert_eq!(slope("x^0", 0, [0.0, 0.0]), 0.0);
    assert_eq!(slope("x^3", 0, [0.0, 0.0]), 0.0);
    assert_eq!(slope("x^y", 1, [0.0, 2.0]), 0.0);
    assert_eq!(slope("x/y", 1, [3.0, 2.0]), -0.75);
}

/// A tree to compare with: printed with as few parentheses as the precedence allows, and evaluated on its own.
#[derive(Clone, Debug)]
enum Tree {
    Number(f64),
    X,
    Y,
    Call(&'static str, Box<Tree>),
    Negate(Box<Tree>),
    Binary(char, Box<Tree>, Box<Tree>),
}

impl Tree {
    fn value(&self, x: f64, y: f64) -> f64 {
        match self {
            Tree::Number(value) => *value,
            Tree::X => x,
            Tree::Y => y,
            Tree::Negate(a) => -a.value(x, y),
            Tree::Call("sqrt", a) => a.value(x, y).sqrt(),
            Tree::Call("sin", a) => a.value(x, y).sin(),
            Tree::Call("cos", a) => a.value(x, y).cos(),
            Tree::Call("log", a) => a.value(x, y).ln(),
            Tree::Call(_, a) => a.value(x, y).exp(),
            Tree::Binary(operator, a, b) => {
                let (a, b) = (a.value(x, y), b.value(x, y));
                match operator {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    '/' => a / b,
                    _ => a.powf(b),
                }
            }
        }
    }

    /// 1 sum, 2 product, 3 sign, 4 power, 5 atom.
    fn strength(&self) -> u8 {
        match self {
            Tree::Binary('+' | '-', ..) => 1,
            Tree::Binary('*' | '/', ..) => 2,
            Tree::Negate(_) => 3,
            Tree::Binary(..) => 4,
            _ => 5,
        }
    }

    fn text(&self, weakest: u8) -> String {
        let inner = match self {
            Tree::Number(value) => format!("{value:?}"),
            Tree::X => "x".into(),
            Tree::Y => "y".into(),
            Tree::Call(name, a) => format!("{name}({})", a.text(1)),
            Tree::Negate(a) => format!("-{}", a.text(3)),
            Tree::Binary('^', a, b) => format!("{}^{}", a.text(5), b.text(3)),
            Tree::Binary(operator, a, b) => {
                format!("{} {operator} {}", a.text(self.strength()), b.text(self.strength() + 1))
            }
        };
        if self.strength() < weakest { format!("({inner})") } else { inner }
    }
}

fn trees() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![(0.1..3.0).prop_map(Tree::Number), Just(Tree::X), Just(Tree::Y)];
    leaf.prop_recursive(4, 24, 2, |inner| {
        let operator = prop::sample::select(vec!['+', '-', '*', '/', '^']);
        let function = prop::sample::select(vec!["sqrt", "sin", "cos", "exp", "log"]);
        prop_oneof![
            3 => (operator, inner.clone(), inner.clone()).prop_map(|(o, a, b)| Tree::Binary(o, a.into(), b.into())),
            1 => (function, inner.clone()).prop_map(|(name, a)| Tree::Call(name, a.into())),
            1 => inner.prop_map(|a| Tree::Negate(a.into())),
        ]
    })
}

proptest! {
    #[test]
    fn text_is_read_as_the_tree_that_wrote_it(tree in trees(), x in 0.2..2.0, y in 0.2..2.0) {
        let text = tree.text(1);
        let formula = Formula::parse(&text, &["x", "y"]).unwrap();
        prop_assert_eq!(formula.text(), &text);
        let (value, expected) = (formula.value(&[x, y]), tree.value(x, y));
        let same = (value - expected).abs() <= 1e-12 * expected.abs() || value.is_nan() && expected.is_nan() || value == expected;
        prop_assert!(same, "{}: {} is not {}", text, value, expected);
    }

    #[test]
    fn many_points_have_the_values_of_each(tree in trees(), at in prop::array::uniform3((-1.0..2.0, -1.0..2.0))) {
        let formula = Formula::parse(&tree.text(1), &["x", "y"]).unwrap();
        let all = formula.values(&at.map(|(x, y)| Point::new(x, y)));
        for ((x, y), value) in at.into_iter().zip(all) {
            let alone = formula.value(&[x, y]);
            // Which sign a NaN has is the processor's and the compiler's, and no formula can tell.
            let undefined = alone.is_nan() && value.is_nan();
            prop_assert!(undefined || alone.to_bits() == value.to_bits(), "{}: {} is not {}", formula.text(), value, alone);
        }
    }

    #[test]
    fn derivative_is_the_limit_of_differences(tree in trees(), x in 0.5..1.5, y in 0.5..1.5, by in 0_usize..2) {
        let formula = Formula::parse(&tree.text(1), &["x", "y"]).unwrap();
        let difference = |h: f64| {
            let moved = |h: f64| if by == 0 { [x + h, y] } else { [x, y + h] };
            (formula.value(&moved(h)) - formula.value(&moved(-h))) / (2.0 * h)
        };
        let (coarse, fine) = (difference(2e-4), difference(1e-4));
        let exact = formula.derivative(by, &[x, y]);
        let size = formula.value(&[x, y]).abs() + exact.abs() + 1e-2;
        // Richardson: only where the differences themselves have settled.
        prop_assume!(size < 1e6 && (coarse - fine).abs() < 1e-5 * size);
        let limit = fine + (fine - coarse) / 3.0;
        prop_assert!((limit - exact).abs() < 1e-6 * size, "{}: {} is not {}", formula.text(), exact, limit);
    }

    #[test]
    fn a_constant_survives_its_text(value in prop::num::f64::NORMAL) {
        let formula = Formula::constant(value);
        prop_assert_eq!(Formula::parse(formula.text(), &[]).unwrap().as_constant(), Some(value));
    }
}

use super::changed_forces::changed_forces;
use super::*;

const X: Point = Point::new(1.0, 0.0);
const Y: Point = Point::new(0.0, 1.0);

fn two() -> [Extent; 2] {
    [Extent { middle: Point::new(1.0, 0.5), radius: 1.0 }, Extent { middle: Point::new(1.0, 1.5), radius: 1.0 }]
}

fn hold(piece: usize, x: f64, y: f64, direction: Point) -> Condition {
    one_point(&two(), piece, None, x, y, direction)
}

fn one_point(pieces: &[Extent], piece: usize, against: Option<usize>, x: f64, y: f64, direction: Point) -> Condition {
    Condition::new(pieces, piece, against, &[(Point::new(x, y), direction)], 0.0).expect("it resists something")
}

fn held(piece: usize) -> Vec<Condition> {
    vec![hold(piece, 0.0, 0.0, X), hold(piece, 0.0, 0.0, Y), hold(piece, 2.0, 0.0, Y)]
}

/// Closed contact of two flat boundaries at these places.
fn touching(pieces: &[Extent], places: &[f64]) -> Touch {
    let at = |piece: usize, sign: f64| {
        let one = |&x: &f64| one_point(pieces, piece, Some(1 - piece), x, 1.0, sign * Y);
        places.iter().map(one).collect()
    };
    [at(0, 1.0), at(1, -1.0)]
}

/// The disc of radius 1 on top of a flat body that is held, touching over an angle; its normals are off by `doubt`.
fn disc(angle: f64, doubt: f64) -> ([Extent; 2], Vec<Condition>, Touch) {
    let pieces = [two()[0], Extent { middle: Point::new(1.0, 2.0), radius: 1.5 }];
    let places: Vec<f64> = (-3..=3).map(|k| f64::from(k) / 3.0 * angle).collect();
    let round = |a: &f64| {
        let normal = Point::new((a + doubt).sin(), -(a + doubt).cos());
        let x = Point::new(1.0 + a.sin(), 2.0 - a.cos());
        Condition { doubt, ..one_point(&pieces, 1, Some(0), x.x, x.y, normal) }
    };
    let [flat, _] = touching(&pieces, &places.iter().map(|a| 1.0 + a.sin()).collect::<Vec<_>>());
    (pieces, held(0), [flat, places.iter().map(round).collect()])
}

#[test]
fn two_held_bodies_are_held() {
    let mut supports = held(0);
    supports.extend(held(1));
    assert_eq!(find_mechanism(&two(), &supports, &[]), None);
}

#[test]
fn contact_holds_a_floating_body_against_the_normal_only() {
    let mut supports = held(0);
    let contact = [touching(&two(), &[0.2, 1.7])];
    let found = find_mechanism(&two(), &supports, &contact).expect("it slides");
    assert_eq!((found.piece, found.motion.as_str()), (1, "move by (1, 0)"));
    supports.push(hold(1, 0.0, 2.0, X));
    assert_eq!(find_mechanism(&two(), &supports, &contact), None);
}

#[test]
fn a_short_seat_holds_a_long_body() {
    let mut supports = held(0);
    supports.push(hold(1, 0.0, 2.0, X));
    assert_eq!(find_mechanism(&two(), &supports, &[touching(&two(), &[0.9, 0.901])]), None);
    assert!(find_mechanism(&two(), &supports, &[touching(&two(), &[0.9, 0.900001])]).is_some(), "as good as a point");
}

#[test]
fn a_disc_rolls_however_wide_it_touches_until_it_is_held() {
    for (angle, doubt) in [(0.05, 0.0), (1.0, 0.0), (0.3, 1e-3)] {
        let (pieces, mut supports, contact) = disc(angle, doubt);
        let found = |supports: &[Condition]| find_mechanism(&pieces, supports, std::slice::from_ref(&contact));
        assert_eq!(found(&supports).expect("it slides").motion, "move by (1, 0)");
        supports.push(one_point(&pieces, 1, None, 1.0, 2.0, X));
        assert_eq!(found(&supports).expect("it rolls").motion, "turn about (1, 2)");
        supports.push(one_point(&pieces, 1, None, 1.0, 3.0, X));
        assert_eq!(found(&supports), None);
    }
}

#[test]
fn a_long_chain_is_held_and_its_loose_link_is_found() {
    let pieces: Vec<Extent> = (0..50).map(|k| Extent { middle: Point::new(1.0, f64::from(k) + 0.5), radius: 1.0 }).collect();
    let line = |k: usize| {
        let of = |piece: usize, against: usize, sign: f64| {
            let one = |x: f64| one_point(&pieces, piece, Some(against), x, k as f64 + 1.0, sign * Y);
            vec![one(0.2), one(1.7)]
        };
        [of(k, k + 1, 1.0), of(k + 1, k, -1.0)]
    };
    let lines: Vec<Touch> = (0..49).map(line).collect();
    let mut supports: Vec<Condition> = (0..50).map(|k| one_point(&pieces, k, None, 0.0, k as f64 + 0.5, X)).collect();
    supports.extend([0.0, 2.0].map(|x| one_point(&pieces, 0, None, x, 0.0, Y)));
    assert_eq!(find_mechanism(&pieces, &supports, &lines), None);
    supports.remove(25);
    let found = find_mechanism(&pieces, &supports, &lines).expect("it slides");
    assert_eq!((found.piece, found.motion.as_str()), (25, "move by (1, 0)"));
}

#[test]
fn a_body_on_one_pin_turns_about_it() {
    let mut supports = held(0);
    supports.extend([hold(1, 0.25, 1.0, X), hold(1, 0.25, 1.0, Y)]);
    let found = find_mechanism(&two(), &supports, &[]).expect("it turns");
    assert_eq!((found.piece, found.motion.as_str()), (1, "turn about (0.25, 1)"));
}

#[test]
fn words_have_the_digits_of_the_body_in_any_unit() {
    let table = [
        (0.25, 1.0, "0.25"),
        (-0.60181502, 1.0, "-0.6018"),
        (3e-5, 1.0, "0"),
        (-1.0, 1.0, "-1"),
        (20.0, 30.0, "20"),
        (1234567.891, 5e3, "1234567.9"),
        (6e17, 3e9, "600000000000000000"),
        (-2.5e-9, 1e-9, "-2.5000e-9"),
    ];
    for (v, large, words) in table {
        assert_eq!(tidy(v, large), words);
    }
}

/// A hexagonal packing of discs of radius 1/2 in rows, whose turns are held; the lowest ones lie on the ground, the first of each
/// row at a wall. Contacts are those of neighbours, by normals of a disc that is a little out of round.
fn packing(side: usize) -> (Vec<Extent>, Vec<Condition>, Vec<Touch>) {
    let middle = |i: usize, j: usize| Point::new(i as f64 + 0.5 * (j % 2) as f64, 0.75f64.sqrt() * j as f64);
    let pieces: Vec<Extent> = (0..side * side).map(|k| Extent { middle: middle(k % side, k / side), radius: 0.5 }).collect();
    let (mut supports, mut contacts) = (Vec::new(), Vec::new());
    for k in 0..side * side {
        let [x, y] = pieces[k].middle.into();
        let arm = Point::new(0.5, 0.0);
        let turn = [(pieces[k].middle + arm, Y), (pieces[k].middle - arm, -Y)];
        supports.extend(Condition::new(&pieces, k, None, &turn, 0.0));
        supports.extend((k < side).then(|| one_point(&pieces, k, None, x, y - 0.5, Y)));
        supports.extend((k % side == 0).then(|| one_point(&pieces, k, None, x - 0.5, y, X)));
        let near = |other: &usize| *other > k && (pieces[*other].middle - pieces[k].middle).norm() < 1.01;
        for other in (k + 1..(k + 2 * side).min(side * side)).filter(near) {
            let normal = pieces[other].middle - pieces[k].middle;
            let x = pieces[k].middle + 0.5 * normal;
            let of = |piece: usize, against: usize, sign: f64| {
                let one = |tilt: f64| {
                    let direction = sign * Point::new(normal.x - tilt * normal.y, normal.y + tilt * normal.x).normalize();
                    one_point(&pieces, piece, Some(against), x.x - 0.5 * tilt * normal.y, x.y + 0.5 * tilt * normal.x, direction)
                };
                [-0.02, 0.02].map(|tilt| one(sign * tilt)).to_vec()
            };
            contacts.push([of(k, other, 1.0), of(other, k, -1.0)]);
        }
    }
    (pieces, supports, contacts)
}

#[test]
fn a_packing_is_held_and_a_disc_that_nothing_touches_is_found() {
    let (pieces, mut supports, mut contacts) = packing(30);
    assert!(contacts.len() > 2500);
    assert_eq!(find_mechanism(&pieces, &supports, &contacts), None);
    let is_of = |touch: &Touch| touch[0].iter().any(|condition| condition.piece == 437 || condition.against == Some(437));
    contacts.iter_mut().filter(|touch| is_of(touch)).for_each(|touch| *touch = Touch::default());
    let found = find_mechanism(&pieces, &supports, &contacts).expect("it moves");
    assert_eq!((found.piece, found.motion.as_str()), (437, "move by (1, 0)"));
    supports.clear();
    assert!(find_mechanism(&pieces, &supports, &contacts).is_some());
}

#[test]
fn what_is_needed_is_what_leaves_a_motion_when_it_is_gone() {
    let same = |pieces: &[Extent], supports: &[Condition], contacts: &[Touch]| {
        let needed = needed_contacts(pieces, supports, contacts);
        for at in 0..contacts.len() {
            let mut others = contacts.to_vec();
            others[at] = Touch::default();
            assert_eq!(needed[at], find_mechanism(pieces, supports, &others).is_some(), "contact {at}");
        }
        needed.iter().filter(|needed| **needed).count()
    };
    let (pieces, supports, contacts) = packing(5);
    assert_eq!(same(&pieces, &supports, &contacts), 0, "each disc has more neighbours than it needs");
    // Discs that lie on two others each need both; the last of a row slides off where it has but one.
    let is_level = |touch: &Touch| touch[0].iter().all(|condition| condition.sees[0][1].abs() < 0.1);
    let upright: Vec<Touch> = contacts.iter().filter(|touch| !is_level(touch)).cloned().collect();
    let few: Vec<Touch> =
        contacts.iter().enumerate().filter(|(at, touch)| at % 7 > 0 || !is_level(touch)).map(|own| own.1.clone()).collect();
    let counts = [upright, few].map(|contacts| (same(&pieces, &supports, &contacts), contacts.len()));
    assert!(counts.iter().any(|(needed, all)| *needed > 0 && needed < all), "{counts:?}");
    let (pieces, supports, contact) = disc(0.3, 0.0);
    assert_eq!(same(&pieces, &supports, std::slice::from_ref(&contact)), 1, "it is not held at all");
    let held = [supports, vec![one_point(&pieces, 1, None, 1.0, 2.0, X), one_point(&pieces, 1, None, 1.0, 3.0, X)]].concat();
    assert_eq!(same(&pieces, &held, std::slice::from_ref(&contact)), 1);
    let fixed = [held, vec![one_point(&pieces, 1, None, 1.0, 3.0, Y)]].concat();
    assert_eq!(same(&pieces, &fixed, &[contact]), 0);
}

/// A body on two flanks, one point each, and one that may turn on a flat: forces as statics sets them.
#[test]
fn a_push_changes_forces_as_statics_says() {
    let (pieces, slope) = (two(), 0.05_f64);
    let supports = [held(0), vec![hold(1, 0.0, 1.0, X), hold(1, 2.0, 1.0, Y), hold(1, 0.0, 1.0, Y)]].concat();
    let turn = &supports[..4];
    let flank = |x: f64, way: f64| {
        let normal = Point::new(way * slope.sin(), -slope.cos());
        [1, 0].map(|piece| vec![one_point(&pieces, piece, Some(1 - piece), x, 1.0, if piece == 1 { normal } else { -normal })])
    };
    let flanks = [flank(1.5, 1.0), flank(0.5, -1.0)];
    let angle = Condition { piece: 1, against: None, sees: [[0.0, 0.0, 1.0], [0.0; 3]], doubt: 0.0 };
    let held = [&supports[..3], &[angle]].concat();
    let changes = changed_forces(&pieces, &held, &flanks, (1, [1.0, 0.0, 0.0])).expect("flanks resist it");
    let wanted = 0.5 / slope.sin();
    for ([sum, size], sign) in changes.into_iter().zip([1.0, -1.0]) {
        assert!((sum - sign * wanted).abs() < 1e-6 * wanted && (size - wanted).abs() < 1e-6 * wanted, "{sum} {size}");
    }
    // Nothing resists a shift along a flat, and a flat resists a turn by its ends.
    let flat = [touching(&pieces, &[0.0, 2.0])];
    assert_eq!(changed_forces(&pieces, &supports[..3], &flat, (1, [1.0, 0.0, 0.0])), None);
    let by_ends = changed_forces(&pieces, turn, &flat, (1, [0.0, 0.0, 1.0])).expect("its ends resist it");
    assert!(by_ends[0][0].abs() < 1e-6 && (by_ends[0][1] - 1.0).abs() < 1e-6, "{by_ends:?}");
    // Where round sides meet on either side of a disc that does not turn, what presses moves along them.
    let round = [pieces[0], Extent { middle: Point::new(1.0, 2.0), radius: 1.0 }];
    let side = |up: f64| {
        let sees = |piece: usize, turn: f64, sign: f64| {
            let at = |a: f64| {
                let normal = sign * Point::new((turn * a).sin(), up * (turn * a).cos());
                one_point(&round, piece, Some(1 - piece), 1.0 + a.sin(), 2.0 + up * a.cos(), normal)
            };
            [-0.1, 0.0, 0.1].map(at).to_vec()
        };
        [sees(0, 0.5, -1.0), sees(1, 1.0, 1.0)]
    };
    let moved = changed_forces(&round, &held, &[side(1.0), side(-1.0)], (1, [1.0, 0.0, 0.0])).expect("both resist it");
    assert!(moved.iter().all(|[sum, size]| sum.abs() < 1e-6 && *size < 1e-6), "{moved:?}");
    // A disc that turns presses elsewhere.
    let (round, below, contact) = disc(0.1, 0.0);
    assert_eq!(changed_forces(&round, &below, &[contact], (1, [0.0, 0.0, 1.0])), None);
}

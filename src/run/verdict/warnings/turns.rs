//! Whether the angles that a case gives are small.

use crate::body::RigidSet;
use crate::case::Case;
use crate::run::verdict::limits::ROTATION;

/// Words for each rigid tool and each plate whose given angle no theory of small rotations is good for; of load steps the
/// largest angle counts.
pub fn far_turns(case: &Case) -> Vec<String> {
    let largest = |key: &str| {
        let steps = case.steps.iter().flat_map(|step| motions(&step.case));
        let same = steps.chain(motions(case)).filter(|motion| motion.key == key);
        same.filter_map(|motion| motion.prescribed[2]).max_by(|a, b| a.abs().total_cmp(&b.abs()))
    };
    let far = |key: &str| largest(key).filter(|angle| angle.abs() > ROTATION.value);
    let words = |motion: &RigidSet| {
        let (key, most) = (&motion.key, ROTATION.value);
        let angle = far(key)?;
        Some(format!(
            "{key}.angle = {angle}: radians, of which {most} can be trusted at most: the theory is that of small rotations; draw it as it lies after turning, and turn it by less"
        ))
    };
    motions(case).filter_map(words).collect()
}

/// What the case says of the motion of its tools and its plates.
fn motions(case: &Case) -> impl Iterator<Item = &RigidSet> {
    case.tools.iter().map(|tool| &tool.motion).chain(case.plates.iter().map(|plate| &plate.motion))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn angles_beyond_small_ones_are_told_of_tools_and_plates_in_any_step() {
        let case = |change: &str| {
            let text = format!(
                "mesh.file = \"a.msh\"\nbody.a = {{ young = 1.0, poisson = 0.3 }}\ncontact.c.between = [\"top\", \"rigid.die\"]\n{change}"
            );
            Case::parse(&text, Path::new("case.toml"), &[]).expect("a good case")
        };
        let turned = |angle: f64| {
            far_turns(&case(&format!(
                "rigid.die = {{ line = [[0, 1], [1, 1]], angle = {angle:?} }}\nload.l = {{ on = \"right\", rigid = true, force = [0, 1], angle = {angle:?} }}"
            )))
        };
        assert_eq!((turned(0.2), turned(-0.2)), (vec![], vec![]));
        let words = turned(-7.0);
        assert_eq!(words.len(), 2);
        assert!(words[0].starts_with("rigid.die.angle = -7: ") && words[1].starts_with("load.l.angle = -7: "), "{words:?}");
        let steps = case(
            "rigid.die = { line = [[0, 1], [1, 1]], angle = 0.1 }\nsteps.turn = { factors = [-4, 1], scales = [\"rigid.die\"] }",
        );
        assert!(far_turns(&steps)[0].starts_with("rigid.die.angle = -0.4: "));
    }
}

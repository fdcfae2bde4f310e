//! Nodal forces, kept in little memory: most loads act on boundaries.

/// Share of forces that are not zero below which these alone are kept.
const FEW: f64 = 0.3;

/// Nodal forces of this rank's unknowns.
pub enum Load {
    /// All of them.
    All(Vec<f64>),
    /// Those that are not zero, each with its unknown.
    Few(Vec<(u32, f64)>),
}

impl Load {
    /// Of all forces.
    pub fn new(forces: Vec<f64>) -> Self {
        let count = forces.iter().filter(|force| **force != 0.0).count();
        if count as f64 > FEW * forces.len() as f64 {
            return Self::All(forces);
        }
        let mut few = Vec::with_capacity(count);
        few.extend(forces.iter().enumerate().filter(|(_, force)| **force != 0.0).map(|(at, &force)| (at as u32, force)));
        Self::Few(few)
    }

    /// Puts the forces into a vector of zeros.
    pub fn put(&self, values: &mut [f64]) {
        match self {
            Self::All(forces) => values.copy_from_slice(forces),
            Self::Few(forces) => forces.iter().for_each(|&(at, force)| values[at as usize] = force),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_forces_and_many_are_the_same_forces() {
        let all = |few: usize| (0..100).map(|k| if k % few == 0 { 1.0 + f64::from(k as u32) } else { 0.0 }).collect::<Vec<_>>();
        for few in [1, 2, 5, 50] {
            let load = Load::new(all(few));
            assert_eq!(matches!(load, Load::Few(_)), few > 3);
            let mut values = vec![0.0; 100];
            load.put(&mut values);
            assert_eq!(values, all(few));
        }
    }
}

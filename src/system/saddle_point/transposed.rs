//! `B̂ᵀ (I - D̂ Ĉ)` by its columns: all but few of its rows are empty, and a matrix by rows has its tables for each of them.

use crate::discretisation::{Components, Space};
use crate::geometry::Point;
use crate::petsc::{Gather, Index, Operator, Result, Session, Vector};
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// Columns of those multipliers, of any rank, that have entries at nodes of this rank.
pub struct TransposedCoupling {
    /// Multipliers that have such entries, ascending.
    multipliers: Vec<usize>,
    /// For each of them its nodes, ascending and counted from this rank's first, with their entries.
    columns: RefCell<Vec<Vec<(u32, Point)>>>,
    /// The column behind the one that was set last.
    next: Cell<usize>,
    /// What fetches their values.
    gather: RefCell<Gather>,
    /// Numbers of this rank's multipliers, and how many there are on all ranks.
    own: std::ops::Range<usize>,
    count: usize,
    /// Numbers of the multipliers of the columns.
    numbers: Vec<usize>,
    session: Session,
}

impl TransposedCoupling {
    /// Zeros at the given nodes of each column, ascending and all of this rank; `number` are those of the multipliers, of which
    /// `own` are this rank's. **Collective**
    pub fn new(columns: &[Vec<usize>], number: &[usize], own: usize, space: &Space, session: &Session) -> Result<Rc<Self>> {
        let layout = Vector::new(session, own)?;
        let here = |column: &Vec<usize>| -> Vec<(u32, Point)> {
            column.iter().map(|&node| ((node - space.own.start) as u32, Point::zeros())).collect()
        };
        let all = columns.iter().map(here).enumerate().filter(|(_, column)| !column.is_empty());
        let (multipliers, columns): (Vec<usize>, Vec<_>) = all.unzip();
        let numbers: Vec<usize> = multipliers.iter().map(|&i| number[i]).collect();
        let wanted: Vec<Index> = numbers.iter().map(|&number| number as Index).collect();
        let gather = RefCell::new(Gather::new(&layout, &wanted)?);
        let (columns, session) = (RefCell::new(columns), session.clone());
        Ok(Rc::new(Self {
            multipliers,
            columns,
            next: Cell::new(0),
            gather,
            own: layout.range(),
            count: number.len(),
            numbers,
            session,
        }))
    }

    /// Puts a column, nodes ascending, in place of the one before, times a factor: zeros where it has no entry.
    pub fn set(&self, multiplier: usize, column: &[(usize, Point)], factor: f64, space: &Space) {
        // Columns are mostly set one after the other.
        let next = self.next.get();
        let is_next = self.multipliers.get(next) == Some(&multiplier);
        let Ok(at) = (if is_next { Ok(next) } else { self.multipliers.binary_search(&multiplier) }) else { return };
        self.next.set(at + 1);
        let mut entries = column.iter().skip_while(|(node, _)| *node < space.own.start).peekable();
        for (node, value) in &mut self.columns.borrow_mut()[at] {
            let node = space.own.start + *node as usize;
            while entries.next_if(|(other, _)| *other < node).is_some() {}
            *value = entries.next_if(|(other, _)| *other == node).map_or(Point::zeros(), |(_, entry)| entry * factor);
        }
    }
}

impl Operator for Rc<TransposedCoupling> {
    fn multiply(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        y.set(0.0)?;
        self.multiply_add(x, y)
    }

    fn multiply_add(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        let mut gather = self.gather.borrow_mut();
        let (values, mut y) = (gather.read(x)?, y.values_mut());
        let y: &mut [Components] = y.as_chunks_mut().0;
        for (column, lambda) in self.columns.borrow().iter().zip(values.iter()) {
            for &(node, value) in column {
                let [a, b] = &mut y[node as usize];
                (*a, *b) = (*a + value.x * lambda, *b + value.y * lambda);
            }
        }
        Ok(())
    }

    fn multiply_transpose(&self, x: &Vector, y: &mut Vector) -> Result<()> {
        let mut all = vec![0.0; self.count];
        let x = x.values();
        let x: &[Components] = x.as_chunks().0;
        for (column, &number) in self.columns.borrow().iter().zip(&self.numbers) {
            all[number] = column.iter().map(|&(node, value)| value.x * x[node as usize][0] + value.y * x[node as usize][1]).sum();
        }
        self.session.sum(&mut all);
        y.values_mut().copy_from_slice(&all[self.own.clone()]);
        Ok(())
    }

    fn work(&self) -> f64 {
        4.0 * self.columns.borrow().iter().map(|column| column.len() as f64).sum::<f64>()
    }
}

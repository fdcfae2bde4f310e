//! Counts and entries of the assembly made into matrices of PETSc's.

use super::assembly::Assembly;
use super::lattice_operator::Strips;
use super::preallocation::{ContactNeighbours, Counts};
use crate::geometry::Point;
use crate::petsc::{Matrix, Session};
use crate::system::{Space, SystemError};

/// The stored rows of a level, assembled, with explicit zeros for the couplings of contact, and the rows that are not stored.
/// `lift` is that of [`Assembly::entries`]. **Collective**
pub fn assembled(
    assembly: &Assembly,
    contact: &ContactNeighbours,
    lift: impl FnMut(usize, Point),
    session: &Session,
) -> Result<(Matrix, Strips), SystemError> {
    let space = assembly.space();
    let (diagonal, off_diagonal) = assembly.counts(contact);
    let mut matrix = Matrix::aij(session, space.local_unknowns(), space.local_unknowns(), 2, &diagonal, &off_diagonal)?;
    matrix.set_positive_definite(true)?;
    if assembly.has_strips() {
        matrix.expect_empty_rows()?;
    }
    let mut places: Vec<i32> = Vec::with_capacity(19);
    let entries = assembly.entries(
        |row, columns, values| {
            places.clear();
            places.extend(columns.iter().map(|&column| column as i32));
            Ok(matrix.add_blocks(&[row as i32], &places, values)?)
        },
        lift,
    );
    let strips = match entries {
        Err(SystemError::Petsc(error)) => return Err(error.into()),
        entries => session.agree(entries).map_err(SystemError::Case)?,
    };
    keep_places(&mut matrix, space, contact)?;
    matrix.assemble()?;
    Ok((matrix, strips))
}

/// A matrix of zeros at the couplings of contact alone. **Collective**
pub fn contact_places(space: &Space, contact: &ContactNeighbours, session: &Session) -> Result<Matrix, SystemError> {
    let counts = Counts::new(space, contact);
    let (mut diagonal, off_diagonal) = counts.finish();
    let untouched = |at: usize| !contact.contains_key(&(space.own.start + at));
    diagonal.iter_mut().enumerate().filter(|(at, _)| untouched(*at)).for_each(|(_, count)| *count = 0);
    let mut matrix = Matrix::aij(session, space.local_unknowns(), space.local_unknowns(), 2, &diagonal, &off_diagonal)?;
    keep_places(&mut matrix, space, contact)?;
    matrix.assemble()?;
    Ok(matrix)
}

/// Explicit zeros, which keep the places of the couplings.
fn keep_places(matrix: &mut Matrix, space: &Space, contact: &ContactNeighbours) -> Result<(), SystemError> {
    for (&row, columns) in contact.range(space.own.clone()) {
        for &column in columns {
            matrix.add_blocks(&[row as i32], &[column as i32], &[0.0; 4])?;
        }
    }
    Ok(())
}

//! How much a displacement has changed.

use crate::petsc::Session;

/// Change of a displacement since `then`, relative to its norm: this rank's unknowns of both, none for zeros. **Collective**
pub(crate) fn relative_change(now: &[f64], then: &[f64], session: &Session) -> f64 {
    let mut squares = [0.0; 2];
    for (now, then) in now.iter().zip(then.iter().chain(std::iter::repeat(&0.0))) {
        squares[0] += (now - then).powi(2);
        squares[1] += now * now;
    }
    session.sum(&mut squares);
    if squares[1] > 0.0 { (squares[0] / squares[1]).sqrt() } else { 0.0 }
}

//! The contact boundary as a table.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use super::SIGNS;
use crate::output::error::OutputError;

/// The solution at one point of the contact boundary; signs as in [`SIGNS`].
///
/// Points come in order of `s`; where λ jumps, two points with the same `s` carry both values.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactPoint {
    /// Arc length from the first end of the contact boundary.
    pub s: f64,
    /// Position on the contact boundary.
    pub x: f64,
    /// Position on the contact boundary.
    pub y: f64,
    /// Unit normal from body 1 to body 2.
    pub nx: f64,
    /// Unit normal from body 1 to body 2.
    pub ny: f64,
    /// Contact pressure λ (stress).
    pub lambda: f64,
    /// Gap of the deformed bodies (length).
    pub gap: f64,
    /// Normal displacement n · u of body 1 at the corresponding point (length).
    pub un_1: f64,
    /// Normal displacement n · u of body 2.
    pub un_2: f64,
    /// Normal stress n · σ n on the trace of body 1 (stress).
    pub sigma_1: f64,
    /// Normal stress n · σ n on the trace of body 2.
    pub sigma_2: f64,
}

/// Writes `contact_NAME.csv`: [`SIGNS`] as lines that start with `# `, the names of the columns, one line per point.
///
/// Numbers are the shortest that read back as the same double.
///
/// # Errors
/// The operating system refuses.
pub fn write_contact(path: &Path, points: &[ContactPoint]) -> Result<(), OutputError> {
    File::create(path).and_then(|file| write_table(BufWriter::new(file), points)).map_err(OutputError::io("write", path))
}

fn write_table(mut out: impl Write, points: &[ContactPoint]) -> std::io::Result<()> {
    for line in SIGNS.iter() {
        writeln!(out, "# {line}")?;
    }
    writeln!(out, "s,x,y,nx,ny,lambda,gap,un_1,un_2,sigma_1,sigma_2")?;
    for p in points {
        write!(out, "{:?},{:?},{:?},{:?},{:?},{:?},", p.s, p.x, p.y, p.nx, p.ny, p.lambda)?;
        writeln!(out, "{:?},{:?},{:?},{:?},{:?}", p.gap, p.un_1, p.un_2, p.sigma_1, p.sigma_2)?;
    }
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back_as_they_were() {
        let point = ContactPoint {
            s: 1.0 / 3.0,
            x: -0.0,
            y: 1e-300,
            nx: 0.1 + 0.2,
            ny: 1.0,
            lambda: std::f64::consts::PI * 1e20,
            gap: -5e-324,
            un_1: 7.0,
            un_2: f64::MAX,
            sigma_1: f64::MIN_POSITIVE,
            sigma_2: -1.5e-9,
        };
        let mut text = Vec::new();
        write_table(&mut text, &[point, point]).unwrap();
        let text = String::from_utf8(text).unwrap();
        let mut lines = text.lines().skip_while(|line| line.starts_with("# "));
        assert_eq!(lines.next(), Some("s,x,y,nx,ny,lambda,gap,un_1,un_2,sigma_1,sigma_2"));
        let row: Vec<f64> = lines.next().unwrap().split(',').map(|number| number.parse().unwrap()).collect();
        let p = point;
        assert_eq!(row, [p.s, p.x, p.y, p.nx, p.ny, p.lambda, p.gap, p.un_1, p.un_2, p.sigma_1, p.sigma_2]);
        assert_eq!(lines.count(), 1);
        assert!(text.lines().all(|line| line.len() < 260));
    }

    #[test]
    fn signs_are_stated_before_the_table() {
        let mut text = Vec::new();
        write_table(&mut text, &[]).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(SIGNS.iter().all(|sign| text.contains(&format!("# {sign}\n"))));
        assert_eq!(text.lines().count(), SIGNS.len() + 1);
    }
}

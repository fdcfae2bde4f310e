//! Files for ParaView are read back by the Python packages `vtk` and `meshio`, value by value.
//!
//! Set `MEZHA_PYTHON` to an interpreter that has both; without it the test says so and checks nothing.

use std::fs;
use std::path::Path;
use std::process::Command;

use mezha::element::Order;
use mezha::geometry::Point;
use mezha::output::vtk::{Piece, PieceNode, write_curve, write_parallel, write_piece};
use mezha::recovery::TracePoint;

/// Two triangles of the rectangle with the given lower left corner, with fields that are formulas of the place.
fn write_rectangle(path: &Path, order: Order, corner: [f64; 2], rank: i32) {
    let (offsets, cells): (&[[f64; 2]], &[u32]) = match order {
        Order::P1 => (&[[0., 0.], [2., 0.], [2., 1.], [0., 1.]], &[0, 1, 2, 0, 2, 3]),
        Order::P2 => (
            &[[0., 0.], [2., 0.], [2., 1.], [0., 1.], [1., 0.], [2., 0.5], [1., 0.5], [1., 1.], [0., 0.5]],
            &[0, 1, 2, 4, 5, 6, 0, 2, 3, 6, 7, 8],
        ),
    };
    let node = |d: &[f64; 2]| {
        let [x, y] = [corner[0] + d[0], corner[1] + d[1]];
        PieceNode {
            place: [x, y],
            displacement: [0.1 * x + y / 3.0, x * y],
            stress: [x + y, x - y, x * y, 0.3 * x],
            von_mises: 1e-7 * x + 1e7 * y,
            temperature: 20.0 + x - 3.0 * y,
        }
    };
    let (nodes, parts) = (offsets.iter().map(node).collect(), vec![[7, 9], [8, 8]]);
    let piece = Piece { order, nodes, cells: cells.to_vec(), parts, is_heated: true, rank };
    write_piece(path, &piece).unwrap();
}

/// A quarter circle; the fourth and fifth point share their place, where λ jumps.
fn quarter_circle() -> Vec<TracePoint> {
    let point = |number: usize, s: f64| TracePoint {
        arc: s,
        x: Point::new(s.cos(), s.sin()),
        normal: Point::new(s.cos(), s.sin()),
        lambda: number as f64 + 0.5,
        gap: 1e-9 * s,
        displacement: [2.0 * s, 3.0 * s],
        stress: [-s, -2.0 * s],
        ..TracePoint::default()
    };
    [0.0, 0.3, 0.6, 0.9, 0.9, 1.2, 1.5].iter().enumerate().map(|(number, &s)| point(number, s)).collect()
}

#[test]
fn python_reads_what_was_written() {
    let Some(python) = std::env::var_os("MEZHA_PYTHON") else {
        println!("skipped: MEZHA_PYTHON is not set, so nobody has read the files");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    write_rectangle(&path("p1.vtu"), Order::P1, [-1.0, 3.0], 0);
    write_rectangle(&path("p2.vtu"), Order::P2, [5.0, -2.0], 4);
    let pieces = ["fields_0.vtu", "fields_1.vtu", "fields_2.vtu"];
    write_rectangle(&path(pieces[0]), Order::P2, [0.0, 0.0], 0);
    write_rectangle(&path(pieces[1]), Order::P2, [2.0, 0.0], 1);
    let (nodes, cells, parts) = (Vec::new(), Vec::new(), Vec::new());
    let empty = Piece { order: Order::P2, nodes, cells, parts, is_heated: true, rank: 2 };
    write_piece(&path(pieces[2]), &empty).unwrap();
    write_parallel(&path("fields.pvtu"), &pieces, true).unwrap();
    write_curve(&path("contact_arc.vtu"), &quarter_circle()).unwrap();
    assert!(fs::read_to_string(path("fields.pvtu")).unwrap().contains("fields_2.vtu"));

    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/vtk_readable.py");
    let run = Command::new(python).arg(script).arg(folder.path()).output().unwrap();
    let said = String::from_utf8_lossy(&run.stdout);
    assert!(run.status.success(), "{said}{}", String::from_utf8_lossy(&run.stderr));
    assert!(said.ends_with("all files read\n"), "{said}");
}

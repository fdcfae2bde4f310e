"""Reads the files that tests/vtk_readable.rs wrote into a folder, with vtk and with meshio, and compares every value.

usage: vtk_readable.py FOLDER
"""

import sys
from pathlib import Path

import meshio
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader


def read_with_vtk(path):
    """Points, cells by VTK type, point data and cell data of a .vtu or .pvtu file."""
    reader = vtkXMLPUnstructuredGridReader() if path.suffix == ".pvtu" else vtkXMLUnstructuredGridReader()
    complaints = []
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append(path))
    reader.AddObserver("WarningEvent", lambda *_: complaints.append(path))
    reader.SetFileName(str(path))
    reader.Update()
    assert not complaints, f"vtk complains about {path.name}"
    grid = reader.GetOutput()
    cells = [[grid.GetCell(i).GetPointId(k) for k in range(grid.GetCell(i).GetNumberOfPoints())] for i in range(grid.GetNumberOfCells())]
    kinds = {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}
    fields = [
        {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
        for data in (grid.GetPointData(), grid.GetCellData())
    ]
    return vtk_to_numpy(grid.GetPoints().GetData()), np.array(cells), kinds, *fields


def read_with_meshio(path):
    """The same through meshio, which has no .pvtu."""
    kinds = {"line": 3, "triangle": 5, "triangle6": 22}
    mesh = meshio.read(path)
    (block,) = mesh.cells
    cell_data = {name: values[0] for name, values in mesh.cell_data.items()}
    return mesh.points, block.data, {kinds[block.type]}, mesh.point_data, cell_data


def check_bodies(points, cells, kinds, point_data, cell_data, kind, body, rank):
    """Fields are the formulas of the place that the Rust side wrote; triangles have the area one and run counter-clockwise."""
    x, y, z = points.T
    assert kinds == {kind} and not z.any()
    exact = {
        "displacement": [0.1 * x + y / 3.0, x * y, 0 * x],
        "stress": [x + y, x - y, x * y, 0.3 * x],
        "von_mises": 1e-7 * x + 1e7 * y,
        "temperature": 20.0 + x - 3.0 * y,
    }
    assert set(point_data) == set(exact) and set(cell_data) == {"body", "part", "rank"}
    for name, values in exact.items():
        np.testing.assert_array_equal(point_data[name], np.array(values).T, err_msg=name)
    np.testing.assert_array_equal(cell_data["body"], body)
    np.testing.assert_array_equal(cell_data["part"], [9, 8] * (len(body) // 2))
    np.testing.assert_array_equal(cell_data["rank"], rank)
    a, b, c = (points[cells[:, k]] for k in range(3))
    np.testing.assert_array_equal(np.cross(b - a, c - a)[:, 2], 2.0)
    for middle, first, second in [(3, 0, 1), (4, 1, 2), (5, 2, 0)] if kind == 22 else []:
        np.testing.assert_array_equal(points[cells[:, middle]], (points[cells[:, first]] + points[cells[:, second]]) / 2)


def check_curve(points, cells, kinds, point_data, cell_data):
    """The quarter circle, with a jump between points 3 and 4."""
    s = np.array([0.0, 0.3, 0.6, 0.9, 0.9, 1.2, 1.5])
    normal = np.array([np.cos(s), np.sin(s), 0 * s]).T
    assert kinds == {3} and not cell_data
    assert cells.tolist() == [[0, 1], [1, 2], [2, 3], [4, 5], [5, 6]]
    exact = {"s": s, "lambda": np.arange(7) + 0.5, "gap": 1e-9 * s, "un_1": 2 * s, "un_2": 3 * s, "sigma_1": -s, "sigma_2": -2 * s}
    assert set(point_data) == {*exact, "normal"}
    for name, values in exact.items():
        np.testing.assert_array_equal(np.ravel(point_data[name]), values, err_msg=name)
    np.testing.assert_allclose(points, normal, atol=1e-15)
    np.testing.assert_allclose(point_data["normal"], normal, atol=1e-15)


folder = Path(sys.argv[1])
for read in (read_with_vtk, read_with_meshio):
    check_bodies(*read(folder / "p1.vtu"), kind=5, body=[7, 8], rank=[0, 0])
    check_bodies(*read(folder / "p2.vtu"), kind=22, body=[7, 8], rank=[4, 4])
    check_bodies(*read(folder / "fields_1.vtu"), kind=22, body=[7, 8], rank=[1, 1])
    check_curve(*read(folder / "contact_arc.vtu"))
check_bodies(*read_with_vtk(folder / "fields.pvtu"), kind=22, body=[7, 8, 7, 8], rank=[0, 0, 1, 1])
print("all files read")

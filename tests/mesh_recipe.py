"""Writes one mesh as Abaqus, MED and Exodus file, and converts each with python/mesh_to_gmsh.py: mesh_recipe.py FOLDER.

Prints the names of the formats that could be tried: MED needs h5py, Exodus netCDF4.
"""

import pathlib
import subprocess
import sys

import meshio
import numpy as np

ABAQUS = """*HEADING
Two blocks, the lower one of two kinds of elements in one set; nodes in two parts, sets of several ranges.
*NODE
1, 0., 0.
2, 1., 0.
3, 2., 0.
4, 0., 1.
5, 1., 1.
6, 2., 1.
*NODE
11, 0., 1.
12, 2., 1.
13, 2., 2.
14, 0., 2.
*Element, type=cpe4r, elset=lower
1, 1, 2, 5, 4
*ELEMENT, TYPE=CPE3, ELSET=lower
2, 2, 3, 6
22, 2, 6, 5
*ELEMENT, TYPE=CPE3,
ELSET=upper
3, 11, 12,
13
4, 11, 13, 14
*ELSET, ELSET=everything, GENERATE
1, 4, 1
22, 22
*NSET, NSET=bottom, GENERATE
1, 2
3, 3, 1
*NSET, NSET=lower.seam
4, 5, 6
*NSET, NSET=upper.seam
11, 12
*NSET, NSET=top
13, 14
"""

POINTS = np.array([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1], [0, 1], [2, 1], [2, 2], [0, 2]], dtype=float)
QUADRANGLES, TRIANGLES = np.array([[0, 1, 4, 3], [1, 2, 5, 4]]), np.array([[6, 7, 8], [6, 8, 9]])
CURVES = {"bottom": [[0, 1], [1, 2]], "lower.seam": [[5, 4], [4, 3]], "upper.seam": [[6, 7]], "top": [[8, 9]]}


def med(file):
    import h5py  # noqa: F401

    lines = [line for lines in CURVES.values() for line in lines]
    tags = {-6: ["lower"], -7: ["upper"], **{-8 - k: [name] for k, name in enumerate(CURVES)}}
    of_lines = [-8 - k for k, lines in enumerate(CURVES.values()) for _ in lines]
    cells = [("line", np.array(lines)), ("quad", QUADRANGLES), ("triangle", TRIANGLES)]
    data = {"cell_tags": [np.array(of_lines), np.full(2, -6), np.full(2, -7)]}
    mesh = meshio.Mesh(POINTS, cells, cell_data=data)
    mesh.cell_tags, mesh.point_tags = tags, {}
    meshio.write(file, mesh)


def exodus(file):
    import netCDF4

    sets = {name: np.unique(CURVES[name]) for name in ["bottom", "top"]}
    points = np.column_stack([POINTS, np.zeros(len(POINTS))])
    mesh = meshio.Mesh(points, [("quad", QUADRANGLES), ("triangle", TRIANGLES)], point_sets=sets)
    meshio.write(file, mesh)
    with netCDF4.Dataset(file, "a") as data:
        data.createDimension("num_side_sets", 2)
        data.createDimension("len_name", 33)
        for key, names in [("eb_names", ["lower", "upper"]), ("ss_names", ["lower.seam", "upper.seam"])]:
            row = data.createVariable(key, "S1", ("num_el_blk" if key == "eb_names" else "num_side_sets", "len_name"))
            for k, name in enumerate(names):
                row[k, : len(name)] = np.array(list(name), dtype="S1")
        for k, (elements, sides) in enumerate([([1, 2], [3, 3]), ([3], [1])]):
            data.createDimension(f"num_side_ss{k + 1}", len(elements))
            data.createVariable(f"elem_ss{k + 1}", "i4", (f"num_side_ss{k + 1}",))[:] = elements
            data.createVariable(f"side_ss{k + 1}", "i4", (f"num_side_ss{k + 1}",))[:] = sides


def abaqus(file):
    file.write_text(ABAQUS)


folder = pathlib.Path(sys.argv[1])
script = pathlib.Path(__file__).parent.parent / "python" / "mesh_to_gmsh.py"
for write, ending in [(abaqus, "inp"), (med, "med"), (exodus, "e")]:
    file = folder / f"blocks.{ending}"
    try:
        write(file)
    except ImportError as error:
        print(f"{ending} is left out: {error}")
        continue
    subprocess.run([sys.executable, script, file, folder / f"{ending}.msh"], check=True, stdout=subprocess.DEVNULL)
    print(f"{ending}.msh")

REFUSED = [("cpe4r", "CAX4P", "are axisymmetric"), ("cpe4r", "C3D4", "are not read"), ("1, 1, 2, 5, 4", "1, 1, 2, 5, 9", "node 9"),
           ("*HEADING", "*INSTANCE, NAME=a, PART=b", "Do not use parts"), ("1, 2\n3, 3, 1", "1, 2\n3, 3, 0", "at least 1")]
for good, bad, words in REFUSED:
    file = folder / "refused.inp"
    file.write_text(ABAQUS.replace(good, bad))
    run = subprocess.run([sys.executable, script, file, folder / "none"], capture_output=True, text=True)
    assert run.returncode == 1 and words in run.stderr and "Traceback" not in run.stderr, f"{bad}: {run.stderr}"

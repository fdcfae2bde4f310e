"""Reads the mesh files of a folder with meshio, and with gmsh if it is there: mesh_readable.py FOLDER.

Prints for every file, by name, its points, and the number of lines and triangles of each physical group.
"""

import pathlib
import sys
from collections import Counter

import meshio

try:
    import gmsh
except (ImportError, OSError):
    gmsh = None

DIMENSION = {"line": 1, "triangle": 2}


def by_meshio(file):
    mesh = meshio.read(file)
    names = {(dimension, tag): name for name, (tag, dimension) in mesh.field_data.items()}
    counts = Counter()
    for cells, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
        counts.update(names[DIMENSION[cells.type], tag] for tag in tags)
    return len(mesh.points), counts


def by_gmsh(file):
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(file))
    counts = Counter()
    for dimension, tag in gmsh.model.getPhysicalGroups():
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, tag):
            _, tags, _ = gmsh.model.mesh.getElements(dimension, entity)
            counts[gmsh.model.getPhysicalName(dimension, tag)] += sum(map(len, tags))
    points = len(gmsh.model.mesh.getNodes()[0])
    gmsh.finalize()
    return points, counts


def words(points, counts):
    return f"{points} points; " + "; ".join(f"{name} {count}" for name, count in sorted(counts.items()))


for file in sorted(pathlib.Path(sys.argv[1]).glob("*.msh")):
    read = words(*by_meshio(file))
    print(f"{file.name}: {read}")
    if gmsh:
        again = words(*by_gmsh(file))
        assert again == read, f"{file.name}: gmsh reads {again}, meshio {read}"

"""Makes a Gmsh file of a plane mesh in any format that meshio reads, with its names: mesh_to_gmsh.py FROM TO.msh

Needs `pip install meshio`; for MED files `h5py` too, and for Exodus `netCDF4`.

Sets of triangles and quadrangles become physical surfaces (bodies), sets of lines, of element sides and of nodes on the boundary
become physical curves:

    Abaqus   *ELEMENT, ELSET= and *ELSET (an element in several sets belongs to the smallest), *NSET
    MED      groups of faces, of edges and of nodes
    Exodus   blocks, side sets and node sets
    others   sets of cells and of points, as meshio reads them

Second-order elements stay so: mezha takes curved sides from their midside nodes.
"""

import os
import sys
from collections import Counter, defaultdict

import abaqus_file
import meshio
import numpy as np

FACES = {"triangle": 3, "triangle6": 3, "quad": 4, "quad8": 4, "quad9": 4}
LINES = {"line", "line3"}


def cell_sets(mesh, file):
    """Names of sets of cells: {name: [indices in block 0, indices in block 1, ...]}."""
    empty = [np.array([], dtype=int)] * len(mesh.cells)
    sets = {name: [np.asarray([] if own is None else own, dtype=int) for own in of] for name, of in mesh.cell_sets.items()}
    groups = getattr(mesh, "cell_tags", {})  # MED: a tag for each combination of groups
    for block, tags in enumerate(mesh.cell_data.get("cell_tags", [])):
        for tag, names in groups.items():
            for name in names:
                sets.setdefault(name, list(empty))
                sets[name][block] = np.union1d(sets[name][block], np.flatnonzero(tags == tag))
    if "gmsh:physical" in mesh.cell_data:
        for name, (tag, _) in mesh.field_data.items():
            sets[name] = [np.flatnonzero(tags == tag) for tags in mesh.cell_data["gmsh:physical"]]
    return sets


def point_sets(mesh):
    """Names of sets of points: {name: indices}."""
    sets = {name: np.asarray(own, dtype=int) for name, own in mesh.point_sets.items()}
    for tag, names in getattr(mesh, "point_tags", {}).items():
        for name in names:
            own = np.flatnonzero(mesh.point_data["point_tags"] == tag)
            sets[name] = np.union1d(sets.get(name, own), own)
    return sets


def exodus_sets(file, mesh):
    """Names of blocks, and lines of side sets, which meshio does not read: ({name: cells}, {name: [block, cell, side]})."""
    import netCDF4

    with netCDF4.Dataset(file) as data:
        def names(key, count, kind):
            rows = data[key][:] if key in data.variables else []
            found = [b"".join(np.ma.filled(row, b"")).decode().strip("\0 ") for row in rows]
            return [(found[k] if k < len(found) else "") or f"{kind}_{k + 1}" for k in range(count)]

        count = len(mesh.cells)
        blocks = {}
        for k, name in enumerate(names("eb_names", count, "block")):
            own = [np.arange(len(block.data)) if j == k else np.array([], dtype=int) for j, block in enumerate(mesh.cells)]
            blocks[name] = own
        starts = np.cumsum([0] + [len(block.data) for block in mesh.cells])
        sides = {}
        total = len(data.dimensions["num_side_sets"]) if "num_side_sets" in data.dimensions else 0
        for k, name in enumerate(names("ss_names", total, "side_set")):
            elements, numbers = data[f"elem_ss{k + 1}"][:] - 1, data[f"side_ss{k + 1}"][:] - 1
            at = np.searchsorted(starts, elements, side="right") - 1
            sides[name] = [(int(b), int(e - starts[b]), int(s)) for b, e, s in zip(at, elements, numbers)]
    return blocks, sides


def side(block, cell, number):
    """Nodes of one side of a face: both ends, and the midside node of second-order elements."""
    corners, nodes = FACES[block.type], block.data[cell]
    ends = [nodes[number], nodes[(number + 1) % corners]]
    return ends + [nodes[corners + number]] if len(nodes) > corners else ends


def converted(file):
    """The mesh of a file with physical groups."""
    if not os.path.isfile(file):
        sys.exit(f"{file}: no such file")
    if str(file).lower().endswith(".msh"):
        sys.exit(f"{file}: mezha reads the files of Gmsh itself")
    mesh = abaqus_file.read(file) if str(file).lower().endswith(".inp") else meshio.read(file)
    heights = mesh.points[:, 2:]
    if heights.size and np.ptp(heights) > 1e-9 * np.ptp(mesh.points, axis=0).max():
        sys.exit(f"{file}: does not lie in a plane z = constant; turn it into one, since mezha drops the coordinate z")
    sets, sides = cell_sets(mesh, file), {}
    if str(file).lower().endswith((".e", ".exo", ".ex2", ".g")):
        blocks, sides = exodus_sets(file, mesh)
        sets.update(blocks)
    faces = [k for k, block in enumerate(mesh.cells) if block.type in FACES]
    if not faces:
        sys.exit(f"{file}: has no triangles and no quadrangles; mezha reads plane meshes")

    # An element belongs to the smallest set that it is in.
    size = {name: sum(len(own[k]) for k in faces) for name, own in sets.items()}
    body = {k: np.full(len(mesh.cells[k].data), "body", dtype=object) for k in faces}
    for name in sorted((name for name in sets if size[name]), key=lambda name: -size[name]):
        for k in faces:
            body[k][sets[name][k]] = name

    outer = Counter()
    for k in faces:
        for cell in range(len(mesh.cells[k].data)):
            for number in range(FACES[mesh.cells[k].type]):
                outer[tuple(sorted(side(mesh.cells[k], cell, number)))] += 1
    curves = defaultdict(list)
    for name, own in sets.items():
        for k, block in enumerate(mesh.cells):
            if block.type in LINES:
                curves[name] += [tuple(line) for line in block.data[own[k]]]
    for name, own in sides.items():
        curves[name] += [tuple(side(mesh.cells[block], cell, number)) for block, cell, number in own]
    on_boundary = [
        line
        for k in faces
        for cell in range(len(mesh.cells[k].data))
        for line in (tuple(side(mesh.cells[k], cell, number)) for number in range(FACES[mesh.cells[k].type]))
        if outer[tuple(sorted(line))] == 1
    ]
    for name, own in point_sets(mesh).items():
        own = set(own.tolist())
        found = [line for line in on_boundary if own.issuperset(line)]
        if found and name not in curves:
            curves[name] = found

    groups = defaultdict(list)  # (dimension, name, type) -> cells
    for name, lines in curves.items():
        for line in lines:
            groups[1, name, "line" if len(line) == 2 else "line3"].append(line)
    for k in faces:
        for name, cell in zip(body[k], mesh.cells[k].data):
            groups[2, name, mesh.cells[k].type].append(cell)
    names = list(dict.fromkeys((dimension, name) for dimension, name, _ in groups))
    tags = {group: number + 1 for number, group in enumerate(names)}
    cells = [(kind, np.array(own)) for (_, _, kind), own in groups.items()]
    physical = [np.full(len(own), tags[dimension, name]) for (dimension, name, _), own in groups.items()]
    points = np.zeros((len(mesh.points), 3))
    points[:, :2] = mesh.points[:, :2]
    # A curve and a surface may have one name; meshio knows groups by their names alone.
    both = {name for dimension, name in names if (3 - dimension, name) in tags}
    told = {(f"{name}.boundary" if dimension == 1 and name in both else name): np.array([tags[dimension, name], dimension])
            for dimension, name in names}
    data = {"gmsh:physical": physical, "gmsh:geometrical": physical}
    return meshio.Mesh(points, cells, cell_data=data, field_data=told)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    mesh = converted(sys.argv[1])
    meshio.write(sys.argv[2], mesh, file_format="gmsh22", binary=False)
    for name, (tag, dimension) in mesh.field_data.items():
        count = sum(int((tags == tag).sum()) for tags in mesh.cell_data["gmsh:physical"])
        print(f"{'body' if dimension == 2 else 'boundary'} {name}: {count} elements")


if __name__ == "__main__":
    main()

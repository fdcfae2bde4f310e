"""Reads plane meshes from Abaqus input files: nodes, elements and their sets.

meshio's own reader loses nodes of a second *NODE, elements of an ELSET that two *ELEMENT name, and all but the first line of a
set that is generated, and takes axisymmetric elements for plane ones.
"""

import os
import re

import meshio
import numpy as np

SHAPES = {"3": ("triangle", 3), "4": ("quad", 4), "6": ("triangle6", 6), "8": ("quad8", 8)}
PLANE = re.compile(r"(CPS|CPE|CPEG|M2D)([3468])(R|H|RH|I|IH|M|MH|T|RT|HT|P|PH|RP)?$")
LINE = re.compile(r"(T2D|B2)([123])[A-Z]*$")
MOST_INCLUDED = 20


def blocks(file, depth=0):
    """Keyword, parameters and data lines, one after the other, of a file and those that it includes."""
    if depth > MOST_INCLUDED:
        raise SystemExit(f"{file}: *INCLUDE goes round in a circle, or is too deep")
    if not os.path.isfile(file):
        raise SystemExit(f"{file}: no such file")
    found, goes_on = [], False
    with open(file, encoding="utf-8", errors="replace") as text:
        for line in (line.strip() for line in text):
            if line.startswith("**") or not line:
                continue
            if line.startswith("*"):
                key = " ".join(line.lstrip("*").partition(",")[0].upper().split())
                found.append({"key": key, "parameters": {}, "lines": []})
            if line.startswith("*") or goes_on:
                # A line of a keyword that ends with a comma goes on in the next one.
                goes_on = line.endswith(",")
                pairs = (word.partition("=") for word in line.lstrip("*").split(","))
                found[-1]["parameters"].update({name.strip().upper(): value.strip().strip('"') for name, _, value in pairs})
            elif found:
                found[-1]["lines"].append(line)
    for block in found:
        if block["key"] == "INCLUDE":
            yield from blocks(os.path.join(os.path.dirname(file), block["parameters"].get("INPUT", "")), depth + 1)
        else:
            yield block


def shape(kind, file):
    """meshio's name of an element type, and its number of nodes."""
    plane, line = PLANE.match(kind), LINE.match(kind)
    if plane:
        return SHAPES[plane[2]]
    if line:
        return ("line3", 3) if line[2] == "3" or kind.startswith("B22") else ("line", 2)
    if kind.startswith(("CAX", "CGAX", "SAX", "MAX")):
        raise SystemExit(f"{file}: elements {kind} are axisymmetric; write CPE elements in their place, and plane = \"axisymmetric\" in the case")
    raise SystemExit(f"{file}: elements {kind} are not read; mezha takes plane ones: CPE and CPS of 3, 4, 6 or 8 nodes")


def numbers(name, block, file):
    """Whole numbers of a set, and names of sets in it."""
    rows = [[word.strip() for word in line.split(",") if word.strip()] for line in block["lines"]]
    if "GENERATE" in block["parameters"]:
        ranges = [[int(word) for word in row] + [1] for row in rows]
        if any(len(row) not in (3, 4) or row[2] < 1 for row in ranges):
            raise SystemExit(f"{file}: set {name} is generated, and wants lines of first, last and a step of at least 1")
        return [k for first, last, step, *_ in ranges for k in range(first, last + 1, step)], []
    words = [word for row in rows for word in row]
    return [int(word) for word in words if word.isdigit()], [word.strip('"') for word in words if not word.isdigit()]


def gathered(sets, block, key, known, file):
    """Adds what a *NSET or *ELSET lists."""
    name = block["parameters"].get(key, "")
    own, others = numbers(name, block, file)
    for other in others:
        if other not in sets:
            raise SystemExit(f"{file}: set {name} names a set {other} that is not before it")
        own = own + sets[other]
    sets.setdefault(name, []).extend(k for k in own if k in known)


def read(file):
    """The mesh of a file, with cell_sets and point_sets."""
    nodes, elements, node_sets, element_sets = {}, {}, {}, {}
    for block in blocks(file):
        key, parameters = block["key"], block["parameters"]
        if key == "INSTANCE" and "PART" in parameters or key == "SYSTEM":
            raise SystemExit(
                f"{file}: holds *{key}; only flat files are read: in Abaqus/CAE, choose `Do not use parts and assemblies in input "
                "files` among the attributes of the model, and write the job again"
            )
        if key == "NODE":
            rows = [[word for word in line.split(",") if word.strip()] for line in block["lines"]]
            nodes.update({int(row[0]): [float(x) for x in row[1:4]] + [0.0] * (4 - len(row)) for row in rows})
            if "NSET" in parameters:
                node_sets.setdefault(parameters["NSET"], []).extend(int(row[0]) for row in rows)
        elif key == "ELEMENT":
            kind, count = shape(parameters.get("TYPE", "").upper(), file)
            words = [int(word) for line in block["lines"] for word in line.split(",") if word.strip()]
            if len(words) % (count + 1):
                raise SystemExit(f"{file}: elements {parameters['TYPE']} want {count} nodes each")
            rows = [words[at:at + count + 1] for at in range(0, len(words), count + 1)]
            elements.update({row[0]: (kind, row[1:]) for row in rows})
            if "ELSET" in parameters:
                element_sets.setdefault(parameters["ELSET"], []).extend(row[0] for row in rows)
        elif key == "NSET":
            gathered(node_sets, block, "NSET", nodes, file)
        elif key == "ELSET":
            gathered(element_sets, block, "ELSET", elements, file)
    return assembled(file, nodes, elements, node_sets, element_sets)


def assembled(file, nodes, elements, node_sets, element_sets):
    """A meshio mesh of what was read, one block of cells for each kind of element."""
    at_node = {tag: at for at, tag in enumerate(nodes)}
    lost = next((node for _, own in elements.values() for node in own if node not in at_node), None)
    if lost is not None:
        raise SystemExit(f"{file}: an element names node {lost}, which is not among the *NODE")
    kinds = list(dict.fromkeys(kind for kind, _ in elements.values()))
    of_kind = {kind: [tag for tag, (own, _) in elements.items() if own == kind] for kind in kinds}
    cells = [(kind, np.array([[at_node[node] for node in elements[tag][1]] for tag in of_kind[kind]])) for kind in kinds]
    place = {tag: (block, at) for block, kind in enumerate(kinds) for at, tag in enumerate(of_kind[kind])}
    cell_sets = {
        name: [np.array(sorted({place[tag][1] for tag in own if place[tag][0] == block}), dtype=int) for block in range(len(kinds))]
        for name, own in element_sets.items()
    }
    point_sets = {name: np.array(sorted({at_node[tag] for tag in own}), dtype=int) for name, own in node_sets.items()}
    points = np.array(list(nodes.values())).reshape(-1, 3)
    return meshio.Mesh(points, cells, point_sets=point_sets, cell_sets=cell_sets)

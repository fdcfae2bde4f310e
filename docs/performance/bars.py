"""Fine meshes as they come from a file: the two bars of cases/bars_inclined, cut into irregular triangles in any order."""

import random

NAMES = [(1, "bottom"), (1, "left"), (1, "top"), (1, "lower.seam"), (1, "upper.seam"), (2, "lower"), (2, "upper")]
TAGS = {name: tag + 1 for tag, (_, name) in enumerate(NAMES)}
# The sides of each bar, counterclockwise from below, and the place of its seam.
SIDES = [["bottom", None, "lower.seam", "left"], ["upper.seam", None, "top", "left"]]
# How far a vertex inside a bar is moved, in edges.
MOVED = 0.25


def seam(x):
    """The height of the line between the bars."""
    return 3 + x / 6


def bar(columns, low, high, chance):
    """Points, triangles and the edges of each side of a bar of columns x columns/2 cells between two heights; all inner points
    are moved by chance, and numbers have no order."""
    rows = columns // 2
    moved = lambda inner: chance.uniform(-MOVED, MOVED) if inner else 0.0
    points = []
    for j in range(rows + 1):
        for i in range(columns + 1):
            inner = 0 < i < columns and 0 < j < rows
            x, t = 6 * (i + moved(inner)) / columns, (j + moved(inner)) / rows
            points.append((x, low(x) * (1 - t) + high(x) * t))
    number = list(range(len(points)))
    chance.shuffle(number)
    at = lambda i, j: number[j * (columns + 1) + i]
    triangles = []
    for j in range(rows):
        for i in range(columns):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            triangles += [(a, b, c), (a, c, d)] if chance.random() < 0.5 else [(a, b, d), (b, c, d)]
    chance.shuffle(triangles)
    sides = [
        [(at(i, 0), at(i + 1, 0)) for i in range(columns)],
        [(at(columns, j), at(columns, j + 1)) for j in range(rows)],
        [(at(i + 1, rows), at(i, rows)) for i in range(columns)],
        [(at(0, j + 1), at(0, j)) for j in range(rows)],
    ]
    placed = [None] * len(points)
    for at, point in zip(number, points):
        placed[at] = point
    return placed, triangles, sides


def write(path, columns):
    """Writes both bars as Gmsh 4.1 text, some 2 columns² triangles; what is there already is kept."""
    if path.exists():
        return
    chance = random.Random(1)
    bars = [bar(columns, lambda x: 0.0, seam, chance), bar(columns - 2, seam, lambda x: 6.0, chance)]
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(NAMES))]
    lines += [f'{dimension} {TAGS[name]} "{name}"' for dimension, name in NAMES] + ["$EndPhysicalNames", "$Entities", "0 8 2 0"]
    for k, names in enumerate(SIDES):
        lines += [f"{4 * k + s + 1} 0 0 0 0 0 0 {f'1 {TAGS[name]}' if name else '0'} 0" for s, name in enumerate(names)]
    lines += [f"{k + 1} 0 0 0 0 0 0 1 {TAGS[name]} 0" for k, name in enumerate(["lower", "upper"])] + ["$EndEntities"]
    count = sum(len(points) for points, _, _ in bars)
    lines += ["$Nodes", f"2 {count} 1 {count}"]
    first = [1, 1 + len(bars[0][0])]
    for k, (points, _, _) in enumerate(bars):
        lines.append(f"2 {k + 1} 0 {len(points)}")
        lines += [str(first[k] + at) for at in range(len(points))]
        lines += [f"{x!r} {y!r} 0" for x, y in points]
    blocks = [(1, 4 * k + s + 1, 1, edges) for k in range(2) for s, edges in enumerate(bars[k][2])]
    blocks += [(2, k + 1, 2, triangles) for k, (_, triangles, _) in enumerate(bars)]
    count = sum(len(cells) for *_, cells in blocks)
    lines += ["$EndNodes", "$Elements", f"{len(blocks)} {count} 1 {count}"]
    element = 1
    for dimension, entity, kind, cells in blocks:
        lines.append(f"{dimension} {entity} {kind} {len(cells)}")
        start = first[(entity - 1) // 4 if dimension == 1 else entity - 1]
        for cell in cells:
            lines.append(" ".join(str(number) for number in [element, *(start + point for point in cell)]))
            element += 1
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(".partial")
    partial.write_text("\n".join(lines + ["$EndElements"]) + "\n")
    partial.replace(path)

"""Meshes and cases of the page of scaling: two bars of triangles, one on the other."""

CASE = """title = "{title}"

[mesh]
file   = "{mesh}"
order  = {order}
refine = {refine}

[body.lower]
young   = 7000.0
poisson = 0.227

[body.upper]
young   = 7000.0
poisson = 0.3

[support.table]
on = "bottom"
uy = 0.0

[support.wall]
on = "left"
ux = 0.0

[load.top]
on       = "top"
pressure = "1 + 0.3 * cos(0.7 * x)"

[contact.seam]
between    = ["lower.seam", "upper.seam"]
curve      = "line"
gap        = "closed"
multiplier = "{multiplier}"
segments   = {segments}

[solver]
inf_sup = false

[output]
fields = false
"""

NAMES = [(1, "bottom"), (1, "right"), (1, "lower.seam"), (1, "left"), (1, "upper.seam"), (1, "top"), (2, "lower"), (2, "upper")]


def grid(columns, rows, low, high, length):
    """Points and triangles of columns x rows cells, and the edges of its bottom, right, top and left side, by point numbers."""
    points = [(length * i / columns, low + (high - low) * j / rows) for j in range(rows + 1) for i in range(columns + 1)]
    at = lambda i, j: j * (columns + 1) + i
    triangles = []
    for j in range(rows):
        for i in range(columns):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            triangles += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    sides = [
        [(at(i, 0), at(i + 1, 0)) for i in range(columns)],
        [(at(columns, j), at(columns, j + 1)) for j in range(rows)],
        [(at(i + 1, rows), at(i, rows)) for i in range(columns)],
        [(at(0, j + 1), at(0, j)) for j in range(rows)],
    ]
    return points, triangles, sides


def write_bars(path, columns, rows, length=None):
    """Writes two bars of columns x rows cells each, the upper one with one column less, as Gmsh 4.1 text; `length` is their
    length (columns by default), a row is 1 high."""
    length = length or columns
    bars = [grid(columns, rows, 0.0, rows, length), grid(columns - 1, rows, rows, 2 * rows, length)]
    curves = [["bottom", "right", "lower.seam", "left"], ["upper.seam", "right", "top", "left"]]
    tag = {name: k + 1 for k, name in enumerate(name for dimension, name in NAMES if dimension == 1)}
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(NAMES))]
    lines += [f'1 {tag[name]} "{name}"' for dimension, name in NAMES if dimension == 1]
    lines += ['2 1 "lower"', '2 2 "upper"', "$EndPhysicalNames", "$Entities", "0 8 2 0"]
    lines += [f"{1 + 4 * k + side} 0 0 0 0 0 0 1 {tag[name]} 0" for k in range(2) for side, name in enumerate(curves[k])]
    lines += [f"{k + 1} 0 0 0 0 0 0 1 {k + 1} 0" for k in range(2)]
    count = sum(len(points) for points, _, _ in bars)
    lines += ["$EndEntities", "$Nodes", f"2 {count} 1 {count}"]
    first, start = [], 1
    for k, (points, _, _) in enumerate(bars):
        first.append(start)
        lines.append(f"2 {k + 1} 0 {len(points)}")
        lines += [str(start + at) for at in range(len(points))]
        lines += [f"{x!r} {y!r} 0" for x, y in points]
        start += len(points)
    count = sum(len(triangles) + sum(map(len, sides)) for _, triangles, sides in bars)
    lines += ["$EndNodes", "$Elements", f"10 {count} 1 {count}"]
    element = 1
    for k, (_, triangles, sides) in enumerate(bars):
        for entity, kind, cells in [(1 + 4 * k + side, (1, 1), edges) for side, edges in enumerate(sides)] + [(k + 1, (2, 2), triangles)]:
            lines.append(f"{kind[0]} {entity} {kind[1]} {len(cells)}")
            for cell in cells:
                lines.append(" ".join(str(number) for number in [element, *(first[k] + point for point in cell)]))
                element += 1
    path.write_text("\n".join(lines + ["$EndElements"]) + "\n")


def write_case(folder, name, columns, rows, refine, order=1, segments='"auto"', length=None):
    """A folder with a case and its mesh; the case file. What is there already is kept."""
    folder = folder / "cases" / name
    folder.mkdir(parents=True, exist_ok=True)
    if not (folder / "bars.msh").exists():
        write_bars(folder / "bars.msh", columns, rows, length)
    multiplier = "p0" if order == 1 else "p1-discontinuous"
    values = {"mesh": "bars.msh", "order": order, "refine": refine, "multiplier": multiplier, "segments": segments}
    (folder / "case.toml").write_text(CASE.format(title=f"Two bars: {name}", **values))
    return folder / "case.toml"

"""Discs that lie on each other, as meshes for mezha: python3 packing.py KIND FILE.msh, in Gmsh's format 4.1, ASCII.

KIND is WIDTHxROWS for rows of WIDTH and WIDTH - 1 discs of radius 1 in turn, in a box as wide as the longer ones; pyramid for
rows of 4, 3, 2 and 1; groove for unequal discs, each on two supports. The groove's forces, by statics, go to standard output.
"""
import math
import sys

ROOT = math.sqrt(3)


def rows(width, count, shorter):
    """Centres of discs of radius 1 in rows; row `k` has `shorter(k)` discs less than the first."""
    return [(1 + 2 * k + shorter(row), 1 + ROOT * row, 1.0) for row in range(count) for k in range(width - shorter(row))]


def turned(radius, angle):
    return radius * math.cos(angle), radius * math.sin(angle)


WALLS = ((0.0, math.radians(125)), (0.0, math.radians(50)))  # the groove: from the origin, along these angles
RADII = (1.0, 0.7, 1.3, 0.8, 1.1, 0.9, 1.2)


def inward(wall):
    """The normal of a wall of the groove, towards the discs."""
    angle = WALLS[wall][1]
    return (math.sin(angle), -math.cos(angle)) if wall == 0 else (-math.sin(angle), math.cos(angle))


def on_two(radius, discs, pair):
    """Centres of a disc that touches two of: walls, which are "left" and "right", and discs."""
    walls = [support for support in pair if isinstance(support, str)]
    curves = [inward(("left", "right").index(wall)) for wall in walls]
    round_ones = [discs[support] for support in pair if not isinstance(support, str)]
    if len(curves) == 2:  # n·x = radius on both
        (a, b), (c, d) = curves
        det = a * d - b * c
        return [((d - b) * radius / det, (a - c) * radius / det)]
    if len(curves) == 1:  # along the wall, until the disc is reached
        (nx, ny), (x, y, r) = curves[0], round_ones[0]
        away = radius - (nx * x + ny * y)
        rest = (radius + r) ** 2 - away**2
        return [] if rest < 0 else [(x + away * nx - s * ny, y + away * ny + s * nx) for s in (math.sqrt(rest), -math.sqrt(rest))]
    (x1, y1, r1), (x2, y2, r2) = round_ones
    distance = math.dist((x1, y1), (x2, y2))
    a, b = r1 + radius, r2 + radius
    if distance > a + b:
        return []
    along = (distance**2 + a * a - b * b) / (2 * distance)
    ex, ey = (x2 - x1) / distance, (y2 - y1) / distance
    return [(x1 + along * ex - s * ey, y1 + along * ey + s * ex) for s in (1, -1) for s in (s * math.sqrt(max(a * a - along**2, 0)),)]


def towards(support, disc, discs):
    """The direction in which a support pushes a disc."""
    if isinstance(support, str):
        return inward(("left", "right").index(support))
    x, y, r = discs[support]
    return (disc[0] - x) / (disc[2] + r), (disc[1] - y) / (disc[2] + r)


def shares(a, b, force):
    """The two forces along `a` and `b` that balance a force."""
    det = a[0] * b[1] - a[1] * b[0]
    return -(force[0] * b[1] - force[1] * b[0]) / det, -(a[0] * force[1] - a[1] * force[0]) / det


def groove():
    """Discs dropped one after the other, each to the lowest place where two supports hold it; and its supports."""
    discs, supports = [], []
    for radius in RADII:
        known, best = ["left", "right", *range(len(discs))], None
        for pair in [(p, q) for k, p in enumerate(known) for q in known[k + 1 :]]:
            for x, y in on_two(radius, discs, pair):
                disc = (x, y, radius)
                is_free = all(math.dist(disc[:2], other[:2]) > radius + other[2] - 1e-9 for other in discs)
                is_free = is_free and all(n[0] * x + n[1] * y > radius - 1e-9 for n in map(inward, (0, 1)))
                directions = [towards(support, disc, discs) for support in pair]
                if is_free and min(shares(*directions, (0, -1))) > 0.05 and (best is None or y < best[0][1]):
                    best = disc, pair
        discs.append(best[0])
        supports.append(best[1])
    return discs, supports


def statics(discs, supports, weight=9.81):
    """The force on each support: from the last disc, which carries nothing but itself, down."""
    loads = [[0.0, -weight * math.pi * radius**2] for *_, radius in discs]
    found = {}
    for k in reversed(range(len(discs))):
        directions = [towards(support, discs[k], discs) for support in supports[k]]
        for support, direction, force in zip(supports[k], directions, shares(*directions, loads[k])):
            found[k, support] = force
            if not isinstance(support, str):
                loads[support][0] -= force * direction[0]
                loads[support][1] -= force * direction[1]
    return found


def disc_mesh(turn, rings=2):
    """The unit disc in rings of 6, 12, ... triangles' edges: nodes of second order, triangles, and edges of the rim."""
    nodes, first = [(0.0, 0.0)], [0]
    for ring in range(1, rings + 1):
        first.append(len(nodes))
        nodes += [turned(ring / rings, turn + 2 * math.pi * k / (6 * ring)) for k in range(6 * ring)]
    at = lambda ring, k: first[ring] + k % max(6 * ring, 1)
    triangles = []
    for ring in range(1, rings + 1):
        for side in range(6):
            for k in range(ring):
                outer, inner = side * ring + k, side * (ring - 1) + k
                triangles.append((at(ring, outer), at(ring, outer + 1), at(ring - 1, inner)))
                if k + 1 < ring:
                    triangles.append((at(ring, outer + 1), at(ring - 1, inner + 1), at(ring - 1, inner)))
    middles = {}

    def middle(a, b):
        if (key := frozenset((a, b))) not in middles:
            x, y = ((nodes[a][c] + nodes[b][c]) / 2 for c in (0, 1))
            stretch = 1 / math.hypot(x, y) if min(a, b) >= first[rings] and abs(math.dist(nodes[a], nodes[b]) - 2 * math.sin(math.pi / 6 / rings)) < 1e-9 else 1
            middles[key] = len(nodes)
            nodes.append((stretch * x, stretch * y))
        return middles[key]

    triangles = [(a, b, c, middle(a, b), middle(b, c), middle(c, a)) for a, b, c in triangles]
    rim = [(at(rings, k), at(rings, k + 1)) for k in range(6 * rings)]
    return nodes, triangles, [(a, b, middle(a, b)) for a, b in rim]


def write(path, discs):
    """Body disc001 with the boundary disc001.rim, and so on. No two meshes are turned alike, so that no edges match."""
    digits = max(len(str(len(discs))), 2)
    names = [f"disc{k + 1:0{digits}}" for k in range(len(discs))]
    meshes = [disc_mesh(2.399963 * k) for k in range(len(discs))]
    each, count = len(meshes[0][0]), len(discs)
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", str(2 * count)]
    lines += [f'1 {k} "{name}.rim"' for k, name in enumerate(names, 1)] + [f'2 {k} "{name}"' for k, name in enumerate(names, 1)]
    lines += ["$EndPhysicalNames", "$Entities", f"0 {count} {count} 0"]
    lines += [f"{k} 0 0 0 0 0 0 1 {k} 0" for _ in range(2) for k in range(1, count + 1)]
    lines += ["$EndEntities", "$Nodes", f"{count} {count * each} 1 {count * each}"]
    for k, ((x, y, radius), (nodes, _, _)) in enumerate(zip(discs, meshes)):
        lines += [f"2 {k + 1} 0 {each}"] + [str(k * each + i + 1) for i in range(each)]
        lines += [f"{x + radius * u:.14g} {y + radius * v:.14g} 0" for u, v in nodes]
    per = len(meshes[0][1]) + len(meshes[0][2])
    lines += ["$EndNodes", "$Elements", f"{2 * count} {count * per} 1 {count * per}"]
    tag = 0
    for dimension, kind, part in ((1, 8, 2), (2, 9, 1)):
        for k, own in enumerate(meshes):
            lines.append(f"{dimension} {k + 1} {kind} {len(own[part])}")
            for element in own[part]:
                tag += 1
                lines.append(" ".join(map(str, [tag] + [k * each + i + 1 for i in element])))
    with open(path, "w") as file:
        file.write("\n".join(lines + ["$EndElements", ""]))


def main(kind, path):
    if kind == "groove":
        discs, supports = groove()
        for (k, support), force in sorted(statics(discs, supports).items(), key=str):
            print(f"disc{k + 1:02} on {support if isinstance(support, str) else f'disc{support + 1:02}'}: {force:.9f}")
    elif kind == "pyramid":
        discs = rows(4, 4, lambda row: row)
    else:
        width, count = map(int, kind.split("x"))
        discs = rows(width, count, lambda row: row % 2)
    write(path, discs)


if __name__ == "__main__":
    main(*sys.argv[1:])

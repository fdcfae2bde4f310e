"""Mirrors a mesh of Gmsh (4.1, ASCII) at the x axis, the y axis, or both, and joins it along them.

    python3 mirror.py QUARTER.msh WHOLE.msh xy

Points on an axis are taken once, and mirrored coordinates differ from the others in their sign only: a symmetric scene has
the same discrete solution on a part and on the whole. Physical curves of which all points lie on a mirrored axis are left out:
they are inside the bodies now.
"""
import sys


def read(path):
    """Names of the physical groups, points, and elements as (dimension, entity, points)."""
    blocks, words = {}, open(path).read().split("\n")
    while words:
        head = words.pop(0)
        if head.startswith("$"):
            end = words.index("$End" + head[1:])
            blocks[head[1:]], words = words[:end], words[end + 1 :]
    names = {tuple(map(int, line.split()[:2])): line.split('"')[1] for line in blocks["PhysicalNames"][1:]}
    groups, lines = {}, iter(blocks["Entities"])
    for dimension, count in enumerate(map(int, next(lines).split()[:3])):
        for _ in range(count):
            values = next(lines).split()
            first = 4 if dimension == 0 else 7
            groups[dimension, int(values[0])] = [int(tag) for tag in values[first + 1 : first + 1 + int(values[first])]]
    points, lines = {}, iter(blocks["Nodes"][1:])
    for line in lines:
        tags = [int(next(lines)) for _ in range(int(line.split()[3]))]
        points.update({tag: tuple(map(float, next(lines).split()[:2])) for tag in tags})
    elements, lines = [], iter(blocks["Elements"][1:])
    for line in lines:
        dimension, entity, _, count = map(int, line.split())
        for _ in range(count):
            tags = list(map(int, next(lines).split()[1:]))
            elements += [(dimension, group, tags) for group in groups[dimension, entity] if dimension > 0]
    return names, points, elements


def mirrored(points, elements, axis):
    """The same joined with its image at an axis: 0 is x = 0, 1 is y = 0."""
    lies_on = lambda tag: points[tag][axis] == 0.0
    step = max(points)
    image = {tag: tag if lies_on(tag) else tag + step for tag in points}
    turned = lambda x: (-x[0], x[1]) if axis == 0 else (x[0], -x[1])
    kept = [element for element in elements if element[0] == 2 or not all(map(lies_on, element[2]))]
    all_points = {**points, **{image[tag]: turned(x) for tag, x in points.items() if not lies_on(tag)}}
    return all_points, kept + [(d, group, [image[tag] for tag in tags[::-1]]) for d, group, tags in kept]


def write(path, names, points, elements):
    """One entity for each physical group."""
    used = sorted({(dimension, group) for dimension, group, _ in elements})
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(used))]
    lines += [f'{d} {group} "{names[d, group]}"' for d, group in used] + ["$EndPhysicalNames", "$Entities"]
    lines.append("0 %d %d 0" % tuple(sum(d == k for d, _ in used) for k in (1, 2)))
    lines += [f"{group} -1 -1 0 1 1 0 1 {group} 0" for _, group in used] + ["$EndEntities", "$Nodes"]
    number = {tag: k + 1 for k, tag in enumerate(sorted(points))}
    lines += [f"1 {len(points)} 1 {len(points)}", f"2 {used[-1][1]} 0 {len(points)}"]
    lines += [str(k) for k in sorted(number.values())]
    lines += ["%r %r 0" % points[tag] for tag in sorted(points)] + ["$EndNodes", "$Elements"]
    lines.append(f"{len(used)} {len(elements)} 1 {len(elements)}")
    count = 0
    for d, group in used:
        own = [tags for e, other, tags in elements if (e, other) == (d, group)]
        lines.append(f"{d} {group} {d} {len(own)}")
        for tags in own:
            count += 1
            lines.append(" ".join(map(str, [count] + [number[tag] for tag in tags])))
    open(path, "w").write("\n".join(lines + ["$EndElements", ""]))


source, target, axes = sys.argv[1:]
names, points, elements = read(source)
# What rounding has left of an axis.
points = {tag: tuple(0.0 if abs(value) < 1e-14 else value for value in x) for tag, x in points.items()}
for axis in axes:
    points, elements = mirrored(points, elements, "xy".index(axis))
write(target, names, points, elements)

"""The expected values of the assemblies in `cases`: python3 scenes.py NAME [DIV ...], see README.md."""
import math
import sys
import time

import numpy as np
from programme import Arc, Body, Line, Scene, half_width, mesh, peak

STEEL = 2.1e5
POISSON = 0.3


def disc(radius, hole=0.0):
    def draw(occ):
        outer = occ.addDisk(0, 0, 0, radius, radius)
        if hole:
            occ.cut([(2, outer)], [(2, occ.addDisk(0, 0, 0, hole, hole))])

    return draw


def box(x, y):
    return lambda occ: occ.addRectangle(x[0], y[0], 0, x[1] - x[0], y[1] - y[0])


def centre(cuts, pressure):
    """The place on which a contact's force acts."""
    return np.average((cuts[1:] + cuts[:-1]) / 2, weights=np.diff(cuts) * np.maximum(pressure, 1e-300))


class Case:
    """Bodies (drawn about their centres), and contacts at points, from which scenes of any fineness are made."""

    def __init__(self):
        self.kinds, self.bodies, self.contacts = {}, [], []
        self.push, self.pressed = {}, {}  # forces on rigid hubs by kind, on rigid tools by contact

    def kind(self, name, draw, size, young=STEEL, **more):
        self.kinds[name] = draw, size, young, more

    def body(self, kind, centre=(0.0, 0.0), **more):
        self.bodies.append((kind, np.array(centre, float), more))
        return len(self.bodies) - 1

    def contact(self, name, pair, point, normal, radii):
        """`radii` of both sides; infinite is a plane, negative hollow."""
        self.contacts.append((name, pair, np.array(point, float), np.array(normal, float), radii))

    def stiffness(self, pair):
        soft = sum((1 - POISSON**2) / self.kinds[self.bodies[k][0]][2] for k in pair if k is not None)
        return 1 / soft

    def scene(self, before=None, div=0, least=2e-3):
        """With what a scene before has found: edges and segments of b/div, over 1.5 b on each side of where it presses."""
        forces = {name: force for name, (force, *_) in before.items()} if before else {}
        widths, spots = {}, {name: {} for name in self.kinds}
        top = max(forces.values(), default=0)
        middles = {name: centre(*before[name][1:]) if before and force > least * top else 0.0 for name, force in forces.items()}
        for name, pair, point, normal, radii in self.contacts:
            if forces:
                width = half_width(max(forces[name], least * top), sum(1 / r for r in radii), self.stiffness(pair))
            else:
                width = 0.25 * min([abs(r) for r in radii if math.isfinite(r)])
            widths[name] = width
            for k in pair:
                if k is not None and forces:
                    kind, origin, _ = self.bodies[k]
                    at = tuple(np.round(point - origin + middles[name] * np.array([-normal[1], normal[0]]), 9) + 0.0)
                    spots[kind][at] = min(spots[kind].get(at, np.inf), width / div)
        made = {}
        for name, (draw, size, young, more) in self.kinds.items():
            parts = mesh(draw, size, [(x, y, h) for (x, y), h in spots[name].items()])
            made[name] = Body(parts, young, POISSON, **more)
        for name, force in self.push.items():
            held = np.setdiff1d(np.arange(len(made[name].load)), made[name].free)
            made[name].load[held[:2]] += force
        scene = Scene()
        scene.pressed = self.pressed
        for kind, origin, more in self.bodies:
            scene.add(made[kind], origin, **more)
        for name, pair, point, normal, radii in self.contacts:
            width = 1.5 * widths[name] if forces else widths[name]
            count = 3 * div if forces else 8
            depth = lambda r, s: r - math.copysign(1, r) * np.sqrt(r * r - s * s) if math.isfinite(r) else 0 * s
            gap = lambda s, radii=radii: sum(depth(r, s) for r in radii)
            finite = [abs(r) for r in radii if math.isfinite(r)]
            scene.contact(name, pair, Line(point, normal, 0.5 * min(finite)), middles.get(name, 0.0) + np.linspace(-width, width, count + 1), gap)
        return scene


def roller(rollers=(0.0,), half=10.0, pressure=50.0):
    """Rollers of radius 5 between two plates."""
    case = Case()
    case.kind("bottom", box((-half, half), (-5, 5)), 2.5, clamp=lambda x: x[:, 1] < -5 + 1e-9, floats=False)
    case.kind("top", box((-half, half), (-5, 5)), 2.5, pressure=(lambda x: x[:, 1] > 5 - 1e-9, pressure))
    case.kind("roller", disc(5), 2.0)
    bottom, top = case.body("bottom", (0, -5)), case.body("top", (0, 15), held=(0,))
    for k, x in enumerate(rollers, 1):
        own = case.body("roller", (x, 5), held=(0, 2))
        case.contact(f"lower{k}", (bottom, own), (x, 0), (0, 1), (math.inf, 5))
        case.contact(f"upper{k}", (own, top), (x, 10), (0, 1), (5, math.inf))
    return case


def four_rollers():
    return roller((-18, -6, 6, 18), 24.0)


def bending(force=200.0):
    """A beam 100 x 10 on two rigid rollers, and a third one presses in the middle; the beam is the body of force here."""
    case = Case()
    case.kind("beam", box((-50, 50), (-5, 5)), 1.0)
    beam = case.body("beam", held=(0,))
    case.contact("left", (None, beam), (-40, -5), (0, 1), (5, math.inf))
    case.contact("right", (None, beam), (40, -5), (0, 1), (5, math.inf))
    case.contact("middle", (beam, None), (0, 5), (0, 1), (math.inf, 5))
    case.pressed = {"middle": force}
    return case


def bearing(count=12, force=1000.0):
    case = Case()
    case.kind("inner", disc(30, 20), 3.0, clamp=lambda x: np.hypot(*x.T) < 20 + 1e-6)
    case.kind("outer", disc(50, 40), 3.0, clamp=lambda x: np.hypot(*x.T) > 50 - 1e-6, floats=False)
    case.kind("roller", disc(5), 2.0)
    inner, outer = case.body("inner", held=(2,)), case.body("outer")
    case.push = {"inner": (0.0, -force)}
    for k in range(count):
        angle = -math.pi / 2 + 2 * math.pi * k / count
        away = np.array([math.cos(angle), math.sin(angle)])
        own = case.body("roller", 35 * away, along=away, held=(1, 2))
        case.contact(f"inner{k:02d}", (inner, own), 30 * away, away, (30, 5))
        case.contact(f"outer{k:02d}", (own, outer), 40 * away, away, (5, -40))
    return case


def discs_in_box(centres, walls, weight=9.81):
    """Discs of radius 1 under their own weight; `walls` are (name, point, outward normal) of rigid lines."""
    case = Case()
    case.kind("disc", disc(1), 0.35, young=1e5, force=(0.0, -weight))
    for centre in centres:
        case.body("disc", centre, held=(2,))
    for i, a in enumerate(centres):
        for j in range(i + 1, len(centres)):
            away = np.subtract(centres[j], a)
            if np.linalg.norm(away) < 2 + 1e-9:
                case.contact(f"disc{i + 1}-disc{j + 1}", (i, j), np.add(a, away / 2), away / 2, (1, 1))
        for name, point, normal in walls:
            if abs((np.array(point) - a) @ normal - 1) < 1e-9:
                case.contact(f"{name}-disc{i + 1}", (i, None), np.add(a, normal), np.array(normal, float), (1, math.inf))
    return case


def hexagonal(width, rows):
    root = math.sqrt(3)
    centres = [(1 + 2 * k + row % 2, 1 + root * row) for row in range(rows) for k in range(width - row % 2)]
    return discs_in_box(centres, [("floor", (0, 0), (0, -1)), ("left", (0, 0), (-1, 0)), ("right", (2 * width, 0), (1, 0))])


def pyramid(width=4):
    root = math.sqrt(3)
    centres = [(1 + 2 * k + row, 1 + root * row) for row in range(width) for k in range(width - row)]
    return discs_in_box(centres, [("floor", (0, 0), (0, -1)), ("left", (0, 0), (-1, 0)), ("right", (2 * width, 0), (1, 0))])


def wheels(force=(200.0, -1000.0)):
    """A wheel of radius 4 on two of radius 6, all with rigid hubs of radius 2."""
    case = Case()
    clamp = lambda x: np.hypot(*x.T) < 2 + 1e-6
    case.kind("lower", disc(6, 2), 2.0, clamp=clamp, floats=False)
    case.kind("upper", disc(4, 2), 1.5, clamp=clamp)
    centre = np.array([0, math.sqrt(100 - 49)])
    left, right, upper = case.body("lower", (-7, 0)), case.body("lower", (7, 0)), case.body("upper", centre, held=(2,))
    case.push = {"upper": force}
    for name, own, x in (("left", left, -7), ("right", right, 7)):
        away = (centre - (x, 0)) / 10
        case.contact(name, (own, upper), np.array([x, 0]) + 6 * away, away, (6, 4))
    return case


def link_outline(socket=True, head=True):
    """A link of the chain about its own origin: a block with a dovetail on its left, and a neck with a round head on its right."""

    def draw(occ):
        tags = [(2, occ.addRectangle(0, -11, 0, 20, 22))]
        if head:
            neck, ball = occ.addRectangle(19, -1.5, 0, 9, 3), occ.addDisk(24 + 2 - 2.5 + math.sqrt(50), 0, 0, 5, 5)
            tags = occ.fuse(tags, [(2, neck), (2, ball)])[0]
        if socket:
            corners = [(-1, 2.5), (2, 2.5), (5.5, 6), (13, 6), (13, -6), (5.5, -6), (2, -2.5), (-1, -2.5)]
            points = [occ.addPoint(x, y, 0) for x, y in corners]
            lines = [occ.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]
            hole = occ.addPlaneSurface([occ.addCurveLoop(lines)])
            occ.cut(tags, [(2, hole)])

    return draw


def chain(force=200.0):
    """Five links; the first one is held at its left, the last one pulled at its right."""
    case = Case()
    case.kind("first", link_outline(socket=False), 2.5, clamp=lambda x: x[:, 0] < 1e-9, floats=False)
    case.kind("link", link_outline(), 2.5)
    case.kind("last", link_outline(head=False), 2.5, pressure=(lambda x: x[:, 0] > 20 - 1e-9, -force / 22))
    for k in range(5):
        case.body("first" if k == 0 else "last" if k == 4 else "link", (24 * k, 0), held=() if k == 0 else (2,))
    root = math.sqrt(0.5)
    for k in range(4):
        centre = np.array([24 * (k + 1) + 2 - 2.5 + math.sqrt(50), 0])
        for side, sign in (("upper", 1), ("lower", -1)):
            away = np.array([-root, sign * root])
            case.contact(f"{side}{k + 1}", (k, k + 1), centre + 5 * away, away, (5, math.inf))
    return case


def lug(edge, force=4000.0, clearance=0.02):
    """A pin in a hole of radius 10, pulled upwards: contact around the arc. Prints λ at 0, 10, ... degrees from the top."""
    hole, pin = 10.0, 10.0 - clearance
    near = f"{edge}+.3*Max(0, Abs(Sqrt(x^2+y^2)-{hole})-{4 * edge})"

    def draw(occ):
        whole = occ.fuse([(2, occ.addDisk(0, 0, 0, 25, 25))], [(2, occ.addRectangle(-25, -75, 0, 50, 75))])[0]
        occ.cut(whole, [(2, occ.addDisk(0, 0, 0, hole, hole))])

    plate = Body(mesh(draw, 4.0, [], near), STEEL, POISSON, clamp=lambda x: x[:, 1] < -75 + 1e-9, floats=False)
    parts = mesh(disc(pin), 2.0, [], near)
    area = math.pi * pin**2
    scene = Scene()
    scene.add(Body(parts, STEEL, POISSON, force=(0, force / area)), held=(0, 2))
    scene.add(plate)
    half = math.radians(100) * hole
    cuts = np.linspace(-half, half, 2 * round(half / edge) + 1)
    scene.contact("seam", (0, 1), Arc((0, 0), hole, math.pi / 2, 0.5), cuts, lambda s: clearance + 0 * s)
    found, energy = scene.solve()
    total, cuts, pressure = found["seam"]
    middle = (cuts[1:] + cuts[:-1]) / 2
    closed = middle[pressure > 1e-6 * pressure.max()]
    at = [np.interp(math.radians(angle) * hole, middle, pressure) for angle in range(0, 60, 10)]
    print(f"edge {edge}: {scene.status}, force {total:.4f}, energy {energy:.6f}, half angle {math.degrees(closed.max() / hole):.2f}", np.round(at, 3), flush=True)


def persson(force=4000.0, clearance=0.02, hole=10.0, young=STEEL):
    """Persson's closed form for an infinite plate: half angle, λ at 0, 10, ... degrees."""
    stiff = young / (1 - POISSON**2)
    wanted = math.pi * stiff * clearance / force
    load = lambda b: (2 - 2 * b**4 - math.log(1 + b * b)) / (b * b * (1 + b * b))
    low, high = 1e-3, 0.999
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if load(middle) > wanted else (low, middle)
    b, at = low, []
    for angle in range(0, 60, 10):
        y = math.tan(math.radians(angle) / 2)
        if y < b:
            root, side = math.sqrt(b * b - y * y), math.sqrt(b * b + 1)
            first = 2 / (math.pi * side) * root / (1 + y * y)
            at.append(force / hole * (first + math.log((side + root) / (side - root)) / (2 * math.pi * b * b * (b * b + 1))))
    print(f"Persson: half angle {math.degrees(2 * math.atan(b)):.2f}", np.round(at, 3))


SCENES = {
    "roller": roller,
    "four_rollers": four_rollers,
    "bending": bending,
    "bearing": bearing,
    "disc": lambda: hexagonal(1, 1),
    "discs3": lambda: hexagonal(2, 2),
    "discs14": lambda: hexagonal(5, 3),
    "discs105": lambda: hexagonal(11, 10),
    "discs1003": lambda: hexagonal(30, 34),
    "pyramid": pyramid,
    "wheels": wheels,
    "chain": chain,
}


def solved(case, divisions):
    """Coarse, then finer: prints each contact, and how much its force has changed."""
    begin = time.time()
    found, energy = case.scene().solve()
    print(f"coarse: {len(found)} contacts, energy {energy:.6e}, {time.time() - begin:.1f} s", flush=True)
    for div in divisions:
        begin = time.time()
        scene = case.scene(found, div)
        last = {name: force for name, (force, *_) in found.items()}
        found, energy = scene.solve()
        change = max(abs(found[name][0] - last[name]) for name in last) / max(last.values())
        print(f"b/{div}: {scene.status}, energy {energy:.8e}, forces changed by {change:.1e} of the largest, {time.time() - begin:.1f} s", flush=True)
    return scene, found, energy


if __name__ == "__main__":
    if sys.argv[1] == "lug":
        for edge in sys.argv[2:] or (0.5, 0.25):
            lug(float(edge))
        persson()
        sys.exit()
    case = SCENES[sys.argv[1]]()
    scene, found, energy = solved(case, [int(div) for div in sys.argv[2:]] or [2, 4, 6])
    top = max(force for force, *_ in found.values())
    for name, pair, point, normal, radii in case.contacts:
        force, cuts, pressure = found[name]
        width = half_width(force, sum(1 / r for r in radii), case.stiffness(pair)) if force > 0 else 0
        high = peak(cuts, pressure) if force > 1e-2 * top else 0
        hertz = f"Hertz: b {width:.5f}, peak {2 * force / math.pi / width:.4f}" if force > 1e-6 * top else ""
        point = point + centre(cuts, pressure) * np.array([-normal[1], normal[0]])
        print(f"{name:16} at ({point[0]:.6f}, {point[1]:.6f}): force {force:.6f}, peak {high:.4f}; {hertz}")

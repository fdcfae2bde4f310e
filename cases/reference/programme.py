"""Elastic bodies in contact without friction, as one convex quadratic programme: by other means than mezha's.

P2 triangles of Gmsh's, λ constant on each of many segments of a tangent (or an arc), the displacements eliminated body by body:

    min 1/2 λᵀ S λ - λᵀ (B K⁺ f - g),   λ >= 0,   Rᵀ (f - Bᵀ λ) = 0 for each rigid motion R that nothing holds

Each scene is solved coarsely first; its forces say how wide each contact is (Hertz), and then on meshes of edges b/div there.
Wants numpy, scipy, gmsh and clarabel of PyPI.
"""
import math

import clarabel
import gmsh
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as spl

GAUSS = np.polynomial.legendre.leggauss(4)


def shapes(r, s):
    """Values and slopes of the six shape functions of P2."""
    t = 1 - r - s
    values = np.array([t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * r * t, 4 * r * s, 4 * s * t])
    slopes = np.array([[1 - 4 * t, 1 - 4 * t], [4 * r - 1, 0], [0, 4 * s - 1], [4 * (t - r), -4 * r], [4 * s, 4 * r], [-4 * s, 4 * (t - s)]])
    return values, slopes


def triangle_points():
    """Six points, exact to degree four, with their weights."""
    for a, w in ((0.445948490915965, 0.223381589678011), (0.091576213509771, 0.109951743655322)):
        for r, s in ((a, a), (1 - 2 * a, a), (a, 1 - 2 * a)):
            yield r, s, w / 2


def mesh(draw, size, spots, formula=None):
    """Nodes, triangles and boundary edges of what `draw(occ)` draws; edges are `h` long at each spot (x, y, h), and as a formula says."""
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    draw(gmsh.model.occ)
    gmsh.model.occ.synchronize()
    for name in ("FromPoints", "FromCurvature", "ExtendFromBoundary"):
        gmsh.option.setNumber("Mesh.MeshSize" + name, 0)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    formulas = [formula] if formula else []
    formulas += [f"{h}+.3*Max(0, Sqrt((x-({x}))^2+(y-({y}))^2)-{8 * h})" for x, y, h in spots]
    fields = [gmsh.model.mesh.field.add("MathEval") for _ in formulas]
    for field, formula in zip(fields, formulas):
        gmsh.model.mesh.field.setString(field, "F", formula)
    if fields:
        least = gmsh.model.mesh.field.add("Min")
        gmsh.model.mesh.field.setNumbers(least, "FieldsList", fields)
        gmsh.model.mesh.field.setAsBackgroundMesh(least)
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2)
    tags, x, _ = gmsh.model.mesh.getNodes()
    number = np.zeros(int(tags.max()) + 1, int)
    number[tags.astype(int)] = np.arange(len(tags))
    nodes = x.reshape(-1, 3)[:, :2]
    triangles, edges = (number[gmsh.model.mesh.getElementsByType(kind)[1].astype(int)] for kind in (9, 8))
    gmsh.finalize()
    triangles, edges = triangles.reshape(-1, 6), edges.reshape(-1, 3)
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    turned = np.cross(b - a, c - a) < 0
    triangles[turned] = triangles[turned][:, [0, 2, 1, 5, 4, 3]]
    return nodes, triangles, edges


class Body:
    """Stiffness and load of one body. `clamp(x)` says where nodes are held; with `floats` they move rigidly, all together."""

    def __init__(self, parts, young=1.0, poisson=0.3, force=(0.0, 0.0), pressure=None, clamp=None, floats=True):
        self.x, self.triangles, self.edges = parts
        count = len(self.x)
        law = young / ((1 + poisson) * (1 - 2 * poisson)) * np.array([[1 - poisson, poisson, 0], [poisson, 1 - poisson, 0], [0, 0, 0.5 - poisson]])
        blocks, self.mass, corners = 0, np.zeros(count), self.x[self.triangles]
        for r, s, w in triangle_points():
            value, slope = shapes(r, s)
            jacobi = np.einsum("eki,kj->eij", corners, slope)
            area = w * np.linalg.det(jacobi)
            d = np.einsum("kj,eji->eki", slope, np.linalg.inv(jacobi))
            strain = np.zeros((len(corners), 3, 12))
            strain[:, 0, 0::2] = strain[:, 2, 1::2] = d[:, :, 0]
            strain[:, 1, 1::2] = strain[:, 2, 0::2] = d[:, :, 1]
            blocks = blocks + np.einsum("eai,ab,ebj->eij", strain, law, strain) * area[:, None, None]
            np.add.at(self.mass, self.triangles.ravel(), np.outer(area, value).ravel())
        dof = np.stack([2 * self.triangles, 2 * self.triangles + 1], -1).reshape(-1, 12)
        place = (np.repeat(dof, 12, 1).ravel(), np.tile(dof, (1, 12)).ravel())
        self.stiffness = sp.csc_matrix((blocks.ravel(), place), shape=(2 * count, 2 * count))
        self.load = np.outer(self.mass, force).ravel()
        if pressure:
            self.press(*pressure)
        self.middle = self.mass @ self.x / self.mass.sum()
        arm = self.x - self.middle
        self.rigid = np.zeros((2 * count, 3))
        self.rigid[0::2, 0] = self.rigid[1::2, 1] = 1
        self.rigid[0::2, 2], self.rigid[1::2, 2] = -arm[:, 1], arm[:, 0]
        held = np.repeat(clamp(self.x), 2) if clamp else np.zeros(2 * count, bool)
        self.clamped, self.floats = bool(held.any()), floats or not held.any()
        if not self.clamped:  # any three that hold it: a generalised inverse
            left, right = np.argmin(self.x[:, 0]), np.argmax(self.x[:, 0])
            held[[2 * left, 2 * left + 1, 2 * right + 1]] = True
        self.free = np.flatnonzero(~held)
        self.factor = None

    def press(self, where, pressure):
        """A pressure on the boundary edges of which all nodes are `where(x)`."""
        for edge in self.edges[where(self.x)[self.edges].all(1)]:
            a, b, m = self.x[edge]
            for t, w in zip(*GAUSS):
                along = (b - a) / 2 + t * (a + b - 2 * m)
                value = np.array([t * (t - 1) / 2, t * (t + 1) / 2, 1 - t * t])
                normal = np.array([along[1], -along[0]])  # edges of Gmsh's run in one direction: outward by the middle
                normal *= np.sign(normal @ (m - self.x.mean(0)))
                self.load.reshape(-1, 2)[edge] -= w * pressure * np.outer(value, normal)

    def solve(self, forces, modes):
        """K⁺ of forces (dofs × columns); the means of the rigid motions `modes` are zero."""
        if self.factor is None:
            self.factor = spl.splu(self.stiffness[self.free][:, self.free])
        project = not self.clamped and modes.shape[1] > 0
        if project:
            weights = np.repeat(self.mass, 2)[:, None]
            means = weights * modes @ np.linalg.inv(modes.T @ (weights * modes))
            forces = forces - means @ (modes.T @ forces)
        u = np.zeros_like(forces)
        u[self.free] = self.factor.solve(np.ascontiguousarray(forces[self.free]))
        return u - modes @ (means.T @ u) if project else u


class Turned:
    """A body at a place of its own, with its shifts along and across a direction; it shares all else with `body`."""

    def __init__(self, body, centre=(0.0, 0.0), along=(1.0, 0.0), held=()):
        self.body, self.centre, self.held = body, np.array(centre, float), list(held)
        x, y = along
        self.turn = np.array([[x, -y, 0], [y, x, 0], [0, 0, 1.0]])


class Line:
    """Γ_C on the tangent at a point: n points from the first body to the second."""

    def __init__(self, point, normal, reach):
        self.point, self.normal, self.reach = np.array(point, float), np.array(normal, float), reach
        self.along = np.array([-self.normal[1], self.normal[0]])

    def places(self, x):
        """Arc length, distance and normal of points."""
        return (x - self.point) @ self.along, (x - self.point) @ self.normal, np.broadcast_to(self.normal, x.shape)


class Arc:
    """Γ_C on a circle, s from the angle `middle`; n outward."""

    def __init__(self, centre, radius, middle, reach):
        self.centre, self.radius, self.middle, self.reach = np.array(centre, float), radius, middle, reach

    def places(self, x):
        x = x - self.centre
        size = np.linalg.norm(x, axis=-1, keepdims=True)
        angle = np.angle((x[..., 0] + 1j * x[..., 1]) * np.exp(-1j * self.middle))
        return self.radius * angle, size[..., 0] - self.radius, x / size


def trace(body, centre, curve, cuts):
    """∫ ψ n·u ds of a body over segments between `cuts`, as a matrix."""
    rows, columns, values = [], [], []
    x = body.x + centre
    s, away, _ = curve.places(x[body.edges])
    near = (abs(away) < curve.reach).all(1) & (s.min(1) <= cuts[-1]) & (s.max(1) >= cuts[0]) & (np.ptp(s, axis=1) < 4 * curve.reach)
    for edge, at in zip(body.edges[near], s[near]):
        low, high = max(at[:2].min(), cuts[0]), min(at[:2].max(), cuts[-1])
        inner = cuts[(cuts > low) & (cuts < high)]
        pieces = np.concatenate([[low], inner, [high]])
        length, middle = np.diff(pieces), (pieces[1:] + pieces[:-1]) / 2
        if not (length > 1e-13).any():
            continue
        wanted = (middle[:, None] + length[:, None] / 2 * GAUSS[0]).ravel()
        t = 2 * (wanted - at[0]) / (at[1] - at[0]) - 1
        for _ in range(8):  # where on the bent edge it is
            value = np.stack([t * (t - 1) / 2, t * (t + 1) / 2, 1 - t * t], -1)
            point = value @ x[edge]
            step = 1e-6
            shifted = np.stack([(t + step) * (t + step - 1) / 2, (t + step) * (t + step + 1) / 2, 1 - (t + step) ** 2], -1) @ x[edge]
            found = curve.places(point)[0]
            t = t + (wanted - found) * step / (curve.places(shifted)[0] - found)
        value = np.stack([t * (t - 1) / 2, t * (t + 1) / 2, 1 - t * t], -1)
        normal = curve.places(value @ x[edge])[2]
        weight = (length[:, None] / 2 * GAUSS[1]).ravel()
        row = np.clip(np.searchsorted(cuts, np.repeat(middle, len(GAUSS[0]))) - 1, 0, len(cuts) - 2)
        for k in range(3):
            for c in range(2):
                rows.append(row)
                columns.append(np.full(len(row), 2 * edge[k] + c))
                values.append(weight * value[:, k] * normal[:, c])
    if not rows:
        raise ValueError("no edge lies on this contact")
    return sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(len(cuts) - 1, len(body.load)))


class Scene:
    def __init__(self):
        self.bodies, self.contacts, self.pressed = [], [], {}

    def add(self, *arguments, **more):
        self.bodies.append(Turned(*arguments, **more))
        return len(self.bodies) - 1

    def contact(self, name, pair, curve, cuts, gap):
        """`pair` are numbers of bodies, None is rigid and at rest; `gap(s)`."""
        mean = lambda a, b: (b - a) / 2 * GAUSS[1] @ gap((a + b) / 2 + (b - a) / 2 * GAUSS[0])
        gaps = np.array([mean(a, b) for a, b in zip(cuts, cuts[1:])])
        self.contacts.append((name, pair, curve, cuts, gaps))

    def solve(self):
        """Force, cuts and λ of each contact by its name, and the strain energy."""
        first = np.cumsum([0] + [len(cuts) - 1 for *_, cuts, _ in self.contacts])
        count = first[-1]
        lengths = np.concatenate([np.diff(cuts) for *_, cuts, _ in self.contacts])
        gap = np.concatenate([gaps for *_, gaps in self.contacts])
        schur, open_by, border, balance, blocks = [], np.zeros(count), [], [], []
        for k, own in enumerate(self.bodies):
            body, parts, at = own.body, [], []
            for c, (_, pair, curve, cuts, _) in enumerate(self.contacts):
                if k in pair:
                    sign = 1.0 if pair[0] == k else -1.0
                    parts.append(sign * trace(body, own.centre, curve, cuts))
                    at.append(np.arange(first[c], first[c + 1]))
            trace_of, at = sp.vstack(parts).tocsr(), np.concatenate(at)
            modes = body.rigid @ own.turn
            both = body.solve(np.column_stack([trace_of.T.toarray(), body.load]), modes[:, own.held])
            block = trace_of @ both[:, :-1]
            place = np.meshgrid(at, at, indexing="ij")
            schur.append(sp.coo_matrix(((block + block.T).ravel() / 2, (place[0].ravel(), place[1].ravel())), shape=(count, count)))
            open_by[at] += trace_of @ both[:, -1]
            blocks.append((trace_of, at, modes, own, []))
            for mode in range(3) if body.floats else ():
                if mode not in own.held:
                    row = np.zeros(count)
                    row[at] = trace_of @ modes[:, mode]
                    blocks[-1][-1].append((mode, len(border)))
                    border.append(sp.csr_matrix(row))
                    balance.append(modes[:, mode] @ body.load)
        for k, (name, *_) in enumerate(self.contacts):
            if name in self.pressed:  # by a rigid tool that carries a force
                row = np.zeros(count)
                row[first[k] : first[k + 1]] = lengths[first[k] : first[k + 1]]
                border.append(sp.csr_matrix(row))
                balance.append(self.pressed[name])
        schur = sum(schur[1:], schur[0]).tocsc()
        border = sp.vstack(border) if border else sp.csr_matrix((0, count))
        scale = sp.diags(1 / lengths)  # unknown: the force of a segment
        quadratic, linear = sp.triu(scale @ schur @ scale).tocsc(), (gap - open_by) / lengths
        size, force = abs(quadratic.diagonal()).max(), max(map(abs, balance), default=1.0)
        rows = sp.vstack([border @ scale, -sp.eye(count)]).tocsc()
        settings = clarabel.DefaultSettings()
        settings.verbose = False
        settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = 1e-10
        cones = [clarabel.ZeroConeT(len(balance)), clarabel.NonnegativeConeT(count)]
        wanted = np.concatenate([np.array(balance) / force, np.zeros(count)])
        answer = clarabel.DefaultSolver(quadratic / size, linear / (size * force), rows, wanted, cones, settings).solve()
        self.status = str(answer.status)
        forces = np.array(answer.x) * force
        pressure = forces / lengths
        motions = -np.array(answer.z)[: len(balance)] * size * force
        energy, self.displacements = 0.0, []
        for trace_of, at, modes, own, unknown in blocks:
            body = own.body
            acting = body.load - trace_of.T @ pressure[at]
            u = body.solve(acting[:, None], modes[:, own.held])[:, 0]
            energy += acting @ u / 2
            for mode, row in unknown:
                u = u + modes[:, mode] * motions[row]
            self.displacements.append(u)
        found = {}
        for k, (name, _, _, cuts, _) in enumerate(self.contacts):
            own = slice(first[k], first[k + 1])
            found[name] = forces[own].sum(), cuts, pressure[own]
        return found, energy


def peak(cuts, pressure):
    """The largest pressure of a round contact: λ² is a parabola in the middle of it."""
    s = (cuts[1:] + cuts[:-1]) / 2
    inner = pressure > 0.75 * pressure.max()
    a, b, c = np.polyfit(s[inner], pressure[inner] ** 2, 2)
    return math.sqrt(c - b * b / (4 * a))


def half_width(force, curvature, stiffness):
    """Hertz: b of a force, 1/R of both sides together, and E*."""
    return math.sqrt(max(4 * force / (math.pi * stiffness * curvature), 0.0))

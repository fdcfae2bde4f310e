"""A run along its contact boundary, and its errors against the run on the graded mesh of the same scene."""

import bisect
import csv
import json
import math
from pathlib import Path


def read_study(folder):
    """The rows of a study, each with the folder of its run and what stands in its summary."""
    rows = json.loads((Path(folder) / "study.json").read_text())["rows"]
    for row in rows:
        row["folder"] = Path(folder) / row["result"] if row["result"] else None
    return rows


class Line:
    """The columns of `contact_seam.csv`, one list each, over x."""

    def __init__(self, folder):
        with open(folder / "contact_seam.csv") as lines:
            table = csv.reader(line for line in lines if not line.startswith("#"))
            names = next(table)
            rows = [[float(value) for value in row] for row in table]
        self.columns = dict(zip(names, map(list, zip(*rows))))
        self.x = self.columns["x"]
        s = self.columns["s"]
        self.ends = [at for at in range(1, len(s)) if s[at] == s[at - 1]]      # two rows at one place: a segment ends

    def __getitem__(self, name):
        return self.columns[name]


class Reference:
    """The run on the graded mesh.

    Its pressure is linear in x on each segment (in the parameter of the contact boundary, which is x in both scenes) and
    of higher order at the two Gauss points of a segment: it is read there, and a cubic laid through four of these.
    """

    def __init__(self, folder):
        self.line = Line(folder)
        x, pressure, ends = self.line.x, self.line["lambda"], self.line.ends
        self.nodes, self.values = [], []
        for first, last in zip([0, *ends], [*(at - 1 for at in ends), len(x) - 1]):
            for z in (0.5 - 0.5 / math.sqrt(3), 0.5 + 0.5 / math.sqrt(3)):
                self.nodes.append(x[first] + z * (x[last] - x[first]))
                self.values.append(pressure[first] + z * (pressure[last] - pressure[first]))

    def pressure(self, x):
        """Contact pressure at x."""
        first = min(max(bisect.bisect(self.nodes, x) - 2, 0), len(self.nodes) - 4)
        four = range(first, first + 4)
        weights = [math.prod((x - self.nodes[j]) / (self.nodes[i] - self.nodes[j]) for j in four if j != i) for i in four]
        return sum(weight * self.values[i] for weight, i in zip(weights, four))

    def displacement(self, name, x):
        """Normal displacement of a body at x, linear between the rows of the table."""
        at = min(max(bisect.bisect(self.line.x, x), 1), len(self.line.x) - 1)
        (a, b), column = self.line.x[at - 1 : at + 1], self.line[name]
        share = (x - a) / (b - a) if b > a else 0.0
        return column[at - 1] + share * (column[at] - column[at - 1])


def first_ends(line, reference, count):
    """Relative errors of λ at the first segment ends, there the mean of both values."""
    pressure = line["lambda"]
    return [0.5 * (pressure[at - 1] + pressure[at]) / reference.pressure(line.x[at]) - 1 for at in line.ends[:count]]


def root_mean_square(x, values):
    """By the trapezoidal rule over the rows; a jump has no width."""
    pieces = [(x[k + 1] - x[k], 0.5 * (values[k] ** 2 + values[k + 1] ** 2)) for k in range(len(x) - 1)]
    return math.sqrt(sum(width * square for width, square in pieces) / sum(width for width, _ in pieces))


def errors(line, reference, span):
    """Relative root mean square errors where x lies in `span`: λ, σ of each body, normal displacement of both."""
    inside = [at for at, x in enumerate(line.x) if span[0] <= x <= span[1]]
    x = [line.x[at] for at in inside]
    exact = [reference.pressure(place) for place in x]

    def off(name, sign, wanted):
        difference = [sign * line[name][at] - value for at, value in zip(inside, wanted)]
        return root_mean_square(x, difference) / root_mean_square(x, wanted)

    moved = [off(name, 1, [reference.displacement(name, place) for place in x]) for name in ("un_1", "un_2")]
    return {
        "lambda": off("lambda", 1, exact),
        "sigma_1": off("sigma_1", -1, exact),
        "sigma_2": off("sigma_2", -1, exact),
        "u": math.hypot(*moved) / math.sqrt(2),
    }

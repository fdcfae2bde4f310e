"""Figures and tables of docs/paper.md from the results of its studies: of the curves, against N, and of the points.

    python3 docs/paper/draw.py out/gls out/paper out/points

writes figure_4.svg, figure_6.svg, errors.svg and five tables into docs/paper, or into a fourth folder if one is named; README.md
there says what the tables hold.
"""

import csv
import math
import sys
from itertools import groupby
from pathlib import Path

from measure import Line, Reference, errors, first_ends, read_study
from sheet import BLUE, GREEN, GREY, INK, VERMILION, Axis, Sheet

SPACES = {"p0": ("P0", BLUE), "p1-discontinuous": ("P1 disc.", VERMILION), "p1-continuous": ("P1 cont.", GREEN)}
RULES = {"cut": "cut", "segment": "uncut"}

# λ by hp finite elements, graded to the corners; the same values as in the READMEs of cases/bars_inclined and cases/bars_parabola.
EXACT = {
    "inclined": [
        (0.6, 0.943062), (1.2, 0.925057), (1.8, 0.930748), (2.4, 0.947871), (3, 0.97248), (3.6, 1.00292), (4.2, 1.03826),
        (4.8, 1.07579), (5.4, 1.1029),
    ],
    "parabola": [(0.4, 0.7806876), (1.2, 1.11386922), (2, 1.4009059), (2.8, 1.12445884), (3.6, 0.48007225)],
}
LENGTH = {"inclined": 6.0, "parabola": 4.0}
SPANS = {"middle": (0.2, 0.8), "vertex": (0.4, 0.6), "end": (0.8, 1.0)}      # shares of the length in x
# What is measured of a run, and its column in the tables.
QUANTITIES = {
    "lambda": "lambda_middle_60",
    "vertex": "lambda_middle_20",
    "end": "lambda_last_20",
    "sigma_1": "sigma_lower",
    "sigma_2": "sigma_upper",
    "u": "u",
    "energy": "energy",
    "oscillation": "oscillation",
}
DRAWN = {
    "lambda": "λ",
    "sigma_2": "n·σn, upper bar",
    "u": "n·u of both bars",
    "energy": "strain energy",
    "oscillation": "oscillation of λ",
}


def measured(row, references):
    """All quantities of a run; nothing where it has no result."""
    figures = dict.fromkeys(QUANTITIES)
    if row["folder"] is None or not (row["folder"] / "contact_seam.csv").exists():
        return figures
    scene = row["case"].removesuffix("_graded")
    line = Line(row["folder"])
    within = {name: [share * LENGTH[scene] for share in span] for name, span in SPANS.items()}
    figures |= errors(line, references[scene], within["middle"])
    figures |= {name: errors(line, references[scene], within[name])["lambda"] for name in ("vertex", "end")}
    figures["energy"] = row["errors.energy"]
    figures["oscillation"] = row["contact.seam.oscillation"]
    return figures


def status(row):
    """Whether a run has converged, and whether mezha then trusts its pressure; nothing where it has no figure to judge by."""
    if row["status"] != "converged":
        return ["no", ""]
    return ["yes", {True: "yes", False: "no", None: ""}[row["contact.seam.trust"]]]


def draw_pressures(rows, figure, title, pressures):
    """λ and both bodies' -n·σn along x: rows for spaces, columns for N and quadrature."""
    rows = [row for row in rows if (row["curve"] or "").startswith(figure)]
    curves = [(key, list(pair)) for key, pair in groupby(rows, key=lambda row: row["curve"])]
    scene = rows[0]["case"]
    sheet = Sheet(title, 4, len(curves) // 2)
    stresses = [("−n·σn of the lower bar", VERMILION, 0.9, ""), ("of the upper bar", GREEN, 0.9, "")]
    sheet.legend([("λ", BLUE, 2.2, ""), *stresses, ("λ by hp elements", INK, 0, "")])
    x_axis = Axis(0, LENGTH[scene], range(int(LENGTH[scene]) + 1))
    for at, (name, pair) in enumerate(curves):
        for shift, row in enumerate(pair):
            plot = sheet.plot(2 * (at % 2) + shift, at // 2, x_axis, pressures)
            line = Line(row["folder"])
            for column, colour in (("sigma_1", VERMILION), ("sigma_2", GREEN)):
                plot.curve(line.x, [-value for value in line[column]], colour, 0.9)
            plot.curve(line.x, line["lambda"], BLUE, 2.2)
            plot.dots(*zip(*EXACT[scene]), INK)
            plot.note(f"{name.removeprefix(figure + ': ')}, {RULES[row['contact.seam.quadrature']]}")
            if at >= len(curves) - 2:
                plot.foot("x")
    return sheet


def draw_errors(sweep):
    """Errors and oscillation against N: rows for quantities, columns for example and quadrature."""
    sheet = Sheet("Errors and oscillation against the number N of segments, meshes fixed", 4, 5)
    spaces = [(words, colour, 2, "") for words, colour in SPACES.values()]
    orders = [("P2 displacement", GREY, 1.3, ""), ("P1 displacement", GREY, 1.3, "5 3")]
    sheet.legend([*spaces, *orders, ("not converged, or not trusted", GREY, 0, "hollow")])
    x_axis = Axis(4, 300, (5, 10, 20, 30, 60, 120, 240), log=True)
    y_axis = Axis(1e-6, 2, (1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1), log=True)
    columns = [(example, rule) for example in ("example 1", "example 2") for rule in RULES]
    for column, (example, rule) in enumerate(columns):
        for down, quantity in enumerate(DRAWN):
            plot = sheet.plot(column, down, x_axis, y_axis)
            if down == 0:
                plot.head(f"{example}, {RULES[rule]}")
            if down == 4:
                plot.foot("N")
            if column == 0:
                plot.side(DRAWN[quantity])
            for (curve, order, space, used), runs in sweep.items():
                if (curve, used) == (example, rule):
                    counts = [row["contact.seam.segments"] for row, _ in runs]
                    values = [figures[quantity] for _, figures in runs]
                    plot.curve(counts, values, SPACES[space][1], 1.3, "5 3" if order == 1 else "")
                    plot.dots(counts, values, SPACES[space][1], [status(row) != ["yes", "yes"] for row, _ in runs])
    return sheet


def cells(values):
    """All quantities of a run, to two digits."""
    for quantity in QUANTITIES:
        value = values[quantity]
        known = value is not None and math.isfinite(value)
        yield (">10" if value > 10 else f"{value:.1e}") if known else ""


def curve_of(row):
    """Which curve of the study `gls` it is, its spaces and its number of segments."""
    if row["curve"] == "graded":
        return [row["case"].replace("_", " "), "", ""]
    name, _, rest = row["curve"].partition(": ")
    return [name, *rest.split(", N = ")]


def tables(figures, sweep, points, references):
    """Every figure of the studies: by the name of a table its head and its rows."""
    spaces = lambda order, space: f"P{order}/{SPACES[space][0]}"
    rule = lambda row: RULES[row["contact.seam.quadrature"]]
    judged = ["converged", "trusted", *QUANTITIES.values()]
    yield "graded", ["example", "x", "lambda"], [
        [scene, f"{x:g}", f"{reference.pressure(x) / value - 1:.1e}"]
        for scene, reference in references.items()
        for x, value in EXACT[scene]
    ]
    yield "curves", ["curve", "spaces", "N", "quadrature", *judged], [
        [*curve_of(row), rule(row), *status(row), *cells(values)] for row, values in figures
    ]
    beside = [row for row, _ in figures if row["case"] == "parabola"]
    errors_of = lambda row: first_ends(Line(row["folder"]), references["parabola"], 6)
    yield "corner", ["curve", "spaces", "N", "quadrature", *(f"end_{at}_percent" for at in range(1, 7))], [
        [*curve_of(row), rule(row), *(f"{100 * error:.1f}" for error in errors_of(row))] for row in beside
    ]
    yield "points", ["spaces", "N", "points", *judged], [
        [
            spaces(2, row["contact.seam.multiplier"]),
            row["contact.seam.segments"],
            row["contact.seam.points"],
            *status(row),
            *cells(values),
        ]
        for row, values in points
    ]
    shown = {key: runs for key, runs in sweep.items() if any(row["status"] != "refused" for row, _ in runs)}
    yield "segments", ["curve", "spaces", "quadrature", "N", *judged], [
        [curve, spaces(order, space), RULES[used], row["contact.seam.segments"], *status(row), *cells(values)]
        for (curve, order, space, used), runs in shown.items()
        for row, values in runs
    ]


def main(curves, sweep, points, out=Path(__file__).parent):
    out = Path(out)
    rows = read_study(curves)
    graded = [row for row in rows if row["curve"] == "graded" and row["contact.seam.quadrature"] == "cut"]
    references = {row["case"].removesuffix("_graded"): Reference(row["folder"]) for row in graded}
    for figure, title, axis in (
        ("figure 4", "Example 1: contact pressure along the line", Axis(0.6, 1.4, (0.6, 0.8, 1, 1.2, 1.4))),
        ("figure 6", "Example 2: contact pressure along the parabola", Axis(0, 3, (0, 1, 2, 3))),
    ):
        draw_pressures(rows, figure, title, axis).write(out / f"{figure.replace(' ', '_')}.svg")
    keys = ("curve", "mesh.order", "contact.seam.multiplier", "contact.seam.quadrature")
    runs = groupby(read_study(sweep), key=lambda row: tuple(row[key] for key in keys))
    sweep = {key: [(row, measured(row, references)) for row in group] for key, group in runs}
    draw_errors(sweep).write(out / "errors.svg")
    figures = [(row, measured(row, references)) for row in rows if row not in graded]
    points = [(row, measured(row, references)) for row in read_study(points)]
    for name, head, lines in tables(figures, sweep, points, references):
        with open(out / f"{name}.csv", "w", newline="") as table:
            csv.writer(table, lineterminator="\n").writerows([head, *lines])


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    main(*sys.argv[1:])

"""Tables and sentences of docs/performance.md. A sentence says what the numbers of the studies say, whatever they are."""

import math

SMALL = (
    "**A first version, from small meshes run once each on a machine that did other things meanwhile: counts and errors "
    "stand, times mean little.**"
)
# An estimate of the root of the error of the energy, for which no times are listed beside those of the energy.
NORM = "estimate.energy"
# Bounds of each error whose times are listed; bounds that no run meets are left out.
BOUNDS = {
    "errors.energy": [1e-4, 1e-6, 1e-8],
    "errors.lambda_seam": [1e-2, 1e-3, 1e-4, 1e-5],
}
# What tables call the errors.
SHORT = {"errors.energy": "energy", NORM: "norm", "errors.lambda_seam": "λ"}
# Bounds at which groups of runs are compared: the tightest one that both meet.
RACES = {"errors.energy": [1e-3, 1e-4, 1e-6, 1e-8]}
DECADES = [10.0**-k for k in range(1, 10)]
# Unknowns from which on tables list a run; figures have all.
LISTED = 1e5
# What the names of curves on graded and on adapted meshes have.
GRADED, ADAPTED = ", graded", ", adapted"
# Times that differ by less count as equal.
EQUAL = 1.2


def page(studies, small):
    """The whole page."""
    speed, scaling, ranks = studies["speed_against_error"], studies["scaling"], studies["ranks"]
    parts = [
        "# Performance",
        "Made by `docs/performance/make` from the studies in [cases/studies](../cases/studies/README.md). "
        "Figures and fits are explained in [studies.md](studies.md).",
        SMALL if small else "",
        machine(studies),
        speed_section(speed, small),
        scaling_section(scaling, small),
        brought_section(studies["brought"]),
        solvers_section(studies["solvers"]),
        ranks_section(ranks),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def machine(studies):
    machines = sorted({name for study in studies.values() for name in study["machines"]})
    blas = sorted({name.split(" (")[0] for study in studies.values() for name in study["blas"]})
    version = sorted({study["mezha"] for study in studies.values()})
    text = f"Machine: {'; '.join(machines)}. BLAS: {', '.join(blas)}. mezha {', '.join(version)}."
    if len(machines) > 1:
        text += " Times of several machines do not compare."
    return text


# Errors and times


def speed_section(study, small):
    errors = study["errors"]
    parts = [
        "## What an error costs",
        "Three contacts, with all pairs of elements and multipliers on even meshes, two pairs on meshes graded towards the ends of the "
        "contact line, and one on meshes that adapt themselves, to the displacement in the energy norm or to λ. One rank, "
        "`tolerance = \"discretisation\"`. Times are `" + study["time"] + "`, from start to end, on adapted meshes of the whole sequence"
        + (", medians of the repeats." if repeats(study) > 1 else "."),
        "- *energy*, `errors.energy`: relative error of the strain energy.\n"
        "- *norm*, `estimate.energy`: estimated relative error of the displacement in the energy norm, about the root of *energy* where "
        "loads alone do work.\n"
        "- *λ*, `errors.lambda_seam`: relative error of the pressure, at points away from the corners on both pairs of bars, in the mean "
        "square on the rings.",
        "A run counts for a bound only if all finer runs of its line stay below it too.",
        "![time against error](figures/speed_against_error.svg)",
        "[All diagrams](figures/speed_against_error_all.svg).",
        "Seconds to an error below a bound, by the fastest run of each pair, of all pairs in bold; a dash: no run meets it.",
    ]
    cases = unique(line["case"] for line in study["lines"])
    of_case = {case: [line for line in study["lines"] if line["case"] == case] for case in cases}
    for case, lines in of_case.items():
        parts.append(f"### {case}: {lines[0]['title']}")
        parts.append(bounds_table(lines, [error for error in errors if error != NORM]))
        untrusted = sum(not point["trusted"] for line in lines for point in line["points"])
        if untrusted:
            parts.append(f"Left out: {untrusted} setting{'s' if untrusted > 1 else ''} whose pressure is not to be trusted (hollow marks).")
    if not small:
        parts += [
            "### Which choice is faster",
            "The best run of one group against the best of the other, at the tightest bound that both meet:",
            races_table(of_case, errors),
        ]
    return "\n\n".join(part for part in parts if part)


def time_to(line, error, bound):
    """The time of the fastest run from which on all finer ones are below the bound; None if there is none."""
    times = []
    for point in reversed(line["points"]):
        if point["errors"].get(error, math.inf) > bound:
            break
        if point["trusted"]:
            times.append(point["time"]["median"])
    return min(times, default=None)


def bounds_table(lines, errors):
    """A row for each line, a column for each bound that any of them meets."""
    columns = []
    for error in errors:
        for bound in BOUNDS.get(error, DECADES):
            times = [time_to(line, error, bound) for line in lines]
            known = [time for time in times if time is not None]
            if not known:
                break
            cells = ["–" if time is None else seconds(time) for time in times]
            bold = [f"**{cell}**" if time == min(known) else cell for cell, time in zip(cells, times)]
            columns.append([f"{short(error)} {power(bound)}"] + bold)
    rows = [[line["name"]] + [column[at + 1] for column in columns] for at, line in enumerate(lines)]
    return table(["pair"] + [column[0] for column in columns], rows)


def races_table(of_case, errors):
    """P2 against P1 on meshes of the user's, graded meshes against even ones, and adapted ones against both."""
    rows = []
    for case, lines in of_case.items():
        adapted = [line for line in lines if ADAPTED in line["name"]]
        given = [line for line in lines if ADAPTED not in line["name"]]
        orders = [[line for line in given if line["name"].startswith(order)] for order in ("P1", "P2")]
        meshes = [[line for line in given if (GRADED in line["name"]) is graded] for graded in (False, True)]
        for error in (error for error in errors if error != NORM):
            rows.append([
                case, short(error), race(orders, ("P1", "P2"), error), race(meshes, ("even", "graded"), error),
                race([given, adapted], ("given", "adapted"), error),
            ])
    return table(["case", "error", "P1 or P2", "even or graded", "given or adapted"], rows)


def race(groups, names, error):
    """Which group is first at the tightest bound that both meet; the first are the fastest."""
    both = None
    for bound in RACES.get(error, DECADES):
        times = [[time_to(line, error, bound) for line in group] for group in groups]
        first = [min((time for time in own if time is not None), default=None) for own in times]
        if all(first):
            both = bound, first
    return met(*both, names) if both else "–"


def met(bound, first, names):
    (fast, winner), (slow, _) = sorted(zip(first, names))
    if slow > EQUAL * fast:
        return f"{winner}, {slow / fast:.1f}× ({power(bound)})"
    return f"equal within {100 * (EQUAL - 1):.0f} % ({power(bound)})"


# Large meshes


def scaling_section(study, small):
    header = ["pair", "unknowns", "Krylov iterations", "seconds", "of which in solves", "bytes for each unknown"]
    laws = []
    for line in study["lines"]:
        cost = line["cost"]
        if cost is not None:
            growth = f"grows like N^{cost['exponent']:.2f}" if cost["deviation"] <= 1.5 else "follows no power law"
            laws.append(f"{growth} with {line['name']}")
    ranks = unique(line["ranks"] for line in study["lines"])
    parts = [
        "## Large meshes",
        f"Example 1 with even meshes and segments, {' and '.join(map(str, ranks))} ranks, `tolerance = 1e-8`. Iterations are those on the "
        "finest mesh: of GMRES, with one cycle each, and above half a million unknowns of BiCGStab, with two.",
        "![time against unknowns](figures/scaling.svg)",
        table(header, rows_of_runs(study, "time_s.solve")),
        f"Over the three largest meshes time {', and '.join(laws)}." if laws and not small else "",
    ]
    return "\n\n".join(part for part in parts if part)


# Meshes as they come


def brought_section(study):
    header = ["pair", "unknowns", "Krylov iterations", "seconds", "of which reading and dealing out", "bytes for each unknown"]
    return "\n\n".join([
        "## Fine meshes from a file",
        "The same bars of up to 980 thousand irregular triangles, not refined, whose numbers have no order at all; 2 ranks, "
        "`tolerance = 1e-8`.",
        "![time against unknowns](figures/brought.svg)",
        table(header, rows_of_runs(study, "time_s.mesh")),
    ])


def rows_of_runs(study, part):
    """A row for each run that is listed, with one part of its time beside the whole."""
    rows = []
    for line in study["lines"]:
        for point in listed(line):
            unknowns, time = point["unknowns"], point["time"]["median"]
            row = next(row for row in study["rows"] if row["result"] == point["result"])
            cells = [count(unknowns), f"{point['iterations']:.0f}", seconds(time), seconds(row[part])]
            rows.append([line["name"]] + cells + [f"{point['memory'] * 2**20 / unknowns:.0f}"])
    return rows


# Solvers


def solvers_section(study):
    header = ["pair", "unknowns", "s, fieldsplit", "s, direct", "ratio", "MiB, fieldsplit", "MiB, direct"]
    lines = {line["name"]: line for line in study["lines"]}
    rows = []
    for name in unique(name.rsplit(", ", 1)[0] for name in lines):
        for own, other in zip(*(listed(lines[f"{name}, {solver}"]) for solver in ("fieldsplit", "direct"))):
            times = [point["time"]["median"] for point in (own, other)]
            memory = [point["memory"] for point in (own, other)]
            rows.append([name, count(own["unknowns"])] + [seconds(time) for time in times] + [f"{times[1] / times[0]:.1f}"]
                        + [f"{each:.0f}" for each in memory])
    parts = [
        "## Multigrid and a factorisation",
        "The same problems with `solver.name = \"fieldsplit\"` and `\"direct\"` (MUMPS), 2 ranks; both solve two coarser meshes "
        "first. The ratio is the time of `direct` by that of `fieldsplit`.",
        "![fieldsplit and direct](figures/solvers.svg)",
        table(header, rows),
    ]
    return "\n\n".join(parts)


# Ranks


def ranks_section(study):
    names = unique(line["name"].rsplit(", ", 1)[0] for line in study["lines"])
    rows, differences, more = [], [], []
    for name in names:
        lines = {line["ranks"]: line for line in study["lines"] if line["name"].rsplit(", ", 1)[0] == name}
        alone = lines[1]
        for ranks, line in sorted(lines.items()):
            if ranks == 1:
                continue
            for one, many in zip(listed(alone), listed(line)):
                energies = [energy(study, point) for point in (one, many)]
                differences.append(abs(energies[0] - energies[1]) / abs(energies[0]))
                more.append(round(abs(one["iterations"] - many["iterations"])))
                times = [point["time"]["median"] for point in (one, many)]
                rows.append([name, count(one["unknowns"])] + [seconds(time) for time in times] + [f"{times[0] / times[1]:.2f}"])
    iterations = f"differ by {max(more)} at most" if max(more) else "are the same"
    parts = [
        "## One rank and two",
        "![one and two ranks](figures/ranks.svg)",
        table(["pair", "unknowns", "s, 1 rank", "s, 2 ranks", "ratio"], rows),
        f"Iterations {iterations}. Energies differ by {scientific(max(differences))} at most. "
        "For more machines see [slurm.md](slurm.md).",
    ]
    return "\n\n".join(parts)


def energy(study, point):
    return next(row for row in study["rows"] if row["result"] == point["result"])["energy.total"]


# Words


def listed(line):
    """The points of a line that tables list: all, if all are small."""
    return [point for point in line["points"] if point["unknowns"] >= LISTED] or line["points"]


def short(error):
    return SHORT.get(error, f"`{error}`")


def repeats(study):
    return max(row["repeat"] for row in study["rows"])


def unique(items):
    return list(dict.fromkeys(items))


def table(header, rows):
    lines = ["| " + " | ".join(cells) + " |" for cells in [header] + rows]
    return "\n".join([lines[0], "|" + "---|" * len(header)] + lines[1:])


def seconds(time):
    return f"{time:.1f}" if time >= 10 else f"{time:.2f}"


def count(number):
    if number >= 1e6:
        return f"{number / 1e6:.1f} million"
    return f"{number / 1e3:.0f} thousand" if number >= 1e4 else f"{number:.0f}"


def power(number):
    exponent = round(-math.log10(number))
    return "10⁻" + str(exponent).translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))


def scientific(number):
    digits, exponent = f"{number:.1e}".split("e")
    if float(digits) == 0:
        return "0"
    raised = str(int(exponent)).replace("-", "⁻").translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{digits}·10{raised}" if int(exponent) else digits

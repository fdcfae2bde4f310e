"""Tables and sentences of docs/performance.md. A sentence says what the numbers of the studies say, whatever they are."""

import math

SMALL = (
    "**A first version, from small meshes run once each on a machine that did other things meanwhile: counts and errors "
    "stand, times mean little.**"
)
# Errors whose times are listed.
TARGETS = {"errors.energy": [1e-3, 1e-4, 1e-6, 1e-8]}
DECADES = [10.0**-k for k in range(1, 10)]
# What the names of curves on graded and on adapted meshes have.
GRADED, ADAPTED = ", graded", ", adapted"
# Times that differ by less count as equal.
EQUAL = 1.2


def page(studies, small):
    """The whole page."""
    speed, scaling, ranks = studies["speed_against_error"], studies["scaling"], studies["ranks"]
    parts = [
        "# Performance",
        "Made by `docs/performance/make` from the studies in [cases/studies](../cases/studies/README.md): words and tables "
        "too, so do not edit them here. What the figures show, and how laws are fitted: [studies.md](studies.md).",
        SMALL if small else "",
        machine(studies),
        speed_section(speed, small),
        scaling_section(scaling, small),
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
    parts = [
        "## What an error costs",
        "Three contacts, all pairs of elements and multipliers on uniform meshes, two of them on meshes that are graded towards "
        "the corners at the ends of the contact line, all of them on meshes that adapt themselves to an accuracy, of the "
        "displacement in the energy norm or of λ, one rank; the solver stops where its error is small beside that of the "
        "discretisation (`tolerance = \"discretisation\"`). Times are `" + study["time"] + "`, from start to end, on adapted "
        "meshes of the whole sequence"
        + (", medians of the repeats." if repeats(study) > 1 else ".")
        + " `errors.energy` is the relative error of the strain energy, `estimate.energy` the estimated one of the displacement in "
        "the energy norm, about its root where loads alone do work. `errors.lambda_seam` is that of the pressure: at points away "
        "from the corners on both pairs of bars, in the mean square on the rings.",
        "An error of a single number, as of the energy, may change its sign from one mesh to the next, and be small by accident. "
        "So a run counts for a bound only if all finer runs of its line stay below it too. "
        f"The fastest run of all took {seconds(fastest(study))} s.",
        "![time against error](figures/speed_against_error.svg)",
        "The other errors, and time and iterations against unknowns: [all diagrams](figures/speed_against_error_all.svg).",
    ]
    for case in unique(line["case"] for line in study["lines"]):
        lines = [line for line in study["lines"] if line["case"] == case]
        parts.append(f"### {case}: {lines[0]['title']}")
        for error in study["errors"]:
            parts.append(f"Seconds to `{error}` below a bound, for the fastest run of each pair; bold, the fastest of all:")
            parts.append(bounds_table(lines, error))
            parts.append("" if small else " ".join(bounds_sentences(lines, error)))
        parts.append("Orders p, error ~ h^p:")
        parts.append(orders_table(lines, study["errors"]))
        untrusted = sum(not point["trusted"] for line in lines for point in line["points"])
        if untrusted:
            parts.append(f"Left out of the tables of times: {untrusted} settings whose pressure is not to be trusted (hollow marks).")
    return "\n\n".join(part for part in parts if part)


def fastest(study):
    return min(point["time"]["median"] for line in study["lines"] for point in line["points"])


def time_to(line, error, bound):
    """The time of the fastest run from which on all finer ones are below the bound; None if there is none."""
    times = []
    for point in reversed(line["points"]):
        if point["errors"].get(error, math.inf) > bound:
            break
        if point["trusted"]:
            times.append(point["time"]["median"])
    return min(times, default=None)


def bounds_table(lines, error):
    """A row for each line, a column for each bound that any of them meets."""
    columns = []
    for bound in TARGETS.get(error, DECADES):
        times = [time_to(line, error, bound) for line in lines]
        known = [time for time in times if time is not None]
        if not known:
            break
        cells = ["–" if time is None else seconds(time) for time in times]
        columns.append([power(bound)] + [f"**{cell}**" if time == min(known) else cell for cell, time in zip(cells, times)])
    # Bounds that all pairs meet on their coarsest mesh say nothing.
    while error not in TARGETS and len(columns) > 1 and columns[0][1:] == columns[1][1:]:
        columns.pop(0)
    rows = [[line["name"]] + [column[at + 1] for column in columns] for at, line in enumerate(lines)]
    return table(["pair"] + [column[0] for column in columns], rows)


def bounds_sentences(lines, error):
    """P2 against P1 on meshes of the user's, graded meshes against even ones, and adapted ones against both: the best of each at
    the tightest bound that both reach."""
    adapted = [line for line in lines if ADAPTED in line["name"]]
    drawn = [line for line in lines if ADAPTED not in line["name"]]
    orders = [[line for line in drawn if line["name"].startswith(order)] for order in ("P1", "P2")]
    meshes = [[line for line in drawn if (GRADED in line["name"]) is graded] for graded in (False, True)]
    sentences = [
        race(orders, ("runs with P1", "runs with P2"), error),
        race(meshes, ("runs on even meshes", "runs on graded meshes"), error),
        race([drawn, adapted], ("runs on meshes that are given", "runs on adapted meshes"), error),
    ]
    return [sentence for sentence in sentences if sentence]


def race(groups, names, error):
    """Which group is first at the tightest bound that both meet, and how far one of them goes alone; the first are the fastest."""
    both, alone = None, None
    for bound in TARGETS.get(error, DECADES):
        first = []
        for group in groups:
            times = [(time_to(line, error, bound), line["name"]) for line in group]
            first.append(min((entry for entry in times if entry[0] is not None), default=None))
        if all(first):
            both = bound, first
        elif any(first):
            alone = bound, next((*entry, name) for entry, name in zip(first, names) if entry)
    return " ".join(([met(*both, names)] if both else []) + ([met_alone(*alone)] if both and alone else []))


def met(bound, first, names):
    where = f"At {power(bound)}, the tightest bound that {names[0]} and {names[1]} both meet,"
    ((fast, one), winner), ((slow, other), loser) = sorted(zip(first, names))
    if slow > EQUAL * fast:
        return f"{where} {winner} are {slow / fast:.1f} times as fast as {loser} ({one} against {other})."
    return f"{where} the best of both take the same time within {100 * (EQUAL - 1):.0f} %."


def met_alone(bound, first):
    time, line, names = first
    return f"Only {names} meet {power(bound)}, in {seconds(time)} s ({line})."


def orders_table(lines, errors):
    rows = [[line["name"]] + [law(line["orders"][error]) for error in errors] for line in lines]
    return table(["pair"] + [f"`{error}`" for error in errors], rows)


# Large meshes


def scaling_section(study, small):
    header = ["pair", "unknowns", "Krylov iterations", "seconds", "of which in solves", "microseconds for each unknown", "bytes for each unknown"]
    rows, sentences = [], []
    for line in study["lines"]:
        for point in line["points"]:
            unknowns, time = point["unknowns"], point["time"]["median"]
            row = next(row for row in study["rows"] if row["result"] == point["result"])
            each = [f"{1e6 * time / unknowns:.2f}", f"{point['memory'] * 2**20 / unknowns:.0f}"]
            cells = [count(unknowns), f"{point['iterations']:.0f}", seconds(time), seconds(row["time_s.solve"])]
            rows.append([line["name"]] + cells + each)
        sentences.append(scaling_sentence(line, small))
    ranks = unique(line["ranks"] for line in study["lines"])
    parts = [
        "## Large meshes",
        f"Example 1 with even meshes and segments, {' and '.join(map(str, ranks))} ranks, the solver to 10⁻⁸; iterations are "
        "those of the linear solves on the finest mesh: of GMRES, with one cycle each, and above half a million unknowns of BiCGStab, "
        "with two.",
        "![time against unknowns](figures/scaling.svg)",
        table(header, rows),
        " ".join(sentences),
        "The counts are held on small meshes by `tests/scaling.rs`, and on large ones by `ci/scaling`.",
    ]
    return "\n\n".join(parts)


def scaling_sentence(line, small):
    points = line["points"]
    iterations = [point["iterations"] for point in points]
    first, last = points[0]["unknowns"], points[-1]["unknowns"]
    between = f"{min(iterations):.0f}" if min(iterations) == max(iterations) else f"{min(iterations):.0f} to {max(iterations):.0f}"
    text = f"{line['name']}: {between} iterations from {count(first)} to {count(last)} unknowns"
    cost = line["cost"]
    if cost is None or small:
        return text + "."
    if cost["deviation"] > 1.5:
        return text + "; the times follow no power law."
    return text + f"; over the three largest meshes time ~ N^{cost['exponent']:.2f}."


# Solvers


def solvers_section(study):
    header = ["pair", "unknowns", "s, fieldsplit", "s, direct", "ratio", "MiB, fieldsplit", "MiB, direct", "ratio"]
    lines = {line["name"]: line for line in study["lines"]}
    rows, told = [], []
    for name in unique(name.rsplit(", ", 1)[0] for name in lines):
        pairs = list(zip(*(lines[f"{name}, {solver}"]["points"] for solver in ("fieldsplit", "direct"))))
        for own, other in pairs:
            times = [point["time"]["median"] for point in (own, other)]
            memory = [point["memory"] for point in (own, other)]
            rows.append([name, count(own["unknowns"])] + [seconds(time) for time in times] + [f"{times[1] / times[0]:.1f}"]
                        + [f"{each:.0f}" for each in memory] + [f"{memory[0] / memory[1]:.2f}"])
        told.append(f"with {name} {times[1] / times[0]:.1f} times the time and {memory[1] / memory[0]:.1f} times the memory")
    largest = count(pairs[-1][0]["unknowns"])
    parts = [
        "## Multigrid and a factorisation",
        "The same problems with `solver.name = \"fieldsplit\"` and with `\"direct\"`, MUMPS with the BLAS named above, on 2 ranks, from "
        "start to end. Both solve two coarser meshes first.",
        "![fieldsplit and direct](figures/solvers.svg)",
        table(header, rows),
        f"At {largest} unknowns the factorisation takes {', and '.join(told)}.",
    ]
    return "\n\n".join(parts)


# Ranks


def ranks_section(study):
    names = unique(line["name"].rsplit(", ", 1)[0] for line in study["lines"])
    rows, gains, differences = [], [], []
    for name in names:
        lines = {line["ranks"]: line for line in study["lines"] if line["name"].rsplit(", ", 1)[0] == name}
        alone = lines[1]
        for ranks, line in sorted(lines.items()):
            if ranks == 1:
                continue
            for one, many in zip(alone["points"], line["points"]):
                gain = one["time"]["median"] / many["time"]["median"]
                energies = [energy(study, point) for point in (one, many)]
                differences.append(abs(energies[0] - energies[1]) / abs(energies[0]))
                times = [seconds(point["time"]["median"]) for point in (one, many)]
                gains.append((one["unknowns"], *times, name))
                iterations = [f"{point['iterations']:.0f}" for point in (one, many)]
                rows.append([name, count(one["unknowns"])] + times + [f"{gain:.2f}"] + iterations + [scientific(differences[-1])])
    header = ["pair", "unknowns", "s, 1 rank", "s, 2 ranks", "ratio", "iterations, 1 rank", "2 ranks", "relative difference of the energy"]
    largest = max(entry[0] for entry in gains)
    told = [f"{name} takes {one} s on one rank and {two} s on two" for unknowns, one, two, name in gains if unknowns == largest]
    parts = [
        "## One rank and two",
        "![one and two ranks](figures/ranks.svg)",
        table(header, rows),
        f"At {count(largest)} unknowns {'; '.join(told)}. The energies differ by {scientific(max(differences))} "
        "at most, with the solver to 10⁻⁸.",
        "Both ranks share the memory of one machine, and its bandwidth: more machines are another matter, see "
        "[slurm.md](slurm.md).",
    ]
    return "\n\n".join(parts)


def energy(study, point):
    return next(row for row in study["rows"] if row["result"] == point["result"])["energy.total"]


# Words


def repeats(study):
    return max(row["repeat"] for row in study["rows"])


def unique(items):
    return list(dict.fromkeys(items))


def table(header, rows):
    lines = ["| " + " | ".join(cells) + " |" for cells in [header] + rows]
    return "\n".join([lines[0], "|" + "---|" * len(header)] + lines[1:])


def law(law):
    if law is None:
        return "too few points"
    return f"{law['exponent']:.2f}" if law["deviation"] <= 1.5 else "no power law"


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

"""Tables and sentences of docs/scaling.md. A sentence says what the measurements say, whatever they are."""

import model

SMALL = "**A first version, from few ranks and small meshes.**"
BUSY = "**The machine did other things meanwhile: counts and memory stand, times, latencies and the model's seconds mean little.**"
COLLECTIVES = model.COLLECTIVES
SPACES = {1: "P1/P0", 2: "P2/P1 discontinuous"}


def page(measured):
    """The whole page."""
    parts = [
        "# Scaling",
        "What grows with the number of ranks. Made by `docs/scaling/make`, words and tables too: do not edit them here. Counts are "
        "exact, whatever else the machine does; times are not.",
        SMALL if measured["small"] else "",
        BUSY if measured["busy"] else "",
        counts_section(measured["counts"]),
        latency_section(measured["latency"]),
        memory_section(measured["memory"]),
        speed_section(measured["speed"]),
        partition_section(measured["partitions"]),
        model_section(measured),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(value) for value in row) + " |" for row in rows])


def number(value, digits=3):
    """So many digits; thousands apart."""
    if value == 0:
        return "0"
    if abs(value) >= 10**(digits - 1):
        return f"{round(value):,}".replace(",", " ")
    return f"{value:.{digits}g}"


# Sections


def counts_section(lines):
    first, second = ([line for line in lines if line["order"] == order] for order in SPACES)
    rows = [
        [
            one["ranks"], one["iterations"], two["iterations"], number(collectives(one), 2), number(one["most"]["messages"]),
            *(number(line["most"]["messages_bytes"] / 1024) for line in (one, two)),
        ]
        for one, two in zip(first, second)
    ]
    head = ["ranks", "iterations to 1e-10, P1", "P2", "collectives, P1", "messages of a rank, most, P1", "KiB sent by a rank, most, P1", "P2"]
    return "\n\n".join([
        "## Messages and collectives",
        f"One problem of {number(first[0]['unknowns'], 9)} unknowns on ever more ranks, which share the cores of one machine: two bars "
        f"of 496 macro triangles in all, pressed together, with {SPACES[1]} and {SPACES[2]}. A layer of MPI's profiling interface "
        "([counting.c](scaling/counting.c)) counts what each rank does in one Krylov iteration on the finest mesh: the difference of "
        "two solves, to 1e-6 and to 1e-10. All ranks wait for collectives; a message goes from one rank to another.",
        table(head, rows),
    ])


def collectives(line):
    return sum(line["most"][kind] for kind in COLLECTIVES)


def latency_section(lines):
    return "\n\n".join([
        "## Latencies on the critical path",
        "The profiling layer makes every wait for messages longer by a delay of 1, 2 and 4 ms, "
        "and every collective by that times log₂ of the number of ranks, rounded up. The slope of the time of an iteration "
        "over the delay is the number of latencies that follow each other (P1, the problem above). "
        "[two_hosts](scaling/two_hosts) makes a network of any latency on one machine, where the kernel has `sch_netem`.",
        table(
            ["ranks", "latencies of an iteration", "waits for messages of a rank, most"],
            [[line["ranks"], number(line["latencies"]), number(line["waits"])] for line in lines],
        ),
    ])


def memory_section(lines):
    rows, least = [], 0.0
    for line in lines:
        if "small mesh" in line["name"]:
            least = line["max_rank"]
        rows.append([
            line["name"], line["ranks"], number(line["max_rank"]),
            number(line["max_rank"] - least) if line["max_rank"] != least else "",
        ])
    return "\n\n".join([
        "## Memory of a rank",
        "Every rank holds the macro mesh, [Γ_C](method.md#what-is-solved) and its multipliers. Resident memory; pages of libraries count on every rank.",
        table(["scene", "ranks", "MiB of the largest rank", "more than the small mesh"], rows),
    ])


def speed_section(lines):
    rows = []
    for line in lines:
        one = next(l for l in lines if l["order"] == line["order"] and l["ranks"] == 1)
        work = line["unknowns"] / one["unknowns"] / line["ranks"]
        what = "one rank" if line["ranks"] == 1 else ("twice as large" if line["grown"] else "the same")
        rows.append([
            SPACES[line["order"]], what, line["ranks"], number(line["unknowns"], 9), number(1e3 * line["iteration_s"]),
            number(100 * one["iteration_s"] * work / line["iteration_s"], 2),
        ])
    return "\n\n".join([
        "## One and two cores",
        "Time of an iteration on the finest mesh, the best of three. Both cores share one memory.",
        table(["spaces", "problem", "ranks", "unknowns", "ms for an iteration", "efficiency, %"], rows),
    ])


def partition_section(lines):
    rows = [
        [
            SPACES[line["order"]], number(line["triangles"], 9), number(line["ranks"], 9), number(line["nodes"], 12),
            number(line["neighbours"]["most"], 2), number(line["halo_bytes"]["most"] / 1024),
            number(line["work"]["most"] / line["work"]["mean"]), number(line["owned"]["most"] / line["owned"]["mean"]), number(line["seconds"], 2),
        ]
        for line in lines
    ]
    return "\n\n".join([
        "## Partitions for thousands of ranks",
        "Macro triangles dealt by PTScotch and numbered by mezha, in one process ([partition.rs](../tests/benchmarks/partition.rs)). *Halo*: "
        "what a rank receives before a sweep over the finest level. A rank with 8 macro triangles is balanced to one of them.",
        table(
            ["spaces", "macro triangles", "ranks", "nodes", "neighbours, most", "halo KiB, most", "work, most / mean", "nodes, most / mean", "s to deal"],
            rows,
        ),
    ])


def model_section(measured):
    found = model.parameters(measured)
    shown = [[text, f"{number(found[name])} {unit}".strip()] for name, text, unit in model.MEASURED]
    assumed = [[text, f"{number(value)} {unit}".strip()] for value, text, unit in model.ASSUMED.values()]
    head = ["unknowns", *(f"{number(ranks, 9)} ranks" for ranks in model.RANKS)]
    rows = [[f"10^{power}", *(model.words(found, 10.0**power, ranks) for ranks in model.RANKS)] for power in model.POWERS]
    where = []
    for power, ranks in model.TOLD:
        parts = model.parts(found, 10.0**power, ranks)
        where.append([f"10^{power}", number(ranks, 9), *(f"{100 * part / sum(parts):.0f}" for part in parts)])
    return "\n\n".join([
        "## What follows for larger machines",
        "A model, not a measurement. An iteration on N unknowns and P ranks takes",
        "    T = t w/1.78 Σ d s_d n_d/P_d  +  V/V₀ (α v + o m)  +  α c log₂ P  +  B/β",
        "with the imbalance w. Level d, the finest being 1, has n_d = N/4^(d-1) unknowns on P_d ranks, and an F-cycle visits it d times: "
        "1.78 N unknowns in all. s_d = 1 + (s - 1) P_d/P is the slowdown of a full socket. v and m, counted on a small hierarchy, grow "
        "with the visits V to levels that several ranks share, of which that one had V₀. B grows as the root of N/P, which is too fast. A "
        "solve is by GMRES, with one cycle for each iteration.",
        "Measured (P1):",
        table(["what", "value"], shown),
        "Assumed, of no machine in particular:",
        table(["what", "value"], assumed),
        "Seconds for one solve; in brackets GiB on each rank for its unknowns, beside the macro mesh and Γ_C; – where a rank would have "
        f"fewer than {number(model.LEAST, 9)} unknowns:",
        table(head, rows),
        "Where this time goes, in %:",
        table(["unknowns", "ranks", "work, levels of all ranks", "work, other levels", "collectives", "messages"], where),
    ])

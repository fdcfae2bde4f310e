"""Seconds of a solve on machines that were not there: measured parameters, and assumed ones."""

import math

RANKS = [16, 128, 1024, 4096, 10_000]
POWERS = [8, 9, 10]
# Unknowns of a rank below which nobody would go on.
LEAST = 1000
# Unknowns, by powers of ten, and ranks for which it is told where the time goes.
TOLD = [(8, 1024), (8, 10_000), (9, 10_000)]
# Levels of the hierarchy on which messages and waits are counted: see `counts` and `latency` in make.
LEVELS = 5

COLLECTIVES = ["reductions", "sums", "gatherings"]

# Value, words, unit.
ASSUMED = {
    "latency": (2e-6, "latency α of a message, and of each step of a collective", "s"),
    "overhead": (0.5e-6, "time o of a processor for a message", "s"),
    "bandwidth": (4e8, "bandwidth β of a rank: 25 GB/s of a node, shared by 64", "B/s"),
    "socket": (2.0, "slowdown s of a rank on a full socket, whose cores share its memory, against the two ranks here", ""),
    "gathered": (3000.0, "unknowns of the largest level that every rank holds whole (GATHERED in the source)", ""),
}

# Name, words, unit.
MEASURED = [
    ("unknown", "time t of an unknown and iteration, two ranks", "s"),
    ("iterations", "iterations to 1e-8, most ranks, half-way between those to 1e-6 and to 1e-10", ""),
    ("collectives", "reductions, sums and gatherings c of an iteration", ""),
    ("waits", "latencies v on the critical path of an iteration, collectives apart", ""),
    ("messages", "messages of the busiest rank in an iteration, most ranks", ""),
    ("bytes", "bytes that the busiest rank sends in an iteration, at the N/P below", "B"),
    ("gathered", "bytes G that a rank hands to collectives in an iteration", "B"),
    ("share", "unknowns N/P of a rank there", ""),
    ("imbalance", "imbalance w of the work, 10 000 ranks", ""),
    ("memory", "memory for each unknown, two ranks", "B"),
]


def parameters(measured):
    """The measured parameters, of P1."""
    counts = [line for line in measured["counts"] if line["order"] == 1]
    last = counts[-1]
    speed = max((line for line in measured["speed"] if line["order"] == 1 and line["ranks"] == 2), key=lambda line: line["unknowns"])
    latency = measured["latency"][-1]
    collectives = sum(last["most"][kind] for kind in COLLECTIVES)
    steps = math.ceil(math.log2(latency["ranks"]))
    dealt = max((line for line in measured["partitions"] if line["order"] == 1), key=lambda line: line["triangles"])
    return {
        "unknown": speed["iteration_s"] * speed["ranks"] / speed["unknowns"],
        "iterations": last["iterations"] - 0.5 * last["more"],
        "collectives": collectives,
        "waits": max(latency["latencies"] - collectives * steps, 0.0),
        "messages": last["most"]["messages"],
        "bytes": last["most"]["messages_bytes"],
        "gathered": sum(last["most"][f"{kind}_bytes"] for kind in COLLECTIVES),
        "share": last["unknowns"] / last["ranks"],
        "imbalance": dealt["work"]["most"] / dealt["work"]["mean"],
        "memory": speed["bytes_per_unknown"],
    }


def parts(found, unknowns, ranks):
    """Seconds of one solve: of work, of collectives, and of messages on the levels that are shared out, with their waits."""
    value = {name: entry[0] for name, entry in ASSUMED.items()}
    levels = max(math.log(unknowns / value["gathered"], 4), 1.0)
    visits = levels * (levels + 1) / (LEVELS * (LEVELS + 1))
    share = unknowns / ranks
    work = found["unknown"] * share * value["socket"] * found["imbalance"]
    steps = value["latency"] * found["collectives"] * math.log2(ranks)
    collectives = steps + 2.0 * found["gathered"] / value["bandwidth"]
    waits = visits * (value["latency"] * found["waits"] + value["overhead"] * found["messages"])
    messages = waits + found["bytes"] * math.sqrt(share / found["share"]) / value["bandwidth"]
    return [found["iterations"] * seconds for seconds in (work, collectives, messages)]


def seconds(found, unknowns, ranks):
    """Of one solve."""
    return sum(parts(found, unknowns, ranks))


def words(found, unknowns, ranks):
    if unknowns / ranks < LEAST:
        return "–"
    memory = found["memory"] * unknowns / ranks / 2**30
    return f"{seconds(found, unknowns, ranks):.2g} ({memory:.2g})"

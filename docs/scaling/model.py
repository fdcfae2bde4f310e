"""Seconds of a solve on machines that were not there: measured parameters, and assumed ones."""

import math

RANKS = [16, 128, 1024, 4096, 10_000]
POWERS = [8, 9, 10]
# Unknowns of a rank below which nobody would go on.
LEAST = 1000
# Unknowns, by powers of ten, and ranks for which it is told where the time goes.
TOLD = [(8, 1024), (8, 10_000), (9, 10_000)]
# Unknowns of the largest level on one rank: SMALL in src/discretisation/levels.rs.
SMALL = 3000
# Unknowns of a rank on larger levels that are brought together, at least: LEAST_ON_A_RANK there.
LEAST_ON_A_RANK = 1000
# Unknowns of a level that needs none below it: FEW in src/multigrid/auxiliary/mod.rs.
COARSEST = 500

COLLECTIVES = ["reductions", "sums", "gatherings"]

# Value, words, unit.
ASSUMED = {
    "latency": (2e-6, "latency α of a message, and of each step of a collective", "s"),
    "overhead": (0.5e-6, "time o of a processor for a message", "s"),
    "bandwidth": (4e8, "bandwidth β of a rank: 25 GB/s of a node, shared by 64", "B/s"),
    "socket": (2.0, "slowdown s of a rank on a full socket, against the two ranks here", ""),
}

# Name, words, unit.
MEASURED = [
    ("unknown", "time t of an unknown and iteration, two ranks", "s"),
    ("iterations", "iterations to 1e-8, between those to 1e-6 and 1e-10", ""),
    ("collectives", "collectives c of an iteration", ""),
    ("waits", "latencies v of an iteration, collectives apart", ""),
    ("messages", "messages m of the busiest rank in an iteration", ""),
    ("bytes", "bytes B that it sends, at the N/P below", "B"),
    ("share", "unknowns N/P of a rank", ""),
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
        "messages": max(line["most"]["messages"] for line in counts),
        "bytes": last["most"]["messages_bytes"],
        "share": last["unknowns"] / last["ranks"],
        "visits": visits_with_messages(last["unknowns"], last["ranks"]),
        "imbalance": dealt["work"]["most"] / dealt["work"]["mean"],
        "memory": speed["bytes_per_unknown"],
    }


def hierarchy(unknowns, ranks):
    """The levels, from the finest one: how often an F-cycle comes there, its unknowns, and the ranks that share it."""
    levels, size = [], unknowns
    while not levels or size >= COARSEST:
        group = 1
        while group < ranks and (size <= SMALL or group * size < LEAST_ON_A_RANK * ranks):
            group *= 2
        levels.append((len(levels) + 1, size, math.ceil(ranks / group) if levels else ranks))
        size /= 4
    return levels


def visits_with_messages(unknowns, ranks):
    """Visits of an F-cycle to levels that several ranks share."""
    return sum(visits for visits, _, sharing in hierarchy(unknowns, ranks) if sharing > 1)


def parts(found, unknowns, ranks):
    """Seconds of one solve: of work that all ranks share, of work on levels that fewer have, of collectives, and of messages with
    their waits."""
    value = {name: entry[0] for name, entry in ASSUMED.items()}
    # An F-cycle comes to the levels once, twice, …: so many visits to all of the finest one, by their unknowns.
    all_visits = sum((level + 1) / 4**level for level in range(30))
    visit = found["unknown"] / all_visits * found["imbalance"]
    shared, brought = 0.0, 0.0
    for visits, size, sharing in hierarchy(unknowns, ranks):
        if sharing == ranks:
            shared += visit * visits * size / ranks * value["socket"]
        else:
            # The fewer ranks work at once, the less they are in each other's way.
            slowdown = 1.0 + (value["socket"] - 1.0) * sharing / ranks
            brought += visit * visits * size / sharing * slowdown
    collectives = value["latency"] * found["collectives"] * math.log2(ranks)
    more = visits_with_messages(unknowns, ranks) / found["visits"]
    waits = more * (value["latency"] * found["waits"] + value["overhead"] * found["messages"])
    messages = waits + found["bytes"] * math.sqrt(unknowns / ranks / found["share"]) / value["bandwidth"]
    return [found["iterations"] * seconds for seconds in (shared, brought, collectives, messages)]


def seconds(found, unknowns, ranks):
    """Of one solve."""
    return sum(parts(found, unknowns, ranks))


def words(found, unknowns, ranks):
    if unknowns / ranks < LEAST:
        return "–"
    memory = found["memory"] * unknowns / ranks / 2**30
    return f"{seconds(found, unknowns, ranks):.2g} ({memory:.2g})"

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
        "What grows with the number of ranks. Made by `docs/scaling/make`, words and tables too, so do not edit them here. Counts "
        "are exact, whatever else the machine does; times are not.",
        SMALL if measured["small"] else "",
        BUSY if measured["busy"] else "",
        counts_section(measured["counts"]),
        latency_section(measured["latency"], measured["counts"]),
        memory_section(measured["memory"]),
        speed_section(measured["speed"]),
        partition_section(measured["partitions"]),
        model_section(measured),
        NAMESPACES,
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


def fit(points):
    """Least squares: a and b of y = a + b x."""
    n = len(points)
    x, y = (sum(point[k] for point in points) / n for k in (0, 1))
    b = sum((p[0] - x) * (p[1] - y) for p in points) / sum((p[0] - x) ** 2 for p in points)
    return y - b * x, b


# Sections


def counts_section(lines):
    parts = [
        "## Messages and reductions",
        "The same problem on ever more ranks, which share the cores of one machine: two bars of 496 macro triangles in all, one on "
        "the other, pressed together by a load that varies along them. A layer of MPI's profiling interface "
        "([counting.c](scaling/counting.c)) counts what each rank does. The figures are those of one Krylov iteration on the finest "
        "mesh: the difference of two solves, to 1e-6 and to 1e-10, which are equal up to the last iterations of the first. "
        "Reductions, sums and gatherings are collectives: all ranks wait for them. A reduction is one of a few numbers, as the Krylov "
        "method wants them; a sum brings a vector of more than 1 KiB together on every rank. A message goes from one rank to another. "
        "Levels with few unknowns are brought together on fewer ranks: those with up to 3000 on one, larger ones on so many that "
        "each of them has about a thousand or more; the finest one stays on all. The other ranks have nothing to say there.",
    ]
    for order in sorted({line["order"] for line in lines}):
        own = [line for line in lines if line["order"] == order]
        head = ["ranks", "iterations to 1e-10", "reductions", "sums", "gatherings", "messages of a rank, mean", "most", "KiB sent by a rank, most", "KiB in collectives"]
        rows = [
            [
                line["ranks"], line["iterations"], number(line["most"]["reductions"], 2), number(line["most"]["sums"], 2), number(line["most"]["gatherings"], 2),
                number(line["mean"]["messages"]), number(line["most"]["messages"]),
                number(line["most"]["messages_bytes"] / 1024),
                number(sum(line["most"][f"{kind}_bytes"] for kind in COLLECTIVES) / 1024),
            ]
            for line in own
        ]
        parts += [f"{SPACES[order]}, {number(own[0]['unknowns'], 9)} unknowns, for each iteration:", table(head, rows), messages_fit(own)]
    return "\n\n".join(parts)


def messages_fit(lines):
    many = [line for line in lines if line["ranks"] >= 8]
    if len(many) < 2:
        return ""
    slopes = [fit([(line["ranks"], line[name]["messages"]) for line in many])[1] for name in ("mean", "most")]
    first, last = many[0], many[-1]
    least, most = (number(f(line["most"]["messages"] for line in many)) for f in (min, max))
    return (
        f"From {first['ranks']} to {last['ranks']} ranks: a rank sends {number(first['mean']['messages'])} messages in the mean, "
        f"then {number(last['mean']['messages'])}, by least squares {number(slopes[0], 2)} for each further rank; the busiest one "
        f"sends {least} to {most}, by least squares {number(slopes[1], 2)} for each further rank."
    )


def latency_section(lines, counts):
    rows = []
    for line in lines:
        of_count = next((c for c in counts if c["order"] == 1 and c["ranks"] == line["ranks"]), None)
        both = sum(of_count["most"][kind] for kind in COLLECTIVES) if of_count else 0
        rows.append([line["ranks"], number(line["latencies"]), number(line["waits"]), number(both, 2)])
    return "\n\n".join([
        "## Latencies on the critical path",
        "The kernel of this machine has no `tc netem`, so no network was delayed. Measured instead: the profiling layer makes every "
        "wait for messages last longer by a delay of 1, 2 and 4 ms, once for all messages that are waited for together, and every "
        "collective by that times log₂ of the number of ranks, rounded up, as in a tree. The slope of the time of an iteration over "
        "the delay is the number of latencies that follow each other (P1, the problem above). Waits that ranks make at the same time "
        "count once. Recipe for a delayed network: [below](#a-network-with-latency-on-one-machine).",
        table(["ranks", "latencies of an iteration", "waits for messages of a rank, most", "collectives"], rows),
    ])


def memory_section(lines):
    rows, least = [], 0.0
    for line in lines:
        if "small mesh" in line["name"]:
            least = line["max_rank"]
        rows.append([
            line["name"], line["ranks"], number(line["unknowns"], 9), number(line["max_rank"]), number(line["sum"] / 1024),
            number(line["max_rank"] - least) if line["max_rank"] != least else "",
        ])
    return "\n\n".join([
        "## Memory of a rank",
        "Every rank holds the macro mesh, Γ_C and its multipliers; of the rows of B it holds those that it needs. What remains on "
        "every rank shows where these are large. Resident memory; pages of libraries count on every rank.",
        table(["scene", "ranks", "unknowns", "MiB of the largest rank", "GiB in all", "MiB more than the small mesh"], rows),
    ])


def speed_section(lines):
    rows = []
    for line in lines:
        one = next(l for l in lines if l["order"] == line["order"] and l["ranks"] == 1)
        work = line["unknowns"] / one["unknowns"] / line["ranks"]
        what = "one rank" if line["ranks"] == 1 else ("a problem twice as large" if line["grown"] else "the same problem")
        rows.append([
            SPACES[line["order"]], what, line["ranks"], number(line["unknowns"], 9), line["iterations"], number(1e3 * line["iteration_s"]),
            number(1e9 * line["iteration_s"] * line["ranks"] / line["unknowns"]), number(100 * one["iteration_s"] * work / line["iteration_s"], 2) + " %",
        ])
    return "\n\n".join([
        "## One and two cores",
        "Time of an iteration on the finest mesh, from the same differences; the best of three. Both cores share one memory.",
        table(["spaces", "problem", "ranks", "unknowns", "iterations to 1e-10", "ms for an iteration", "ns × ranks for an unknown and iteration", "efficiency"], rows),
    ])


def partition_section(lines):
    rows = [
        [
            SPACES[line["order"]], number(line["triangles"], 9), number(line["ranks"], 9), number(line["nodes"], 12),
            number(line["neighbours"]["mean"], 2), number(line["neighbours"]["most"], 2),
            number(line["halo_bytes"]["mean"] / 1024), number(line["halo_bytes"]["most"] / 1024),
            number(line["work"]["most"] / line["work"]["mean"]), number(line["owned"]["most"] / line["owned"]["mean"]), number(line["seconds"], 2),
        ]
        for line in lines
    ]
    return "\n\n".join([
        "## Partitions for thousands of ranks",
        "Macro triangles dealt by PTScotch with mezha's graph and weights, and numbered by mezha, in one process "
        "([partition.rs](../tests/benchmarks/partition.rs)): neighbours of a rank, what it receives before a sweep over the finest "
        "level, and the largest share of work and of nodes over the mean. A rank with 8 macro triangles cannot be balanced to better "
        "than one of them.",
        table(
            ["spaces", "macro triangles", "ranks", "nodes", "neighbours, mean", "most", "halo KiB, mean", "most", "work, most / mean", "nodes, most / mean", "s to deal"],
            rows,
        ),
    ])


def model_section(measured):
    found = model.parameters(measured)
    shown = [[text, number(found[name]), unit] for name, text, unit in model.MEASURED]
    assumed = [[text, number(value), unit] for value, text, unit in model.ASSUMED.values()]
    head = ["unknowns", *(f"{number(ranks, 9)} ranks" for ranks in model.RANKS)]
    rows = [[f"10^{power}", *(model.words(found, 10.0**power, ranks) for ranks in model.RANKS)] for power in model.POWERS]
    where = []
    for power, ranks in model.TOLD:
        parts = model.parts(found, 10.0**power, ranks)
        where.append([f"10^{power}", number(ranks, 9), *(f"{100 * part / sum(parts):.0f} %" for part in parts)])
    return "\n\n".join([
        "## What follows for larger machines",
        "A model, not a measurement. An iteration on N unknowns and P ranks takes",
        "    T = t w/1.78 Σ d s_d n_d/P_d  +  V/V₀ (α v + o m)  +  α c log₂ P  +  B/β",
        "with the time t of an unknown and the imbalance w. Level d, the finest being 1, has n_d = N/4^(d-1) unknowns on P_d ranks, and "
        "an F-cycle visits it d times: 1.78 N unknowns in all. s_d is the slowdown of a full socket: s where all ranks work, "
        "1 + (s - 1) P_d/P where fewer do. v are the waits and m the messages of a rank, which were counted on a small hierarchy: they "
        "grow with the visits V to levels that several ranks share, of which that one had V₀. c are the collectives and B the bytes "
        "of a rank, which grow as the root of N/P: too fast, since part of them goes to levels that are brought together. A "
        "solve, to 1e-8, makes as many iterations as one here, of GMRES, with one cycle each.",
        "Measured (P1):",
        table(["what", "value", "unit"], shown),
        "Assumed, of no machine in particular:",
        table(["what", "value", "unit"], assumed),
        "Seconds for one solve; in brackets GiB on each rank for its unknowns, where a core seldom has more than 4; – where a rank would "
        f"have fewer than {number(model.LEAST, 9)} unknowns. Beside these every rank holds the macro mesh and Γ_C, by the table above "
        "half a KiB for each macro triangle and some 2 KiB for each segment, 3 on rank 0: 0.3 GiB for 100 000 segments.",
        table(head, rows),
        "Where this time goes:",
        table(["unknowns", "ranks", "work on levels of all ranks", "work on levels of fewer ranks", "collectives", "messages"], where),
    ])


NAMESPACES = """## A network with latency on one machine

Where the kernel has `sch_netem` (`tc qdisc add dev lo root netem delay 1ms` says so), two network namespaces, joined by a pair of virtual devices, are two hosts with a network of any latency between them. As root:

```sh
for k in 1 2; do
    ip netns add host$k
    ip link add veth$k type veth peer name bridge$k
    ip link set veth$k netns host$k
    ip netns exec host$k ip address add 10.77.0.$k/24 dev veth$k
    ip netns exec host$k ip link set veth$k up
    ip netns exec host$k ip link set lo up
done
ip link add mezha-bridge type bridge
ip link set mezha-bridge up
for k in 1 2; do
    ip link set bridge$k master mezha-bridge
    ip link set bridge$k up
    ip netns exec host$k tc qdisc add dev veth$k root netem delay 1ms      # the latency, one way
done

# mpirun reaches a host by this instead of ssh: its first word that is no option is the address.
cat > enter <<'SCRIPT'
#!/bin/sh
while [ "${1#-}" != "$1" ]; do shift; done
host=host${1##*.}; shift
exec ip netns exec "$host" sh -c "$*"
SCRIPT
chmod +x enter

ip netns exec host1 mpirun --host 10.77.0.1:1,10.77.0.2:1 -n 2 \\
    --mca plm_rsh_agent "$PWD/enter" --mca orte_keep_fqdn_hostnames 1 \\
    --mca btl tcp,self --mca btl_tcp_if_include 10.77.0.0/24 --mca oob_tcp_if_include 10.77.0.0/24 \\
    target/release/mezha run cases/bars_inclined/even.toml --out out/delayed

for k in 1 2; do ip netns delete host$k; done; ip link delete mezha-bridge
```

`--mca btl tcp,self` keeps the ranks from the shared memory that they have in truth. Runs at delays of 0, 1, 2 and 4 ms give the slope of time over delay. An `sshd` in each namespace does instead of the script."""

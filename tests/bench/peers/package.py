"""Makes the calls of tests/bench/python.rs through the Python package.

Runs one round for each line on standard input. Prints the name of each row and the median time of its calls in
microseconds.
"""

import sys
from time import perf_counter_ns

import drystone as ds

FLOOR = [(-9.0, -1.0), (9.0, -1.0), (9.0, 0.0), (-9.0, 0.0)]


def brick(x, y):
    return [(x, y), (x + 3.0, y), (x + 3.0, y + 1.0), (x, y + 1.0)]


def cells(x, y):
    return [(x, y), (x + 1, y), (x + 2, y)]


def timed(call, *arguments, **keys):
    start = perf_counter_ns()
    call(*arguments, **keys)
    return (perf_counter_ns() - start) / 1e3


def print_median(name, times):
    print(name, sorted(times)[len(times) // 2], sep="\t", flush=True)


def steps(kind, session, calls, polygon, keys):
    rows = {name: [] for name in ("place", "hold", "release", "remove")}
    for _ in range(calls):
        rows["place"].append(timed(session.place, "c", polygon, **keys))
        rows["hold"].append(timed(session.hold, "crane", "c"))
        rows["release"].append(timed(session.release, "crane"))
        rows["remove"].append(timed(session.remove, "c"))
    for name, times in rows.items():
        print_median(f"{name}, {kind}", times)


def built():
    return ds.Scene(friction=0.6).ground(FLOOR).block("a", brick(0.0, 0.0)).block("b", brick(1.0, 1.0))


def one_round(calls):
    free = ds.Scene(friction=0.6).ground(FLOOR).robot("crane")
    free.block("a", brick(0.0, 0.0)).block("b", brick(3.0, 0.0))
    steps("outlines", ds.Session(free), calls, brick(1.0, 1.0), {})
    lattice = ds.Scene(friction=0.6, grid={"kind": "square", "side": 1})
    lattice.ground(cells=[(x, -1) for x in range(-9, 9)]).robot("crane")
    lattice.block("a", cells=cells(0, 0)).block("b", cells=cells(3, 0))
    steps("cells", ds.Session(lattice), calls, None, {"cells": cells(1, 1)})
    scene = built()
    print_median("check a scene of two blocks", [timed(ds.check, scene) for _ in range(calls)])
    print_median("build it and check it", [timed(lambda: ds.check(built())) for _ in range(calls)])


for _ in sys.stdin:
    one_round(int(sys.argv[1]))

"""Compares the verdicts, forces and margins of two programs on random scenes.

    python3 beside.py OLD NEW --scenes 100000 [--first 0] [--margins 20] [--keep folder]

Each number always gives the same scene. The kinds: piles of bricks, towers with pebbles, walls near their limit, walls
with ten robots, arches, and piles without friction; a quarter of all have a slight load. Every scene is given to
`batch` of both programs, and every 20th (--margins) also with --margins. Prints how many scenes differ, and in what;
--keep writes each of them to a file. A margin differs if both programs give a number and these differ by more than
1e-6 of their size.
"""

import argparse
import json
import math
import pathlib
import random
import subprocess
from concurrent.futures import ThreadPoolExecutor

TOLERANCE = 1e-6


def box(x, y, width, height):
    return [[x, y], [x + width, y], [x + width, y + height], [x, y + height]]


def pile(chance):
    """Courses of bricks at random places."""
    bricks, y, reach = [], 0.0, (-2.0, 2.0)
    for _ in range(chance.randint(1, 4)):
        height, x = chance.choice([0.25, 0.5, 0.5, 1.0]), reach[0] + chance.randint(-4, 6) / 8
        left = x
        for _ in range(chance.randint(1, 4)):
            width = chance.choice([0.25, 0.5, 1.0, 1.5])
            bricks.append(box(x, y, width, height))
            x += width + chance.choice([0, 0, 0.125, 0.5])
        reach, y = (left, x), y + height
    return bricks


def pebbles(chance):
    """A tower with stones down to a millionth of a brick on it, whose weights go down to 1e-12."""
    bricks, x = [], 0.0
    for k in range(chance.randint(1, 5)):
        x += chance.randint(-3, 3) / 8
        bricks.append(box(x, float(k), 2.0, 1.0))
    top = float(len(bricks))
    for side in range(chance.randint(1, 2)):
        size, beyond = 2.0 ** -chance.randint(0, 20), chance.choice([0.25, 0.484375, 0.5, 0.515625, 0.75])
        bricks.append(box(x - size * beyond if side else x + 2.0 - size * (1 - beyond), top, size, size))
    return bricks


def wall(chance, columns=None):
    """A wall in running bond, sometimes without one of its bricks."""
    bricks = []
    columns = columns or chance.randint(2, 6)
    for row in range(chance.randint(2, 6)):
        cuts = [float(c) for c in range(columns + 1)]
        if row % 2:
            cuts = [0.0] + [c + 0.5 for c in range(columns)] + [float(columns)]
        bricks += [box(a, 0.5 * row, b - a, 0.5) for a, b in zip(cuts, cuts[1:])]
    if chance.random() < 0.4:
        bricks.pop(chance.randrange(len(bricks)))
    return bricks


def arch(chance):
    """A semicircular arch near its least thickness, 0.1075."""
    stones, thickness = chance.randint(5, 21), chance.choice([0.09, 0.1, 0.105, 0.107, 0.1075, 0.11, 0.15, 0.2])

    def at(radius, k):
        angle = math.pi * k / stones
        return [-radius * math.cos(angle), 0.0 if k in (0, stones) else radius * math.sin(angle)]

    inner, outer = 1 - thickness / 2, 1 + thickness / 2
    return [[at(inner, k), at(inner, k + 1), at(outer, k + 1), at(outer, k)] for k in range(stones)]


KINDS = {
    "pile": pile,
    "pebbles": pebbles,
    "wall near its limit": wall,
    "ten robots": lambda chance: wall(chance, columns=5),
    "arch": arch,
    "without friction": pile,
}


def scene(number):
    """Returns the kind and the scene with this number."""
    chance = random.Random(number)
    kind = list(KINDS)[number % len(KINDS)]
    outlines = KINDS[kind](chance)
    light = kind == "pebbles"
    blocks = []
    for k, outline in enumerate(outlines):
        weight = chance.randint(1, 9)
        if light and chance.random() < 0.5:
            weight *= 10.0 ** -chance.choice([1, 2, 3, 4, 6, 8, 10, 12])
        blocks.append({"id": f"{k}", "polygon": outline, "weight": weight})
    friction = chance.choice([0.05, 0.25, 0.5, 0.7, 1.0, 3.0, round(chance.random(), 3)])
    file = {
        "drystone": 1,
        "friction": 0 if kind == "without friction" else friction,
        "kernel": chance.choice([0, 0, 0, 0.2, 0.25, 1.0]),
        "ground": [{"polygon": box(-50, -1, 100, 1)}],
        "blocks": blocks,
    }
    if kind == "wall near its limit":
        # At the angle of friction a wall begins to slide; some stand and some fall by a very small difference.
        angle = math.atan(file["friction"]) + chance.choice([-1, 1, 0]) * 10.0 ** -chance.choice([1, 2, 4, 6, 8])
        file["gravity"] = [9.81 * math.sin(angle), -9.81 * math.cos(angle)]
    elif chance.random() < 0.2:
        file["gravity"] = chance.choice([[3, -4], [-1, -1], [0.125, -1], [-5, -12]])
    held = chance.sample(range(len(blocks)), min(10, len(blocks))) if kind == "ten robots" else []
    if not held and chance.random() < 0.2:
        held = [chance.randrange(len(blocks))]
    limits = [None, {"force": chance.randint(0, 24) / 2}, {"fx": chance.randint(0, 9), "torque": 1}, {"fy": 2, "fx": 0.5}]
    file["robots"] = [
        {"id": f"r{k}", "holds": f"{block}", **({"limits": limit} if (limit := chance.choice(limits)) else {})}
        for k, block in enumerate(held)
    ]
    loads = []
    if chance.random() < 0.3:
        loads.append({"block": chance.choice(blocks)["id"], "force": [chance.randint(-16, 16) / 4, chance.randint(-16, 4) / 4]})
    if chance.random() < 0.25:
        size = chance.randint(1, 9) * 10.0 ** -chance.randint(4, 9)
        loads.append({"block": chance.choice(blocks)["id"], "force": chance.choice([[size, 0], [-size, 0], [0, size], [size, -size]])})
    file["loads"] = loads
    return kind, file


def answers(program, files, margins):
    command = [program, "batch", "--jobs", "1", "--quiet", "--fields", "verdict,frames.total_force"]
    lines = "".join(json.dumps(file) + "\n" for file in files)
    output = subprocess.run(command + ["--margins"] * margins, input=lines, capture_output=True, text=True, check=False).stdout
    return [json.loads(line) for line in output.splitlines()]


def numbers(value, path=""):
    """Returns the path and the value of each margin of an answer, without mechanisms."""
    if isinstance(value, dict):
        pairs = value.items()
    elif isinstance(value, list):
        pairs = enumerate(value)
    else:
        return {path: value}
    skipped = ("mechanisms", "excluded", "mechanism")
    return {name: v for key, one in pairs if key not in skipped for name, v in numbers(one, f"{path}.{key}").items()}


def differences(old, new):
    """Returns what differs between two answers: a list of (what, old value, new value)."""
    found = []
    before, after = numbers(old), numbers(new)
    for name in sorted(before.keys() | after.keys()):
        a, b = before.get(name), after.get(name)
        if name in (".line", ".file") or a == b:
            continue
        both = isinstance(a, float | int) and isinstance(b, float | int)
        if not both or abs(a - b) > TOLERANCE * max(1.0, abs(a), abs(b)):
            found.append((name.removeprefix(".frames.0."), a, b))
    return found


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("old")
    arguments.add_argument("new")
    arguments.add_argument("--scenes", type=int, default=10_000)
    arguments.add_argument("--first", type=int, default=0)
    arguments.add_argument("--margins", type=int, default=20, metavar="N", help="margins of every Nth scene; 0: of none")
    arguments.add_argument("--keep", type=pathlib.Path, help="a folder for the scenes that differ")
    options = arguments.parse_args()
    verdicts, count, different = {}, {}, 0
    last = options.first + options.scenes
    for start in range(options.first, last, 1000):
        every = range(start, min(start + 1000, last))
        of_margins = [n for n in every if options.margins and n // len(KINDS) % options.margins == 0]
        for chosen, margins in ((every, False), (of_margins, True)):
            made = [scene(number) for number in chosen]
            files = [file for _, file in made]
            with ThreadPoolExecutor(1) as pool:
                old, new = pool.map(lambda program: answers(program, files, margins), (options.old, options.new))
            for number, (kind, file), a, b in zip(chosen, made, old, new, strict=True):
                if not margins:
                    key = kind, a.get("verdict", "refused"), b.get("verdict", "refused")
                    verdicts[key] = verdicts.get(key, 0) + 1
                found = differences(a, b)
                different += bool(found)
                for what, before, after in found:
                    count[what] = count.get(what, 0) + 1
                    print(f"{number} {kind}: {what}: {before} -> {after}", flush=True)
                if found and options.keep:
                    options.keep.mkdir(parents=True, exist_ok=True)
                    (options.keep / f"{number}.json").write_text(json.dumps(file))
    print("| kind | old | new | scenes |\n|---|---|---|---|")
    for (kind, a, b), scenes in sorted(verdicts.items()):
        print(f"| {kind} | {a} | {b} | {scenes} |")
    print(f"{different} answers differ: {count}")


if __name__ == "__main__":
    main()

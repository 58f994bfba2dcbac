"""Writes a corpus of random scenes of ten blocks, one per line. The same seed gives the same corpus.

    python3 examples/cluster/corpus.py 1000000 > corpus.ndjson

One third each of the scenes are piles of randomly shifted bricks, leaning towers and semicircular arches. Some of the
scenes stand and some fall. With --broken N, every Nth line is truncated, as may happen in a real corpus.
"""

import argparse
import json
import math
import random
import sys

BLOCKS = 10


def rectangle(x, y, width, height):
    return [[round(a, 3), round(b, 3)] for a, b in
            [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]]


def pile(generator):
    """Returns rows of 4, 3, 2 and 1 bricks. Each brick lies on about two bricks of the row below."""
    shift = generator.choice([0.1, 0.2, 0.4])
    blocks = []
    for row in range(4):
        left = 0.5 * row
        for k in range(4 - row):
            x = left + 1.2 * k + round(generator.uniform(0, shift), 3)
            blocks.append(rectangle(x, 0.5 * row, 0.8, 0.5))
    return blocks


def tower(generator):
    """Returns a tower of ten bricks, each shifted relative to the brick below it."""
    lean = generator.uniform(0, 0.12)
    x = 0.0
    blocks = []
    for k in range(BLOCKS):
        blocks.append(rectangle(x, 0.4 * k, 1.0, 0.4))
        x += round(lean + generator.uniform(-0.1, 0.1), 3)
    return blocks


def arch(generator):
    """Returns ten voussoirs of a semicircular arch with a random thickness.

    An arch of many voussoirs falls if it is thinner than about 0.1075 of its radius (Milankovitch).
    """
    thickness = generator.uniform(0.08, 0.2)
    inner, outer = 1 - thickness / 2, 1 + thickness / 2

    def at(radius, k):
        angle = math.pi * k / BLOCKS
        return [round(-radius * math.cos(angle), 6), round(radius * math.sin(angle), 6)]

    return [[at(inner, k), at(inner, k + 1), at(outer, k + 1), at(outer, k)] for k in range(BLOCKS)]


def scene(number, seed):
    generator = random.Random(seed * 1_000_003 + number)
    make = [pile, tower, arch][number % 3]
    return {
        "drystone": 1,
        "title": f"scene {number}",
        "friction": generator.choice([0.4, 0.6, 0.8]),
        "ground": [{"polygon": [[-9, -1], [9, -1], [9, 0], [-9, 0]]}],
        "blocks": [{"polygon": polygon, "density": 1000} for polygon in make(generator)],
    }


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("scenes", type=int)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--broken", type=int, default=0, metavar="N")
    options = arguments.parse_args()
    for number in range(1, options.scenes + 1):
        line = json.dumps(scene(number, options.seed), separators=(",", ":"))
        if options.broken and number % options.broken == 0:
            line = line[: len(line) // 2]
        sys.stdout.write(line + "\n")


if __name__ == "__main__":
    main()

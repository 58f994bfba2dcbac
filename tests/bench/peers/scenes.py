"""Walls, arches and stacks for which it is known whether they stand or fall."""

import math


def scene(title, blocks, gravity=(0, -9.81), friction=0.7):
    far = max([9999] + [abs(x) + 1 for polygon in blocks for x, _ in polygon])
    return {
        "drystone": 1,
        "title": title,
        "gravity": list(gravity),
        "friction": friction,
        "contact_tolerance": 1e-6,
        "ground": [{"polygon": [[-far, -1], [far, -1], [far, 0], [-far, 0]]}],
        "blocks": [{"id": f"b{k}", "polygon": polygon, "density": 1000} for k, polygon in enumerate(blocks)],
    }


def rectangle(x, y, width, height):
    return [[x, y], [x + width, y], [x + width, y + height], [x, y + height]]


def turned(degrees):
    a = math.radians(degrees)
    return (9.81 * math.sin(a), -9.81 * math.cos(a))


def wall(blocks, stands):
    """A wall in running bond with half bricks at the ends of every second row.

    With gravity turned by 40 degrees it slides, because tan 40° > 0.7."""
    rows = max(2, round(math.sqrt(blocks / 2.5)))
    columns = max(2, round((blocks - rows // 2) / rows))
    bricks = []
    for row in range(rows):
        cuts = [float(c) for c in range(columns + 1)]
        if row % 2:
            cuts = [0.0] + [c + 0.5 for c in range(columns)] + [float(columns)]
        bricks += [rectangle(a, 0.5 * row, b - a, 0.5) for a, b in zip(cuts, cuts[1:])]
    gravity = (0, -9.81) if stands else turned(40)
    return scene(f"wall of {len(bricks)}", bricks, gravity)


def arch(blocks, stands):
    """A semicircular arch of radius 1.

    A circular arch needs a thickness of 0.1075 of its radius (Milankovitch); an arch of finitely many stones needs
    slightly less. With ten stones or more it falls at a thickness of 0.05."""
    thickness = 0.2 if stands else 0.05
    inner, outer = 1 - thickness / 2, 1 + thickness / 2

    def at(radius, k):
        angle = math.pi * k / blocks
        return [-radius * math.cos(angle), 0.0 if k in (0, blocks) else radius * math.sin(angle)]

    stones = [[at(inner, k), at(inner, k + 1), at(outer, k + 1), at(outer, k)] for k in range(blocks)]
    return scene(f"arch of {blocks}", stones)


def stack(blocks, stands):
    """A stack of n bricks of length 1, each shifted by the same distance s.

    The centre of gravity of all bricks above the lowest lies n/2 * s from the middle of the lowest. So the stack
    stands up to s = 1/n."""
    shift = (0.9 if stands else 1.1) / blocks
    bricks = [rectangle(shift * k, 0.25 * k, 1.0, 0.25) for k in range(blocks)]
    return scene(f"stack of {blocks}", bricks)


def separate(blocks, stands):
    """Separate towers of ten bricks. If the structure should fall, only the last tower does."""
    bricks = []
    towers = max(1, blocks // 10)
    for tower in range(towers):
        shift = 0.11 if not stands and tower == towers - 1 else 0.05
        bricks += [rectangle(4.0 * tower + shift * k, 0.25 * k, 1.0, 0.25) for k in range(10)]
    return scene(f"{towers} towers", bricks)


KINDS = {"wall": wall, "arch": arch, "stack": stack}

"""Writes the scenes of the gallery in the README, and draws their figures.

    python3 examples/gallery.py            # writes the scenes
    python3 examples/gallery.py drystone   # also draws the figures, with the program of this name

Lengths are in metres, forces in newtons. The structures are invented, but have the proportions of real buildings.
"""
import json
import math
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent / "assets" / "gallery"
# The options of `drystone render`. The figures show the flow of forces.
LOOK = ["--kind", "flow", "--no-key", "--width-mm", "100", "--dpi", "120", "--no-source"]


def box(left, bottom, right, top):
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def mirrored(polygon):
    return [(-x, y) for x, y in reversed(polygon)]


class Scene:
    def __init__(self, title, ground, **more):
        self.file = {"drystone": 1, "title": title, **more, "ground": [{"polygon": rounded(p)} for p in ground], "blocks": []}

    def add(self, name, polygon):
        self.file["blocks"].append({"id": name, "polygon": rounded(polygon)})

    def both(self, name, polygon):
        """Adds a block and its mirror image about x = 0, with the suffixes e and w in their names."""
        self.add(name + "w", mirrored(polygon))
        self.add(name + "e", polygon)

    def load(self, block, at, force):
        self.file.setdefault("loads", []).append({"block": block, "at": rounded([at])[0], "force": list(force)})

    def text(self):
        """Returns the scene as JSON, with one line for each block."""
        more = {key: value for key, value in self.file.items() if key != "blocks"}
        blocks = ",\n".join("  " + json.dumps(block) for block in self.file["blocks"])
        return f'{json.dumps(more)[:-1]}, "blocks": [\n{blocks}\n] }}\n'


def rounded(polygon):
    return [[round(x + 0.0, 6) + 0.0, round(y + 0.0, 6) + 0.0] for x, y in polygon]


def courses(scene, both, name, left, right, bottom, top, count):
    """Adds a stack of `count` blocks of equal height. If `both` is true, also adds the mirror images of the blocks."""
    height = (top - bottom) / count
    for i in range(count):
        polygon = box(left, bottom + i * height, right, bottom + (i + 1) * height)
        (scene.both if both else scene.add)(f"{name}{i + 1}", polygon)


def polar(centre, radius, degrees):
    x, y = centre
    return (x + radius * math.cos(math.radians(degrees)), y + radius * math.sin(math.radians(degrees)))


def voussoir(centre, inner, outer, start, end, curved=True):
    """Returns the outline of a voussoir: the part of a ring between the angles `start` and `end`, in degrees.

    If `curved` is true, each curved side has an additional corner in the middle.
    """
    middle = (start + end) / 2
    below = [polar(centre, inner, a) for a in ([start, middle, end] if curved else [start, end])]
    above = [polar(centre, outer, a) for a in ([end, middle, start] if curved else [end, start])]
    return below[::-1] + above[::-1]


def aqueduct():
    scene = Scene("Aqueduct of two tiers", [box(-2, -1, 23, 0)], density=2300, friction=0.65)
    pitch, pier, ring, bays = 7.0, 1.4, 0.55, 3
    # The rings of two neighbouring bays stand on one pier. The lowest course fills the gap between their feet.
    inner = (pitch - pier) / 2
    outer = inner + ring
    level = 0.0
    for tier, height in enumerate([4.0, 2.4]):
        names = "AB"[tier]
        for p in range(bays + 1):
            x = p * pitch
            courses(scene, False, f"{names}{p}p", x - pier / 2, x + pier / 2, level, level + height, 2)
        spring, count = level + height, 11
        angles = [180 * k / count for k in range(count + 1)]
        for bay in range(bays):
            centre = ((bay + 0.5) * pitch, spring)
            for k in range(count):
                scene.add(f"{names}{bay}v{k + 1}", voussoir(centre, inner, outer, angles[k], angles[k + 1], curved=False))
        # Courses of stones fill the space between the rings of neighbouring bays. The top of each course is at the
        # height of a corner of the extrados.
        half = count // 2
        backs = [(outer * math.cos(math.radians(a)), spring + outer * math.sin(math.radians(a))) for a in angles[: half + 1]]
        for p in range(bays + 1):
            x = p * pitch
            for k in range(half):
                (low, y0), (high, y1) = backs[k], backs[k + 1]
                left = [x - pitch / 2 + low, x - pitch / 2 + high] if p > 0 else [x - pier / 2] * 2
                right = [x + pitch / 2 - low, x + pitch / 2 - high] if p < bays else [x + pier / 2] * 2
                scene.add(f"{names}{p}s{k + 1}", [(left[0], y0), (right[0], y0), (right[1], y1), (left[1], y1)])
        top = backs[-1][1]
        joints = [pitch * p + side * pitch / 4 for p in range(bays + 1) for side in (-1, 1)][1:-1]
        if tier == 1:
            joints = [pitch / 2 * k for k in range(1, 2 * bays)]
        ends = [-pier / 2, *joints, bays * pitch + pier / 2]
        for k in range(len(ends) - 1):
            scene.add(f"{names}c{k + 1}", box(ends[k], top, ends[k + 1], top + 0.6))
        level = top + 0.6
    return scene


def gabled_wall():
    scene = Scene("Gabled wall with a door and a window", [box(-1.5, -0.6, 10.5, 0)], density=2000, friction=0.6, thickness=0.4)
    width, course, stone = 9.0, 0.4, 0.9
    eaves, rise, rows = 3.2, 4.4, 19
    openings = [(3.8, 5.2, 0, 6), (4.0, 5.0, 9, 12)]  # left, right, first course of the opening, first course above it

    def ends(y):
        """Returns the x coordinates of the left and the right end of the wall at the height y."""
        inset = max(0.0, y - eaves) / rise * width / 2
        return inset, width - inset

    for row in range(rows):
        low, high = row * course, (row + 1) * course
        parts = [(ends(low), ends(high))]
        for left, right, first, above in openings:
            if first <= row < above:
                (l0, r0), (l1, r1) = parts.pop()
                parts += [((l0, left), (l1, left)), ((right, r0), (right, r1))]
        for part, ((l0, r0), (l1, r1)) in enumerate(parts):
            joints = [k * stone / 2 for k in range(1, 21) if k % 2 == row % 2]
            for left, right, _, above in openings:
                if row == above:  # this course contains the lintel of the opening
                    joints = [j for j in joints if not left - 0.75 < j < right + 0.75] + [left - 0.4, right + 0.4]
            joints = sorted(j for j in joints if l1 + 0.3 < j < r1 - 0.3)
            bottoms, tops = [l0, *joints, r0], [l1, *joints, r1]
            for k in range(len(bottoms) - 1):
                polygon = [(bottoms[k], low), (bottoms[k + 1], low), (tops[k + 1], high)]
                if tops[k + 1] - tops[k] > 1e-9:
                    polygon.append((tops[k], high))
                scene.add(f"{row + 1}{'ab'[part] if len(parts) > 1 else ''}-{k + 1}", polygon)
    # The loads from two purlins on each slope and from the ridge of the roof.
    for y, force in [(4.4, 4000), (6.0, 4000)]:
        for x, side in zip(ends(y), (1, -1)):
            at = (x + 0.25 * side, y)
            scene.load(block_at(scene, at), at, (0, -force))
    scene.load(block_at(scene, (4.5, 7.4)), (4.5, 7.5), (0, -3000))
    return scene


def block_at(scene, point):
    """Returns the name of the highest block that is below the point or contains it."""
    x, y = point
    under = [b for b in scene.file["blocks"] if min(p[0] for p in b["polygon"]) <= x <= max(p[0] for p in b["polygon"])]
    return max((b for b in under if min(p[1] for p in b["polygon"]) < y - 1e-6), key=lambda b: min(p[1] for p in b["polygon"]))["id"]


def flyer(wall, pier, seat, low, high, centre, count):
    """Returns the stones of a flying buttress between a pier and a wall.

    The lower edge of the flying buttress is an arc, and the upper edge is straight. `wall` and `pier` are the x
    coordinates of the faces of the wall and of the pier. The lowest stone stands on a seat in front of the pier; `seat`
    is the length of this seat. `low` and `high` are the heights of the lower and of the upper edge, each at the pier
    and at the wall. The centre of the arc is `centre` metres inside the wall.
    """
    (pier_low, wall_low), (pier_high, wall_high) = low, high
    x0, x1 = centre, centre + pier - seat - wall
    centre_y = (x1 * x1 - x0 * x0 + pier_low * pier_low - wall_low * wall_low) / (2 * (pier_low - wall_low))
    radius = math.hypot(x0, wall_low - centre_y)
    start = math.atan2(pier_low - centre_y, x1)
    end = math.atan2(wall_low - centre_y, x0)
    below, above = [], []
    for k in range(count + 1):
        share = k / count
        angle = start + (end - start) * share
        below.append((wall + radius * math.cos(angle) - x0, centre_y + radius * math.sin(angle)))
        above.append((pier + (wall - pier) * share, pier_high + (wall_high - pier_high) * share))
    stones = [[below[k], above[k], above[k + 1], below[k + 1]] for k in range(count)]
    stones[0].insert(1, (pier, pier_low))
    return stones


def flying_buttress():
    scene = Scene("Flying buttress and the push of a vault", [box(-1.5, -1, 9.5, 0)], density=2200, friction=0.7)
    courses(scene, False, "wall", 0, 1.2, 0, 12, 10)
    courses(scene, False, "pier", 5.6, 7.8, 0, 6, 5)
    scene.add("seat", [(5.4, 6), (7.8, 6), (7.8, 6.8), (5.0, 6.8), (5.0, 6.5)])
    courses(scene, False, "head", 5.6, 7.8, 6.8, 9.4, 2)
    for k, stone in enumerate(flyer(1.2, 5.6, 0.6, (6.8, 9.4), (8.4, 10.6), 0.6, 6)):
        scene.add(f"f{k + 1}", stone)
    scene.add("pinnacle", [(5.9, 9.4), (7.5, 9.4), (6.7, 13.2)])
    scene.load("wall9", (0, 10.0), (26000, -18000))
    scene.load("wall10", (0.6, 12), (0, -30000))
    return scene


def corbelled_vault():
    scene = Scene("Corbelled vault", [box(-6, -0.8, 6, 0)], density=2400, friction=0.6)
    count, height, long = 11, 0.55, 2.6
    for k in range(count):
        inside = 2.9 * math.cos(0.5 * math.pi * (k / count) ** 1.25) ** 0.8
        scene.both(f"{k + 1}", box(inside, k * height, inside + long - 0.06 * k, (k + 1) * height))
    scene.add("cap", box(-1.2, count * height, 1.2, count * height + 0.6))
    return scene


def cathedral():
    scene = Scene("Section of a Gothic church", [box(-15.5, -1.2, 15.5, 0)], density=2200, friction=0.7)
    aisle, spring = 5.0, 13.0
    # The piers of the nave, from below: the parts up to the vault of the aisle and up to the vault of the nave, and the
    # wall above.
    courses(scene, True, "n", 4.6, 6.65, 0, aisle, 4)
    courses(scene, True, "m", 4.6, 6.2, aisle, spring, 7)
    courses(scene, True, "w", 5.05, 6.2, spring, 18, 4)
    # The outer buttresses with pinnacles.
    courses(scene, True, "o", 10.75, 13.6, 0, aisle, 4)
    courses(scene, True, "b", 11.2, 13.6, aisle, 9.6, 4)
    scene.both("seat", [(11.0, 9.6), (13.6, 9.6), (13.6, 10.4), (10.6, 10.4), (10.6, 10.1)])
    courses(scene, True, "u", 11.2, 13.6, 10.4, 13.4, 3)
    scene.both("t", box(11.5, 13.4, 13.3, 14.4))
    scene.both("p", [(11.6, 14.4), (13.2, 14.4), (12.4, 18.2)])
    # The vault of the nave: stones with horizontal beds at the feet of the vault, a pointed ring, and a keystone.
    centre, inner, outer = (-2.3, spring), 6.9, 7.35
    foot, key, count = 22.0, 66.0, 7
    back, cut = 5.05, 11.0
    side = math.sin(math.radians(cut)) * inner + spring
    scene.both("h1", [polar(centre, inner, cut * k / 2) for k in (0, 1, 2)][::-1] + [(back, spring), (back, side)])
    head = polar(centre, outer, foot)
    inside = [polar(centre, inner, cut + (foot - cut) * k / 2) for k in (2, 1, 0)]
    scene.both("h2", inside + [(back, side), (back, head[1]), head])
    for k in range(count):
        angles = [foot + (key - foot) * j / count for j in (k, k + 1)]
        scene.both(f"v{k + 1}", voussoir(centre, inner, outer, *angles))
    apex = [(0, spring + math.sqrt(r * r - centre[0] ** 2)) for r in (inner, outer)]
    right = [polar(centre, r, key) for r in (inner, outer)]
    left = [(-x, y) for x, y in right]
    scene.add("key", [right[0], right[1], apex[1], left[1], left[0], apex[0]])
    # The vaults of the aisles.
    middle, span = (6.65 + 10.75) / 2, 10.75 - 6.65
    shift = 0.25 * span
    centre, inner = (middle - shift, aisle), span / 2 + shift
    outer = inner + 0.45
    limit = math.degrees(math.acos(shift / inner)) - 6
    for k in range(4):
        stone = voussoir(centre, inner, outer, limit * k / 4, limit * (k + 1) / 4)
        scene.both(f"x{k + 1}", stone)
        scene.both(f"y{k + 1}", [(2 * middle - x, y) for x, y in reversed(stone)])
    apex = [(middle, aisle + math.sqrt(r * r - shift * shift)) for r in (inner, outer)]
    right = [polar(centre, r, limit) for r in (inner, outer)]
    left = [(2 * middle - x, y) for x, y in right]
    scene.both("k", [right[0], right[1], apex[1], left[1], left[0], apex[0]])
    for k, stone in enumerate(flyer(6.2, 11.2, 0.6, (10.4, 13.8), (12.4, 15.4), 0.6, 6)):
        scene.both(f"f{k + 1}", stone)
    # The loads of the timber roof on the walls.
    scene.load("w4w", (-5.6, 18), (0, -45000))
    scene.load("w4e", (5.6, 18), (0, -45000))
    return scene


STRUCTURES = {
    "aqueduct": aqueduct,
    "cathedral": cathedral,
    "corbelled-vault": corbelled_vault,
    "flying-buttress": flying_buttress,
    "gabled-wall": gabled_wall,
}


def main():
    FOLDER.mkdir(exist_ok=True)
    for name, structure in STRUCTURES.items():
        (FOLDER / f"{name}.json").write_text(structure().text(), encoding="utf-8")
    for program in sys.argv[1:2]:
        for name in STRUCTURES:
            scene, picture = (str(FOLDER / f"{name}.{ending}") for ending in ("json", "png"))
            subprocess.run([program, "render", scene, *LOOK, "-o", picture], check=True)


if __name__ == "__main__":
    main()

"""Walls just short of the tilt at which they fall, and just past it: verdict, processor time, and the rung that decided.

    cargo build --release && python3 tests/bench/peers/edge.py target/release/drystone

The tilt comes from `check --margins tilt`; each wall is then turned by it and a little more or less.
"""

import json
import pathlib
import resource
import subprocess
import sys
import tempfile

import scenes

# Bricks to a course, and courses.
WALLS = [(20, 20), (30, 30), (45, 44)]
# Differences from the tilt, as fractions of it; positive ones are beyond the limit.
BESIDE = [1e-3, 1e-4, 1e-5, -1e-5, -1e-4]


def wall(columns, rows):
    bricks = []
    for row in range(rows):
        cuts = [2.0 * column for column in range(columns + 1)]
        if row % 2:
            cuts = [0.0] + [2.0 * column + 1 for column in range(columns)] + [2.0 * columns]
        bricks += [scenes.rectangle(a, 1.0 * row, b - a, 1.0) for a, b in zip(cuts, cuts[1:])]
    return scenes.scene(f"wall of {len(bricks)}", bricks)


def asked(binary, path, scene, *options):
    path.write_text(json.dumps(scene))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    told = subprocess.run([binary, "check", "--json", *options, path], capture_output=True, check=False).stdout
    return json.loads(told)["frames"][0], resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main():
    binary = sys.argv[1]
    print("| bricks | beyond the limit by | verdict | failures | decided by | iterations | s | relative to the upright wall |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "wall.json"
        for columns, rows in WALLS:
            scene = wall(columns, rows)
            _, upright = asked(binary, path, scene)
            frame, _ = asked(binary, path, scene, "--margins", "tilt")
            edge = frame["margins"]["tilt"]["right"]
            for beside in BESIDE:
                scene["gravity"] = list(scenes.turned(edge * (1 + beside)))
                frame, seconds = asked(binary, path, scene)
                cells = [len(scene["blocks"]), f"{beside:.0e}", frame["verdict"], len(frame["failures"]), frame["solve"]["method"]]
                cells += [frame["solve"]["iterations"], f"{seconds:.2f}", f"{seconds / upright:.1f}"]
                print("|", " | ".join(str(cell) for cell in cells), "|", flush=True)


if __name__ == "__main__":
    main()

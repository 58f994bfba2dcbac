"""Checks walls whose gravity is tilted by slightly less or slightly more than the limit at which they fall.

    cargo build --release && python3 tests/bench/peers/edge.py target/release/drystone

The limit comes from `check --margins tilt`. The table lists the verdict, the processor time, and the method that
decided.
"""

import json
import pathlib
import resource
import subprocess
import sys
import tempfile

import scenes

# Bricks per course, and number of courses.
WALLS = [(20, 20), (30, 30), (45, 44)]
# Differences from the limit, as fractions of it. Positive differences are beyond the limit.
DIFFERENCES = [1e-3, 1e-4, 1e-5, -1e-5, -1e-4]


def wall(columns, rows):
    bricks = []
    for row in range(rows):
        cuts = [2.0 * column for column in range(columns + 1)]
        if row % 2:
            cuts = [0.0] + [2.0 * column + 1 for column in range(columns)] + [2.0 * columns]
        bricks += [scenes.rectangle(a, 1.0 * row, b - a, 1.0) for a, b in zip(cuts, cuts[1:])]
    return scenes.scene(f"wall of {len(bricks)}", bricks)


def check(binary, path, scene, *options):
    """Checks a scene. Returns its first frame and the processor time in seconds."""
    path.write_text(json.dumps(scene))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    output = subprocess.run([binary, "check", "--json", *options, path], capture_output=True, check=False).stdout
    return json.loads(output)["frames"][0], resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main():
    binary = sys.argv[1]
    print("| bricks | beyond the limit by | verdict | failures | decided by | iterations | s | relative to the upright wall |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "wall.json"
        for columns, rows in WALLS:
            scene = wall(columns, rows)
            _, upright = check(binary, path, scene)
            frame, _ = check(binary, path, scene, "--margins", "tilt")
            limit = frame["margins"]["tilt"]["right"]
            for difference in DIFFERENCES:
                scene["gravity"] = list(scenes.turned(limit * (1 + difference)))
                frame, seconds = check(binary, path, scene)
                cells = [len(scene["blocks"]), f"{difference:.0e}", frame["verdict"], len(frame["failures"])]
                cells += [frame["solve"]["method"]]
                cells += [frame["solve"]["iterations"], f"{seconds:.2f}", f"{seconds / upright:.1f}"]
                print("|", " | ".join(str(cell) for cell in cells), "|", flush=True)


if __name__ == "__main__":
    main()

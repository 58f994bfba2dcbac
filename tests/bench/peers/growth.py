"""How processor time and memory of checking and drawing grow with the number of blocks.

    python3 growth.py ../../../target/release/drystone --sizes 100,1000,10000

The time is the processor time of the whole process, the minimum of --rounds runs. The memory is its peak. The
exponent p means that the time grew with the p-th power of the number of blocks since the previous size. For the time
of each stage, run `cargo bench --bench large`.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import tempfile

import scenes

KINDS = {"arch": scenes.arch, "towers of ten": scenes.separate, "wall": scenes.wall}


def spent(command):
    """Runs a command. Returns its processor time in seconds and its peak memory in megabytes."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0, f"{command} ended with {process.returncode}"
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("drystone")
    arguments.add_argument("--sizes", default="100,1000,10000")
    arguments.add_argument("--rounds", type=int, default=3)
    wanted = arguments.parse_args()
    print("| structure | blocks | check, s | exponent | MB | check and draw, s | MB |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        path, picture = pathlib.Path(folder) / "scene.json", pathlib.Path(folder) / "scene.svg"
        for kind, make in KINDS.items():
            before = None
            for size in (int(size) for size in wanted.sizes.split(",")):
                scene = make(size, True)
                path.write_text(json.dumps(scene))
                blocks = len(scene["blocks"])
                check = min(spent([wanted.drystone, "check", "--quiet", path]) for _ in range(wanted.rounds))
                draw = min(spent([wanted.drystone, "render", "--quiet", path, "-o", picture]) for _ in range(wanted.rounds))
                exponent = ""
                if before:
                    exponent = f"{math.log(check[0] / before[1]) / math.log(blocks / before[0]):.2f}"
                before = (blocks, check[0])
                print(f"| {kind} | {blocks} | {check[0]:.3g} | {exponent} | {check[1]:.0f} | {draw[0]:.3g} | {draw[1]:.0f} |", flush=True)


if __name__ == "__main__":
    main()

"""Checks many scenes from Python with one process of drystone. Each scene and each result is one line of JSON."""
import json
import subprocess

process = subprocess.Popen(["drystone", "batch", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def check(scene):
    """The result of one scene."""
    process.stdin.write(json.dumps(scene) + "\n")
    process.stdin.flush()
    return json.loads(process.stdout.readline())


if __name__ == "__main__":
    ground = [{"polygon": [[-5, -1], [5, -1], [5, 0], [-5, 0]]}]
    for lean in [0.1, 0.4, 0.6]:
        blocks = [{"polygon": [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]], "weight": 10} for x, y in [(0, 0), (lean, 1)]]
        print(lean, check({"drystone": 1, "ground": ground, "blocks": blocks})["verdict"])

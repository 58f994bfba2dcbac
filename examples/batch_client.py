"""Checks many scenes from Python with a single process of `drystone batch`.

Each scene is sent to the process as one line of JSON, and each result is read as one line of JSON.
"""
import json
import subprocess

process = subprocess.Popen(["drystone", "batch", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def check(scene):
    """Returns the result of one scene, a dict with the keys of a scene file."""
    process.stdin.write(json.dumps(scene) + "\n")
    process.stdin.flush()
    return json.loads(process.stdout.readline())


if __name__ == "__main__":
    ground = [{"polygon": [[-5, -1], [5, -1], [5, 0], [-5, 0]]}]
    for lean in [0.1, 0.4, 0.6]:
        blocks = [{"polygon": [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]], "weight": 10} for x, y in [(0, 0), (lean, 1)]]
        print(lean, check({"drystone": 1, "ground": ground, "blocks": blocks})["verdict"])

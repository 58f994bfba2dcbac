"""Checks many scenes from Python with a single process of `drystone batch`.

Each scene is sent to the process as one line of JSON, and each result is read as one line of JSON. A scene that is not
valid has a result too: its problems.
"""
import json
import subprocess

process = subprocess.Popen(["drystone", "batch", "-", "--fields", "verdict,frames.robots"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def check(scene):
    """Returns the result of one scene, a dict with the keys of a scene file."""
    process.stdin.write(json.dumps(scene) + "\n")
    process.stdin.flush()
    return json.loads(process.stdout.readline())


if __name__ == "__main__":
    ground = [{"polygon": [[-5, -1], [5, -1], [5, 0], [-5, 0]]}]
    robots = [{"id": "arm", "holds": "2"}]
    # The last block lies in the first one.
    for lean, height in [(0.1, 1), (0.4, 1), (0.6, 1), (0.6, 0)]:
        blocks = [
            {"polygon": [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]], "weight": 10} for x, y in [(0, 0), (lean, height)]
        ]
        scene = {"drystone": 1, "ground": ground, "blocks": blocks}
        answer = check(scene)
        if "problems" in answer:
            print(lean, "; ".join(problem["message"] for problem in answer["problems"]))
            continue
        held = check({**scene, "robots": robots})["frames"][0]["robots"][0]
        print(lean, answer["verdict"], "the arm exerts", held["force"], "N")

"""The environment and the notebook of the examples."""

import ast
import importlib.util
import json
import os
import shutil
import subprocess
import sys

from conftest import ROOT, needed


def test_the_environment_builds_an_arch():
    spec = importlib.util.spec_from_file_location("gym_arch", ROOT / "examples/gym_arch.py")
    gym_arch = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(gym_arch)
    env = gym_arch.ArchEnv(5)
    observation, _ = env.reset()
    assert sum(observation) == 0
    # Both robots work inwards from the springings; the keystone joins the halves.
    total, done = 0.0, False
    for action in (0, 10, 9, 11, 1, 8, 10, 2):
        _, reward, done, _, _ = env.step(action)
        total += reward
        if done:
            break
    assert (total, done) != (0.0, False)
    assert "<svg" in env.render()
    assert env.step(99)[1] == -1.0
    needed("scipy")
    plays = [gym_arch.played(gym_arch.ArchEnv(7, solver), 0.5, seed=3)[2] for solver in ("drystone", "highs")]
    count = min(map(len, plays))
    assert count > 10 and plays[0][:count] == plays[1][:count]


def test_the_notebook_runs(tmp_path, monkeypatch):
    for name in ("numpy", "pandas", "matplotlib"):
        needed(name)
    import matplotlib

    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    cells = json.loads((ROOT / "examples/drystone.ipynb").read_text(encoding="utf-8"))["cells"]
    names, shown = {}, 0
    for cell in cells:
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, "cell", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
            html = getattr(value, "_repr_html_", None)
            if html is not None:
                assert len(html()) > 100
                shown += 1
    assert shown >= 4


def test_the_scenes_of_the_gallery_are_those_of_its_script():
    spec = importlib.util.spec_from_file_location("gallery", ROOT / "examples/gallery.py")
    gallery = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(gallery)
    for name, structure in gallery.STRUCTURES.items():
        written, ours = ((ROOT / f"assets/gallery/{name}.json").read_text(encoding="utf-8"), structure().text())
        assert json.loads(written) == json.loads(ours), name


def test_the_client_of_batch_shows_forces_and_problems(tmp_path):
    program = tmp_path / "drystone"
    program.write_text(f'#!/bin/sh\nexec {sys.executable} -m drystone "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    path = os.pathsep.join([str(tmp_path), os.environ["PATH"]])
    if os.name == "nt" or not shutil.which("sh"):
        return
    words = [sys.executable, str(ROOT / "examples/batch_client.py")]
    lines = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "PATH": path}, check=True).stdout.splitlines()
    assert [line.split()[1] for line in lines[:3]] == ["stable", "stable", "unstable"]
    assert lines[2].endswith(" N") and "overlap by 0.4 m" in lines[3]

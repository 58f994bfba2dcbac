"""The plug-in of pytest."""

import os
import subprocess
import sys

TEST = """
import drystone as ds

def scene(weight):
    return ds.Scene(friction=0.6).ground([(-9, -1), (9, -1), (9, 0), (-9, 0)]).block("a", [(0, 0), (3, 0), (3, 1), (0, 1)], weight=weight)

def test_block(drystone_snapshot):
    drystone_snapshot(ds.check(scene(WEIGHT)))
    drystone_snapshot(ds.check(scene(7)), "se/ven")
"""


def run(folder, weight, *options, ci=False):
    (folder / "test_it.py").write_text(TEST.replace("WEIGHT", str(weight)))
    kept = {name: value for name, value in os.environ.items() if name not in ("CI", "UPDATE_SNAPSHOTS")}
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *options, str(folder)]
    done = subprocess.run(words, env=kept | ({"CI": "1"} if ci else {}), cwd=folder, capture_output=True, text=True)
    return done.returncode, done.stdout


def test_references_are_written_compared_and_accepted(tmp_path):
    code, out = run(tmp_path, 5)
    assert code == 1 and "no reference exists yet" in out and "again with --drystone-accept" in out
    assert run(tmp_path, 5, "--drystone-accept", ci=True)[0] == 1
    assert run(tmp_path, 5, "--drystone-accept")[0] == 0
    names = sorted(path.name for path in (tmp_path / "snapshots" / "test_it").iterdir())
    assert names == [f"{name}.{end}" for name in ("se-ven", "test_block") for end in ("png", "svg", "txt")]
    assert run(tmp_path, 5, ci=True)[0] == 0
    code, out = run(tmp_path, 6)
    assert code == 1 and "block a: weight 5 → 6 N" in out, out
    assert (tmp_path / "snapshots" / "test_it" / "test_block.diff.png").exists()
    assert run(tmp_path, 6, "--drystone-accept")[0] == run(tmp_path, 6)[0] == 0
    assert len(list((tmp_path / "snapshots" / "test_it").iterdir())) == 6

"""Results: attributes, tables, JSON."""

import copy
import hashlib
import json
import math
import pickle
import subprocess
import sys

import pytest
from conftest import FLOOR, ROOT, brick, needed

import drystone as ds


def program(*words, **options):
    return subprocess.run([sys.executable, "-m", "drystone", *map(str, words)], capture_output=True, text=True, **options)


def test_to_dict_is_what_the_program_prints():
    path = ROOT / "assets/thesis/figure-4.json"
    printed = program("check", "--json", "--no-timing", "--margins=friction,tilt", "--wedging", path)
    result = ds.check(path, margins=["friction", "tilt"], wedging=True)
    assert result.to_dict(timing=False) == json.loads(printed.stdout)
    assert result.to_json(timing=False) == printed.stdout
    assert "seconds" in json.dumps(result.to_dict())


def test_sensitivities_are_those_of_the_program(steps):
    path = ROOT / "assets/starter.json"
    printed = program("check", "--json", "--no-timing", "--sensitivity=load_factor", path)
    result = ds.check(path, sensitivity="load_factor")
    assert result.to_json(timing=False) == printed.stdout
    found = result.frames[-1].sensitivity
    assert found.parameter == "load_factor"
    assert all(end.weights for end in found.ends)
    many = ds.check_many([steps], sensitivity="friction")
    assert many[0].frames[0].sensitivity.parameter == "friction"
    with pytest.raises(ds.DrystoneError, match='"friction" or "kernel", found "robots"'):
        ds.check(path, sensitivity="robots")


def test_certificates_are_those_of_the_program(steps, tmp_path):
    path, proof, scene = ROOT / "assets/starter.json", tmp_path / "proof.json", tmp_path / "scene.json"
    program("check", "--margins", "--certificate", proof, path)
    assert ds.check(path, margins=True).certificate() == proof.read_text(encoding="utf-8")
    steps.save(scene)
    proof.write_text(ds.check(steps).certificate(), encoding="utf-8")
    assert program("verify", proof, scene).stdout.count("exactly") == 3
    session = ds.Session(ROOT / "assets/certificate/stands.json")
    result = session.check()
    known = hashlib.sha256(result.scene.to_json().encode()).hexdigest()
    assert json.loads(result.certificate())["scene_sha256"] == known


def test_attributes_mirror_the_result(steps):
    result = ds.check(steps)
    found = result.to_dict()
    assert (result.stands, result.verdict) == (False, "unstable")
    assert [frame.verdict for frame in result.frames] == [frame["verdict"] for frame in found["frames"]]
    assert repr(result) == "<Result: 3 frames, 2 stand, 1 falls>"
    assert repr(result.frames[2]) == "<Frame 2 'It lets go': falls>"
    for frame, known in zip(result.frames, found["frames"]):
        for key, value in known.items():
            if key == "solve":
                continue
            mine = getattr(frame, key)
            assert len(mine) == len(value) if key in ("failures", "robots") else mine == value
    assert result.contact_tolerance.gap == found["contact_tolerance"]["gap"]
    assert result.frames[1].interfaces[0].resultant.force == found["frames"][1]["interfaces"][0]["resultant"]["force"]
    assert "proof" in dir(result.frames[0]) and "contact_tolerance" in dir(result)
    with pytest.raises(AttributeError, match="there are"):
        result.frames[0].verdikt
    with pytest.raises(TypeError, match="stands"):
        bool(result)
    with pytest.raises(ds.DrystoneError, match="frames"):
        result.margins


def test_margins_are_attributes():
    scene = ds.Scene(friction=0.5).ground(FLOOR).block("a", brick(0, 0))
    result = ds.check(scene, margins=["friction", "horizontal_load"])
    assert result.margins.friction == 0
    assert result.margins.horizontal_load.left == pytest.approx(0.5)
    assert "tilt" not in result.margins
    assert ds.check(scene).margins is None
    assert ds.check(scene, margins=True).margins.load_factor is None
    with pytest.raises(ds.DrystoneError, match='margins.0.: .*\\n.*did you mean "friction"'):
        ds.check(scene, margins=["fricton"])
    with pytest.raises(ds.DrystoneError, match="accuracy"):
        ds.check(scene, accuracy="draft")
    with pytest.raises(ds.DrystoneError, match="time_limit"):
        ds.check(scene, time_limit=-1)


def test_tables_agree_with_the_result(steps):
    numpy = needed("numpy")
    result = ds.check(steps)
    found = result.to_dict()["frames"]
    rows = result.contacts.to_numpy()
    known = [(number, contact) for number, frame in enumerate(found) for contact in frame["interfaces"]]
    assert len(rows) == len(known) == len(result.contacts)
    names = [block["id"] for block in result.scene.to_dict()["blocks"]]
    for row, (number, contact) in zip(rows, known):
        assert (row["frame"], [row["body_0"], row["body_1"]]) == (number, contact["bodies"])
        for name, index in ((row["body_0"], row["block_0"]), (row["body_1"], row["block_1"])):
            assert names[index] == name if index >= 0 else name == "ground"
        assert [row["force_x"], row["force_y"]] == contact["resultant"]["force"]
        assert [[row["end_0_x"], row["end_0_y"]], [row["end_1_x"], row["end_1_y"]]] == contact["ends"]
        assert [row["normal_force_0"], row["normal_force_1"]] == contact["normal_forces"]
        assert (row["mu"], row["friction_used"]) == (contact["mu"], contact["friction_used"])
    failures = result.failures.to_dicts()
    missing = [failure for frame in found for failure in frame["failures"]]
    assert [row["amount"] for row in failures] == [failure["amount"] for failure in missing]
    assert [row["kind"] for row in failures] == [failure["kind"] for failure in missing]
    robots = result.robots.to_dicts()
    assert [row["id"] for row in robots] == [robot["id"] for frame in found for robot in frame["robots"]]
    last = result.frames[2].blocks
    assert len(last) == 2 and last["id"].tolist() == ["left", "lintel"]
    moving = {motion["block"]: motion for motion in found[2]["mechanism"]}
    for row in last.to_dicts():
        expected = moving.get(row["id"], {"velocity": [0, 0], "spin": 0})
        assert ([row["velocity_x"], row["velocity_y"]], row["spin"]) == (expected["velocity"], expected["spin"])
    assert numpy.array(result.blocks).dtype.names == tuple(result.blocks.columns)
    assert "rows of frame" in repr(result.contacts)
    with pytest.raises(KeyError, match="there is no column"):
        result.contacts["weights"]


def test_columns_are_writable_arrays():
    needed("numpy")
    result = ds.check(ds.Scene().ground(FLOOR).block("a", brick(0, 0)).block("b", brick(4, 2)))
    blocks = result.blocks
    assert blocks["id"][blocks["unsupported"]].tolist() == ["b"]
    weights = blocks["weight"]
    weights *= 2
    assert weights.tolist() == [2 * row["weight"] for row in blocks.to_dicts()]
    assert list(blocks) == blocks.columns and "weight" in blocks


def test_a_result_keeps_its_scene(lintel, tmp_path):
    result = ds.check(lintel)
    before = lintel.to_dict()
    lintel.block("late", brick(0, 4))
    assert result.scene.to_dict() == before
    result.report(tmp_path / "sheet.md")
    assert "late" not in (tmp_path / "sheet.md").read_text(encoding="utf-8")


def test_tables_without_rows_are_tables():
    result = ds.check(ds.Scene().ground(FLOOR).block("a", brick(0, 0)))
    assert len(result.failures) == 0 and result.failures.to_dicts() == []
    numpy = needed("numpy")
    assert isinstance(result.failures.to_numpy(), numpy.ndarray)


def test_pandas_polars_and_pyarrow_read_the_stream(steps):
    result = ds.check(steps)
    known = result.contacts.to_dicts()
    pyarrow = needed("pyarrow")
    assert pyarrow.table(result.contacts).to_pylist() == known
    pandas = needed("pandas")
    assert result.contacts.to_pandas().to_dict("records") == known
    assert list(pandas.DataFrame.from_arrow(result.contacts).columns) == result.contacts.columns
    polars = needed("polars")
    assert polars.DataFrame(result.contacts).to_dicts() == known


def test_a_stream_that_nobody_reads_is_released(steps):
    result = ds.check(steps)
    for _ in range(1000):
        assert type(result.contacts.__arrow_c_stream__()).__name__ == "PyCapsule"


def test_many_scenes_in_order(lintel):
    scenes = [lintel.copy() for _ in range(20)]
    scenes[7] = ds.Scene().ground(FLOOR).block("a", brick(0, 0)).block("b", brick(2, 1))
    counts = []
    results = ds.check_many(scenes, margins=["friction"], progress=counts.append)
    assert results.verdicts == ["stable"] * 7 + ["unstable"] + ["stable"] * 12
    assert counts == sorted(counts) and counts[-1] == 20
    assert repr(results) == "<Results: 20 scenes: 19 stand, 1 falls>"
    for scene, result in zip(scenes, results):
        assert result.to_dict(timing=False) == ds.check(scene, margins=["friction"]).to_dict(timing=False)
    table = results.table.to_dicts()
    assert [row["scene"] for row in table] == list(range(20))
    assert table[0]["friction"] == results[0].margins.friction
    assert isinstance(results[3:5], ds.Results) and len(results[3:5]) == 2


def test_a_refused_scene_among_many(lintel):
    scenes = [lintel, {"blocks": [{"id": "a"}]}, lintel]
    with pytest.raises(ds.SceneError) as caught:
        ds.check_many(scenes)
    assert caught.value.problems[0].path.startswith("blocks[0]")
    results = ds.check_many(scenes, errors="keep")
    assert results.verdicts == ["stable", "refused", "stable"]
    assert [row["scene"] for row in results.table.to_dicts()] == [0, 2]
    with pytest.raises(ValueError, match="keep"):
        ds.check_many(scenes, errors="ignore")
    assert len(ds.check_many([])) == 0


def test_an_exception_in_progress_ends_the_work(lintel):
    def stop(count):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ds.check_many([lintel] * 500, progress=stop)


def test_the_lock_of_python_is_released(lintel):
    import threading
    import time

    done = threading.Event()
    ticks = []

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    ds.check_many([lintel] * 2000)
    end = time.perf_counter()
    done.set()
    thread.join()
    assert len([t for t in ticks if start < t < end]) >= 3


def test_the_program_comes_with_the_package():
    shown = program("--version")
    assert shown.returncode == 0 and ds.__version__ in shown.stdout
    path = ROOT / "assets/thesis/figure-4.json"
    assert program("check", "--quiet", path).returncode == 1
    assert program("chek").returncode == 2


def test_results_are_pickled_and_copied(lintel, steps, tmp_path):
    path = tmp_path / "lintel.json"
    lintel.save(path)
    result = ds.check(path, margins="tilt", capacity=("lintel", (2, 3)))
    for made in (pickle.loads(pickle.dumps(result)), copy.copy(result), copy.deepcopy(result)):
        assert made.to_json(timing=False) == result.to_json(timing=False) and "lintel.json" in made.to_json()
        assert made.scene == result.scene and made.stands is result.stands
        assert made.figure().svg() == result.figure().svg()
    assert copy.deepcopy(result)._native is result._native, "a copy is not solved again"
    many = ds.check_many([lintel, {"blocks": [{"id": "a"}]}, steps], errors="keep")
    again = pickle.loads(pickle.dumps(many))
    assert again.verdicts == many.verdicts and str(again[1]) == str(many[1]) and again[1].problems == many[1].problems
    # Forces of robots that a frame does not have are not numbers, which equal nothing.
    assert repr(again.table.to_dicts()) == repr(many.table.to_dicts())
    frame = many[2].frames[1]
    other = pickle.loads(pickle.dumps(frame))
    assert (other.number, other.title, other.verdict) == (frame.number, frame.title, frame.verdict)
    for name in ("contacts", "blocks", "robots", "failures"):
        table = getattr(many[2], name)
        for same in (pickle.loads(pickle.dumps(table)), copy.deepcopy(table)):
            assert same.to_dicts() == table.to_dicts() and repr(same) == repr(table)
    for thing in (frame.figure("mechanism", width_mm=84), ds.Figure.of_problems(ds.Scene().block("a")._json())):
        assert pickle.loads(pickle.dumps(thing)).svg() == thing.svg()
    varied = ds.vary("arch", {"voussoirs": 9, "thickness": (0.1, 0.6)}, digits=2)
    assert pickle.loads(pickle.dumps(varied)) == varied == copy.deepcopy(varied)
    record = result.frames[0].margins
    assert pickle.loads(pickle.dumps(record)) == record == copy.deepcopy(record)


def test_one_number_says_how_far_a_structure_is_from_its_limit():
    def pushed(push):
        scene = ds.Scene(friction=0.5).ground(FLOOR).block("a", brick(0, 0, 2.0, 1.0), weight=8)
        return scene.load("a", (push, 0), at=(1, 0.5))

    for push, expected in ((2, 0.5), (4 - 1e-9, 0), (8, -0.5)):
        result = ds.check(pushed(push), margins="load_factor")
        assert result.signed_margin("load_factor") == pytest.approx(expected, abs=1e-6)
        assert result.frames[0].signed_margin("load_factor") == result.frames[0].signed_margins.load_factor
    many = ds.check_many([pushed(2), pushed(8)], margins=["load_factor", "tilt"])
    assert many.table["signed_load_factor"] == pytest.approx([0.5, -0.5])
    assert many.table["signed_tilt"].tolist() == [one.signed_margin() for one in many]
    assert "signed_kernel" not in many.table.columns
    with pytest.raises(ds.DrystoneError, match='margins="kernel"'):
        result.signed_margin("kernel")
    with pytest.raises(ds.DrystoneError, match="there are tilt, horizontal_load"):
        result.signed_margin("friction")
    session = ds.Session(ds.Scene(friction=0.6).ground(FLOOR))
    session.place("a", brick(0, 0))
    assert session.signed_margin() == pytest.approx(math.degrees(math.atan(0.6)) / 90)
    session.place("b", brick(1.6, 1))
    assert -1 <= session.signed_margin() < 0
    steps = ds.check(session.scene(), margins="tilt")
    assert steps.signed_margin() == session.signed_margin() == steps.frames[1].signed_margin()
    late = ds.check(pushed(8), margins="kernel", verdict_only=True)
    assert math.isnan(late.signed_margin("kernel"))


def test_the_table_of_many_scenes_has_the_force_of_each_robot(steps):
    force = ds.check_many([steps, ds.Scene()]).table["force_crane"]
    (x,), (y,) = (ds.check(steps).frames[1].robots[name] for name in ("force_x", "force_y"))
    assert force == pytest.approx([math.nan, math.hypot(x, y), math.nan, math.nan], nan_ok=True)

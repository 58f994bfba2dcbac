"""Numbers that vary."""

import math

import drystone as ds
import pytest


def test_an_interval_has_two_ends_that_are_verdicts():
    found = ds.vary("incline", {"friction": 0.5, "angle": (0, 60)})
    [(low, high)] = found.stands
    assert low == 0 and abs(high - math.degrees(math.atan(0.5))) < 0.02
    assert [interval["state"] for interval in found.intervals] == ["holds", "fails"]
    assert set(found.column("state")) == {"holds", "fails"} and found.column("angle")[0] == 0
    assert found.svg.startswith("<svg")
    with pytest.raises(ds.DrystoneError, match="one number has intervals"):
        found.region
    with pytest.raises(ds.DrystoneError, match="a column is one of angle, state, value"):
        found.column("height")


def test_a_scene_of_two_numbers_has_a_region():
    scene = ds.Scene(friction=0.5).ground([(0, -1), (9, -1), (9, 0), (0, 0)])
    scene.block("a", [(1, 0), (3, 0), (3, 2), (1, 2)], weight=10).load("a", (1, 0), at=(2, 2))
    found = ds.vary(scene, {"loads[0].force[0]": (0, 10), "friction": (0.05, 1.2)})
    [ring] = found.region
    # It slides if the force is larger than μ times the weight, and turns over if it is larger than half of the weight.
    assert max(x for x, _ in ring) == pytest.approx(5, abs=0.02)
    assert found.data["ranges"][1]["given"] == 0.5


def test_a_goal_and_a_curve():
    found = ds.vary("incline", {"angle": 10, "friction": (0.2, 1.0)}, goal="tilt>=15", curve="tilt")
    assert found.stands[0][0] == pytest.approx(math.tan(math.radians(25)), abs=2e-4)
    assert max(v for v in found.column("value") if v is not None) > 15


def test_a_map_has_lines_of_equal_values():
    found = ds.vary("incline", {"friction": (0.2, 1.0), "angle": (0, 40)}, isolines="tilt")
    lines = {line["value"]: line["lines"] for line in found.data["isolines"]}
    friction, angle = lines[10][0][0]
    assert math.degrees(math.atan(friction)) - angle == pytest.approx(10, abs=0.05)


def test_what_cannot_vary_is_refused():
    with pytest.raises(ds.DrystoneError, match="there is no structure bridge"):
        ds.vary("bridge", {"span": (1, 2)})
    with pytest.raises(ds.SceneError, match="unknown key"):
        ds.vary({"drystone": 1, "blocks": []}, {"nonsense": (0, 1)})

"""Scenes from files, arrays, polygons and assemblies, and their errors."""

import inspect
import json

import pytest
from conftest import FLOOR, ROOT, brick, needed

import drystone as ds

SCHEMA = json.loads(ds.schema())


def keys_of(name):
    return set(SCHEMA["$defs"][name]["properties"]) if name else set(SCHEMA["properties"])


@pytest.mark.parametrize(
    ("method", "name"),
    [
        ("ground", "GroundEntry"),
        ("block", "BlockEntry"),
        ("shape", "ShapeEntry"),
        ("material", "MaterialEntry"),
        ("robot", "RobotEntry"),
        ("load", "LoadEntry"),
        ("case", "CaseEntry"),
        ("movement", "MovementEntry"),
        ("step", "StepEntry"),
        ("contact", "ContactEntry"),
    ],
)
def test_the_arguments_are_the_keys_of_the_scene_file(method, name):
    arguments = set(inspect.signature(getattr(ds.Scene, method)).parameters) - {"self", "name"}
    assert arguments == keys_of(name)


def test_every_key_of_a_scene_is_an_argument_or_a_method():
    arguments = set(inspect.signature(ds.Scene.__init__).parameters) - {"self"}
    added = {"ground", "blocks", "shapes", "materials", "friction_pairs", "robots", "loads", "steps", "contacts"}
    added |= {"cases", "joint_sets", "movements"}
    assert arguments | added | {"drystone", "$schema"} == keys_of(None)


def test_a_scene_that_is_written_and_read_again_is_equal(steps):
    again = ds.Scene.from_json(steps.to_json())
    assert again == steps
    assert ds.Scene.from_dict(steps.to_dict()) == steps
    one, other = ds.check(again).to_dict(timing=False), ds.check(steps).to_dict(timing=False)
    # Only notes of a scene that was read from text have a line.
    assert [note.pop("line") is None for note in one["notes"] + other["notes"]] == [False, True]
    assert one == other
    assert repr(steps) == "<Scene 'A lintel': 3 blocks, 1 part of the ground, 1 robot, 3 steps>"


def test_a_file_is_read_and_keeps_its_text():
    path = ROOT / "assets/thesis/figure-4.json"
    scene = ds.Scene.from_file(path)
    assert scene.to_json() == path.read_text(encoding="utf-8")
    assert scene.to_dict() == json.loads(path.read_text(encoding="utf-8"))
    assert not scene.validate().copy().step("nothing").to_json() == scene.to_json()


def test_problems_have_all_their_parts():
    scene = ds.Scene().block("a", brick(0, 0)).block("b", brick(1, 0), density=-1)
    with pytest.raises(ds.SceneError) as caught:
        ds.check(scene)
    codes = {problem.code: problem for problem in caught.value.problems}
    assert set(codes) == {"negative"} or "overlap" in codes
    problem = codes["negative"]
    assert (problem.path, problem.line, problem.column) == ("blocks[1].density", None, None)
    assert problem.message and problem.hint
    assert "blocks[1].density" in str(caught.value) and "line" not in str(caught.value).split("help")[0]
    assert isinstance(caught.value, ds.DrystoneError)


def test_problems_of_a_text_have_lines():
    text = '{ "drystone": 1,\n  "blocks": [],\n  "frction": 1 }'
    with pytest.raises(ds.SceneError, match="line 3") as caught:
        ds.check(ds.Scene.from_json(text))
    assert caught.value.problems[0].line == 3
    with pytest.raises(ds.SceneError):
        ds.Scene.from_json("{ this is no JSON").to_dict()
    with pytest.raises(ds.SceneError):
        ds.Scene.from_json("[1, 2]").to_dict()


def test_an_unknown_key_of_a_dict_is_named():
    with pytest.raises(ds.SceneError, match="nearest known key"):
        ds.check({"blokcs": []})


def test_input_that_is_not_a_scene_is_refused_with_a_reason():
    with pytest.raises(TypeError, match="from_json"):
        ds.check("{}")
    with pytest.raises(ds.DrystoneError, match="corner 1"):
        ds.Scene().block("a", [(0, 0), (1,), (1, 1)])
    with pytest.raises(ds.DrystoneError, match="corner 0"):
        ds.Scene().block("a", 5)
    with pytest.raises(ds.DrystoneError, match="infinite or not a number"):
        ds.check(ds.Scene().block("a", [(0, 0), (1, 0), (float("nan"), 1)]))


class Shape:
    def __init__(self, geometry):
        self.__geo_interface__ = geometry


def test_numpy_and_geo_interface_give_the_same_block():
    numpy = needed("numpy")
    closed = [*brick(0, 0), (0.0, 0.0)]
    for outline in (
        numpy.array(brick(0, 0)),
        numpy.array(closed),
        Shape({"type": "Polygon", "coordinates": [closed]}),
        Shape({"type": "MultiPolygon", "coordinates": [[closed]]}),
        Shape({"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [closed]}, "properties": {}}),
    ):
        scene = ds.Scene().block("a", outline, density=numpy.float64(2.0), at=numpy.array([1, 2]))
        assert scene.to_dict()["blocks"] == [
            {"id": "a", "density": 2.0, "at": [1, 2], "polygon": [list(map(float, p)) for p in brick(0, 0)]}
        ]
    with pytest.raises(ds.DrystoneError, match="of 2 polygons"):
        ds.Scene().block("a", Shape({"type": "MultiPolygon", "coordinates": [[closed], [closed]]}))
    with pytest.raises(ds.DrystoneError, match="LineString"):
        ds.Scene().block("a", Shape({"type": "LineString", "coordinates": closed}))


def test_shapely_polygons_with_holes():
    geometry = needed("shapely.geometry")
    ring = geometry.box(0, 0, 3, 3).difference(geometry.box(1, 1, 2, 2))
    scene = ds.Scene().ground(FLOOR).block("ring", ring, density=2400)
    entry = scene.to_dict()["blocks"][0]
    assert len(entry["polygon"]) == 4 and len(entry["holes"]) == 1
    assert ds.check(scene).blocks.to_dicts()[0]["area"] == pytest.approx(8.0)


def test_rows_of_a_feature_collection():
    features = {
        "type": "FeatureCollection",
        "features": [
            {
                "type": "Feature",
                "geometry": {"type": "Polygon", "coordinates": [[*brick(0, y), (0, y)]]},
                "properties": {"name": f"b{y}", "density": 2000.0 + y, "owner": "nobody", "friction": float("nan")},
            }
            for y in (0, 1)
        ],
    }
    scene = ds.Scene().ground(FLOOR).blocks(Shape(features), id="name", fill="#aabbcc")
    blocks = scene.to_dict()["blocks"]
    assert [block["id"] for block in blocks] == ["b0", "b1"]
    assert blocks[1]["density"] == 2001.0 and blocks[1]["fill"] == "#aabbcc"
    assert "owner" not in blocks[0] and "friction" not in blocks[0]
    assert ds.check(scene).stands


def test_geopandas_rows():
    geopandas = needed("geopandas")
    geometry = needed("shapely.geometry")
    frame = geopandas.GeoDataFrame({"id": ["a", "b"], "density": [1.0, 2.0]}, geometry=[geometry.box(0, 0, 3, 1), geometry.box(0, 1, 3, 2)])
    assert ds.check(ds.Scene().ground(FLOOR).blocks(frame)).stands


class Box:
    """A box with those methods of a compas mesh that the import calls."""

    def __init__(self, x, z, width=2.0, depth=0.5, height=1.0, lean=0.0):
        self.corners = [
            (x + i * width + lean * j * k, j * depth, z + k * height) for i in (0, 1) for j in (0, 1) for k in (0, 1)
        ]

    def faces(self):
        return range(6)

    def face_vertices(self, face):
        return [(0, 4, 5, 1), (2, 6, 7, 3), (0, 2, 6, 4), (1, 3, 7, 5), (0, 1, 3, 2), (4, 5, 7, 6)][face]

    def vertex_coordinates(self, vertex):
        return self.corners[vertex]


class Graph:
    def __init__(self, blocks):
        self.attributes = blocks

    def nodes(self):
        return range(len(self.attributes))

    def node_attribute(self, node, name):
        return self.attributes[node].get(name)


class Assembly:
    def __init__(self, blocks):
        self.graph = Graph(blocks)


def test_assemblies_of_prisms():
    assembly = Assembly(
        [{"block": Box(0, -1, width=4), "is_support": True}, {"block": Box(1, 0)}, {"block": Box(1.5, 1)}]
    )
    scene = ds.Scene.from_compas(assembly, friction=0.7, density=2000)
    file = scene.to_dict()
    assert (file["thickness"], len(file["ground"]), len(file["blocks"])) == (0.5, 1, 2)
    result = ds.check(scene)
    assert result.stands and len(result.contacts) == 2
    assert result.frames[0].weight == pytest.approx(2 * 2.0 * 0.5 * 2000 * 9.81)
    with pytest.raises(ds.DrystoneError, match="choose another plane"):
        ds.Scene.from_compas(Assembly([{"block": Box(0, 0, lean=0.2)}]), plane="xy")
    with pytest.raises(ds.DrystoneError, match="thickness="):
        ds.Scene.from_compas(Assembly([{"block": Box(0, 0)}, {"block": Box(0, 1, depth=0.7)}]))


def test_a_dict_is_checked_at_once():
    file = {"blocks": [{"id": "a", "polygon": brick(0, 0), "weight": -1}]}
    for wrong in (lambda: ds.Scene.from_dict(file), lambda: ds.check(file), lambda: ds.check_many([file])):
        with pytest.raises(ds.SceneError) as caught:
            wrong()
        assert [problem.path for problem in caught.value.problems] == ["blocks[0].weight"]
    assert repr(ds.Scene.from_dict({})) == "<Scene: 0 blocks>"

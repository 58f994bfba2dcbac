"""Sessions: verdicts after each step, copies, and the forces that a block can carry."""

import copy
import multiprocessing
import pickle

import pytest
from conftest import FLOOR, brick

import drystone as ds


@pytest.fixture
def session():
    return ds.Session(ds.Scene(friction=0.6).ground(FLOOR).robot("crane"))


def test_every_step_returns_the_verdict(session):
    assert session.place("a", brick(0, 0)) == "stable"
    assert session.place("b", brick(2, 1)) == "unstable"
    assert session.hold("crane", "b") == "stable"
    assert session.holds == {"crane": "b"}
    assert session.place(polygon=brick(-1, 1)) == "stable"
    assert session.release("crane") == "unstable"
    assert not session.stands
    assert session.remove("b") == "stable"
    assert session.blocks == ["a", "1"]
    assert repr(session) == "<Session: 2 blocks, stable>"


def test_a_block_is_placed_with_all_its_keys(session):
    hole = [(1, 0.25), (2, 0.25), (2, 0.75), (1, 0.75)]
    session.place(7, brick(0, 0), holes=[hole], density=2000, friction=None, fill="#aabbcc")
    scene = ds.Scene(friction=0.6).ground(FLOOR).robot("crane")
    scene.block("7", brick(0, 0), holes=[hole], density=2000, fill="#aabbcc")
    mine, known = session.check().blocks.to_dicts(), ds.check(scene).blocks.to_dicts()
    assert mine == known and mine[0]["area"] == pytest.approx(2.5)
    grid = ds.Scene(grid={"kind": "square"}).ground(cells=[(x, -1) for x in range(9)])
    cells = ds.Session(grid)
    assert cells.place("a", cells=[(0, 0), (1, 0)]) == "stable"
    assert cells.place("b", cells=[(1, 1), (2, 1), (3, 1)]) == "unstable"
    with pytest.raises(ds.SceneError) as caught:
        session.place("b", [(4, 0), (5, 0), (5, float("nan"))])
    assert caught.value.problems[0].path == "blocks[1].polygon[2]"


def test_a_step_that_is_not_possible_changes_nothing(session):
    session.place("a", brick(0, 0))
    with pytest.raises(ds.SceneError) as caught:
        session.place("b", brick(1, 0))
    assert caught.value.problems[0].code == "overlap"
    for wrong, words in (
        (lambda: session.place("a", brick(3, 0)), "already"),
        (lambda: session.remove("z"), "no block z"),
        (lambda: session.hold("crane", "z"), "no block z"),
        (lambda: session.hold("nobody", "a"), "no robot nobody"),
        (lambda: session.release("crane"), "holds nothing"),
        (lambda: session.place("c", brick(3, 0), colour="red"), "colour"),
        (lambda: ds.Session(ds.Scene().block("a", brick(0, 0)).step(place=["a"])), "steps"),
    ):
        with pytest.raises(ds.DrystoneError, match=words):
            wrong()
    assert session.blocks == ["a"] and session.verdict == "stable"


def test_a_copy_is_independent(session):
    session.place("a", brick(0, 0))
    for other in (session.copy(), copy.copy(session), copy.deepcopy(session)):
        other.place("b", brick(2, 1))
        assert (session.verdict, other.verdict) == ("stable", "unstable")
        assert session.blocks == ["a"]


def test_a_session_agrees_with_a_scene(session):
    session.place("a", brick(0, 0))
    session.hold("crane", "a", at=(1, 0.5))
    scene = ds.Scene(friction=0.6).ground(FLOOR).robot("crane", holds="a", at=[1, 0.5]).block("a", brick(0, 0))
    mine, known = session.check(margins=True), ds.check(scene, margins=True)
    assert mine.to_dict(timing=False)["frames"] == known.to_dict(timing=False)["frames"]
    assert session.margins("friction").friction == known.margins.friction
    assert "<svg" in session._repr_svg_()
    assert mine.scene.to_dict() == scene.to_dict()


def test_the_forces_that_a_block_can_carry(session):
    session.place("a", brick(0, 0), weight=6)
    carried = session.capacity("a")
    assert carried.shape == "unbounded" and carried.stands_without
    assert carried.vertices[0] == pytest.approx([0, 6], abs=1e-5)
    top = session.capacity("a", (1.5, 1.0))
    assert top.at == [[1.5, 1.0]]
    assert session.capacity("a", (0, 1), (3, 1)).shape == "unbounded"
    fewer = session.capacity("a", for_all="friction=0.3..0.6")
    slope = min(edge.normal[0] / edge.normal[1] for edge in fewer.edges)
    assert slope == pytest.approx(-1 / 0.3, rel=1e-5)
    with pytest.raises(ds.DrystoneError, match="did you mean a"):
        session.capacity("aa")
    result = ds.check(ds.Scene(friction=0.6).ground(FLOOR).block("a", brick(0, 0), weight=6), capacity=("a", (1.5, 0.5)))
    assert result.frames[0].capacity.vertices[0] == pytest.approx([0, 6], abs=1e-5)


def state(session):
    return session.verdict, session.blocks, session.holds, session.scene(), session.check().to_dict(timing=False)


def test_the_scene_of_a_session_has_its_steps():
    start = ds.Scene(units={"length": "mm"}, expect="stable").ground([(0, -1), (9, -1), (9, 0), (0, 0)]).robot("crane", holds="0", at=(1, 0.5))
    session = ds.Session(start.block("0", brick(0, 0)).robot("other"))
    verdicts = [session.verdict, session.place("a", brick(3, 0))]
    verdicts += [session.hold("other", "a", at=(0.004, 0.0005)), session.release("other"), session.remove("a")]
    verdicts += [session.place("a", brick(3, 0)), session.remove("a"), session.place("a", brick(2, 1)), session.hold("other", "a")]
    scene = session.scene()
    assert [frame.verdict for frame in ds.check(scene).frames] == verdicts
    file = scene.to_dict()
    assert [block["id"] for block in file["blocks"]] == ["0", "a", "a (2)"]
    assert file["steps"][0] == {"place": ["0"], "hold": {"crane": {"block": "0", "at": [1, 0.5]}}}
    assert file["steps"][2]["hold"]["other"]["at"] == pytest.approx([4, 0.5])
    assert file["steps"][5:] == [{"place": ["a"]}, {"remove": ["a"]}, {"place": ["a (2)"]}, {"hold": {"other": "a (2)"}}]
    assert state(pickle.loads(pickle.dumps(session))) == state(session)
    empty = ds.Session(ds.Scene().ground(FLOOR))
    assert "steps" not in empty.scene().to_dict()


def test_a_pickled_session_goes_on(session):
    session.place("a", brick(0, 0), weight=7)
    session.hold("crane", "a", at=(1, 0.25))
    session.place(polygon=brick(2, 1))
    session.remove("1")
    made = pickle.loads(pickle.dumps(session))
    assert state(made) == state(session)
    for one in (session, made):
        one.release("crane")
        one.place("1", brick(2.5, 1))
    assert state(made) == state(session) and made.verdict == "unstable"
    cells = ds.Session(ds.Scene(grid={"kind": "square"}).ground(cells=[(x, -1) for x in range(9)]))
    cells.place("a", cells=[(0, 0), (1, 0)])
    cells.remove("a")
    cells.place("b", cells=[(1, 0)])
    assert state(pickle.loads(pickle.dumps(cells))) == state(cells)
    strict = ds.Session(ds.Scene().ground(FLOOR).block("a", brick(0, 0)), accuracy="exact", verdict_only=True)
    assert pickle.dumps(pickle.loads(pickle.dumps(strict))) == pickle.dumps(strict)
    with pytest.raises(ds.DrystoneError, match="no block z"):
        made.remove("z")


@pytest.mark.parametrize("method", ["spawn", "fork", "forkserver"])
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_process_pools_take_and_return_sessions_and_results(session, lintel, method):
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"this system has no {method}")
    session.place("a", brick(0, 0))
    # Two groups of blocks, so that threads have worked before a process is forked.
    result = ds.check(lintel.block("far", brick(-1, 4, 0.5)).block("c", brick(2, 4, 0.5)), margins=True)
    with multiprocessing.get_context(method).Pool(1) as pool:
        returned = pool.map_async(copy.copy, [session, result, result.frames[0].contacts, result.scene]).get(120)
    other, again, contacts, scene = returned
    assert state(other) == state(session)
    assert again.to_dict(timing=False) == result.to_dict(timing=False)
    assert contacts.to_dicts() == result.contacts.to_dicts() and scene == result.scene

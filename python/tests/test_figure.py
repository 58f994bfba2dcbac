"""Pictures, reports and notebooks."""

import json
import re

import pytest
from conftest import FLOOR, brick, needed

import drystone as ds


def test_formats(lintel, tmp_path):
    figure = ds.check(lintel).figure(theme="dark", width_mm=84)
    assert figure.svg().startswith("<svg") and 'width="84mm"' in figure.svg()
    assert figure.png(dpi=100)[:4] == b"\x89PNG"
    assert figure.pdf()[:5] == b"%PDF-"
    for ending in ("svg", "png", "pdf", "tikz"):
        figure.save(tmp_path / f"figure.{ending}")
        assert (tmp_path / f"figure.{ending}").stat().st_size > 500
    with pytest.raises(ds.DrystoneError, match="saved as"):
        figure.save(tmp_path / "figure.jpg")


def test_every_kind_is_drawn(steps):
    result = ds.check(steps)
    kinds = ds.figure_kinds()
    assert {"forces", "mechanism", "thrust"} <= set(kinds)
    drawn = {kind: result.figure(kind).svg() for kind in kinds}
    # By default, forces have one scale in all steps, as the steps of a construction always have.
    assert drawn.pop("build") == drawn["forces"]
    assert len(set(drawn.values())) == len(drawn)
    assert result.figure("freebody", block="left").svg() != drawn["forces"]
    assert result.frames[0].figure().svg() != drawn["forces"]


def test_a_figure_computes_what_the_result_lacks(lintel):
    bare = ds.check(lintel)
    asked = ds.check(lintel, sensitivity="friction", capacity="lintel")
    # The lintel exerts no horizontal force, so it stands without friction, and gravity may be tilted by some degrees.
    assert bare.margins is None and "sensitivity" not in bare.frames[0].to_dict()
    friction, tilt = (bare.figure("sensitivity", margin=name).svg() for name in ("friction", "tilt"))
    assert "friction" in friction and "tilt" in tilt and friction != tilt
    assert asked.figure("sensitivity").svg() == friction
    assert asked.figure("sensitivity", margin="tilt").svg() == tilt
    assert bare.figure("capacity", capacity="lintel").svg() == asked.figure("capacity").svg()
    at = bare.figure("capacity", capacity=("lintel", (3, 4))).svg()
    assert at == bare.figure("capacity", capacity="lintel@3,4").svg() != asked.figure("capacity").svg()
    fewer = bare.figure("capacity", capacity="lintel", for_all="friction=0.3..0.6").svg()
    assert fewer != asked.figure("capacity").svg()


def test_wrong_options_are_explained(lintel):
    result = ds.check(lintel)
    for options, words in (
        ({"kind": "forcs"}, "forces"),
        ({"theme": "drak"}, "dark"),
        ({"amonts": True}, "amounts"),
        ({"block": "left"}, "freebody"),
        ({"width_mm": -1}, "width_mm: it must be a width"),
        ({"pages": True}, "pages: unknown key"),
        ({"kind": "freebody", "block": "z"}, "no block z"),
        ({"kind": "sensitivity", "margin": "robots"}, "kernel"),
        ({"kind": "capacity", "capacity": "z"}, "no block z"),
    ):
        with pytest.raises(ds.DrystoneError, match=words) as caught:
            result.figure(**options).svg()
        assert all(word not in str(caught.value) for word in ("error:", "Usage", "--", "line 1"))
    # All problems are reported at once.
    with pytest.raises(ds.DrystoneError) as caught:
        result.figure("flow", theme="drak", fill="stres", columns=0).png(dpi=0.1)
    assert all(word in str(caught.value) for word in ('did you mean "dark"', 'did you mean "stress"', "columns", "dpi"))


def test_a_notebook_shows_scenes_results_and_problems(lintel, steps):
    assert lintel._repr_svg_() == ds.check(lintel).figure().svg()
    for shown in (lintel, steps, ds.check(steps), ds.check(steps).frames[1], ds.check(steps).figure("thrust")):
        assert '<img alt="Figure" style="max-width:100%" src="data:image/svg+xml;base64,' in shown._repr_html_()
    assert "<table>" in ds.check(steps).contacts._repr_html_()
    wrong = ds.Scene().block("a", brick(0, 0)).block("b", brick(1, 0))
    assert "overlap" in wrong._repr_svg_()


def test_names_are_escaped():
    scene = ds.Scene("<b>&").ground(FLOOR).block("<i>", brick(0, 0)).step("<u>", place=["<i>"])
    html = ds.check(scene)._repr_html_() + ds.check(scene).blocks._repr_html_()
    assert "<u>" not in html and "<i>" not in html and "&lt;u&gt;" in html


def test_animations(steps, tmp_path):
    result = ds.check(steps)
    result.animate(tmp_path / "talk.png", seconds=0.5)
    data = (tmp_path / "talk.png").read_bytes()
    assert b"acTL" in data
    with pytest.raises(ds.DrystoneError, match="gif"):
        result.animate(tmp_path / "talk.mp4")
    image = needed("PIL.Image")
    result.animate(tmp_path / "talk.gif", seconds=0.5)
    assert image.open(tmp_path / "talk.gif").n_frames == 3


def test_reports(steps, tmp_path):
    result = ds.check(steps, margins=["friction"])
    for ending in ("html", "pdf", "md", "json"):
        path = tmp_path / f"sheet.{ending}"
        result.report(path, title="A sheet")
        assert path.stat().st_size > 1000
    assert "A sheet" in (tmp_path / "sheet.html").read_text(encoding="utf-8")
    with pytest.raises(ds.DrystoneError, match="must end in .html"):
        result.report(tmp_path / "sheet.doc")
    with pytest.raises(ds.DrystoneError, match="no theme"):
        result.report(tmp_path / "sheet.html", theme="drak")


def test_matplotlib(steps):
    matplotlib = needed("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    axes = ds.check(steps).frames[1].draw()
    found = {patch.get_gid() for patch in axes.patches}
    assert {"ground", "block:left", "block:lintel"} <= found and "block:right" not in found
    assert any(gid.startswith("force:") for gid in found)
    low, high = axes.get_xlim()
    assert low <= -1 and high >= 7
    _, own = plt.subplots()
    assert ds.check(steps).draw(own, forces=False) is own
    assert any(gid.startswith("block:") for gid in (p.get_gid() for p in own.patches))
    plt.close("all")


def test_a_style_is_a_file_or_a_dict(lintel, tmp_path):
    figure = ds.check(lintel).figure
    style = {"theme": "dark", "page": "#d01234", "widths": {"force": 0.06}}
    file = tmp_path / "own.json"
    file.write_text(json.dumps(style), encoding="utf-8")
    drawn = figure(style=style).svg()
    assert drawn == figure(style=str(file)).svg() != figure(theme="dark").svg()
    assert "#d01234" in figure(theme="plain", style={"page": "#d01234"}).svg()
    wrong = {"failur": "red", "widths": {"force": -1}}
    file.write_text(json.dumps(wrong), encoding="utf-8")
    messages = []
    for given in (wrong, str(file)):
        with pytest.raises(ds.DrystoneError) as caught:
            figure(style=given).svg()
        # A dict has no name and no lines.
        messages.append(re.sub(r"(style|\S*own\.json): |line \d+, column \d+, ", "", str(caught.value)))
    assert messages[0] == messages[1] and "the nearest known key is `failure`" in messages[0]

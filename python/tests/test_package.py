"""The package itself: types, documentation, memory, the wheel."""

import ast
import doctest
import importlib.util
import os
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import FLOOR, ROOT, brick, needed

import drystone as ds


def test_doctests_of_the_package_and_the_page():
    names = [module.name for module in pkgutil.iter_modules(ds.__path__) if module.name not in ("__main__", "sphinx")]
    if os.environ.get("CI") or importlib.util.find_spec("sphinx"):
        names.append("sphinx")
    tried = 0
    for module in [ds, *(importlib.import_module(f"drystone.{name}") for name in names)]:
        result = doctest.testmod(module)
        assert result.failed == 0
        tried += result.attempted
    assert tried >= 8


def test_the_examples_of_the_python_page_are_correct(tmp_path, monkeypatch):
    needed("numpy")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text((ROOT / "assets/thesis/figure-4.json").read_text(encoding="utf-8"))
    page = ROOT / "python/README.md"
    result = doctest.testfile(str(page), module_relative=False, optionflags=doctest.ELLIPSIS)
    assert result.failed == 0 and result.attempted > 20


def test_the_lines_of_the_readme_run(tmp_path, monkeypatch):
    needed("numpy")
    monkeypatch.chdir(tmp_path)
    lines = (ROOT / "README.md").read_text(encoding="utf-8").split("```python\n")[1].split("```")[0]
    names = {}
    exec(lines, names)
    assert names["result"].stands and (tmp_path / "figure.pdf").stat().st_size > 1000


def test_types(tmp_path):
    needed("mypy")
    clean = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file", ROOT / "pyproject.toml", ROOT / "python/drystone"],
        capture_output=True,
        text=True,
    )
    assert clean.returncode == 0, clean.stdout + clean.stderr
    # Run outside the repository, so that the installed package is compared with its types.
    stubs = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "--mypy-config-file", ROOT / "pyproject.toml", "drystone._drystone"],
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert stubs.returncode == 0, stubs.stdout + stubs.stderr


def test_modules_do_not_import_each_other_in_a_circle():
    """Imports inside functions and for types count too."""
    folder = Path(ds.__file__).parent
    uses = {}
    for path in folder.glob("*.py"):
        found = set()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.level == 1:
                found.update([node.module] if node.module else [name.name for name in node.names])
        uses[path.stem] = {name for name in found if (folder / f"{name}.py").exists()}
    assert {"_figure", "_scene"} <= uses["_result"]
    while free := [name for name, found in uses.items() if not found & uses.keys()]:
        for name in free:
            del uses[name]
    assert not uses, f"these modules import each other in a circle, or import such modules: {sorted(uses)}"


def test_the_package_says_that_it_has_types():
    assert (Path(ds.__file__).parent / "py.typed").exists()
    assert (Path(ds.__file__).parent / "_drystone.pyi").exists()
    assert all(hasattr(ds, name) for name in ds.__all__)


def test_one_wheel_serves_every_python():
    """The module uses the stable interface of Python 3.10, and the wheel says so."""
    module = Path(ds._drystone.__file__).name
    if sys.platform == "linux":
        assert ".abi3." in module
    wheels = sorted(Path(os.environ.get("DRYSTONE_WHEELS", ROOT / "target/wheels")).glob("drystone-*.whl"))
    if not wheels:
        pytest.skip("no wheel was built")
    for wheel in wheels:
        assert "-cp310-abi3-" in wheel.name
        if os.environ.get("DRYSTONE_WHEEL_IS_RELEASED"):
            assert wheel.stat().st_size <= 12_000_000


def resident():
    """Returns the resident memory of this process in bytes."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGESIZE")


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_nothing_leaks():
    """Memory does not grow with the number of scenes. DRYSTONE_LEAK_SCENES sets this number; the full test uses 100000."""
    count = int(os.environ.get("DRYSTONE_LEAK_SCENES", "1000"))
    scene = ds.Scene().ground(FLOOR).block("a", brick(0, 0)).block("b", brick(1, 1))
    wrong = ds.Scene().block("a", brick(0, 0)).block("b", brick(1, 0))
    session = ds.Session(ds.Scene().ground(FLOOR).block("a", brick(0, 0)))

    def once():
        result = ds.check(scene)
        result.contacts.__arrow_c_stream__()
        result.to_dict()
        result.contacts.to_dicts()
        with pytest.raises(ds.SceneError):
            ds.check(wrong)
        session.place("c", brick(1, 1))
        session.copy().verdict
        session.remove("c")

    for _ in range(max(200, count // 10)):
        once()
    before = resident()
    for _ in range(count):
        once()
    assert resident() - before < 8_000_000 + 20 * count


def test_the_playground_is_a_file_of_the_package(tmp_path, monkeypatch):
    page = tmp_path / "playground.html"
    monkeypatch.setattr("drystone._playground._PAGE", page)
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    with pytest.raises(ds.DrystoneError, match="build.sh"):
        ds.playground()
    page.touch()
    assert opened == [] and ds.playground() == page.as_uri() and opened == [page.as_uri()]

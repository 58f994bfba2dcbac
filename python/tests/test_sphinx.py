"""The directive of Sphinx."""

import os
import subprocess
import sys

from conftest import needed

CONF = 'project = "Walls"\nextensions = ["drystone.sphinx", "myst_parser"]\nroot_doc = "index"\n'
RST = """Walls
=====

.. toctree::

   deep/page

.. drystone:: deep/half.json
   :kind: mechanism
   :theme: auto
   :name: falls

See :ref:`falls`.
"""
PAGE = """# A page

```{drystone} half.json
:caption: Half a lintel
```

```{drystone}
:nocaption:

%s
```
"""


def build(builder, folder):
    words = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", builder, "-d", folder / "trees"]
    environment = {**os.environ, "PYTHONIOENCODING": "utf-8"}
    return subprocess.run([*words, folder / "src", folder / builder], capture_output=True, text=True, env=environment)


def test_a_site_and_a_book_show_scenes(lintel, tmp_path):
    needed("sphinx")
    needed("myst_parser")
    source = tmp_path / "src"
    (source / "deep").mkdir(parents=True)
    falls = lintel.copy().step("Half", place=["left", "lintel"])
    falls.save(source / "deep/half.json")
    for name, text in (("conf.py", CONF), ("index.rst", RST), ("deep/page.md", PAGE % lintel.to_json())):
        (source / name).write_text(text, encoding="utf-8")
    built = build("html", tmp_path)
    assert built.returncode == 0, built.stdout + built.stderr
    index = (tmp_path / "html/index.html").read_text(encoding="utf-8")
    page = (tmp_path / "html/deep/page.html").read_text(encoding="utf-8")
    assert 'alt="A lintel. It falls' in index and "<figcaption>" in index and 'href="#falls"' in index
    assert 'alt="Half a lintel"' in page and 'alt="A lintel. It stands.' in page and page.count("<figcaption>") == 1
    pictures = [path.read_text(encoding="utf-8") for path in (tmp_path / "html/_images").glob("*.svg")]
    assert len(pictures) == 3 and sum("prefers-color-scheme" in svg for svg in pictures) == 1
    built = build("latex", tmp_path)
    assert built.returncode == 0, built.stdout + built.stderr
    assert len(list((tmp_path / "latex").glob("*.pdf"))) == 3
    # A change of the scene file changes the page; an invalid scene is reported with its page and line.
    lintel.save(source / "deep/half.json")
    build("html", tmp_path)
    assert 'alt="A lintel. It stands.' in (tmp_path / "html/index.html").read_text(encoding="utf-8")
    (source / "deep/half.json").write_text('{"drystone": 1, "blokcs": []}', encoding="utf-8")
    built = build("html", tmp_path)
    assert built.returncode != 0
    assert "index.rst:8" in built.stderr and "blokcs" in built.stderr, built.stderr

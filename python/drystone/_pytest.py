"""The plug-in of pytest: the fixture ``drystone_snapshot`` and the option ``--drystone-accept``."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest

from ._result import Result

Compare = Callable[..., None]


def pytest_addoption(parser: pytest.Parser) -> None:
    words = "write the results of drystone_snapshot as references where they differ"
    parser.getgroup("drystone").addoption("--drystone-accept", action="store_true", help=words)


@pytest.fixture
def drystone_snapshot(request: pytest.FixtureRequest) -> Compare:
    """A function that fails if a result differs from its references.

    ``drystone_snapshot(result)`` compares with ``snapshots/FILE/TEST.txt``, ``TEST.svg`` and ``TEST.png`` next to the
    file of the test; the argument ``name`` replaces the name of the test. A second call in a test needs another name.
    """
    used: set[str] = set()

    def compare(result: Result, name: str | None = None) -> None:
        __tracebackhide__ = True
        name = re.sub(r"[^\w.-]+", "-", name or request.node.name).strip("-.")
        if name in used:
            pytest.fail(f"this test has compared {name} already; give the result another name: name=…", pytrace=False)
        used.add(name)
        base = request.path.parent / "snapshots" / request.path.stem / name
        differences = result._native.snapshot(str(base), request.config.getoption("--drystone-accept"))
        if differences:
            pytest.fail("\n".join(differences), pytrace=False)

    return compare

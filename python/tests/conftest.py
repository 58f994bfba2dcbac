"""Scenes that several tests use."""

import importlib
import os
from pathlib import Path

import pytest

import drystone as ds

ROOT = Path(__file__).resolve().parents[2]

FLOOR = [(-9, -1), (9, -1), (9, 0), (-9, 0)]


def needed(name):
    """Returns the module with this name. If it is not installed, the test is skipped, but fails if CI is set."""
    return importlib.import_module(name) if os.environ.get("CI") else pytest.importorskip(name)


def brick(x, y, width=3.0, height=1.0):
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]


@pytest.fixture
def lintel():
    return (
        ds.Scene("A lintel", friction=0.6)
        .ground([(-1, -1), (7, -1), (7, 0), (-1, 0)])
        .shape("post", [(0, 0), (1, 0), (1, 3), (0, 3)])
        .block("left", shape="post", weight=60)
        .block("right", shape="post", at=[5, 0], weight=60)
        .block("lintel", [(0, 3), (6, 3), (6, 4), (0, 4)], weight=110)
    )


@pytest.fixture
def steps(lintel):
    return (
        lintel.robot("crane", limits={"force": 100})
        .step("One post", place=["left"])
        .step("The crane holds", place=["lintel"], hold={"crane": {"block": "lintel", "at": [5, 4]}})
        .step("It lets go", release=["crane"])
    )

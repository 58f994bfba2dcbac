"""Runs the program ``drystone``: ``python -m drystone``."""

from __future__ import annotations

import os
import signal
import sys

from ._drystone import run


def main() -> int:
    """Runs drystone with the arguments of this process and returns the exit code."""
    # Let an interrupt (Ctrl+C) end the process at once. Python would handle it only after `run` has returned.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # `drystone report --interactive` searches its script here.
    os.environ.setdefault("DRYSTONE_INTERACTIVE", os.path.dirname(__file__))
    return run(["drystone", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())

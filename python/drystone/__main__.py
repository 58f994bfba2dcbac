"""The ``drystone`` program: ``python -m drystone``."""

from __future__ import annotations

import signal
import sys

from ._drystone import run


def main() -> int:
    """Runs the command line of this process and returns its exit code."""
    # Python would keep an interrupt until the program has ended.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run(["drystone", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())

"""The function :func:`playground`, which opens the playground that the wheel contains."""

from __future__ import annotations

import webbrowser
from pathlib import Path

from ._errors import DrystoneError

_PAGE = Path(__file__).with_name("playground.html")


def playground() -> str:
    """Opens the playground in a browser, and returns its address.

    The playground is one file of this package: it needs no network and no server.
    """
    if not _PAGE.is_file():
        raise DrystoneError(
            "this installation has no playground: wheels of releases have one; in a clone, run examples/playground/build.sh "
            "and node examples/playground/single.mjs python/drystone/playground.html, and then pip install . again"
        )
    address = _PAGE.as_uri()
    webbrowser.open(address)
    return address

"""Opening a hull file: its tables and its history, and whether they are what was written.

Examples
--------
>>> from pathlib import Path
>>> from tempfile import TemporaryDirectory
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.hull_file.open import open_hull_file
>>> from assoc_hull.io.hull_file.write import save_hull_file
>>> with TemporaryDirectory() as folder:
...     document = Document(wigley())
...     save_hull_file(document, Path(folder) / "ship.hull")
...     again = open_hull_file(Path(folder) / "ship.hull")
...     print(again.state.particulars.name)
...     again.keeper.close()
...     document.keeper.close()
Wigley
"""

from __future__ import annotations

import getpass
import os
from pathlib import Path

from assoc_hull.edit.document import Document
from assoc_hull.io.hull_file.check import require_sound
from assoc_hull.io.hull_file.connect import as_written, connect, speaking_of
from assoc_hull.io.hull_file.storage import HullFile
from assoc_hull.io.hull_file.tables import read_state

__all__ = ["open_hull_file", "user"]


def user() -> str:
    """Give the name of who is at work, as the system knows it; empty if it does not."""
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        return ""


def open_hull_file(path: Path, wait: float = 0.0, *, damaged: bool = False) -> Document:
    """Open a hull file; nothing is computed but splines, and the fingerprint must agree.

    Parameters
    ----------
    path : Path
        The file.
    wait : float, s
        How long to wait while another process writes, now and at each edit.
    damaged : bool
        Open it also if its tables contradict one another, to be looked at by a check.

    Returns
    -------
    Document
        With its history; each edit is in the file before it counts as committed.

    Raises
    ------
    BadInputError, DamagedFileError, FileBusyError, HullFileError
        See `assoc_hull.io.hull_file.connect.connect`.
    """
    path = Path(os.path.realpath(path))
    database = connect(path, wait)
    try:
        with speaking_of(path, wait), as_written(path, "it is damaged"):
            database.execute("BEGIN")
            state = read_state(database)
            file = HullFile(path, database, state, wait)
            document = Document(state, keeper=file, author=user())
            document.stand(*file.follow(document))
            document.start = str(file.recorded(0))
            file.require_print()
            if not damaged:
                require_sound(state)
            database.execute("ROLLBACK")
    except BaseException:
        database.close()
        raise
    return document

"""Saving and opening a hull: as a hull file that keeps every edit, or as text.

The name tells which: one that ends in ``.hull.json`` is the canonical text, one in ``.hull`` a
hull file. Opening looks at what the file holds, not at its name.

Examples
--------
>>> from pathlib import Path
>>> from tempfile import TemporaryDirectory
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.hull_file.saving import close, save
>>> with TemporaryDirectory() as folder:
...     document = Document(wigley())
...     written = save(document, Path(folder) / "ship.hull").written
...     again = save(document).written
...     close(document)
>>> written, again
(True, False)
"""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

import attrs

from assoc_hull.arguments import file_path
from assoc_hull.edit.document import Document
from assoc_hull.errors import BadInputError
from assoc_hull.io.hull_file.connect import is_hull_file
from assoc_hull.io.hull_file.open import open_hull_file, user
from assoc_hull.io.hull_file.storage import HullFile
from assoc_hull.io.hull_file.write import save_hull_file
from assoc_hull.io.hull_json import read_hull_json, write_hull_json
from assoc_hull.model.definition.verify import Difference

__all__ = [
    "FILE_ENDING",
    "TEXT_ENDING",
    "Saved",
    "close",
    "damages",
    "detach",
    "holds_hull",
    "open_document",
    "path_of",
    "refresh",
    "save",
]

FILE_ENDING, TEXT_ENDING = ".hull", ".hull.json"


@attrs.frozen
class Saved:
    """What came of saving.

    Attributes
    ----------
    path : Path
        The file that holds the hull.
    written : bool
        Whether anything was written.
    """

    path: Path
    written: bool

    def __str__(self) -> str:
        if self.written:
            return f"written: {self.path}"
        return f"nothing to write: every edit is in {self.path} already"


def path_of(document: Document) -> Path | None:
    """Give the hull file of a document, None if it lives in memory."""
    return document.keeper.path if isinstance(document.keeper, HullFile) else None


def save(
    document: Document, path: str | os.PathLike[str] | None = None, *, replace: bool = False
) -> Saved:
    """Write a hull; see `assoc_hull.hull.Hull.save`."""
    there = path_of(document)
    if path is None:
        if there is None:
            remedy = "give the name of a file, for instance ship.hull"
            raise BadInputError("this hull lives in memory", "in save", remedy)
        return _in_place(document, there)
    document.require_ended("save")
    name = file_path(path, "in save")
    if name.endswith(TEXT_ENDING):
        write_hull_json(document.state, path)
        return Saved(Path(path), written=True)
    if there is not None and there == Path(os.path.realpath(path)):
        return _in_place(document, there)
    if not name.endswith(FILE_ENDING):
        remedy = f"end the name in {FILE_ENDING} or {TEXT_ENDING}; other forms are exported"
        raise BadInputError("the form is unknown", f"at {name}", remedy)
    wait = document.keeper.wait if isinstance(document.keeper, HullFile) else 0.0
    save_hull_file(document, Path(path), wait, replace=replace)
    document.author = document.author or user()
    return Saved(Path(path), written=True)


def _in_place(document: Document, there: Path) -> Saved:
    """Say that every edit is in the hull file, if that still is where it was."""
    if isinstance(document.keeper, HullFile):
        document.keeper.place.require_file()
    return Saved(there, written=False)


def open_document(
    path: str | os.PathLike[str], wait: float = 0.0, *, damaged: bool = False
) -> Document:
    """Open a hull file, or read the canonical text; see `assoc_hull.hull.open`."""
    if not (isinstance(path, str) and path.lstrip()[:1] == "{"):
        file = Path(os.path.realpath(path))
        if is_hull_file(file) or not (_is_text(file) or file.name.endswith(".json")):
            return open_hull_file(file, wait, damaged=damaged)
    return Document(read_hull_json(path), author=user())


def holds_hull(path: Path) -> bool:
    """Tell whether a file begins as a hull file or as the canonical text does."""
    return is_hull_file(path) or _is_text(path)


def _is_text(path: Path) -> bool:
    """Tell whether a file begins as the canonical text does."""
    with contextlib.suppress(OSError), path.open("rb") as file:
        return file.read(200).lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"{"
    return False


def refresh(document: Document) -> None:
    """Bring a document to the state in its hull file.

    Raises
    ------
    BadInputError
        It lives in memory.
    """
    if not isinstance(document.keeper, HullFile):
        remedy = "save it as a hull file first"
        raise BadInputError("this hull lives in memory", "in refresh", remedy)
    document.require_ended("refresh")
    document.begin(keep=False)
    try:
        document.keeper.refresh(document)
    finally:
        document.end(keep=False)


def detach(document: Document) -> None:
    """Let a hull live in memory, with all its history; the hull file stays as it is.

    Raises
    ------
    BadInputError
        An edit is open.
    """
    document.require_ended("detach")
    document.keeper = None


def damages(document: Document) -> list[Difference]:
    """Look through the hull file, if there is one, for what is not as it was written."""
    keeper = document.keeper
    found = keeper.damages() if isinstance(keeper, HullFile) else []
    return [Difference(each, "hull file", float("inf")) for each in found]


def close(document: Document) -> None:
    """Let go of the hull file, if there is one.

    Raises
    ------
    BadInputError
        An edit is open.
    """
    document.require_ended("close")
    if isinstance(document.keeper, HullFile):
        document.keeper.close()

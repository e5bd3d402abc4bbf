"""Surfaces out of files: control nets as a table or as JSON, spline surfaces in IGES.

What a file holds is told by its content, not by its name.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.surfaces.surface_file import read_surface_file, write_surfaces
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> with tempfile.TemporaryDirectory() as folder:
...     path = Path(folder) / "plate.igs"
...     write_surfaces([plate], path)
...     found = read_surface_file(path)
>>> found[0].name, found.form, found.unit, found.notes
('plate', 'iges', 'm', ())
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Self

from assoc_hull.arguments import file_path, regular_file
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.iges.file import looks_like_iges
from assoc_hull.io.iges.surfaces import surfaces_of_iges
from assoc_hull.io.iges.write import iges_text
from assoc_hull.io.open_databases import is_hull_file
from assoc_hull.io.surfaces.control_nets import looks_like_nets, nets_of_table, table_of_nets
from assoc_hull.io.surfaces.surface_json import json_of_surfaces, surfaces_of_json
from assoc_hull.io.units import checked_unit
from assoc_hull.io.write_file import form_by_ending, write_whole

__all__ = ["ReadSurfaces", "read_surface_file", "write_surfaces"]

_MOST_BYTES = 200_000_000
_FORMS = {".csv": "csv", ".json": "json", ".igs": "iges", ".iges": "iges"}
_WRITERS: dict[str, Callable[[Sequence[SplineSurface]], str]] = {
    "csv": table_of_nets, "json": json_of_surfaces, "iges": iges_text,
}  # fmt: skip


class ReadSurfaces(tuple[SplineSurface, ...]):
    """Surfaces, in the order of their file, and what is to be told of it.

    Attributes
    ----------
    form : {"csv", "json", "iges"}
        What the file is.
    unit : str
        The unit of its lengths; those of the surfaces are in m.
    notes : tuple of str
        What was left out or taken otherwise, in whole sentences.
    """

    form: str
    unit: str
    notes: tuple[str, ...]

    def __new__(
        cls, surfaces: Iterable[SplineSurface], form: str, unit: str, notes: tuple[str, ...] = ()
    ) -> Self:
        """Put surfaces and facts together."""
        found = super().__new__(cls, surfaces)
        found.form, found.unit, found.notes = form, unit, notes
        return found


def read_surface_file(path: str | os.PathLike[str], unit: str | None = None) -> ReadSurfaces:
    """Read the surfaces of a file; see `assoc_hull.surface.read_surfaces`.

    Raises
    ------
    BadInputError
        It cannot be read, is too large, of another kind, damaged, or holds no surface that can be
        read.
    """
    where = "in read_surfaces"
    name = file_path(path, where)
    given = None if unit is None else checked_unit(unit, where)
    text, source = _text_of(Path(name)), Path(name).name
    if looks_like_iges(text):
        surfaces, used, notes = surfaces_of_iges(text, source, given)
        return ReadSurfaces(surfaces, "iges", used, notes)
    if text.lstrip()[:1] in ("{", "["):
        surfaces, used, notes = surfaces_of_json(text, source, given)
        return ReadSurfaces(surfaces, "json", used, notes)
    if looks_like_nets(text):
        surfaces, used = nets_of_table(text, source, given)
        return ReadSurfaces(surfaces, "csv", used)
    raise _unknown(text, source)


def _text_of(path: Path) -> str:
    """Give the content of a file that may hold surfaces."""
    where = f"at {path}"
    if is_hull_file(path):
        what = "this is a hull, and no file of surfaces"
        raise BadInputError(what, where, "open it as a hull, and fit its surface")
    try:
        with regular_file(path).open("rb") as file:
            data = file.read(_MOST_BYTES + 1)
    except OSError as error:
        reason = error.strerror or str(error)
        what = f"the file cannot be read ({reason})"
        raise BadInputError(what, where, "check name and permissions") from error
    if len(data) > _MOST_BYTES:
        what = f"the file has more than {_MOST_BYTES / 1e6:g} MB"
        raise BadInputError(what, where, "export fewer surfaces")
    if not data.strip():
        raise BadInputError("there is nothing in the file", where, "give one with surfaces")
    if looks_like_iges(data[:2000].decode("latin-1")):
        return data.decode("latin-1")  # columns are bytes there
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _unknown(text: str, source: str) -> BadInputError:
    """Give the error for a file of another kind."""
    remedy = (
        "give control nets (a table that begins with patch,i_u,j_v,x,y,z, or JSON) or IGES with "
        "spline surfaces (128)"
    )
    head = text.lstrip()[:80]
    kind = "this is a STEP file" if head.startswith("ISO-10303-21") else "the form is unknown"
    return BadInputError(kind, f"in {source}", remedy)


def write_surfaces(
    surfaces: Sequence[SplineSurface], path: str | os.PathLike[str], form: str | None = None
) -> None:
    """Write surfaces, in m: as a table, JSON or IGES, by the ending of the name.

    Parameters
    ----------
    surfaces : sequence of SplineSurface
        At least one; a table holds Bezier surfaces only.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : {"csv", "json", "iges"} or None
        None: by the ending.

    Raises
    ------
    BadInputError
        Another form, surfaces that it cannot hold, or a file that cannot be written.
    """
    chosen = form_by_ending(path, form, tuple(_WRITERS), _FORMS, "in write_surfaces")
    write_whole(path, _WRITERS[chosen](surfaces).encode())

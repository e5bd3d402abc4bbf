"""Shell plates: surfaces out of files, plates, their tables.

The face of what `surface` finds and `io` reads and writes.

Examples
--------
>>> import assoc_hull as ah
>>> from pathlib import Path
>>> from tempfile import TemporaryDirectory
>>> with TemporaryDirectory() as folder:
...     path = Path(folder) / "plates.csv"
...     ah.plates(ah.examples.typical_plates()).save(path)
...     len(path.read_text().splitlines())
8
"""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import wraps
from typing import ParamSpec

import attrs

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.plates_file import write_plates
from assoc_hull.io.surface_file import read_surface_file
from assoc_hull.surface.plate_table import Plates as FoundPlates
from assoc_hull.surface.plates import plates as find_plates

__all__ = ["Plates", "plates", "read_surfaces"]

Given = ParamSpec("Given")


@attrs.frozen(eq=False)
class Plates(FoundPlates):
    """Plates that can be written; what they hold says `assoc_hull.surface.plate_table.Plates`."""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the plates, as a table (``.csv``) or as a document (``.json``).

        `assoc_hull.plot.plate_sheet.plate_sheet` draws them on a sheet, with the same table.

        Parameters
        ----------
        path : path
            The file; what was there is replaced by the whole of it, or stays.

        Raises
        ------
        BadInputError
            Another ending, or a file that cannot be written.
        """
        write_plates(self, path)


def _that_can_be_written(find: Callable[Given, FoundPlates]) -> Callable[Given, Plates]:
    """Give a function that finds plates as one of plates that can be written."""

    @wraps(find)
    def found(*args: Given.args, **kwargs: Given.kwargs) -> Plates:
        return Plates(*attrs.astuple(find(*args, **kwargs), recurse=False))

    return found


plates = _that_can_be_written(find_plates)


def read_surfaces(
    path: str | os.PathLike[str], unit: str | None = None
) -> tuple[SplineSurface, ...]:
    r"""Read spline surfaces: control nets from a table or JSON, or untrimmed ones from IGES.

    Which it is, the content of the file tells, not its name.

    Parameters
    ----------
    path : path
        A table with the columns ``patch,i_u,j_v,x,y,z`` (and ``w``), each patch a Bezier surface;
        JSON with degrees, knots and nets; or IGES with spline surfaces (entity 128).
    unit : {"m", "mm", "cm", "ft", "in"} or None
        Of the lengths in the file. None: as the file says; a table that says nothing is in m.

    Returns
    -------
    tuple of SplineSurface
        In the order of the file, in m; besides it has `form`, `unit` and `notes`: what of the
        file was left out or taken otherwise.

    Raises
    ------
    BadInputError
        The file cannot be read, is damaged, tells no unit, or holds surfaces of other kinds or
        trimmed ones: nothing is left out unseen.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> rows = [f"deck,{i},{j},{2 * i},{j},0" for i in (0, 1) for j in (0, 1)]
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "deck.csv"
    ...     _ = path.write_text("\n".join(["patch,i_u,j_v,x,y,z", *rows]))
    ...     (deck,) = ah.read_surfaces(path)
    >>> deck.name, deck.at(0.5, 0.5).tolist()
    ('deck', [1.0, 0.5, 0.0])
    """
    return read_surface_file(path, unit)

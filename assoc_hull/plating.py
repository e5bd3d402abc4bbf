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
from collections.abc import Sequence
from functools import wraps
from typing import Any, overload

import attrs

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.surfaces.surface_file import read_surface_file
from assoc_hull.io.tables.hull_plates import write_hull_plates
from assoc_hull.io.tables.plates import write_plates
from assoc_hull.model.tables import HasState, state_of
from assoc_hull.surface.blocks.fit_net import surface_of_net
from assoc_hull.surface.blocks.fit_options import fit_options, length_of
from assoc_hull.surface.blocks.net_surface import NetSurface
from assoc_hull.surface.plates.hull_plates import HullPlateTable as FoundHullPlates
from assoc_hull.surface.plates.hull_plates import hull_plates
from assoc_hull.surface.plates.hull_seams import HullSeams
from assoc_hull.surface.plates.rival_fits import other_fits
from assoc_hull.surface.plates.surface_plates import PlateTable as FoundPlates
from assoc_hull.surface.plates.surface_plates import Seams
from assoc_hull.surface.plates.surface_plates import plates as find_plates

__all__ = ["HullPlates", "Plates", "plates", "plates_of_hull", "read_surfaces"]


@attrs.frozen(eq=False)
class Plates(FoundPlates):
    """Plates that can be written; see `assoc_hull.surface.plates.surface_plates.PlateTable`."""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the plates, as a table (``.csv``) or as a document (``.json``).

        `assoc_hull.plot.plates.plate_book.plate_sheet` draws them on a sheet, with the same table.

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


@attrs.frozen(eq=False)
class HullPlates(FoundHullPlates):
    """Plates of a hull that can be written.

    What they hold says `assoc_hull.surface.plates.hull_plates.HullPlateTable`.
    """

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the plates, as a table (``.csv``) or as a document (``.json``).

        `assoc_hull.plot.plates.hull_map.hull_map` draws them on the hull.

        Parameters
        ----------
        path : path
            The file; what was there is replaced by the whole of it, or stays.

        Raises
        ------
        BadInputError
            Another ending, or a file that cannot be written.
        """
        write_hull_plates(self, path)


Surfaces = SplineSurface | Sequence[SplineSurface] | FloatArray
"""What is cut along lines of constant parameter, or not at all."""


@overload
def plates(
    surfaces: HasState | NetSurface | Sequence[SplineSurface], seams: HullSeams, **options: Any
) -> HullPlates: ...


@overload
def plates(
    surfaces: Surfaces | NetSurface,
    seams: Seams | Sequence[Seams | None] | None = None,
    *args: Any,
    **options: Any,
) -> Plates: ...


@wraps(find_plates)
def plates(surfaces: Any, seams: Any = None, *args: Any, **options: Any) -> Plates | HullPlates:
    """Find plates of surfaces, or of a hull; see `find_plates` and `plates_of_hull`."""
    if isinstance(seams, HullSeams):
        return plates_of_hull(surfaces, seams, *args, **options)
    given = surfaces.patches if isinstance(surfaces, NetSurface) else surfaces
    return Plates(*attrs.astuple(find_plates(given, seams, *args, **options), recurse=False))


@wraps(hull_plates)
def plates_of_hull(surface: Any, seams: HullSeams, *args: Any, **options: Any) -> HullPlates:
    """Find plates of a hull; of a hull its surface is made, and two more to compare with."""
    if hasattr(surface, "state"):
        state = state_of(surface, "in plates of a hull")
        usual = fit_options(length_of(state))
        if "others" not in options:
            options["others"] = other_fits(state, usual)
        surface = surface_of_net(state, usual)
    found = hull_plates(surface, seams, *args, **options)
    return HullPlates(*attrs.astuple(found, recurse=False))


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

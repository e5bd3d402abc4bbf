"""Where hulls come from: the examples, a file that was saved, a file of another form.

Examples
--------
>>> from assoc_hull.sources import examples
>>> examples.wigley()
<Hull Wigley, 31 lines, 0 edits>
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assoc_hull.arguments import file_path, flag, not_negative
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull

if TYPE_CHECKING:
    from assoc_hull.io.slice_places import Places

__all__ = ["Examples", "examples", "open", "read"]


class Examples:
    """Hulls that come with the package, one method each."""

    def wigley(
        self,
        length: float = 100.0,
        breadth: float = 10.0,
        draught: float = 6.25,
        *,
        stations: int = 21,
        waterlines: int = 11,
    ) -> Hull:
        """Make the Wigley hull; see `assoc_hull.examples.wigley`."""
        from assoc_hull.examples.wigley import wigley

        return Hull(wigley(length, breadth, draught, stations=stations, waterlines=waterlines))

    def series60(self, cb: float = 0.70) -> Hull:
        """Make a Series 60 parent, CB 0.60 or 0.70; see `assoc_hull.examples.series60`."""
        from assoc_hull.examples.series60 import series60_net

        state, report = series60_net(cb)
        hull = Hull(state)
        hull.adoption = report
        return hull

    def bulk_carrier_207k(self) -> Hull:
        """Make a 207,000 TDW bulk carrier; see `assoc_hull.examples.bulk_carrier`."""
        from assoc_hull.examples.bulk_carrier import bulk_carrier_207k_net

        state, report = bulk_carrier_207k_net()
        hull = Hull(state)
        hull.adoption = report
        return hull


examples = Examples()


def open(path: str | os.PathLike[str], *, wait: float = 0.0, damaged: bool = False) -> Hull:
    """Open a hull that was saved; nothing is computed.

    Parameters
    ----------
    path : path
        A hull file: every edit is in it before the ``with`` block of the edit is left. Or a
        ``.hull.json``: edits are in memory until they are saved.
    wait : float, s
        How long to wait while another process writes to the hull file, now and at each edit.
    damaged : bool
        Open a hull file also if its tables contradict one another: ``check`` then says how,
        and nothing else can be relied upon.

    Raises
    ------
    BadInputError, DamagedFileError, FileBusyError, HullFileError
        The file cannot be read or holds no hull; another process is writing.
    """
    from assoc_hull.io.saving import open_document

    if not (isinstance(path, str) and path.lstrip()[:1] == "{"):
        file_path(path, "in open")
    return Hull(
        open_document(
            path, not_negative(wait, "wait", "in open"), damaged=flag(damaged, "damaged", "in open")
        )
    )


def read(
    path: str | os.PathLike[str],
    *,
    length: float | None = None,
    breadth: float | None = None,
    draught: float | None = None,
    scale: float | None = None,
    stations: Places | None = None,
    waterlines: Places | None = None,
    buttocks: Places | None = None,
    unit: str | None = None,
    axes: str | None = None,
    tolerance: float | None = None,
    join: float | None = None,
    deck: str | None = None,
) -> Hull:
    """Read any supported format, told by content: a saved hull, offsets, lines, or a mesh.

    The hull lives in memory, also one that was saved, with its history; `open` edits the file.
    A table in normalised form needs its dimensions (m), unless its comments tell them. Meshes
    (STL, OBJ, PLY, also ``.gz``) take `scale`, full scale over model scale, and the other
    options, as `assoc_hull.io.slice_read.read_slices` does; digitised lines (CSV, DXF, BRITFAIR,
    DELFTship, GHS) all but planes and axes. Tables of offsets may be CSV or XLSX. No form tells
    whether there is a deck between the deck edges: `deck` does, "open" (the default) or "closed".

    Raises
    ------
    BadInputError
        The file cannot be read, or is none of these; or an option that its form does not take.
    """
    from assoc_hull.examples.completion import net_from_table
    from assoc_hull.io.offsets import read_offsets
    from assoc_hull.io.saving import holds_hull
    from assoc_hull.io.slice_read import holds_lines, read_slices

    file = Path(file_path(path, "in read"))
    named: dict[str, Any] = {
        "scale": scale, "stations": stations, "waterlines": waterlines, "buttocks": buttocks,
        "unit": unit, "axes": axes, "tolerance": tolerance, "join": join,
    }  # fmt: skip
    options = {name: value for name, value in named.items() if value is not None}
    if holds_hull(file):
        _refuse_options(options if deck is None else options | {"deck": deck}, file)
        hull = open(file)
        hull.detach()
        return hull
    deck = "open" if deck is None else deck
    sizes: dict[str, Any] = {"length": length, "breadth": breadth, "draught": draught}
    if holds_lines(file):
        state, made = read_slices(file, **sizes, deck=deck, **options)
        hull = Hull(state)
        hull.adoption = made.adoption
        return hull
    _refuse_options(options, file)
    table, _ = read_offsets(file, **sizes)
    state, report = net_from_table(table, deck=deck)
    hull = Hull(state)
    hull.adoption = report
    return hull


def _refuse_options(options: Mapping[str, object], file: Path) -> None:
    from assoc_hull.io.slice_read import require_file

    if options:
        require_file(file)
        raise BadInputError(
            f"{', '.join(sorted(options))} cannot be given", f"for {file.name}",
            "leave it out, or read a mesh or digitised lines",
        )  # fmt: skip

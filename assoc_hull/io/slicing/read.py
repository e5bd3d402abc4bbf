"""A hull from a mesh, from surfaces of CAD or from digitised lines, in one call."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import attrs

from assoc_hull.arguments import choice
from assoc_hull.errors import AssocHullError, BadInputError, CoincidentPointsError
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.digitised.text import is_digitised
from assoc_hull.io.lines.several_hulls import HullChoice
from assoc_hull.io.lines.ship_frame import StatedPlaces
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.mesh.read import is_mesh_name
from assoc_hull.io.placing.options import FrameOptions
from assoc_hull.io.read_file import as_utf8
from assoc_hull.io.reports import Note, Tell, no_progress
from assoc_hull.io.rhino.read import is_rhino
from assoc_hull.io.slicing.cut_planes import Places
from assoc_hull.io.slicing.mesh_lines import DOUBLED, read_mesh, refuse_bottomless
from assoc_hull.io.slicing.net import SliceReport, net_from_slices
from assoc_hull.io.slicing.surface_lines import cad_kind, read_surface_lines
from assoc_hull.io.units import check_particular
from assoc_hull.model.tables import DECKS, HullState, Particulars

__all__ = ["holds_lines", "read_slices", "require_file"]

_HEAD = 20_000
"""So many bytes of a file tell what it holds."""


def holds_lines(path: Path) -> bool:
    """Tell whether a file is a mesh, or holds surfaces or digitised lines: no table of offsets."""
    if is_mesh_name(path):
        return True
    if not path.is_file():
        return False
    if is_rhino(path) or cad_kind(path):
        return True
    head = as_utf8(path.read_bytes()[:_HEAD])
    return b"\0" not in head and is_digitised(head.decode("utf-8", "replace"))


def require_file(path: Path) -> None:
    """Say that there is no file before anything is said of how it is read.

    Raises
    ------
    BadInputError
        There is none.
    """
    if not path.exists():
        raise BadInputError("there is no such file", f"at {path}", "check the path")


def _refuse_cuts(path: Path, names: list[str]) -> None:
    """Digitised lines stand where they were drawn: they are not cut."""
    if names:
        require_file(path)
        raise BadInputError(
            f"{', '.join(names)} cannot be given for digitised lines", f"in {path.name}",
            "leave it out, or read a mesh",
        )  # fmt: skip


def _refuse_deck_edge(path: Path, name: str | None) -> None:
    """Lines that are cut here have no names in the file."""
    if name is not None:
        raise BadInputError(
            "deck_edge cannot be given", f"for {path.name}",
            "leave it out, no line has a name there; give depth=, or a mesh cut off at the deck",
        )  # fmt: skip


def read_slices(
    path: Path,
    *,
    length: float | None = None,
    breadth: float | None = None,
    draught: float | None = None,
    frame: FrameOptions | None = None,
    centre: float | str | None = None,
    deck: str = "open",
    stations: Places | None = None,
    waterlines: Places | None = None,
    buttocks: Places | None = None,
    scale: float = 1.0,
    unit: str = "auto",
    axes: str | None = None,
    tolerance: float | None = None,
    join: float | None = None,
    deck_edge: str | None = None,
    stated: StatedPlaces | None = None,
    tell: Tell = no_progress,
) -> tuple[HullState, SliceReport]:
    """Read a mesh, surfaces or digitised lines and adopt them.

    Parameters
    ----------
    path : Path
        STL, OBJ, PLY (``.gz``), IGES or STEP, or digitised lines as for
        `assoc_hull.io.digitised.read.read_lines`.
    length, breadth, draught : float or None, m
        Particulars; what is not given is found, as `assoc_hull.io.placing.frame.find_frame` does.
    frame : FrameOptions or None
        What else is said of where base line, waterline and perpendiculars are.
    centre : float or str or None
        Which of several hulls side by side: its centre plane in the file, in the unit of the
        file or with a unit, as "4.2 m".
    deck : {"open", "closed"}
        Closed: there is a deck between the deck edges, which no mesh or line tells.
    stations, waterlines, buttocks, scale, unit, axes
        As for `assoc_hull.io.slicing.mesh_lines.slice_mesh`, whose defaults hold for None;
        digitised lines take scale, unit and axes only.
    tolerance : float or None, m
        How far an adopted curve may pass its smooth line; by default 3 times the median noise
        of the pieces, but at least 5 mm, of a mesh 10 mm.
    join : float or None, m
        Loose ends of pieces this close are joined; by default 60 mm.
    deck_edge : str or None
        The line that is the deck edge, of digitised lines.
    stated : StatedPlaces or None
        What comments say of the ship, m at the scale of the file, of digitised lines.
    tell : callable
        Hears what is being done, and how far.

    Raises
    ------
    BadInputError, NoMeetingError, MissingExtraError
        As for `read_mesh`, `read_lines` and `net_from_slices`; planes or axes for lines; a mesh
        or surfaces whose bottom is missing.
    """
    for name, value in (("tolerance", tolerance), ("join", join)):
        check_particular(name, value)
    sizes: dict[str, Any] = {"length": length, "breadth": breadth, "draught": draught}
    places = attrs.evolve(
        frame or FrameOptions(),
        **{name: value for name, value in sizes.items() if value is not None},
    )
    choice(deck, "deck", DECKS, "in the particulars")
    named: dict[str, Any] = {
        "stations": stations, "waterlines": waterlines, "buttocks": buttocks
    }  # fmt: skip
    cuts = {name: value for name, value in named.items() if value is not None}
    common: dict[str, Any] = {
        "scale": scale, "unit": unit, "gaps": join, "length": places.length, "frame": places,
        "choice": HullChoice(centre, places.depth, places.mean_draught),
    }  # fmt: skip
    if axes is not None:
        common["axes"] = axes
    if is_mesh_name(path) or cad_kind(path):
        _refuse_deck_edge(path, deck_edge)
        read = read_mesh if is_mesh_name(path) else read_surface_lines
        slices = read(path, tell=tell, **common, **cuts)
    else:
        _refuse_cuts(path, list(cuts))
        slices = read_lines(path, deck_edge=deck_edge, stated=stated, **common)
    refuse_bottomless(slices)
    if join is not None and not slices.joins:
        what = f"no line has loose ends within {join:.6g} m of each other: nothing was joined"
        note = Note("join", "the lines", what, join)
        notes = attrs.evolve(slices.report, assumptions=(*slices.report.assumptions, note))
        slices = attrs.evolve(slices, report=notes)
    try:
        return net_from_slices(slices, _particulars(slices, deck), tolerance, tell=tell)
    except CoincidentPointsError as error:
        raise _as_of_mesh(slices, error) from error


def _as_of_mesh(slices: HullSlices, error: CoincidentPointsError) -> AssocHullError:
    """Tell of a line that runs back over itself by the place in the file, where that is known."""
    note = next((each for each in slices.report.suspicions if each.kind == DOUBLED), None)
    if note is None:
        return error
    return BadInputError(
        f"{note.where}: {note.what.partition(': ')[0]}", f"in {slices.name}",
        "look at the mesh there, and move that vertex back or leave out what stands out",
    )  # fmt: skip


def _particulars(slices: HullSlices, deck: str) -> Particulars | None:
    found = slices.frame
    if found is None:
        return None
    return Particulars(slices.name, found.length, found.breadth, found.depth, found.draught, deck)

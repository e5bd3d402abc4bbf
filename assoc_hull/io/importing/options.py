"""How a foreign file is to be taken: every option of `ah.read` and of the command, in one value.

Examples
--------
>>> from assoc_hull.io.importing.options import ImportOptions
>>> ImportOptions(length=100.0, unit="mm").named("length", "draught", "unit")
{'length': 100.0, 'unit': 'mm'}
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

import attrs

from assoc_hull.arguments import word
from assoc_hull.errors import BadInputError
from assoc_hull.io.placing.options import FrameOptions, Place
from assoc_hull.io.slicing.cut_planes import Places
from assoc_hull.io.slicing.read import require_file

__all__ = ["ImportOptions"]


@attrs.frozen(kw_only=True)
class ImportOptions:
    """What the caller says of a file; None or "auto" where it is to be found.

    Attributes
    ----------
    length, breadth, draught, depth : float or None, m
        Particulars: between perpendiculars, moulded, design, to the deck edge amidships.
    draught_aft, draught_fwd : float or None, m
        Design draughts at AP and FP of a hull with a design trim.
    ap, fp, base, waterline, origin
        Where perpendiculars, base line, design waterline and x = 0 of the file are, as for
        `assoc_hull.io.placing.options.FrameOptions`.
    deck : {"open", "closed"} or None
        Whether a deck lies between the deck edges; open by default.
    unit : str or None
        Of the numbers in the file.
    station_zero : {"ap", "fp"} or None
        Perpendicular of station 0, of a table.
    station_spacings : int or None
        Station spacings between the perpendiculars, of a table.
    frame_spacing : float or None, m
        Distance of frames, of a table whose stations are frame numbers.
    centre : float or str or None
        The centre plane of a hull that is not at y = 0, or of one of several hulls: in units of
        the file, or with a unit; of a table from where its half-breadths are to be counted.
    deck_edge : str or None
        The line that is the deck edge, of digitised lines where the uppermost is not.
    scale, axes, stations, waterlines, buttocks, tolerance, join
        As for `assoc_hull.io.slicing.read.read_slices`.
    accept : bool
        Take a hull that is not sound; the verdict is kept in its notes.
    strict : bool
        Refuse a hull under suspicion too.
    """

    SIZES: ClassVar[tuple[str, ...]] = ("length", "breadth", "draught")
    TABLES: ClassVar[tuple[str, ...]] = ("station_zero", "station_spacings", "frame_spacing")
    PLANES: ClassVar[tuple[str, ...]] = ("stations", "waterlines", "buttocks", "axes")
    CUTS: ClassVar[tuple[str, ...]] = (
        "stations", "waterlines", "buttocks", "scale", "axes", "tolerance", "join", "centre",
    )  # fmt: skip
    ONLY_CUTS: ClassVar[tuple[str, ...]] = (
        "stations", "waterlines", "buttocks", "axes", "tolerance", "join", "deck_edge",
    )  # fmt: skip

    length: float | None = None
    breadth: float | None = None
    draught: float | None = None
    depth: float | None = None
    draught_aft: float | None = None
    draught_fwd: float | None = None
    ap: Place | None = None
    fp: Place | None = None
    base: Place | None = None
    waterline: Place | None = None
    origin: str | None = None
    deck: str | None = None
    unit: str | None = None
    station_zero: str | None = None
    station_spacings: int | None = None
    frame_spacing: float | None = None
    centre: Place | None = None
    deck_edge: str | None = None
    scale: float | None = None
    axes: str | None = None
    stations: Places | None = None
    waterlines: Places | None = None
    buttocks: Places | None = None
    tolerance: float | None = None
    join: float | None = None
    accept: bool = False
    strict: bool = False

    def __attrs_post_init__(self) -> None:
        # Before any file is opened: which reader would come upon it hangs on the file.
        for name in ("unit", "axes", "origin", "deck", "station_zero", "deck_edge"):
            if getattr(self, name) is not None:
                word(getattr(self, name), name, "in the import")
        if self.accept and self.strict:
            raise BadInputError(
                "accept takes what is not sound, and strict refuses what is suspected",
                "in the import", "give one of them",
            )  # fmt: skip

    def named(self, *names: str) -> dict[str, Any]:
        """Give those of some options that were given, by name."""
        every = {name: getattr(self, name) for name in names}
        return {name: value for name, value in every.items() if value is not None}

    @property
    def frame(self) -> FrameOptions:
        """What is said of where things are, checked."""
        names = (each.name for each in attrs.fields(FrameOptions))
        return FrameOptions(**self.named(*names))

    def of_lines(self) -> tuple[str, ...]:
        """Name the options given that say how lines are read, not what is taken."""
        return tuple(name for name in self.given() if name not in ("accept", "strict"))

    def given(self) -> tuple[str, ...]:
        """Name the options that are not as by default."""
        fields = attrs.fields(ImportOptions)
        return tuple(each.name for each in fields if getattr(self, each.name) is not each.default)

    def refuse(self, why: str, path: Path, names: tuple[str, ...] | None = None) -> None:
        """Refuse options that a form does not take; None: any at all.

        Raises
        ------
        BadInputError
            One of `names` was given.
        """
        wrong = [name for name in self.given() if names is None or name in names]
        if wrong:
            require_file(path)
            raise BadInputError(
                f"{', '.join(wrong)} cannot be given", f"for {path.name}", f"leave it out: {why}"
            )

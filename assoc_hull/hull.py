"""The public hull: a thin face, each method one call downward; and how to get one.

Examples
--------
>>> import assoc_hull as ah
>>> hull = ah.examples.wigley()
>>> hull.find("WL 2.5 x ST 7").parent_curve
<Curve ST 7>
>>> hull.check(), len(hull.history)
((), 0)
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from assoc_hull.arguments import file_path, flag, instance, integer, not_negative, number, text
from assoc_hull.edit.document import Document
from assoc_hull.edit.report import EditReport
from assoc_hull.edit.script import Changes, GapsName, PolicyName, carry_out, settings_of
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError
from assoc_hull.model.address import AddressBook
from assoc_hull.model.family import FAMILIES
from assoc_hull.model.handles import Crossing, Curve, Group, Line, Point, handle
from assoc_hull.model.named import Named
from assoc_hull.model.points import Points
from assoc_hull.model.source import LineSource
from assoc_hull.model.state import Association, HullState, Particulars
from assoc_hull.tolerance import Tolerances

if TYPE_CHECKING:
    import networkx

    from assoc_hull.edit.adopt import AdoptionReport
    from assoc_hull.edit.check_hull import Finding
    from assoc_hull.edit.explain import Thing, Why
    from assoc_hull.edit.preview import Preview
    from assoc_hull.io.export_book import ExportReport
    from assoc_hull.io.slice_places import Places
    from assoc_hull.model.verify import Difference

__all__ = ["Examples", "Hull", "examples", "open", "read"]

_ENDING = ".hull.json"


class Hull:
    """A ship hull form: lines that follow one another, with its history.

    `adoption` tells how the net was made, if it was made of lines here.
    """

    def __init__(self, state: HullState) -> None:
        self.document = Document(instance(state, HullState, "state", "in Hull"))
        self.adoption: AdoptionReport | None = None
        self._open: Edit | None = None

    @classmethod
    def from_lines(
        cls,
        lines: Sequence[LineSource],
        *,
        particulars: Particulars,
        associations: Sequence[Association],
        tolerances: Tolerances | None = None,
    ) -> Self:
        """Make a net of given lines; see `assoc_hull.edit.adopt.adopt`."""
        from assoc_hull.edit.adopt import adopt

        state, report = adopt(lines, particulars, associations, tolerances)
        hull = cls(state)
        hull.adoption = report
        return hull

    def __repr__(self) -> str:
        ship = self.particulars
        return f"<Hull {ship.name}, {len(self.lines)} lines, {len(self.history)} edits>"

    @property
    def state(self) -> HullState:
        """The tables."""
        return self.document.state

    @property
    def particulars(self) -> Particulars:
        """Name and principal dimensions, m."""
        return self.state.particulars

    @property
    def groups(self) -> Mapping[str, Group]:
        """The groups of lines by name, in the order of the ranks."""
        found = [Group.of(self.state, i) for i in self.state.live("groups").tolist()]
        found.sort(key=lambda each: (FAMILIES[each.family].rank, each.name))
        return Named("group", {each.name: each for each in found})

    @property
    def lines(self) -> Mapping[str, Line]:
        """All lines by name; by group and name where two groups have one of the same name."""
        book, live = AddressBook(self.state), self.state.live("lines").tolist()
        return Named("line", {book.line_name(i): Line.of(self.state, i) for i in live})

    @property
    def points(self) -> Points:
        """All points by address."""
        return Points(self.state)

    @property
    def crossings(self) -> Mapping[str, Crossing]:
        """All crossings by address."""
        book, table = AddressBook(self.state), self.state.rows
        live = [row for row in self.state.live("rows").tolist() if table.curve.data[row, 1] >= 0]
        return Named("crossing", {book.address(i): Crossing.of(self.state, i) for i in live})

    @property
    def history(self) -> tuple[EditReport, ...]:
        """The reports of all committed edits, oldest first."""
        return tuple(step.report for step in self.document.history)

    @property
    def undone(self) -> tuple[EditReport, ...]:
        """The reports of edits that were taken back, the last one taken back last."""
        return tuple(step.report for step in self.document.undone)

    def edit(
        self, name: str, policy: PolicyName = "all_or_nothing", gaps: GapsName = "refuse"
    ) -> Edit:
        """Begin an edit, for a ``with`` statement; inside another one it joins that.

        Raises
        ------
        BadInputError
            An unknown policy, or an unknown treatment of gaps.
        """
        settings = settings_of(policy, gaps)
        text(name, "the name", "in edit")
        if self._open is None or not self._open.active:
            self._open = Edit(self.document, name, settings)
        return self._open

    def preview(
        self, edits: Changes, policy: PolicyName = "all_or_nothing", gaps: GapsName = "refuse"
    ) -> Preview:
        """Run edits, publish nothing, and tell what they would do.

        Parameters
        ----------
        edits : callable, or sequence of mappings
            Called with the edit; or ``{"op": "move", "point": ..., "y": ...}`` and so on.
        policy, gaps
            As for `edit`.

        Returns
        -------
        Preview
            The report, or why it would be refused; the change of volume and LCB.
        """
        from assoc_hull.edit.preview import preview

        return preview(
            self.document, lambda edit: carry_out(edit, edits), settings_of(policy, gaps)
        )

    def apply(self, name: str, edits: Changes | None = None) -> EditReport | None:
        """Carry out edits given as for `preview`; None if they joined one that is still open.

        Raises
        ------
        BadInputError
            No name, no edits, or one that no method of `Edit` fits.
        """
        with self.edit(name) as edit:
            carry_out(edit, edits)
        return edit.report

    def undo(self, n: int = 1) -> None:
        """Take back the last edits; stored values come back, nothing is computed."""
        self.document.undo(n)

    def redo(self, n: int = 1) -> None:
        """Make edits that were taken back again."""
        self.document.redo(n)

    def find(self, address: str) -> Group | Line | Curve | Point:
        """Give what an address names; see `assoc_hull.model.address`."""
        return handle(self.state, address)

    def why(self, thing: Thing | str) -> Why:
        """Explain the last change of a point or curve, or of the first curve of a line.

        Raises
        ------
        UnknownNameError, ForeignPointError, BadInputError
            Nothing that this hull has, or a group.
        """
        from assoc_hull.edit.explain import node_of, why

        return why(self.document, node_of(self.state, thing))

    def check(self, notes: bool = False) -> tuple[Finding, ...]:
        """Give what is wrong with the hull; empty if nothing is."""
        from assoc_hull.edit.check_hull import check

        return check(self.document, flag(notes, "notes", "in check"))

    def verify(self, relative: float = 0.0) -> tuple[Difference, ...]:
        """Rebuild the hull beside the published one and give every difference."""
        from assoc_hull.model.verify import verify

        return tuple(verify(self.state, not_negative(relative, "relative", "in verify")))

    @property
    def fingerprint(self) -> str:
        """SHA-256 of definition and published values; undo gives the old one back."""
        from assoc_hull.model.definition import fingerprint

        return fingerprint(self.state)

    def graph(
        self,
        *,
        around: Thing | str | None = None,
        up: int = 1,
        down: int = 1,
        two_way: bool = False,
        edit: int | None = None,
    ) -> networkx.MultiDiGraph[str]:
        """Give objects and links as a graph; see `assoc_hull.edit.view.graph_of`."""
        from assoc_hull.edit.view import graph_of

        hops = integer(up, "up", "in graph", least=0), integer(down, "down", "in graph", least=0)
        return graph_of(self.document, around, hops, flag(two_way, "two_way", "in graph"), edit)

    def dependencies(self, points: bool = False) -> networkx.DiGraph[str]:
        """Give who drives whom now; see `assoc_hull.model.view.dependencies`."""
        from assoc_hull.model.view import dependencies

        return dependencies(self.state, flag(points, "points", "in dependencies"))

    def half_breadth(self, x: float, z: float) -> float:
        """Give the half-breadth (m) at x and z (m); see `assoc_hull.model.breadth`."""
        from assoc_hull.model.breadth import half_breadth

        where = "in half_breadth"
        return half_breadth(self.state, number(x, "x", where), number(z, "z", where))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the canonical text form; the name of the file ends in ``.hull.json``.

        Raises
        ------
        BadInputError
            Another ending, or a file that cannot be written.
        """
        from assoc_hull.io.hull_json import write_hull_json

        if not file_path(path, "in save").endswith(_ENDING):
            raise BadInputError("the form is unknown", f"at {path}", f"end the name in {_ENDING}")
        write_hull_json(self.state, path)

    def export(self, path: str | os.PathLike[str], form: str | None = None) -> ExportReport:
        """Write offsets or sections for other programs; see `assoc_hull.io.export.export`."""
        from assoc_hull.io.export import export

        return export(self.state, path, form)


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


def open(path: str | os.PathLike[str]) -> Hull:
    """Open a hull that was saved; nothing is computed.

    Raises
    ------
    BadInputError
        The file cannot be read or holds no hull.
    """
    from assoc_hull.io.hull_json import read_hull_json

    if not (isinstance(path, str) and path.lstrip()[:1] == "{"):
        file_path(path, "in open")
    return Hull(read_hull_json(path))


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
) -> Hull:
    """Read any supported format, told by content: a saved hull, offsets, lines, or a mesh.

    A table in normalised form needs its dimensions (m), unless its comments tell them. Meshes
    (STL, OBJ, PLY, also ``.gz``) take `scale`, full scale over model scale, and the other
    options, as `assoc_hull.io.slice_read.read_slices` does; digitised lines (CSV, DXF, BRITFAIR,
    DELFTship, GHS) all but planes and axes. Tables of offsets may be CSV or XLSX.

    Raises
    ------
    BadInputError
        The file cannot be read, or is none of these; or an option that its form does not take.
    """
    from assoc_hull.examples.completion import net_from_table
    from assoc_hull.io.offsets import read_offsets
    from assoc_hull.io.slice_read import holds_lines, read_slices

    file = Path(file_path(path, "in read"))
    named: dict[str, Any] = {
        "scale": scale, "stations": stations, "waterlines": waterlines, "buttocks": buttocks,
        "unit": unit, "axes": axes, "tolerance": tolerance, "join": join,
    }  # fmt: skip
    options = {name: value for name, value in named.items() if value is not None}
    if holds_lines(file):
        state, made = read_slices(file, length=length, breadth=breadth, draught=draught, **options)
        hull = Hull(state)
        hull.adoption = made.adoption
        return hull
    _refuse_options(options, file)
    if file.is_file() and file.read_bytes()[:200].lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"{":
        return open(file)
    table, _ = read_offsets(file, length=length, breadth=breadth, draught=draught)
    state, report = net_from_table(table)
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

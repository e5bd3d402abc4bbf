"""The public hull: a thin face, each method one call downward.

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
from typing import TYPE_CHECKING, Self

from assoc_hull.arguments import flag, instance, integer, not_negative, number, text
from assoc_hull.edit.document import Document
from assoc_hull.edit.report import EditReport
from assoc_hull.edit.script import Changes, GapsName, PolicyName, carry_out, settings_of
from assoc_hull.edit.session import Edit
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import FAMILIES
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.objects import Crossing, Curve, Group, Line, Point, Points, handle
from assoc_hull.model.tables import Association, HullState, Particulars
from assoc_hull.tolerance import Tolerances

if TYPE_CHECKING:
    import networkx

    from assoc_hull.creation.creation_report import CreationReport
    from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
    from assoc_hull.edit.checks.finding import Finding
    from assoc_hull.edit.explain.causes import Thing, Why
    from assoc_hull.edit.explain.compare_states import Comparison
    from assoc_hull.edit.explain.hull_graph import OnlyName
    from assoc_hull.edit.explain.preview import Preview
    from assoc_hull.edit.script import Replayed
    from assoc_hull.edit.step_storage import Label
    from assoc_hull.io.hull_file.saving import Saved
    from assoc_hull.io.reports import ExportReport
    from assoc_hull.model.definition.verify import Difference
    from assoc_hull.model.form_definition import FormDefinition
    from assoc_hull.model.objects import FeatureHandle

__all__ = ["Hull", "to_change"]


class Hull:
    """A ship hull form, with its history; `adoption` tells how it was made of lines, if here."""

    def __init__(self, state: HullState | Document) -> None:
        if not isinstance(state, Document):
            state = Document(instance(state, HullState, "state", "in Hull"))
        self.document = state
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
        """Make a net of given lines; see `assoc_hull.edit.adoption.adopt_lines.adopt`."""
        from assoc_hull.edit.adoption.adopt_lines import adopt

        state, report = adopt(lines, particulars, associations, tolerances)
        hull = cls(state)
        hull.adoption = report
        return hull

    def __repr__(self) -> str:
        ship = self.particulars
        return f"<Hull {ship.name}, {len(self.lines)} lines, {len(self.document.history)} edits>"

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
        return NamedMapping("group", {each.name: each for each in found})

    @property
    def lines(self) -> Mapping[str, Line]:
        """All lines by name; by group and name where two groups have one of the same name."""
        book, live = AddressBook(self.state), self.state.live("lines").tolist()
        return NamedMapping("line", {book.line_name(i): Line.of(self.state, i) for i in live})

    @property
    def points(self) -> Points:
        """All points by address."""
        return Points(self.state)

    @property
    def crossings(self) -> Mapping[str, Crossing]:
        """All crossings by address."""
        book, table = AddressBook(self.state), self.state.rows
        live = [row for row in self.state.live("rows").tolist() if table.curve.data[row, 1] >= 0]
        return NamedMapping("crossing", {book.address(i): Crossing.of(self.state, i) for i in live})

    @property
    def features(self) -> Mapping[str, FeatureHandle]:
        """Circles, arcs, flats, straight runs, knuckle lines and joins by name."""
        from assoc_hull.model.objects import features_by_name

        return features_by_name(self.state)

    @property
    def definitions(self) -> Mapping[str, FormDefinition]:
        """Definitions by form parameters by name; `values` of each holds its numbers."""
        return NamedMapping("definition", {each.name: each for each in self.state.definitions})

    @property
    def creation(self) -> CreationReport:
        """The hull beside its definitions; BadInputError if it has none."""
        from assoc_hull.creation.creation_report import creation_report

        return creation_report(self.state)

    @property
    def history(self) -> tuple[EditReport, ...]:
        """The reports of all committed edits, oldest first."""
        return tuple(step.report for step in self.document.history)

    @property
    def undone(self) -> tuple[EditReport, ...]:
        """The reports of edits that were taken back, the last one taken back last."""
        return tuple(step.report for step in self.document.undone)

    @property
    def author(self) -> str:
        """Who edits; every step keeps it."""
        return self.document.author

    @author.setter
    def author(self, name: str) -> None:
        self.document.author = text(name, "the name", "in author")

    @property
    def labels(self) -> Mapping[str, Label]:
        """Checkpoints, and branches that undone edits were left on, by name."""
        return NamedMapping("checkpoint or branch", dict(self.document.labels))

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
        self,
        edits: Changes,
        policy: PolicyName = "all_or_nothing",
        gaps: GapsName = "refuse",
        *,
        name: str = "preview",
        why: Sequence[Thing | str] = (),
    ) -> Preview:
        """Run edits, publish nothing, and tell what they would do.

        Parameters
        ----------
        edits : callable, or sequence of mappings
            Called with the edit; or ``{"op": "move", "point": ..., "y": ...}`` and so on.
        policy, gaps
            As for `edit`.
        name, why : str, sequence of objects or addresses
            Name of the edit, for its report; of what to tell why it would change.

        Returns
        -------
        Preview
            The report, or why it would be refused; lines that would change; volume and LCB.
        """
        from assoc_hull.edit.explain.preview import preview

        return preview(
            self.document, lambda edit: carry_out(edit, edits), settings_of(policy, gaps), name, why
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

    def checkpoint(self, name: str) -> None:
        """Name the present state, to return to it or compare with it.

        Raises
        ------
        NameTakenError
            The name is in use.
        """
        self.document.label(name)

    def go(self, name: str) -> None:
        """Return to a checkpoint or branch; what is left is reachable by a name, too.

        Raises
        ------
        UnknownNameError
            There is no such name.
        """
        self.document.go(name)

    def diff(self, before: str, after: str | None = None) -> Comparison:
        """Compare two checkpoints or branches, or one with the present state."""
        from assoc_hull.edit.explain.compare_states import compare_labelled

        return compare_labelled(self.document, before, after)

    def replay(self, other: Hull, *, skip: bool = False) -> tuple[Replayed, ...]:
        """Make the edits of another hull again on this one; see `assoc_hull.edit.script`."""
        from assoc_hull.edit.script import replay

        steps = instance(other, Hull, "other", "in replay").document.history
        return replay(self.document, steps, skip=flag(skip, "skip", "in replay"))

    def find(self, address: str) -> Group | Line | Curve | Point:
        """Give what an address names; see `assoc_hull.model.address`."""
        return handle(self.state, address)

    def why(self, thing: Thing | FormDefinition | str) -> Why:
        """Explain the last change of a point, curve, definition, or a line's first curve.

        Raises
        ------
        UnknownNameError, ForeignPointError, BadInputError
            Nothing that this hull has, or a group.
        """
        from assoc_hull.edit.explain.causes import node_of, why

        return why(self.document, node_of(self.state, thing))

    def check(self, notes: bool = False) -> tuple[Finding, ...]:
        """Give what is wrong with the hull; empty if nothing is."""
        from assoc_hull.edit.checks.hull_findings import check

        return check(self.document, flag(notes, "notes", "in check"))

    def verify(self, relative: float = 0.0) -> tuple[Difference, ...]:
        """Rebuild the hull beside the published one, look through its file: all that differs."""
        from assoc_hull.io.hull_file.saving import file_damages
        from assoc_hull.model.definition.verify import verify

        found = verify(self.state, not_negative(relative, "relative", "in verify"))
        return (*found, *file_damages(self.document))

    @property
    def fingerprint(self) -> str:
        """SHA-256 of definition and published values; undo gives the old one back."""
        from assoc_hull.model.definition.fingerprint import fingerprint

        return fingerprint(self.state)

    def graph(
        self,
        *,
        around: Thing | FormDefinition | str | None = None,
        up: int = 1,
        down: int = 1,
        only: OnlyName | None = None,
        edit: int | None = None,
    ) -> networkx.MultiDiGraph[str]:
        """Give objects and links as a graph; see `assoc_hull.edit.explain.hull_graph.graph_of`."""
        from assoc_hull.edit.explain.hull_graph import graph_of

        hops = integer(up, "up", "in graph", least=0), integer(down, "down", "in graph", least=0)
        return graph_of(self.document, around, hops, only, edit)

    def dependencies(self, points: bool = False) -> networkx.DiGraph[str]:
        """Give who drives whom now; see `assoc_hull.model.object_graph.dependencies`."""
        from assoc_hull.model.object_graph import dependencies

        return dependencies(self.state, flag(points, "points", "in dependencies"))

    def half_breadth(self, x: float, z: float) -> float:
        """Give the half-breadth (m) at x and z (m); see `assoc_hull.model.half_breadth`."""
        from assoc_hull.model.half_breadth import half_breadth

        where = "in half_breadth"
        return half_breadth(self.state, number(x, "x", where), number(z, "z", where))

    @property
    def path(self) -> Path | None:
        """The hull file that holds every edit; None for a hull in memory."""
        from assoc_hull.io.hull_file.saving import path_of

        return path_of(self.document)

    def save(self, path: str | os.PathLike[str] | None = None, *, replace: bool = False) -> Saved:
        """Write the hull; see `assoc_hull.io.hull_file.saving`.

        Parameters
        ----------
        path : path or None
            ``ship.hull.json``: the canonical text is written. ``ship.hull``: a hull file, with
            the history, in which every edit is kept from then on. None: the hull file that
            this hull is in; there is nothing to write, and the answer says so.
        replace : bool
            Write over a hull file that is there, with its history.

        Raises
        ------
        BadInputError, HullFileError
            There is such a file; it cannot be written; no name for a hull in memory.
        """
        from assoc_hull.io.hull_file.saving import save_hull

        return save_hull(self.document, path, replace=flag(replace, "replace", "in save"))

    def export(
        self, path: str | os.PathLike[str], form: str | None = None, unit: str | None = None
    ) -> ExportReport:
        """Write offsets or lines for other programs."""
        from assoc_hull.io.export.write import export_hull

        self.document.require_ended("export")
        return export_hull(self.state, path, form, unit)

    def refresh(self) -> None:
        """Take over what another process has committed to the hull file since."""
        from assoc_hull.io.hull_file.saving import refresh_hull

        refresh_hull(self.document)

    def detach(self) -> None:
        """Edit in memory from now on; the hull file stays as it is until the hull is saved."""
        from assoc_hull.io.hull_file.saving import detach_hull

        detach_hull(self.document)

    def close(self) -> None:
        """Let go of the hull file; the hull can be read on, and not be edited, nor its history."""
        from assoc_hull.io.hull_file.saving import close_hull_file

        close_hull_file(self.document)


def to_change(hull: Hull, act: str, *, in_place: object) -> Hull:
    """Give the hull that an act changes: the given one, or a copy of it in memory.

    Raises
    ------
    WrongTypeError
        What is given is no hull, or `in_place` neither True nor False.
    BadInputError
        An edit of the hull is open.
    """
    from assoc_hull.model.tables import copy_state, state_of

    state = state_of(hull, f"in {act}")
    hull.document.require_ended(act)
    return hull if flag(in_place, "in_place", f"in {act}") else Hull(copy_state(state))

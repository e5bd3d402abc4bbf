"""The public hull: a thin face, each method one call downward.

Longer than other modules, as it is the one page a user reads: what starts from one hull is a
method here, with all that is to be known of its arguments; the functions called have a line.
What a method needs is imported when it is called first. Results that hold hulls, or that can be
written, stand in `results`; pictures in `pictures`; where hulls come from in `sources`.

Examples
--------
>>> import assoc_hull as ah
>>> hull = ah.examples.wigley()
>>> hull["WL 2.5 x ST 7"].parent_curve
<Curve ST 7>
>>> hull.check(), len(hull.history)
((), 0)
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Self

from assoc_hull.arguments import (
    flag,
    instance,
    integer,
    not_negative,
    number,
    shown,
    small_length,
    text,
    word,
)
from assoc_hull.edit.document import Document
from assoc_hull.edit.recording import Settings
from assoc_hull.edit.script import Changes, GapsName, PolicyName, carry_out
from assoc_hull.edit.session import Edit, join_edit, open_edit
from assoc_hull.edit.step import EditReport, EditReports
from assoc_hull.edit.write_lock import PATIENCE
from assoc_hull.errors import BadInputError, ForeignPointError, UnknownNameError, WrongTypeError
from assoc_hull.model.address import AddressBook
from assoc_hull.model.attachments import attachment_named
from assoc_hull.model.kinds import FAMILIES, OWN
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.objects import Crossing, Curve, Group, Line, Point, Points, handle
from assoc_hull.model.tables import Association, HullState, Particulars, copy_state, state_of
from assoc_hull.tolerance import Tolerances

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable
    from os import PathLike
    from typing import Any, Literal

    import networkx
    from numpy.typing import ArrayLike

    from assoc_hull.analysis.derivatives.hydrostatic_derivatives import Derivatives
    from assoc_hull.analysis.derivatives.parameters import Parameter
    from assoc_hull.analysis.form.curve_transform import CurveTransform, Kind
    from assoc_hull.analysis.form.floating_shape import Screw
    from assoc_hull.analysis.form.parameter import FormParameter, FormValue
    from assoc_hull.analysis.hydrostatics.floating_body import (
        Appendage,
        FloatingPosition,
        Freeboard,
    )
    from assoc_hull.analysis.hydrostatics.hull_hydrostatics import DraughtTo
    from assoc_hull.analysis.hydrostatics.record import Hydrostatics, HydrostaticTable
    from assoc_hull.analysis.hydrostatics.section_areas import Bonjean
    from assoc_hull.analysis.hydrostatics.tunnel import Tunnel
    from assoc_hull.analysis.panels.hull_panels import Side, Spacing
    from assoc_hull.analysis.resistance.calm_water_resistance import Resistance
    from assoc_hull.analysis.resistance.holtrop import Method
    from assoc_hull.analysis.stability.condition import OnError
    from assoc_hull.analysis.stability.cross_curves import CrossCurves
    from assoc_hull.analysis.stability.equilibrium import Equilibrium
    from assoc_hull.analysis.stability.flooding import FloodingPoint
    from assoc_hull.analysis.stability.righting_lever import TrimRule
    from assoc_hull.analysis.stability.stability_report import Stability
    from assoc_hull.creation.creation_report import CreationReport
    from assoc_hull.creation.design_reading import DesignReading
    from assoc_hull.creation.six_numbers import DesignNote
    from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
    from assoc_hull.edit.checks.finding import Finding
    from assoc_hull.edit.dirty_objects import Dirty
    from assoc_hull.edit.document import Changed, Label
    from assoc_hull.edit.drag import Drag, DragWay
    from assoc_hull.edit.explain.causes import Thing, Why
    from assoc_hull.edit.explain.compare_states import Comparison
    from assoc_hull.edit.explain.hull_graph import OnlyName
    from assoc_hull.edit.explain.preview import Measure, Preview
    from assoc_hull.edit.script import Replayed
    from assoc_hull.edit.shapes import Shapes
    from assoc_hull.fairing.fair_report import FairReport
    from assoc_hull.fairing.fair_window import FairWindow
    from assoc_hull.fairing.line_fairness import FairnessTable
    from assoc_hull.fairing.net_doctor import NetDoctorReport
    from assoc_hull.geometry.curves import FloatArray
    from assoc_hull.geometry.plane import Plane
    from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    from assoc_hull.hull.pictures import HullPictures
    from assoc_hull.hull.results import HullPlates, HullSurface, ProductionArcs
    from assoc_hull.hull.studies import Study
    from assoc_hull.hull.variants import Jumboised, Shifted, Variation
    from assoc_hull.io.hull_file.saving import Saved
    from assoc_hull.model.attached_body import AttachedBody
    from assoc_hull.model.definition.restore import Difference
    from assoc_hull.model.form_definition import FormDefinition
    from assoc_hull.model.objects import FeatureHandle
    from assoc_hull.model.tables import HasState
    from assoc_hull.plot.booklet.parts import PartName
    from assoc_hull.surface.blocks.fitted_surface import FittedSurface
    from assoc_hull.surface.cells.closed_mesh import ClosedMesh
    from assoc_hull.surface.plating.hull_seams import HullSeams
    from assoc_hull.variation.comparing.comparison import HullComparison
    from assoc_hull.variation.jumboise_hull import Names
    from assoc_hull.variation.parameters.field_layout import Layout
    from assoc_hull.variation.parameters.measurement import Measures
    from assoc_hull.variation.request import Planes, Stations, VariationRequest
    from assoc_hull.variation.sensitivities import Sensitivities
    from assoc_hull.variation.shifts.shift_terms import Fade, ShiftShape, Terminals

    Named = Group | Line | Curve | Point | Tunnel | AttachedBody

__all__ = ["Hull"]


class Hull:
    """A ship hull form, with its history; `adoption` tells how it was made of lines, if here.

    `notes` tells where the values of a ship from six numbers come from (`ah.create`).
    """

    def __init__(self, state: HullState | Document) -> None:
        if not isinstance(state, Document):
            state = Document(instance(state, HullState, "state", "in Hull"))
        self.document = state
        self.adoption: AdoptionReport | None = None
        self.notes: tuple[DesignNote, ...] = ()

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

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        # Asked by notebooks, which take from it what they can show.
        from assoc_hull.hull.notebook import mimebundle_of

        return mimebundle_of(self.state, repr(self))

    def _ipython_key_completions_(self) -> list[str]:
        return [*self.lines, *self.groups]

    @property
    def state(self) -> HullState:
        """The published tables; they stay as they are, whatever is edited later."""
        return self.document.state.published()

    @property
    def particulars(self) -> Particulars:
        """Name and principal dimensions, m."""
        return self.state.particulars

    @property
    def groups(self) -> Mapping[str, Group]:
        """The groups of lines by name, in the order of the ranks; last, those of one's own."""
        state = self.state
        table = state.groups
        rank = {name: family.rank for name, family in FAMILIES.items()} | {OWN: len(FAMILIES)}
        order = sorted(
            state.live("groups").tolist(), key=lambda i: (rank[table.family[i]], table.name[i])
        )
        groups = {str(table.name[i]): Group.of(state, i) for i in order}
        return NamedMapping("group", groups, spoken=True)

    @property
    def lines(self) -> Mapping[str, Line]:
        """All lines by name; by group and name where two groups have one of the same name."""
        state = self.state
        book, live = AddressBook(state), state.live("lines").tolist()
        lines = {book.line_name(i): Line.of(state, i) for i in live}
        return NamedMapping("line", lines, spoken=True)

    @property
    def points(self) -> Points:
        """All points by address."""
        return Points(self.state)

    @property
    def crossings(self) -> Mapping[str, Crossing]:
        """All crossings by address."""
        state = self.state
        book, table = AddressBook(state), state.rows
        live = [row for row in state.live("rows").tolist() if table.curve[row, 1] >= 0]
        crossings = {book.address(i): Crossing.of(state, i) for i in live}
        return NamedMapping("crossing", crossings, spoken=True)

    @property
    def features(self) -> Mapping[str, FeatureHandle]:
        """Circles, arcs, flats, straight runs, knuckle lines and joins by name."""
        from assoc_hull.model.objects import features_by_name

        return features_by_name(self.state)

    @property
    def tunnels(self) -> Mapping[str, Tunnel]:
        """The tunnels that the hull holds by name, measured as its shell is now."""
        from assoc_hull.analysis.hydrostatics.tunnel import kept_tunnels

        found = {each.name: each for each in kept_tunnels(self.state)}
        return NamedMapping("tunnel", found, spoken=True)

    @property
    def bodies(self) -> Mapping[str, AttachedBody]:
        """Hatches, deck houses, boxes and bossings beside the net by name; no part of the shell."""
        return NamedMapping("body", {each.name: each for each in self.state.bodies}, spoken=True)

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
    def history(self) -> EditReports:
        """The reports of all committed edits, oldest first."""
        return EditReports(step.report for step in tuple(self.document.history))

    @property
    def undone(self) -> EditReports:
        """The reports of edits that were taken back, the last one taken back last."""
        return EditReports(step.report for step in tuple(self.document.undone))

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
        self,
        name: str,
        policy: PolicyName | None = None,
        gaps: GapsName | None = None,
        *,
        author: str | None = None,
        wait: float = PATIENCE,
    ) -> Edit:
        """Begin an edit, for a ``with`` or ``async with`` statement; inside another one it joins.

        Only an edit of the same thread and task is joined. Inside an edit the hull reads as it was
        published; what the edit itself gives answers with what was asked for.

        Parameters
        ----------
        name : str
            Of the edit, for the history.
        policy : {"all_or_nothing", "keep_going"}
            What becomes of it when a curve cannot be made; the first if not given.
        gaps : {"refuse", "report"}
            Whether a gap over its limit refuses it; the first if not given.
        author : str or None
            Who edits; None for `author`.
        wait : float, s
            For how long another thread may be at work on this hull before this one is refused. A
            task of the same thread is refused at once; ``async with`` waits for both.

        Raises
        ------
        BadInputError
            An unknown policy or treatment of gaps, or others than those of the edit it joins.
        HullBusyError
            On entering: somebody else is at work on this hull, and has not ended in time.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("fuller forward", author="anna") as edit:
        ...     edit.move("WL 2.5 x ST 7", y=2.95)
        >>> hull.history[-1].author
        'anna'
        """
        outer = open_edit(self.document)
        settings = Settings.named(policy, gaps, None if outer is None else outer.settings)
        text(name, "the name", "in edit")
        if author is not None:
            text(author, "author", "in edit")
        not_negative(wait, "wait", "in edit", unit="s")
        if outer is not None:
            return join_edit(outer, settings, author)
        return Edit(self.document, name, settings, author=author, wait=wait)

    def preview(
        self,
        edits: Changes,
        policy: PolicyName = "all_or_nothing",
        gaps: GapsName = "refuse",
        *,
        name: str = "preview",
        why: Sequence[Thing | str] = (),
        shapes: bool = False,
        measure: Measure = True,
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
        shapes : bool
            Whether the curves that would change are given.
        measure : bool or "about"
            Whether volume and LCB are measured, when somebody asks for them: exactly, or about,
            by differences of sectional areas as a drag does, in a fraction of the time.

        Returns
        -------
        Preview
            The report, or why it would be refused; lines that would change; volume and LCB. Where
            something is asked with ``fair=True``, what the plain field would do is its ``plain``.

        Raises
        ------
        BadInputError
            An edit is open.
        WrongTypeError, UnknownNameError, AbsentParameterError, ForeignPointError
            What was asked for is not there, or is of another kind; all else is `refused`.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> move = [{"op": "move", "point": "WL 2.5 x ST 7", "y": 2.95}]
        >>> seen = hull.preview(move, shapes=True, measure=False)
        >>> seen.shapes.spline.count, seen.volume_change
        (2, None)
        """
        from assoc_hull.edit.explain.preview import preview

        return preview(
            self.document, lambda edit: carry_out(edit, edits), Settings.named(policy, gaps), name,
            why, shapes=shapes, measure=measure,
        )  # fmt: skip

    def drag(
        self,
        point: Point | str,
        how: DragWay = "pull",
        radius: tuple[float, float] | None = None,
        *,
        across_flats: bool = False,
        policy: PolicyName = "all_or_nothing",
        gaps: GapsName = "refuse",
    ) -> Drag:
        """Begin to drag a point: each step is carried out and read, and none is published.

        Parameters
        ----------
        point : Point or address
            The point.
        how : {"pull", "move"}
            A soft pull along the hull's normal, or the point alone along its freedom.
        radius : (float, float) or None, m
            Of a pull, as for `Edit.pull`.
        across_flats : bool
            Of a pull: whether flats may move.
        policy, gaps
            As for `edit`.

        Returns
        -------
        Drag
            For a ``with`` statement: ``to`` tells what the hull would be, ``commit`` makes the
            edit that the last ``to`` asked for, ``stop`` ends a ``to`` from another thread.

        Raises
        ------
        BadInputError
            An unknown way or point, or an edit is open.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.drag("WL 2.5 x ST 7", radius=(20.0, 4.0)) as drag:
        ...     for d in (0.005, 0.010, 0.015):
        ...         live = drag.to(d=d)  # a picture would be drawn from it
        ...     report = drag.commit("fuller shoulder")
        >>> print(f"{len(live.curves)} curves, about {live.volume_change:+.1f} m3")
        17 curves, about +2.4 m3
        >>> len(hull.history)
        1
        """
        from assoc_hull.edit.drag import Drag

        settings = Settings.named(policy, gaps)
        return Drag(self.document, point, how, radius, across_flats=across_flats, settings=settings)

    def shapes(self) -> Shapes:
        """Give all curves as one batch of splines, with their numbers.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> shapes = ah.examples.wigley().shapes()
        >>> shapes.spline.count == len(shapes.curves)
        True
        """
        from assoc_hull.edit.shapes import shapes_of

        return shapes_of(self.state)

    @property
    def state_number(self) -> int:
        """Number of the published state: it rises with each edit, undo, redo, go and refresh.

        It counts what this object has seen, from 0 where it was opened or made.
        """
        return self.document.state_number

    def snapshot(self) -> Self:
        """Give this hull as it is published now: in memory, without history, of its own.

        Nothing is copied until one of the two is edited, so it takes a fraction of a millisecond.
        For readers in other threads that need several things of one state: what they ask this hull
        itself for, one after the other, may come from states that follow one another.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> before = hull.snapshot()
        >>> with hull.edit("fuller") as edit:
        ...     edit.move("WL 2.5 x ST 7", y=2.95)
        >>> before.points["WL 2.5 x ST 7"].y < hull.points["WL 2.5 x ST 7"].y
        True
        """
        found = type(self)(self.document.state.snapshot())
        found.adoption, found.notes = self.adoption, self.notes
        return found

    def since(self, number: int) -> Changed:
        """Tell which curves, points and lines have changed since the state with a number.

        Raises
        ------
        BadInputError
            There was no such state.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> seen = hull.state_number
        >>> report = hull.apply("a", [{"op": "move", "point": "WL 2.5 x ST 7", "y": 2.95}])
        >>> len(hull.since(seen).curves) == len(report.relofted)
        True
        """
        return self.document.since(number)

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

    def undo(self, n: int = 1, *, author: str | None = None) -> None:
        """Take back the last edits; stored values come back, nothing is computed.

        Parameters
        ----------
        n : int
            How many.
        author : str or None
            Only edits of this author; refused where edits of others lie above them.

        Raises
        ------
        BadInputError
            There are not so many, an edit is open, or edits of others lie above: they are named.
        HullBusyError
            Somebody else is at work on this hull.
        """
        self.document.undo(n, None if author is None else text(author, "author", "in undo"))

    def redo(self, n: int = 1) -> None:
        """Make edits that were taken back again.

        Raises
        ------
        BadInputError
            There are not so many, or an edit is open.
        HullBusyError
            Somebody else is at work on this hull.
        """
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
        """Compare two checkpoints or branches, or one with the present state.

        `assoc_hull.variation.compare` compares two hulls.

        Raises
        ------
        UnknownNameError
            There is no checkpoint or branch of a name.
        WrongTypeError
            A hull was given.
        """
        from assoc_hull.edit.explain.compare_states import compare_labelled

        if any(isinstance(each, Hull) for each in (before, after)):
            what = "diff compares states of one hull by their names; a hull was given"
            remedy = "call ah.variation.compare(hull, other) for two hulls"
            raise WrongTypeError(what, "in diff", remedy)
        return compare_labelled(self.document, before, after)

    def replay(self, other: Hull, *, skip: bool = False) -> tuple[Replayed, ...]:
        """Make the edits of another hull again on this one; see `assoc_hull.edit.script`."""
        from assoc_hull.edit.script import replay

        steps = instance(other, Hull, "other", "in replay").document.history
        return replay(
            self.document, steps, skip=flag(skip, "skip", "in replay"),
            vary=lambda script: self.vary_by(script, in_place=True).report.edit,
        )  # fmt: skip

    def __getitem__(self, address: str) -> Named:
        """Give what an address names: a line, point, curve, group, tunnel or body; as `find`."""
        return self.find(address)

    def __contains__(self, address: object) -> bool:
        """Whether an address names a line, point, curve, group, tunnel or body of the hull."""
        try:
            if isinstance(address, str) and not address.strip():
                return False  # nothing is named so
            self.find(text(address, "the address", "in a look-up"))
        except UnknownNameError:
            return False
        return True

    # A hull is no sequence: without this, Python would ask it for hull[0], hull[1], ...
    __iter__ = None

    def find(self, address: str) -> Named:
        """Give what an address names; see `assoc_hull.model.address`.

        Tunnels and bodies have a name only.
        """
        try:
            return handle(self.state, address)
        except WrongTypeError:
            # What no line or point is called may stand beside the net.
            beside = attachment_named(self.state, text(address, "the address", "in a look-up"))
            if beside is None:
                raise
            name = beside[1].name
            return self.tunnels[name] if name in self.tunnels else self.bodies[name]

    @property
    def dirty(self) -> Dirty:
        """What the edit that is open here has reached so far, by address, and because of what.

        Nothing where none is open. `Curve.dirty` and `Point.dirty` tell the same of one object; see
        `assoc_hull.edit.dirty_objects.Dirty`.
        """
        from assoc_hull.edit.dirty_objects import Dirty

        return Dirty(self.document.state, self.document.state.dirty_here())

    def why(
        self,
        thing: Thing | FormDefinition | str,
        *,
        step: int | None = None,
        least: float | None = None,
    ) -> Why:
        """Explain a change of a point, curve, definition, or a line's first curve.

        Parameters
        ----------
        thing : handle, address or definition
            The object.
        step : int or None
            The number of an edit of the history, -1 for the last; None for the last that reached
            the object.
        least : float or None, m
            Causes that moved less are left out, and counted. None: where an edit set points that
            nobody named, as a pull does, those below a hundredth of the largest.

        Raises
        ------
        UnknownNameError, ForeignPointError, BadInputError
            Nothing that this hull has, or a group; an edit that the history does not have.
        """
        from assoc_hull.edit.explain.causes import node_of, why

        if least is not None:
            not_negative(least, "least", "in why", unit="m")
        return why(self.document, node_of(self.state, thing), step, least)

    def check(self, notes: bool = False) -> tuple[Finding, ...]:
        """Give what is wrong with the hull; empty if nothing is."""
        from assoc_hull.edit.checks.hull_findings import check

        return check(self.state, flag(notes, "notes", "in check"))

    def verify(self, relative: float = 0.0) -> tuple[Difference, ...]:
        """Rebuild the hull beside the published one, look through its file: all that differs."""
        from assoc_hull.io.hull_file.saving import file_damages
        from assoc_hull.model.definition.restore import verify

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
        step: int | None = None,
    ) -> networkx.MultiDiGraph[str]:
        """Give objects and links as a graph, or what lies around one of them.

        Parameters
        ----------
        around : handle, address or definition, or None
            Only what lies near this object; of a line, its curves. None: all of the hull.
        up, down : int
            Most links against and along their direction, from `around`.
        only : {"two-way", "one-way", "latent", "changed", "dirty"} or None
            Links by which both curves generate points, only one does, or none does yet; what an
            edit changed; what the edit that is open here has reached.
        step : int or None
            Only what the edit of this number of the history changed; -1 is the last.

        Returns
        -------
        networkx.MultiDiGraph
            What passes every filter; nodes and links have attributes, see docs/inspection.md.

        Raises
        ------
        UnknownNameError, ForeignPointError, WrongTypeError, BadInputError
            No such object, filter or edit.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> found = hull.graph(around=hull["WL 2.5 x ST 7"], up=0, down=1)
        >>> sorted(data["kind"] for _, data in found.nodes(data=True))
        ['curve', 'curve', 'point', 'point']
        """
        from assoc_hull.edit.explain.hull_graph import graph_of

        hops = integer(up, "up", "in graph", least=0), integer(down, "down", "in graph", least=0)
        return graph_of(self.document, around, hops, only, step)

    def dependencies(self, points: bool = False) -> networkx.DiGraph[str]:
        """Give who drives whom now; see `assoc_hull.model.object_graph.dependencies`."""
        from assoc_hull.model.object_graph import dependencies

        return dependencies(self.state, flag(points, "points", "in dependencies"))

    def half_breadth(self, x: float, z: float) -> float:
        """Give the half-breadth (m) at x and z (m); see `assoc_hull.model.half_breadth`."""
        from assoc_hull.model.half_breadth import half_breadth

        where = "in half_breadth"
        return half_breadth(self.state, number(x, "x", where), number(z, "z", where))

    def meet(
        self,
        line: Line | Curve | str,
        plane: Plane | tuple[Sequence[float], float] | None = None,
        *,
        x: float | None = None,
        y: float | None = None,
        z: float | None = None,
    ) -> FloatArray:
        """Find where a line meets a plane; nothing is added to the hull.

        Parameters
        ----------
        line : Line, Curve or str
            The line, all its curves, or one curve of it; or its name.
        plane : Plane, or (unit normal, offset in m)
            The plane, whose points P have ``normal . P = offset``.
        x, y, z : float, m
            In place of `plane`, the coordinate that its points share: x forward from AP, y to
            port from the centre plane, z up from the base line.

        Returns
        -------
        (k, 3), m
            The places where it passes, touches or ends on the plane, in order along each curve;
            the two ends of a run along the plane; none where the line lies in the plane.

        Raises
        ------
        BadInputError, WrongTypeError
            No plane or several, a normal that is not of unit length, no line.
        UnknownNameError
            The hull has no such line; near names are told.
        ForeignPointError
            A line of another hull.

        See Also
        --------
        half_breadth : at any place of the hull, also between lines.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> hull.meet("WL 2.5", x=52.5).round(3).tolist()
        [[52.5, 3.192, 2.5]]
        >>> len(hull.meet("WL 2.5", ((0.6, 0.8, 0.0), 33.0)))
        1
        """
        from assoc_hull.geometry.plane import plane_asked

        found = self.find(line) if isinstance(line, str) else line
        if not isinstance(found, Line | Curve):
            what = f"the line is {shown(line)}"
            raise WrongTypeError(what, "in meet", "give a line or a curve, or its name")
        if found.home is not self.state.live_tables:
            raise ForeignPointError(f"{type(found).__name__.lower()} {found.id!r}")
        return found.meet(plane_asked(plane, x, y, z, "in meet"))

    def tunnel(self, name: str, *, x: float, z: float, radius: float) -> Tunnel:
        """Measure a thruster's tunnel athwartships through the hull, as it is now; none is kept.

        `Edit.tunnel` keeps one in the hull, and `tunnels` lists those.

        Parameters
        ----------
        name : str
            What it is called.
        x, z, radius : float, m
            Of its axis, from AP and from the base line; of its inside.

        Returns
        -------
        Tunnel
            Mouth, gaps in lines, volume, surfaces, and an `appendage` for `hydrostatics`.

        Raises
        ------
        BadInputError
            The tunnel leaves the hull; the message tells where.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> tunnel = hull.tunnel("bow thruster", x=88.0, z=3.0, radius=0.8)
        >>> tunnel.gap(x=88.0)
        (2.2, 3.8)
        >>> bare = hull.hydrostatics(draught=6.25).volume
        >>> less = hull.hydrostatics(draught=6.25, appendages=[tunnel.appendage]).volume
        >>> round(bare - less - tunnel.volume, 9)
        0.0
        """
        from assoc_hull.analysis.hydrostatics.tunnel import measure_tunnel

        return measure_tunnel(self, name, x, z, radius)

    # ----------------------------------------------------------------------------------
    # Numbers of the hull as she floats.

    def hydrostatics(
        self,
        *,
        draught: float | None = None,
        draughts: tuple[float, float] | None = None,
        heel_deg: float = 0.0,
        rho: float = 1.025,
        shell_factor: float = 1.0,
        kg: float | None = None,
        transom: bool = False,
        on_error: OnError = "refuse",
        appendages: Iterable[Appendage] = (),
        keel_thickness: float = 0.0,
        draught_to: DraughtTo = "moulded",
        estimate: bool = True,
        demihulls: int = 1,
        separation: float | None = None,
    ) -> Hydrostatics:
        """Compute the hydrostatics of a hull at one floating position.

        Parameters
        ----------
        draught : float, m
            At even keel; or `draughts`. The design draught if neither is given.
        draughts : (float, float), m
            T_A and T_F, on the centre line at the perpendiculars.
        heel_deg : float, degrees
            + starboard down.
        rho : float, t/m3
            Density of the water: 1.025 salt, 1.000 fresh.
        shell_factor : float
            Displacement over that of the moulded volume.
        kg : float or None, m
            Centre of gravity above the base line.
        transom : bool
            Count the immersed transom, and other flat ends, as wetted surface.
        on_error : "refuse" or "report"
            What to do if the integrals are doubtful: a section that is open or crosses itself, two
            routes that disagree. What is reported stands in the `notes` of the record.
        appendages : iterable of Appendage
            That are added to the moulded hull.
        keel_thickness : float, m
            From the base line down to the underside of keel.
        draught_to : "moulded" or "keel"
            Whether draughts are given to the base line, or to the underside of keel; the record is
            always of moulded ones.
        estimate : bool
            Estimate how far each value may be off by the integration of these lines. Without,
            numbers are not compared with those of other routes either: only the lines can make it
            doubtful.
        demihulls : 1 or 2
            2: the numbers of a ship of two demihulls, each of them this hull: volume, displacement,
            wetted surface, waterplane and sections are those of both; I_T, BM_T and KM_T have the
            transfer term of each about the ship's centre plane, from which y is measured.
            Coefficients are on the breadths of both together, so that they are a demihull's;
            `bwl` is over all. Appendages are given for the ship.
        separation : float or None, m
            Between the centre planes of two demihulls.

        Returns
        -------
        Hydrostatics
            The record.

        Raises
        ------
        OutOfRangeError
            A position in which the hull does not float, with the range.
        BadInputError
            A number that cannot be used; a doubtful hull.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> round(hull.hydrostatics(draught=6.25).cb, 3)  # 4/9
        0.444
        """
        from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics

        return hydrostatics(
            self,
            draught=draught,
            draughts=draughts,
            heel_deg=heel_deg,
            rho=rho,
            shell_factor=shell_factor,
            kg=kg,
            transom=transom,
            on_error=on_error,
            appendages=appendages,
            keel_thickness=keel_thickness,
            draught_to=draught_to,
            estimate=estimate,
            demihulls=demihulls,
            separation=separation,
        )

    def hydrostatic_table(
        self,
        draughts: Sequence[float],
        trims: Sequence[float] = (0.0,),
        *,
        heel_deg: float = 0.0,
        rho: float = 1.025,
        shell_factor: float = 1.0,
        kg: float | None = None,
        transom: bool = False,
        on_error: OnError = "refuse",
        appendages: Iterable[Appendage] = (),
        keel_thickness: float = 0.0,
        draught_to: DraughtTo = "moulded",
        estimate: bool = True,
        demihulls: int = 1,
        separation: float | None = None,
        date: str | None = None,
    ) -> HydrostaticTable:
        """Compute a table of hydrostatics over draughts and trims, all in one go.

        Parameters
        ----------
        draughts : (n,), m
            Mean draughts, rising.
        trims : (k,), m
            T_A - T_F: + by the stern, rising.
        heel_deg, rho, shell_factor, kg, transom, on_error, appendages, keel_thickness
            As for `hydrostatics`.
        draught_to, estimate, demihulls, separation
            As for `hydrostatics`.
        date : str or None
            For the head of the table.

        Raises
        ------
        OutOfRangeError, BadInputError
            As `hydrostatics`; also draughts or trims that do not rise.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> table = ah.examples.wigley().hydrostatic_table([2.0, 4.0, 6.0], [0.0, 0.5])
        >>> table.shape, table[2, 1].trim_by_stern
        ((3, 2), 0.5)
        """
        from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatic_table

        return hydrostatic_table(
            self,
            draughts,
            trims,
            heel_deg=heel_deg,
            rho=rho,
            shell_factor=shell_factor,
            kg=kg,
            transom=transom,
            on_error=on_error,
            appendages=appendages,
            keel_thickness=keel_thickness,
            draught_to=draught_to,
            estimate=estimate,
            demihulls=demihulls,
            separation=separation,
            date=date,
        )

    def hydrostatic_derivatives(
        self,
        wrt: Iterable[Parameter],
        *,
        draught: float | None = None,
        draughts: tuple[float, float] | None = None,
        heel_deg: float = 0.0,
        rho: float = 1.025,
        shell_factor: float = 1.0,
        kg: float | None = None,
        transom: bool = False,
        on_error: OnError = "refuse",
        appendages: Iterable[Appendage] = (),
        keel_thickness: float = 0.0,
        draught_to: DraughtTo = "moulded",
    ) -> Derivatives:
        """Differentiate the hydrostatics of a hull at one floating position.

        Parameters
        ----------
        wrt : iterable of k parameters
            By what: `DRAUGHT`, `TRIM`, `DRAUGHT_AFT`, `DRAUGHT_FORE` (m), `HEEL` (degree),
            `PointMove` (m), `Deformation`; of `assoc_hull.analysis.derivatives.parameters`; or
            `Moves`.
        draught, draughts, heel_deg, rho, shell_factor, kg, transom, on_error, appendages
            As for `hydrostatics`.
        keel_thickness, draught_to
            As for `hydrostatics`.

        Returns
        -------
        Derivatives
            The record, and its derivatives.

        Raises
        ------
        WrongTypeError, BadInputError, UnknownNameError, FreedomError, PointRoleError
            A parameter that cannot be used; else as `hydrostatics`.

        Notes
        -----
        Draughts, water, KG and appendages stay as they are, and so do Lpp and B but where a
        parameter has rates for them (`assoc_hull.analysis.derivatives.parameters.Moves`). The
        layout of the surface is that of the hull as it stands; where a value has a kink (the
        largest station changes, a section begins to be wet) the derivative is that to one side.

        Examples
        --------
        >>> from assoc_hull.analysis.derivatives.parameters import DRAUGHT, PointMove
        >>> import assoc_hull as ah
        >>> wrt = [DRAUGHT, PointMove("WL 2.5 x ST 7")]
        >>> found = ah.examples.wigley().hydrostatic_derivatives(wrt, draught=6.25)
        >>> found.of("volume").round(2).tolist(), round(found.value.waterplane_area, 2)
        ([666.63, 6.25], 666.63)
        """
        from assoc_hull.analysis.derivatives.hydrostatic_derivatives import hydrostatic_derivatives

        return hydrostatic_derivatives(
            self,
            wrt,
            draught=draught,
            draughts=draughts,
            heel_deg=heel_deg,
            rho=rho,
            shell_factor=shell_factor,
            kg=kg,
            transom=transom,
            on_error=on_error,
            appendages=appendages,
            keel_thickness=keel_thickness,
            draught_to=draught_to,
        )

    def immersion(
        self,
        weight: float,
        *,
        lcg: float | None = None,
        kg: float | None = None,
        trim_by_stern: float = 0.0,
        heel_deg: float = 0.0,
        rho: float = 1.025,
        shell_factor: float = 1.0,
        appendages: Iterable[Appendage] = (),
    ) -> FloatingPosition:
        """Find the draughts at which a hull carries a weight (`loading`).

        Parameters
        ----------
        weight : float, t
            All of it.
        lcg, kg : float or None, m
            Centre of gravity from AP and above base; without `lcg` the trim is as given.
        trim_by_stern, heel_deg : m, degrees
            Of the ship; with `lcg` the trim is found, and none may be given.
        rho, shell_factor, appendages
            As for `hydrostatics`.

        Raises
        ------
        OutOfRangeError
            A weight that the hull does not carry, with the range.
        BadInputError
            A number that cannot be used; trim and `lcg` both; no trim at which the hull would
            float.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> round(ah.examples.wigley().immersion(2777.8 * 1.025).draught_aft, 2)
        6.25
        """
        from assoc_hull.analysis.hydrostatics.draughts_from_weight import immersion

        return immersion(
            self,
            weight,
            lcg=lcg,
            kg=kg,
            trim_by_stern=trim_by_stern,
            heel_deg=heel_deg,
            rho=rho,
            shell_factor=shell_factor,
            appendages=appendages,
        )

    def equilibrium(
        self,
        weight: float,
        *,
        lcg: float,
        kg: float,
        tcg: float = 0.0,
        rho: float = 1.025,
        shell_factor: float = 1.0,
        appendages: Iterable[Appendage] = (),
        on_error: OnError = "refuse",
    ) -> Equilibrium:
        """Find the draughts and the heel at which a ship comes to rest from upright.

        Parameters
        ----------
        weight : float, t
            All of it.
        lcg, tcg, kg : float, m
            Centre of gravity from AP, to port, and above the base line.
        rho, shell_factor, appendages, on_error
            As for `stability`.

        Returns
        -------
        Equilibrium
            Position, and how stable it is.

        Raises
        ------
        OutOfRangeError
            A weight that she does not carry, with the range.
        BadInputError
            A number that cannot be used; she does not come to rest before 85 degrees, or before the
            edge of her open deck goes under.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.wigley().equilibrium(2847.0, lcg=51.0, tcg=-0.1, kg=4.0)
        >>> found.kind, round(found.position.heel_deg, 2)
        ('list', 4.46)
        """
        from assoc_hull.analysis.stability.equilibrium import equilibrium

        return equilibrium(
            self,
            weight,
            lcg=lcg,
            kg=kg,
            tcg=tcg,
            rho=rho,
            shell_factor=shell_factor,
            appendages=appendages,
            on_error=on_error,
        )

    def stability(
        self,
        *,
        kg: float,
        weight: float | None = None,
        draught: float | None = None,
        draughts: tuple[float, float] | None = None,
        lcg: float | None = None,
        tcg: float = 0.0,
        trim: TrimRule = "fixed",
        heels: Sequence[float] | None = None,
        flooding: Iterable[FloodingPoint] = (),
        rho: float = 1.025,
        shell_factor: float = 1.0,
        appendages: Iterable[Appendage] = (),
        on_error: OnError = "refuse",
        date: str | None = None,
    ) -> Stability:
        """Compute the righting levers of a ship in a condition, and judge them.

        Parameters
        ----------
        kg : float, m
            Centre of gravity above the base line, corrected for free surfaces by the caller.
        weight : float, t
            All of it; or `draught`, or `draughts`; the design draught if none is given.
        draught, draughts : float or (float, float), m
            At even keel, or T_A and T_F: upright, moulded.
        lcg : float or None, m
            With `weight`: centre of gravity from AP. Without, she is at even keel upright.
        tcg : float, m
            Centre of gravity to port.
        trim : "fixed" or "free"
            Keep the trim that she has upright, or find that of equilibrium at each heel.
        heels : (d,), degrees
            For the table: rising, + starboard down, from -90 to 90.
        flooding : iterable of FloodingPoint
            Openings through which water comes in.
        rho, shell_factor, appendages, on_error
            As for `hydrostatics`.
        date : str or None
            For the head.

        Returns
        -------
        Stability
            Levers, angles and criteria.

        Raises
        ------
        OutOfRangeError
            A weight that she does not carry, draughts at which she does not float, with the range.
        BadInputError
            A number that cannot be used; a doubtful hull.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.wigley().stability(draught=6.25, kg=4.0, heels=[0, 10, 20, 30])
        >>> found.kn.round(3).tolist()
        [0.0, 0.918, 1.82, 2.694]
        """
        from assoc_hull.analysis.stability.condition import HEELS
        from assoc_hull.analysis.stability.stability_report import stability

        return stability(
            self,
            kg=kg,
            weight=weight,
            draught=draught,
            draughts=draughts,
            lcg=lcg,
            tcg=tcg,
            trim=trim,
            flooding=flooding,
            rho=rho,
            shell_factor=shell_factor,
            appendages=appendages,
            on_error=on_error,
            date=date,
            heels=HEELS if heels is None else heels,
        )

    def cross_curves(
        self,
        *,
        weights: Sequence[float] | None = None,
        draughts: Sequence[float] | None = None,
        heels: Sequence[float] | None = None,
        trim_by_stern: float = 0.0,
        trim: TrimRule = "fixed",
        rho: float = 1.025,
        shell_factor: float = 1.0,
        kg: float | None = None,
        appendages: Iterable[Appendage] = (),
        on_error: OnError = "refuse",
        date: str | None = None,
    ) -> CrossCurves:
        """Compute KN over displacement and heel, all in one go.

        Parameters
        ----------
        weights : (n,), t
            Displacements at even keel, rising; or `draughts`.
        draughts : (n,), m
            Mean draughts upright, rising.
        heels : (k,), degrees
            Rising, + starboard down, from -90 to 90.
        trim_by_stern : float, m
            Of the draughts, upright.
        trim : "fixed" or "free"
            Keep the trim that she has upright, or find that of equilibrium at each heel, with the
            centre of gravity where it balances her upright.
        kg : float or None, m
            Where it lies above the base line, for the trim of equilibrium; None: at each heel as
            high as the centre of buoyancy.
        rho, shell_factor, appendages, on_error, date
            As for `stability`.

        Raises
        ------
        OutOfRangeError
            A displacement that she does not carry, or a draught at which she does not float.
        BadInputError
            Neither weights nor draughts, or both; a number that cannot be used; a doubtful hull.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.wigley().cross_curves(draughts=[5.0, 6.25], heels=[10, 30])
        >>> found.kn.shape, found.kn[1].round(3).tolist()
        ((2, 2), [0.918, 2.694])
        """
        from assoc_hull.analysis.stability.cross_curves import ANGLES, cross_curves

        return cross_curves(
            self,
            weights=weights,
            draughts=draughts,
            trim_by_stern=trim_by_stern,
            trim=trim,
            rho=rho,
            shell_factor=shell_factor,
            kg=kg,
            appendages=appendages,
            on_error=on_error,
            date=date,
            heels=ANGLES if heels is None else heels,
        )

    def freeboard(self, position: FloatingPosition) -> Freeboard:
        """Give the least height of the deck edge above the water, and where.

        Parameters
        ----------
        position : FloatingPosition
            Where it floats, moulded.

        Raises
        ------
        OutOfRangeError
            It does not float there.
        """
        from assoc_hull.analysis.hydrostatics.draughts_from_weight import freeboard

        return freeboard(self, position)

    def deck_edge_angle(
        self,
        position: FloatingPosition,
        appendages: Iterable[Appendage] = (),
        *,
        demihulls: int = 1,
        separation: float | None = None,
    ) -> float | None:
        """Give the heel (degrees) at which the deck edge goes under, at this displacement and trim.

        Parameters
        ----------
        position : FloatingPosition
            Where it floats upright, moulded.
        appendages : iterable of Appendage
            That carry as well.
        demihulls : {1, 2}
            2: of the ship of two such hulls side by side, `separation` (m) between their centre
            planes; see `hydrostatics`.
        separation : float or None, m
            Needed with two demihulls.

        Raises
        ------
        OutOfRangeError
            It does not float there.
        """
        from assoc_hull.analysis.hydrostatics.draughts_from_weight import deck_edge_angle

        return deck_edge_angle(
            self, position, appendages, demihulls=demihulls, separation=separation
        )

    def bonjean(self, levels: int | ArrayLike = 41) -> Bonjean:
        """Give the Bonjean curves of a hull, from the keel to the deck edge.

        Parameters
        ----------
        levels : int or (n,) m
            At these heights, from below; or at so many, from the lowest place of the hull to the
            lowest of an open deck edge, or the highest of a closed one.

        Raises
        ------
        BadInputError
            Fewer than two levels, heights that do not rise, numbers that are none.
        OutOfRangeError
            A height outside that range.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> curves = ah.examples.wigley().bonjean([2.0, 4.0, 6.0])
        >>> curves.stations.area.shape == curves.moment.shape == (3, len(curves.stations.x))
        True
        """
        from assoc_hull.analysis.hydrostatics.section_areas import bonjean

        return bonjean(self, levels)

    def section_points(
        self,
        x: object,
        *,
        points: int = 20,
        draught: float | None = None,
        draughts: tuple[float, float] | None = None,
    ) -> FloatArray:
        """Part immersed half sections of an upright hull into equal lengths.

        All pieces of a section (bulb and stem, bossing and counter) are one length, one after the
        other from below; the way from one to the next does not count.

        Parameters
        ----------
        x : float or (k,), m
            Where the sections are, from AP.
        points : int
            On each, from the keel to the waterline, both ends counted.
        draught : float, m
            At even keel; or `draughts`. The design draught if neither is given.
        draughts : (float, float), m
            T_A and T_F, on the centre line at the perpendiculars.

        Returns
        -------
        (k, points, 3), m
            Port side, in the axes of the ship; nan where nothing is wet. Beyond the last stations
            the curves of the surface lean: there they are those whose place is x by proportion.

        Raises
        ------
        OutOfRangeError
            A position in which the hull does not float, with the range.
        BadInputError
            A number that cannot be used.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.bulk_carrier_207k().section_points(150.0, points=4)
        >>> found[0, :, 1:].round(3).tolist()
        [[0.0, 0.0], [13.99, 0.0], [25.0, 4.01], [25.0, 18.0]]
        """
        from assoc_hull.analysis.panels.hull_panels import section_points

        return section_points(self, x, points=points, draught=draught, draughts=draughts)

    def panels(
        self,
        *,
        draught: float | None = None,
        draughts: tuple[float, float] | None = None,
        heel_deg: float = 0.0,
        count: int | None = None,
        stations: int | Sequence[float] | None = None,
        points: int | None = None,
        spacing: Spacing = "arc",
        side: Side | None = None,
        knuckle_deg: float | None = None,
        transom: bool = True,
        origin: float | None = None,
        on_error: Literal["refuse", "report"] = "refuse",
    ) -> PanelMesh:
        """Divide the immersed hull into panels, for seakeeping codes.

        Half sections are parted into equal lengths from keel to waterline, and neighbouring ones
        joined by quadrilaterals, by triangles where a section is a point. The mesh follows the
        surface that hydrostatics integrates; it is closed but for the water surface.

        Parameters
        ----------
        draught : float, m
            At even keel; or `draughts`. The design draught if neither is given.
        draughts : (float, float), m
            T_A and T_F, on the centre line at the perpendiculars.
        heel_deg : float, degrees
            + starboard down.
        count : int or None
            How many panels to aim at, of the half or the full mesh; instead of `stations` and
            `points`, or with one of them.
        stations : int, (k,) m, or None
            How many sections to join, or at which x; sections at which the hull ends, branches or
            joins are added. By the shape of the panels if not given.
        points : int or None
            On a half section, both ends counted; 20 if neither this nor `count` is given.
        spacing : "arc" or "cosine"
            Sections by equal lengths along the waterline, or close together at both ends.
        side : "half", "full" or None
            Port only, to be mirrored by the code, or both sides. None: half if upright.
        knuckle_deg : float or None
            Put points on knuckles that turn by more; the lengths between share the panels by the
            largest remainder. None: points are spaced equally throughout.
        transom : bool
            Close immersed transoms and other ends of the surface by panels.
        origin : float or None, m
            x from AP of the origin of the mesh; midship, Lpp / 2, if None.
        on_error : "refuse" or "report"
            What to do if lines make the surface doubtful.

        Returns
        -------
        PanelMesh
            With the water surface at z = 0, x forward in it, y to port.

        Raises
        ------
        OutOfRangeError
            A position in which the hull does not float, or a station beyond what is wet of it, with
            the range.
        BadInputError
            A number that cannot be used; half of a heeled hull; a doubtful hull.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> mesh = ah.examples.wigley().panels(stations=41, points=11)
        >>> mesh.count, mesh.mirror_y, round(float(mesh.volumes[0]), 1)  # exactly 2777.8
        (400, True, 2768.2)
        """
        from assoc_hull.analysis.panels.hull_panels import panels

        return panels(
            self,
            draught=draught,
            draughts=draughts,
            heel_deg=heel_deg,
            count=count,
            stations=stations,
            points=points,
            spacing=spacing,
            side=side,
            knuckle_deg=knuckle_deg,
            transom=transom,
            origin=origin,
            on_error=on_error,
        )

    # ----------------------------------------------------------------------------------
    # Numbers of her form.

    def form_parameters(
        self,
        *,
        draught: float | None = None,
        draughts: tuple[float, float] | None = None,
        screw: Screw | None = None,
        rho: float = 1.025,
        shell_factor: float = 1.0,
        transom: bool = False,
        only: Iterable[str] | None = None,
        further: Iterable[FormParameter] = (),
    ) -> Mapping[str, FormValue]:
        """Give the form parameters of a hull, upright at a draught.

        Values are computed once: until a line of the hull changes, asking again costs nothing.

        Parameters
        ----------
        draught : float, m
            At even keel; or `draughts`. The design draught if neither is given.
        draughts : (float, float), m
            T_A and T_F, on the centre line at the perpendiculars.
        screw : Screw or None
            Without it, what depends on screw and shaft has no value.
        rho, shell_factor, transom
            As for `hydrostatics`.
        only : iterable of str or None
            Symbols of the entries wanted; None: all of them.
        further : iterable of FormParameter
            Entries of one's own, which may need others of the catalogue.

        Returns
        -------
        mapping of str to FormValue
            By symbol: a number with its unit, or the reason why there is none.

        Raises
        ------
        OutOfRangeError
            A position in which the hull does not float, with the range.
        UnknownNameError
            A symbol that is no entry.
        BadInputError
            A number that cannot be used; entries that do not fit into the catalogue.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.wigley().form_parameters(draught=6.25)
        >>> round(found["Cb"].number, 3), found["Cb"].unit  # 4/9
        (0.444, '-')
        """
        from assoc_hull.analysis.form.form_parameters import form_parameters

        return form_parameters(
            self,
            draught=draught,
            draughts=draughts,
            screw=screw,
            rho=rho,
            shell_factor=shell_factor,
            transom=transom,
            only=only,
            further=further,
        )

    def resistance(
        self,
        speeds: ArrayLike,
        *,
        method: Method = "1984",
        draught: float | None = None,
        draughts: tuple[float, float] | None = None,
        c_stern: float = 0.0,
        appendage_area: float = 0.0,
        appendage_factor: float | None = None,
        thruster_diameter: float = 0.0,
        thruster_coefficient: float | None = None,
        wetted_surface: float | None = None,
        entrance_deg: float | None = None,
        bulb_area: float | None = None,
        bulb_height: float | None = None,
        transom_area: float | None = None,
        rho: float = 1.025,
        nu: float = 1.18831e-6,
        roughness: float = 150e-6,
    ) -> Resistance:
        """Estimate the resistance of a hull in calm deep water by Holtrop's regression.

        Of the bare hull, and of what is stated. What it is computed from are form parameters of the
        hull as she floats upright; the result shows each with its source.

        Parameters
        ----------
        speeds : float or (n,), kn
            Above 0, in any order.
        method : "1984" or "1982"
            The paper: Holtrop (1984), or Holtrop and Mennen (1982).
        draught : float, m
            At even keel; or `draughts`. The design draught if neither is given.
        draughts : (float, float), m
            T_A and T_F, on the centre line at the perpendiculars.
        c_stern : float
            -25 pram with gondola, -10 V-shaped sections, 0 normal, +10 U-shaped with Hogner stern.
        appendage_area : float, m2
            S_APP, wetted surface of all appendages.
        appendage_factor : float or None
            1 + k_2 of them, the mean by area, from 1 up.
        thruster_diameter : float, m
            Of the opening of a bow thruster.
        thruster_coefficient : float or None
            C_BTO of it, 0.003 to 0.012.
        wetted_surface : float or None, m2
            S of the bare hull; None: measured.
        entrance_deg : float or None, degrees
            i_E, half angle of entrance; None: by the regression, beside which the measured one is
            shown.
        bulb_area, bulb_height : float or None, m2 and m
            A_BT of the section at FP, both sides, and the height of its centre above the base line;
            None: measured. Above 0.6 T_F the height counts as that.
        transom_area : float or None, m2
            A_T, immersed at rest; None: measured.
        rho : float, t/m3
            Density of the water.
        nu : float, m2/s
            Its kinematic viscosity: that of salt water of 15 degrees.
        roughness : float, m
            Of the shell, from 150e-6 up.

        Returns
        -------
        Resistance
            RF, form, RAPP, RW, RB, RTR, RA and their total at each speed, kN; coefficients, inputs,
            and warnings where the ship lies outside the ranges of the regression. Prints a table.

        Raises
        ------
        BadInputError
            A speed, method or number that cannot be used; a doubtful hull; one of appendages and
            their factor without the other.
        OutOfRangeError
            A position in which the hull does not float; a ship or speed of which the regression
            cannot tell the resistance.

        See Also
        --------
        assoc_hull.hydro.holtrop : the same of main dimensions, without a hull.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.wigley().resistance([10.0, 15.0])
        >>> found.total.round(1).tolist()
        [52.0, 139.5]
        >>> [each.source for each in found.inputs if each.symbol == "i_E"]
        ['regression']
        """
        from assoc_hull.analysis.resistance.hull_resistance import resistance

        return resistance(
            self,
            speeds,
            method=method,
            draught=draught,
            draughts=draughts,
            c_stern=c_stern,
            appendage_area=appendage_area,
            appendage_factor=appendage_factor,
            thruster_diameter=thruster_diameter,
            thruster_coefficient=thruster_coefficient,
            wetted_surface=wetted_surface,
            entrance_deg=entrance_deg,
            bulb_area=bulb_area,
            bulb_height=bulb_height,
            transom_area=transom_area,
            rho=rho,
            nu=nu,
            roughness=roughness,
        )

    def measure(self, *, only: Iterable[str] | None = None) -> Measures:
        """Give the present values of a hull's named parameters.

        Parameters
        ----------
        only : iterable of str or None
            Names of parameters; None: all of them.

        Returns
        -------
        mapping of str to float
            Values by name, in m, or in degrees where the name ends in ``_deg``; x from AP forward,
            z from the base line up. `absent` tells by name why the hull has no such parameter,
            `anchors` where and how each was measured; `spent` by how much variations of this hull
            have changed each parameter, shifts of sections among them, which no line shows.

        Raises
        ------
        UnknownNameError
            A name that is none of a parameter.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.series60(0.70).measure(only=["breadth", "depth", "bossing_radius"])
        >>> {name: round(value, 3) for name, value in found.items()}
        {'breadth': 17.417, 'depth': 10.45}
        >>> found.absent["bossing_radius"]
        'parent has no bossing circle'
        """
        from assoc_hull.variation.earlier_values import varied_values
        from assoc_hull.variation.parameters.measurement import Measures
        from assoc_hull.variation.parameters.parameter_measures import measure

        found = measure(self, only=only)
        return Measures(found.anchors.values(), varied_values(self.document).spent)

    def sensitivities(
        self,
        outputs: Iterable[str] | None = None,
        parameters: Iterable[object] | None = None,
        *,
        kg: float | None = None,
        layout: Mapping[str, Any] | Layout | None = None,
    ) -> Sensitivities:
        """Differentiate outputs of a hull by parameters of its shape and position.

        The hull floats upright at its design draught, the new one where a parameter changes that.

        Parameters
        ----------
        outputs : iterable of m str or None
            Fields of the record of hydrostatics ("volume", "lcb"), symbols of form parameters
            ("Cpa"), section areas ("A ST 5", "A x=42.5"), resistance at a speed ("R 14 kn"); None:
            `USUAL_OUTPUTS`.
        parameters : iterable of k or None
            Each the name of a parameter that `vary` knows ("breadth", m or degrees),
            "mean_draught" or "trim" (m), a raw layer (by its strength), or one of
            `assoc_hull.analysis.derivatives.parameters` such as a `PointMove`; None: all that
            `vary` knows and this hull has.
        kg : float or None, m
            Centre of gravity above the base line, for metacentric heights.
        layout : mapping or Layout or None
            How far the fields of named parameters reach, as for `vary`.

        Returns
        -------
        Sensitivities
            The table. A named parameter changes alone, as in `vary` with it alone: lines,
            dimensions and features go along, other parameters may change with it.

        Raises
        ------
        UnknownNameError
            No such output or parameter, with the nearest names.
        BadInputError
            The hull lacks one; a name that stands twice; a hull that is doubtful.
        WrongTypeError, OutOfRangeError
            What is no parameter; a hull that does not float at its design draught.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.wigley().sensitivities(
        ...     ["volume", "cb"], ["breadth", "mean_draught"]
        ... )
        >>> print(found)
                      per   volume           cb
                                m3            -
        now                2777.45     0.444392
        breadth         m  277.747  2.97793e-07
        mean_draught    m  666.625    0.0355574
        """
        from assoc_hull.variation.sensitivities import sensitivities

        return sensitivities(self, outputs, parameters, kg=kg, layout=layout)

    def fairness(
        self, *, lines: Iterable[str] | None = None, allowed: int | Mapping[str, int] = 0,
        noise: float | None = None,
    ) -> FairnessTable:  # fmt: skip
        """Take the five criteria of fairness as numbers, and say where lines are unfair.

        A line is unfair at a place where the loftsman's batten springs off it more than off the
        lines beside. The criteria are never put into one score.

        Parameters
        ----------
        lines : iterable of str, optional
            Names of lines of the hull; all of them by default.
        allowed : int or mapping of str to int
            Inflections that are wanted: of each curve, or by name of line (others: none).
        noise : float or None, m
            Of the source, as a standard deviation: battens that spring by so little are not
            judged. None: 2e-6 of Lpp.

        Returns
        -------
        FairnessTable
            A record for each curve, and the unfair places. `assoc_hull.form.fairness` takes single
            lines and plane curves.

        Raises
        ------
        GeometryError
            ``"fairness: curve has no length"``.
        UnknownNameError
            There is no such line.
        BadInputError
            A number of wanted inflections that is none.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.wigley().fairness()
        >>> found["WL 2.5"][0].failed
        ()
        """
        from assoc_hull.fairing.line_fairness import hull_fairness

        return hull_fairness(self, lines, allowed, noise)

    def fair(
        self,
        lines: Sequence[Group | Line | str] | None = None,
        *,
        noise: float | Literal["auto"] | None = None,
        tolerance: float | Mapping[Line | Point | str, float] | None = None,
        at: Point | str | ArrayLike | None = None,
        radius: tuple[float, float] | None = None,
        keep: Sequence[Line | Point | str] = (),
        hold: Sequence[Literal["volume", "lcb"]] = (),
        since: str | None = None,
        name: str = "fair",
        dry_run: bool = False,
    ) -> FairReport:
        """Take noise out of all lines together, while they stay crossing: one edit.

        Parameters
        ----------
        lines, noise, tolerance, at, radius, keep, hold, since
            As `assoc_hull.edit.session.Edit.fair` takes them: which lines, the standard deviation
            of their noise (m), how far points may move (m), a window, what stays, what is held,
            and since when points count as given.
        name : str
            Of the edit.
        dry_run : bool
            Whether the hull stays as it is, and only the report is made.

        Returns
        -------
        FairReport
            The noise, the lines before and after, what stayed and why; it prints as a page.

        Raises
        ------
        BadInputError
            Nothing can move; the noise is not known or cannot be told from the shape; a tolerance
            below half the noise; a number that is not above 0, a radius without a place; volume
            or centre that cannot be held; an edit is open.
        UnknownNameError
            No such line, point or checkpoint.
        RefusedEditError
            The hull would not be consistent; it is unchanged.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> report = hull.fair(noise=0.001)
        >>> report.found.unknowns, hull.history[-1].name
        (171, 'fair')
        """
        from assoc_hull.fairing.fair_window import fair_hull

        flag(dry_run, "dry_run", "in fair")
        return fair_hull(
            self.document,
            lambda edit: edit.fair(
                lines, noise=noise, tolerance=tolerance, at=at, radius=radius, keep=keep,
                hold=hold, since=since,
            ),
            text(name, "the name", "in fair"), dry_run=dry_run,
        )  # fmt: skip

    def fair_window(
        self, *, at: Point | str | ArrayLike, radius: tuple[float, float]
    ) -> FairWindow:
        """Begin to fair a window by hand: solved at each step, published by its `commit`.

        Parameters
        ----------
        at : Point, address or (x, y, z) in m
            The middle.
        radius : (float, float), m
            How far it reaches along the length and the girth.

        Returns
        -------
        FairWindow
            ``to(noise=..., radius=...)`` gives the window as it would be, ``commit()`` edits.

        Raises
        ------
        BadInputError, UnknownNameError
            A radius that is not above 0, no such point; nothing can move there.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> window = hull.fair_window(at="WL 3.75 x ST 8", radius=(20, 4))
        >>> len(window.to(noise=0.002).rows), len(hull.history)
        (55, 0)
        """
        from assoc_hull.edit.fair_arguments import window_of
        from assoc_hull.fairing.fair_window import FairWindow

        return FairWindow(self.document, *window_of(self.document.state, at, radius))

    def doctor(self, *, top: int = 10, noise: float | None = None) -> NetDoctorReport:
        """Look for points that the lines of the hull do not bear out; nothing is changed.

        Each point is judged by how far battens spring off the points of all lines that move with
        it, beside what they do on the lines of the family beside. Points that were placed, profile,
        flats and features are not judged. Of a table of offsets `assoc_hull.doctor` tells slips of
        the hand, before a hull is made of it.

        Parameters
        ----------
        top : int
            So many findings are listed at least, those that are called first.
        noise : float or None, m
            To what points are known: 1 mm of a hull of 100 m and more if None.

        Returns
        -------
        NetDoctorReport
            With ``findings`` and ``alarms``, those with a score above 15; as text, all of them.

        Raises
        ------
        BadInputError
            A number that cannot be used.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> print(ah.examples.wigley().doctor())
        Wigley: 0 points called (score above 15)
        judged: 171 points by 286 residuals, known to 1 mm; not placed points, profile, flats, \
features
        """
        from assoc_hull.fairing.net_doctor import examine_net

        where = "in doctor"
        most = integer(top, "top", where, least=0, most=1000)
        state = state_of(self, where)
        length = state.particulars.length
        known = None if noise is None else small_length(noise, "noise", where, length)
        return examine_net(state, most, known)

    def curve_transform(
        self,
        curve: Line | Curve | str,
        kind: Kind = "chebyshev",
        terms: int = 12,
        *,
        along: str | None = None,
        across: str | None = None,
        span: tuple[float, float] | Literal["perpendiculars"] | None = None,
        relative: bool | None = None,
        draught: float | None = None,
        draughts: tuple[float, float] | None = None,
        heel_deg: float = 0.0,
    ) -> CurveTransform:
        """Give the coefficients of a curve of a hull as a series.

        Parameters
        ----------
        curve : Line, Curve or str
            A line, one of its curves, the address of either, or ``"sectional areas"``.
        kind : "chebyshev", "sine" or "fourier"
            Chebyshev or half-range sine series of an ordinate over an abscissa; or Fourier
            descriptors of a section, or of a line seen from above, closed with its mirror image.
        terms : int
            Number of coefficients; of Fourier descriptors, harmonics to each side.
        along, across : "x", "y" or "z"
            Abscissa and ordinate. By default half breadth over x; of a section half breadth over z,
            of a buttock z over x. Fourier descriptors take y as one of the two.
        span : (float, float), "perpendiculars" or None, m
            Range of the abscissa: between two places, from AP to FP, or the whole curve (the wetted
            length, of sectional areas). Beyond the curve the ordinate is zero. Of Fourier
            descriptors, range of the coordinate that is not y.
        relative : bool or None
            Divide by the largest ordinate; None does so for sectional areas only.
        draught, draughts, heel_deg
            The floating position of sectional areas, as in `hydrostatics`.

        Returns
        -------
        CurveTransform
            The coefficients and what they leave out.

        Raises
        ------
        BadInputError
            A curve that is not single-valued in the abscissa or has gaps; a number that cannot be
            used.
        OutOfRangeError
            A position in which the hull does not float.
        UnknownNameError
            No line has this address.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> found = hull.curve_transform("sectional areas", terms=3)  # A / Amax = 1 - xi^2
        >>> (found.coefficients + 0.0).round(3).tolist()
        [0.5, 0.0, -0.5]
        """
        from assoc_hull.analysis.form.curve_transform import curve_transform

        return curve_transform(
            self,
            curve,
            kind,
            terms,
            along=along,
            across=across,
            span=span,
            relative=relative,
            draught=draught,
            draughts=draughts,
            heel_deg=heel_deg,
        )

    def compare(
        self, variant: HasState, *, draught: float | None = None, screw: Screw | None = None
    ) -> HullComparison:
        """Compare this hull, as the parent, with a variant or any other hull.

        Lines are paired by name, and by key where one was renamed. Of each pair the largest shift
        is reported, measured curve to curve in the plane of the line (see
        `assoc_hull.variation.comparing.line_comparison`), and how fair it is before and after. All
        differences are variant less parent: with both exchanged, they change their signs.

        Parameters
        ----------
        variant : Hull
            The other hull; neither is changed.
        draught : float or None, m
            Moulded, at even keel, for the numbers of both; each at its design draught if not given.
        screw : Screw or None
            For the form parameters that need it.

        Returns
        -------
        HullComparison
            Everything; what has no number has a reason.

        Raises
        ------
        OutOfRangeError
            One of both does not float at the draught that was asked.
        BadInputError
            No hull, or a number that cannot be used.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> parent = ah.examples.wigley()
        >>> found = parent.compare(parent.vary(set={"breadth": 11.0}).hull, draught=5.0)
        >>> print(f"{found.parameter('BMT').percent:.3f} %")
        21.000 %
        """
        from assoc_hull.variation.comparing.comparison import compare

        return compare(self, variant, draught=draught, screw=screw)

    def design(self) -> DesignReading:
        """Read form parameters off this hull: a design of which `create` makes it again.

        Contour, deck edge and flats become courses. The curve of areas becomes two halves with the
        volume and the centre of buoyancy of either half of the hull, up to the forward end of the
        waterline; so does the waterline at the draught, by least squares. Sections become
        form-parameter curves of seven vertices, with the area of the curve of areas; their angles,
        curvatures and tangents are nodes of courses at the stations. A bilge radius is read where
        the parallel body has flats and an arc, a bulb where sections close ahead of the stem.

        Returns
        -------
        DesignReading
            ``design``, the design, whose values can be changed; ``residuals``, how far each curve
            lies off (m, m2 for areas: root mean square, largest, and where); ``notes``, what was
            left out and why. Of a hull that was created its own design, without residuals; a note
            says so.

        Raises
        ------
        BadInputError
            No profile, no deck edge, or fewer than five sections; the hull is open ahead or abaft;
            the profile does not rise through the draught; a transom that cannot be made.

        References
        ----------
        S.Y. Kim, S.W. Kang, "Ship Lines Creation by B-Spline Form Parameter Method", Trans. SNAK
        29(2), 1992.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> parent = ah.examples.wigley()
        >>> found = parent.design()
        >>> again = ah.create(found.design)
        >>> round(again.hydrostatics().volume / parent.hydrostatics().volume, 4)
        1.0
        >>> found.residual("ST 5").largest < 0.01
        True
        """
        from assoc_hull.creation.design_reading import design_of_hull

        return design_of_hull(self.state)

    # ----------------------------------------------------------------------------------
    # Other hulls from this one.

    def vary(
        self,
        *,
        set: Mapping[str, float] | None = None,
        reach: Mapping[str, float] | None = None,
        free: Sequence[object] | str = (),
        bounds: Mapping[str, tuple[float | None, float | None]] | None = None,
        exact: bool = True,
        layers: Sequence[object] = (),
        layout: Mapping[str, Any] | Layout | None = None,
        drivers: Sequence[Group | Line | str] | None = None,
        stations: Stations = "number",
        planes: Planes = "follow",
        tolerance: float = 2e-3,
        fair: float | bool = False,
        accept: bool = False,
        name: str | None = None,
        ship: str | None = None,
        in_place: bool = False,
    ) -> Variation[Hull]:
        """Vary a hull so that named parameters, and outputs, have asked values; all lines follow.

        The map is certified not to fold, the lines that drive are carried exactly, all others are
        cut again from them, and the asked values are measured on the lines of the result to 1e-6.
        Values that the hull has already change nothing, and make no step in the history; beside
        others they say that these values are to stay. Outputs are reached by what is free for it,
        on the hydrostatics of the result, to 1e-10 of their size.

        Parameters
        ----------
        set : mapping of str to float
            Values by name, m, or degrees where the name ends in ``_deg``; x from AP forward, z from
            the base line up. `measure` gives the names and the present values.
        reach : mapping of str to float
            Values of outputs by name, in their units, at the design draught: fields of
            `hydrostatics`, form parameters, sectional areas; see
            `assoc_hull.variation.aiming.outputs.Outputs`.
        free : sequence of str, layer or mapping
            What may change so that they are reached: named parameters that are not `set`, and
            layers, of which the strength is found: 1 is the layer as given, 0 none of it. Layers as
            for `layers`, or as data ``{"name": ..., "fields": [...]}``. Where there is more
            freedom than targets the change is the least.
        bounds : mapping of str to (float or None, float or None)
            Least and greatest values by the names of what is free, m, degrees, or strengths of
            layers; None leaves an end open.
        exact : bool
            Whether targets must all be met; otherwise the best compromise is taken where they
            cannot be.
        layers : sequence
            Raw layers that act after those of the named parameters: a `FieldLayer`,
            `AdditiveLayer`, `CornerLayer` or `DeadriseLayer`, or a list of fields as data (see
            `assoc_hull.variation.fields.field_data`).
        layout : mapping or Layout
            How far the fields reach; see `assoc_hull.variation.parameters.field_layout.Layout`.
        drivers : sequence of Group, Line or str
            Lines whose images are taken exactly; boundary curves always are. By default all lines
            whose planes the map keeps.
        stations : {"number", "x"}
            Sections go with the map and keep their numbers, or stay where they are.
        planes : {"follow", "stay"}
            Waterlines and buttocks go with a map that sends their planes to parallel ones, as a
            change of breadth, draught or depth does, and keep their names; or they stay at their
            heights and half-breadths and are cut again. If a map bends the planes of some over more
            than half of their length, all stay.
        tolerance : float, m
            How far a driver may leave its exact image.
        fair : float or bool, m
            How far points that the map has moved may move once more, so that lines get no new
            changes of the sign of curvature; True: 20 mm, of a hull under 100 m less in proportion.
            The profile and other boundary curves, flats, features and placed points stay where the
            map takes them; values and targets are met as without. `VariationReport.faired` tells
            what was done, and which lines have more changes still.
        accept : bool
            Take a hull as well whose lines have come to bend a hundred times as sharply, as no
            designer would; it is refused otherwise.
        name : str
            Of the step in the history; by default it tells the values.
        ship : str
            What the variant is called. By default her parent's name with what was asked for, as
            "Wigley, breadth=11"; in place the name stays.
        in_place : bool
            Vary this hull, as a step that can be undone; else a copy of it.

        Returns
        -------
        Variation
            The hull, what was reached, and the map.

        See Also
        --------
        vary_by : the same from data or a file.
        measure : present values.

        Raises
        ------
        UnknownNameError
            No such parameter or output.
        UnreachableError, DependentTargetsError, TooFewFreeError
            Targets that cannot be reached by what is free: how near one comes, and what is in the
            way.
        FoldError
            The map folds, or nearly; where, and between which values one may ask.
        OutOfRangeError
            What comes out is no ship; with the interval.
        RefusedSetError
            Values that cannot be had together: which one to leave out, and how much of all changes
            can be had.
        BadInputError
            The parent has not what is asked for; two parameters contradict each other. The hull is
            unchanged, whatever the error.
        RefusedEditError
            A line would fold or lose its order, or bend as no one would have it (`accept`). The
            hull is unchanged.

        Notes
        -----
        Several values are taken class by class, each class by a map that is laid out on the hull
        that the one before has made, and corrected until all are met on the final hull; a class
        that is refused is taken more finely. All of it is one step. `VariationReport.stages` tells
        what was done.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> variant = ah.examples.wigley().vary(set={"breadth": 11.0, "draught": 7.0})
        >>> [target.reached for target in variant.report.targets]
        [11.0, 7.0]
        >>> variant = ah.examples.wigley().vary(reach={"volume": 2800.0}, free=["breadth"])
        >>> round(variant.hull.hydrostatics().volume, 7), round(variant.hull.particulars.breadth, 4)
        (2800.0, 10.0812)
        """
        from assoc_hull.hull.variants import Variation
        from assoc_hull.variation.request import VariationRequest
        from assoc_hull.variation.vary import measure_parent, vary_document

        ask = VariationRequest.of(
            set, reach=reach, free=free, bounds=bounds, exact=exact, layers=layers, layout=layout,
            drivers=drivers, stations=stations, planes=planes, tolerance=tolerance, fair=fair,
            accept=accept, name=name,
        )  # fmt: skip
        measure_parent(state_of(self, "in vary"))
        varied = _to_change(self, "vary", in_place=in_place)
        called = _variant_name(self, ask, ship, in_place=in_place)
        space_map, report = vary_document(varied.document, ask, called)
        return Variation(varied, report, space_map)

    def vary_by(
        self,
        script: Mapping[str, Any] | str | PathLike[str],
        *,
        ship: str | None = None,
        in_place: bool = False,
    ) -> Variation[Hull]:
        """Vary a hull by a script: the arguments of `vary` as data, or a JSON file of them.

        The same parent and the same script give the same hull, to the last bit.

        Parameters
        ----------
        script : mapping or path
            See `assoc_hull.variation.request`. `VariationReport.script` is such a one.
        ship, in_place : str, bool
            As in `vary`.

        Raises
        ------
        AssocHullError
            As `vary`; a file that cannot be read.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> str(ah.examples.wigley().vary_by({"set": {"breadth": 11.0}}).report.targets[0])
        'breadth 10 -> 11 m'
        """
        from assoc_hull.hull.variants import Variation
        from assoc_hull.variation.request import read_script, request_from_data
        from assoc_hull.variation.vary import vary_document

        ask = request_from_data(script if isinstance(script, Mapping) else read_script(script))
        varied = _to_change(self, "vary", in_place=in_place)
        called = _variant_name(self, ask, ship, in_place=in_place)
        space_map, report = vary_document(varied.document, ask, called)
        return Variation(varied, report, space_map)

    def shift_sections(
        self,
        *,
        to: Mapping[str, float] | None = None,
        by: Mapping[str, float] | None = None,
        shape: ShiftShape = "c2",
        terminals: ArrayLike | Terminals | None = None,
        fade: Fade = "b5",
        tolerance: float = 2e-3,
        name: str | None = None,
        in_place: bool = False,
    ) -> Shifted[Hull]:
        """Shift the sections of a hull along the ship so that its volume and centre are as asked.

        Every section keeps its shape; the ends of the hull stay where they are. After Lackenby
        (1950), by a closed form that is exact for the curve of areas, then by Newton's rule on the
        hydrostatics of the varied hull, to 1e-10. What is not asked for is held: the block
        coefficient, the centre of buoyancy, the other body, the ends of the parallel body.

        Parameters
        ----------
        to : mapping of str to float
            Values that are to be had at the design draught: one of ``cb``, ``cp``, ``volume`` (m3),
            and one of ``lcb`` (m from AP) and ``lcb_percent`` (% Lpp from midship, + forward); or
            ``Cpf`` and ``Cpa``, the prismatic coefficients of fore and after body, each on its own.
            With either, ``parallel_body_start`` and ``parallel_body_end`` (m from AP): where the
            inner two terminals are to be.
        by : mapping of str to float
            Changes of present values, by the same names; what is in `to` cannot be here.
        shape : str
            Of the movement between parallel body and end: ``"c2"`` leaves with slope and curvature
            zero at both; ``"c1"``, ``"end"``, ``"half"``, ``"lackenby"`` are those of
            `assoc_hull.variation.fields.shift_shapes.BUMP_SHAPES`; ``"1-cp"`` is a straight line,
            which lengthens the parallel body.
        terminals : (4,), m from AP, or Terminals
            After terminal, start and end of the parallel body, fore terminal. Nothing moves abaft
            the first and forward of the last. By default where the profile begins to rise, and the
            measured ends of the parallel body; on a hull without one, the two stations with the
            largest areas.
        fade : {"b5", "linear"}
            How the movement of an end of the parallel body fades out to the terminal.
        tolerance : float, m
            How far a line may leave its exact image.
        name : str
            Of the step in the history; by default it tells the values.
        in_place : bool
            Shift this hull, as a step that can be undone; else a copy of it.

        Returns
        -------
        Shifted
            The hull, what was reached, and the map.

        Raises
        ------
        OutOfRangeError
            Sections would cross, or no shift gives what is asked for; with the largest change that
            can be had.
        UnknownNameError, BadInputError, WrongTypeError
            What is asked for is not clear, or the hull has not what it takes.
        RefusedEditError
            A line would fold or lose its order. The hull is unchanged, whatever the error.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.wigley().shift_sections(by={"lcb_percent": 0.5}, to={"cb": 0.45})
        >>> [f"{target.reached:.6f}" for target in found.report.targets]
        ['0.450000', '0.500000']
        """
        from assoc_hull.hull.variants import Shifted
        from assoc_hull.variation.shifts.shift_hull import shift_document
        from assoc_hull.variation.shifts.shift_terms import ShiftRequest

        ask = ShiftRequest.of(
            to, by, shape=shape, terminals=terminals, fade=fade, tolerance=tolerance, name=name
        )
        varied = _to_change(self, "shift_sections", in_place=in_place)
        space_map, report = shift_document(varied.document, ask)
        return Shifted(varied, report, space_map)

    def swing(
        self,
        *,
        length: float | None = None,
        breadth: float | None = None,
        draught: float | None = None,
        name: str | None = None,
        in_place: bool = False,
    ) -> Shifted[Hull]:
        """Change breadth against draught, or length against both; volume and coefficients stay.

        The map is affine, heights above the draught included. What lofting again leaves over of
        volume and centre (1e-6) is taken away by a shift of sections of less than a millimetre or
        so, so that volume, CB, and LCB in parts of Lpp are held to 1e-10.

        Parameters
        ----------
        length, breadth, draught : float, m
            One or two of them. The rest gives way: breadth to draught and draught to breadth; with
            a length alone, both in one ratio.
        name : str
            Of the step in the history.
        in_place : bool
            Vary this hull, as a step that can be undone; else a copy of it.

        Returns
        -------
        Shifted
            The hull, what was reached, and the map.

        Raises
        ------
        BadInputError
            None of the three is given, or all; one is no positive number. The hull is unchanged.

        See Also
        --------
        vary : dimensions one by one; CB is held by each of them, the volume is not.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> variant = ah.examples.wigley().swing(breadth=12.5).hull
        >>> variant.state.particulars.draught, round(variant.hydrostatics().cb, 3)
        (5.0, 0.444)
        """
        from assoc_hull.hull.variants import Shifted
        from assoc_hull.variation.shifts.shift_hull import swing_document

        asked = {"length": length, "breadth": breadth, "draught": draught}
        varied = _to_change(self, "swing", in_place=in_place)
        space_map, report = swing_document(varied.document, asked, name)
        return Shifted(varied, report, space_map)

    def jumboise(
        self,
        length: float,
        at: float | None = None,
        *,
        names: Names = "keep",
        name: str | None = None,
        in_place: bool = False,
    ) -> Jumboised[Hull]:
        """Insert a length of parallel body, or take one out; both ends of the ship stay.

        What lies forward of the cut moves as a whole, the fore perpendicular with it; Lpp changes
        by the length, the volume by length times midship area. The section at the cut is copied
        to where the fore part begins now, and between at the spacing there was. Lines that are
        drawn along the ship keep their tangents at the cut, so that fore and after body keep their
        shape between the sections too.

        Parameters
        ----------
        length : float, m
            To insert; below 0 to take out, at most the length of the parallel body.
        at : float, m from AP
            Where to cut: the nearest section of the parallel body is taken, by default that nearest
            to its middle. What is taken out begins there, or as far aft as it must. A hull without
            a parallel body can be cut only at its largest section, and only if waterlines are
            parallel there to 0.2 degrees.
        names : {"keep", "number"}
            Sections keep their names, and copies are called ``ST 10+30``, by the metres from their
            model; or all that go by a number are numbered anew by the new Lpp (by their places, if
            they were named by these).
        name : str
            Of the step in the history.
        in_place : bool
            Change this hull, as a step that can be undone; else a copy of it.

        Returns
        -------
        Jumboised
            The hull, and the report: volume and its centre before and after, the area at the cut,
            sections that came and went, and how far any point of either part lies off its place.

        Raises
        ------
        OutOfRangeError
            More is to be taken out than there is, or `at` lies outside the parallel body.
        BadInputError
            No length; a hull without a parallel body, with what could be cut instead. The hull is
            unchanged, whatever the error.

        See Also
        --------
        vary : ``parallel_body_length`` lengthens the parallel body within the same Lpp.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> longer = ah.examples.bulk_carrier_207k().jumboise(30.0, at=150.0)
        >>> print(longer.report.told[0], longer.report.added)
        30 m of parallel body inserted at ST 10 (150 m) ('ST 10+30',)
        >>> before, after = longer.report.volume
        >>> round(after - before - 30.0 * longer.report.area, 6) + 0.0
        0.0
        """
        from assoc_hull.hull.variants import Jumboised
        from assoc_hull.variation.jumboise_hull import jumboise_document

        changed = _to_change(self, "jumboise", in_place=in_place)
        report = jumboise_document(changed.document, length, at, names=names, name=name)
        return Jumboised(changed, report)

    def study(
        self,
        *,
        set: object = None,
        reach: object = None,
        free: object = (),
        bounds: Mapping[str, object] | None = None,
        layers: Sequence[object] = (),
        outputs: Sequence[str] | None = None,
        layout: Mapping[str, Any] | Layout | None = None,
        file: str | PathLike[str] | None = None,
        workers: int | None = None,
        cluster: object = None,
        progress: Callable[[str, int, int], None] | None = None,
        fair: float | bool = False,
    ) -> Study[Hull]:
        """Make many variants of a hull: certified, lofted again, checked, measured.

        Variants have the structure of the parent: its points go where the map of the variant
        sends them, none comes or goes. Where a variant needs other points it is carried as `vary`
        does, and the column ``anew`` of its table says so. The hull itself is not changed.

        Parameters
        ----------
        set : mapping of str to float or (n,), sequence of mappings, structured array, or frame
            Values of named parameters (m, degrees), or factors on layers: one, or one per variant;
            or a row per variant: a mapping each, a structured array, a frame of pandas.
        reach : as `set`
            Targets by the names of outputs, see `assoc_hull.variation.aiming.outputs.Outputs`:
            fields of hydrostatics, symbols of form parameters, areas of sections,
            resistance at a speed ("R 14 kn").
        free : sequence of str or layer
            Parameters whose values are sought, as in `vary`; as many as there are targets, or more:
            then the variant is one of nearly the least change.
        bounds : mapping of str to (float, float)
            Least and greatest values of free parameters.
        layers : sequence
            Raw layers, as in `vary`, which `set` and `free` may name; one that they do not name
            acts as it is.
        outputs : sequence of str
            What is told of each variant, by the same names.
        layout : mapping or Layout
            How far the fields of named parameters reach.
        file : path
            A SQLite file that rows are added to as they are made. What has landed survives Ctrl-C,
            a kill and a loss of power, and the same call goes on where it stopped; more rows
            behind the same ones are added. Without it rows are held in memory.
        workers : int
            Processes of this machine; one, this one, unless it is said. The rows are the same to
            the last bit, whatever their number. A program that asks for more than one begins under
            ``if __name__ == "__main__":``, as new processes import it.
        cluster : str or distributed.Client
            Makes rows by Dask: "local" begins as many processes as `workers`, or as there are
            cores; the address of a scheduler, or a client, uses the workers that it has.
        progress : callable
            Is called with what is done and how fast, how many variants are, and of how many.
        fair : False
            A study fairs no followers: vary the rows that matter with ``fair=True``.

        Returns
        -------
        Study
            A row per variant. After an interrupt (Ctrl-C) those that were finished.

        Raises
        ------
        UnknownNameError, WrongTypeError, BadInputError
            What is asked for cannot be understood, or does not fit the hull; the file is of
            another study; a process came to an end.
        StudyBusyError, DamagedFileError, HullFileError
            Another study is writing to the file; it is damaged; it cannot be read or written.
        ClusterError, MissingExtraError
            The cluster cannot be reached, or has failed; Dask is not installed.

        See Also
        --------
        sample : values drawn within intervals.
        grid : every combination of values.
        vary : one variant, with the structure that it needs.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> parent = ah.examples.wigley()
        >>> asked = ah.study.sample({"volume": (2760.0, 2800.0)}, 2, seed=1)
        >>> found = parent.study(reach=asked, free=["breadth"])
        >>> print(found)
        2 of 2 variants
        >>> bool((abs(found.table()["volume"] - asked["volume"]) < 1e-6).all())
        True
        """
        from assoc_hull.hull.studies import make_study
        from assoc_hull.study.design import OUTPUTS, StudyDesign

        if fair is not False:
            raise BadInputError(
                "a study fairs no followers", "in study",
                "leave fair out, and make what matters by hull.vary(set=..., fair=True)",
            )  # fmt: skip
        design = StudyDesign.of(
            set=set, reach=reach, free=free, bounds=bounds, layers=layers,
            outputs=OUTPUTS if outputs is None else outputs, layout=layout,
        )  # fmt: skip
        return make_study(
            self, design, Hull, file=file, workers=workers, cluster=cluster, progress=progress
        )

    # ----------------------------------------------------------------------------------
    # Surfaces, plates, arcs.

    def surface(
        self,
        *,
        leave_out: Sequence[str] = (),
        previous: FittedSurface | None = None,
        smoothing: float | None = None,
        tolerance: float | None = None,
        cutoff: float = 1e-7,
    ) -> HullSurface:
        """Fit a surface to the lines of a hull.

        Parameters
        ----------
        leave_out : sequence of str
            Names of lines that nothing is fitted to, but from which the surface is measured.
        previous : HullSurface, optional
            An earlier surface of the hull: blocks whose lines have not moved are taken from it. One
            that was made with other options, or other lines left out, is of no use, and no error.
        smoothing : float, m3, optional
            The factor of the penalty on second derivatives; ``9.6e-10 length**3`` without it.
        tolerance : float, m, optional
            What 95 % of the distances of the body should keep; 8 mm at a length of 300 m without
            it.
        cutoff : float, m
            With `previous`, points of lines that have moved by less since the fit of their block
            was made count as unmoved, and so do control points. With 0 only what is the same in
            every bit is taken over: the surface then is, in every bit, the one that comes without
            `previous`.

        Returns
        -------
        HullSurface
            One spline surface a block, for the half y >= 0; `refitted` names the blocks fitted.

        Raises
        ------
        BadInputError, UnknownNameError
            A curve of the hull has failed; there is no such line; lines that no blocks were found
            between; numbers that are none, or below 0.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> found = hull.surface()
        >>> found.refitted, hull.surface(previous=found).refitted
        (('body',), ())
        """
        from assoc_hull.hull.results import surface_of_hull

        return surface_of_hull(
            self, leave_out=leave_out, previous=previous, smoothing=smoothing,
            tolerance=tolerance, cutoff=cutoff,
        )  # fmt: skip

    def mesh(
        self, *, half: bool = False, points: int = 4, leave_out: Collection[str] = ()
    ) -> ClosedMesh:
        """Make a closed mesh on the lines of a hull: for panels, printing, a check of volumes.

        The lines part the hull into cells; these are filled with elements that fit together along
        every edge. Deck and transom are covered, whatever the particulars say of the deck, and the
        half is mirrored. The mesh comes from the lines alone: it shares nothing with
        `Hull.hydrostatics` but these. Tunnels that the hull holds go through it, each a group;
        bodies beside the net stand beside it, each a group that is closed by itself.

        Parameters
        ----------
        half : bool
            The port half only, open in the centre plane.
        points : int
            Into how many parts each piece of a line between two crossings is cut: even, 2 to 64.
        leave_out : collection of str
            Names of lines, tunnels and bodies to do without; `bodies` itself for all of these.

        Returns
        -------
        ClosedMesh
            Checked: every edge is that of two triangles, once in each sense.

        Raises
        ------
        BadInputError
            A curve of the hull has failed, or an option is out of its range.
        UnknownNameError
            What is to be left out does not exist.
        OpenNetError
            The lines do not part the hull into cells; those at fault are named.
        OpenMeshError
            The mesh does not close all the same.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> mesh = hull.mesh()
        >>> mesh.names, mesh.report.euler, mesh.report.open_edges
        (('shell', 'deck'), 2, 0)
        >>> round(mesh.below(6.25).volume, 1), round(hull.hydrostatics(draught=6.25).volume, 1)
        (2776.3, 2777.4)
        """
        from assoc_hull.surface.cells.closed_mesh import closed_mesh

        return closed_mesh(self, half=half, points=points, leave_out=leave_out)

    def plates(
        self,
        seams: HullSeams,
        *,
        zero: str = "strain",
        strain_tol: float = 1e-3,
        breadth: float = 2.5,
        k0: float | None = None,
        sagitta_tol: float = 3e-3,
        sagitta_length: float | None = None,
        share: float = 0.95,
        suggestions: Mapping[str, str] | None = None,
        others: Sequence[FittedSurface] | None = None,
        previous: HullPlates | None = None,
    ) -> HullPlates:
        """Tell of each plate of the hull how it is curved, and how sure that is.

        A surface is fitted to the lines, and two more to compare with. A butt x = constant, a seam
        z = constant is a plane; plates and the regions in them have the areas of the surface
        itself, to the tolerance of `assoc_hull.surface.curvature_regions`. Roll axes, radii and
        strains are found at 7 by 7 nodes on each patch.

        Parameters
        ----------
        seams : HullSeams
            Butts and seams.
        zero : {"strain", "absolute"}
            What counts as no Gaussian curvature; see `assoc_hull.surface.curvature_regions`.
        strain_tol : float
            The strain of the mode "strain", K0 = 8 strain_tol / breadth**2.
        breadth : float, m
            The breadth that K0, and the sagitta of what is flat, are meant for.
        k0 : float, 1/m2
            Half the width of the band of the mode "absolute".
        sagitta_tol, sagitta_length, share, suggestions
            See `assoc_hull.surface.plates`.
        others : sequence of HullSurface, optional
            Other fits of the same hull: by what they change, a plate's dK is found. By default a
            stiffer one, and one without every second waterline.
        previous : HullPlates, optional
            Earlier plates; Bezier patches with the same nets under the same options are taken from
            them.

        Returns
        -------
        HullPlates
            A row for each plate, from aft forward and from below upward; its `save` writes a table.

        Raises
        ------
        BadInputError, WrongTypeError
            No seams, numbers that are none or that the mode does not use; seams that leave no
            plate.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> found = ah.examples.wigley().plates(ah.surface.HullSeams(x=(30.0, 70.0)))
        >>> [str(each.range) for each in found.rows]
        ['x below 30 m', 'x 30 to 70 m', 'x above 70 m']
        """
        from assoc_hull.hull.results import plates_of_hull

        given = {} if others is None else {"others": others}
        return plates_of_hull(
            self,
            seams,
            zero=zero,
            strain_tol=strain_tol,
            breadth=breadth,
            k0=k0,
            sagitta_tol=sagitta_tol,
            sagitta_length=sagitta_length,
            share=share,
            suggestions=suggestions,
            previous=previous,
            **given,
        )

    def production_arcs(
        self,
        lines: Sequence[Group | Line | Curve | str] | Group | Line | Curve | str | None = None,
        within: float = 0.0005,
        least_radius: float = 0.0,
    ) -> ProductionArcs:
        """Make chains of circular arcs and straight lines of the lines of a hull.

        Neighbouring arcs have one tangent where they meet, and meet on the line; at knuckles both
        tangents are kept; straight runs are straight lines. Every line lies within the tolerance of
        its arcs, and every arc of its line, measured on ten times as many places as the search
        used.

        Parameters
        ----------
        lines : names, or handles of groups, lines or curves
            Which lines; all by default. Of a line that lies in no plane its plan and profile are
            given (of one athwart ships plan and body plan).
        within : float, m
            The tolerance, 0.001 mm to 1 m.
        least_radius : float, m
            Of all arcs; 0 leaves them free.

        Returns
        -------
        ProductionArcs
            A chain for each curve, number of arcs and deviations, what was left out and why; its
            `save` writes DXF or a table.

        Raises
        ------
        GeometryError
            A line that was named is bent more than the least radius and the tolerance allow; if all
            are asked for, it is left out, and the result says so.
        UnknownNameError, WrongTypeError, BadInputError
            Lines that are not there; a tolerance or radius that is no length.

        Notes
        -----
        Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for
        Design and Production", J. SNAK.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> arcs = ah.examples.wigley().production_arcs(lines=["WL 5"], within=0.001)
        >>> line = arcs.lines[0]
        >>> len(line.arcs) == arcs.count, bool(line.deviation.max() <= 0.001)
        (True, True)
        """
        from assoc_hull.hull.results import arcs_of_hull

        return arcs_of_hull(self, lines, within, least_radius)

    # ----------------------------------------------------------------------------------
    # Files.

    @property
    def plot(self) -> HullPictures:
        """Pictures of the hull, one method each; they need the extra `plot`."""
        from assoc_hull.hull.pictures import HullPictures

        return HullPictures(self)

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
        self,
        path: str | os.PathLike[str],
        form: str | None = None,
        unit: str | None = None,
        *,
        scale: float | None = None,
        half: bool = False,
        points: int | None = None,
        accept: bool = False,
        leave_out: Collection[str] = (),
    ) -> Any:
        """Write offsets, lines, the surface or the closed mesh for other programs.

        Parameters
        ----------
        path : path
            The file; what was there is replaced by the whole of it, or stays.
        form : str or None
            Where the ending of the name does not tell it; `docs/exchange.md` lists them.
        unit : {"m", "mm"} or None
            Of drawings, Rhino files and meshes, m if None, and of surfaces, mm if None.
        scale : float or None
            Of a lines plan: denominator of the scale at which it is to be printed.
        half : bool
            Of surfaces and meshes: the port half only.
        points : int or None
            Of a mesh: into how many parts each piece of a line between two crossings is cut; None:
            4, or as many more as round lines with few crossings take.
        accept : bool
            Of surfaces and meshes: also one of another volume than hydrostatics find, or a surface
            that crosses the centre plane or leaves its residual limits.
        leave_out : collection of str
            Of a mesh: names of lines, tunnels and bodies to do without.

        Returns
        -------
        ExportReport, CadReport or MeshFile
            What was written; of lines also what the form cannot hold.

        Raises
        ------
        BadInputError, MissingExtraError, OpenNetError, OpenMeshError
            A form, unit or option that is not known or does not go with it, a file that cannot be
            written, an extra that is not installed, a mesh that does not close.
        NotSoundError
            A surface or mesh of another volume than hydrostatics find, or a surface whose halves
            cross or that leaves a limit, which was not accepted.
        """
        from assoc_hull.hull.exports import export_file

        self.document.require_ended("export")
        return export_file(
            self, path, form, unit, scale=scale, half=half, points=points, accept=accept,
            leave_out=leave_out,
        )  # fmt: skip

    def report(
        self,
        path: str | os.PathLike[str],
        parts: Iterable[PartName] | PartName | None = None,
        *,
        draught: float | None = None,
        draughts: Sequence[float] | None = None,
        kg: float | None = None,
        flooding: Iterable[FloodingPoint] = (),
        rho: float = 1.025,
        shell_factor: float = 1.0,
        appendages: Iterable[Appendage] = (),
        on_error: OnError = "refuse",
        surface: FittedSurface | None = None,
        plates: HullPlates | None = None,
        title: str = "Hull report",
        date: str | None = None,
    ) -> tuple[str, ...]:
        """Write one document with all that is known of the hull, numbered, with its contents.

        Parameters
        ----------
        path : path
            ``.pdf``: title page, contents, then the parts, tables on upright A4 and pictures on A3.
            ``.xlsx``: the same tables. What was there is replaced by the whole of it, or stays.
        parts : names, or None
            Of "lines", "hydrostatics", "bonjean", "areas", "form", "stability", "surface",
            "plates", "accuracy" (error bars and findings); all that can be made if None.
        draught : float, m
            At even keel: of the title page, sectional areas, form parameters and stability; the
            design draught if None.
        draughts : (n,), m
            Of hydrostatics and cross curves, rising; round ones around `draught` if None.
        kg : float or None, m
            Centre of gravity above the base line. Without it no criterion of stability is
            evaluated, and each says so.
        flooding, rho, shell_factor, appendages, on_error
            As for `stability`.
        surface : HullSurface or None
            What `Hull.surface` gave; without it there is no such part.
        plates : HullPlates or None
            What `Hull.plates` gave; without it there is no such part.
        title : str
            Of the document.
        date : str or None
            In words. The same hull gives the same bytes at any time: none stands in it unless it
            is given here.

        Returns
        -------
        tuple of str
            The parts that were written.

        Raises
        ------
        BadInputError, OutOfRangeError
            Another ending, a part that is none, a surface or plates asked for and not given, a file
            that cannot be written, draughts at which she does not float, a doubtful hull.
        MissingExtraError
            No matplotlib for a PDF, no openpyxl for a workbook.

        Examples
        --------
        >>> import tempfile
        >>> from pathlib import Path
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley(stations=9, waterlines=6)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     hull.report(Path(folder) / "ship.pdf", parts=["lines", "areas"])
        ('lines', 'areas')
        """
        from assoc_hull.plot.booklet.write import write_booklet

        return write_booklet(
            self, path, parts, draught=draught, draughts=draughts, kg=kg, flooding=flooding,
            rho=rho, shell_factor=shell_factor, appendages=appendages, on_error=on_error,
            surface=surface, plates=plates, adoption=self.adoption, title=title, date=date,
        )  # fmt: skip

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


def _variant_name(hull: Hull, ask: VariationRequest, ship: object, *, in_place: bool) -> str | None:
    """Give what a varied hull is called; None: as before."""
    from assoc_hull.variation.vary import variant_name

    if ship is not None:
        return word(ship, "ship", "in vary")
    return None if in_place else variant_name(hull.particulars.name, ask)


def _to_change(hull: Hull, act: str, *, in_place: object) -> Hull:
    """Give the hull that an act changes: this one, or a copy of it in memory."""
    state = state_of(hull, f"in {act}")
    hull.document.require_ended(act)
    if flag(in_place, "in_place", f"in {act}"):
        return hull
    from assoc_hull.variation.earlier_values import varied_values

    found = Hull(copy_state(state))
    found.document.varied_before = varied_values(hull.document)
    return found

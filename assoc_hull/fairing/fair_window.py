"""Fairing as one act, and a window that is faired while a hand draws at it.

A step solves for the points of the window by dense factors, in a fraction of the time of an edit,
and shows the lines as they would be. Only `commit` edits the hull, and takes the full way. Fairing
as one act is one edit of its own, tried or carried out, and the report of it.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.analysis.fairness.fair_solution import linear_algebra, solve_battens, solve_few
from assoc_hull.arguments import pair, small_length
from assoc_hull.edit.document import Document
from assoc_hull.edit.modifications.fair import (
    Faired,
    FairRequest,
    GivenBattens,
    given_values,
    tolerances_of,
)
from assoc_hull.edit.session import Edit
from assoc_hull.edit.shapes import Shapes
from assoc_hull.edit.step import Step
from assoc_hull.errors import BadInputError, RefusedEditError
from assoc_hull.fairing.fair_report import FairReport
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState

__all__ = ["FairFrame", "FairWindow", "fair_hull"]

_REMEDY = "fair with half the noise, or in a window (at=, radius=) that leaves these places alone"


def fair_hull(
    document: Document, ask: Callable[[Edit], Faired], name: str, *, dry_run: bool
) -> FairReport:
    """Fair a hull in one edit, or try it.

    Raises
    ------
    BadInputError
        An edit is open; and as `Edit.fair` does.
    RefusedEditError
        The hull would not be consistent; it is unchanged.
    """
    document.require_ended("fair")
    begin, before, seen = time.thread_time(), document.state.published(), list[HullState]()

    def look(step: Step | None) -> None:
        seen.append(document.state.as_written())

    trial = Edit(document, name, look=look if dry_run else None)
    try:
        with trial:
            found = ask(trial)
    except RefusedEditError as error:
        raise RefusedEditError(error.edit, (*error.findings, _REMEDY)) from error
    after = seen[0] if seen else document.state.published()
    report = trial.report
    changed = report is not None and report.changed
    return FairReport(
        found, report if changed else None, not dry_run, time.thread_time() - begin, before, after
    )


_WHERE = "in a fair window"

_FEW = 200
"""Up to so many points dense factors are faster."""


@attrs.frozen(eq=False)
class FairFrame:
    """A window as it would be.

    Attributes
    ----------
    noise : float, m
        The noise that is taken out.
    radius : (float, float), m
        How far the window reaches along the length and the girth.
    rows : (k,) int
        The points that move.
    displacement : (k,), m
        How far, along the normal of the hull, from where they are.
    state : HullState
        The hull that it was found for.
    """

    noise: float
    radius: tuple[float, float]
    rows: IntArray
    displacement: FloatArray
    state: HullState = attrs.field(repr=False)
    _given: GivenBattens = attrs.field(repr=False)

    @property
    def shapes(self) -> Shapes:
        """The curves through points that move, as they would be, to first order."""
        problem, state = self._given.problem, self.state
        place = problem.places(state.rows.xyz.data, self.displacement)
        moved = np.flatnonzero(np.diff(problem.rates.indptr))
        reader = state.rows.reader.data[moved]
        curves = np.unique(reader[reader >= 0])
        row = np.concatenate([state.curves.rows.data[each] for each in curves.tolist()])
        return Shapes(curves, loft(attrs.evolve(curve_data(state, curves), xyz=place[row])))


class FairWindow:
    """A window of a hull that is faired step by step; nothing changes before `commit`.

    Parameters
    ----------
    document : Document
        The hull.
    at : (3,), m
        The middle.
    radius : (float, float), m
        How far it reaches along the length and the girth.
    """

    def __init__(self, document: Document, at: FloatArray, radius: tuple[float, float]) -> None:
        self.document = document
        self.at = at
        self.radius = radius
        self._given: GivenBattens | None = None
        self._of: HullState | None = None
        self._frame: FairFrame | None = None
        self._prepared(radius)

    def to(
        self, *, noise: float | None = None, radius: tuple[float, float] | None = None
    ) -> FairFrame:
        """Fair it with another noise (m), or another radius (m), or both.

        Raises
        ------
        BadInputError
            A length that is not above 0; no noise in the first step; nothing can move.
        """
        if noise is not None:
            length = self.document.state.particulars.length
            noise = small_length(noise, "noise", _WHERE, length)
        elif self._frame is not None:
            noise = self._frame.noise
        else:
            raise BadInputError("the noise is not stated", _WHERE, "give noise=, in m")
        reach = self.radius if radius is None else pair(radius, "radius", _WHERE, positive=True)
        given, state = self._prepared(reach)
        problem = given.problem
        limit = tolerances_of(state, problem, FairRequest(), noise) * problem.freedom
        with linear_algebra().limit(limits=1):
            few = len(problem.rows) <= _FEW
            found = (
                solve_few(problem, noise, given.share, limit)
                if few
                else solve_battens(problem, noise, given.share, limit).displacement
            )
        self._frame = FairFrame(
            noise, self.radius, problem.rows, found - given.present, state, given
        )
        return self._frame

    def _prepared(self, radius: tuple[float, float]) -> tuple[GivenBattens, HullState]:
        """Give the problem of a window of the published hull, and keep it.

        A window that is refused leaves the one before.
        """
        state = self.document.state.published()
        if self._given is None or self._of is not state or radius != self.radius:
            given = given_values(self.document, FairRequest(at=self.at, radius=radius))
            self._given, self._of, self.radius = given, state, radius
        return self._given, state

    def commit(self, name: str = "fair") -> FairReport:
        """Fair the hull as the last step showed it, in one edit.

        Raises
        ------
        BadInputError
            No step was made, or the hull was edited since; or an edit is open.
        RefusedEditError
            The hull would not be consistent; it is unchanged.
        """
        frame = self._frame
        if frame is None:
            raise BadInputError("no step was made", _WHERE, "call to(noise=...) first")
        if frame.state is not self.document.state.published():
            what = "the hull has been edited since the last step"
            raise BadInputError(what, _WHERE, "call to() again, and look at what it gives")
        return fair_hull(
            self.document,
            lambda edit: edit.fair(noise=frame.noise, at=self.at, radius=frame.radius),
            name,
            dry_run=False,
        )

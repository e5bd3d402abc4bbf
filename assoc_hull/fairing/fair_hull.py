"""Fairing as one act: one edit of its own, tried or carried out, and the report of it."""

from __future__ import annotations

import time
from collections.abc import Callable

from assoc_hull.edit.document import Document
from assoc_hull.edit.modifications.fair import Faired
from assoc_hull.edit.session import Edit
from assoc_hull.edit.step import Step
from assoc_hull.errors import RefusedEditError
from assoc_hull.fairing.fair_report import FairReport
from assoc_hull.model.tables import HullState

__all__ = ["fair_hull"]

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

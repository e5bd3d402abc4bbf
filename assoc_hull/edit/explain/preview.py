"""Looking at an edit before it is made: everything runs, nothing is published."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import attrs

from assoc_hull.analysis.hydrostatics.volume import Displaced, displaced
from assoc_hull.arguments import all_of, text
from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.cause import Why
from assoc_hull.edit.explain.explain import Thing, node_of, why_after
from assoc_hull.edit.explain.line_changes import LineChange, line_changes
from assoc_hull.edit.pending_changes import Settings
from assoc_hull.edit.report import EditReport
from assoc_hull.edit.session import Edit
from assoc_hull.edit.step import Step
from assoc_hull.errors import BadInputError, RefusedEditError
from assoc_hull.model.definition.definition import fingerprint

__all__ = ["Preview", "preview"]


@attrs.frozen
class Preview:
    """What an edit would do.

    Attributes
    ----------
    report : EditReport or None
        The report that the edit would have; None if it would be refused.
    refused : tuple of str
        Every reason why the edit would be refused; empty if it would not.
    volume_change : float or None, m3
        At the design draught, both sides; None without two sections, or if refused.
    lcb_change : float or None, m
        + forward; None likewise.
    lines : tuple of LineChange
        The lines that would change, how far each would move, and where.
    why : mapping of str to Why
        Why each object that was asked for would change.
    fingerprint : str or None
        That of the hull after the edit; None if refused.
    """

    report: EditReport | None
    refused: tuple[str, ...]
    volume_change: float | None
    lcb_change: float | None
    lines: tuple[LineChange, ...] = ()
    why: Mapping[str, Why] = attrs.field(factory=dict, repr=False)
    fingerprint: str | None = None

    def __str__(self) -> str:
        if self.report is None:
            return "would be refused: " + "; ".join(self.refused)
        words = str(self.report)
        if self.volume_change is not None and self.lcb_change is not None:
            words += f"; volume {self.volume_change:+.4g} m3, LCB {1e3 * self.lcb_change:+.4g} mm"
        return words


def preview(
    document: Document,
    carry_out: Callable[[Edit], None],
    settings: Settings | None = None,
    name: str = "preview",
    why: Sequence[Thing | str] = (),
) -> Preview:
    """Run an edit beside the published state, and take it back.

    Parameters
    ----------
    document : Document
        The hull.
    carry_out : callable
        Called with the edit.
    settings : Settings or None
        As for an edit.
    name : str
        Name of the edit, for its report.
    why : sequence of objects or addresses
        Objects of which to tell why they would change.

    Returns
    -------
    Preview
    """
    asked: list[Any] = all_of(why, object, "why", "in preview")
    before, after = _measure(document), list[_After]()
    trial = Edit(
        document, text(name, "the name", "in preview"), settings,
        look=lambda step: after.append(_look(document, step, asked)),
    )  # fmt: skip
    try:
        with trial:
            carry_out(trial)
    except RefusedEditError as error:
        return Preview(None, error.findings, None, None)
    now, volume, lcb = after[0], None, None
    if before is not None and now.displaced is not None:
        volume = now.displaced.volume - before.volume
        lcb = now.displaced.lcb - before.lcb
    return Preview(trial.report, (), volume, lcb, now.lines, now.why, now.fingerprint)


@attrs.frozen
class _After:
    """What is to be known of a hull before an edit is taken back."""

    displaced: Displaced | None
    lines: tuple[LineChange, ...]
    why: dict[str, Why]
    fingerprint: str


def _look(document: Document, step: Step | None, asked: Sequence[Thing | str]) -> _After:
    state, steps = document.state, [*document.history, *([] if step is None else [step])]
    causes = dict[str, Why]()
    for thing in asked:
        node = node_of(state, thing)
        causes[thing if isinstance(thing, str) else thing.id] = why_after(state, steps, node)
    return _After(_measure(document), line_changes(state, step), causes, fingerprint(state))


def _measure(document: Document) -> Displaced | None:
    try:
        return displaced(document.state)
    except BadInputError:
        return None

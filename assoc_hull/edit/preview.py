"""Looking at an edit before it is made: everything runs, nothing is published."""

from __future__ import annotations

from collections.abc import Callable

import attrs

from assoc_hull.analysis.volume import Displaced, displaced
from assoc_hull.edit.document import Document
from assoc_hull.edit.pending import Settings
from assoc_hull.edit.report import EditReport
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, RefusedEditError

__all__ = ["Preview", "preview"]


@attrs.frozen
class Preview:
    """What an edit would do.

    Attributes
    ----------
    report : EditReport or None
        Curves that would change, the largest movement and where; None if it is refused.
    refused : tuple of str
        Every reason why the edit would be refused; empty if it would not.
    volume_change : float or None, m3
        At the design draught, both sides; None without two sections, or if refused.
    lcb_change : float or None, m
        + forward; None likewise.
    """

    report: EditReport | None
    refused: tuple[str, ...]
    volume_change: float | None
    lcb_change: float | None

    def __str__(self) -> str:
        if self.report is None:
            return "would be refused: " + "; ".join(self.refused)
        text = str(self.report)
        if self.volume_change is not None and self.lcb_change is not None:
            text += f"; volume {self.volume_change:+.4g} m3, LCB {1e3 * self.lcb_change:+.4g} mm"
        return text


def preview(
    document: Document, carry_out: Callable[[Edit], None], settings: Settings | None = None
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

    Returns
    -------
    Preview
    """
    before, after = _measure(document), list[Displaced | None]()
    trial = Edit(document, "preview", settings, look=lambda: after.append(_measure(document)))
    try:
        with trial:
            carry_out(trial)
    except RefusedEditError as error:
        return Preview(None, error.findings, None, None)
    now = after[0]
    if before is None or now is None:
        return Preview(trial.report, (), None, None)
    return Preview(trial.report, (), now.volume - before.volume, now.lcb - before.lcb)


def _measure(document: Document) -> Displaced | None:
    try:
        return displaced(document.state)
    except BadInputError:
        return None

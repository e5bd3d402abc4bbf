"""What a report of stability says besides its numbers."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.stability.heeled import FREE_MOST, Heeled
from assoc_hull.analysis.stability.levers import Case

__all__ = ["notes_of", "why_it_ends"]


def why_it_ends(end: float, limit: float | None) -> str:
    """Say why a curve of levers ends.

    Parameters
    ----------
    end : float, degrees
        Where it does.
    limit : float or None, degrees
        Where the edge of an open deck goes under; None: the deck is closed, or its edge stays dry.
    """
    if limit is not None:
        return f"GZ stops at {limit:.2f} deg, where the edge of the open deck goes under"
    return f"GZ is computed to {end:.4g} deg"


def notes_of(at: Heeled, case: Case, limit: float | None, side: int) -> tuple[str, ...]:
    """Say whether the deck is open, what is not evaluated, and which heels have no lever.

    Parameters
    ----------
    at : Heeled
        The heels that were asked.
    case : Case
        The ship.
    limit : float or None, degrees
        As for `why_it_ends`.
    side : int
        To which side the ship is judged: 1 starboard, -1 port.
    """
    deck = "closed" if case.afloat.body.limits.closed else "open"
    notes = [f"the deck is {deck}" + (f": {why_it_ends(0.0, limit)}" if limit is not None else "")]
    if case.trim == "fixed":
        notes.append("trim is fixed: levers are those of the plane with the draughts' difference")
    notes.append("the weather criterion (2008 IS Code A 2.3) is not evaluated")
    return (*notes, *_other_side(at, side), *_missing(at, case, limit))


def _other_side(at: Heeled, side: int) -> list[str]:
    """Tell that all heels of the table are to the side on which the ship is not judged."""
    towards = side * at.heel_deg
    if (towards > 0.0).any() or not (towards < 0.0).any():
        return []
    judged, sign = ("starboard", "positive") if side > 0 else ("port", "negative")
    return [f"she is judged heeling to {judged}: for levers to that side ask for {sign} heels"]


def _missing(at: Heeled, case: Case, limit: float | None) -> list[str]:
    """Name heels that were asked and have no lever, though the deck keeps the water out."""
    most = FREE_MOST if case.trim == "free" else 90.0
    heel = np.abs(at.heel_deg)
    none = np.isnan(at.gz) & (heel <= (most if limit is None else limit))
    notes = []
    if (heel > most).any() and limit is None:
        notes.append(f"at free trim nothing is computed beyond {most:g} deg")
    if none.any():
        words = ", ".join(f"{each:g}" for each in at.heel_deg[none].tolist())
        notes.append(f"she does not float at {words} deg, or an appendage gets wet just there")
    return notes

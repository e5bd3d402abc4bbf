"""A seeded walk over a ship: edits of all kinds, one after another, at shared crossings."""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.edit.step import EditReport
from tests.cases import places
from tests.independent import Snapshot, snapshot

__all__ = ["Step", "walk"]

AMOUNTS = {"drag": (0.005, 0.02, 0.05), "pull": (0.02, 0.05), "re-shape": (0.02, 0.05)}
"""Normal displacements, m; each kind is as likely as the others."""

_TRIES = 3
"""So many edits may be tried for each that is wanted."""


@attrs.frozen
class Step:
    """One accepted edit: the hull before it, and what it reports."""

    before: Snapshot
    report: EditReport


def walk(hull: ah.Hull, seed: int, count: int) -> Iterator[Step]:
    """Edit a hull, and give every edit while it stands; at the end all are undone.

    Refused edits are passed over, once it is seen that they changed no bit.
    """
    rng, start, accepted = np.random.default_rng(seed), len(hull.history), 0
    try:
        for _ in range(_TRIES * count):
            before, mark = snapshot(hull), hull.fingerprint
            report = _edit(hull, rng)
            if report is None:
                assert hull.fingerprint == mark
                continue
            yield Step(before, report)
            accepted += 1
            if accepted == count:
                return
        raise AssertionError(f"only {accepted} of {_TRIES * count} edits were accepted")
    finally:
        hull.undo(len(hull.history) - start)


def _edit(hull: ah.Hull, rng: np.random.Generator) -> EditReport | None:
    """Try an edit of any kind at any shared crossing, outward or inward; None if refused."""
    pair = places.PAIRS[int(rng.integers(len(places.PAIRS)))]
    row = int(rng.choice(places.shared_rows(hull, pair)))
    kind = str(rng.choice(sorted(AMOUNTS)))
    amount = float(rng.choice(AMOUNTS[kind]) * rng.choice((-1.0, 1.0)))
    name = str(rng.choice(pair))
    act = {
        "drag": places.drag(hull, amount),
        "pull": places.pull(hull, amount),
        "re-shape": places.reshape(hull, name, amount),
    }[kind]
    try:
        with hull.edit(f"{kind} {1e3 * amount:+.0f} mm") as edit:
            act(edit, row)
    except ah.errors.RefusedEditError:
        return None
    return edit.report

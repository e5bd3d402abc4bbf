"""Findings on features: points that lie off them, and references that lead nowhere.

An edit never leaves any behind: it dissolves what it bends. A file that other hands have written
may hold them, and so does a hull between a mapping and the making anew of its features.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.model.address import AddressBook
from assoc_hull.model.feature_geometry import ROUNDING, line_numbers, places_off
from assoc_hull.model.features import Feature
from assoc_hull.model.state import HullState

__all__ = ["find_off_features"]


def find_off_features(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Tell, feature by feature, the point that lies farthest off where one lies too far off.

    Examples
    --------
    >>> from assoc_hull.edit.checks.features import find_off_features
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley(stations=5, waterlines=4)
    >>> list(find_off_features(state, AddressBook(state)))
    []
    """
    live = set(state.live("rows").tolist())
    lines = set(line_numbers(state))
    for each in state.features:
        if not (live.issuperset(each.points) and lines.issuperset(each.lines)):
            text = "owns a point or lies on a line that is not there: undo the edit"
            yield Finding("feature", each.name, None, None, text)
            continue
        yield from _off(state, book, each)


def _off(state: HullState, book: AddressBook, feature: Feature) -> Iterator[Finding]:
    off = places_off(feature, state.rows.xyz.data[list(feature.points)])
    worst = int(np.argmax(off))
    if off[worst] > feature.gap + ROUNDING:
        text = (
            f"lies {1e3 * off[worst]:.3f} mm off the {feature.kind} {feature.name!r}: make the "
            "feature anew, or undo what bent it"
        )
        yield row_finding(state, book, feature.points[worst], "feature", text, float(off[worst]))

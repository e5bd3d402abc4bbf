"""What becomes of features when an edit has run: they follow, are found on new lines, or dissolve.

A feature is dissolved, with a note, where a point that it owns was set by hand on its line, where
it has lost an end, and where its points have been bent off it and `redraw_features` could not put
them back. All else follows: points that came between its ends are its own now, and it lies in the
plane of its line.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.edit.followup.features import (
    feature_in_plane,
    find_features,
    followed_feature,
    loose_of,
)
from assoc_hull.edit.mapped_features import CarriedFeatures
from assoc_hull.edit.modification import Work
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.address import address
from assoc_hull.model.feature_geometry import line_numbers, places_off, rounded_gap, rounding_of
from assoc_hull.model.features import Feature
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import HullState

__all__ = ["Hand", "affected_features", "set_by_hand", "settle_features"]

_TOLD = 3
"""So many features a note names."""

Hand = set[tuple[int, int]]
"""Points that were set by hand, each with a curve."""


@attrs.define(eq=False)
class _Settling:
    """Features while they are settled: those kept, by key, and what is told of the others.

    `lines` holds the numbers of the live lines by key.
    """

    kept: dict[str, Feature]
    lines: dict[str, int]
    notes: list[str] = attrs.field(factory=list)
    lost: list[str] = attrs.field(factory=list)
    bent: list[str] = attrs.field(factory=list)


def settle_features(work: Work, rows: IntArray, changed: IntArray) -> None:
    """Bring the features of a hull up to date with an edit, through its journal.

    Parameters
    ----------
    work : Work
        The update, which has run and was found good.
    rows : (k,) int
        Points that were set, and differ from before by a bit.
    changed : (k,) int
        All points that changed, these included.
    """
    state, pending = work.state, work.pending
    before = state.features if pending.features is None else pending.features.features
    fresh = _fresh_lines(work)
    whole = pending.structural or pending.alone
    affected, hand = affected_features(work, rows, changed)
    if not affected and not fresh:
        return
    found = _Settling({each.key: each for each in before}, line_numbers(state))
    for each in affected:
        _settle(work, found, each, hand, whole=whole)
    _find_anew(state, found, before, fresh)
    Maker(state, work.journal).features(found.kept.values())
    pending.notes += [
        *found.notes, *_told("they have lost an end", found.lost),
        *_told("their points are bent off them", found.bent),
    ]  # fmt: skip


def affected_features(
    work: Work, rows: IntArray, changed: IntArray
) -> tuple[Sequence[Feature], Hand]:
    """Give the features that an edit may have changed, and the points that were set by hand.

    `rows` and `changed` are as `settle_features` takes them.
    """
    pending = work.pending
    hand = pending.by_hand | _moved_by_hand(work, rows)
    every = work.state.features if pending.features is None else pending.features.features
    if pending.structural or pending.alone:
        return every, hand
    return [every[number] for number in _affected(work, changed)], hand


def _fresh_lines(work: Work) -> set[str]:
    """Give the keys of lines that were cut, or cut again, in this edit."""
    state = work.state
    curves = [curve for curve in work.pending.fresh if state.curves.alive[curve]]
    return {str(state.lines.key[state.line_of(curve)]) for curve in curves}


def _moved_by_hand(work: Work, rows: IntArray) -> Hand:
    """Give the points that the edit itself moved, each with both its curves."""
    if work.pending.alone:
        return set()
    moved = work.pending.values.keys() & set(rows.tolist())
    curve = work.state.rows.curve.data
    return {(row, int(each)) for row in moved for each in curve[row]}


def _affected(work: Work, changed: IntArray) -> list[int]:
    """Give the numbers of the features that own a point which changed."""
    point, owner = _owners(work.state)
    if not len(point):
        return []
    hand = np.array([row for row, _ in work.pending.by_hand], np.int64)
    every = np.concatenate([changed, hand])
    found: list[int] = np.unique(owner[np.isin(point, every)]).tolist()
    return found


def _owners(state: HullState) -> tuple[IntArray, IntArray]:
    """Give each owned point with the number of its feature; kept until the features change."""
    table = state.featured
    return state.derived(("owners",), (table.feature, table.alive), lambda: _find_owners(state))


def _find_owners(state: HullState) -> tuple[IntArray, IntArray]:
    points = [np.array(each.points, np.int64) for each in state.features]
    owner = np.repeat(np.arange(len(points)), [len(part) for part in points])
    return np.concatenate([np.zeros(0, np.int64), *points]), owner


def _settle(work: Work, found: _Settling, old: Feature, hand: Hand, *, whole: bool) -> None:
    """Keep a feature, as it has become, or dissolve it."""
    state = work.state
    carried = work.pending.features
    places = None if carried is None else carried.places
    new = followed_feature(state, old, found.lines, places) if whole else old
    touched = set_by_hand(state, old, hand) or (set_by_hand(state, new, hand) if new else "")
    if touched:
        found.notes.append(f"the feature {old.name!r} is dissolved: {touched} was set by hand")
    elif new is None:
        found.lost += [old.name] if set(old.lines) & found.lines.keys() else []
    else:
        stays = _held(state, new, carried)
        if stays is not None:
            found.kept[old.key] = stays
            return
        found.bent.append(old.name)
    del found.kept[old.key]


def _held(state: HullState, feature: Feature, carried: CarriedFeatures | None) -> Feature | None:
    """Give a feature, None if its points are off it; after a mapping its gap may be wider."""
    off = float(places_off(feature, state.rows.xyz[list(feature.points)]).max())
    if off <= feature.gap + rounding_of(state):
        return feature
    if carried is None:
        return None
    if np.isinf(carried.within):
        return feature
    stays = feature.key not in carried.bent and off <= carried.within
    return attrs.evolve(feature, gap=rounded_gap(state, off)) if stays else None


def set_by_hand(state: HullState, feature: Feature, hand: Hand) -> str:
    """Name a point of a feature that was set by hand on its line; empty if there is none."""
    for row, curve in sorted(hand):
        if curve < 0 or row not in feature.points:
            continue
        if state.lines.key[state.line_of(curve)] in feature.lines:
            return address(state, row) if state.rows.alive[row] else "a point of it"
    return ""


def _find_anew(
    state: HullState, found: _Settling, before: Sequence[Feature], fresh: set[str]
) -> None:
    """Find the features of lines that were cut; one of a name that was there keeps its key."""
    if not fresh:
        return
    known = {(each.lines, each.name): each for each in before if fresh.issuperset(each.lines)}
    old = {each.key for each in found.kept.values() if fresh.issuperset(each.lines)}
    found.kept = {key: each for key, each in found.kept.items() if key not in old}
    names = set[tuple[tuple[str, ...], str]]()
    for each in find_features(state, lines=fresh):
        new = _as_before(state, found.lines, known.get((each.lines, each.name)), each)
        found.kept[new.key] = new
        names.add((each.lines, each.name))
    told = {*found.lost, *found.bent}
    found.lost = [each for each in found.lost if each not in {name for _, name in names}]
    found.bent = [each for each in found.bent if each not in {name for _, name in names}]
    found.bent += [name for lines, name in known if (lines, name) not in names and name not in told]


def _as_before(
    state: HullState, lines: Mapping[str, int], old: Feature | None, new: Feature
) -> Feature:
    """Give a feature found anew the key it had, and the circle it had where that fits as well."""
    if old is None or old.kind != new.kind:
        return new
    again = feature_in_plane(state, attrs.evolve(old, points=new.points), lines[new.lines[0]])
    off = places_off(again, state.rows.xyz[list(new.points)]) if again else np.ones(1)
    if again is None or off.max() > loose_of(state):
        return attrs.evolve(new, key=old.key)
    return attrs.evolve(again, gap=rounded_gap(state, float(off.max())))


def _told(reason: str, names: Sequence[str]) -> list[str]:
    """Say in one note which features are dissolved."""
    if not names:
        return []
    shown = ", ".join(repr(name) for name in names[:_TOLD])
    more = f" and {len(names) - _TOLD} more" if len(names) > _TOLD else ""
    return [f"features dissolved, as {reason}: {shown}{more}"]

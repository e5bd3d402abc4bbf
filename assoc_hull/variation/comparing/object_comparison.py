"""Points and features of a parent and of a variant: which came, which went, which changed."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import attrs

from assoc_hull.model.address import AddressBook
from assoc_hull.model.features import Place
from assoc_hull.model.kinds import Sort
from assoc_hull.model.objects import FeatureHandle, features_by_name
from assoc_hull.model.tables import HullState

__all__ = ["FeatureComparison", "PointsComparison", "compare_features", "compare_points"]


@attrs.frozen
class PointsComparison:
    """The points of both hulls.

    Attributes
    ----------
    before, after : mapping of str to int
        How many crossings, placed and adopted points parent and variant have.
    came, went : tuple of str
        Addresses in the variant of points that the parent lacks, and in the parent of those that
        the variant lacks. A point is the same if its key is: a key outlives moves and renaming.
    """

    before: Mapping[str, int]
    after: Mapping[str, int]
    came: tuple[str, ...]
    went: tuple[str, ...]


@attrs.frozen
class FeatureComparison:
    """A feature of a parent, of a variant, or of both.

    Attributes
    ----------
    name, kind : str
        Of the variant; of a feature that went, of the parent.
    what : {"same", "changed", "came", "went"}
        Whether its parameters are equal, to the last bit, or it is in one of both only.
    before, after : mapping of str to float or place, or None
        Its parameters, m; None where it is not.
    """

    name: str
    kind: str
    what: str
    before: Mapping[str, float | Place] | None
    after: Mapping[str, float | Place] | None


def compare_points(parent: HullState, variant: HullState) -> PointsComparison:
    """Tell which points came and went.

    Parameters
    ----------
    parent, variant : HullState
        The tables.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.comparing.object_comparison import compare_points
    >>> found = compare_points(wigley(waterlines=3), wigley(waterlines=4))
    >>> found.after["crossing"] - found.before["crossing"], found.came[0]
    (21, 'WL 2.08333 x profile')
    """
    old, new = _rows(parent), _rows(variant)
    return PointsComparison(
        _counts(parent),
        _counts(variant),
        _addresses(variant, [row for key, row in new.items() if key not in old]),
        _addresses(parent, [row for key, row in old.items() if key not in new]),
    )


def _rows(state: HullState) -> dict[str, int]:
    keys = state.rows.key.data
    return {str(keys[row]): row for row in state.live("rows").tolist()}


def _addresses(state: HullState, rows: list[int]) -> tuple[str, ...]:
    book = AddressBook(state)
    return tuple(book.address(row) for row in rows)


def _counts(state: HullState) -> Mapping[str, int]:
    sort = state.rows.sort[state.live("rows")]
    return MappingProxyType({each.name.lower(): int((sort == each).sum()) for each in Sort})


def compare_features(parent: HullState, variant: HullState) -> tuple[FeatureComparison, ...]:
    """Compare features by name, in the order of the variant; those that went come last.

    Parameters
    ----------
    parent, variant : HullState
        The tables.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.comparing.object_comparison import compare_features
    >>> {each.what for each in compare_features(wigley(), wigley())}
    {'same'}
    """
    old, new = (dict(features_by_name(state)) for state in (parent, variant))
    names = [*new, *(name for name in old if name not in new)]
    return tuple(_feature(name, old.get(name), new.get(name)) for name in names)


def _feature(
    name: str, before: FeatureHandle | None, after: FeatureHandle | None
) -> FeatureComparison:
    was, now = (None if each is None else each.parameters for each in (before, after))
    if before is None or after is None:
        (there,) = (each for each in (before, after) if each is not None)
        return FeatureComparison(name, there.kind, "went" if after is None else "came", was, now)
    same = before.kind == after.kind and was == now
    return FeatureComparison(name, after.kind, "same" if same else "changed", was, now)

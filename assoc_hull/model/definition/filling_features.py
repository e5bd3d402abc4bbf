"""From a definition to the features of a hull, every reference checked.

Examples
--------
>>> from assoc_hull.graph.journal import Journal
>>> from assoc_hull.model.definition.filling import Keys
>>> from assoc_hull.model.definition.filling_features import put_features
>>> from assoc_hull.model.state import HullState, Particulars
>>> state = HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))
>>> put_features(state, Journal(), [], Keys({}, {}, {}, {}))
>>> state.features
()
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from assoc_hull.errors import BadInputError
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.filling import Keys, wrong
from assoc_hull.model.features import Feature
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.state import HullState

__all__ = ["put_features"]


def put_features(
    state: HullState, journal: Journal, records: Iterable[Mapping[str, Any]], keys: Keys
) -> None:
    """Put the features of a definition into the tables.

    Raises
    ------
    BadInputError
        A line or point that is not there, a key that stands twice, or parameters that
        do not fit the kind.
    """
    features = [_feature(record, keys) for record in records]
    there = set[str]()
    for each in features:
        if each.key in there:
            raise wrong(f"the key {each.key!r} stands there twice", "in the features")
        there.add(each.key)
    Maker(state, journal).features(features)


def _feature(record: Mapping[str, Any], keys: Keys) -> Feature:
    where = f"the feature {record['key']}"
    points = [keys.find("points", key, where) for key in record["points"]]
    for key in record["lines"]:
        keys.find("lines", key, where)
    try:
        return Feature(**{**record, "points": points})
    except BadInputError as error:
        raise wrong(error.what, error.where) from error

"""The features of a hull to the rows of a hull file, and back.

Examples
--------
>>> from assoc_hull.io.hull_file.features import feature_of, feature_row
>>> from assoc_hull.model.features import Feature
>>> run = Feature(key="ST 1 straight", kind="straight", name="run", lines=("ST 1",), points=(3, 4))
>>> feature_of(feature_row(0, True, run)) == run
True
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.features import Feature
from assoc_hull.model.state import HullState

__all__ = ["feature_of", "feature_row", "feature_rows", "read_features"]


def feature_rows(state: HullState, numbers: IntArray) -> Iterator[tuple[Any, ...]]:
    """Give rows of the table of features as rows of the file."""
    table = state.featured
    for i in numbers.tolist():
        yield feature_row(i, bool(table.alive.data[i]), table.feature.data[i])


def read_features(state: HullState, rows: Sequence[tuple[Any, ...]]) -> None:
    """Put rows of the file into the empty table of features.

    Raises
    ------
    ValueError, TypeError, AssocHullError
        A row holds none.
    """
    table = state.featured
    table.resize(len(rows))
    table.feature.data[:] = [feature_of(row) for row in rows]
    table.alive.store[: len(rows)] = [bool(row[1]) for row in rows]
    table.alive.writes += 1


def feature_row(number: int, alive: bool, feature: Feature) -> tuple[Any, ...]:
    """Give a feature as a row of the table."""
    return (
        number, int(alive), feature.key, feature.kind, feature.name, json.dumps(feature.lines),
        np.array(feature.points, "<i4").tobytes(), _blob(feature.centre), _blob(feature.radius),
        _blob(feature.normal), _blob(feature.offset), _blob(feature.direction), feature.side,
        _blob(feature.gap),
    )  # fmt: skip


def feature_of(row: tuple[Any, ...]) -> Feature:
    """Take a feature from a row of the table.

    Raises
    ------
    ValueError, TypeError, AssocHullError
        The row holds none.
    """
    _, _, key, kind, name, lines, points, centre, radius, normal, offset, direction, side, gap = row
    return Feature(
        key, kind, name, json.loads(lines), np.frombuffer(points, "<i4").tolist(), _vector(centre),
        _real(radius), _vector(normal), _real(offset), _vector(direction), side, _real(gap),
    )  # fmt: skip


def _blob(value: object) -> bytes | None:
    return None if value is None else np.asarray(value, "<f8").tobytes()


def _vector(blob: bytes | None) -> Any:
    return None if blob is None else np.frombuffer(blob, "<f8").tolist()


def _real(blob: bytes | None) -> Any:
    return None if blob is None else np.frombuffer(blob, "<f8").item()

"""A comparison of two hulls as a table for a terminal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING

from assoc_hull.variation.comparing.cells import (
    LINE_HEAD,
    NUMBER_HEAD,
    PRINCIPAL,
    counts,
    hull_words,
    line_cells,
    line_words,
    number_cells,
    object_words,
    reason_words,
)
from assoc_hull.variation.comparing.number_comparison import NumberComparison

if TYPE_CHECKING:
    from assoc_hull.variation.comparing.compare import HullComparison

__all__ = ["comparison_text"]


def comparison_text(found: HullComparison, lines: int = 10) -> str:
    """Lay out a comparison: lines that moved, numbers, what came and went.

    Parameters
    ----------
    found : HullComparison
        The comparison.
    lines : int
        At most so many lines are listed, those that moved farthest.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.variation.comparing.text import comparison_text
    >>> hull = ah.examples.wigley()
    >>> print(comparison_text(ah.compare(hull, hull)).splitlines()[3])
    lines: 31 same, 0 moved, 0 came, 0 went
    """
    parts = [
        _head(found),
        _lines(found, lines),
        _numbers("HYDROSTATICS", [found.hydrostatic(name) for name in PRINCIPAL]),
        _numbers("FORM PARAMETERS", [each for each in found.parameters if not each.is_same]),
        ("", *object_words(found)),
    ]
    return "\n".join(chain.from_iterable(parts))


def _head(found: HullComparison) -> Iterator[str]:
    for title, hull in (("parent", found.parent), ("variant", found.variant)):
        yield f"{title:9}{hull_words(hull)}"
        yield from (f"{'':9}{each}" for each in hull.doubts)
    if found.is_same:
        yield f"{'':9}the same hull: both have one fingerprint"
    yield f"lines: {counts(found)}"
    yield from line_words(found)


def _lines(found: HullComparison, count: int) -> Iterator[str]:
    chosen = found.worst(count)
    if chosen:
        yield ""
        yield f"LINES, the {len(chosen)} that moved farthest of {len(found.of('moved'))}"
        yield from _laid_out([LINE_HEAD, *map(line_cells, chosen)], "<><<>>>>")


def _numbers(title: str, numbers: Sequence[NumberComparison]) -> Iterator[str]:
    if numbers:
        yield ""
        yield title
        yield from _laid_out([NUMBER_HEAD, *map(number_cells, numbers)], "<<>>>>")
        yield from reason_words(numbers)


def _laid_out(rows: Iterable[Sequence[str]], sides: str) -> Iterator[str]:
    """Put cells below one another, each column to one side."""
    cells = [list(row) for row in rows]
    wide = [max(len(each) for each in column) for column in zip(*cells, strict=True)]
    for row in cells:
        told = [f"{each:{side}{room}}" for each, side, room in zip(row, sides, wide, strict=True)]
        yield "  ".join(told).rstrip()

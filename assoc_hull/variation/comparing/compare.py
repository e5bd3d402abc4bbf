"""A parent and a variant of it side by side: lines, numbers, fairness, points, features.

Examples
--------
>>> import assoc_hull as ah
>>> parent = ah.examples.wigley()
>>> variant = ah.vary(parent, set={"breadth": 11.0}).hull
>>> found = ah.compare(parent, variant)
>>> line = found.line("WL 6.25")
>>> line.shift.direction, round(line.shift.length, 6)
('out', 0.5)
>>> round(found.hydrostatic("volume").percent, 6)
10.0
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType

import attrs

from assoc_hull.analysis.form.screw import Screw
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, state_of
from assoc_hull.arguments import choice, instance, integer
from assoc_hull.model.definition.definition import fingerprint
from assoc_hull.model.named_mapping import Named
from assoc_hull.model.state import HullState, Particulars
from assoc_hull.variation.comparing.line_fairness import FairnessTable
from assoc_hull.variation.comparing.lines import LineComparison, compare_lines
from assoc_hull.variation.comparing.number_comparison import (
    NumberComparison,
    compare_numbers,
    numbers_of,
)
from assoc_hull.variation.comparing.object_comparison import (
    FeatureComparison,
    PointsComparison,
    compare_features,
    compare_points,
)

__all__ = ["ComparedHull", "HullComparison", "compare"]

_WHERE = "in compare"


@attrs.frozen
class ComparedHull:
    """One of both hulls.

    Attributes
    ----------
    particulars : Particulars
        Name and principal dimensions, m.
    fingerprint : str
        SHA-256 of definition and published values.
    draught : float, m
        Moulded, at which it was measured, at even keel.
    doubts : tuple of str
        What makes its hydrostatics doubtful, or why there are none.
    """

    particulars: Particulars
    fingerprint: str
    draught: float
    doubts: tuple[str, ...]


_BY: Mapping[str, Callable[[LineComparison], float]] = MappingProxyType(
    {
        "shift": lambda line: line.length,
        "course": lambda line: line.course,
        "comb": lambda line: line.comb_ratio or 0.0,
        "signs": lambda line: float(line.added),
    }
)
"""By what lines may be sorted, the greatest first."""


@attrs.frozen(eq=False)
class HullComparison:
    """A parent and a variant side by side; `str` gives it as a table.

    Attributes
    ----------
    parent, variant : ComparedHull
        Which hulls, and at which draughts.
    lines : tuple of LineComparison
        Every line of either, in the order of the variant; those that went come last.
    hydrostatics : tuple of NumberComparison
        As `assoc_hull.hydrostatics` gives them, under its names.
    parameters : tuple of NumberComparison
        All form parameters, in the order of the tables of the catalogue.
    points : PointsComparison
        Points that came and went.
    features : tuple of FeatureComparison
        Every feature of either.
    """

    parent: ComparedHull
    variant: ComparedHull
    lines: tuple[LineComparison, ...]
    hydrostatics: tuple[NumberComparison, ...]
    parameters: tuple[NumberComparison, ...]
    points: PointsComparison
    features: tuple[FeatureComparison, ...]

    def line(self, name: str) -> LineComparison:
        """Give a line by its name.

        Raises
        ------
        UnknownNameError
            Neither hull has it.
        """
        return Named("line", {each.name: each for each in reversed(self.lines)})[name]

    def hydrostatic(self, name: str) -> NumberComparison:
        """Give a value of the record of hydrostatics by its name.

        Raises
        ------
        UnknownNameError
            There is none.
        """
        return Named("value", {each.symbol: each for each in self.hydrostatics})[name]

    def parameter(self, symbol: str) -> NumberComparison:
        """Give a form parameter by its symbol.

        Raises
        ------
        UnknownNameError
            There is none.
        """
        return Named("form parameter", {each.symbol: each for each in self.parameters})[symbol]

    def worst(self, count: int = 10, *, by: str = "shift") -> tuple[LineComparison, ...]:
        """Give the lines that changed most, the worst first.

        Parameters
        ----------
        count : int
            At most so many.
        by : {"shift", "course", "comb", "signs"}
            The largest shift; that beside the shift of the plane; the ratio of the comb
            integrals; changes of sign of curvature that were added. A line of which this is
            nil does not come, nor one whose comb has not risen.

        Raises
        ------
        BadInputError
            No such number, or another order.
        """
        integer(count, "count", "in worst", least=0)
        measure = _BY[choice(by, "by", _BY, "in worst")]
        least = 1.0 if by == "comb" else 0.0
        found = [line for line in self.lines if line.what == "moved" and measure(line) > least]
        return tuple(sorted(found, key=lambda line: -measure(line))[:count])

    def of(self, what: str) -> tuple[LineComparison, ...]:
        """Give the lines that are the same, moved, came or went.

        Raises
        ------
        BadInputError
            Another word.
        """
        choice(what, "what", ("same", "moved", "came", "went"), "in of")
        return tuple(line for line in self.lines if line.what == what)

    @property
    def fairness(self) -> FairnessTable:
        """Changes of sign and comb ratios of the lines of both, and their sums."""
        told = (line.fairness for line in self.lines)
        return FairnessTable(tuple(each for each in told if each is not None))

    @property
    def is_same(self) -> bool:
        """Tell whether both hulls have the same fingerprint."""
        return self.parent.fingerprint == self.variant.fingerprint

    def to_json(self) -> str:
        """Give everything as JSON text; its schema is `comparison` of ``assoc-hull schema``."""
        from assoc_hull.variation.comparing.json import comparison_json

        return comparison_json(self)

    def __str__(self) -> str:
        from assoc_hull.variation.comparing.text import comparison_text

        return comparison_text(self)


def compare(
    parent: HasState,
    variant: HasState,
    *,
    draught: float | None = None,
    screw: Screw | None = None,
) -> HullComparison:
    """Compare a variant with its parent, or any two hulls.

    Lines are paired by name, and by key where one was renamed. Of each pair the largest shift
    is told, measured curve to curve in the plane of the line (see
    `assoc_hull.variation.comparing.line_shift`), and how fair it is before and after. All
    differences are variant less parent: with both exchanged, they change their signs.

    Parameters
    ----------
    parent, variant : Hull
        The hulls; neither is changed.
    draught : float or None, m
        Moulded, at even keel, for the numbers of both; each at its design draught if not given.
    screw : Screw or None
        For the form parameters that need it.

    Returns
    -------
    HullComparison
        Everything; what has no number has a reason.

    Raises
    ------
    OutOfRangeError
        One of both does not float at the draught that was asked.
    BadInputError
        No hull, or a number that cannot be used.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> parent = ah.examples.wigley()
    >>> found = ah.compare(parent, ah.vary(parent, set={"breadth": 11.0}).hull, draught=5.0)
    >>> print(f"{found.parameter('BMT').percent:.3f} %")
    21.000 %
    """
    old, new = state_of(parent, _WHERE), state_of(variant, _WHERE)
    if screw is not None:
        instance(screw, Screw, "screw", _WHERE)
    was, now = (numbers_of(hull, draught, screw) for hull in (parent, variant))
    hydrostatics, parameters = compare_numbers(was, now)
    return HullComparison(
        _hull(old, draught, was.doubts),
        _hull(new, draught, now.doubts),
        compare_lines(old, new),
        hydrostatics,
        parameters,
        compare_points(old, new),
        compare_features(old, new),
    )


def _hull(state: HullState, draught: float | None, doubts: Iterable[str]) -> ComparedHull:
    ship = state.particulars
    level = ship.draught if draught is None else float(draught)
    return ComparedHull(ship, fingerprint(state), level, tuple(doubts))

"""Numbers, points and features of a parent and of a variant side by side.

Points and features of a parent and of a variant: which came, which went, which changed.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

import attrs

from assoc_hull.analysis.form.floating_shape import Screw
from assoc_hull.analysis.form.form_parameters import CATALOGUE, by_table, form_parameters
from assoc_hull.analysis.form.parameter import FormValue
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics
from assoc_hull.analysis.hydrostatics.record import FIELDS, Hydrostatics
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.model.address import AddressBook
from assoc_hull.model.features import Place
from assoc_hull.model.kinds import Sort
from assoc_hull.model.objects import FeatureHandle, features_by_name
from assoc_hull.model.tables import HasState, HullState

__all__ = [
    "FeatureComparison",
    "NumberComparison",
    "Numbers",
    "PointsComparison",
    "compare_features",
    "compare_numbers",
    "compare_points",
    "numbers_of",
]


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
    >>> from assoc_hull.variation.comparing.number_comparison import compare_points
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
    >>> from assoc_hull.variation.comparing.number_comparison import compare_features
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


_LOADED = ("gmt", "gml")
"""Of a hull whose centre of gravity is known; so they are not compared."""

_TITLE = 60
"""Letters of a title on a line of a terminal; of a longer one the first clause is printed."""


@attrs.frozen
class NumberComparison:
    """A number of both hulls.

    Attributes
    ----------
    symbol, title, unit : str
        As the record of hydrostatics or the catalogue of form parameters has it; a dash where
        there is no unit.
    digits : int
        After the point, for people.
    before, after : float or None
        Of parent and variant; None where there is none.
    reason : str or None
        Why one of both, or both, are missing.
    """

    symbol: str
    title: str
    unit: str
    digits: int
    before: float | None
    after: float | None
    reason: str | None = None

    @property
    def printed_symbol(self) -> str:
        """The symbol that naval architects use: "KM_T" of the record's field `kmt`."""
        return FIELDS[self.symbol].symbol if self.symbol in FIELDS else self.symbol

    @property
    def short_title(self) -> str:
        """The title without what explains it, where it is too long for a line of a terminal."""
        words = re.split("[:;]", self.title)[0]
        return words if len(words) <= _TITLE else words.split(",")[0]

    @property
    def difference(self) -> float | None:
        """Variant less parent, in the unit; None where one is missing."""
        if self.before is None or self.after is None:
            return None
        return self.after - self.before

    @property
    def percent(self) -> float | None:
        """The difference in percent of the parent's value.

        None if that is missing, or zero in its printed digits: then it is only rounding; and of a
        value in per cent itself, where it would be taken for its points.
        """
        if self.unit.startswith("%"):
            return None
        if self.difference is None or self.before is None or not self._printed(self.before):
            return None
        return 100.0 * self.difference / abs(self.before)

    @property
    def is_same(self) -> bool:
        """Tell whether both have it, or both have it not, and its printed digits are equal."""
        if self.before is None or self.after is None:
            return self.before is self.after
        return self._printed(self.before) == self._printed(self.after)

    @property
    def prints_alike(self) -> bool:
        """Tell whether a row of it would say nothing: the same digits, or a difference of 0."""
        return self.is_same or (self.difference is not None and not self._printed(self.difference))

    def _printed(self, value: float) -> float:
        return round(value, self.digits)


@attrs.frozen(eq=False)
class Numbers:
    """What is measured of one hull.

    Attributes
    ----------
    record : Hydrostatics or None
        Upright at even keel.
    parameters : mapping of str to FormValue
        Form parameters by symbol; none where the hull cannot be measured.
    trouble : str or None
        Why it cannot.
    """

    record: Hydrostatics | None
    parameters: Mapping[str, FormValue]
    trouble: str | None = None

    @property
    def doubts(self) -> tuple[str, ...]:
        """What makes the numbers doubtful, or why there are none."""
        if self.record is None:
            return () if self.trouble is None else (self.trouble,)
        return self.record.notes


def numbers_of(hull: HasState, draught: float | None, screw: Screw | None) -> Numbers:
    """Measure a hull at even keel.

    Parameters
    ----------
    hull : Hull
        The hull.
    draught : float or None, m
        Moulded; None: its design draught, and what cannot be measured there has a reason.
    screw : Screw or None
        For the form parameters that need it.

    Raises
    ------
    OutOfRangeError, BadInputError
        The hull does not float at the draught that was asked.
    """
    try:
        record = hydrostatics(hull, draught=draught, estimate=False, on_error="report")
        return Numbers(record, form_parameters(hull, draught=draught, screw=screw))
    except (BadInputError, OutOfRangeError) as error:
        if draught is not None:
            raise
        return Numbers(None, {}, str(error))


def compare_numbers(
    parent: Numbers, variant: Numbers
) -> tuple[tuple[NumberComparison, ...], tuple[NumberComparison, ...]]:
    """Put hydrostatics, then form parameters of two hulls side by side, in the order of tables.

    Examples
    --------
    >>> from assoc_hull.hull.sources import examples
    >>> from assoc_hull.variation.comparing.number_comparison import compare_numbers, numbers_of
    >>> numbers = numbers_of(examples.wigley(), None, None)
    >>> (volume, *_), _ = compare_numbers(numbers, numbers)
    >>> volume.symbol, volume.difference
    ('volume', 0.0)
    """
    records = tuple(
        NumberComparison(
            name, each.title, each.unit, each.digits,
            before := _field(parent, name), after := _field(variant, name),
            _why(before, after, parent.trouble, variant.trouble),
        )
        for name, each in FIELDS.items()
        if name not in _LOADED
    )  # fmt: skip
    entries = [entry for some in by_table(CATALOGUE.values()).values() for entry in some]
    parameters = []
    for entry in entries:
        old, new = (_parameter(side, entry.symbol, entry.unit) for side in (parent, variant))
        why = _why(old.number, new.number, old.reason, new.reason)
        parameters.append(
            NumberComparison(
                entry.symbol, entry.name, entry.unit, entry.digits, old.number, new.number, why
            )
        )
    return records, tuple(parameters)


def _field(side: Numbers, name: str) -> float | None:
    found: float | None = None if side.record is None else getattr(side.record, name)
    return found


def _parameter(side: Numbers, symbol: str, unit: str) -> FormValue:
    if side.trouble is not None:
        return FormValue(None, unit, symbol, reason=side.trouble)
    return side.parameters[symbol]


def _why(before: float | None, after: float | None, old: str | None, new: str | None) -> str | None:
    """Say why a number is missing, and in which hull."""
    if before is None and after is None:
        return old if old == new else f"parent: {old}; variant: {new}"
    if before is None:
        return f"parent: {old}"
    return f"variant: {new}" if after is None else None

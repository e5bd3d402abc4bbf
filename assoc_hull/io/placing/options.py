"""What a caller says of where things are: places in units of the file, or in metres.

Examples
--------
>>> from assoc_hull.io.placing.options import FileAxes, FrameOptions
>>> asked = FrameOptions(fp=100.0, base="-6 m", length=98.0).in_metres(FileAxes(factor=0.3048))
>>> round(asked.fp, 6), asked.base, asked.length
(30.48, -6.0, 98.0)
"""

from __future__ import annotations

import re
from typing import Any, ClassVar

import attrs
import numpy as np

from assoc_hull.arguments import choice, number, plain, shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.units import METRES, check_particular

__all__ = ["ORIGINS", "FileAxes", "FrameOptions", "Place", "same_place"]

Place = float | str
"""A coordinate: a number in units of the file, or a text such as "12.5 m"."""

ORIGINS = ("ap", "midship", "fp")
"""Where x = 0 of a file may be."""

_TEXT = re.compile(r"\s*([-+]?[0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?)\s*([a-z]*)\s*")
_WHERE = "as an argument"


@attrs.frozen(kw_only=True)
class FileAxes:
    """How coordinates of a file become those of the outline.

    Attributes
    ----------
    factor : float
        Metres at full scale in a unit of the file.
    x_sign, z_sign : float
        -1 where the axis was turned round.
    """

    factor: float = 1.0
    x_sign: float = 1.0
    z_sign: float = 1.0

    @classmethod
    def between(cls, factor: float, before: FloatArray, after: FloatArray) -> FileAxes:
        """Tell which axes were turned round as vertices (n, 3) came to another place."""
        signs = []
        for axis in (0, 2):
            off = _unit(after[:, axis])
            # The column that went there is like it but for a sign; others may vary along with it.
            sums = [float((off * _unit(column)).sum()) for column in before.T]
            signs.append(float(np.sign(max(sums, key=abs))) or 1.0)
        return cls(factor=factor, x_sign=signs[0], z_sign=signs[1])


def _unit(values: FloatArray) -> FloatArray:
    off = values - values.mean()
    return np.asarray(off / max(float(np.sqrt((off * off).sum())), 1e-300))


def _size(value: float | None) -> float | None:
    """Take a particular as a float; what is none is refused by its name later."""
    return None if value is None else plain(value)


@attrs.frozen(kw_only=True)
class FrameOptions:
    """Where things are, as the caller says it; None where it is to be found.

    Attributes
    ----------
    ap, fp : float or str or None
        x of the perpendiculars: in units of the file, or text with a unit.
    base, waterline : float or str or None
        Heights of the base line and of the design waterline, likewise.
    length, breadth, draught, depth : float or None, m
        Particulars, at full scale.
    draught_aft, draught_fwd : float or None, m
        Design draughts at the perpendiculars of a hull with a design trim.
    origin : {"ap", "midship", "fp"} or None
        Where x = 0 of the file is.
    """

    PLACES: ClassVar[tuple[str, ...]] = ("ap", "fp", "base", "waterline")
    SIZES: ClassVar[tuple[str, ...]] = (
        "length", "breadth", "draught", "depth", "draught_aft", "draught_fwd",
    )  # fmt: skip

    ap: Place | None = None
    fp: Place | None = None
    base: Place | None = None
    waterline: Place | None = None
    length: float | None = attrs.field(default=None, converter=_size)
    breadth: float | None = attrs.field(default=None, converter=_size)
    draught: float | None = attrs.field(default=None, converter=_size)
    depth: float | None = attrs.field(default=None, converter=_size)
    draught_aft: float | None = attrs.field(default=None, converter=_size)
    draught_fwd: float | None = attrs.field(default=None, converter=_size)
    origin: str | None = None

    def __attrs_post_init__(self) -> None:
        for name in self.SIZES:
            check_particular(name, getattr(self, name))
        for name in self.PLACES:
            if getattr(self, name) is not None:
                _place(getattr(self, name), name, 1.0)
        if self.origin is not None:
            choice(self.origin, "origin", ORIGINS, _WHERE)
        _refuse_pairs(self)

    def in_metres(self, axes: FileAxes) -> FrameOptions:
        """Give the same with all places in m, forward and upward positive."""
        signs = {"ap": axes.x_sign, "fp": axes.x_sign, "base": axes.z_sign}
        found: dict[str, Any] = {}
        for name in self.PLACES:
            value = getattr(self, name)
            if value is not None:
                sign = signs.get(name, axes.z_sign)
                found[name] = sign * _place(value, name, axes.factor) + 0.0
        return attrs.evolve(self, **found)

    def ends(self, factor: float) -> tuple[float | None, float | None]:
        """Give AP and FP in the file, m, as far as they are given; `factor` is m over its unit."""
        if self.origin is not None:
            return (
                0.0 if self.origin == ORIGINS[0] else None,
                0.0 if self.origin == ORIGINS[2] else None,
            )
        ap, fp = (
            None if value is None else _place(value, name, factor)
            for name, value in (("ap", self.ap), ("fp", self.fp))
        )
        return ap, fp

    @property
    def mean_draught(self) -> float | None:
        """The draught given, m, else the mean of both draughts of a design trim."""
        if self.draught is not None or self.draught_aft is None or self.draught_fwd is None:
            return self.draught
        return 0.5 * (self.draught_aft + self.draught_fwd)

    def metres(self, name: str) -> float | None:
        """Give a place after `in_metres`, or None."""
        value = getattr(self, name)
        return None if value is None else float(value)


def same_place(one: float, other: float, size: float) -> bool:
    """Tell whether two statements of one length or place agree within half a per cent of a size."""
    return abs(one - other) <= 5e-3 * abs(size)


def _refuse_pairs(options: FrameOptions) -> None:
    """Refuse options that say one thing twice, or half of a thing."""
    if options.origin is not None and (options.ap is not None or options.fp is not None):
        raise BadInputError(
            "origin was given with ap or fp", _WHERE, "give either: both say where x = 0 is"
        )
    both = (options.draught_aft, options.draught_fwd)
    if (both[0] is None) != (both[1] is None):
        missing = "draught_aft" if both[0] is None else "draught_fwd"
        what = f"{missing} is missing"
        raise BadInputError(what, _WHERE, "give both draughts of a design trim, or draught alone")
    if both[0] is not None and both[1] is not None and options.draught is not None:
        mean = 0.5 * (both[0] + both[1])
        if not same_place(mean, options.draught, mean):
            raise BadInputError(
                f"draught is {options.draught:g} m, the mean of draught_aft and draught_fwd "
                f"{mean:g} m", _WHERE, "leave draught out, or correct it",
            )  # fmt: skip


def _place(value: object, name: str, factor: float) -> float:
    """Read a coordinate: a number in units of the file, or a text with a unit; m."""
    if not isinstance(value, str):
        return number(value, name, _WHERE) * factor
    found = _TEXT.fullmatch(value)
    unit = found[2] if found else ""
    if not found or (unit and unit not in METRES):
        raise BadInputError(
            f"{name} is {shown(value)}", _WHERE,
            f"give a number in units of the file, or one with a unit ({', '.join(METRES)}), as "
            "'12.5 m'",
        )  # fmt: skip
    return number(float(found[1]), name, _WHERE) * (METRES[unit] if unit else factor)

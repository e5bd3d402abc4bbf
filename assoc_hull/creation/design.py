"""A design: the data of which a hull is created, and nothing else.

Examples
--------
>>> from assoc_hull.creation.form_definitions import course
>>> from assoc_hull.creation.design import Design
>>> from assoc_hull.model.state import Particulars
>>> Design(Particulars("ship", 100.0, 16.0, 9.0, 6.0), [course("keel_angle", {"AP": (0, 45)})])
Traceback (most recent call last):
...
assoc_hull.errors.BadInputError: it lacks sectional_area, in the design of 'ship'; define ...
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.arguments import all_of, instance, number, numbers, text
from assoc_hull.errors import BadInputError, NameTakenError, UnknownNameError
from assoc_hull.model.definition_part import FormDefinition
from assoc_hull.model.forms.closure import close_halves
from assoc_hull.model.state import Particulars
from assoc_hull.model.uses import USES
from assoc_hull.tolerance import Tolerances

__all__ = ["Design"]

_LEAST = 1e-6
"""Planes of one family closer than this (m) are one plane."""


def _definitions(given: object) -> tuple[FormDefinition, ...]:
    return tuple(all_of(given, FormDefinition, "definitions", "in a design"))


def _places(given: object) -> tuple[float, ...]:
    """Take positions of planes, in order."""
    found = np.atleast_1d(numbers(given, "a position of lines", "in a design"))
    return tuple(sorted(found.tolist()))


@attrs.frozen
class Design:
    """What a hull is created of.

    Attributes
    ----------
    particulars : Particulars
        Principal dimensions; sections below the draught have the areas of the curve of areas.
    definitions : tuple of FormDefinition
        Curves of form parameters, each of another use.
    stations : tuple of float
        Where sections stand, in twentieths of the length between perpendiculars: 0 at AP,
        20 at FP; below 0 abaft AP. They are named by these numbers.
    waterlines : tuple of float, m
        Heights.
    buttocks : tuple of float, m
        Half-breadths.
    transom : float or None, m
        x of a flat transom; None where the hull ends on its profile.
    tolerances : Tolerances
        Of the net.
    """

    particulars: Particulars
    definitions: tuple[FormDefinition, ...] = attrs.field(converter=_definitions)
    stations: tuple[float, ...] = attrs.field(default=(), converter=_places)
    waterlines: tuple[float, ...] = attrs.field(default=(), converter=_places)
    buttocks: tuple[float, ...] = attrs.field(default=(), converter=_places)
    transom: float | None = None
    tolerances: Tolerances = attrs.field(factory=Tolerances)

    def __attrs_post_init__(self) -> None:
        where = f"in the design of {_named(self.particulars)!r}"
        instance(self.tolerances, Tolerances, "tolerances", where)
        if self.transom is not None:
            number(self.transom, "transom", where)
        _check_uses(self.definitions, where)
        _check_apart("stations", self.station_places, where)
        _check_apart("waterlines", self.waterlines, where)
        _check_apart("buttocks", self.buttocks, where)

    @property
    def station_places(self) -> tuple[float, ...]:
        """Where sections stand, m from AP."""
        return tuple(each * self.particulars.length / 20.0 for each in self.stations)

    def definition(self, use: str) -> FormDefinition:
        """Give the definition of a use, or of that name.

        Raises
        ------
        UnknownNameError
            There is none.
        """
        for each in self.definitions:
            if use in (each.use, each.name):
                return each
        known = tuple(each.use for each in self.definitions)
        raise UnknownNameError("definition", text(use, "use", "in a design"), known)

    def having(self, *definitions: FormDefinition) -> Design:
        """Give the same design with other definitions in the place of those of their uses."""
        new = {each.use: each for each in _definitions(definitions)}
        kept = tuple(new.pop(each.use, each) for each in self.definitions)
        return attrs.evolve(self, definitions=(*kept, *new.values()))

    def closed(
        self,
        *,
        cb: float | None = None,
        cp: float | None = None,
        lcb: float | None = None,
        cw: float | None = None,
        lcf: float | None = None,
    ) -> Design:
        """Give the same design with curves of areas and waterline closed to these.

        Parameters
        ----------
        cb, cp, cw : float or None
            Block, prismatic and waterplane coefficient.
        lcb, lcf : float or None, m
            Centre of buoyancy and of flotation, from midship, forward positive.

        Raises
        ------
        OutOfRangeError
            No entrance closes the curve; the error tells the interval.
        """
        found, ship = self, self.particulars
        areas = {"cb": cb, "cp": cp, "lcb": lcb}
        if any(each is not None for each in areas.values()):
            found = found.having(close_halves(self.definition("sectional_area"), ship, **areas))
        line = {"cw": cw, "lcf": lcf}
        if any(each is not None for each in line.values()):
            found = found.having(close_halves(self.definition("design_waterline"), ship, **line))
        return found

    def to_json(self) -> str:
        """Give the design as JSON text, every number to its last bit; it ends with a newline."""
        from assoc_hull.creation.design_json import design_json

        return design_json(self)

    @classmethod
    def from_json(cls, source: str | os.PathLike[str]) -> Design:
        """Take a design from JSON text or from a file.

        Parameters
        ----------
        source : str or path
            Text that begins with ``{``, or the path of a file.

        Raises
        ------
        BadInputError
            It cannot be read, or does not hold a design; the place in it is told.
        OutOfRangeError
            A closure that it asks for has no entrance.
        """
        from assoc_hull.creation.design_json import read_design

        return read_design(source)


def _named(particulars: object) -> str:
    return instance(particulars, Particulars, "particulars", "in a design").name


def _check_uses(definitions: Sequence[FormDefinition], where: str) -> None:
    """Check that each use stands once, with its kind, and that none lacks."""
    seen: set[str] = set()
    for each in definitions:
        if each.use not in USES:
            raise UnknownNameError("use of a definition", each.use, tuple(USES))
        if each.use in seen:
            raise BadInputError(f"{each.use} is defined twice", where, "leave one out")
        if each.kind != USES[each.use].kind:
            what = f"{each.use} is a definition of kind {each.kind!r}"
            raise BadInputError(what, where, f"give one of kind {USES[each.use].kind!r}")
        seen.add(each.use)
    names = [each.name for each in definitions]
    for name in names:
        if names.count(name) > 1:
            raise NameTakenError("definition", name)
    for use, known in USES.items():
        if known.needed and use not in seen:
            raise BadInputError(f"it lacks {use}", where, f"define the {known.what}")


def _check_apart(title: str, places: Iterable[float], where: str) -> None:
    """Check that no two planes of a family are one."""
    ordered = list(places)
    for one, other in pairwise(ordered):
        if other - one < _LEAST:
            raise BadInputError(f"two of the {title} stand at {one:g} m", where, "leave one out")

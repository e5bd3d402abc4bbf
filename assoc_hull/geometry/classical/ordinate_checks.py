"""What is refused of a section of ordinates, and what is only remarked."""

from __future__ import annotations

import math

import attrs
import numpy as np

from assoc_hull.arguments import shown, shown_name
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite
from assoc_hull.geometry.classical.paired_parabolas import PairedParabolas
from assoc_hull.geometry.curves import FloatArray

__all__ = ["FORMS", "Sizes", "check_section", "notes_of_section", "read_sizes"]

FORMS = ("bottom+main+camber", "main+camber", "bottom+camber")
"""The general form; without a part on buttocks; without a main part."""

_LEAST_BUTTOCKS, _LEAST_WATERLINES = 4, 3

_MOST = 10_000
"""More ordinates than this are a mistake."""

_STEP = 0.15
"""The last buttock may end below the first waterline by this part of its height, unremarked."""

_DECK = 1e-3
"""The half-breadth of the deck may differ from that of the side by this part, unremarked."""


@attrs.frozen
class Sizes:
    """Six of the eight values, m; the other two are counts."""

    hb: float
    sb: float
    sw: float
    hd: float
    bd: float
    cam: float


def read_sizes(*values: float) -> Sizes:
    """Take hb, sb, sw, hd, bd, cam (m): finite, spacings above 0, no negative breadth.

    Raises
    ------
    GeometryError
        A value that is none of these.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.ordinate_checks import read_sizes
    >>> read_sizes(0.9, 3, 2, 12.4, 15.2, 0.4).hd
    12.4
    """
    names = attrs.fields_dict(Sizes)
    found = Sizes(
        *(float(finite(each, f"section {n}", ())) for n, each in zip(names, values, strict=True))
    )
    for name, told in (("sb", "buttock spacing"), ("sw", "waterline spacing")):
        value = getattr(found, name)
        if value <= 0.0:
            _refuse(f"section: {told} {figure(value)} is not above 0", "give one above 0", sb=value)
    if found.bd < 0.0:
        what = f"section: negative deck half-breadth {figure(found.bd)}"
        _refuse(what, "give it to port", bd=found.bd)
    return found


def check_section(
    sizes: Sizes, zb: FloatArray, yw: FloatArray, counts: tuple[object, object], form: str | None
) -> str:
    """Refuse what makes no section, and give its form.

    Parameters
    ----------
    sizes : Sizes
        As read.
    zb, yw : (nb + 1,), (nw,), m
        Heights and half-breadths.
    counts : (int, int)
        nb and nw.
    form : str or None
        One of `FORMS`, or to be told by the counts.

    Raises
    ------
    GeometryError
        What is wrong.
    """
    nb, nw = _counts(zb, yw, *counts)
    shape = _form(sizes, nb) if form is None else shown_name(form)
    if shape not in FORMS:
        what = f"section: no form {shown(form)}"
        raise GeometryError(what, f"use one of {', '.join(FORMS)}", {"form": form})
    if shape == FORMS[0] and nb < _LEAST_BUTTOCKS:
        what = f"section: bottom part needs at least {_LEAST_BUTTOCKS} buttocks, got {nb}"
        _refuse(what, "give more, or the form main+camber", nb=nb)
    if shape != FORMS[0] and nb:
        what = f"section: {nb} buttocks in the form {shape}"
        _refuse(what, "give half-breadths from the keel up", nb=nb)
    if nw < _LEAST_WATERLINES:
        what = f"section: main part needs at least {_LEAST_WATERLINES} waterlines, got {nw}"
        _refuse(what, "give more", nw=nw)
    _heights(sizes, zb, nw, shape)
    below = np.flatnonzero(yw < 0.0)
    if len(below):
        what = f"section: negative half-breadth at waterline {below[0]}"
        _refuse(what, "give 0 at the centre line", waterline=int(below[0]))
    return shape


def _form(sizes: Sizes, nb: int) -> str:
    """Tell the form of a section by what is given of it."""
    if nb:
        return FORMS[0]
    return FORMS[1] if sizes.hb < sizes.hd else FORMS[2]


def _counts(zb: FloatArray, yw: FloatArray, nb: object, nw: object) -> tuple[int, int]:
    buttocks, waterlines = _whole(nb, "buttocks"), _whole(nw, "waterlines")
    if buttocks or len(zb):
        finite(zb, "section heights", (buttocks + 1,))
    finite(yw, "section half-breadths", (waterlines,))
    return buttocks, waterlines


def _whole(value: object, name: str) -> int:
    if (
        isinstance(value, bool)
        or not isinstance(value, int | np.integer)
        or not 0 <= value <= _MOST
    ):
        what = f"section: {shown(value)} {name}"
        raise GeometryError(what, f"give a whole number from 0 to {_MOST}", {name: value})
    return int(value)


def _heights(sizes: Sizes, zb: FloatArray, nw: int, form: str) -> None:
    """Refuse parts that do not follow upon one another from below."""
    foot = sizes.hb
    if form == FORMS[2]:
        if sizes.hb < sizes.hd:
            _refuse(
                f"section: without main part the bottom appendage height {figure(sizes.hb)} must "
                f"exceed the deck side height {figure(sizes.hd)}",
                "raise it, or give a main part", hb=sizes.hb, hd=sizes.hd,
            )  # fmt: skip
        foot = float(zb[0]) if len(zb) else math.nan
        if math.isnan(foot):
            _refuse("section: without main part the height of the keel is missing", "give zb")
    if sizes.hd <= foot:
        what = f"section: deck side {figure(sizes.hd)} is not above {figure(foot)}"
        _refuse(what, "raise it, or lower the first waterline", hd=sizes.hd, foot=foot)
    top = foot + (nw - 1) * sizes.sw
    if top <= sizes.hd:
        _refuse(
            f"section: last waterline z={figure(top)} must be above the deck side "
            f"{figure(sizes.hd)}", "add a waterline", z=top, hd=sizes.hd,
        )  # fmt: skip
    if form == FORMS[0] and zb[-1] > sizes.hb:
        what = f"section: last buttock height {figure(zb[-1])} above hb {figure(sizes.hb)}"
        _refuse(what, "lower it, or raise hb", z=float(zb[-1]), hb=sizes.hb)
    if form == FORMS[1] and len(zb) and zb[0] != sizes.hb:
        what = f"section: keel at {figure(zb[0])}, but the main part begins at {figure(sizes.hb)}"
        _refuse(what, "let both be the same", z=float(zb[0]), hb=sizes.hb)


def notes_of_section(
    sizes: Sizes, bottom: PairedParabolas | None, side: PairedParabolas
) -> tuple[str, ...]:
    """Say what is unusual about a section, a sentence each.

    Parameters
    ----------
    sizes : Sizes
        Its values.
    bottom : PairedParabolas or None
        Height over y.
    side : PairedParabolas
        Half-breadth over z.
    """
    found = [] if bottom is None else _of_bottom(sizes, bottom)
    if bottom is not None and side.values[0] < bottom.last - 1e-9 * sizes.sb:
        found.append(
            f"section: the first waterline ends at y={figure(side.values[0])}, inside the last "
            f"buttock at {figure(bottom.last)}"
        )
    if sizes.cam < 0.0:
        found.append(f"section: camber {figure(sizes.cam)} is negative: the deck falls inboard")
    wide = float(side.at(sizes.hd))
    if abs(wide - sizes.bd) > _DECK * sizes.bd:
        found.append(
            f"section: y(hd)={figure(wide)} at the deck side differs from bd={figure(sizes.bd)} "
            f"by more than {_DECK:g} bd"
        )
    return tuple(found)


def _of_bottom(sizes: Sizes, bottom: PairedParabolas) -> list[str]:
    found = []
    last = float(bottom.values[-1])
    if abs(last - sizes.hb) > _STEP * abs(sizes.hb):
        found.append(
            f"section: last buttock height {figure(last)} differs from hb {figure(sizes.hb)} by "
            f"more than {_STEP:g} hb"
        )
    falls = np.flatnonzero(np.diff(bottom.values) < 0.0)
    if len(falls):
        found.append(f"section: buttock heights decrease at buttock {falls[0] + 1}")
    return found


def _refuse(what: str, remedy: str, **values: object) -> None:
    raise GeometryError(what, remedy, values)

"""Regions and fields of Choi & Lee (1999), figure 1: where ratios act and where they fade.

With `blend="paper"` and one of their names in a layout the fields of the after body have all of
these heights as boundary curves, and end where the lengths say; what is not named is read off the
hull. Ratios are 1 outside, and go over into each other by cubics that are level at both ends. The
figure shows an after body; `Hbulb` and `EX0` to `EX3` are the same scheme for the fore body [own].

The fields of shaft and bossing as Choi & Lee (1999) lay them out: ratios of coordinates.

No tube, no pivot at the bossing's centre: a small radius that is to grow has a large ratio, and all
that lies beside the bossing grows with it, as the paper says of itself.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.parameters.field_layout import HEIGHTS, LENGTHS, Layout
from assoc_hull.variation.parameters.parent import Parent

__all__ = ["PaperRegions", "bossing_ratios", "regions_of", "shaft_ratios"]

Anchor = tuple[str, float, float]
"""Name, height and change, m."""

_PLACES = {"Hbilge": "bilge high", "Hshaft": "boss", "Htransom": "transom", "Hbulb": "bulb tip"}
"""Where heights are read off a hull."""

_RISING = (
    ("Hbase", "Hbilge"), ("Hbilge", "Hshaft"), ("Hbase", "Hshaft"), ("Hshaft", "Htransom"),
    ("Hshaft", "Hdraft"), ("Hbase", "Hdraft"), ("Htransom", "Hmax"), ("Hdraft", "Hmax"),
    ("Hbase", "Hbulb"), ("Hbulb", "Hdraft"),
    ("BX0", "BX1"), ("BX0", "BX2"), ("BX1", "BX3"), ("BX2", "BX3"), ("BX3", "EX3"),
    ("EX3", "EX2"), ("EX3", "EX1"), ("EX2", "EX0"), ("EX1", "EX0"),
)  # fmt: skip
"""Pairs of which the first lies below, or aft of, the second."""

_MAY_MEET = {("BX3", "EX3"), ("BX1", "BX3"), ("BX0", "BX2"), ("EX3", "EX1"), ("EX2", "EX0")}


@attrs.frozen
class PaperRegions:
    """Heights above the base line and places from AP, m, by their names.

    Attributes
    ----------
    heights, lengths : mapping of str to float, m
        Those that are given and those that were read off the hull; a height that a hull has not,
        as that of the shaft, is left out.
    given : frozenset of str
        Which of them are given.
    layout : Layout
        The blend.
    """

    heights: Mapping[str, float]
    lengths: Mapping[str, float]
    given: frozenset[str]
    layout: Layout

    def __str__(self) -> str:
        every = {**self.heights, **self.lengths}
        given, read = (
            ", ".join(f"{name} {every[name]:.6g}" for name in every if (name in self.given) is own)
            for own in (True, False)
        )
        return f"regions of the paper, m: {given}; read off the hull: {read}"

    def at_rest(self, anchors: Sequence[Anchor], *names: str) -> list[Anchor]:
        """Add boundaries that stay to anchors (name, height, change), m; gives all from below.

        Raises
        ------
        BadInputError
            A given height lies among the anchors, which move as one.
        """
        low, high = anchors[0][1], anchors[-1][1]
        rest = list[Anchor]()
        for name in names:
            z = self.heights.get(name)
            if z is None:
                continue
            if not low <= z <= high:
                rest.append((name, z, 0.0))
            elif name in self.given:
                raise BadInputError(
                    f"{name} of {z:.6g} m lies within what moves, {low:.6g} to {high:.6g} m",
                    "in vary", "give a height beyond it",
                )  # fmt: skip
        return sorted([*rest, *anchors], key=lambda each: each[1])

    def below(self, z: float) -> float:
        """Give the next height below one, m; of base, bilge and shaft."""
        every = [self.heights[name] for name in ("Hbase", "Hbilge", "Hshaft")
                 if name in self.heights]  # fmt: skip
        return max((each for each in every if each < z), default=self.heights["Hbase"])

    def above(self, z: float) -> float:
        """Give the next height above one, m; of transom, draught and top."""
        every = [self.heights[name] for name in ("Htransom", "Hdraft", "Hmax")
                 if name in self.heights]  # fmt: skip
        return min((each for each in every if each > z), default=self.heights["Hmax"])

    def aft(self, x: float) -> BlendChain:
        """Give 1 up to BX0, or to x (m) if that is farther forward, and 0 from BX1 on."""
        return self._chain([max(x, self.lengths["BX0"]), self.lengths["BX1"]], [1.0, 0.0], "BX1")

    def fore(self) -> BlendChain:
        """Give 0 up to EX1, and 1 from EX0 on."""
        return self._chain([self.lengths["EX1"], self.lengths["EX0"]], [0.0, 1.0], "EX1")

    def middle(self) -> BlendChain:
        """Give 0 up to BX2, 1 from BX3 to EX3, and 0 from EX2 on."""
        nodes = [self.lengths[name] for name in ("BX2", "BX3", "EX3", "EX2")]
        values = [0.0, 1.0, 1.0, 0.0]
        if nodes[1] == nodes[2]:
            del nodes[2], values[2]
        return self._chain(nodes, values, "BX3")

    def _chain(self, nodes: list[float], values: list[float], name: str) -> BlendChain:
        if not all(one < other for one, other in pairwise(nodes)):
            raise BadInputError(
                f"{name} of {self.lengths[name]:.6g} m leaves no length to fade over: the change "
                f"is full up to {nodes[0]:.6g} m", "in vary", "give a place farther away",
            )  # fmt: skip
        return BlendChain.through(nodes, values, self.layout.curve, name)


def regions_of(parent: Parent, layout: Layout) -> PaperRegions | None:
    """Give the regions of a layout, the rest read off the parent; None where none is named.

    Raises
    ------
    BadInputError
        Heights or lengths that are not in order.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.parameters.field_layout import Layout
    >>> from assoc_hull.variation.parameters.paper_regions import regions_of
    >>> from assoc_hull.variation.parameters.parent import Parent
    >>> places = {"boss": np.array([6.0, 0.0, 5.0]), "body start": np.array([115.0, 0.0, 0.0])}
    >>> ship = Parent(300, 50, 27, 18, 27, places)
    >>> found = regions_of(ship, Layout.of({"blend": "paper", "BX1": 60.0}))
    >>> found.heights["Hshaft"], found.lengths["BX1"], found.lengths["BX3"]
    (5.0, 60.0, 115.0)
    """
    given = {
        name: float(getattr(layout, name)) for name in (*HEIGHTS, *LENGTHS)
        if getattr(layout, name) is not None
    }  # fmt: skip
    if not given:
        return None
    every = _of_hull(parent, layout) | given
    found = PaperRegions(
        {name: every[name] for name in HEIGHTS if name in every},
        {name: every[name] for name in LENGTHS}, frozenset(given), layout,
    )  # fmt: skip
    for low, high in _RISING:
        _refuse_order(every, given, low, high)
    return found


def _of_hull(parent: Parent, layout: Layout) -> dict[str, float]:
    """Read all heights and lengths off a hull, m; reaches are the usual ones."""
    length = parent.length
    found = {"Hbase": 0.0, "Hdraft": parent.draught, "Hmax": parent.top}
    found |= {
        name: float(parent.places[place][2]) for name, place in _PLACES.items() if parent.has(place)
    }
    aft = float(parent.places["transom"][0]) if parent.has("transom") else 0.0
    body = ("body start", "body end") if parent.has("body start") else (
        "largest aft", "largest fore"
    )  # fmt: skip
    start, end = (
        float(parent.places[each][0]) if parent.has(each) else 0.5 * length for each in body
    )
    return found | {
        "BX0": aft, "BX1": min(aft + layout.stern * length, start),
        "BX2": max(start - layout.bilge_length * length, aft), "BX3": start,
        "EX0": length, "EX1": max(layout.bow_from * length, end),
        "EX2": min(end + layout.bilge_length * length, length), "EX3": end,
    }  # fmt: skip


def _refuse_order(
    every: Mapping[str, float], given: Mapping[str, float], low: str, high: str
) -> None:
    """Refuse two regions in the wrong order; what a hull has by itself is as it is."""
    if low not in every or high not in every or not {low, high} & given.keys():
        return
    one, other = every[low], every[high]
    if one < other or (one == other and (low, high) in _MAY_MEET):
        return
    below, above = ("below", "above") if low.startswith("H") else ("aft of", "forward of")
    whence = [f" ({name} as read off the hull)" for name in (low, high) if name not in given]
    remedy = f"{low} {below} {other:.6g} m" if low in given else f"{high} {above} {one:.6g} m"
    raise BadInputError(
        f"{low} of {one:.6g} m is not {below} {high} of {other:.6g} m{''.join(whence)}", "in vary",
        f"give {remedy}",
    )  # fmt: skip


_ALL = ("Hbase", "Hbilge", "Htransom", "Hdraft", "Hmax")
"""Heights at which ratios of shaft and bossing are 1."""


def shaft_ratios(parent: Parent, change: float, layout: Layout, fade: BlendChain) -> StackedField:
    """Give the field that raises the shaft: full over the bossing's end, nothing at base and T.

    Parameters
    ----------
    parent : Parent
    change : float, m
    layout : Layout
        With regions their heights are at rest, and their lengths end the field.
    fade : BlendChain
        How it fades along the ship without regions.
    """
    regions = regions_of(parent, layout)
    boss = parent.at("boss", "shaft_height")
    h, r = float(boss[2]), 0.0
    if parent.has("boss top"):
        r = float(parent.places["boss top"][2]) - h
    if regions is not None:
        h = _centre(regions, h, r)
    anchors = [("shaft", h, change)]
    if r:
        anchors = [("shaft-r", h - r, change), *anchors, ("shaft+r", h + r, change)]
    if regions is None:
        anchors = [("base", 0.0, 0.0), *anchors, ("T", parent.draught, 0.0)]
        return layout.over("shaft_height", anchors, fade)
    return layout.over(
        "shaft_height", regions.at_rest(anchors, *_ALL), regions.aft(float(fade.x[0]))
    )


def bossing_ratios(
    parent: Parent, asked: float, layout: Layout, fade: BlendChain
) -> tuple[StackedField, StackedField]:
    """Give the fields that widen the bossing and make it higher; the rest as `shaft_ratios`."""
    name = "bossing_radius"
    side, boss, top = (parent.at(key, name) for key in ("boss side", "boss", "boss top"))
    h, y = float(boss[2]), float(side[1])
    r = float(top[2]) - h
    anchors = [
        ("shaft-r", h - r, r - asked), ("shaft", h, 0.0), ("shaft+r", h + r, asked - r),
    ]  # fmt: skip
    low, middle, high = h - 3.0 * r, h, h + 3.0 * r
    regions = regions_of(parent, layout)
    if regions is None:
        anchors = [("base", 0.0, 0.0), *anchors, ("T", parent.draught, 0.0)]
    else:
        fade, anchors = regions.aft(float(fade.x[0])), regions.at_rest(anchors, *_ALL)
        middle = _centre(regions, h, r)
        low, high = regions.below(h - r), regions.above(h + r)
    walls = level_boundaries(["below", "shaft", "above"], [low, middle, high])
    none, broad = AffinePiece.along(fade, 0.0, 0.0), AffinePiece.along(fade, asked / y - 1.0, 0.0)
    out = StackedField(name, "y", walls, (none, broad, none), layout.curve)
    return out, layout.over(name, anchors, fade)


def _centre(regions: PaperRegions, h: float, r: float) -> float:
    """Give where ratios of the shaft are full, which is within its bossing, m."""
    found = regions.heights["Hshaft"]
    if r and abs(found - h) > r:
        raise BadInputError(
            f"Hshaft of {found:.6g} m lies beyond the bossing, {h - r:.6g} to {h + r:.6g} m",
            "in vary", "give a height within it, or leave Hshaft out",
        )  # fmt: skip
    return found

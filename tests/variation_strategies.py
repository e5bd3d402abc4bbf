"""Random chains, fields, layers and maps of a hull of 240 m, for all suites.

Amplitudes are such that a map of strength 1 does not fold; `strength` scales them.
"""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.bounded_functions import (
    CUBIC,
    QUINTIC,
    Blend,
    BlendChain,
    BoundedFunction,
    Contour,
)
from assoc_hull.variation.fields.field import AffinePiece, Axis, Boundary, StackedField, Tube
from assoc_hull.variation.fields.layers import CornerLayer, DeadriseLayer, FieldLayer, Layer, Rake
from assoc_hull.variation.fields.shift_shapes import Bump, BumpShape
from assoc_hull.variation.fields.space_map import VariationMap

__all__ = [
    "BEAM",
    "DEPTH",
    "LENGTH",
    "blends",
    "bumps",
    "chains",
    "contours",
    "corner_layers",
    "courses",
    "deadrise_layers",
    "field_layers",
    "fields",
    "hats",
    "layers",
    "maps",
    "places",
    "rakes",
]

LENGTH, BEAM, DEPTH = 240.0, 40.0, 20.0

_SHAPES: tuple[BumpShape, ...] = ("c1", "c2", "end", "half", "lackenby")

blends: SearchStrategy[Blend] = st.sampled_from([CUBIC, QUINTIC])


def _nodes(draw: DrawFn, most: int) -> FloatArray:
    """Nodes at least 20 m apart, from aft of the AP on."""
    count = draw(st.integers(2, most))
    steps = draw(st.lists(st.floats(20.0, 60.0), min_size=count - 1, max_size=count - 1))
    return draw(st.floats(-10.0, 100.0)) + np.concatenate([[0.0], np.cumsum(steps)])


@st.composite
def chains(draw: DrawFn, low: float = 0.0, high: float = 1.0, most: int = 4) -> BlendChain:
    """Chains of values between two numbers; some of one node, many that fade to `low`."""
    if draw(st.integers(0, 5)) == 0:
        return BlendChain.constant(draw(st.floats(low, high)))
    nodes = _nodes(draw, most)
    value = st.one_of(st.just(low), st.floats(low, high))
    values = draw(st.lists(value, min_size=len(nodes), max_size=len(nodes)))
    return BlendChain.through(nodes, values, draw(blends))


@st.composite
def contours(draw: DrawFn, low: float = 0.0, high: float = 1.0, most: int = 5) -> Contour:
    """Splines through values between two numbers; between nodes they may leave the range."""
    nodes = _nodes(draw, most)
    values = draw(st.lists(st.floats(low, high), min_size=len(nodes), max_size=len(nodes)))
    return Contour(nodes, np.array(values))


@st.composite
def bumps(draw: DrawFn, size: float = 1.0) -> Bump:
    """Bumps of every shape, either way round."""
    begin, end = _nodes(draw, 2).tolist()
    if draw(st.booleans()):
        begin, end = end, begin
    return Bump(begin, end, draw(st.floats(-size, size)), draw(st.sampled_from(_SHAPES)))


def courses() -> SearchStrategy[BoundedFunction]:
    """Functions along the ship of every kind."""
    return st.one_of(chains(-1.0, 1.0), contours(-1.0, 1.0), bumps())


@st.composite
def _stacks(draw: DrawFn) -> tuple[tuple[Boundary, ...], float]:
    """Boundary curves, level or sloping, and the least gap between two neighbours."""
    gaps = draw(st.lists(st.floats(2.0, 8.0), min_size=0, max_size=3))
    heights = draw(st.floats(-2.0, 8.0)) + np.concatenate([[0.0], np.cumsum(gaps)])
    gap = min(gaps, default=8.0)
    slope = st.one_of(st.just(0.0), st.floats(-0.15 * gap, 0.15 * gap))
    curves = []
    for k, height in enumerate(heights.tolist()):
        tilt = draw(slope)
        x = sorted(draw(st.tuples(st.floats(0.0, 100.0), st.floats(130.0, 240.0))))
        course = BlendChain.through(x, [height, height + tilt], draw(blends))
        curves.append(Boundary(f"h{k}", course if tilt else BlendChain.constant(height)))
    return tuple(curves), 0.7 * gap


@st.composite
def fields(draw: DrawFn, axis: Axis | None = None, strength: float = 1.0) -> StackedField:
    """Fields with one to four boundaries; about as strong as certified ones are."""
    moved: Axis = draw(st.sampled_from(["x", "y", "z"])) if axis is None else axis
    boundaries, gap = draw(_stacks())
    ratio = {"x": 0.004, "y": 0.15, "z": 0.08}[moved] * strength
    shift = {"x": 0.4, "y": 0.0, "z": 0.07 * gap}[moved] * strength
    pieces = []
    for each in boundaries:
        pivot = {
            "x": draw(st.floats(0.0, LENGTH)),
            "y": 0.0,
            "z": float(each.height.at(np.zeros(1))[0]),
        }
        pieces.append(
            AffinePiece(draw(chains(-ratio, ratio)), pivot[moved], draw(chains(-shift, shift)))
        )
    if draw(st.booleans()):
        pieces[0] = AffinePiece(BlendChain.constant(0.0), 0.0, BlendChain.constant(0.0))
    tube = Tube(draw(st.floats(0.5, 3.0)), 6.0, draw(blends)) if moved == "y" else None
    tube = draw(st.sampled_from([None, tube]))
    return StackedField("drawn", moved, boundaries, tuple(pieces), draw(blends), tube)


@st.composite
def hats(draw: DrawFn, strength: float = 1.0) -> StackedField:
    """Rounded hats of z over three to five anchors."""
    gaps = draw(st.lists(st.floats(3.0, 8.0), min_size=2, max_size=4))
    z = draw(st.floats(-1.0, 3.0)) + np.concatenate([[0.0], np.cumsum(gaps)])
    most = 0.2 * min(gaps) * strength
    inner = draw(st.lists(st.floats(-most, most), min_size=len(z) - 2, max_size=len(z) - 2))
    anchors = [
        (f"a{k}", *pair) for k, pair in enumerate(zip(z.tolist(), [0.0, *inner, 0.0], strict=True))
    ]
    return hat_field("hat", anchors, draw(chains()), blend=draw(blends))


@st.composite
def rakes(draw: DrawFn, strength: float = 1.0) -> Rake:
    """Rakes of a stem, or of a stern."""
    q = draw(st.floats(-0.1, 0.1)) * strength
    return Rake("rake", draw(chains()), q, draw(st.floats(8.0, 14.0)), draw(st.floats(2.0, 6.0)),
                draw(blends))  # fmt: skip


@st.composite
def field_layers(draw: DrawFn, strength: float = 1.0) -> FieldLayer:
    """One to three fields that add, the weaker the more there are."""
    count = draw(st.integers(1, 3))
    part = strength / count
    one = st.one_of(fields(strength=part), hats(part), rakes(part))
    return FieldLayer("fields", tuple(draw(one) for _ in range(count)))


@st.composite
def corner_layers(draw: DrawFn, strength: float = 1.0) -> CornerLayer:
    """Bilges that become larger or smaller, with and without rise of floor."""
    radius = draw(st.floats(1.0, 3.0))
    fade = BlendChain.through([radius, 5.0 * radius], [1.0, 0.0], draw(blends))
    ratio = st.floats(1.0 - 0.2 * strength, 1.0 + 0.2 * strength)
    rise = draw(st.sampled_from([0.0, 0.03]))
    return CornerLayer("corner", draw(chains()), 0.5 * BEAM, draw(st.floats(0.0, 1.0)), rise,
                       draw(ratio), draw(ratio), fade)  # fmt: skip


@st.composite
def deadrise_layers(draw: DrawFn, strength: float = 1.0) -> DeadriseLayer:
    """Bottoms that rise outward from the keel, ramped or not."""
    q = draw(st.floats(-0.03, 0.03)) * strength
    fade = BlendChain.through([4.0, 14.0], [1.0, 0.0], draw(blends))
    width = draw(st.sampled_from([0.0, 2.0]))
    return DeadriseLayer("deadrise", draw(chains()), q, draw(st.floats(0.0, 2.0)), width, fade,
                         draw(blends))  # fmt: skip


def layers(strength: float = 1.0) -> SearchStrategy[Layer]:
    """Layers of every kind."""
    return st.one_of(field_layers(strength), corner_layers(strength), deadrise_layers(strength))


@st.composite
def maps(draw: DrawFn, strength: float = 1.0, most: int = 3) -> VariationMap:
    """Up to `most` layers, one after the other."""
    return VariationMap(tuple(draw(st.lists(layers(strength), min_size=1, max_size=most))))


@st.composite
def places(draw: DrawFn, count: int = 60) -> FloatArray:
    """Places in and around the hull, starboard too."""
    spread = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    low = [-8.0, -0.5 * BEAM, -2.0]
    return spread.uniform(low, [LENGTH + 8.0, 0.5 * BEAM, DEPTH], (count, 3))

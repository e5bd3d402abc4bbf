"""A parent that all tests of layouts share."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.parameters.measurement import SectionFrames
from assoc_hull.variation.parameters.parent import Parent


def at(x: float, y: float, z: float) -> FloatArray:
    """A place."""
    return np.array([x, y, z], np.float64)


@pytest.fixture
def ship() -> Parent:
    """A bulk carrier as a layout sees it."""
    places = {
        "boss": at(6, 0, 5), "boss top": at(6, 0, 5.725), "boss side": at(6, 0.725, 5),
        "transom": at(-5, 0, 18.4), "transom side": at(-5, 20, 27), "bulb tip": at(306.4, 0, 7),
        "bulb top": at(306.4, 0, 13), "bulb side": at(300, 6, 7), "bilge low": at(150, 22.6, 0),
        "bilge high": at(150, 25, 2.4), "corner": at(150, 25, 0), "keel side": at(150, 0, 0),
        "bottom": at(150, 11.3, 0), "bottom edge": at(150, 22.6, 0), "flat edge": at(150, 22.6, 0),
        "body start": at(115, 0, 0), "body end": at(205.5, 0, 0), "stem": at(300, 0, 18),
        "stem top": at(303, 0, 27), "deck": at(150, 25, 27), "deck fore": at(300, 10, 27),
        "deck aft": at(0, 20, 27), "aft terminal": at(14, 0, 0), "fore terminal": at(289, 0, 0),
        "entrance": at(285, side(285, 18), 18), "waterline fore": at(300, 0, 18),
        "run": at(15, side(15, 18), 18), "waterline aft": at(0, side(0, 18), 18),
    }  # fmt: skip
    return Parent(300, 50, 27, 18, 27, places, {}, frames, waterline, bulb)


def side(x: float, z: float) -> float:
    """Half-breadth of a simple hull with a parallel body, m."""
    aft, fore = max(0.0, 115.0 - x) / 115.0, max(0.0, x - 205.5) / 94.5
    part = (1.0 - 0.7 * aft**2) * (1.0 - fore**2)
    return float(25.0 * part * (0.7 + 0.3 * (z / 18.0) ** (1.0 + aft + fore)))


def frames() -> SectionFrames:
    """Its sections up to the draught."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    x, z = np.linspace(0.0, 295.0, 60), 9.0 + 9.0 * nodes
    xyz = np.array([[a, side(a, b), b] for a in x.tolist() for b in z.tolist()])
    return SectionFrames(x, 12 * np.arange(61), xyz, np.tile(9.0 * weights, 60))


def bulb() -> SectionFrames:
    """The section of its bulb at FP: half an ellipse, 14 m high and 6 m from the centre plane."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    xyz = np.column_stack([np.full(24, 300.0), 6.0 * np.sqrt(1.0 - nodes**2), 7.0 + 7.0 * nodes])
    return SectionFrames(np.array([300.0]), np.array([0, 24]), xyz, 7.0 * weights)


def waterline() -> FloatArray:
    """Its design waterline."""
    return np.array([[a, side(a, 18.0), 18.0] for a in np.linspace(0.0, 300.0, 400).tolist()])

"""Transverse sections where they stand, cut off at a deck."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import attrs
import numpy as np
from scipy.optimize import brentq

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_curve import ArcCurve
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.classical.deck_surface import Deck
from assoc_hull.geometry.curves import FloatArray

__all__ = ["AT", "Station", "deck_edge_at", "sorted_stations", "trimmed", "upper_deck"]

AT = 1e-3
"""Places nearer than this (m) are taken for one: a section that ends so near a deck reaches it."""

_SAMPLES = 33
"""Of each piece of a section, where its meeting with a deck is looked for."""


@attrs.frozen(eq=False)
class Station:
    """A transverse section.

    Attributes
    ----------
    x : float, m
        Where it stands.
    curve : ArcCurve
        (y, z) from the keel upward, to the deck or beyond.
    """

    x: float
    curve: ArcCurve

    @property
    def keel(self) -> float:
        """Height of its lowest given point, m: where it begins."""
        return float(self.curve.arcs.start[0, 1])


def sorted_stations(stations: Sequence[Station]) -> tuple[Station, ...]:
    """Give stations from aft forward, each checked to begin on the centre line.

    Raises
    ------
    GeometryError
        Two sections at one place, or one that begins elsewhere.
    """
    found = sorted(stations, key=lambda each: each.x)
    for one, two in itertools.pairwise(found):
        if two.x - one.x <= AT:
            what = f"two sections at x={figure(two.x)}"
            raise GeometryError(what, "leave one of them out", {"x": two.x})
    for each in found:
        y = float(each.curve.arcs.start[0, 0])
        if abs(y) > AT:
            what = f"section at x={figure(each.x)}: begins at y={figure(y)}"
            raise GeometryError(what, "begin on the centre line", {"x": each.x, "y": y})
    return tuple(found)


def upper_deck(decks: Sequence[Deck]) -> Deck | None:
    """Give the highest of decks that do not meet, None if there is none."""
    least = max((each.sheer.range[0] for each in decks), default=0.0)
    return max(decks, key=lambda each: float(each.centre(least)), default=None)


def deck_edge_at(station: Station, deck: Deck) -> tuple[int, float]:
    """Find where a section meets a deck, the first time on its way up.

    Parameters
    ----------
    station : Station
        The section.
    deck : Deck
        The deck; x in the same datum.

    Returns
    -------
    int, float
        Number of the piece of the section, and the arc length (m) from its start.

    Raises
    ------
    GeometryError
        A section that ends below the deck, or begins above it; ``"deck {n}: sheer does not
        cover x={x}"``; ``"camber: y={y} beyond reference half-breadth {B}"``.
    """
    arcs, centre = station.curve.arcs, float(deck.centre(station.x))
    camber = deck.camber

    def above(points: FloatArray) -> FloatArray:
        y = np.abs(points[:, 0])
        if camber.scale == "local":
            return np.asarray(points[:, 1] - centre + camber.total)
        return np.asarray(points[:, 1] - centre + camber.drop(np.minimum(y, camber.half_breadth)))

    piece = np.repeat(np.arange(len(arcs)), _SAMPLES)
    along = (arcs.length[:, None] * np.linspace(0.0, 1.0, _SAMPLES)).ravel()
    over = above(arcs.at(piece, along))
    if over[0] >= 0.0 or over.max() < -AT:
        side = "begins above" if over[0] >= 0.0 else "does not reach"
        raise GeometryError(
            f"section at x={figure(station.x)}: {side} deck {deck.number}",
            f"the deck lies at z={figure(centre)} on the centre line",
            {"x": station.x, "deck": deck.number},
        )  # fmt: skip
    if over.max() < 0.0:
        number, t = len(arcs) - 1, float(arcs.length[-1])
    else:
        k = int(np.argmax(over >= 0.0))
        number = int(piece[k])
        t = float(along[k])
        if along[k] > 0.0 and over[k] > 0.0:
            t = brentq(
                lambda s: float(above(arcs.at(np.array([number]), [s]))[0]),
                float(along[k - 1]), t, xtol=1e-12,
            )  # fmt: skip
    if camber.scale == "fixed":
        camber.drop(arcs.at(np.array([number]), [t])[0, 0])
    return number, t


def trimmed(station: Station, deck: Deck | None) -> Station:
    """Give a section up to a deck; all of it where there is no deck."""
    if deck is None:
        return station
    return Station(station.x, station.curve.cut(*deck_edge_at(station, deck)))

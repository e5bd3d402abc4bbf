"""Classical curves as the criteria of fairness look at them."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.classical.chord_spline import ChordSpline
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.classical.elastica import Elastica
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.curve_pieces import (
    PieceDerivatives,
    SplinePieces,
    searched_distance,
)

__all__ = ["ArcFairnessPieces", "ElasticaFairnessPieces", "chord_spline_pieces"]

_UP = np.array([0.0, 0.0, 1.0])


def chord_spline_pieces(spline: ChordSpline) -> SplinePieces:
    """Give a chord spline as pieces: it is a composite cubic.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.chord_spline import ChordSpline
    >>> from assoc_hull.analysis.fairness.classical_pieces import chord_spline_pieces
    >>> from assoc_hull.geometry.fairness.criteria import criteria
    >>> batten = ChordSpline.through([(0, 0), (2, 1), (4, 1.5), (7, 1.2), (9, 0)])
    >>> criteria(chord_spline_pieces(batten))[0].failed
    ()
    """
    return SplinePieces.of(spline.batch, _UP)


def _seen(
    angle: FloatArray, curvature: FloatArray, rate: FloatArray, speed: FloatArray
) -> PieceDerivatives:
    """Put together what is seen from direction, curvature and its slope."""
    tangent = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    left = np.stack([-tangent[..., 1], tangent[..., 0]], axis=-1)
    return PieceDerivatives(tangent, curvature, rate, speed, curvature[..., None] * left, rate)


@attrs.frozen(eq=False)
class ArcFairnessPieces:
    """One chain of arcs and straight lines."""

    arcs: PlaneArcs

    @property
    def owner(self) -> IntArray:
        """All arcs belong to one curve."""
        return np.zeros(len(self.arcs), np.int64)

    @property
    def signed(self) -> np.typing.NDArray[np.bool_]:
        """Curvature has a sign."""
        return np.ones(1, np.bool_)

    @property
    def of_arcs(self) -> bool:
        """Only the steps of curvature count."""
        return True

    def seen(self, u: FloatArray) -> PieceDerivatives:
        """Look at all arcs at parameters u (k,)."""
        arcs = self.arcs
        shape = (len(arcs), len(u))
        angle = arcs.angle[:, None] + (arcs.curvature * arcs.length)[:, None] * u
        curvature, speed = (
            np.broadcast_to(each[:, None], shape) for each in (arcs.curvature, arcs.length)
        )
        return _seen(angle, curvature, np.zeros(shape), speed)

    def distance(self, curve: IntArray, points: FloatArray) -> FloatArray:
        """Give the distance (m) of points (k, 2) from the chain, (k,)."""
        arc = np.tile(np.arange(len(self.arcs)), len(points))
        each = self.arcs.distance(arc, np.repeat(points, len(self.arcs), axis=0))
        return np.asarray(each.reshape(len(points), -1).min(axis=1))


@attrs.frozen(eq=False)
class ElasticaFairnessPieces:
    """A chain of elastica, joined end to end; each is looked at in `parts` pieces."""

    segments: tuple[Elastica, ...]
    parts: int = 8

    @property
    def owner(self) -> IntArray:
        """All pieces belong to one curve."""
        return np.zeros(self.parts * len(self.segments), np.int64)

    @property
    def signed(self) -> np.typing.NDArray[np.bool_]:
        """Curvature has a sign."""
        return np.ones(1, np.bool_)

    @property
    def of_arcs(self) -> bool:
        """Curvature changes along an elastica."""
        return False

    def seen(self, u: FloatArray) -> PieceDerivatives:
        """Look at all pieces at parameters u (k,)."""
        rows = [self._one(each, u) for each in self.segments]
        angle, curvature, rate, speed = (np.concatenate(each) for each in zip(*rows, strict=True))
        return _seen(angle, curvature, rate, speed)

    def _one(self, rod: Elastica, u: FloatArray) -> tuple[FloatArray, ...]:
        step = rod.length / self.parts
        s = np.minimum((np.arange(self.parts)[:, None] + u) * step, rod.length)
        speed = np.full(s.shape, step)
        return rod.direction(s), rod.curvature(s), rod.curvature_rate(s), speed

    def distance(self, curve: IntArray, points: FloatArray) -> FloatArray:
        """Give the distance (m) of points (k, 2) from the chain, (k,)."""
        away = [
            searched_distance(rod.at, np.linspace(0.0, rod.length, self.parts + 1), points)
            for rod in self.segments
        ]
        return np.asarray(np.min(away, axis=0))

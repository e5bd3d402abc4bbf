"""Plates seen in plan and in space: the frame of a plate, eyes, and what they see on paper."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Eye", "Place", "plate_frame", "relief_of", "upright"]

_RELIEFS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)
_RISE = 0.12
"""Of the length of a plate: so high it may look in space, where heights are drawn larger."""

_STEEP = 0.3
"""Of the breadth, likewise."""

_TURN, _RAISED = np.radians(-28.0), np.radians(32.0)


@attrs.frozen(eq=False)
class Eye:
    """From where a plate is seen, without perspective.

    Attributes
    ----------
    middle : (3,), m
        What lies in the middle.
    frame : (3, 3)
        Rows: along the plate, across it, and its normal; of length 1.
    relief : float
        So many times larger heights along the normal are drawn.
    turn : (3, 3)
        Rows: to the right, upward and toward the eye, in the axes of the frame.
    """

    middle: FloatArray
    frame: FloatArray
    relief: float
    turn: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.middle, self.frame, self.turn)

    def seen(self, xyz: FloatArray) -> FloatArray:
        """Give what is to the right, upward and toward the eye, m, of points (..., 3), m."""
        local = (xyz - self.middle) @ self.frame.T * (1.0, 1.0, self.relief)
        return np.asarray(local @ self.turn.T)

    def lit(self, normal: FloatArray) -> FloatArray:
        """Give how bright plates with these normals (k, 3) look from here, 0 to 1."""
        local = normal @ self.frame.T / (1.0, 1.0, self.relief)
        size = np.sqrt((local * local).sum(axis=-1))
        local = local / np.maximum(size, 1e-300)[:, None]
        light = np.array([-0.35, 0.45, 0.82])
        return np.asarray(np.abs(local @ light))

    def in_space(self, relief: float) -> Eye:
        """Give the eye that looks at the same plate from aside and above."""
        toward = np.array([
            np.sin(_TURN) * np.cos(_RAISED), -np.cos(_TURN) * np.cos(_RAISED), np.sin(_RAISED)
        ])  # fmt: skip
        right = np.array([np.cos(_TURN), np.sin(_TURN), 0.0])
        turn = np.array([right, np.cross(toward, right), toward])
        return attrs.evolve(self, relief=relief, turn=turn)


def plate_frame(points: FloatArray, weights: FloatArray, outward: FloatArray) -> Eye:
    """Give the eye that sees a plate in plan: its long side level, its normal toward the eye.

    Parameters
    ----------
    points : (k, 3), m
        On the plate.
    weights : (k,)
        The share of the area that each stands for.
    outward : (3,)
        About the normal of the plate.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.plot.plates.plate_view import plate_frame
    >>> corners = np.array([[0.0, 0, 0], [0, 6, 0], [2, 0, 0], [2, 6, 0]])
    >>> plate_frame(corners, np.ones(4), np.array([0.0, 0, 1])).frame[0].tolist()
    [0.0, 1.0, 0.0]
    """
    share = weights / weights.sum()
    middle = share @ points
    off = points - middle
    _, axes = np.linalg.eigh((off * share[:, None]).T @ off)
    long, normal = axes[:, 2], axes[:, 0]
    long = long * np.sign(long[np.abs(long).argmax()]) + 0.0
    normal = normal * (1.0 if normal @ outward >= 0.0 else -1.0) + 0.0
    frame = np.array([long, np.cross(normal, long), normal]) + 0.0
    return Eye(middle, frame, 1.0, np.eye(3))


def upright(middle: FloatArray) -> Eye:
    """Give the eye that sees x to the right and y upward."""
    return Eye(middle, np.eye(3), 1.0, np.eye(3))


def relief_of(eye: Eye, points: FloatArray) -> float:
    """Choose how many times larger heights are to be drawn, so that the shape is seen."""
    extent = np.ptp((points - eye.middle) @ eye.frame.T, axis=0)
    if extent[2] <= 1e-6 * extent[0]:
        return 1.0
    wanted = min(_RISE * extent[0], _STEEP * extent[1]) / extent[2]
    return max((each for each in _RELIEFS if each <= wanted), default=1.0)


@attrs.frozen(eq=False)
class Place:
    """An eye's picture at a place of the sheet.

    Attributes
    ----------
    eye : Eye
        From where.
    origin : (2,), mm
        Where its middle lies.
    unit : float
        Millimetres for a metre.
    """

    eye: Eye
    origin: FloatArray
    unit: float

    def on_paper(self, xyz: FloatArray) -> FloatArray:
        """Give the places (..., 2), mm, of points (..., 3), m."""
        return np.asarray(self.origin + self.unit * self.eye.seen(xyz)[..., :2])

    def toward(self, xyz: FloatArray) -> FloatArray:
        """Give how near points (..., 3) lie to the eye, m."""
        return np.asarray(self.eye.seen(xyz)[..., 2])

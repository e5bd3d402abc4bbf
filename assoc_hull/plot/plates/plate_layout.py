"""How plates are seen, and where they lie on a sheet: in rows and columns, all to one scale.

A plate has a frame of its own; eyes see it in plan or in space, and a placement turns what they
see into millimetres. Plates are laid on shelves like goods, so that all have room.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.plot.plates.plate_picture import PlateShape
from assoc_hull.plot.sheet.paper import scale_of

__all__ = [
    "PlateCell",
    "PlateEye",
    "PlatePlacement",
    "PlateSight",
    "SheetArea",
    "lay_plates",
    "plate_frame",
    "relief_of",
    "upright",
]

# --------------------------------------------------------------------------------------
# Plates seen in plan and in space: the frame of a plate, eyes, and what they see on paper.

_RELIEFS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)
_RISE = 0.12
"""Of the length of a plate: so high it may look in space, where heights are drawn larger."""

_STEEP = 0.3
"""Of the breadth, likewise."""

_TURN, _RAISED = np.radians(-28.0), np.radians(32.0)


@attrs.frozen(eq=False)
class PlateEye:
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

    def in_space(self, relief: float) -> PlateEye:
        """Give the eye that looks at the same plate from aside and above."""
        toward = np.array([
            np.sin(_TURN) * np.cos(_RAISED), -np.cos(_TURN) * np.cos(_RAISED), np.sin(_RAISED)
        ])  # fmt: skip
        right = np.array([np.cos(_TURN), np.sin(_TURN), 0.0])
        turn = np.array([right, np.cross(toward, right), toward])
        return attrs.evolve(self, relief=relief, turn=turn)


def plate_frame(points: FloatArray, weights: FloatArray, outward: FloatArray) -> PlateEye:
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
    >>> from assoc_hull.plot.plates.plate_layout import plate_frame
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
    return PlateEye(middle, frame, 1.0, np.eye(3))


def upright(middle: FloatArray) -> PlateEye:
    """Give the eye that sees x to the right and y upward."""
    return PlateEye(middle, np.eye(3), 1.0, np.eye(3))


def relief_of(eye: PlateEye, points: FloatArray) -> float:
    """Choose how many times larger heights are to be drawn, so that the shape is seen."""
    extent = np.ptp((points - eye.middle) @ eye.frame.T, axis=0)
    if extent[2] <= 1e-6 * extent[0]:
        return 1.0
    wanted = min(_RISE * extent[0], _STEEP * extent[1]) / extent[2]
    return max((each for each in _RELIEFS if each <= wanted), default=1.0)


@attrs.frozen(eq=False)
class PlatePlacement:
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

    eye: PlateEye
    origin: FloatArray
    unit: float

    def on_paper(self, xyz: FloatArray) -> FloatArray:
        """Give the places (..., 2), mm, of points (..., 3), m."""
        return np.asarray(self.origin + self.unit * self.eye.seen(xyz)[..., :2])

    def toward(self, xyz: FloatArray) -> FloatArray:
        """Give how near points (..., 3) lie to the eye, m."""
        return np.asarray(self.eye.seen(xyz)[..., 2])


# --------------------------------------------------------------------------------------
# Where plates lie on a sheet: in rows and columns, all to one scale.

_GAP = 4.0  # mm at A3, between plates and between views of one
_CAPTION = 7.5


@attrs.frozen(eq=False)
class PlateSight:
    """One view of a plate: its shape, and from where it is seen.

    Attributes
    ----------
    kind : str
        "plan", "space" or "parameters".
    shape : Shape
        What is seen.
    eye : Eye
        From where.
    """

    kind: str
    shape: PlateShape
    eye: PlateEye

    @property
    def box(self) -> FloatArray:
        """Least and greatest of what is to the right and upward, (2, 2), m."""
        seen = self.eye.seen(self.shape.corner)[..., :2].reshape(-1, 2)
        return np.array([seen.min(axis=0), seen.max(axis=0)])


@attrs.frozen
class SheetArea:
    """A part of a sheet, mm."""

    left: float
    low: float
    right: float
    top: float

    def part(self, row: int, column: int, rows: int, columns: int, gap: float) -> SheetArea:
        """Give one of rows (from the top) and columns with gaps between them."""
        wide = (self.right - self.left + gap) / columns
        tall = (self.top - self.low + gap) / rows
        left, top = self.left + column * wide, self.top - row * tall
        return SheetArea(left, top - tall + gap, left + wide - gap, top)


@attrs.frozen(eq=False)
class PlateCell:
    """Where a plate lies: its field, the scale, and the place of each of its views.

    Attributes
    ----------
    field : Field
        With room for words above and below.
    places : tuple of Place
        Of its views, in their order.
    denominator : float
        Views in plan are 1 to this.
    """

    field: SheetArea
    places: tuple[PlatePlacement, ...]
    denominator: float


def lay_plates(
    plates: Sequence[Sequence[PlateSight]], field: SheetArea, factor: float, below: float
) -> list[PlateCell]:
    """Choose rows, columns and scales so that plates are drawn as large as they can be.

    Parameters
    ----------
    plates : sequence of sequences of Sight
        The views of each plate; all plates have the same kinds of views.
    field : Field
        Where they go.
    factor : float
        How much wider spaces are than on A3.
    below : float, mm
        Room for words below each plate.
    """
    boxes = np.array([[sight.box for sight in plate] for plate in plates])
    extent = np.maximum(np.ptp(boxes, axis=2), 1e-9).max(axis=0)
    best = max(
        (_Shelf.of(len(plates), columns, beside, extent, field, factor, below)
         for columns in range(1, len(plates) + 1) for beside in (False, True)),
        key=lambda shelf: shelf.size,
    )  # fmt: skip
    return [best.cell(k, plate) for k, plate in enumerate(plates)]


@attrs.frozen(eq=False)
class _Shelf:
    """Rows and columns, views of a plate beside or above one another, millimetres for a metre."""

    rows: int
    columns: int
    beside: bool
    field: SheetArea
    factor: float
    below: float
    units: FloatArray

    @classmethod
    def of(
        cls,
        count: int,
        columns: int,
        beside: bool,
        extent: FloatArray,
        field: SheetArea,
        factor: float,
        below: float,
    ) -> _Shelf:
        rows = -(-count // columns)
        shelf = cls(rows, columns, beside, field, factor, below, np.ones(len(extent)))
        room = shelf.room(shelf.part(0), 0, len(extent))
        size = np.array([room.right - room.left, room.top - room.low])
        return attrs.evolve(shelf, units=(np.maximum(size, 1.0) / extent).min(axis=1))

    @property
    def size(self) -> float:
        return float(np.prod(self.units))

    def part(self, number: int) -> SheetArea:
        row, column = divmod(number, self.columns)
        gap = _GAP * self.factor
        return self.field.part(row, column, self.rows, self.columns, gap)

    def room(self, part: SheetArea, number: int, count: int) -> SheetArea:
        """Give the field of a view."""
        inner = attrs.evolve(part, low=part.low + self.below, top=part.top - _CAPTION * self.factor)
        rows, columns = (1, count) if self.beside else (count, 1)
        row, column = (0, number) if self.beside else (number, 0)
        return inner.part(row, column, rows, columns, _GAP * self.factor)

    def cell(self, number: int, plate: Sequence[PlateSight]) -> PlateCell:
        part, places, denominator = self.part(number), [], 0.0
        for k, sight in enumerate(plate):
            room, box, unit = self.room(part, k, len(plate)), sight.box, float(self.units[k])
            if sight.kind == "plan":
                denominator = scale_of(1.0, unit)
                unit = 1e3 / denominator
            middle = np.array([room.left + room.right, room.low + room.top]) / 2.0
            places.append(PlatePlacement(sight.eye, middle - unit * box.mean(axis=0), unit))
        return PlateCell(part, tuple(places), denominator)

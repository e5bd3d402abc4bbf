"""Where plates lie on a sheet: in rows and columns, all to one scale."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.plates.plate_scene import Shape
from assoc_hull.plot.plates.plate_view import Eye, Place
from assoc_hull.plot.sheet.view import scale_of

__all__ = ["Cell", "Field", "Sight", "lay_plates"]

_GAP = 4.0  # mm at A3, between plates and between views of one
_CAPTION = 7.5


@attrs.frozen(eq=False)
class Sight:
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
    shape: Shape
    eye: Eye

    @property
    def box(self) -> FloatArray:
        """Least and greatest of what is to the right and upward, (2, 2), m."""
        seen = self.eye.seen(self.shape.corner)[..., :2].reshape(-1, 2)
        return np.array([seen.min(axis=0), seen.max(axis=0)])


@attrs.frozen
class Field:
    """A part of a sheet, mm."""

    left: float
    low: float
    right: float
    top: float

    def part(self, row: int, column: int, rows: int, columns: int, gap: float) -> Field:
        """Give one of rows (from the top) and columns with gaps between them."""
        wide = (self.right - self.left + gap) / columns
        tall = (self.top - self.low + gap) / rows
        left, top = self.left + column * wide, self.top - row * tall
        return Field(left, top - tall + gap, left + wide - gap, top)


@attrs.frozen(eq=False)
class Cell:
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

    field: Field
    places: tuple[Place, ...]
    denominator: float


def lay_plates(
    plates: Sequence[Sequence[Sight]], field: Field, factor: float, below: float
) -> list[Cell]:
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
    field: Field
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
        field: Field,
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

    def part(self, number: int) -> Field:
        row, column = divmod(number, self.columns)
        gap = _GAP * self.factor
        return self.field.part(row, column, self.rows, self.columns, gap)

    def room(self, part: Field, number: int, count: int) -> Field:
        """Give the field of a view."""
        inner = attrs.evolve(part, low=part.low + self.below, top=part.top - _CAPTION * self.factor)
        rows, columns = (1, count) if self.beside else (count, 1)
        row, column = (0, number) if self.beside else (number, 0)
        return inner.part(row, column, rows, columns, _GAP * self.factor)

    def cell(self, number: int, plate: Sequence[Sight]) -> Cell:
        part, places, denominator = self.part(number), [], 0.0
        for k, sight in enumerate(plate):
            room, box, unit = self.room(part, k, len(plate)), sight.box, float(self.units[k])
            if sight.kind == "plan":
                denominator = scale_of(1.0, unit)
                unit = 1e3 / denominator
            middle = np.array([room.left + room.right, room.low + room.top]) / 2.0
            places.append(Place(sight.eye, middle - unit * box.mean(axis=0), unit))
        return Cell(part, tuple(places), denominator)

"""Lines that run unseen between positive and negative cells: cells made by hand."""

import numpy as np

from assoc_hull.geometry.patches.cells import CellKind, SignCells, ZeroSetArcs
from assoc_hull.geometry.patches.components import (
    ComponentKind,
    LineEndKind,
    ZeroSetComponent,
    join_arcs,
)
from tests.unit.geometry.patches.joined_lines import apart

Box = tuple[tuple[float, float], tuple[float, float]]

LEFT, RIGHT = (0.0, 0.25), (0.75, 1.0)
LOW, HIGH, ALL = (0.0, 0.5), (0.5, 1.0), (0.0, 1.0)
ARC = CellKind.V_SIMPLE


def components(
    *rows: tuple[CellKind, tuple[float, float], tuple[float, float]],
) -> list[ZeroSetComponent]:
    """The components of cells; in simple ones the line v = 1/2 runs, positive above."""
    kind = np.array([row[0] for row in rows])
    box = np.array([row[1:] for row in rows])
    simple = np.flatnonzero(kind == ARC)
    row = np.full(len(rows), -1)
    row[simple] = np.arange(len(simple))
    b = np.tile(np.array([[-1.0, 1.0], [-1.0, 1.0]]), (len(simple), 1, 1))
    level = np.zeros(len(rows), np.intp)
    cells = SignCells(level, box, level, kind, row, b, 1e-9 + 0.0 * b, np.zeros(1, bool))
    ends = np.full((len(simple), 2, 2), 0.5)
    ends[..., 0] = box[simple, 0]
    across, rising = np.ones(len(simple), np.intp), np.ones(len(simple), bool)
    arcs = ZeroSetArcs(simple, across, box[simple, 0], ends, rising)
    return list(join_arcs(apart(np.zeros((1, 2, 2, 3))), cells, arcs))


def test_a_gap_is_followed_along_cells() -> None:
    """Between two arcs, a line runs where positive cells meet negative ones."""
    (line,) = components(
        (ARC, LEFT, ALL), (ARC, RIGHT, ALL),
        (CellKind.NEGATIVE, (0.25, 0.75), LOW),
        (CellKind.POSITIVE, (0.25, 0.5), HIGH), (CellKind.POSITIVE, (0.5, 0.75), HIGH),
    )  # fmt: skip
    assert line.kind is ComponentKind.OPEN
    assert line.tags == ("gap",)
    assert [arcs.tolist() for arcs in line.chains] == [[0, 1]]
    assert line.ends.tolist() == [[0.0, 0.5], [1.0, 0.5]]


def test_a_gap_may_lead_to_the_border() -> None:
    """A line that runs unseen to the border of the surface ends there."""
    (line,) = components(
        (ARC, LEFT, ALL),
        (CellKind.NEGATIVE, (0.25, 1.0), LOW), (CellKind.POSITIVE, (0.25, 1.0), HIGH),
    )  # fmt: skip
    assert line.kind is ComponentKind.OPEN
    assert line.end_kinds == (LineEndKind.BORDER, LineEndKind.BORDER)


def test_a_gap_turns_with_the_cells() -> None:
    """It turns at corners of cells, and may lead out at another side."""
    (line,) = components(
        (ARC, LEFT, ALL),
        (CellKind.NEGATIVE, (0.25, 0.5), LOW), (CellKind.POSITIVE, (0.25, 0.5), HIGH),
        (CellKind.POSITIVE, (0.5, 1.0), ALL),
    )  # fmt: skip
    assert line.kind is ComponentKind.OPEN
    assert LineEndKind.JUNCTION not in line.end_kinds


def test_a_gap_may_lead_to_nil_cells() -> None:
    """A line that runs unseen to a part without curvature ends there."""
    (line,) = components(
        (ARC, LEFT, ALL),
        (CellKind.NEGATIVE, (0.25, 0.5), LOW), (CellKind.POSITIVE, (0.25, 0.5), HIGH),
        (CellKind.ZERO, (0.5, 1.0), ALL),
    )  # fmt: skip
    assert line.kind is ComponentKind.JUNCTION
    assert line.meetings == 1
    assert line.tags == ("flat", "gap")
    assert line.cells.tolist() == [3]


def test_small_nil_cells_in_a_gap_do_not_end_a_line() -> None:
    """A nil cell as narrow as a line lies on it."""
    (line,) = components(
        (ARC, LEFT, ALL), (ARC, RIGHT, ALL),
        (CellKind.NEGATIVE, (0.25, 0.5), LOW), (CellKind.POSITIVE, (0.25, 0.5), HIGH),
        (CellKind.ZERO, (0.5, 0.502), (0.49, 0.51)),
        (CellKind.NEGATIVE, (0.5, 0.502), (0.0, 0.49)),
        (CellKind.POSITIVE, (0.5, 0.502), (0.51, 1.0)),
        (CellKind.NEGATIVE, (0.502, 0.75), LOW), (CellKind.POSITIVE, (0.502, 0.75), HIGH),
    )  # fmt: skip
    assert line.kind is ComponentKind.OPEN
    assert line.tags == ("flat", "gap")
    assert [arcs.tolist() for arcs in line.chains] == [[0, 1]]

"""A box with circular bilges and flat ends: its form parameters are known in closed form."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.parameter import FormValue
from assoc_hull.geometry.curves import PointKind
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

LENGTH, HALF, DEPTH, DRAUGHT, BILGE = 100.0, 10.0, 12.0, 6.0, 2.0
SMOOTH, TANGENT = int(PointKind.SMOOTH), int(PointKind.TANGENT)


def rim(x: float, radius: float) -> tuple[np.ndarray, list[int], np.ndarray]:
    """Half a section with flat bottom, bilge and flat side: points, kinds, directions."""
    angle = np.linspace(0.0, 0.5 * np.pi, 25)
    turn = np.column_stack(
        [HALF - radius + radius * np.sin(angle), radius - radius * np.cos(angle)]
    )
    turn[0], turn[-1] = [HALF - radius, 0.0], [HALF, radius]
    points = np.concatenate([[[0.0, 0.0]], turn, [[HALF, DEPTH]]])
    kind = [SMOOTH, TANGENT, *[SMOOTH] * (len(turn) - 2), TANGENT, SMOOTH]
    direction = np.zeros((len(points), 3))
    direction[1], direction[-2] = [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]
    return np.column_stack([np.full(len(points), x), points]), kind, direction


def round_box(radius: float = BILGE, *, placed: bool = True) -> ah.Hull:
    """Its two ends are flat; the aft one is a transom. Points of sections may be `placed`."""

    def end(
        name: str,
        points: np.ndarray,
        plane: tuple[tuple[int, int, int], float],
        kind: list[int] | None = None,
        direction: np.ndarray | None = None,
    ) -> LineSource:
        return LineSource.make(
            "boundary", name, points, plane=plane, boundary=BoundaryKind.END, kind=kind,
            direction=direction, placed=True,
        )  # fmt: skip

    ends = {x: rim(x, radius) for x in (0.0, LENGTH)}
    lines = [
        end("profile", np.array([[0.0, 0, 0], [LENGTH, 0, 0]]), ((0, 1, 0), 0.0)),
        end("deck", np.array([[0.0, HALF, DEPTH], [LENGTH, HALF, DEPTH]]), ((0, 0, 1), DEPTH)),
        end("aft end", ends[0.0][0], ((1, 0, 0), 0.0), *ends[0.0][1:]),
        end("fore end", ends[LENGTH][0], ((1, 0, 0), LENGTH), *ends[LENGTH][1:]),
    ]
    for i, x in enumerate((25.0, 50.0, 75.0), 1):
        points, kind, direction = rim(x, radius)
        lines.append(
            LineSource.make(
                "sections", f"ST {i}", points, kind=kind, direction=direction, placed=placed
            )
        )
    ship = ah.Particulars("Round box", LENGTH, 2.0 * HALF, DEPTH, DRAUGHT, "closed")
    links = [ah.Association("boundary", "sections")]
    return ah.Hull.from_lines(lines, particulars=ship, associations=links)


@pytest.fixture(scope="module")
def found() -> Mapping[str, FormValue]:
    """Form parameters with a screw that stands in the box, which only numbers mind."""
    return round_box().form_parameters(screw=ah.form.Screw(height=3.0, diameter=2.0, x=1.0))


@pytest.mark.parametrize(
    ("symbol", "value"),
    [
        ("ATT", 2.0 * HALF * DRAUGHT - 2.0 * (1.0 - np.pi / 4.0) * BILGE**2),
        ("B_tr", 2.0 * HALF),
        ("TH", 0.0),
        ("TRZ", DRAUGHT),
        ("SO", 0.0),
        ("Hap", 0.0),
        ("BCL", HALF),
        ("B07", HALF),
        ("Tau", 0.0),
        ("S3.A2", HALF * DRAUGHT - (1.0 - np.pi / 4.0) * BILGE**2),
        # Above z = 3 the side stands off the chord from (0, 0) to (10, 6) by 10 (1 - z / 6).
        ("S3.A1", 7.5),
        ("PI", 2.0),
    ],
)
def test_the_box_is_measured_exactly(
    found: Mapping[str, FormValue], symbol: str, value: float
) -> None:
    """The bilge is drawn by 25 points, within 1e-7 m of the circle."""
    assert found[symbol].number == pytest.approx(value, abs=1e-5)


def test_the_bilge_radius_is_found_both_ways(found: Mapping[str, FormValue]) -> None:
    """BR: by the arc, and from what the section's area leaves of B T."""
    assert found["BR"].number == pytest.approx(BILGE, abs=1e-5)
    assert found["ATT"].number is not None
    lost = 2.0 * HALF * DRAUGHT - found["ATT"].number
    assert np.sqrt(lost / (2.0 - 0.5 * np.pi)) == pytest.approx(BILGE, abs=1e-5)


def test_straight_sides_have_no_radius(found: Mapping[str, FormValue]) -> None:
    """Raft: T/2 and 3T/4 are on the side, T/4 in the bilge: a circle; with a small bilge none."""
    assert found["Raft"].number is not None
    small = round_box(1.0).form_parameters(only=["Raft", "BR"])
    assert small["Raft"].reason == "the section is straight there"
    assert small["BR"].number == pytest.approx(1.0, abs=1e-5)

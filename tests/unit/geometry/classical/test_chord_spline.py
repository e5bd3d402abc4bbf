"""The mechanical spline: values of the paper's method, what is continuous, what is refused."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.chord_spline import ChordSpline, Mode, chord_splines
from assoc_hull.geometry.curves import FloatArray

POINTS = [(0.0, 0.0), (2.0, 1.0), (4.0, 1.5), (7.0, 1.2), (9.0, 0.0)]
ANGLES: dict[Mode, list[float]] = {
    "moment": [
        0.5104118580736114, 0.3703227578616388, 0.12301554951305137, -0.37141835124820693,
        -0.6255277690244943,
    ],
    "curvature": [
        0.5107550927990916, 0.36964079218264, 0.1266229501834916, -0.3785802507258173,
        -0.6218724717850048,
    ],
}  # fmt: skip
MIDDLE: dict[Mode, tuple[float, float]] = {
    "moment": (2.9844639908241595, 1.312144036703362),
    "curvature": (2.9847360363814275, 1.3110558544742899),
}
MODES = pytest.mark.parametrize("mode", ["moment", "curvature"])


def drawn(seed: int, count: int) -> list[FloatArray]:
    """Curves that turn gently, of any total angle."""
    rng = np.random.default_rng(seed)
    curves = []
    for _ in range(count):
        n = int(rng.integers(2, 30))
        turn = np.cumsum(rng.uniform(-0.5, 0.5, n) + rng.uniform(-0.2, 0.2))
        length = rng.uniform(0.5, 2.0, n)
        step = np.column_stack([length * np.cos(turn), length * np.sin(turn)])
        curves.append(np.vstack([[0.0, 0.0], np.cumsum(step, axis=0)]))
    return curves


@MODES
def test_the_directions_are_those_of_the_reference(mode: Mode) -> None:
    """Both modes, five points, free ends: directions and a point between, all digits."""
    spline = ChordSpline.through(POINTS, mode=mode)
    assert spline.angles == pytest.approx(ANGLES[mode], abs=1e-12)
    middle = spline.at(0.5 * (spline.knots[1] + spline.knots[2]))
    assert middle == pytest.approx(MIDDLE[mode], abs=1e-12)
    assert spline.notes == ()


@pytest.mark.parametrize(
    ("mode", "jump"),
    [
        pytest.param("moment", 0.014038795366700857, id="moments continuous"),
        pytest.param("curvature", 0.0, id="curvature continuous"),
    ],
)
def test_only_one_mode_has_continuous_curvature(mode: Mode, jump: float) -> None:
    """The paper's moments agree in frames of two chords, so curvature jumps."""
    before, after = ChordSpline.through(POINTS, mode=mode).node_curvatures
    assert np.abs(after - before).max() == pytest.approx(jump, abs=1e-14)


@pytest.mark.parametrize(
    ("count", "error"),
    [
        pytest.param(9, 0.0001882193057745063, id="9 points"),
        pytest.param(17, 1.1649524254364607e-05, id="17 points"),
    ],
)
def test_a_half_circle_is_met_to_the_fourth_order(count: int, error: float) -> None:
    """Clamped vertically, the radial error is that of the reference: a 16th for half the step."""
    turn = np.linspace(0.0, np.pi, count)
    points = np.column_stack([np.cos(turn), np.sin(turn)])
    arch = ChordSpline.through(points, 0.5 * np.pi, -0.5 * np.pi)
    t = np.linspace(0.0, arch.knots[-1], 100 * (count - 1) + 1)
    away = np.abs(np.hypot(*arch.at(t).T) - 1.0)
    assert away.max() == pytest.approx(error, rel=1e-9)


@MODES
def test_drawn_curves_interpolate_and_keep_what_is_continuous(mode: Mode) -> None:
    """200 curves: through the points to rounding, one direction at each, bend to 1e-10."""
    for spline in chord_splines(drawn(1, 200), mode=mode):
        assert np.abs(spline.at(spline.knots) - spline.points).max() < 1e-12
        batch = spline.batch
        gap = np.abs(np.cross(batch.leave, batch.arrive)[:, 2])
        assert gap.max() < 1e-12
        if mode == "curvature":
            before, after = spline.node_curvatures
            assert np.abs(after - before).max() < 1e-10
        else:
            before, after = moments(spline)
            assert np.abs(after - before).max(initial=0.0) < 1e-10


def moments(spline: ChordSpline) -> tuple[FloatArray, FloatArray]:
    """Moment over stiffness before and after inner points, from second derivatives."""
    step = np.diff(spline.points, axis=0)
    length, angle = np.hypot(*step.T), np.unwrap(np.arctan2(step[:, 1], step[:, 0]))
    m0, m1 = np.tan(spline.angles[:-1] - angle), np.tan(spline.angles[1:] - angle)
    return ((2 * m0 + 4 * m1) / length)[:-1], (-(4 * m0 + 2 * m1) / length)[1:]


def test_free_ends_do_not_bend() -> None:
    """At a free end curvature is nil; at a clamped one the direction is the given one."""
    free, clamped = ChordSpline.through(POINTS), ChordSpline.through(POINTS, 0.6, -0.5)
    assert free.curvature([0.0, free.knots[-1]]) == pytest.approx([0.0, 0.0], abs=1e-12)
    ends = clamped.direction([0.0, clamped.knots[-1]])
    assert ends == pytest.approx([0.6, -0.5], abs=1e-12)


def test_it_turns_and_moves_with_its_points() -> None:
    """Rotated by 2 rad and moved, every place is where the same motion takes it."""
    cosine, sine = np.cos(2.0), np.sin(2.0)
    turn = np.array([[cosine, sine], [-sine, cosine]])
    for points in drawn(2, 20):
        here, there = chord_splines([points, points @ turn + [30.0, -7.0]])
        t = np.linspace(0.0, here.knots[-1], 50)
        moved = here.at(t) @ turn + [30.0, -7.0]
        assert there.at(np.minimum(t, there.knots[-1])) == pytest.approx(moved, abs=1e-10)


@MODES
def test_a_neighbour_in_the_batch_changes_no_bit(mode: Mode) -> None:
    """A spline is the same alone and among 40 others."""
    curves = drawn(3, 40)
    together = chord_splines(curves, mode=mode)
    for points, spline in zip(curves, together, strict=True):
        alone = ChordSpline.through(points, mode=mode)
        assert alone.angles.tobytes() == spline.angles.tobytes()


def test_all_places_of_a_given_height_are_found() -> None:
    """A loop has four places of one y and three of one x; a summit is one place."""
    turn = np.linspace(-0.2, 4.1 * np.pi, 60)
    loop = ChordSpline.through(np.column_stack([np.cos(turn) + 0.1 * turn, np.sin(turn)]))
    found = loop.where("y", [0.5, -0.4])
    assert np.bincount(found.index).tolist() == [4, 4]
    assert found.points[:, 1] == pytest.approx(np.array([0.5, -0.4])[found.index], abs=1e-12)
    assert loop.at(found.t) == pytest.approx(found.points, abs=1e-12)
    arch = ChordSpline.through([(0.0, 0.0), (1.0, 0.3), (2.0, 0.0)])
    assert len(arch.where("y", 0.3)) == 1
    assert arch.where("x", [0.0, 2.0]).points[:, 1].tolist() == [0.0, 0.0]


def test_a_steep_batten_says_so() -> None:
    """A slope beyond .35 to a chord is no error; a sentence tells of it, with its number."""
    [note] = ChordSpline.through([(0, 0), (1, 0)], 0.4).notes
    assert note.startswith("spline: slope 0.4227932187 to the chord at node 0 exceeds 0.35")


ZIGZAG = [(0.0, 0.0), (0.02345656, 0.0), (0.03301734, 0.02503479)]
REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "two points in one": (
        lambda: ChordSpline.through([(0, 0), (1, 1), (1, 1), (2, 0)]),
        "spline: coincident points 1",
    ),
    "a sharp turn": (
        lambda: ChordSpline.through([(0, 0), (1, 0), (0.5, 1)]),
        "spline: turn of 116.5650512 deg between chords 0,1; limit 90 (insert a knuckle or points)",
    ),
    "an end clamped across": (
        lambda: ChordSpline.through([(0, 0), (1, 0)], 1.0),
        "spline: slope 1.557407725 to the chord at node 0 exceeds 1",
    ),
    "an end clamped backward": (
        lambda: ChordSpline.through([(0, 0), (1, 0)], None, 3.0),
        "spline: slope inf to the chord at node 1 exceeds 1",
    ),
    "bent too much inside": (
        lambda: ChordSpline.through([(0, 0), (1, 0), (1, 0.5)], mode="moment"),
        "spline: slope 1.414213562 to the chord at node 1 exceeds 1",
    ),
    "no balance": (
        lambda: ChordSpline.through(ZIGZAG, 0.3791924289, 1.1759689206),
        "spline: Newton did not converge",
    ),
    "one point": (lambda: ChordSpline.through([(0, 0)]), "spline: at least 2 points"),
    "not finite": (
        lambda: ChordSpline.through([(0, 0), (1, float("nan"))]),
        "spline: non-finite value at index (1, 1)",
    ),
    "three columns": (
        lambda: ChordSpline.through([(0, 0, 0), (1, 1, 1)]),
        "spline: expected shape (n, 2), got (2, 3)",
    ),
    "beyond its end": (lambda: ChordSpline.through(POINTS).at(10.5), "spline: x=10.5 outside [0,"),
    "too high": (
        lambda: ChordSpline.through([(0, 0), (1, 0.3), (2, 0)]).where("y", 1.0),
        "spline: x=1 outside [0, 0.3]",
    ),
    "which of many": (
        lambda: chord_splines([POINTS, [(0, 0), (1, 1), (1, 1)]]),
        "spline: coincident points 1, curve 1",
    ),
    "an unknown mode": (
        lambda: ChordSpline.through(POINTS, mode="x"),  # type: ignore[arg-type]
        "spline: no mode 'x'",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("call", "message"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_bent_is_refused(call: Callable[[], object], message: str) -> None:
    """One line that names the place and the number."""
    with pytest.raises(GeometryError) as refused:
        call()
    assert str(refused.value).startswith(message)

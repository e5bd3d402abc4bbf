"""Five criteria of fairness as numbers: what each sees, and what it leaves alone."""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import CubicSpline, PPoly

from assoc_hull.errors import GeometryError
from assoc_hull.fairing.line_fairness import (
    ArcFairnessPieces,
    ElasticaFairnessPieces,
    chord_spline_pieces,
)
from assoc_hull.geometry.classical.chord_spline import ChordSpline
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.classical.elastica import fit_elastica
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.combs import DEAD_BAND, signs_without_waves
from assoc_hull.geometry.fairness.criteria import FairnessRecord, OffsetDeviations, criteria
from assoc_hull.geometry.splines.curve_pieces import (
    GraphPieces,
    PieceDerivatives,
    PiecewiseCurves,
    SplinePieces,
)
from assoc_hull.geometry.splines.loft import loft

UP = [0.0, 0.0, 1.0]
FAIR = [0.0, 1.0, 1.8, 2.45, 2.85, 3.1, 3.2]


@attrs.frozen(eq=False)
class QuarterEllipse:
    """The curve (3 cos t, 1.5 sin t) in equal pieces of t."""

    pieces: int = 24

    @property
    def owner(self) -> IntArray:
        return np.zeros(self.pieces, np.int64)

    @property
    def signed(self) -> np.typing.NDArray[np.bool_]:
        return np.ones(1, np.bool_)

    @property
    def of_arcs(self) -> bool:
        return False

    def seen(self, u: FloatArray) -> PieceDerivatives:
        step = 0.5 * np.pi / self.pieces
        t = (np.arange(self.pieces)[:, None] + u) * step
        along = np.stack([-3.0 * np.sin(t), 1.5 * np.cos(t)], axis=-1)
        speed = np.hypot(along[..., 0], along[..., 1])
        bend = 4.5 / speed**3
        rate = -3.0 * 4.5 * (9.0 - 2.25) * np.sin(t) * np.cos(t) / speed**6
        tangent = along / speed[..., None]
        left = np.stack([-tangent[..., 1], tangent[..., 0]], axis=-1)
        return PieceDerivatives(tangent, bend, rate, speed * step, bend[..., None] * left, rate)

    def distance(self, curve: IntArray, points: FloatArray) -> FloatArray:
        raise NotImplementedError


def graph(raised: float = 0.0) -> FairnessRecord:
    """The natural spline of the reference, its fourth point raised."""
    y = np.array(FAIR)
    y[3] += raised
    return criteria(GraphPieces.of(CubicSpline(np.arange(7.0), y, bc_type="natural")))[0]


def test_a_quarter_of_an_ellipse_has_the_numbers_of_the_reference() -> None:
    """Length, bending and variation of curvature, all digits; one curve that no library knows."""
    record = criteria(QuarterEllipse())[0]
    assert record.length == pytest.approx(3.633168082705378, rel=1e-12)
    assert record.bending == pytest.approx(4.018301915216277, rel=1e-12)
    assert record.variation == pytest.approx(40.761196122899506, rel=1e-12)
    assert record.inflections == 0
    assert record.failed == ()


@pytest.mark.parametrize(
    ("raised", "supports", "by_span", "variation", "length", "inflections"),
    [
        pytest.param(
            0.0, 0.9759219582728202, 0.6069022535878099, 41.9422524512829, 7.005118177152262, 0,
            id="fair",
        ),
        pytest.param(
            0.05, 2.0143708548398913, 0.889830109694213, 172.16106182618856, 7.016450951507651, 4,
            id="one point raised by 50 mm",
        ),
    ],
)  # fmt: skip
def test_a_natural_spline_has_the_numbers_of_the_reference(
    raised: float, supports: float, by_span: float, variation: float, length: float,
    inflections: int,
) -> None:  # fmt: skip
    """Support forces, bending, variation and sign changes.

    The printed bending of these two takes the span along x, 6 m, where the formula has the
    length; that of the ellipse takes the length. Both are checked by the formula.
    """
    record = graph(raised)
    assert record.length == pytest.approx(length, rel=1e-12)
    assert record.support_jumps == pytest.approx(supports, abs=1e-11)
    assert record.bending * 6.0 / record.length == pytest.approx(by_span, rel=1e-10)
    assert record.variation == pytest.approx(variation, rel=1e-10)
    assert record.inflections == inflections
    assert record.failed == (() if inflections == 0 else ("inflections",))


def test_wanted_inflections_are_allowed() -> None:
    """Four are no fault where four are wanted, and one is where three are."""
    y = np.array(FAIR)
    y[3] += 0.05
    pieces = GraphPieces.of(CubicSpline(np.arange(7.0), y, bc_type="natural"))
    found = [criteria(pieces, allowed=wanted)[0] for wanted in (3, 4, 9)]
    assert [each.unwanted_inflections for each in found] == [1, 0, 0]
    assert [each.passed["inflections"] for each in found] == [False, True, True]


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_bending_and_variation_have_no_unit(scale: float) -> None:
    """A curve drawn in mm or km has the same E2, E3, counts and relative jumps."""
    points = np.array([(0.0, 0.0), (2.0, 1.0), (4.0, 1.5), (7.0, 1.2), (9.0, 0.0)])
    one, other = (
        criteria(chord_spline_pieces(ChordSpline.through(factor * points, mode="moment")))[0]
        for factor in (1.0, scale)
    )
    assert other.bending == pytest.approx(one.bending, rel=1e-10)
    assert other.variation == pytest.approx(one.variation, rel=1e-9)
    assert other.curvature_jump == pytest.approx(one.curvature_jump, rel=1e-9)
    assert (other.extrema, other.inflections) == (one.extrema, one.inflections)


def test_a_jump_of_curvature_is_told_against_the_size_of_it() -> None:
    """A moment spline fails the second criterion alone, a curvature spline none."""
    points = [(0.0, 0.0), (2.0, 1.0), (4.0, 1.5), (7.0, 1.2), (9.0, 0.0)]
    rough, even = (
        criteria(chord_spline_pieces(ChordSpline.through(points, mode=mode)))[0]
        for mode in ("moment", "curvature")
    )
    assert rough.failed == ("second derivative",)
    size = max(np.sqrt(rough.bending), 1.0) / rough.length
    assert rough.curvature_jump == pytest.approx(0.014038795366700857 / size, rel=1e-9)
    assert even.failed == ()


def test_a_corner_is_a_fault_unless_it_is_a_knuckle() -> None:
    """A bend of .3 rad is measured, placed, and left out where the hull has a knuckle."""
    corner = PPoly(np.array([[0.0, np.tan(0.3)], [0.0, 0.0]]), np.array([0.0, 1.0, 2.0]))
    pieces = GraphPieces.of(corner)
    bare = criteria(pieces)[0]
    assert bare.angle_jump == pytest.approx(0.3, abs=1e-14)
    assert (bare.angle_at, bare.failed) == (1, ("first derivative",))
    meant = criteria(pieces, knuckles=np.array([True]))[0]
    assert (meant.angle_jump, meant.knuckles, meant.failed) == (0.0, 1, ())


def test_arcs_count_by_the_steps_between_them() -> None:
    """Three arcs: directions meet, curvature steps; E3 by steps over distances of middles."""
    bends, sizes = np.array([0.1, 0.3, 0.2]), np.array([2.0, 1.0, 4.0])
    start, angle = [np.zeros(2)], [0.0]
    for bend, size in zip(bends[:-1], sizes[:-1], strict=True):
        arc = PlaneArcs.make([start[-1]], [angle[-1]], [bend], [size])
        start.append(arc.ends()[0])
        angle.append(float(arc.end_angles()[0]))
    record = criteria(ArcFairnessPieces(PlaneArcs.make(start, angle, bends, sizes)))[0]
    assert record.length == pytest.approx(7.0)
    assert record.bending == pytest.approx(7.0 * float((bends**2) @ sizes))
    assert record.variation == pytest.approx(343.0 * (0.04 / 1.5 + 0.01 / 2.5))
    assert record.support_jumps is None
    assert (record.extrema, record.inflections, record.curvature_at) == (1, 0, 1)
    assert record.angle_jump < 1e-15


def test_an_elastica_is_smooth_within() -> None:
    """Its bending is its energy times its length; nothing jumps."""
    rod = fit_elastica([0, 0], [1, 0], 0.5, -0.3)
    record = criteria(ElasticaFairnessPieces((rod,)))[0]
    assert record.bending == pytest.approx(rod.energy * rod.length, rel=1e-12)
    assert record.failed == ()


def waves(seed: int, count: int) -> SplineBatch:
    """Plane curves of the kernel."""
    rng = np.random.default_rng(seed)
    parts = []
    for _ in range(count):
        n = int(rng.integers(3, 20))
        y = rng.uniform(-0.2, 0.2, n)
        parts.append(loft(CurveData.single(np.column_stack([np.arange(n), y, 0.0 * y]))))
    return SplineBatch.join(parts)


def test_a_neighbour_in_the_batch_changes_no_number() -> None:
    """A curve has the same record alone and among 30 others, to the bit."""
    batch = waves(4, 30)
    together = criteria(SplinePieces.of(batch, UP))
    alone = [criteria(SplinePieces.of(batch.curve(i), UP))[0] for i in range(30)]
    assert list(together) == alone


def test_a_curve_in_space_has_no_inflection() -> None:
    """Laid flat, a plane curve seen in space has the same bending, and no count of signs."""
    batch = waves(5, 6)
    plane = criteria(SplinePieces.of(batch, UP))
    space = criteria(SplinePieces.of(batch, np.full((6, 3), np.nan)))
    for one, other in zip(plane, space, strict=True):
        assert other.inflections is None
        assert other.passed["inflections"] is None
        assert other.bending == pytest.approx(one.bending, rel=1e-12)
        assert other.variation == pytest.approx(one.variation, rel=1e-9)


@pytest.mark.parametrize(
    "pieces",
    [
        pytest.param(GraphPieces.of(PPoly(np.array([[0.0], [0.0]]), [0, 4])), id="graph"),
        pytest.param(ArcFairnessPieces(PlaneArcs.make([(0, 0)], [0.0], [0.0], [4.0])), id="arcs"),
        pytest.param(
            chord_spline_pieces(ChordSpline.through([(0, 0), (1, 0), (4, 0)])), id="chords"
        ),
        pytest.param(ElasticaFairnessPieces((fit_elastica([0, 0], [4, 0], 0, 0),)), id="elastica"),
    ],
)
def test_offsets_are_measured_from_any_curve(pieces: PiecewiseCurves) -> None:
    """On a straight line 4 m long: distance over tolerance, the largest and the mean."""
    points, tolerances = [(1.0, 0.003), (2.0, -0.004), (7.0, 4.0)], [0.005, 0.010, 10.0]
    offsets = OffsetDeviations.measured(pieces, points, tolerances)
    record = criteria(pieces, offsets=offsets)[0]
    assert record.offsets == 3
    assert record.deviation_max == pytest.approx(0.6, abs=1e-9)
    assert record.deviation_rms == pytest.approx(np.sqrt((0.36 + 0.16 + 0.25) / 3.0), abs=1e-9)
    assert record.passed["deviation"] is True
    assert record.inflections == record.extrema == 0
    tight = criteria(pieces, offsets=OffsetDeviations.measured(pieces, points, 0.0025))[0]
    assert tight.failed == ("deviation",)


def test_a_curve_without_length_is_refused() -> None:
    """One line, with the name of the curve."""
    point = SplineBatch(np.array([0, 2]), np.array([0.0, 1.0]), *np.zeros((3, 2, 3)))
    with pytest.raises(GeometryError, match=r"^fairness: curve has no length, WL 0; leave it out"):
        criteria(SplinePieces.of(point, UP), names=("WL 0",))


@pytest.mark.parametrize(
    ("points", "tolerances", "message"),
    [
        pytest.param(
            [(0, 0), (1, 1)], [0.1, 0.1, 0.1],
            "fairness: offsets and tolerances differ in length", id="other counts",
        ),
        pytest.param([(0, 0)], 0.0, "fairness: tolerances must be above 0", id="no tolerance"),
        pytest.param([(0, np.nan)], 1.0, "fairness: offsets are not points", id="not finite"),
        pytest.param([0, 1], 1.0, "fairness: offsets are not points", id="flat"),
        pytest.param("a", 1.0, "fairness: offsets are not points", id="text"),
    ],
)  # fmt: skip
def test_offsets_that_are_none_are_refused(
    points: object, tolerances: object, message: str
) -> None:
    """One line that says what is wrong."""
    pieces = chord_spline_pieces(ChordSpline.through([(0, 0), (4, 0)]))
    with pytest.raises(GeometryError) as refused:
        OffsetDeviations.measured(pieces, points, tolerances)  # type: ignore[arg-type]
    assert str(refused.value).startswith(message)


@given(
    arrays(np.float64, st.integers(0, 30), elements=st.floats(-1.0, 1.0)),
    st.integers(0, 4), st.integers(1, 3),
)  # fmt: skip
def test_without_small_waves_no_more_signs_change_than_are_left(
    value: FloatArray, most: int, parts: int
) -> None:
    """What changes no more often keeps its signs; curves of one line are counted together."""
    curve = np.sort(np.arange(len(value)) % parts)
    found = signs_without_waves(value, np.abs(value), curve, most)

    def changes(sign: FloatArray) -> int:
        some = sign != 0.0
        kept, owner = sign[some], curve[some]
        return int(((kept[1:] != kept[:-1]) & (owner[1:] == owner[:-1])).sum())

    own = np.where(np.abs(value) > DEAD_BAND, np.sign(value), 0.0)
    assert changes(found.astype(np.float64)) <= most
    if changes(own) <= most:
        beyond = own != 0.0
        assert (found[beyond] == own[beyond]).all()

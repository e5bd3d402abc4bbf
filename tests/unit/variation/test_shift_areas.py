"""The closed form of section shifts, on curves of areas known by formulas."""

from collections.abc import Callable
from itertools import pairwise

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.interpolate import PchipInterpolator

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.shipped.series60 import todd_table
from assoc_hull.variation.fields.shift_shapes import Polyline
from assoc_hull.variation.shifts.closed_form import (
    CertifiedShift,
    HalfBodyTask,
    WholeHullTask,
    closed_form,
)
from assoc_hull.variation.shifts.lackenby import half_bodies, lackenby_changes
from assoc_hull.variation.shifts.shift_terms import (
    SHIFT_SHAPES,
    Fade,
    ShiftShape,
    ShiftTerms,
    Terminals,
)
from assoc_hull.variation.shifts.shifted_areas import ShiftSums, VolumeElements
from tests.long_forms import draws

TABLE = todd_table(0.70)[0]
L, T = TABLE.length, TABLE.draught or 0.0
BLOCK = L * TABLE.breadth * T
AREAS = np.array([
    2.0 * float(PchipInterpolator(TABLE.z, row).integrate(0.0, T))
    for row in TABLE.half_breadth
])  # fmt: skip
CURVE = PchipInterpolator(TABLE.x, AREAS)
"""Series 60 .70 between the perpendiculars: areas by pchip over z, and along the ship."""

PLACES = Terminals(0.0, 0.50 * L, 0.55 * L, L)
"""The ends, and the two stations with the largest areas."""


def whole(
    cb: float, lcb: float, shape: ShiftShape = "c2", **moves: float
) -> tuple[WholeHullTask, ShiftTerms]:
    """Give a task on Series 60: changes of CB, and of LCB in % Lpp."""
    terms = ShiftTerms(PLACES, shape, moves.get("start", 0.0), moves.get("end", 0.0))
    elements = VolumeElements.of(CURVE, np.append(TABLE.x, terms.nodes), 0.5 * L)
    return WholeHullTask(elements, ShiftSums.of(elements, terms), BLOCK, L, cb, lcb), terms


def carried(shift: CertifiedShift) -> tuple[float, float]:
    """Integrate the carried curve on its own: CB, and LCB in % Lpp, of A at x + delta(x).

    By the trapezoidal rule on moved places, with one step of Richardson: no derivative is used.
    """
    found = []
    for parts in (2000, 4000):
        x = np.unique(np.concatenate([
            np.linspace(low, high, parts + 1)
            for low, high in zip(TABLE.x[:-1].tolist(), TABLE.x[1:].tolist(), strict=True)
        ]))  # fmt: skip
        moved, area = x + shift.moved(x), CURVE(x)
        step = np.diff(moved)
        volume = float((0.5 * (area[1:] + area[:-1]) * step).sum())
        levers = moved * area
        found.append((volume, float((0.5 * (levers[1:] + levers[:-1]) * step).sum())))
    volume, moment = ((4.0 * fine - coarse) / 3.0 for coarse, fine in zip(*found, strict=True))
    return volume / BLOCK, 100.0 * (moment / volume / L - 0.5)


def test_the_parent_has_the_published_coefficients() -> None:
    """CB and LCB of Series 60 .70 as the rule sums them."""
    elements = whole(0.0, 0.0)[0].elements
    assert f"{elements.total / BLOCK:.10f}" == "0.6988217541"
    assert f"{100.0 * (elements.moment / elements.total / L - 0.5):.10f}" == "0.4793382263"


@pytest.mark.parametrize(
    ("shape", "fore", "aft", "least", "largest"),
    [
        ("lackenby", "0.0869783774", "-0.0271710918", "0.807", "2.17"),
        ("c1", "0.0267981089", "-0.0080788994", "0.817", "2.68"),
        ("c2", "0.0310646070", "-0.0091865187", "0.763", "3.11"),
    ],
)
def test_sizes_of_three_shapes(
    shape: ShiftShape, fore: str, aft: str, least: str, largest: str
) -> None:
    """+.02 CB and +.5 % LCB together: sizes, least 1 + delta' and largest movement, in L."""
    found = closed_form(*whole(0.02, 0.5, shape))
    assert [f"{each / L:.10f}" for each in found.sizes.tolist()] == [fore, aft]
    assert f"{found.least:.3f}" == least
    assert f"{100.0 * found.largest / L:.2f}" == largest
    assert found.certificate.bound > 0.0


@pytest.mark.parametrize("shape", SHIFT_SHAPES)
def test_the_carried_curve_has_what_was_asked_for(shape: ShiftShape) -> None:
    """Integrated on its own, without the sums of the closed form."""
    task, terms = whole(0.02, 0.5, shape)
    elements = task.elements
    cb, lcb = carried(closed_form(task, terms))
    assert cb == pytest.approx(elements.total / BLOCK + 0.02, abs=1e-13)
    before = 100.0 * (elements.moment / elements.total / L - 0.5)
    assert lcb == pytest.approx(before + 0.5, abs=4e-12)


@settings(max_examples=draws(25))
@given(
    heights=st.lists(st.floats(0.1, 1.0), min_size=4, max_size=4),
    shape=st.sampled_from(SHIFT_SHAPES),
    fade=st.sampled_from(("b5", "linear")),
    sizes=st.lists(st.floats(-3.0, 3.0), min_size=4, max_size=4),
)
def test_volume_and_moment_are_exact_for_any_curve(
    heights: list[float], shape: ShiftShape, fade: Fade, sizes: list[float]
) -> None:
    """Also where it jumps at both ends, and the ends of the parallel body move."""
    x = np.array([-2.0, 15.0, 38.0, 60.0, 80.0, 103.0])
    area = PchipInterpolator(x, 100.0 * np.array([heights[0], heights[1], 1, 1, *heights[2:]]))
    terms = ShiftTerms(Terminals(0.0, 38.0, 60.0, 100.0), shape, sizes[0], sizes[1], fade)
    sums = ShiftSums.of(VolumeElements.of(area, np.append(x, terms.nodes), 50.0), terms)
    found = np.array(sizes[2:])

    def carried_by(parts: int) -> tuple[float, float]:
        """Give V' and M' of the moved places, by Simpson's rule over their own parameter."""
        ends = np.unique(np.append(x, terms.nodes))
        volume = moment = 0.0
        for low, high in pairwise(ends.tolist()):
            t = np.linspace(low, high, 2 * parts + 1)
            inner = np.clip(t, low + 1e-12, high - 1e-12)
            moved, slope = t.copy(), np.ones_like(t)
            for course in terms.sized(*found.tolist()):
                moved, slope = moved + course.at(t), slope + course.slope(inner)
            weight = np.tile([2.0, 4.0], parts + 1)[: len(t)]
            weight[[0, -1]] = 1.0
            dv = weight * area(t) * slope * (high - low) / (6.0 * parts)
            volume, moment = volume + float(dv.sum()), moment + float((moved * dv).sum())
        return volume, moment

    volume, moment = carried_by(400)
    assert sums.volume_at(found) == pytest.approx(volume, rel=1e-9)
    assert sums.moment_at(found) == pytest.approx(moment, rel=1e-9)


def test_the_published_formulas_miss_the_centre() -> None:
    """They give CB exactly, and LCB 0.0177 % of L too far forward: squares are neglected."""
    elements = whole(0.0, 0.0)[0].elements
    fore, aft = half_bodies(elements, L, (0.1, 0.0))
    asked = lackenby_changes(fore, aft, 0.02 * BLOCK / (elements.area * L), 0.01)
    moved, half = np.zeros(len(elements.x)), 0.5 * L
    slope = moved.copy()
    for sign, body, change in zip((1.0, -1.0), (fore, aft), asked, strict=True):
        x = sign * (elements.x - elements.middle) / half
        acts = x > body.parallel
        moved += np.where(acts, sign * half * body.lackenby(x, change), 0.0)
        slope += np.where(acts, (1.0 + body.parallel - 2.0 * x) / body.area * change, 0.0)
    volume = float((elements.volume * (1.0 + slope)).sum())
    moment = float((elements.volume * (1.0 + slope) * (elements.x + moved)).sum())
    assert volume / BLOCK == pytest.approx(elements.total / BLOCK + 0.02, abs=1e-15)
    beside = 100.0 * (moment / volume - elements.moment / elements.total) / L - 0.5
    assert f"{beside:+.4f}" == "+0.0177"


@pytest.mark.parametrize(
    ("lcb", "cb", "end"),
    [
        # where c_f reaches the length of the fore body, or the sections of the after body meet
        (0.0, 0.3, 0.1584476), (0.0, -0.3, -0.1586972), (0.5, 0.3, 0.1481814),
        (0.5, -0.3, -0.1622360),
    ],
)  # fmt: skip
def test_the_largest_change_of_cb_is_told(lcb: float, cb: float, end: float) -> None:
    """What crosses is refused with the place, and the range of CB beside this LCB."""
    with pytest.raises(OutOfRangeError, match=r"makes sections cross at x=.* m \(1\+delta'=-") as e:
        closed_form(*whole(cb, lcb, "lackenby"))
    error = e.value
    assert (error.value, error.unit) == (cb, "in CB")
    assert (error.most if cb > 0.0 else error.least) == pytest.approx(end, abs=1e-6)
    assert isinstance(closed_form(*whole(0.9999 * end, lcb, "lackenby")), CertifiedShift)


def test_a_centre_that_cannot_be_had_is_told() -> None:
    """LCB +12 % Lpp: refused, with the range of LCB beside this CB; it can be had to its end."""
    with pytest.raises(OutOfRangeError) as e:
        closed_form(*whole(0.02, 12.0, "lackenby"))
    assert "a change of 12 % Lpp in LCB makes sections cross" in str(e.value)
    assert "beside +0.02 in CB" in str(e.value)
    assert isinstance(closed_form(*whole(0.02, 0.9999 * e.value.most, "lackenby")), CertifiedShift)
    with pytest.raises(OutOfRangeError):
        closed_form(*whole(0.02, 1.0001 * e.value.most, "lackenby"))


def test_no_root_is_out_of_reach() -> None:
    """A quadratic that has no root is refused with what it can give, not guessed."""
    task, terms = whole(0.0, -0.5, "lackenby")
    # whatever c_f = c_a is, the moment grows
    bowl = attrs.evolve(
        task.sums, alpha=np.array([1.0, -1.0]), beta=np.zeros(2), gamma=np.diag([200.0, 200.0])
    )
    task = attrs.evolve(task, sums=bowl)
    assert task.sizes(task.changes) is None
    with pytest.raises(OutOfRangeError, match="is out of reach: no shift gives it") as e:
        closed_form(task, terms)
    assert e.value.least == pytest.approx(0.0, abs=1e-6)
    assert e.value.most > 0.1


def test_ends_of_the_parallel_body_move_alone() -> None:
    """+.02 L at the fore end: volume and centre stay to rounding, and the end moves by that."""
    task, terms = whole(0.0, 0.0, "lackenby", end=0.02 * L)
    found = closed_form(task, terms)
    elements = task.elements
    assert task.sums.volume_at(found.sizes) == pytest.approx(elements.total, rel=1e-14)
    assert task.sums.moment_at(found.sizes) == pytest.approx(elements.moment, rel=1e-14)
    ends = found.moved(PLACES.places)
    assert ends.tolist() == [0.0, 0.0, 0.02 * L, 0.0]
    assert carried(found)[1] == pytest.approx(0.4793382263, abs=1e-9)


def test_bodies_are_shifted_on_their_own() -> None:
    """CP of the fore body alone: the after body does not move."""
    terms = ShiftTerms(PLACES)
    elements = VolumeElements.of(CURVE, np.append(TABLE.x, terms.nodes), 0.5 * L)
    prism = 0.5 * L * elements.area
    found = closed_form(
        HalfBodyTask(elements, ShiftSums.of(elements, terms), prism, 0.01, 0.0), terms
    )
    assert found.sizes[1] == 0.0
    gained = ShiftSums.of(elements, terms).by_body @ found.sizes
    assert gained == pytest.approx([0.01 * prism, 0.0], abs=1e-9)
    assert carried(found)[0] == pytest.approx(
        (elements.total + 0.01 * prism) / BLOCK, abs=1e-12
    )  # fmt: skip


def test_a_curve_that_jumps_is_summed_with_its_jump() -> None:
    """A transom of 40 m2 that moves takes its area along: by parts as much as by A'."""
    terms = ShiftTerms(Terminals(-5.0, 40.0, 60.0, 100.0), "lackenby")

    def area(x: FloatArray) -> FloatArray:
        return np.where(x >= 0.0, 40.0 + 0.02 * x * (100.0 - x), 0.0)

    sums = ShiftSums.of(VolumeElements.of(area, [-5.0, 0.0, *terms.nodes], 50.0), terms)

    def product(f: Callable[[float], float], low: float, high: float) -> float:
        return float(quad(lambda x: -0.02 * (100.0 - 2.0 * x) * f(x), low, high)[0])

    def e_a(x: float) -> float:
        return float(terms.aft.at(np.array([x]))[0])

    assert sums.alpha[1] == pytest.approx(product(e_a, 0.0, 40.0) - 40.0 * e_a(0.0), rel=1e-12)
    beta = product(lambda x: x * e_a(x), 0.0, 40.0)
    assert sums.beta[1] == pytest.approx(beta, rel=1e-12)
    gamma = product(lambda x: e_a(x) ** 2, 0.0, 40.0) - 40.0 * e_a(0.0) ** 2
    assert sums.gamma[1, 1] == pytest.approx(gamma, rel=1e-12)


def test_nothing_moves_beyond_the_terminals() -> None:
    """Not by a bit, whatever the shape; places there keep their numbers."""
    x = np.array([-4.0, 0.0, L, L + 1.25])
    for shape in SHIFT_SHAPES:
        shift = closed_form(*whole(0.02, 0.5, shape))
        assert (shift.moved(x) == 0.0).all()


@pytest.mark.parametrize(
    ("places", "says"),
    [
        ([0.0, 50.0, 60.0], "terminals are 3 numbers"),
        ([0.0, 60.0, 50.0, 100.0], "do not rise"),
        ([0.0, 50.0, 60.0, float("nan")], "nan"),
    ],
)
def test_terminals_that_are_none(places: list[float], says: str) -> None:
    """Refused in one line, with what is wrong."""
    with pytest.raises(BadInputError, match=says):
        Terminals.of(places)


def test_straight_lines_are_level_outside() -> None:
    """Also infinitely far, where regions are asked for; bounds hold the nodes between."""
    line = Polyline(np.array([0.0, 10.0, 30.0]), np.array([0.0, 2.0, 0.5]))
    x = np.array([-np.inf, -1.0, 0.0, 5.0, 10.0, 20.0, 30.0, np.inf])
    assert line.at(x).tolist() == [0.0, 0.0, 0.0, 1.0, 2.0, 1.25, 0.5, 0.5]
    assert line.slope(x).tolist() == [0.0, 0.0, 0.2, 0.2, -0.075, -0.075, 0.0, 0.0]
    low, high = np.array([-np.inf, 5.0, 12.0]), np.array([np.inf, 20.0, 14.0])
    assert [each.tolist() for each in line.bounds(low, high)] == [[0.0, 1.0, 1.7], [2.0, 2.0, 1.85]]
    slopes = line.slope_bounds(low, high)
    assert [each.tolist() for each in slopes] == [[-0.075, -0.075, -0.075], [0.2, 0.2, -0.075]]

"""Sections of ordinates: areas, form, what is refused and what is remarked."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.ordinate_section import FORMS, OrdinateSection, PairedParabolas

GIVEN: dict[str, Any] = {
    "hb": 0.9, "sb": 3.0, "sw": 2.0, "hd": 12.4, "bd": 15.2, "cam": 0.4,
    "zb": [0.0, 0.02, 0.10, 0.31, 0.80], "yw": [12.3, 14.2, 14.8, 15.0, 15.1, 15.2, 15.2],
}  # fmt: skip
KEEL_UP: dict[str, Any] = {"hb": 13.0, "zb": [0.5], "yw": [0.0, 3.0, 4.0, 4.5, 4.6, 4.6, 4.6]}
"""No main part: half-breadths from the keel up."""


def section(**other: object) -> OrdinateSection:
    """The section of the printed values, with others."""
    return OrdinateSection.make(**(GIVEN | other))


@pytest.fixture(scope="module")
def seen() -> OrdinateSection:
    """The section of the printed values."""
    return section()


PRINTED: dict[str, tuple[Callable[[OrdinateSection], float], float]] = {
    "bottom": (lambda s: s.bottom_area, 8.495000000000001),
    "main": (lambda s: s.main_area, 168.99739583333334),
    "camber": (lambda s: s.camber_area, 4.053333333333333),
    "full": (lambda s: s.area, 363.0914583333334),
    "breadth at the deck side": (lambda s: s.deck_breadth, 15.209375),
    "last waterline": (lambda s: s.side.last, 12.9),
}


@pytest.mark.parametrize("name", PRINTED)
def test_printed_values_of_a_section(seen: OrdinateSection, name: str) -> None:
    """To all digits of a double but the last ones."""
    of, printed = PRINTED[name]
    assert of(seen) == pytest.approx(printed, rel=1e-14)
    assert seen.notes == ()


def test_areas_are_those_of_simpsons_rule(seen: OrdinateSection) -> None:
    """Where the deck lies on the last waterline of a pair; of heights without any condition."""
    zb, yw = GIVEN["zb"], GIVEN["yw"]
    assert seen.bottom is not None
    rule = 3.0 / 3.0 * (zb[0] + 4 * zb[1] + 2 * zb[2] + 4 * zb[3] + zb[4])
    assert seen.bottom.integral() == pytest.approx(rule, rel=1e-14)
    rule = 2.0 / 3.0 * (yw[0] + 4 * yw[1] + 2 * yw[2] + 4 * yw[3] + yw[4])
    assert section(hd=8.9).main_area == pytest.approx(rule, rel=1e-14)


def test_the_curve_passes_all_ordinates(seen: OrdinateSection) -> None:
    """Heights on buttocks, half-breadths on waterlines, the deck side at its end."""
    outline = seen.outline()
    np.testing.assert_allclose(outline[:5, 1], GIVEN["zb"], atol=1e-15)
    np.testing.assert_allclose(outline[5:-1, 0], GIVEN["yw"][:6], atol=1e-15)
    np.testing.assert_allclose(outline[-1], [15.209375, 12.4])
    np.testing.assert_allclose(seen.height([0.0, 6.0, 12.0]), [0.0, 0.10, 0.80], atol=1e-15)
    assert float(seen.half_breadth(4.9)) == pytest.approx(14.8)


def test_the_curve_bends_at_even_ordinates_only(seen: OrdinateSection) -> None:
    """Slopes before and after are the same inside a pair, and differ where two pairs meet."""
    before, after = seen.side.slopes().T
    corner = np.abs(after - before)
    assert corner[[1, 3, 5]].max() < 1e-14
    assert corner[[2, 4]].min() > 0.01


def test_steps_of_the_outline_join(seen: OrdinateSection) -> None:
    """Each ends where the next begins, and the joining line is straight."""
    steps = seen.steps()
    np.testing.assert_allclose(steps[:-1].sum(axis=1), steps[1:, 0], atol=1e-14)
    assert not steps[4, 2].any()


@pytest.mark.parametrize("last", [0.8, 0.4])
def test_the_moment_is_that_of_the_outline(last: float) -> None:
    """Area times centroid by a sum of thin layers from the areas below, and of the camber."""
    seen = section(zb=[0.0, 0.02, 0.10, 0.31, last], yw=[15.0, *GIVEN["yw"][1:]])
    z = np.concatenate([np.linspace(0.0, 0.9, 200), np.linspace(0.92, 12.4, 150)])
    below = np.array([seen.area_below(each) for each in z.tolist()])
    layers = float(12.4 * below[-1] - np.trapezoid(below, z))
    y = np.linspace(0.0, 15.2, 2001)
    top = seen.camber(y)
    camber = float(np.trapezoid(top * top - 12.4**2, y))
    assert seen.moment == pytest.approx(layers + camber, rel=4e-6)
    assert below[-1] == pytest.approx(2.0 * (seen.bottom_area + seen.main_area), rel=1e-14)


def test_the_area_below_a_height_of_a_straight_floor() -> None:
    """Where parabolas are straight lines: a triangle."""
    wedge = section(zb=[0.0, 0.125, 0.25, 0.375, 0.5], yw=[12.0, *GIVEN["yw"][1:]])
    assert wedge.area_below(0.3) == pytest.approx(0.3 * 7.2, rel=1e-12)


@pytest.mark.parametrize("level", [-0.1, 0.0, 0.05, 0.5, 0.85, 0.9, 3.3, 12.4])
def test_the_area_below_a_height(level: float) -> None:
    """By counting a fine lattice of columns below, and layers above; also where heights dip."""
    found = section(zb=[0.1, 0.02, 0.10, 0.31, 0.80])
    assert found.bottom is not None
    y = np.linspace(0.0, 12.0, 40001)
    wet = np.trapezoid(np.maximum(min(level, 0.9) - found.height(y), 0.0), y)
    close = max(min(level, 0.9) - 0.8, 0.0)
    wet += 0.5 * close * close * 0.3 / 0.1
    if level > 0.9:
        z = np.linspace(0.9, level, 40001)
        wet += np.trapezoid(found.half_breadth(z), z)
    assert found.area_below(level) == pytest.approx(2.0 * float(wet), abs=2e-6)


def test_three_forms() -> None:
    """With buttocks; from the keel at hb up; from a keel of its own up, without main part."""
    assert section().form == FORMS[0]
    flat = section(zb=[], nb=0)
    assert (flat.form, flat.bottom_area) == (FORMS[1], 0.0)
    assert flat.outline()[:2].tolist() == [[0.0, 0.9], [12.3, 0.9]]
    keel = section(**KEEL_UP)
    assert (keel.form, keel.keel, keel.side.first) == (FORMS[2], 0.5, 0.5)
    assert section(**KEEL_UP, form=FORMS[2]).area == keel.area
    assert keel.outline()[0].tolist() == [0.0, 0.5]


def test_an_odd_last_step_has_the_parabola_of_three() -> None:
    """Five eighths and minus one twelfth, mirrored, of the last step."""
    curve = PairedParabolas.make("odd", 1.0, 2.0, [1.0, 4.0, 9.0, 20.0])
    assert curve.integral(5.0, 7.0) == pytest.approx(2.0 * (5 * 20 + 8 * 9 - 4) / 12)
    assert curve.integral(1.0, 5.0) == pytest.approx(2.0 * (1 + 16 + 9) / 3)
    assert curve.integral() == pytest.approx(curve.integral(1.0, 4.2) + curve.integral(4.2, 7.0))


def test_parabolas_are_their_equation() -> None:
    """f0 (t - 1)(t - 2)/2 - f1 t (t - 2) + f2 t (t - 1)/2, scalars and arrays alike."""
    curve = PairedParabolas.make("f", 0.0, 1.0, [2.0, -1.0, 5.0])
    t = np.array([[0.0, 0.3], [1.2, 2.0]])
    wanted = 2 * (t - 1) * (t - 2) / 2 + t * (t - 2) + 5 * t * (t - 1) / 2
    np.testing.assert_allclose(curve.at(t), wanted, atol=1e-14)
    assert curve.at(0.3).shape == ()


REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "few buttocks": (
        lambda: section(zb=[0.0, 0.1, 0.2, 0.3]),
        "section: bottom part needs at least 4 buttocks, got 3",
    ),
    "few waterlines": (
        lambda: section(yw=[12.3, 15.0]),
        "section: main part needs at least 3 waterlines, got 2",
    ),
    "low last waterline": (
        lambda: section(hd=12.9),
        "section: last waterline z=12.9 must be above the deck side 12.9",
    ),
    "no main part and low bottom": (
        lambda: section(**(KEEL_UP | {"hb": 12.0}), form=FORMS[2]),
        "section: without main part the bottom appendage height 12 must exceed the deck side "
        "height 12.4",
    ),
    "no main part and no keel": (
        lambda: section(**(KEEL_UP | {"zb": []})),
        "section: without main part the height of the keel is missing",
    ),
    "last buttock high": (
        lambda: section(zb=[0.0, 0.02, 0.1, 0.31, 0.95]),
        "section: last buttock height 0.95 above hb 0.9",
    ),
    "negative half-breadth": (
        lambda: section(yw=[12.3, 14.2, -1.0, 15.0, 15.1, 15.2, 15.2]),
        "section: negative half-breadth at waterline 2",
    ),
    "buttocks without a bottom part": (
        lambda: section(form=FORMS[1]), "section: 4 buttocks in the form main+camber"
    ),
    "unknown form": (lambda: section(form="deck"), "section: no form 'deck'"),
    "deck below the bottom part": (
        lambda: section(hd=0.8), "section: deck side 0.8 is not above 0.9"
    ),
    "keel apart from the main part": (
        lambda: section(zb=[0.5], nb=0),
        "section: keel at 0.5, but the main part begins at 0.9",
    ),
    "negative deck": (lambda: section(bd=-1.0), "section: negative deck half-breadth -1"),
    "no spacing of buttocks": (
        lambda: section(sb=0.0), "section: buttock spacing 0 is not above 0"
    ),
    "no spacing of waterlines": (
        lambda: section(sw=-2.0), "section: waterline spacing -2 is not above 0"
    ),
    "another count": (
        lambda: section(nb=5), "section heights: expected shape (6), got (5,)"
    ),
    "a count that is none": (lambda: section(nw=1.5), "section: 1.5 waterlines"),
    "no number": (
        lambda: section(yw=[12.3, float("nan"), 15.0]),
        "section: non-finite value at index 1",
    ),
    "no size": (lambda: section(hd=float("inf")), "section hd: non-finite value at index 0"),
    "a table": (lambda: section(yw=[[1.0, 2.0]]), "section: expected shape (n), got (1, 2)"),
    "above the last waterline": (
        lambda: section().half_breadth(13.0), "section side: x=13 outside [0.9, 12.9]"
    ),
    "beyond the last buttock": (
        lambda: section().height(12.5), "section bottom: x=12.5 outside [0, 12]"
    ),
    "height without buttocks": (
        lambda: section(zb=[], nb=0).height(1.0),
        "section: no buttocks are given in the form main+camber",
    ),
    "beyond the deck": (
        lambda: section().camber(16.0), "camber: |y|=16 exceeds half-breadth 15.2"
    ),
    "area above the deck": (
        lambda: section().area_below(13.0), "section: z=13 above the deck side 12.4"
    ),
    "parabola of two": (
        lambda: PairedParabolas.make("p", 0.0, 1.0, [1.0, 2.0]), "p: at least 3 values, got 2"
    ),
    "parabolas without a step": (
        lambda: PairedParabolas.make("p", 0.0, 0.0, [1.0, 2.0, 3.0]),
        "p: spacing 0 is not above 0",
    ),
    "even Simpson": (
        lambda: PairedParabolas.make("p", 0.0, 1.0, [1.0, 2.0, 3.0, 4.0]).simpson(),
        "p: Simpson's first rule needs an odd number, got 4",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_makes_no_section_is_refused(case: str) -> None:
    """With these words."""
    call, what = REFUSED[case]
    with pytest.raises(GeometryError) as caught:
        call()
    assert caught.value.what == what
    assert caught.value.remedy


REMARKED: dict[str, tuple[dict[str, object], str]] = {
    "last buttock low": (
        {"zb": [0.0, 0.02, 0.1, 0.31, 0.7]},
        "section: last buttock height 0.7 differs from hb 0.9 by more than 0.15 hb",
    ),
    "heights that fall": (
        {"zb": [0.0, 0.05, 0.02, 0.31, 0.8]},
        "section: buttock heights decrease at buttock 2",
    ),
    "a main part inside the bottom": (
        {"yw": [11.9, 14.2, 14.8, 15.0, 15.1, 15.2, 15.2]},
        "section: the first waterline ends at y=11.9, inside the last buttock at 12",
    ),
    "another deck breadth": (
        {"bd": 15.0},
        "section: y(hd)=15.209375 at the deck side differs from bd=15 by more than 0.001 bd",
    ),
    "negative camber": (
        {"cam": -0.4}, "section: camber -0.4 is negative: the deck falls inboard"
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REMARKED)
def test_what_is_odd_is_remarked(case: str) -> None:
    """One sentence, and the section is made."""
    other, note = REMARKED[case]
    assert section(**other).notes == (note,)


def test_limits_of_remarks_lie_where_they_are_said() -> None:
    """0.15 hb and 0.001 bd are still unremarked."""
    assert section(zb=[0.0, 0.02, 0.1, 0.31, 0.9 * 0.8501]).notes == ()
    assert section(bd=15.209375 / 1.0009).notes == ()
    assert section(bd=15.209375 / 1.0011).notes != ()

"""Records and equilibria of hulls that are known by formula, against the reference table."""

import attrs
import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.hydrostatics.draughts_from_weight import Load, position_under_load
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import table_of
from assoc_hull.geometry.floating.immersed_strips import prepare_strips
from tests.exact_hulls import ellipsoid, wigley
from tests.floating_bodies import StripBody, head


@pytest.fixture(scope="module")
def hulls() -> dict[str, StripBody]:
    """Wigley's hull and the ellipsoid."""
    return {
        "W": StripBody.of(prepare_strips(wigley()), 5.0, 12.5),
        "E": StripBody.of(prepare_strips(ellipsoid()), 0.0, 12.0),
    }


# T0, tan trim, heel; V, LCB, TCB, KB, A, LCF, TCF, I_T, I_L, S; A and I in plan
REFERENCE = """
W 6.25 0 0 2777.777778 50 0 3.90625 666.6666667 50 0 3809.523810 333333.3333 1487.906310
W 5.75 .01 0 2777.822222 51.19943224 0 3.912283289 666.24 50.02001281 0 3805.467404 332875.9236 1487.901368
W 6.25 0 10 2778.937122 50 -.2398333209 3.928290040 662.2587599 50 -.02930814247 3721.551134 332097.1863 1488.425283
W 5.75 .01 10 2779.148630 51.19442708 -.2395686140 3.934394081 661.8504555 50.06492324 -.03097947177 3717.928297 331649.9446 1488.460423
W 5 0 20 1995.705439 50 -.5894296404 3.323434436 613.6724726 50 -.3300479257 2921.071429 312300.7617 1246.048500
E 4 .02 10 3829.376232 53.74196224 -.8445553974 3.305787185 1176.525691 51.28238546 -.2894325192 17405.54843 698093.2735 1537.571084
"""  # noqa: E501
NAMES = [
    "volume",
    "lcb",
    "tcb",
    "kb",
    "waterplane_area_proj",
    "lcf",
    "tcf",
    "i_t_proj",
    "i_l_proj",
    "wetted_surface",
]
SCALES = {
    "W": [2778.0, 100, 10, 6.25, 667, 100, 10, 1e5, 1e7, 1488],
    "E": [5027.0, 100, 16, 6, 1257, 100, 16, 4e5, 1.6e7, 1751],
}


@pytest.mark.parametrize("row", REFERENCE.strip().splitlines())
def test_a_record_has_the_reference_values(row: str, hulls: dict[str, StripBody]) -> None:
    """To the digits that are printed of them: names, datum and signs are those of the table."""
    name, *numbers = row.split()
    height, slope, heel, *expected = map(float, numbers)
    position = FloatingPosition(height, height + 100 * slope, heel)
    found = table_of(hulls[name], [position], head(100.0, 10.0, 6.25))[0]
    seen = np.array([getattr(found, each) for each in NAMES])
    assert_allclose(seen / SCALES[name], np.array(expected) / SCALES[name], atol=1e-9)
    c2, s2 = 1 + slope**2, 1 + slope**2 + np.tan(np.radians(heel)) ** 2
    assert found.i_t == pytest.approx(s2**1.5 / c2 * found.i_t_proj, rel=1e-13)


def test_the_product_of_inertia_has_the_reference_value(hulls: dict[str, StripBody]) -> None:
    """I_LT in plan of the Wigley hull under trim and heel: 138.0870818 m4."""
    found = table_of(hulls["W"], [FloatingPosition(5.75, 6.75, 10.0)], head(100.0, 10.0, 6.25))
    assert found[0].i_lt_proj == pytest.approx(138.0870818, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "volume", "heel", "height"),
    [
        ("W", 2777.7777777778, 5.0, 6.2497832764),
        ("W", 2777.7777777778, 10.0, 6.2482493821),
        ("W", 2777.7777777778, 20.0, 6.2354083063),
        ("W", 2777.7777777778, 30.0, 6.1968273782),
        ("E", 3781.5467131, 10.0, 4.9727350625),
        ("E", 3781.5467131, 30.0, 4.7380203676),
        ("E", 3781.5467131, 60.0, 3.4833885216),
    ],
)
def test_a_weight_keeps_its_volume_under_heel(
    name: str, volume: float, heel: float, height: float, hulls: dict[str, StripBody]
) -> None:
    """The draughts at constant volume of the reference righting levers."""
    found = position_under_load(hulls[name], Load(volume, 1.0, heel_deg=heel), 100.0)
    assert found.draught_mean == pytest.approx(height, abs=2e-9)


@pytest.mark.parametrize(
    ("heel", "aft", "fore"),
    [
        (0.0, 5.8328504991, 6.6670720589),
        (10.0, 5.82942667, 6.66662470),
        (20.0, 5.81174616, 6.65818200),
        (30.0, 5.76462459, 6.62769033),
    ],
)
def test_the_wigley_hull_finds_its_trim(
    heel: float, aft: float, fore: float, hulls: dict[str, StripBody]
) -> None:
    """V = 2777.777778 m3, LCG 51 m, KG 4 m: buoyancy stands below gravity at right angles."""
    load = Load(2777.777777777778, 1.0, lcg=51.0, kg=4.0, heel_deg=heel)
    found = position_under_load(hulls["W"], load, 100.0)
    digits = 2e-10 if heel == 0.0 else 1e-8
    assert_allclose([found.draught_aft, found.draught_fore], [aft, fore], atol=digits)


def test_the_trim_of_a_weight_is_reached_from_any_side(hulls: dict[str, StripBody]) -> None:
    """Mirrored about amidships, the load gives mirrored draughts."""
    load = Load(2777.777777777778, 1.0, lcg=51.0, kg=4.0)
    one = position_under_load(hulls["W"], load, 100.0)
    other = position_under_load(hulls["W"], attrs.evolve(load, lcg=49.0), 100.0)
    assert other.draught_aft == pytest.approx(one.draught_fore, abs=1e-10)
    assert other.draught_fore == pytest.approx(one.draught_aft, abs=1e-10)

"""The record of hydrostatics: the algebra between integrals and what a designer reads."""

import attrs
import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.hydrostatics.floating_body import Appendage, FloatingPosition, planes_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import (
    CountingRule,
    HydrostaticIntegrals,
    RecordSetting,
    integral_changes,
    integrals_of,
    propagate,
    table_of,
    values_of,
)
from assoc_hull.analysis.hydrostatics.record import FIELDS, Hydrostatics
from assoc_hull.errors import BadInputError
from tests.floating_bodies import Box, Wigley, head

BOX, WIGLEY = Box(), Wigley()
BOX_HEAD, WIGLEY_HEAD = head(100.0, 20.0, 6.0), head(100.0, 10.0, 6.25)
SPEC = """
    volume displacement lcb lcb_percent tcb kb waterplane_area lcf tcf i_t i_l i_lt bmt bml kmt
    kml gmt gml tpc mtc wetted_surface wetted_surface_girth transom_area lwl bwl a_max x_a_max
    a_midship cb cm cx cp cvp cw cb_lwl cp_lwl draught_mean trim_by_stern waterplane_area_proj
    i_t_proj i_l_proj i_lt_proj
"""
SPEC_NAMES = SPEC.split()


def box(aft: float, fore: float, heel: float = 0.0, **given: object) -> Hydrostatics:
    """The box at one position."""
    facts = attrs.evolve(BOX_HEAD, **given)  # type: ignore[arg-type]
    return table_of(BOX, [FloatingPosition(aft, fore, heel)], facts)[0]


def test_the_record_has_the_agreed_names_in_their_order() -> None:
    """Names of the fields are those of the JSON document, and each is described."""
    assert [each.name for each in attrs.fields(Hydrostatics)] == [*SPEC_NAMES, "error", "notes"]
    assert list(FIELDS) == SPEC_NAMES
    assert all(each.symbol and each.unit and each.title and each.formula
               for each in FIELDS.values())  # fmt: skip


def test_the_wigley_hull_at_its_draught_has_its_closed_forms() -> None:
    """V = 4/9 L B T, KB = 5/8 T, A_W = 2/3 L B, I_T = 16/35 B^3 L / 12, I_L = B L^3 / 30."""
    found = table_of(WIGLEY, [FloatingPosition(6.25, 6.25)], WIGLEY_HEAD)[0]
    expected = {
        "volume": 4 / 9 * 6250, "displacement": 1.025 * 4 / 9 * 6250, "lcb": 50.0,
        "lcb_percent": 0.0, "tcb": 0.0, "kb": 5 / 8 * 6.25, "waterplane_area": 2 / 3 * 1000,
        "i_t": 16 / 35 * 1e3 * 100 / 12, "i_l": 10 * 1e6 / 30, "i_lt": 0.0, "cb": 4 / 9,
        "cm": 2 / 3, "cx": 2 / 3, "cp": 2 / 3, "cw": 2 / 3, "cvp": 2 / 3, "cb_lwl": 4 / 9,
        "cp_lwl": 2 / 3, "lwl": 100.0, "bwl": 10.0, "a_max": 2 / 3 * 62.5, "x_a_max": 50.0,
        "a_midship": 2 / 3 * 62.5, "wetted_surface": 1487.906310, "draught_mean": 6.25,
        "tpc": 1.025 * 2 / 3 * 10, "bmt": 16 / 35 * 1e5 / 12 / (4 / 9 * 6250),
    }  # fmt: skip
    assert_allclose([getattr(found, name) for name in expected], list(expected.values()),
                    rtol=1e-12, atol=1e-11)  # fmt: skip
    assert found.kmt is not None
    assert found.kmt - found.kb == pytest.approx(found.bmt, rel=1e-14)


@pytest.mark.parametrize(
    ("aft", "fore", "heel", "lcb", "tcb", "kb"),
    [
        (6.0, 6.0, 0.0, 50.0, 0.0, 3.0),
        (5.0, 7.0, 0.0, 52.77777778, 0.0, 3.027777778),
        (6.0, 6.0, 20.0, 50.0, -2.022056857, 3.367984254),
        (5.0, 7.0, 20.0, 52.77777778, -2.022056857, 3.395762032),
    ],
)
def test_a_box_has_the_values_of_the_reference_table(
    aft: float, fore: float, heel: float, lcb: float, tcb: float, kb: float
) -> None:
    """Its centroid in ship axes, its waterplane in plan; its ends are hull if they are counted."""
    found = box(aft, fore, heel, transom=True)
    seen = [found.volume, found.lcb, found.tcb, found.kb, found.waterplane_area_proj, found.lcf,
            found.tcf, found.i_t_proj, found.i_l_proj, found.wetted_surface]  # fmt: skip
    assert_allclose(seen, [12000, lcb, tcb, kb, 2000, 50, 0, 2e5 / 3, 5e6 / 3, 3440],
                    rtol=2e-10, atol=1e-10)  # fmt: skip
    assert found.transom_area == pytest.approx(240.0)
    assert box(aft, fore, heel).wetted_surface == pytest.approx(3200.0)


@pytest.mark.parametrize(("tt", "heel"), [(0.0, 0.0), (0.02, 0.0), (0.0, 20.0), (0.02, 20.0)])
def test_inertias_are_those_of_the_inclined_waterplane_itself(tt: float, heel: float) -> None:
    """Against sums over a cloud of places in the plane, in its own two perpendicular axes."""
    th = np.tan(np.radians(heel))
    found = box(6.0 - 50 * tt, 6.0 + 50 * tt, heel)
    nodes, weights = np.polynomial.legendre.leggauss(4)
    x, y = np.meshgrid(50 * (1 + nodes), 10 * nodes, indexing="ij")
    place = np.stack([x, y, tt * x - th * y], axis=-1)
    place -= [found.lcf, found.tcf, tt * found.lcf - th * found.tcf]
    normal = np.array([-tt, th, 1.0])
    area = 500.0 * np.outer(weights, weights) * np.linalg.norm(normal)
    ahead = np.array([1.0, 0.0, tt]) / np.hypot(1.0, tt)
    aside = np.cross(normal / np.linalg.norm(normal), ahead)
    xi, eta = place @ ahead, place @ aside
    expected = [area.sum(), (eta**2 * area).sum(), (xi**2 * area).sum(), (xi * eta * area).sum()]
    seen = [found.waterplane_area, found.i_t, found.i_l, found.i_lt]
    assert_allclose(seen, expected, rtol=1e-13, atol=1e-9)


def test_under_pure_heel_the_inertia_is_that_in_plan_over_the_cube_of_the_cosine() -> None:
    """BM of the box at 20 deg is 6.695 m, where the plan gives 5.5556 m."""
    found = box(6.0, 6.0, 20.0)
    cos = np.cos(np.radians(20.0))
    assert found.bmt == pytest.approx(66666.66667 / 12000 / cos**3, rel=1e-10)
    assert found.bmt == pytest.approx(6.695, abs=5e-4)
    assert found.waterplane_area == pytest.approx(2000 / cos, rel=1e-14)


def test_metacentres_are_none_where_they_have_no_meaning() -> None:
    """KM when heeled, GM without KG."""
    heeled, plain, given = box(6, 6, 10.0, kg=4.0), box(6, 6), box(6, 6, kg=4.0)
    assert (heeled.kmt, heeled.kml, heeled.gmt, heeled.gml) == (None,) * 4
    assert (plain.gmt, plain.gml) == (None, None)
    assert plain.kmt is not None
    assert given.gmt == pytest.approx(plain.kmt - 4.0)


def test_the_trimming_moment_takes_gm_where_there_is_one() -> None:
    """And BM where KG is not given, or the ship heels."""
    plain, given, heeled = box(6, 6), box(6, 6, kg=4.0), box(6, 6, 10.0, kg=4.0)
    assert given.gml is not None
    assert plain.mtc == pytest.approx(1.025 * 12000 * plain.bml / 1e4, rel=1e-14)
    assert given.mtc == pytest.approx(1.025 * 12000 * given.gml / 1e4, rel=1e-14)
    assert heeled.mtc == pytest.approx(1.025 * 12000 * heeled.bml / 1e4, rel=1e-14)


def test_water_and_shell_factor_change_weights_only() -> None:
    """Fresh water, and a shell that adds six thousandths."""
    plain, other = box(6, 5), box(6, 5, rho=1.0, shell_factor=1.006)
    assert other.volume == plain.volume
    assert other.displacement == pytest.approx(1.006 * plain.volume, rel=1e-15)
    assert other.tpc == pytest.approx(plain.tpc / 1.025, rel=1e-14)


def test_a_section_amidships_is_found_between_stations() -> None:
    """By the cubic through the four stations next to it: exact for areas of the third degree."""
    header = attrs.evolve(BOX_HEAD, length=94.0)
    found = table_of(BOX, [FloatingPosition(5.0, 7.0)], header)[0]
    assert found.a_midship == pytest.approx(20.0 * 6.0, rel=1e-13)


def test_appendages_add_to_volume_moments_and_surface_and_are_listed_apart() -> None:
    """One that is dry adds nothing; a recess takes away."""
    fin = Appendage("fin", 30.0, (20.0, 0.0, -1.0), 50.0)
    tunnel = Appendage("tunnel", -6.0, (90.0, 0.0, 2.0), 12.0)
    high = Appendage("high", 5.0, (0.0, 0.0, 9.0), 5.0)
    header = attrs.evolve(BOX_HEAD, appendages=(fin, tunnel, high))
    table = table_of(BOX, [FloatingPosition(6.0, 6.0)], header)
    found, bare = table[0], box(6.0, 6.0)
    assert found.volume == pytest.approx(12024.0, rel=1e-14)
    assert found.lcb * 12024 == pytest.approx(12000 * 50 + 30 * 20 - 6 * 90, rel=1e-13)
    assert found.kb * 12024 == pytest.approx(12000 * 3 - 30 - 12, rel=1e-13)
    assert found.wetted_surface == pytest.approx(bare.wetted_surface + 62.0, rel=1e-14)
    assert found.wetted_surface_girth == bare.wetted_surface_girth
    assert [each.volume.tolist() for each in table.shares] == [[30.0], [-6.0], [0.0]]
    assert table.shares[0].percent[0] == pytest.approx(100 * 30 / 12024, rel=1e-14)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        (("", 1.0, (0, 0, 0)), "name"),
        (("fin", np.nan, (0, 0, 0)), "volume"),
        (("fin", 1.0, (0, 0)), "centroid"),
        (("fin", 1.0, (0, 0, np.inf)), "centroid"),
        (("fin", 1.0, (0, 0, 0), -1.0), "area"),
    ],
)
def test_an_appendage_of_odd_numbers_is_refused(values: tuple[object, ...], words: str) -> None:
    """The error names the number."""
    with pytest.raises(BadInputError, match=words):
        Appendage(*values)  # type: ignore[arg-type]


@pytest.mark.parametrize("kg", [None, 4.0])
@pytest.mark.parametrize("heel", [0.0, 12.0])
def test_changes_of_the_integrals_pass_through_the_algebra(kg: float | None, heel: float) -> None:
    """Every value's error is its central difference along the change, where it has a value."""
    setting = RecordSetting(100.0, 20.0, 1.025, 1.006, kg)
    planes = planes_of([FloatingPosition(5.5, 6.5, heel), FloatingPosition(6.0, 5.0, heel)], 100.0)
    stations = BOX.stations(planes)
    sums = integrals_of(BOX.measure(planes), stations, BOX.transom(planes), CountingRule(50.0))
    names = [each.name for each in attrs.fields(HydrostaticIntegrals)]
    push = {name: 0.1 + 0.03 * k * np.ones(2) for k, name in enumerate(names)}
    found = propagate(sums, [HydrostaticIntegrals(**push)], planes, setting)

    def values(step: float) -> dict[str, np.ndarray]:
        moved = {name: getattr(sums, name) + step * push[name] for name in names}
        return values_of(HydrostaticIntegrals(**moved), planes, setting)

    up, down = values(1e-4), values(-1e-4)
    for name in FIELDS:
        assert_allclose(found[name], np.abs(up[name] - down[name]) / 2e-4, rtol=1e-6, atol=1e-9,
                        err_msg=name)  # fmt: skip


def test_integrals_that_are_off_together_leave_quotients_alone() -> None:
    """A hull that is too large by one part in a thousand has its centroids where they are."""
    table = table_of(Box(off=1e-3), [FloatingPosition(5.0, 7.0, 20.0)], BOX_HEAD)
    found = table[0]
    assert found.error["volume"] == pytest.approx(12.0, rel=1e-12)
    for name in ("lcb", "tcb", "kb", "lcf", "bmt", "bml", "cp", "cx"):
        expected = 1e-3 * found.cx if name == "cx" else 0.0
        assert found.error[name] == pytest.approx(expected, abs=1e-11), name
    assert found.error["kmt"] is None


def test_changes_of_several_kinds_add_up() -> None:
    """They might all have the same sign."""
    planes = planes_of([FloatingPosition(6.0, 6.0)], 100.0)
    setting, stations = RecordSetting(100.0, 20.0, 1.025, 1.0, None), BOX.stations(planes)
    sums = integrals_of(BOX.measure(planes), stations, BOX.transom(planes), CountingRule(50.0))
    one = integral_changes(Box(off=1e-3).changes(planes)[0], stations, CountingRule(50.0))
    other = integral_changes(Box(off=-2e-3).changes(planes)[0], stations, CountingRule(50.0))
    found = propagate(sums, [one, other], planes, setting)
    assert found["volume"][0] == pytest.approx(36.0, rel=1e-12)


def test_what_is_not_estimated_has_no_error() -> None:
    """None for all; with an estimate, None only for what nothing is known of."""
    table = table_of(BOX, [FloatingPosition(6.0, 6.0)], BOX_HEAD, estimate=False)
    assert set(table[0].error.values()) == {None}
    assert list(table[0].error) == SPEC_NAMES


def test_a_table_is_indexed_by_draught_and_trim() -> None:
    """Its columns and rows hold the same numbers; a record cannot be changed."""
    positions = [FloatingPosition(t + 0.5 * d, t - 0.5 * d) for t in (5.0, 6.0) for d in (0, 1, -1)]
    table = table_of(BOX, positions, BOX_HEAD, shape=(2, 3))
    assert len(table) == len(table.rows) == 6
    assert table[1, 2].trim_by_stern == pytest.approx(-1.0, abs=1e-14)
    assert [row.volume for row in table.rows] == table.columns["volume"].tolist()
    assert table.columns["volume"][4] == table[4].volume == table[1, 1].volume
    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        table[0].volume = 1.0  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        table.columns["volume"][0] = 1.0
    with pytest.raises(IndexError):
        table[6]

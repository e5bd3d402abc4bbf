"""What holds of all form parameters, of every hull that ships, at any draughts."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cache

import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.analysis.form.catalogue import CATALOGUE
from assoc_hull.analysis.form.form_parameters import form_parameters
from assoc_hull.analysis.form.screw import Screw
from assoc_hull.analysis.form.value import Value
from assoc_hull.errors import OutOfRangeError
from assoc_hull.sources import examples
from tests.mapped import scaled, turned

HULLS: dict[str, Callable[[], ah.Hull]] = {
    "wigley": examples.wigley,
    "Series 60 CB .60": lambda: examples.series60(0.60),
    "Series 60 CB .70": lambda: examples.series60(0.70),
    "207k": examples.bulk_carrier_207k,
}
POWERS = {"m": 1, "m2": 2, "m3": 3, "m4": 4, "t": 3, "1/m": -1}
"""By which power of length a value grows; every other unit is of an angle or a ratio."""

RATIOS = {"-", "deg", "st", "% Lpp", "% B", "% D"}
FACTOR = 2.0

hulls = pytest.mark.parametrize("name", HULLS)


@cache
def hull(name: str) -> ah.Hull:
    """A hull that nobody edits."""
    return HULLS[name]()


@cache
def twice(name: str) -> ah.Hull:
    """The hull, twice as large."""
    return scaled(hull(name), FACTOR)


def screw(name: str, factor: float = 1.0, twin: bool = False) -> Screw:
    """A screw that is likely for the size of the hull."""
    draught = factor * hull(name).state.particulars.draught
    return Screw(
        height=0.28 * draught, diameter=0.4 * draught, x=0.25 * draught,
        spacing=0.9 * draught if twin else 0.0, boss_diameter=0.08 * draught,
    )  # fmt: skip


def test_every_unit_is_a_power_of_length_or_a_ratio() -> None:
    """The scaling law knows all units of the catalogue."""
    assert {each.unit for each in CATALOGUE.values()} <= set(POWERS) | RATIOS


@hulls
@pytest.mark.parametrize("twin", [False, True], ids=["one screw", "two screws"])
@pytest.mark.parametrize("parts", [(1.0, 1.0), (0.75, 0.6)], ids=["design", "ballast"])
def test_a_hull_twice_as_large_has_the_same_form(
    name: str, parts: tuple[float, float], twin: bool
) -> None:
    """Each number grows by its unit's power of length; reasons and warnings stay."""
    design = hull(name).state.particulars.draught
    aft, fore = (part * design for part in parts)
    small = form_parameters(hull(name), draughts=(aft, fore), screw=screw(name, twin=twin))
    large = form_parameters(
        twice(name), draughts=(FACTOR * aft, FACTOR * fore), screw=screw(name, FACTOR, twin)
    )
    assert list(small) == list(CATALOGUE)
    for symbol, value in small.items():
        other = large[symbol]
        assert (other.reason is None) == (value.reason is None), symbol
        if value.number is not None:
            wanted = value.number * FACTOR ** POWERS.get(value.unit, 0)
            assert other.number == pytest.approx(wanted, rel=1e-6, abs=1e-9), symbol


TURNED = (
    ("V_a", "V_f"), ("Aw_a", "Aw_f"), ("Cpa", "Cpf"), ("Cwa", "Cwf"), ("Ea", "Ef"),
    ("Sigma_a", "Sigma_f"), ("L_R", "L_E"), ("V_R", "V_E"), ("CPR", "CPE"),
)  # fmt: skip
"""What is aft of one hull is forward of the other."""

FROM_ENDS = {"m": (("LCBa", "LCBf"), ("LCFa", "LCFf"), ("LCF", "LCF")), "st": (("PMBs", "PMBe"),)}
"""Places from AP, by their unit; of the other hull they count from FP."""

SAME = (
    "V", "VCB", "Aw", "WSA", "Amax", "LWL", "I_T", "I_L", "Cb", "Cm", "Cp", "Cw", "Cvp", "As",
    "C_IT", "C_IL", "KMT", "KML", "M", "C_S", "B'",
)  # fmt: skip


@hulls
@pytest.mark.parametrize("trim", [0.0, 0.08], ids=["even keel", "trimmed"])
def test_a_hull_turned_end_for_end_changes_fore_and_aft(name: str, trim: float) -> None:
    """What is measured aft of a hull is measured forward of the hull with x reversed."""
    draught, length = (getattr(hull(name).state.particulars, a) for a in ("draught", "length"))
    aft, fore = draught * (1.0 + trim), draught * (1.0 - trim)
    here = form_parameters(hull(name), draughts=(aft, fore))
    there = form_parameters(turned(hull(name)), draughts=(fore, aft))
    pairs = [*TURNED, *((b, a) for a, b in TURNED), *((each, each) for each in SAME)]
    wanted = {other: here[one].number for one, other in pairs}
    for unit, places in FROM_ENDS.items():
        whole = length if unit == "m" else 20.0
        for one, other in [*places, *((b, a) for a, b in places)]:
            place = here[one].number
            wanted[other] = None if place is None else whole - place
    for symbol, number in wanted.items():
        found = there[symbol].number
        assert (found is None) == (number is None), symbol
        assert found is None or found == pytest.approx(number, rel=1e-7), symbol


def draughts() -> st.SearchStrategy[tuple[float, float]]:
    """T_A and T_F as parts of the depth."""
    return st.tuples(st.floats(0.05, 0.98), st.floats(0.05, 0.98))


@hulls
@settings(max_examples=12)
@given(parts=draughts(), screws=st.integers(0, 2))
def test_every_entry_answers_at_any_draught(
    name: str, parts: tuple[float, float], screws: int
) -> None:
    """A finite number or a reason, in the unit of the catalogue; nothing is raised."""
    depth = hull(name).state.particulars.depth
    given_screw = screw(name, twin=screws == 2) if screws else None
    try:
        found = form_parameters(
            hull(name), draughts=(parts[0] * depth, parts[1] * depth), screw=given_screw
        )
    except OutOfRangeError:
        reject()  # it does not float there
    assert list(found) == list(CATALOGUE)
    for symbol, value in found.items():
        assert value.unit == CATALOGUE[symbol].unit
        assert value.definition == symbol
        assert (value.number is None) == bool(value.reason), symbol
        assert value.number is None or math.isfinite(value.number), symbol
    check_sums(found)


SUMS: dict[str, tuple[tuple[str, ...], Callable[..., float]]] = {
    "volumes of the halves": (("V_a", "V_f", "V"), lambda a, f, v: (a + f) / v),
    "moments of the halves": (
        ("V_a", "LCBa", "V_f", "LCBf", "V", "LCB", "Lpp"),
        lambda a, xa, f, xf, v, x, l: (a * xa + f * xf) / (v * l * (0.5 + 0.01 * x)),
    ),
    "areas of the halves": (("Aw_a", "Aw_f", "Aw"), lambda a, f, w: (a + f) / w),
    "centroids of the halves": (
        ("Aw_a", "LCFa", "Aw_f", "LCFf", "Aw", "LCF"),
        lambda a, xa, f, xf, w, x: (a * xa + f * xf) / (w * x),
    ),
    "prismatic coefficients": (("Cpa", "Cpf", "Cp"), lambda a, f, p: 0.5 * (a + f) / p),
    "waterplane coefficients": (("Cwa", "Cwf", "Cw"), lambda a, f, p: 0.5 * (a + f) / p),
    "block and section": (("Cp", "Cm", "Cb"), lambda p, m, b: p * m / b),
    "vertical prism": (("Cvp", "Aw", "T", "V"), lambda c, a, t, v: c * a * t / v),
    "metacentre": (("VCB", "BMT", "KMT"), lambda b, r, m: (b + r) / m),
    "run, parallel body, entrance": (
        ("L_R", "L_E", "PMBs", "PMBe", "Lpp"),
        lambda r, e, s, f, l: (r + e) / l + (f - s) / 20.0,
    ),
}
"""What is 1, by the symbols that it is made of."""


def check_sums(found: Mapping[str, Value]) -> None:
    """What two ways give is the same, wherever both are there."""
    for name, (symbols, formula) in SUMS.items():
        numbers = [found[each].number for each in symbols]
        if None not in numbers:
            assert formula(*numbers) == pytest.approx(1.0, rel=1e-6), name

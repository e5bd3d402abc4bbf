"""What holds of all form parameters, of every hull that ships, at any draughts."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.analysis.form.floating_shape import Screw
from assoc_hull.analysis.form.form_parameters import CATALOGUE, form_parameters
from assoc_hull.analysis.form.parameter import FormValue
from assoc_hull.errors import OutOfRangeError
from assoc_hull.hull.sources import examples
from tests.mapped import scaled, turned
from tests.twin_skeg import twin_skeg_ship

NAMES = ("Wigley", "Series 60 CB .60", "Series 60 CB .70", "207k", "twin skegs")
POWERS = {"m": 1, "m2": 2, "m3": 3, "m4": 4, "t": 3, "1/m": -1, "t/cm": 2, "t m/cm": 3}
"""By which power of length a value grows; every other unit is of an angle or a ratio."""

RATIOS = {"-", "deg", "st", "% Lpp", "% LWL", "% B", "% D"}
FACTOR = 2.0

hulls = pytest.mark.parametrize("name", NAMES)
shipped = pytest.mark.parametrize("name", NAMES[:-1])


@pytest.fixture(scope="module")
def ships(series60_60: ah.Hull, series60_70: ah.Hull, bulk_carrier: ah.Hull) -> dict[str, ah.Hull]:
    """All hulls that ship, and one with all that an entry asks for; nobody edits them here."""
    made = examples.wigley(), series60_60, series60_70, bulk_carrier, twin_skeg_ship()
    return dict(zip(NAMES, made, strict=True))


@pytest.fixture(scope="module")
def twice(ships: dict[str, ah.Hull]) -> dict[str, ah.Hull]:
    """The hulls, twice as large."""
    return {name: scaled(hull, FACTOR) for name, hull in ships.items()}


def screw(hull: ah.Hull, twin: bool = False) -> Screw:
    """A screw that is likely for the size of a hull."""
    draught = hull.state.particulars.draught
    return Screw(
        height=0.28 * draught, diameter=0.4 * draught, x=0.25 * draught,
        spacing=0.9 * draught if twin else 0.0, boss_diameter=0.08 * draught,
    )  # fmt: skip


def _at_parts(hull: ah.Hull, parts: tuple[float, float], twin: bool) -> Mapping[str, FormValue]:
    """At parts of the design draught aft and forward."""
    aft, fore = (part * hull.state.particulars.draught for part in parts)
    return form_parameters(hull, draughts=(aft, fore), screw=screw(hull, twin))


def test_every_unit_is_a_power_of_length_or_a_ratio() -> None:
    """The scaling law knows all units of the catalogue."""
    assert {each.unit for each in CATALOGUE.values()} <= set(POWERS) | RATIOS


@hulls
@pytest.mark.parametrize(
    ("parts", "twin"),
    [
        pytest.param((1.0, 1.0), False, id="design, one screw"),
        pytest.param((0.75, 0.6), True, id="ballast, two screws"),
    ],
)
def test_a_hull_twice_as_large_has_the_same_form(
    ships: dict[str, ah.Hull],
    twice: dict[str, ah.Hull],
    name: str,
    parts: tuple[float, float],
    twin: bool,
) -> None:
    """Each number grows by its unit's power of length, and what has none has none."""
    small, large = (_at_parts(each[name], parts, twin) for each in (ships, twice))
    assert list(small) == list(CATALOGUE)
    for symbol, value in small.items():
        other = large[symbol]
        assert (other.reason is None) == (value.reason is None), symbol
        if value.number is not None:
            wanted = value.number * FACTOR ** POWERS.get(value.unit, 0)
            assert other.number == pytest.approx(wanted, rel=1e-7, abs=1e-9), symbol


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


@shipped
@pytest.mark.parametrize("trim", [0.0, 0.08], ids=["even keel", "trimmed"])
def test_a_hull_turned_end_for_end_changes_fore_and_aft(
    ships: dict[str, ah.Hull], name: str, trim: float
) -> None:
    """What is measured aft of a hull is measured forward of the hull with x reversed."""
    hull = ships[name]
    draught, length = hull.state.particulars.draught, hull.state.particulars.length
    aft, fore = draught * (1.0 + trim), draught * (1.0 - trim)
    here = form_parameters(hull, draughts=(aft, fore))
    there = form_parameters(turned(hull), draughts=(fore, aft))
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


@shipped
@settings(max_examples=6)
@given(parts=draughts(), screws=st.integers(0, 2))
def test_every_entry_answers_at_any_draught(
    ships: dict[str, ah.Hull], name: str, parts: tuple[float, float], screws: int
) -> None:
    """A finite number or a reason, in the unit of the catalogue; nothing is raised."""
    hull = ships[name]
    depth = hull.state.particulars.depth
    given_screw = screw(hull, twin=screws == 2) if screws else None
    try:
        found = form_parameters(
            hull, draughts=(parts[0] * depth, parts[1] * depth), screw=given_screw
        )
    except OutOfRangeError:
        reject()  # it does not float there
    assert list(found) == list(CATALOGUE)
    for symbol, value in found.items():
        assert value.unit == CATALOGUE[symbol].unit
        assert value.definition == symbol
        assert (value.number is None) == bool(value.reason), symbol
        assert value.number is None or math.isfinite(value.number), symbol
        assert value.number != 0.0 or symbol in MAY_BE_NIL, symbol
    check_sums(found)


@hulls
def test_halves_make_up_the_whole(ships: dict[str, ah.Hull], name: str) -> None:
    """At the design draught all numbers that sums are made of are there, and the sums hold."""
    found = form_parameters(ships[name])
    check_sums(found)
    missing = {each for each, (symbols, _) in SUMS.items() if None in numbers(found, symbols)}
    assert missing <= {"run, parallel body, entrance"}


MAY_BE_NIL = {
    "ATT", "TRAR", "TRAR_paper", "A_T",  # of a dry transom
    "LCB", "LCF-LCB",  # of a hull that is alike fore and aft
    "SO", "SA", "Hap", "TRZ",  # of a profile that ends at AP, on the base line, at the draught
}  # fmt: skip
"""Nil says something here; elsewhere it would stand for what is not there."""

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


def numbers(found: Mapping[str, FormValue], symbols: tuple[str, ...]) -> list[float | None]:
    """The numbers of some entries."""
    return [found[each].number for each in symbols]


def check_sums(found: Mapping[str, FormValue]) -> None:
    """What two ways give is the same, wherever both are there."""
    for name, (symbols, formula) in SUMS.items():
        made_of = numbers(found, symbols)
        if None not in made_of:
            assert formula(*made_of) == pytest.approx(1.0, rel=1e-6), name

"""Form parameters of hulls that formulas give, against the formulas."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import attrs
import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.catalogue import CATALOGUE
from assoc_hull.analysis.form.screw import Screw
from tests import form_truths
from tests.nets import ellipsoid_net, wigley_net


@attrs.frozen
class Ship:
    """A hull, and its form parameters by another route; `part` is how near they must be.

    Lengths count in parts of Lpp, heights too; everything else in parts of itself. The hull
    that all tests share is not made here.
    """

    make: Callable[[], ah.Hull] | None
    draught: float
    truth: Callable[[], dict[str, float]]
    part: float
    screw: Screw | None = None


SHIPS = {
    "Wigley": Ship(
        lambda: ah.Hull(wigley_net(41, 21)), 6.25, form_truths.wigley, 4e-6, Screw(2.0, 3.0, 1.0)
    ),
    "ellipsoid": Ship(lambda: ah.Hull(ellipsoid_net(41, 21)), 6.0, form_truths.ellipsoid, 8e-6),
    "207k": Ship(
        None, 18.0, form_truths.carrier, 2e-5,
        Screw(form_truths.SHAFT, form_truths.SCREW, form_truths.SCREW_AT),
    ),
}  # fmt: skip

BLUNT = {"BH", "Z_B", "C_ZB", "A_FP", "Abulb", "A_BT", "BAR", "C_ABT", "B_B", "BW", "C_BB"}
"""Of the carrier, hardly determined by her lines: the height at which the bulb reaches farthest,
as it is round there, and the section at FP, where waterlines end bluntly on the stem."""


@pytest.fixture(scope="module")
def ships(bulk_carrier: ah.Hull) -> dict[str, ah.Hull]:
    """The hulls; nobody edits them here."""
    return {name: ship.make() if ship.make else bulk_carrier for name, ship in SHIPS.items()}


@cache
def truth(name: str) -> dict[str, float]:
    """Its form parameters by the other route."""
    return SHIPS[name].truth()


def allowed(name: str, symbol: str, length: float) -> float:
    """By how much a form parameter may be off."""
    scale = {"m": length, "% Lpp": 100.0, "deg": 57.3, "st": 20.0}
    part = 100.0 if name == "207k" and symbol in BLUNT else 1.0
    return part * SHIPS[name].part * scale.get(CATALOGUE[symbol].unit, abs(truth(name)[symbol]))


CASES = [(name, symbol) for name in SHIPS for symbol in truth(name)]


@pytest.mark.parametrize(("name", "symbol"), CASES, ids=[f"{n} {s}" for n, s in CASES])
def test_a_form_parameter_is_what_the_formula_says(
    ships: dict[str, ah.Hull], name: str, symbol: str
) -> None:
    """The net's value is that of the formula; its lines alone set it apart."""
    ship, hull = SHIPS[name], ships[name]
    found = ah.form_parameters(hull, draught=ship.draught, screw=ship.screw)[symbol]
    if found.reason is not None and "not measured yet" in found.reason:
        pytest.skip("pending")
    off = allowed(name, symbol, hull.state.particulars.length)
    assert found.number == pytest.approx(truth(name)[symbol], rel=0.0, abs=off)


def test_sixty_entries_are_checked() -> None:
    """Entries of the catalogue, not cases: those of several ships count once."""
    checked = {symbol for _, symbol in CASES}
    assert checked <= set(CATALOGUE)
    assert len(checked) >= 60

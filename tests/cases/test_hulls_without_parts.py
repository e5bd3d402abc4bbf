"""A hull that has no bulb, transom, skeg or parallel body gets reasons, and no exception."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.parameter import FormValue


@pytest.fixture(scope="module")
def wigley() -> Mapping[str, FormValue]:
    """Form parameters of Wigley's hull, no screw given."""
    return ah.examples.wigley().form_parameters(draught=6.25)


@pytest.mark.parametrize(
    "symbol",
    ["BL", "BH", "Abulb", "LBA", "LIBA", "Z_B", "L_PR", "B_B", "A_BT", "A_BL", "V_PR",
     "h_B"],
)  # fmt: skip
def test_without_a_bulb_there_is_a_reason(wigley: Mapping[str, FormValue], symbol: str) -> None:
    """Never a zero that means nothing."""
    assert wigley[symbol].number is None
    assert "no bulb" in (wigley[symbol].reason or "") or "no section" in (
        wigley[symbol].reason or ""
    )


@pytest.mark.parametrize("symbol", ["ATT", "B_tr", "TH", "TRZ"])
def test_without_a_transom_there_is_a_reason(wigley: Mapping[str, FormValue], symbol: str) -> None:
    """Both ends of Wigley's hull are sharp."""
    assert wigley[symbol].number is None
    assert "no transom" in (wigley[symbol].reason or "")


@pytest.mark.parametrize(
    "symbol",
    ["SCH", "D_p", "PI", "PTC", "SA", "BCL", "B07", "Tau", "S3.A1", "S3", "S3'.A1", "S3'", "TwDS"],
)
def test_without_a_screw_there_is_a_reason(wigley: Mapping[str, FormValue], symbol: str) -> None:
    """What depends on the shaft is not guessed."""
    assert wigley[symbol].number is None
    assert "no screw given" in (wigley[symbol].reason or "")


@pytest.mark.parametrize(
    "symbol",
    ["TTLS", "HSKEG", "LSKEG", "ASKEG", "XSKEG", "RSKEG", "TwTTL", "TwVSA", "TwLSA"],
)
def test_a_single_skeg_has_no_tunnel(wigley: Mapping[str, FormValue], symbol: str) -> None:
    """Nothing hangs below the centre line."""
    assert wigley[symbol].number is None
    assert "single skeg" in (wigley[symbol].reason or "")


@pytest.mark.parametrize("symbol", ["LWL", "LCF", "KMT", "I_T", "I_L", "BMT", "BML", "KML"])
def test_a_draught_to_the_deck_leaves_no_waterplane(symbol: str) -> None:
    """The deck, which is closed and level, lies in the floating plane."""
    hull = ah.examples.wigley()
    value = hull.form_parameters(draught=hull.particulars.depth, only=[symbol])[symbol]
    assert value.number is None
    assert (value.reason or "").endswith("no waterplane: the deck is in the water")


def test_wigley_has_no_bilge_circle_and_a_level_bottom(wigley: Mapping[str, FormValue]) -> None:
    """Its midship section is a parabola; its stern stands at AP, its bottom on the base line."""
    assert wigley["BR"].number is None
    assert wigley["StemA"].reason == "the bottom does not rise to AP"
    assert (wigley["SO"].number, wigley["Hap"].number) == (0.0, 0.0)

"""A hull that has no bulb, transom, skeg or parallel body gets reasons, and no exception."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.value import Value


@pytest.fixture(scope="module")
def wigley() -> Mapping[str, Value]:
    """Form parameters of Wigley's hull, no screw given."""
    return ah.form_parameters(ah.examples.wigley(), draught=6.25)


@pytest.mark.parametrize(
    "symbol", ["BL", "BH", "Abulb", "LBA", "LIBA", "Z_B", "L_PR", "B_B", "A_BT", "A_BL"]
)
def test_without_a_bulb_there_is_a_reason(wigley: Mapping[str, Value], symbol: str) -> None:
    """Never a zero that means nothing."""
    assert wigley[symbol].number is None
    assert "no bulb" in (wigley[symbol].reason or "") or "no section" in (
        wigley[symbol].reason or ""
    )

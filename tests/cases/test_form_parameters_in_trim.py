"""Entries that a trim changes: at which end each draught counts, and where a measure is taken."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah

LENGTH = 300.0
SCREW = ah.form.Screw(height=5.0, diameter=8.6, x=5.2)


def numbers(hull: ah.Hull, *symbols: str, draughts: tuple[float, float]) -> list[float]:
    """Values of entries, which must be there."""
    found = hull.form_parameters(draughts=draughts, screw=SCREW, only=symbols)
    given = [found[symbol].number for symbol in symbols]
    assert None not in given
    return [float(number) for number in given if number is not None]


def test_each_formula_takes_the_draught_of_its_end(bulk_carrier: ah.Hull) -> None:
    """TRZ, PI and Cvpa' that at AP, C_ZB that at FP, Cb and Cm the mean."""
    aft, fore = 19.8, 14.4

    def of(*symbols: str) -> list[float]:
        return numbers(bulk_carrier, *symbols, draughts=(aft, fore))

    height, part, plane, tip, volume, area = of("TH", "V_a", "Cwa", "Z_B", "V", "Amax")
    mean = 0.5 * (aft + fore)
    assert of("TRZ", "PI", "Cvpa'", "C_ZB", "Cb", "Cm") == pytest.approx(
        [
            aft - height,
            aft - 5.0 - 4.3,
            part / (plane * 150.0 * 50.0 * aft),
            tip / fore,
            volume / (LENGTH * 50.0 * mean),
            area / (50.0 * mean),
        ],
        rel=1e-12,
    )


def test_the_transom_is_cut_where_it_stands(bulk_carrier: ah.Hull) -> None:
    """B_tr and ATT are those of an even keel at the draught that the transom has, 5 m aft of AP."""
    aft, fore = 22.0, 16.0
    there = aft + 5.0 * (aft - fore) / LENGTH
    assert numbers(bulk_carrier, "B_tr", "ATT", draughts=(aft, fore)) == pytest.approx(
        numbers(bulk_carrier, "B_tr", "ATT", draughts=(there, there)), rel=1e-9
    )


def test_a_trim_tilts_the_water_over_the_bulb(bulk_carrier: ah.Hull) -> None:
    """LIBA changes by the wedge that the water line leaves before FP."""
    aft, fore, step = 11.0, 5.0, 0.05
    low, even, high, tilted = (
        numbers(bulk_carrier, "LIBA", draughts=each)[0]
        for each in ((5 - step, 5 - step), (fore, fore), (5 + step, 5 + step), (aft, fore))
    )
    reach = (high - low) / (2.0 * step)  # of the bulb before FP, at this height
    wedge = 0.5 * (fore - aft) / LENGTH * reach * reach
    assert tilted - even == pytest.approx(wedge, rel=0.02)


def test_the_angle_of_run_is_taken_at_half_the_draughts() -> None:
    """Wigley's hull amidships, at half the mean draught, whatever the trim."""
    breadth = 5.0 * (1.0 - (2.5 / 6.25 - 1.0) ** 2)
    wanted = np.degrees(np.arctan2(breadth, 50.0))
    found = numbers(ah.examples.wigley(), "Rangle", draughts=(6.0, 4.0))
    assert found == pytest.approx([wanted], abs=2e-3)

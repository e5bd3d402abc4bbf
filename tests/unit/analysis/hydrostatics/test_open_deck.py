"""One limit of draught for an open deck: all that floats an imported hull asks it, and says so."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.shipped.wigley import wigley_half_breadth

LOWEST, AT = 7.5, 40.0
"""Height of the deck edge where it is lowest, and the station there, m."""


def table(path: Path) -> Path:
    """A Wigley hull with sheer: the deck edge is given by columns, lowest forward of midship."""
    x, z = np.linspace(0.0, 100.0, 21), np.linspace(0.0, 7.0, 8)
    rows = [
        "# Lpp = 100, T = 6",
        "x_m," + ",".join(f"wl_{each:g}" for each in z) + ",z_deck,y_deck",
    ]
    for place in x.tolist():
        y = wigley_half_breadth(np.full(8, place), np.minimum(z, 6.0), 100.0, 10.0, 6.0)
        top = LOWEST + ((place - AT) / 50.0) ** 2
        rows.append(
            ",".join([f"{place:g}", *(f"{each:.5f}" for each in y), f"{top:.5f}", f"{y[-1]:.5f}"])
        )
    path.write_text("\n".join(rows) + "\n")
    return path


@pytest.fixture(scope="module")
def hull(tmp_path_factory: pytest.TempPathFactory) -> ah.Hull:
    """The hull with an open deck, read from her table."""
    return ah.read(table(tmp_path_factory.mktemp("open") / "open.csv"))


_OVER = 8.25
_POSITION = ah.hydro.FloatingPosition(_OVER, _OVER)
_TONS = 1e5

USES: dict[str, Callable[[ah.Hull], object]] = {
    "hydrostatics": lambda hull: hull.hydrostatics(draught=_OVER),
    "hydrostatic_table": lambda hull: hull.hydrostatic_table([6.0, _OVER]),
    "stability": lambda hull: hull.stability(draught=_OVER, kg=4.0),
    "cross_curves": lambda hull: hull.cross_curves(draughts=[_OVER], heels=[10.0]),
    "freeboard": lambda hull: hull.freeboard(_POSITION),
    "deck_edge_angle": lambda hull: hull.deck_edge_angle(_POSITION),
    "section_points": lambda hull: hull.section_points(50.0, draught=_OVER),
    "panels": lambda hull: hull.panels(draught=_OVER, count=100),
    "form_parameters": lambda hull: hull.form_parameters(draught=_OVER),
    "curve_transform": lambda hull: hull.curve_transform("sectional areas", draught=_OVER),
    "compare": lambda hull: hull.compare(hull, draught=_OVER),
    "immersion": lambda hull: hull.immersion(_TONS),
    "equilibrium": lambda hull: hull.equilibrium(_TONS, lcg=50.0, kg=4.0),
    "a hull that was varied": lambda hull: hull.vary(
        set={"breadth": 10.2}, drivers=["sections"]
    ).hull.hydrostatics(draught=_OVER),
}


@pytest.mark.parametrize("use", USES)
def test_each_use_of_an_imported_hull_is_refused_over_her_open_deck_with_place_and_remedy(
    hull: ah.Hull, use: str
) -> None:
    """The lowest place of the deck edge, with its station, and what to do: that works."""
    with pytest.raises(ah.errors.OutOfRangeError) as refused:
        USES[use](hull)
    text = str(refused.value)
    assert f"lowest at z {LOWEST:.3f} m at x {AT:.2f} m" in text
    assert "near ST 40" in text
    assert 'deck="closed"' in text


def test_a_closed_deck_is_what_the_refusal_says(tmp_path: Path) -> None:
    """Read with deck="closed" the same draught floats."""
    hull = ah.read(table(tmp_path / "closed.csv"), deck="closed")
    assert hull.hydrostatics(draught=_OVER).draught_mean == pytest.approx(_OVER)


def test_report_measures_up_to_the_deck_edge_in_every_use_that_has_it(hull: ah.Hull) -> None:
    """Hydrostatics, tables and panels stop at the same height."""
    told = hull.hydrostatics(draught=_OVER, on_error="report")
    assert told.draught_mean == pytest.approx(LOWEST, abs=1e-4)
    assert "drowns the open deck: measured up to 7.5 m" in told.notes[0]
    column = hull.hydrostatic_table([6.0, _OVER], on_error="report").columns["draught_mean"]
    assert column.tolist() == pytest.approx([6.0, LOWEST], abs=1e-4)
    panels = hull.panels(draught=_OVER, count=100, on_error="report")
    assert panels.origin is not None
    assert panels.origin.draught_aft == pytest.approx(LOWEST, abs=1e-4)
    assert hull.bonjean().z[-1] == pytest.approx(LOWEST, abs=1e-4)


def test_the_open_top_of_a_bulb_ahead_of_the_deck_is_no_deck_edge(
    bulk_carrier: ah.Hull, tmp_path: Path
) -> None:
    """A table of a carrier ends on sections of her bulb, 10 m high: the deck limits, at 27 m."""
    path = tmp_path / "carrier.csv"
    bulk_carrier.export(path)
    hull = ah.read(path, accept=True)
    assert hull.adoption is not None
    assert not any("drowns the open deck" in note for note in hull.adoption.notes)
    with pytest.raises(ah.errors.OutOfRangeError, match=r"lowest at z 27\.000 m") as refused:
        hull.hydrostatics(draught=27.5)
    assert refused.value.most == pytest.approx(27.0)

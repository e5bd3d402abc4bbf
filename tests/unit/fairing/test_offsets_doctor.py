"""The doctor of offsets: slips are found, named and counted once; sound tables raise no alarm."""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.fairing.offsets_doctor import (
    ALARM,
    PrintedOffsets,
    examine,
    exchanged_digits,
    moved_points,
    other_digits,
    single_slips,
)
from assoc_hull.fairing.table_residuals import TableWindows
from tests.planted_slips import (
    Rates,
    cells_seen,
    planted,
    slices,
    trial,
    trial_tables,
    with_slips,
)

# First of all, among the first five, called; percent of slips of 5 mm and more. As published for
# the method, less five points.
WANTED = {
    "Series 60 0.60": (65.0, 67.0, 53.0),
    "Series 60 0.70": (57.0, 67.0, 52.0),
    "carrier": (85.0, 90.0, 81.0),
}
TABLES = tuple(WANTED)


@pytest.mark.parametrize("name", TABLES)
def test_planted_slips_are_found(name: str) -> None:
    """Two hundred, one at a time, in cells that are seen from both directions."""
    found = Rates.of(trial(trial_tables()[name], 200, seed=1))
    assert found.count == 200
    first, five, called = WANTED[name]
    assert found.first >= first
    assert found.five >= five
    assert found.called >= called


@pytest.mark.parametrize("name", TABLES)
def test_slips_at_the_borders_of_a_table_are_found(name: str) -> None:
    """In cells that are seen from one direction, of 50 mm and more: six in ten among five."""
    found = Rates.of(trial(trial_tables()[name], 40, seed=12, size=(0.05, 100.0), edge=True))
    assert found.count == 40
    assert found.five >= 60.0


@pytest.mark.parametrize("name", TABLES)
def test_two_exchanged_digits_come_first(name: str) -> None:
    """Of the numbers that one slip makes, that by another exchange is told before all others."""
    found = Rates.of(trial(trial_tables()[name], 40, seed=13, kinds=("swap",)))
    assert found.numbers >= 90.0


def test_sound_tables_raise_no_alarm() -> None:
    """Thirteen tables: Series 60 as printed, the carrier by formula, ten slices of five hulls."""
    every = {name: table.printed for name, table in trial_tables().items()} | slices()
    assert len(every) == 13
    scores = {name: examine(table, 1).findings for name, table in every.items()}
    assert {name: found[0].score for name, found in scores.items() if found[0].alarm} == {}


def test_several_slips_are_found_each_once() -> None:
    """Six at once, of 50 mm and more: nine of ten are among the first eight, no cell twice."""
    random = np.random.default_rng(5)
    hits = count = 0
    for name in TABLES:
        table = trial_tables()[name]
        cells = cells_seen(table.printed)[0]
        for _ in range(5):
            slips = tuple(planted(table, cells, 6, random, (0.05, 100.0)))
            slips = tuple({(each.row, each.column): each for each in slips}.values())
            found = examine(with_slips(table.printed, slips), top=8).findings
            told = [(each.row, each.column) for each in found]
            assert len(set(told)) == len(told) >= 8
            hits += len({(each.row, each.column) for each in slips} & set(told))
            count += len(slips)
    assert hits >= 0.9 * count


def carrier() -> PrintedOffsets:
    """The carrier's table with 13012 typed for 13102 or the like, in the midst of it."""
    table = trial_tables()["carrier"]
    cells = np.array([[33, 9]])
    slips = planted(table, cells, 1, np.random.default_rng(1), (0.05, 100.0), ("swap",))
    return with_slips(table.printed, tuple(slips))


@given(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3), st.floats(1e-3, 1e3))
def test_units_change_no_score(along: float, up: float, across: float) -> None:
    """Of lengths, heights and half-breadths: what is called stays, and so do scores."""
    table = carrier()
    other = attrs.evolve(
        table, x=table.x * along, z=table.z * up, y=table.y * across, step=table.step * across,
        worth=table.worth * across,
    )  # fmt: skip
    one, two = examine(table, 3).findings, examine(other, 3).findings
    assert [each.score for each in two] == pytest.approx([each.score for each in one], rel=1e-6)
    assert [each.numbers for each in two] == [each.numbers for each in one]
    assert one[0].alarm


def test_a_table_turned_end_for_end_has_the_same_slips() -> None:
    """Stations numbered from forward or from aft, and the same waterlines."""
    table = carrier()
    turned = attrs.evolve(
        table, x=-table.x[::-1], y=table.y[::-1], stations=table.stations[::-1],
        text=table.text[::-1],
    )  # fmt: skip
    one, two = examine(table).alarms, examine(turned).alarms
    assert [(each.station, each.waterline, each.mended) for each in one] == [
        (each.station, each.waterline, each.mended) for each in two
    ]
    assert len(one) == 1


def test_every_cell_is_checked_or_told() -> None:
    """Those with a number count in both directions, in one, or are named with the reason."""
    for table in trial_tables().values():
        report = examine(table.printed)
        wide = int((table.printed.y > 0.0).sum())
        assert report.both + report.single + len(report.unchecked) == wide
        assert all(each.endswith(")") for each in report.unchecked)
    told = examine(trial_tables()["Series 60 0.70"].printed).unchecked
    assert "station 20, waterline 1.5 (a corner)" in told
    assert "station 20, waterline 1.25 (beside blanks, zeros or the border)" in told


def test_windows_beside_a_window_are_the_same_places_on_other_lines() -> None:
    """Each window knows that of the lines on either side, and its residual of a cubic is nil."""
    x, z = np.array([0.0, 1.0, 2.5, 3.0, 4.5, 6.0, 7.0]), np.arange(6.0)
    windows = TableWindows.of(x, z, np.ones((7, 6), bool), np.full(6, 1e-9))
    assert len(windows.cells) == 3 * 6 + 2 * 7
    cubic = (x[:, None] ** 3 - 4.0 * x[:, None] * z + 2.0 * z**3).ravel()
    off, scale = windows.off(cubic)
    assert np.abs(off).max() < 1e-12 * np.abs(cubic).max()
    assert (scale > 0.0).all()
    one = windows.cells[windows.beside[0][1]]
    assert (one - windows.cells[0]).tolist() == [1] * 5


def test_a_zero_typed_within_the_hull_is_called() -> None:
    """And so is a number ten times too large."""
    table = trial_tables()["carrier"].printed
    for text in ("0", f"{table.text[32][8]}0"):
        y, cells = table.y.copy(), [list(row) for row in table.text]
        y[32, 8], cells[32][8] = float(text), text
        spoilt = attrs.evolve(table, y=y, text=tuple(map(tuple, cells)))
        (found,) = examine(spoilt, 0).alarms
        assert (found.row, found.column) == (32, 8)
        assert found.score > ALARM


# --------------------------------------------------------------------------------------
# Numbers that one slip makes.


@given(st.from_regex(r"[1-9][0-9]{0,4}(\.[0-9]{1,4})?", fullmatch=True))
def test_slips_go_both_ways(text: str) -> None:
    """A number is among those that one slip makes of what one slip made of it."""
    for number in exchanged_digits(text):
        assert text in exchanged_digits(number)
    for number in other_digits(text):
        assert text in other_digits(number)
    assert all(len(each) == len(text) for each in exchanged_digits(text) + other_digits(text))


@given(st.integers(1, 99999))
def test_a_moved_point_is_a_factor_of_ten(number: int) -> None:
    """One to three places left and right, the nearest first; a forgotten point is found so."""
    found = [float(each) for each in moved_points(str(number))]
    wanted = [number * 10.0**by for by in (-1, 1, -2, 2, -3, 3)]
    assert found == pytest.approx(wanted)
    assert "0.935" in moved_points("935")
    assert moved_points("1e3") == ()


def test_a_number_that_two_slips_make_is_the_commoner_one() -> None:
    """12 of 21: digits exchanged, though the cell beside holds it as well."""
    told = dict(single_slips("21", ("12", "30", "21")))
    assert told["12"] == "two digits exchanged"
    assert told["30"] == "the cell beside"
    assert told["24"] == "one digit other"
    assert told["2.1"] == "decimal point"
    assert "21" not in told

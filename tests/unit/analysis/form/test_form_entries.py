"""Entries of the catalogue: what they may give, and what is told with a number."""

from __future__ import annotations

import json

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.form_parameters import form_report
from assoc_hull.analysis.form.parameter import parameter
from assoc_hull.io.tables.form_parameters import form_json


@pytest.mark.parametrize("given", [None, "1", 1j, True, [1.0]], ids=repr)
def test_an_entry_that_gives_no_number_is_refused_by_its_symbol(given: object) -> None:
    """An entry of one's own gives a number, Absent or Warned; the error says which does not."""
    own = parameter(
        "own", name="own", unit="-", table="measures", definition="-", source="-", needs=("B",)
    )(lambda _: given)  # type: ignore[arg-type,return-value]
    with pytest.raises(TypeError, match="'own' gives"):
        ah.examples.wigley(stations=9, waterlines=6).form_parameters(only=["own"], further=[own])


def test_an_entry_may_give_a_number_of_numpy() -> None:
    """Arrays hand out such numbers."""
    own = parameter(
        "own", name="own", unit="-", table="measures", definition="-", source="-", needs=("B",)
    )(lambda breadth: np.float64(breadth))
    hull = ah.examples.wigley(stations=9, waterlines=6)
    assert hull.form_parameters(only=["own"], further=[own])["own"].number == 10.0


def test_an_entry_belongs_to_a_table_of_the_catalogue() -> None:
    """Another is refused as the entry is made."""
    with pytest.raises(ah.AssocHullError, match="table"):
        parameter("own", name="own", unit="-", table="rubbish", definition="-", source="-")  # type: ignore[arg-type]


def test_a_section_coefficient_above_one_is_told(bulk_carrier: ah.Hull) -> None:
    """In trim the largest section may lie deeper than the mean draught."""
    trimmed = bulk_carrier.form_parameters(draughts=(19.0, 17.0), only=["Cm"])["Cm"]
    assert (trimmed.number or 0.0) > 1.0
    assert "deeper than the mean draught" in (trimmed.warning or "")
    assert bulk_carrier.form_parameters(only=["Cm"])["Cm"].warning is None


def test_a_blunt_bow_warns_of_its_angle(bulk_carrier: ah.Hull, series60_60: ah.Hull) -> None:
    """Where the angle hangs on the place at which it is read, the value says so; a fine bow not."""
    blunt = bulk_carrier.form_parameters(draught=14.4, only=["Eangle"])["Eangle"]
    assert "0.02 B from the centre plane" in (blunt.warning or "")
    fine = series60_60.form_parameters(only=["Eangle"])["Eangle"]
    assert fine.warning is None


@pytest.mark.parametrize(("draughts", "even"), [((6.0, 6.0), True), ((6.0, 5.0), False)])
def test_json_says_whether_the_keel_is_even(draughts: tuple[float, float], even: bool) -> None:
    """Coefficients of a trimmed ship are of her mean draught, and a reader sees that they are."""
    report = form_report(ah.examples.wigley(), draughts=draughts, only=["Cb"])
    assert json.loads(form_json(report))["even_keel"] is even

"""Whether the deck is open or closed: a word of the particulars, kept wherever a hull is kept."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.cli.hull_words import hull_words
from assoc_hull.io.hull_json import dumps_hull_json, read_hull_json
from assoc_hull.io.offsets.complete_table import net_from_table
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.definition.records import definition
from assoc_hull.model.tables import HullState
from assoc_hull.shipped.wigley import wigley

OLD = Path(__file__).parent / "io" / "old_files"
DECKS = ("open", "closed")


def with_deck(deck: str) -> HullState:
    """A small hull with this deck."""
    state = wigley(stations=7, waterlines=5)
    state.settings.particulars.data[0] = attrs.evolve(state.particulars, deck=deck)
    return state


def test_a_deck_is_open_unless_told() -> None:
    """The fifth particular may be left out."""
    assert ah.Particulars("S", 9.0, 2.0, 1.0, 1.0).deck == "open"


@pytest.mark.parametrize("wrong", ["shut", "Open", "", None, 1, True, ["open"]])
def test_another_word_is_refused(wrong: object) -> None:
    """The message names the value and the words there are."""
    with pytest.raises(ah.errors.BadInputError, match=r"^deck is .*; use open or closed"):
        ah.Particulars("S", 9.0, 2.0, 1.0, 1.0, wrong)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["wigley", "series60_60", "series60_70", "bulk_carrier"])
def test_the_hulls_that_ship_are_closed(name: str, request: pytest.FixtureRequest) -> None:
    """They are heeled in examples, and their decks keep the water out."""
    hull = ah.examples.wigley() if name == "wigley" else request.getfixturevalue(name)
    assert hull.particulars.deck == "closed"


@pytest.mark.parametrize("deck", DECKS)
def test_the_text_keeps_it(deck: str) -> None:
    """And is the same text again; an open deck is not written."""
    state = with_deck(deck)
    text = dumps_hull_json(state)
    again = read_hull_json(text)
    assert again.particulars == state.particulars
    assert dumps_hull_json(again) == text
    told = json.loads(text)["definition"]["particulars"]
    assert told.get("deck") == (None if deck == "open" else "closed")


def test_a_text_that_says_open_is_read() -> None:
    """Though it is never written."""
    document = json.loads(dumps_hull_json(with_deck("open")))
    document["definition"]["particulars"]["deck"] = "open"
    assert read_hull_json(json.dumps(document)).particulars.deck == "open"


def test_a_text_with_another_word_is_refused() -> None:
    """The way to it is told."""
    document = json.loads(dumps_hull_json(with_deck("closed")))
    document["definition"]["particulars"]["deck"] = "shut"
    with pytest.raises(ah.errors.BadInputError, match=r"none of open, closed.*particulars\.deck"):
        read_hull_json(json.dumps(document))


def test_a_changed_deck_is_another_hull() -> None:
    """The fingerprint tells; so does a text in which the word was changed by hand."""
    one, other = with_deck("open"), with_deck("closed")
    assert fingerprint(one) != fingerprint(other)
    assert definition(one) != definition(other)
    changed = dumps_hull_json(other).replace('"deck": "closed"', '"deck": "open"')
    with pytest.raises(ah.errors.BadInputError, match="fingerprint"):
        read_hull_json(changed)


@pytest.mark.parametrize("deck", DECKS)
def test_the_hull_file_keeps_it(deck: str, tmp_path: Path) -> None:
    """Through saving, an edit, another name for the ship, undo, and opening."""
    path = tmp_path / "ship.hull"
    hull = ah.Hull(with_deck(deck))
    start = hull.fingerprint
    hull.save(path)
    with hull.edit("rename") as edit:
        edit.rename(hull, "Other")
    hull.close()
    again = ah.open(path)
    assert (again.particulars.name, again.particulars.deck) == ("Other", deck)
    again.undo()
    assert (again.particulars.deck, again.fingerprint) == (deck, start)
    assert again.verify() == ()


@pytest.mark.parametrize("version", [1, 2, 3])
def test_an_older_hull_file_is_open_and_keeps_its_fingerprint(version: int, tmp_path: Path) -> None:
    """Its text, too, reads as before decks were told."""
    path = tmp_path / "old.hull"
    shutil.copy(OLD / f"version_{version}.hull", path)
    hull = ah.open(path)
    assert hull.particulars.deck == "open"
    text = dumps_hull_json(hull.state)
    assert '"deck":' not in text
    assert read_hull_json(text).particulars == hull.particulars


def test_a_comparison_names_the_decks() -> None:
    """Where they differ, and only there."""
    from assoc_hull.edit.explain.compare_states import compare_states

    one, other = with_deck("open"), with_deck("closed")
    found = compare_states(one, other, ("before", "after"))
    assert found.decks == ("open", "closed")
    assert "  deck: open -> closed" in str(found).splitlines()
    assert "deck" not in str(compare_states(one, one, ("before", "after")))


@pytest.mark.parametrize("deck", DECKS)
def test_a_hull_in_words_tells_it(deck: str) -> None:
    """In the line of the dimensions."""
    assert hull_words(ah.Hull(with_deck(deck))).splitlines()[0].endswith(f", deck {deck}")


def table() -> OffsetTable:
    """A box of three stations."""
    x, z = np.array([0.0, 5.0, 10.0]), np.array([0.0, 0.5, 1.0, 2.0])
    y = np.tile([1.0, 1.6, 1.8, 2.0], (3, 1))
    none, rounding = np.empty(0), np.full(4, 5e-4)
    return OffsetTable("box", x, z, y, None, None, None, none, None, 10.0, 4.0, 1.0, 2.0, rounding)


@pytest.mark.parametrize("deck", DECKS)
def test_a_table_is_adopted_with_it(deck: str) -> None:
    """No table tells."""
    assert net_from_table(table(), deck=deck)[0].particulars.deck == deck
    assert net_from_table(table())[0].particulars.deck == "open"


LINES = {"table": "offsets.csv", "lines": "sections.bri"}


@pytest.fixture
def exported(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A closed hull in a form that does not tell."""
    path = tmp_path / LINES[request.param]
    ah.examples.wigley(stations=9, waterlines=5).export(path)
    return path


@pytest.mark.parametrize("exported", LINES, indirect=True)
def test_an_import_is_open_unless_told(exported: Path, tmp_path: Path) -> None:
    """In Python and on the command line, from tables and lines."""
    assert ah.read(exported, draught=6.0).particulars.deck == "open"
    assert ah.read(exported, draught=6.0, deck="closed").particulars.deck == "closed"
    with pytest.raises(ah.errors.BadInputError, match="deck is 'shut'"):
        ah.read(exported, draught=6.0, deck="shut")
    for given, deck in (
        ([], "open"),
        (["--deck", "closed"], "closed"),
        (["--deck", "open"], "open"),
    ):
        out = tmp_path / f"{deck}-{len(given)}.hull.json"
        assert main(["import", str(exported), "-o", str(out), "--draught", "6", *given]) == 0
        assert ah.open(out).particulars.deck == deck


def test_a_saved_hull_has_one_already(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Reading it with another one is refused, not ignored."""
    path = tmp_path / "ship.hull.json"
    ah.Hull(with_deck("closed")).save(path)
    with pytest.raises(ah.errors.BadInputError, match="deck cannot be given"):
        ah.read(path, deck="open")
    assert main(["import", str(path), "-o", str(tmp_path / "o.hull"), "--deck", "open"]) == 2
    assert "deck cannot be given" in capsys.readouterr().err


@pytest.mark.parametrize("ship", ["wigley", "series60", "bulk_carrier_207k"])
def test_what_is_read_after_an_edit_of_the_particulars_is_that_of_the_file(
    ship: str, tmp_path: Path
) -> None:
    """Nothing that was measured before stays; no line moves; undo brings all back."""
    hull: ah.Hull = getattr(ah.examples, ship)()

    def afloat(some: ah.Hull) -> tuple[float | None, ...]:
        found = some.hydrostatics(estimate=False)
        return found.volume, found.lcb, found.kmt, found.waterplane_area, found.wetted_surface

    was, told = hull.particulars, afloat(hull)
    before = hull.fingerprint
    with hull.edit("open her") as edit:
        edit.set_particulars(draught=0.9 * was.draught, deck="open")
    assert edit.report is not None
    assert not edit.report.relofted
    assert any("the deck is open now" in each for each in edit.report.notes)
    hull.save(tmp_path / "a.hull")
    again = ah.open(tmp_path / "a.hull")
    assert hull.particulars == attrs.evolve(was, draught=0.9 * was.draught, deck="open")
    assert afloat(hull) == afloat(again) != told
    assert hull.measure() == again.measure()
    kg = 0.5 * was.depth
    assert str(hull.stability(kg=kg)) == str(again.stability(kg=kg))
    assert not hull.verify()
    hull.undo()
    assert (hull.fingerprint, hull.particulars) == (before, was)
    assert afloat(hull) == told


def test_particulars_that_no_ship_has_are_refused() -> None:
    """And the hull stays as it is."""
    hull = ah.examples.wigley(stations=5, waterlines=4)
    before = hull.fingerprint
    for error, given in (
        (ah.errors.OutOfRangeError, {"draught": 20.0}),
        (ah.errors.BadInputError, {}),
        (ah.errors.BadInputError, {"deck": "shut"}),
        (ah.errors.BadInputError, {"draught": 0.0}),
    ):
        with pytest.raises(error), hull.edit("wrong") as edit:
            edit.set_particulars(**given)
        assert hull.fingerprint == before
    ship = ah.examples.container_ship_225m()
    formed = pytest.raises(ah.errors.BadInputError, match="made from form parameters")
    with formed, ship.edit("draught") as edit:
        edit.set_particulars(draught=9.0)

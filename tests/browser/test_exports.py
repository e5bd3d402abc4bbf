"""Files for other programs, written from the page."""

from pathlib import Path

import pytest
from playwright.sync_api import expect

import assoc_hull as ah
from tests.browser.conftest import Open
from tests.browser.test_panels import opened

BEGINS = {
    "pdf": b"%PDF", "svg": b"<?xml", "dxf": b"", "csv": b"", "xlsx": b"PK", "hull.json": b"{",
    "stl": b"",
}  # fmt: skip
SAME = ("dxf", "csv", "hull.json")


def test_files_are_handed_over_as_downloads(open_page: Open, hull: ah.Hull, tmp_path: Path) -> None:
    """They are those of the library, named by the ship, and the hull stays as it is."""
    hand, before = open_page(hull), hull.fingerprint
    box = opened(hand, "Export")
    for form, begins in BEGINS.items():
        box.locator("select").select_option(form)
        with hand.page.expect_download() as download:
            box.get_by_text("Write the file").click()
        name = f"Series-60-CB-0.70.{form}"
        assert download.value.suggested_filename == name
        target = tmp_path / f"found.{form}"
        download.value.save_as(target)
        assert target.stat().st_size > 1000
        assert target.read_bytes().startswith(begins)
        expect(box).to_contain_text(name, use_inner_text=True)
        if form in SAME:
            hull.export(tmp_path / name)
            assert target.read_bytes() == (tmp_path / name).read_bytes()
    assert hull.fingerprint == before


def test_a_file_that_cannot_be_written_is_told_in_a_sentence(
    open_page: Open, hull: ah.Hull, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is missing and how to have it; no file is handed over, and the next one is written."""

    def missing(*_: object) -> None:
        raise ah.errors.MissingExtraError("matplotlib", "plot")

    hand = open_page(hull)
    box = opened(hand, "Export")
    with monkeypatch.context() as patch:
        patch.setattr("assoc_hull.page.session.write_export", missing)
        handed = list[object]()

        def taken(file: object) -> None:
            handed.append(file)

        hand.page.on("download", taken)
        box.get_by_text("Write the file").click()
        box.get_by_text("assoc-hull[plot]").wait_for()
        assert handed == []
        expect(box).to_contain_text("matplotlib", use_inner_text=True)
    box.locator("select").select_option("csv")
    with hand.page.expect_download() as download:
        box.get_by_text("Write the file").click()
    assert download.value.suggested_filename.endswith(".csv")


def test_a_second_window_shows_the_edits_of_the_other_under_its_name(
    open_page: Open, hull: ah.Hull
) -> None:
    """Both windows show the same hull, and the history says whose the edit is."""
    anna = open_page(hull)
    bert = open_page(server=anna.server)
    bert.ask("p => p.sign('bert')")
    box = opened(anna, "History")
    bert.ask(
        "p => p.apply('fuller', [{op: 'pull', point: 'WL 0.625 x ST 16', d: 0.02,"
        " radius: [15, 5]}])"
    )
    anna.until("p => p.store.history.edits === 1")
    box.get_by_text("fuller", exact=True).first.wait_for()
    expect(box.locator("li").first).to_contain_text("bert", use_inner_text=True)
    told = anna.page.locator("details:has(h2:text-is('Edit'))")
    for word in ("fuller", "bert"):
        expect(told).to_contain_text(word, use_inner_text=True)
    assert anna.shows_what_is_published()
    anna.page.keyboard.press("Control+z")
    anna.page.locator(".banner").get_by_text("0 steps of theirs").wait_for()
    assert len(hull.history) == 1

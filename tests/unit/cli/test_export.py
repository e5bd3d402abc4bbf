"""The command `export`: what it writes, what it says, and what `import` makes of it."""

from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from tests.unit.cli.conftest import Json


@pytest.mark.parametrize(
    ("name", "form", "lines"),
    [
        ("a.csv", "csv", 21), ("a.xlsx", "xlsx", 21), ("a.bri", "britfair", 21),
        ("a.txt", "delftship", 21), ("a.gf", "gf", 21), ("a.hull.json", "hull", 31),
    ],
)  # fmt: skip
def test_the_ending_chooses_the_form(
    hull: Path, facts: Json, tmp_path: Path, name: str, form: str, lines: int
) -> None:
    """The report tells form, lines, largest rounding and what was left out."""
    found = facts("export", hull, "-o", tmp_path / name)["export"]
    assert (found["form"], found["lines"]) == (form, lines)
    assert found["largest"] <= max(found["rounding"], 1e-12) * (1 + 1e-6)
    assert found["path"] == str(tmp_path / name)
    assert {note["kind"] for note in found["left_out"]} <= {
        "boundary", "lines", "end", "tangents"
    }  # fmt: skip
    assert (tmp_path / name).stat().st_size > 500


def test_the_format_may_be_chosen(hull: Path, facts: Json, tmp_path: Path) -> None:
    """`--format` counts before the ending, and words say what was written."""
    out = tmp_path / "a.txt"
    assert (
        facts("export", hull, "-o", out, "--format", "delftship-offsets")["export"]["form"]
        == "delftship-offsets"
    )
    assert out.read_text().startswith("Station")


def test_words_say_what_is_not_in_the_file(
    hull: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without --json a person reads the same."""
    assert main(["export", str(hull), "-o", str(tmp_path / "a.bri")]) == 0
    text = capsys.readouterr().out
    assert "21 lines in 21 curves" in text
    assert "mm at most" in text
    assert "left out (3)" in text
    assert "plumb at x = 100 m: written as a section of half-breadth 0" in text
    assert "waterlines: 10 lines are left out" in text


@pytest.mark.parametrize("name", ["a.csv", "a.bri", "a.gf"])
def test_what_was_exported_is_imported(hull: Path, facts: Json, tmp_path: Path, name: str) -> None:
    """`import` tells the form by the content and makes a hull in which `check` finds nothing."""
    facts("export", hull, "-o", tmp_path / name)
    (tmp_path / name).rename(tmp_path / "sent")
    facts("import", tmp_path / "sent", "-o", tmp_path / "back.hull.json")
    assert facts("check", tmp_path / "back.hull.json")["findings"] == []
    assert len(ah.open(tmp_path / "back.hull.json").groups["sections"].lines) == 19


@pytest.mark.parametrize(
    ("arguments", "holds"),
    [
        (["-o", "a.dat"], ".bri"),
        (["-o", "a.csv", "--format", "acis"], "'acis'"),
        (["-o", "none/a.csv"], "there is no folder none"),
        (["-o", "."], "."),
        ([], "-o"),
    ],
)
def test_wrong_arguments_are_one_line(
    hull: Path,
    arguments: list[str],
    holds: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """An unknown form or place ends with exit code 2, one line, and no file."""
    monkeypatch.chdir(hull.parent)
    assert main(["export", str(hull), *arguments]) == 2
    told = capsys.readouterr()
    assert holds in told.err
    assert told.err.count("\n") == 1
    assert [path.name for path in hull.parent.iterdir()] == [hull.name]


def test_an_export_that_fails_leaves_the_old_file(
    hull: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The disk is full: one line, the old file as it was, nothing beside it."""
    out = tmp_path / "a.csv"
    out.write_text("old")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("assoc_hull.io.write_file.os.replace", full)
    assert main(["export", str(hull), "-o", str(out)]) == 2
    assert "No space left on device" in capsys.readouterr().err
    assert out.read_text() == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.csv", hull.name]


@pytest.mark.parametrize(
    "command",
    [["export", "--format", "csv"], ["export", "--format", "hull"], ["graph"]],
    ids=["csv", "text", "graph"],
)
def test_nothing_else_is_written_over_a_hull_file(
    hull: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], command: list[str]
) -> None:
    """A hull file keeps its history: the one that is read, any other, and under any name."""
    files = [tmp_path / name for name in ("own.hull", "other.hull", "kept.csv")]
    for file in files[:2]:
        assert main(["import", str(hull), "-o", str(file)]) == 0
    files[2].write_bytes(files[1].read_bytes())
    before = [file.read_bytes() for file in files]
    capsys.readouterr()
    for file in files:
        assert main([command[0], str(files[0]), "-o", str(file), *command[1:]]) == 2
        assert "a hull file would be written over" in capsys.readouterr().err
    assert [file.read_bytes() for file in files] == before
    assert main([command[0], str(files[0]), "-o", str(tmp_path / "new.hull"), *command[1:]]) == 2
    assert "the ending .hull is that of hull files" in capsys.readouterr().err
    assert not (tmp_path / "new.hull").exists()


def test_a_form_is_not_written_over_the_text_that_is_read(
    hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A table in the place of the hull would be all that is left of it."""
    before = hull.read_bytes()
    assert main(["export", str(hull), "-o", str(hull), "--format", "csv"]) == 2
    assert "the hull would be written over" in capsys.readouterr().err
    assert hull.read_bytes() == before


def test_python_refuses_the_same(tmp_path: Path) -> None:
    """`hull.export` and `hull.save` to text leave hull files alone, an open one too."""
    ship = ah.examples.wigley()
    ship.save(tmp_path / "ship.hull")
    with pytest.raises(ah.errors.BadInputError, match="a hull file would be written over"):
        ship.export(tmp_path / "ship.hull", "gf")
    (tmp_path / "kept.hull.json").write_bytes((tmp_path / "ship.hull").read_bytes())
    with pytest.raises(ah.errors.BadInputError, match="a hull file would be written over"):
        ship.save(tmp_path / "kept.hull.json")
    with ship.edit("after") as edit:
        edit.move("WL 2.5 x ST 7", y=2.95)
    ship.close()
    again = ah.open(tmp_path / "ship.hull")
    assert len(again.history) == 1
    again.close()

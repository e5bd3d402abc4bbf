"""Whatever is wrong, one line says what, where and what to do; nothing is written."""

import builtins
import errno
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.cli import arranged, inspection, main
from assoc_hull.cli.command_table import COMMANDS
from assoc_hull.cli.commands import make_parser
from assoc_hull.cli.hull_words import wrap_text
from assoc_hull.cli.problems import in_shell
from tests.unit.test_errors import SAMPLES

Edits = Callable[[object], Path]


def error_of(arguments: list[object], capsys: pytest.CaptureFixture[str], code: int = 2) -> str:
    """The one line on standard error of a command that fails."""
    assert main([str(each) for each in arguments]) == code
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.startswith("error: ")
    assert told.err.count("\n") == 1
    return told.err


@pytest.mark.parametrize(
    ("arguments", "holds"),
    [
        ([], "COMMAND"),
        (["paint"], "'paint'"),
        (["info"], "HULL"),
        (["info", "a", "b"], "arguments: b; options stand behind all values, in assoc-hull info"),
        (["vary", "a", "breadth", "10.3"], "breadth 10.3; write breadth=10.3, in assoc-hull vary"),
        (["report", "a", "-o", "a.pdf", "--KG", "3"], "--KG 3; did you mean '--kg'?"),
        (
            ["jumboise", "a", "3", "--dry-run"],
            "--dry-run; there is no such option, in assoc-hull jumboise",
        ),
        (["report", "none.hull", "-o", "a.gif"], "at a.gif; end the name in .pdf"),
        (["example", "titanic", "-o", "a.hull.json"], "'titanic'"),
        (["example", "wigley"], "-o"),
        (["example", "wigley", "-o", "a.csv"], ".hull.json"),
        (["example", "wigley", "-o", "none/a.hull.json"], "there is no folder none"),
        (["import", "a.csv", "-o", "a.hull.json", "--length", "long"], "'long'"),
        (["import", "a.csv", "-o", "a.hull.json", "--length", "nan"], "length is nan"),
        (["import", "none.csv", "-o", "a.hull.json"], "none.csv"),
        (["import", ".", "-o", "a.hull.json"], "."),
        (["graph", "a.hull.json", "--hops", "-1"], "'-1'"),
        (["graph", "a.hull.json", "--format", "gif"], "'gif'"),
        (["plot", "a.hull.json", "-o", "lines.gif"], ".pdf"),
        (["plot", "a.hull.json", "-o", "none/lines.pdf"], "there is no folder none"),
        (["plot", "none.hull.json", "-o", "lines.pdf"], "No such file"),
        (["verify", "a.hull.json", "--relative", "much"], "'much'"),
        (["verify", "none.hull.json", "--relative", "-1"], "none.hull.json"),
    ],
)
def test_wrong_arguments(
    arguments: list[object],
    holds: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """The argument is named, and nothing is written."""
    monkeypatch.chdir(tmp_path)
    assert holds in error_of(arguments, capsys)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("command", ["info", "check", "verify", "graph"])
@pytest.mark.parametrize(
    ("content", "holds"),
    [
        pytest.param(None, "No such file", id="missing"),
        pytest.param(b"\xff\xfe\x00\x01" * 99, "no UTF-8", id="binary"),
        pytest.param(b"", "no JSON", id="empty"),
        pytest.param(b'{"format": "other"}', "'other'", id="other JSON"),
        pytest.param(b"[1, 2]", "no JSON object", id="a list"),
        pytest.param(b'{"format": NaN}', "NaN", id="nan"),
        pytest.param(b"[" * 100_000, "ship.hull.json", id="deep"),
    ],
)
def test_wrong_hull_files(
    command: str,
    content: bytes | None,
    holds: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """File and trouble are named."""
    path = tmp_path / "ship.hull.json"
    if content is not None:
        path.write_bytes(content)
    assert holds in error_of([command, path], capsys)


def test_a_folder_is_no_hull(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Neither to read nor to write, nor is a file a folder."""
    assert "this is a folder" in error_of(["info", tmp_path], capsys)
    target = tmp_path / "x.hull.json"
    target.mkdir()
    assert "this is a folder" in error_of(["example", "wigley", "-o", target], capsys)
    file = tmp_path / "file"
    file.write_text("")
    assert "this is a file" in error_of(["demo", "--out", file], capsys)


def test_a_changed_hull_file_is_found(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """By its fingerprint."""
    hull.write_bytes(hull.read_bytes().replace(b'"Wigley"', b'"Wiggly"'))
    assert "fingerprint" in error_of(["info", hull], capsys)


@pytest.mark.parametrize(
    ("content", "holds"),
    [
        pytest.param("{", "no JSON", id="no JSON"),
        pytest.param("{}", "no list", id="an object"),
        pytest.param("[]", "empty", id="empty"),
        pytest.param("[5]", "modification 1", id="a number"),
        pytest.param('[{"point": "WL 2.5"}]', "no 'op'", id="no op"),
        pytest.param([{"op": "explode"}], "'explode'", id="unknown op"),
        pytest.param([{"op": "_point"}], "'_point'", id="private op"),
        pytest.param(
            [{"op": "move", "point": "WL 2.5 x ST 99", "y": 1}], "'WL 2.5 x ST 99'", id="point"
        ),
        pytest.param(
            [{"op": "move", "point": "WL 2.5 x ST 7", "x": 1}], "free along y", id="freedom"
        ),
        pytest.param('[{"op": "move", "point": "WL 2.5 x ST 7", "y": NaN}]', "NaN", id="nan"),
        pytest.param(
            [{"op": "move", "point": "WL 2.5 x ST 7", "y": "wide"}], "'wide'", id="no number"
        ),
        pytest.param(
            [{"op": "move", "point": 7, "y": 1}], "the point is 7", id="point is a number"
        ),
        pytest.param([{"op": "move", "punkt": "WL 2.5"}], "punkt", id="unknown argument"),
        pytest.param(
            [{"op": "pull", "point": "WL 2.5 x ST 7", "d": 0.1, "radius": 5}],
            "modification 1", id="one radius",
        ),
        pytest.param(
            [{"op": "pull", "point": "WL 2.5 x ST 7", "d": 0.1, "radius": ["a", "b"]}],
            "edits.json", id="radii are words",
        ),
        pytest.param(
            [{"op": "reshape", "curve": "WL 2.5", "points": "round", "span": [1, 2]}],
            "modification 1", id="points are a word",
        ),
        pytest.param(
            [{"op": "set_role", "crossing": "WL 2.5 x ST 7", "role": "boss"}], "boss", id="role"
        ),
        pytest.param([{"op": "rename", "obj": "WL 2.5", "name": "ST 7"},
                      {"op": "rename", "obj": "no", "name": "x"}], "modification 2", id="second"),
    ],
)  # fmt: skip
def test_wrong_edits(
    content: object, holds: str, hull: Path, edits: Edits, capsys: pytest.CaptureFixture[str]
) -> None:
    """The modification is named, the hull file is as before."""
    before, file = hull.read_bytes(), edits(content)
    line = error_of(["edit", hull, file], capsys)
    assert holds in line
    assert "edits.json" in line
    assert hull.read_bytes() == before


@pytest.mark.parametrize("content", [None, b"\xff\xfe[]"])
def test_wrong_files_of_edits(
    content: bytes | None, hull: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Missing, or no text."""
    file = tmp_path / "edits.json"
    if content is not None:
        file.write_bytes(content)
    assert "edits.json" in error_of(["edit", hull, file], capsys)


def test_a_driven_crossing_names_its_driver(
    hull: Path, edits: Edits, capsys: pytest.CaptureFixture[str]
) -> None:
    """And the ways out."""
    before, ship = hull.read_bytes(), ah.open(hull)
    driven = next(point for point in map(ship.find, ship.points) if _is_driven(point))
    assert isinstance(driven, ah.Point)
    assert driven.driver is not None
    change = {"op": "move", "point": driven.name, driven.free[0]: 1.0}
    line = error_of(["edit", hull, edits([change])], capsys)
    assert f"computed from {driven.driver.name}" in line
    assert "set_role" in line
    assert hull.read_bytes() == before


def _is_driven(point: object) -> bool:
    return isinstance(point, ah.Point) and point.driver is not None and len(point.free) == 1


def test_an_unknown_object_of_why_writes_nothing(
    hull: Path, edits: Edits, capsys: pytest.CaptureFixture[str]
) -> None:
    """Though the edit itself is good."""
    before, place = hull.read_bytes(), ah.open(hull).points["WL 2.5 x ST 7"]
    file = edits([{"op": "move", "point": place.name, "y": place.y + 0.01}])
    assert "'ST 99'" in error_of(["edit", hull, file, "--why", "ST 99"], capsys)
    assert hull.read_bytes() == before


def test_a_missing_extra_is_named(
    hull: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the command that installs it."""
    real = builtins.__import__

    def without(name: str, *rest: Any) -> Any:
        if name.partition(".")[0] == "matplotlib":
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    line = error_of(["plot", hull, "-o", hull.with_name("lines.pdf")], capsys)
    assert "pip install 'assoc-hull[plot]'" in line


def test_the_keyboard_stops_quietly(
    hull: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """One line, and the code that shells expect."""

    def stop(_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(inspection, "open_hull", stop)
    assert "keyboard" in error_of(["info", hull], capsys, code=130)


def test_a_fault_of_the_program_is_one_line_too(
    hull: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """With its place; the traceback only if it was asked for."""
    monkeypatch.setattr(inspection, "open_hull", lambda _: 1 / 0)
    arguments: list[object] = ["plot", hull, "-o", hull.with_name("lines.pdf")]
    assert "ZeroDivisionError inside the program" in error_of(arguments, capsys)
    monkeypatch.setenv("ASSOC_HULL_DEBUG", "1")
    assert main([str(each) for each in arguments]) == 2
    assert "Traceback" in capsys.readouterr().err


def test_a_file_that_cannot_be_written_is_named(
    hull: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """And nothing is left of it; what was there stays."""

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "graph.dot")

    target = hull.with_name("graph.dot")
    target.write_text("old")
    monkeypatch.setattr(os, "fsync", full)
    line = error_of(["graph", hull, "-o", target], capsys)
    assert "No space left" in line
    assert "graph.dot" in line
    assert target.read_text() == "old"
    assert sorted(hull.parent.iterdir()) == [target, hull]


@pytest.mark.skipif(os.name != "posix", reason="shell of another system")
def test_a_reader_that_goes_is_no_error(hull: Path) -> None:
    """Nothing on standard error, and the code of a process that a closed pipe ended."""
    code = "import sys; from assoc_hull.cli import main; sys.exit(main())"
    command = [sys.executable, "-c", code, "graph", str(hull)]
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "wb") as gone:
        run = subprocess.run(command, stdout=gone, stderr=subprocess.PIPE, check=False)
    assert (run.returncode, run.stderr) == (141, b"")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
def test_an_output_that_is_full_is_one_line(hull: Path) -> None:
    """Not a second one when Python ends."""
    code = "import sys; from assoc_hull.cli import main; sys.exit(main())"
    command = [sys.executable, "-c", code, "info", str(hull)]
    with open("/dev/full", "w") as full:
        run = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert run.returncode == 2
    assert run.stderr.count("\n") == 1
    assert "No space left" in run.stderr


def test_arguments_of_the_library_are_told_as_options(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What a message says to give can be typed."""
    table = tmp_path / "t.csv"
    table.write_text("station,0,1,2\n0,0,0,1\n1,0,2,3\n2,1,2,3\n3,0,2,3\n4,0,0,1\n")
    command: list[object] = ["import", table, "-o", tmp_path / "t.hull"]
    assert "give --length (Lpp in m)" in error_of(command, capsys)
    assert "give --station-zero ap or fp" in error_of([*command, "--length", "20"], capsys)


OPTIONS = {each: "--" + each.replace("_", "-") for each in ("free", "noise", "on_error", "accept")}


@pytest.mark.parametrize(
    ("text", "typed"),
    [
        ("give free=[names]", "give --free NAME"),
        ("or accept=True.", "or --accept."),
        ("noise=0.001 is 1 mm; in the shell --noise 1", None),
        ("with on_error='report' (--on-error report)", None),
        ("give other=", None),
        ("column 'free=' of a.csv", None),
        ("the file ship-free= is no hull", None),
    ],
)
def test_only_bare_arguments_of_the_command_are_rewritten(text: str, typed: str | None) -> None:
    """What a message says of the shell itself, and arguments of no option, stay."""
    assert in_shell(text, OPTIONS) == (typed or text)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_error_is_told_in_options_that_its_command_has(name: str) -> None:
    """A message changes only where it names an argument, and then to an option of the command."""
    main_parser: Any = make_parser([name])
    command = main_parser._subparsers._group_actions[0].choices[name]
    typed = {
        each.dest: max(each.option_strings, key=len)
        for each in command._actions
        if each.option_strings
    }
    for error, _, _ in SAMPLES:
        words = zip(str(error).split(" "), in_shell(str(error), typed).split(" "), strict=True)
        changed = [each for each in words if each[0] != each[1]]
        assert changed in ([], [("wait=", "--wait")])


def test_a_compromise_is_named_as_it_is_typed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """More targets than what is free: the message has the option, and that works."""
    file = tmp_path / "w.hull"
    assert main(["example", "wigley", "-o", str(file)]) == 0
    words = ["vary", str(file), "--reach", "volume=2800", "--reach", "lcb=50.1", "--free",
             "breadth", "--dry-run"]  # fmt: skip
    capsys.readouterr()
    assert "(--compromise)" in error_of([*words], capsys)
    assert main([*words, "--compromise"]) == 0


@pytest.mark.parametrize("option", ["-o", "--out"])
def test_the_file_of_a_report_may_stand_behind_an_option(option: str) -> None:
    """As of all other commands; an option with several values does not take it."""
    rest = ["--parts", "lines", "form"]
    want = ["report", "s.hull", "r.pdf", *rest]
    assert arranged(["report", "s.hull", *rest, option, "r.pdf"]) == want
    assert arranged(["report", option, "r.pdf", "s.hull", *rest]) == want


@pytest.mark.parametrize("flag", ["--dry-run", "--json", "--fair", "--compromise", "--replace"])
def test_a_value_of_a_variation_may_stand_behind_a_flag(flag: str) -> None:
    """Only what an option takes stays with it."""
    assert arranged(["vary", "s.hull", flag, "breadth=18"]) == [
        "vary", "s.hull", flag, "--set", "breadth=18",
    ]  # fmt: skip
    kept = ["vary", "s.hull", "--reach", "volume=3", "--name", "b=18"]
    assert arranged(kept) == kept


def test_a_long_note_is_parted_between_words() -> None:
    """Sentences are longer than a line; names stay whole."""
    words = ["a sentence of many words that goes on " * 4, "WL 0.5"]
    lines = wrap_text("notes", words).split()
    assert lines == ["notes", *f"{words[0]}, WL 0.5".split()]

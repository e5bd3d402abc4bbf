"""Every command does what its help says, in words and as JSON."""

import json
import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from tests.unit.cli.conftest import Json

TABLE = """# station 0 = AP
station,wl_0,wl_1,wl_2,wl_3,wl_4,wl_5,wl_6
0,0,0,0,0,0.1,0.8,1.4
1,0,0.4,0.9,1.3,1.8,2.4,2.9
2,0.5,1.9,2.6,3.0,3.4,3.7,3.9
4,1.8,3.4,3.8,4.0,4.0,4.0,4.0
6,1.8,3.4,3.8,4.0,4.0,4.0,4.0
8,0.6,2.0,2.6,2.9,3.1,3.3,3.5
9,0.2,0.8,1.2,1.4,1.6,1.9,2.3
10,0,0,0,0,0,0.2,0.5
"""


def test_the_version_is_that_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    """On standard output."""
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"assoc-hull {ah.__version__}\n"


@pytest.mark.parametrize("module", ["assoc_hull", "assoc_hull.cli"])
def test_the_program_runs_as_a_module(module: str) -> None:
    """In a process of its own."""
    command = [sys.executable, "-m", module, "--version"]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    assert (run.stdout, run.stderr) == (f"assoc-hull {ah.__version__}\n", "")


def test_help_shows_examples(capsys: pytest.CaptureFixture[str]) -> None:
    """On standard output; `test_help.py` goes through all commands."""
    assert main(["info", "--help"]) == 0
    assert "examples:\n  assoc-hull info " in capsys.readouterr().out


@pytest.mark.usefixtures("made_already")
@pytest.mark.parametrize(
    "name",
    [
        "wigley",
        pytest.param("series60-060", marks=pytest.mark.slow),
        pytest.param("series60-070", marks=pytest.mark.slow),
        pytest.param("bulk-carrier-207k", marks=pytest.mark.slow),
        pytest.param("bulk-carrier-180m", marks=pytest.mark.slow),
        pytest.param("container-ship-225m", marks=pytest.mark.slow),
        "plain-ship",
    ],
)
def test_an_example_is_written(name: str, tmp_path: Path, facts: Json) -> None:
    """It is the hull of that name."""
    path = tmp_path / "ship.hull.json"
    found = facts("example", name, "-o", path)
    assert ah.open(path).fingerprint == found["fingerprint"]
    assert ah.open(path).particulars.name.lower().startswith(name[:4])


def test_a_table_is_imported_with_its_report(tmp_path: Path, facts: Json) -> None:
    """Assumptions, rounding and deviations come as data, on the output and in the file."""
    table, out, report = (tmp_path / name for name in ("s.csv", "s.hull.json", "report.json"))
    table.write_text(TABLE, "utf-8")
    given = ["--length", 60, "--breadth", 8, "--draught", 4, "--unit", "m", "--station-zero", "ap"]
    found = facts("import", table, "-o", out, *given, "--report", report)
    assert json.loads(report.read_text("utf-8")) == found["report"]
    parts = ["format", "schema", "offsets", "rounding", "adoption", "verdict"]
    assert list(found["report"]) == parts
    assert (found["report"]["format"], found["report"]["schema"]) == ("assoc-hull report", 1)
    assert found["report"]["rounding"][0] == {"z": 0.0, "rounding": pytest.approx(0.05)}
    first = found["report"]["adoption"]["lines"][0]
    assert {
        "curve", "group", "line", "given", "defining", "crossings", "adopted", "placed",
        "deviation_median", "deviation_p95", "deviation", "place", "tolerance", "tolerance_used",
        "inflections_given", "inflections",
    } == set(first)  # fmt: skip
    ship = ah.open(out)
    assert ship.fingerprint == found["fingerprint"]
    assert (ship.particulars.length, ship.particulars.draught) == (60.0, 4.0)


def test_a_report_is_not_written_over_the_hull(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One name for both would leave the report only."""
    table, out = tmp_path / "s.csv", tmp_path / "s.hull.json"
    table.write_text(TABLE, "utf-8")
    assert main(["import", str(table), "-o", str(out), "--report", str(out)]) == 2
    assert "the report would be written over the hull" in capsys.readouterr().err
    assert not out.exists()


def test_an_import_tells_what_it_assumed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In words."""
    (tmp_path / "s.csv").write_text(TABLE, "utf-8")
    arguments = ["import", tmp_path / "s.csv", "-o", tmp_path / "s.hull.json", "--length", "60"]
    assert main([*map(str, arguments), "--unit", "m"]) == 0
    text = capsys.readouterr().out
    assert "station zero: " in text
    assert "rounding: +-50 mm at waterlines" in text


def test_info_names_the_lines(hull: Path, facts: Json, capsys: pytest.CaptureFixture[str]) -> None:
    """The facts are those of the Python objects."""
    found, ship = facts("info", hull), ah.open(hull)
    assert found["fingerprint"] == ship.fingerprint
    assert found["particulars"]["length"] == ship.particulars.length
    assert found["groups"]["sections"]["lines"] == list(ship.groups["sections"].lines)
    assert sum(found["points"].values()) == len(ship.points)
    assert sum(found["crossings"].values()) == len(ship.crossings)
    assert main(["info", str(hull)]) == 0
    assert "ST 7, ST 8" in capsys.readouterr().out


def test_a_sound_hull_has_no_findings(hull: Path, facts: Json) -> None:
    """Exit 0 of check and verify; notes are no findings."""
    assert facts("check", hull) == {"findings": []}
    facts("check", hull, "--notes")
    found = facts("verify", hull)
    assert (found["differences"], found["fingerprint"]) == ([], ah.open(hull).fingerprint)


def test_findings_and_differences_give_exit_1(
    hull: Path, facts: Json, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each comes with kind, object, place and amount, or key, field and amount."""
    from assoc_hull.edit.checks.finding import Finding
    from assoc_hull.model.definition.restore import Difference

    gap = Finding("gap", "WL 1 x ST 2", (1.0, 2.0, 3.0), 0.004, "is wide")
    odd = Difference("sections:1/1", "spline.xyz", float("inf"))
    monkeypatch.setattr(ah.Hull, "check", lambda self, notes: (gap,))
    monkeypatch.setattr(ah.Hull, "verify", lambda self, relative: (odd,))
    found = facts("check", hull, code=1)["findings"][0]
    assert (found["kind"], found["place"], found["amount"]) == ("gap", [1.0, 2.0, 3.0], 0.004)
    found = facts("verify", hull, code=1)["differences"]
    assert found == [{"key": "sections:1/1", "field": "spline.xyz", "amount": None}]
    assert main(["check", str(hull)]) == 1
    assert main(["verify", str(hull)]) == 1


@pytest.mark.parametrize("form", ["dot", "graphml", "mermaid", "json"])
def test_a_graph_is_written(
    form: str, hull: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """On standard output or to a file, the same text; JSON and GraphML parse."""
    arguments = ["graph", str(hull), "--format", form, "--around", "WL 2.5 x ST 7", "--hops", "1"]
    assert main(arguments) == 0
    text = capsys.readouterr().out
    assert "WL 2.5 x ST 7" in text
    assert main([*arguments, "-o", str(tmp_path / "graph.txt")]) == 0
    assert (tmp_path / "graph.txt").read_text("utf-8") == text
    if form == "json":
        assert {"nodes", "edges"} <= set(json.loads(text))
    if form == "graphml":
        assert len(ElementTree.fromstring(text)) > 1


def test_the_whole_graph_is_written(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Without an object to look around, all of it."""
    assert main(["graph", str(hull), "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert len(found["nodes"]) == len(ah.open(hull).graph())


def test_graphs_are_filtered(hull: Path, facts: Json) -> None:
    """By way, by what lies up and down, both; the filters are those of Python."""
    ship = ah.open(hull)
    with ship.edit("declare") as edit:
        edit.associate("sections", "waterlines", two_way=False)
    ship.save(hull)
    for only in ("two-way", "one-way", "latent"):
        found = facts("graph", hull, "--only", only)
        assert [each["id"] for each in found["nodes"]] == list(ship.graph(only=only))
    near = facts("graph", hull, "--around", "WL 2.5", "--up", 1, "--down", 0)
    assert [each["id"] for each in near["nodes"]] == list(ship.graph(around="WL 2.5", down=0))
    both = facts("graph", hull, "--around", "WL 2.5 x ST 7", "--only", "one-way", "--hops", 1)
    ways = {(each["kind"], each["way"]) for each in both["edges"] if "way" in each}
    assert ways == {("touch actual", "one-way")}


def test_a_graph_of_nothing_is_told(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """On standard error; the text is that of a graph without nodes."""
    assert main(["graph", str(hull), "--only", "one-way"]) == 0
    told = capsys.readouterr()
    assert told.out == "digraph hull {\n}\n"
    assert "the graph is empty" in told.err


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (["--hops", "2"], "--around"),
        (["--only", "both"], "two-way"),
        (["--around", "WL 77"], "WL 5"),
        (["--only", "changed"], "history of 0"),
        (["--step", "1"], "make an edit first"),
        (["--around", "WL 2.5", "--hops", "-1"], "0 or more"),
        (["--json", "--format", "dot"], "not allowed"),
    ],
    ids=["no centre", "filter", "name", "no history", "no edit", "hops", "two forms"],
)  # fmt: skip
def test_filters_that_cannot_be_used_are_named(
    arguments: list[str], word: str, hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In one line, exit 2."""
    assert main(["graph", str(hull), *arguments]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert word in told.err
    assert told.err.count("\n") == 1


def test_a_graph_does_not_replace_its_hull(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """However the file is called."""
    before = hull.read_bytes()
    (hull.parent / "link").symlink_to(hull)
    for name in (hull, hull.parent / "link"):
        assert main(["graph", str(hull), "-o", str(name)]) == 2
        assert "the hull would be written over" in capsys.readouterr().err
    assert hull.read_bytes() == before


def test_a_graph_is_the_same_in_every_process(hull: Path) -> None:
    """In every form; nothing depends on the seed of hashes."""
    code = """
import sys
from assoc_hull.cli import main
for form in ("dot", "graphml", "mermaid", "json"):
    main(["graph", sys.argv[1], "--format", form, "--around", "WL 2.5", "--hops", "1"])
"""
    found = [
        subprocess.run(
            [sys.executable, "-c", code, str(hull)], capture_output=True, check=True,
            env={**os.environ, "PYTHONHASHSEED": seed},
        ).stdout
        for seed in ("1", "2")
    ]  # fmt: skip
    assert found[0].count(b"WL 2.5 x ST 7") > 4
    assert found[0] == found[1]


def test_names_of_lines_may_hold_marks(hull: Path, tmp_path: Path) -> None:
    """Each form can be read after lines were renamed to what the forms are made of."""
    ship, name = ah.open(hull), 'a "b" (c) <d> | & \\ ; 船体 {e}'
    with ship.edit("rename") as edit:
        edit.rename("WL 2.5", name)
    ship.save(hull)
    out = tmp_path / "graph"
    for form in ("dot", "graphml", "mermaid", "json"):
        command = ["graph", str(hull), "--around", name, "--format", form, "-o", str(out)]
        assert main(command) == 0
        text = out.read_text("utf-8")
        if form == "json":
            names = [each["name"] for each in json.loads(text)["nodes"]]
            assert f"{name} x ST 7" in names
        if form == "graphml":
            found = ElementTree.fromstring(text).iter("{http://graphml.graphdrawing.org/xmlns}data")
            assert f"{name} x ST 7" in [each.text for each in found]
        assert "船体" in text


@pytest.mark.parametrize("ending", ["pdf", "svg", "png"])
def test_lines_are_plotted(ending: str, hull: Path, tmp_path: Path) -> None:
    """In each form that the ending may ask for."""
    pytest.importorskip("matplotlib")
    path = tmp_path / f"lines.{ending}"
    assert main(["plot", str(hull), "-o", str(path), "--paper", "A3"]) == 0
    assert path.read_bytes().startswith(
        {"pdf": b"%PDF", "svg": b"<?xml", "png": b"\x89PNG"}[ending]
    )


def test_a_plot_tells_its_file(hull: Path, facts: Json, tmp_path: Path) -> None:
    """As every command that writes one does, in JSON too."""
    pytest.importorskip("matplotlib")
    out = tmp_path / "lines.svg"
    assert facts("plot", hull, "-o", out) == {"saved": str(out)}


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--view", "combs", "--heat", "ratio", "--x", "0", "50"], "heat 0/"),
        (["--combs", "WL 2.5", "--heat", "residual"], "heat 0/"),
        (["--before", "{hull}", "--exaggerate", "50"], "50 times"),
    ],
)
def test_pictures_that_fairing_is_judged_by_are_plotted(
    options: list[str], told: str, hull: Path, tmp_path: Path
) -> None:
    """All combs, with heat and of a stretch; what moved since another hull."""
    pytest.importorskip("matplotlib")
    path = tmp_path / "picture.svg"
    given = [each.format(hull=hull) for each in options]
    assert main(["plot", str(hull), "-o", str(path), *given]) == 0
    assert told in path.read_text("utf-8")


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--exaggerate", "50"], "add --before"),
        (["--before", "a.hull", "--heat", "ratio"], "--before draws what moved"),
        (["--view", "definitions", "--x", "0", "9"], "go with lines and combs"),
    ],
)
def test_options_of_another_picture_are_refused(
    options: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before anything is read."""
    assert main(["plot", "none.hull", "-o", "a.svg", *options]) == 2
    assert told in capsys.readouterr().err


def test_combs_are_plotted(hull: Path, tmp_path: Path) -> None:
    """Of the lines that are named."""
    pytest.importorskip("matplotlib")
    path = tmp_path / "combs.svg"
    assert main(["plot", str(hull), "-o", str(path), "--combs", "WL 2.5", "ST 7"]) == 0
    assert "WL 2.5" in path.read_text("utf-8")


def test_a_template_imports_as_it_stands(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Written once, read without a suspicion; it stands alone and writes over nothing."""
    table, hull = tmp_path / "table.csv", tmp_path / "ship.hull"
    assert main(["import", "--template", str(table)]) == 0
    assert main(["import", str(table), "-o", str(hull)]) == 0
    assert "suspicions (0)" in capsys.readouterr().out
    assert ah.open(hull).hydrostatics().volume == pytest.approx(10360.0, rel=0.01)
    again, both = ["--template", str(table)], ["--template", "b.csv", str(table)]
    for words in (again, both, ["-o", "a.hull"]):
        assert main(["import", *words]) == 2

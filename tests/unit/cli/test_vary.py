"""The command `vary`: named values, scripts, lists, refusals."""

import json
from pathlib import Path
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.variation.parameters.catalogue import NAMES
from tests.unit.cli.conftest import Json


def test_the_hull_is_written_with_its_new_values(hull: Path, tmp_path: Path, facts: Json) -> None:
    """Targets are reached, the file measures them, the parent is as it was."""
    target = tmp_path / "broader.hull"
    found = facts("vary", hull, "--set", "breadth=11", "--set", "draught=7", "-o", target)
    assert [(each["name"], each["reached"]) for each in found["targets"]] == [
        ("breadth", 11.0),
        ("draught", 7.0),
    ]
    varied = ah.open(target)
    assert varied.particulars.breadth == 11.0
    assert varied.measure()["draught"] == 7.0
    assert varied.fingerprint == found["fingerprint"]
    assert ah.open(hull).measure()["breadth"] == 10.0


def test_lines_broader_than_the_ship_are_told_wherever_her_breadth_is_printed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """By `info`, by the list, and by what a variation prints; where they agree, nothing is."""
    ship, broad = tmp_path / "ship.hull", tmp_path / "broad.hull"
    ah.examples.plain_ship().save(ship)
    told = "the lines are at most 18.011 m broad"
    assert main(["info", str(ship)]) == 0
    assert told in capsys.readouterr().out
    assert main(["vary", str(ship), "--list"]) == 0
    assert f"breadth of the ship; {told}" in capsys.readouterr().out
    assert main(["vary", str(ship), "breadth=19", "-o", str(broad)]) == 0
    printed = capsys.readouterr().out
    assert "breadth 18 -> 19 m" in printed
    assert "the lines are at most 19.011 m broad" in printed
    assert main(["info", str(broad)]) == 0
    assert "breadth 19.000 m" in capsys.readouterr().out
    ah.examples.wigley().save(tmp_path / "wigley.hull")
    assert main(["info", str(tmp_path / "wigley.hull")]) == 0
    assert "at most" not in capsys.readouterr().out


def test_a_script_and_options_are_one_request(hull: Path, tmp_path: Path, facts: Json) -> None:
    """The same parent and script give the same fingerprint; the file names the step."""
    script = tmp_path / "broad.json"
    script.write_text(json.dumps({"set": {"breadth": 10.5}}))
    one = facts("vary", hull, "--script", script, "-o", tmp_path / "one.hull")
    two = facts("vary", hull, "--set", "breadth=10.5", "-o", tmp_path / "two.hull")
    assert one["fingerprint"] == two["fingerprint"]
    assert ah.open(tmp_path / "one.hull").history[-1].name == "broad"


def test_an_option_goes_before_what_the_script_says(
    hull: Path, tmp_path: Path, facts: Json
) -> None:
    """Of the same value; what only the script names is asked for as well."""
    script = tmp_path / "broad.json"
    script.write_text(json.dumps({"set": {"breadth": 10.5, "draught": 7}}))
    found = facts(
        "vary", hull, "--script", script, "--set", "breadth=11", "-o", tmp_path / "out.hull"
    )
    reached = {each["name"]: each["reached"] for each in found["targets"]}
    assert reached == {"breadth": 11.0, "draught": 7.0}


def test_followers_are_faired_where_it_is_asked(
    hull: Path, tmp_path: Path, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """With a reach, or as far as is usual; what was done is told, and repeated by the script."""
    command = ["vary", hull, "--set", "breadth=11", "--fair", "0.005"]
    found = facts(*command, "-o", tmp_path / "fair.hull")
    assert found["faired"]["within"] == 0.005
    assert found["faired"]["lines"] == []
    assert found["script"]["fair"] == 0.005
    usual = facts(*command[:-1], "-o", tmp_path / "usual.hull")
    assert usual["script"]["fair"] is True
    assert main([*map(str, command), "-o", str(tmp_path / "told.hull")]) == 0
    assert "followers faired within 5 mm: " in capsys.readouterr().out
    plain = facts("vary", hull, "--set", "breadth=11", "-o", tmp_path / "plain.hull")
    assert plain["faired"] is None


def test_the_list_has_a_line_per_parameter(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One each below the head, with its value or the reason why there is none."""
    assert main(["vary", str(hull), "--list"]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert [row.split()[0] for row in rows[1 : 1 + len(NAMES)]] == list(NAMES)
    assert any(row.startswith("bulb_length") and "no profile" in row for row in rows)
    assert any(row.startswith("depth") and "not with deck_height" in row for row in rows)


def test_intervals_are_those_of_the_layout(hull: Path, facts: Json) -> None:
    """A field that reaches further leaves more room; an interval holds the present value."""

    def listed(*options: str) -> dict[str, dict[str, Any]]:
        found = facts("vary", hull, "--list", *options)["parameters"]
        return {each["name"]: each for each in found}

    usual, far = listed(), listed("--layout", "bow_from=0.5")
    assert usual["draught"]["low"] < usual["draught"]["value"] < usual["draught"]["high"]
    assert far["stem_rake_deg"]["low"] < usual["stem_rake_deg"]["low"] < 0.0
    assert far["breadth"] == usual["breadth"]
    region = listed("--layout", "blend=paper", "--layout", "EX1=60")
    assert region["stem_rake_deg"]["low"] < usual["stem_rake_deg"]["low"]
    assert usual["deadrise_deg"]["reason"] == (
        "cannot be varied: parent has no parallel middle body"
    )


def test_targets_are_reached_by_what_is_free(hull: Path, tmp_path: Path, facts: Json) -> None:
    """The file has the asked volume; the document tells how it was reached, and repeats it."""
    target = tmp_path / "fuller.hull"
    found = facts("vary", hull, "--reach", "volume=2800", "--free", "breadth=9:", "-o", target)
    volume = ah.open(target).hydrostatics().volume
    assert volume == pytest.approx(2800.0, rel=1e-10)
    assert found["aim"]["reached"]
    assert found["aim"]["free"] == ["breadth"]
    assert found["aim"]["values"] == pytest.approx([volume], rel=1e-12)
    assert found["script"]["bounds"] == {"breadth": [9.0, None]}
    assert "hull" not in found["aim"]


def test_a_compromise_is_taken_where_it_is_asked_for(
    hull: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Out of reach: exit 2 and nothing written; with leave for it, the nearest hull is written."""
    target = tmp_path / "near.hull"
    asked = ["vary", str(hull), "--reach", "volume=2800", "--free", "breadth=:10.02",
             "-o", str(target)]  # fmt: skip
    assert main(asked) == 2
    assert "breadth at its bound" in capsys.readouterr().err
    assert not target.exists()
    assert main([*asked, "--compromise"]) == 0
    assert "best compromise" in capsys.readouterr().out
    assert ah.open(target).measure()["breadth"] == pytest.approx(10.02, abs=1e-6)


def test_options_add_to_what_a_script_frees(hull: Path, tmp_path: Path, facts: Json) -> None:
    """Names on the command line join those of the file, and their bounds go before its own."""
    script = tmp_path / "aim.json"
    given = {"reach": {"volume": 2800}, "free": ["breadth"], "bounds": {"breadth": [9, 10.01]}}
    script.write_text(json.dumps(given))
    options = "--free", "breadth=9:11", "--free", "draught=6.2:6.3"
    found = facts("vary", hull, "--script", script, *options, "-o", tmp_path / "out.hull")
    assert found["script"]["free"] == ["breadth", "draught"]
    assert found["script"]["bounds"] == {"breadth": [9.0, 11.0], "draught": [6.2, 6.3]}
    assert found["aim"]["steps"][-1]["kkt"] <= 1e-6


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--set", "bredth=11"], "the nearest names are 'breadth'"),
        (["--set", "breadth"], "give NAME=VALUE"),
        (["--set", "breadth=wide"], "breadth"),
        (["--set", "breadth=11", "--set", "breadth=12"], "given twice"),
        (["--set", "bossing_radius=1"], "parent has no bossing circle"),
        (["--set", "breadth=11", "--layout", "sten=0.3"], "the nearest names are 'stern'"),
        (["--reach", "volume=2800"], "free"),
        (["--reach", "volumen=2800", "--free", "breadth"], "volume"),
        (["--reach", "volume=2800", "--free", "breadth=9"], "give NAME or NAME=LOW:HIGH"),
        (["--reach", "volume=2800", "--free", "breadth=9:a"], "LOW and HIGH are numbers"),
        (["--reach", "volume=2800", "--free", "breadth", "--free", "breadth=9:"], "given twice"),
        ([], "nothing is asked for"),
    ],
)
def test_bad_requests_are_told_in_one_line(
    hull: Path, options: list[str], says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit 2, the reason, and the file unchanged."""
    before = hull.read_bytes()
    assert main(["vary", str(hull), *options]) == 2
    error = capsys.readouterr().err
    assert says in error
    assert len(error.splitlines()) == 1
    assert hull.read_bytes() == before


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--to", "cb=0.5"], "unrecognized arguments: --to cb=0.5; did you mean"),
        (["--sett", "breadth=11"], "did you mean '--set'"),
        (["Cb=0.5"], "ask for reach={'cb': ...} with free=[...] (--reach cb=... --free ...)"),
        (["breath=11"], "the nearest names are 'breadth'"),
    ],
)
def test_an_option_or_a_value_that_is_not_known_is_not_taken_for_another(
    words: list[str], told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`--to` was taken for the beginning of `--tolerance`."""
    path = tmp_path / "ship.hull"
    ah.examples.wigley(stations=5, waterlines=4).save(path)
    assert main(["vary", str(path), *words]) == 2
    assert told in capsys.readouterr().err


def test_a_dry_run_tells_what_would_change_and_writes_nothing(
    hull: Path, tmp_path: Path, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """Values before and after, the movement of lines, hydrostatics; then the same is written."""
    was = {each.name: each.read_bytes() for each in hull.parent.iterdir()}
    assert main(["vary", str(hull), "breadth=11", "--dry-run"]) == 0
    words = capsys.readouterr().out
    for told in ("breadth 10 -> 11 m", "lines: ", "that moved farthest", "HYDROSTATICS"):
        assert told in words
    assert words.endswith("nothing written\n")
    trial = facts("vary", hull, "breadth=11", "--dry-run")
    assert trial["saved"] is None
    moved = [each["shift"]["length"] for each in trial["comparison"]["lines"] if each["shift"]]
    assert max(moved) == pytest.approx(0.5)
    assert {each.name: each.read_bytes() for each in hull.parent.iterdir()} == was
    written = facts("vary", hull, "breadth=11", "-o", tmp_path / "broad.hull")
    same = ("targets", "rounds", "regions", "drivers", "added", "fingerprint", "script")
    assert {key: trial[key] for key in same} == {key: written[key] for key in same}


def test_a_dry_run_names_lines_that_would_be_less_fair(
    hull: Path, facts: Json, capsys: pytest.CaptureFixture[str]
) -> None:
    """Those that `compare` would warn of."""
    asked = ["vary", str(hull), "stem_rake_deg=20"]
    assert main([*asked, "--dry-run"]) == 0
    words = capsys.readouterr().out
    less = ah.open(hull).compare(ah.open(hull).vary(set={"stem_rake_deg": 20.0}).hull).less_fair
    assert less
    number = "1 line is" if len(less) == 1 else f"{len(less)} lines are"
    assert f"WARNING: {number} less fair" in words
    assert all(f"  {each.name}: " in words for each in less[:10])


def test_a_dry_run_of_what_is_refused_gives_the_interval(
    hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The code and the sentence of the variation itself; a misspelt option is told."""
    codes = [main(["vary", str(hull), "draught=40", *more]) for more in ([], ["--dry-run"])]
    told = capsys.readouterr().err.splitlines()
    assert codes[0] == codes[1] != 0
    assert told[0] == told[1]
    assert "admissible draught from " in told[0]
    assert main(["vary", str(hull), "breadth=11", "--dryrun"]) == 2
    assert "--dry-run" in capsys.readouterr().err


def test_an_option_that_is_typed_as_a_parameter_is_named(
    hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As it is written then."""
    assert main(["vary", str(hull), "breadth=10.2", "stations=x"]) == 2
    assert "write --stations x" in capsys.readouterr().err

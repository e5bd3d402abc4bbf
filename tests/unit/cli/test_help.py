"""Every command says what it is for and shows how it is called."""

import argparse
import json
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import arranged, command_table, main
from assoc_hull.cli.command_table import SYNONYMS
from assoc_hull.cli.commands import make_parser

_ACROSS = re.MULTILINE | re.DOTALL


def commands() -> dict[str, argparse.ArgumentParser]:
    """All commands by name."""
    (found,) = (
        each for each in make_parser()._actions if isinstance(each, argparse._SubParsersAction)
    )
    return dict(found.choices)


def sections() -> dict[str, str]:
    """What `docs/cli.md` says under the heading of each command."""
    page = Path(__file__).resolve().parents[3] / "docs" / "cli.md"
    parts = re.split(r"^(##+) (.*)$", page.read_text("utf-8"), flags=re.MULTILINE)
    titled = zip(parts[1::3], parts[2::3], parts[3::3], strict=True)
    return {title: text for level, title, text in titled if level == "###"}


COMMANDS, SECTIONS = commands(), sections()


def examples(parser: argparse.ArgumentParser) -> list[str]:
    """The examples in the help of a command, without what the shell does with the output."""
    lines = [line.strip() for line in (parser.epilog or "").splitlines()]
    return [line.partition(" > ")[0] for line in lines if line.startswith("assoc-hull ")]


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_tells_itself_and_its_arguments(name: str) -> None:
    """One sentence about the command, and a word about every argument that it takes."""
    parser = COMMANDS[name]
    assert parser.description
    assert parser.description.endswith(".")
    assert [each.dest for each in parser._actions if not each.help] == []
    assert f"assoc-hull {name}" in parser.format_help()


@pytest.mark.parametrize("name", COMMANDS)
def test_the_examples_of_a_command_can_be_run(name: str) -> None:
    """Each begins with the name of the program, and its arguments are taken as they stand."""
    found = examples(COMMANDS[name])
    assert found
    for line in found:
        words = shlex.split(line)
        assert words[:2] == ["assoc-hull", name]
        assert callable(make_parser().parse_args(arranged(words[1:])).run)


def test_the_program_lists_its_commands_and_exit_codes() -> None:
    """Its own help names every command, tells what 0, 1 and 2 mean, and its examples parse."""
    parser = make_parser()
    text = parser.format_help()
    assert [name for name in COMMANDS if name not in text.split()] == []
    assert "exit codes: 0 done; 1 findings" in text
    shown = examples(parser)
    assert len(shown) > 4
    for line in shown:
        assert callable(parser.parse_args(arranged(shlex.split(line)[1:])).run)


def test_the_table_lists_the_commands_that_are_made_and_no_others() -> None:
    """Words of other programs lead to commands that are there, and are none themselves."""
    assert sorted(command_table.COMMANDS) == sorted(COMMANDS)
    assert {meant.split()[0] for meant in SYNONYMS.values()} <= set(COMMANDS)
    assert not set(SYNONYMS) & set(COMMANDS)


@pytest.mark.parametrize("name", COMMANDS)
def test_of_a_command_its_own_module_is_enough(name: str) -> None:
    """What is typed is read as it is with all commands there."""
    (found,) = (
        each for each in make_parser([name])._actions
        if isinstance(each, argparse._SubParsersAction)
    )  # fmt: skip
    assert found.choices[name].format_help() == COMMANDS[name].format_help()


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("hydro", "hydrostatics"),
        ("iges", "export"),
        ("smooth", "fair"),
        ("chek", "check"),
        ("pull", "edit HULL pull"),
        ("stretch", "vary"),
    ],
)
def test_a_name_that_is_no_command_is_told_what_may_be_meant(
    typed: str, meant: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """A beginning, a word of another program, a slip."""
    assert main([typed, "ship.hull"]) == 2
    told = capsys.readouterr().err
    assert told.startswith(f"error: there is no command '{typed}'; did you mean '{meant}'")


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        (["example", "series60"], "series60-0"),
        (["vary", "a.hull", "--stations", "numbers"], "number"),
    ],
)
def test_a_choice_that_is_none_is_answered_with_the_nearest(
    typed: list[str], meant: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Names of examples and words of options, before all that there are."""
    assert main(typed) == 2
    assert f"did you mean '{meant}" in capsys.readouterr().err


def test_help_loads_no_numbers() -> None:
    """It is there at once: neither numpy nor a hull is imported for it."""
    code = "import sys; from assoc_hull.cli import main; main(['--help']); print(*sys.modules)"
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(told.stdout.splitlines()[-1].split())
    assert "assoc_hull.cli.commands" in loaded
    assert not loaded & {"numpy", "scipy", "assoc_hull.hull", "assoc_hull.cli.edits"}


def test_the_page_describes_the_commands_and_no_others() -> None:
    """`docs/cli.md` has a heading for each, and a link to it in its list."""
    assert sorted(SECTIONS) == sorted(COMMANDS)


@pytest.mark.parametrize("name", COMMANDS)
def test_the_site_shows_the_help_of_a_command_below_its_heading(name: str) -> None:
    """The page in the repository has a mark there, and no second list of options."""
    assert SECTIONS[name].startswith(f"\n\n<!-- help of {name} -->\n")
    assert f"assoc-hull {name} " not in SECTIONS[name] or name == "completion"


def test_the_edits_that_are_shown_can_be_made(series60_70: ah.Hull) -> None:
    """Those of the page and of the help, on the hull that the other examples are about."""
    blocks = re.findall(r"^    (\[\{?$.*?^ *\]|\[\{.*?\}\])$", SECTIONS["edit"], _ACROSS)
    (helped,) = re.findall(r"edits\.json: (\[.*?\}\])", COMMANDS["edit"].epilog or "", re.DOTALL)
    assert len(blocks) == 1
    for text in (*blocks, helped):
        assert series60_70.preview(json.loads(text)).refused == ()

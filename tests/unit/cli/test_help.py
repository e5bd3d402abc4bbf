"""Every command says what it is for and shows how it is called."""

import argparse
import shlex

import pytest

from assoc_hull.cli.parser import make_parser


def commands() -> dict[str, argparse.ArgumentParser]:
    """All commands by name."""
    (found,) = (
        each for each in make_parser()._actions if isinstance(each, argparse._SubParsersAction)
    )
    return dict(found.choices)


COMMANDS = commands()


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
        assert callable(make_parser().parse_args(words[1:]).run)


def test_the_program_lists_its_commands_and_exit_codes() -> None:
    """Its own help names every command, tells what 0, 1 and 2 mean, and its examples parse."""
    parser = make_parser()
    text = parser.format_help()
    assert [name for name in COMMANDS if name not in text.split()] == []
    assert "exit codes: 0 done; 1 findings" in text
    for line in examples(parser):
        assert callable(parser.parse_args(shlex.split(line)[1:]).run)

"""The command line: `main` finds the command, runs it, and turns every failure into one line.

Exit codes: 0 done; 1 findings (check, doctor, verify, a refused edit); 2 bad input or usage, with
one line ``error: what, where, how much, what to do`` on standard error; 3 an imported hull is not
sound, with all findings on standard output and one line of error; 130 stopped by the keyboard; 141
when the reader of the output has gone.
"""

from __future__ import annotations

import contextlib
import os
import re
import sys
import warnings
from collections.abc import Callable, Sequence

from assoc_hull.cli.commands import make_parser
from assoc_hull.cli.problems import explain, in_shell
from assoc_hull.errors import NotSoundError

__all__ = ["arranged", "main"]

_PAIR = re.compile(r"[A-Za-z_]\w*=")
_NEGATIVE = re.compile(r"-\.?\d")

_BAD, _NOT_SOUND, _STOPPED, _NO_READER = 2, 3, 130, 141


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command.

    Parameters
    ----------
    argv : sequence of str or None
        The arguments after the name of the program; those of this process if None.

    Returns
    -------
    int
        The exit code.

    Examples
    --------
    >>> from assoc_hull.cli import main
    >>> main(["example", "wigley", "-o", "no such folder/w.hull.json"])
    2
    """
    try:
        code = _run(argv)
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:
        _give_up_output()
        return _NO_READER
    except KeyboardInterrupt:
        return _fail(
            "stopped by the keyboard; hull files are whole, run the command again", _STOPPED
        )
    except NotSoundError as error:
        return _fail(error.summary, _NOT_SOUND)  # the findings stand on standard output
    except Exception as error:  # a traceback is of no use to a designer
        return _fail(explain(error), _BAD)
    return code


def _run(argv: Sequence[str] | None) -> int:
    try:
        words = list(sys.argv[1:] if argv is None else argv)
        if words[:1] == ["help"]:
            words = [*words[1:2], "--help"]
        parser = make_parser(words)
        arguments = parser.parse_args(arranged(words))
    except SystemExit as done:  # --help and --version
        return int(done.code or 0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the one line on standard error says what is wrong
        try:
            code: int = arguments.run(arguments)
        except (NotSoundError, BrokenPipeError):
            raise
        except Exception as error:  # a traceback is of no use to a designer
            return _fail(in_shell(explain(error), arguments.options), _BAD)
    return code


def arranged(words: Sequence[str]) -> list[str]:
    """Write what was typed as the parsers of commands take it."""
    typed = _with_axes(words)
    arrange = _ARRANGED.get(typed[0]) if typed else None
    return typed if arrange is None else arrange(typed)


_TAKES_VALUE = ("--out", "--name", "--why", "--wait")


def _options_last(words: list[str]) -> list[str]:
    """Put options of an edit behind its values, between which they may be typed."""
    if "--" in words:
        return words
    if any(word.startswith("--") for word in words):
        from assoc_hull.cli.typed_edits import options_as_values

        words = options_as_values(words)
    values, options = list[str](), list[str]()
    rest = iter(words)
    for word in rest:
        if not word.startswith("-") or word == "-":
            values.append(word)
            continue
        options.append(word)
        # An option may be shortened, as argparse takes it.
        name = len(word) > len("--") and any(each.startswith(word) for each in _TAKES_VALUE)
        if word == "-o" or name:
            options += [each for each in [next(rest, None)] if each is not None]
    return [*values, *options]


def _out_second(words: list[str]) -> list[str]:
    """Let the file of a report stand behind `-o`, as those of other commands do."""
    for i, word in enumerate(words[:-1]):
        if word in ("-o", "--out"):
            rest = [*words[:i], *words[i + 2 :]]
            # Behind the hull, where that is the first word: an option may take several values.
            place = 2 if rest[1:] and not rest[1].startswith("-") else len(rest)
            return [*rest[:place], words[i + 1], *rest[place:]]
    return words


_WITHOUT_VALUE = ("--compromise", "--dry-run", "--fair", "--json", "--list", "--replace")


def _with_set(words: list[str]) -> list[str]:
    """Let `NAME=VALUE` of a variation stand without `--set`, but not where an option takes it."""
    found = list[str]()
    for before, word in zip(["-", *words], words, strict=False):
        if _PAIR.match(word) and (before in _WITHOUT_VALUE or not before.startswith("-")):
            found.append("--set")
        found.append(word)
    return found


_ARRANGED: dict[str, Callable[[list[str]], list[str]]] = {
    "edit": _options_last, "report": _out_second, "vary": _with_set,
}  # fmt: skip
"""Commands whose words may stand in an order that argparse does not take, and what orders them."""


def _with_axes(words: Sequence[str]) -> list[str]:
    """Keep what begins with a minus from being taken for an option: axes, values of edits."""
    found: list[str] = []
    for word in words:
        if words[0] == "edit" and _NEGATIVE.match(word):
            found.append(f" {word}")  # what has a blank is no option to argparse
        elif found[-1:] == ["--axes"] and word[:2].lower() in ("-x", "-y", "-z"):
            found[-1] = f"--axes={word}"
        else:
            found.append(word)
    return found


def _fail(text: str, code: int) -> int:
    """Say in one line what is wrong."""
    with contextlib.suppress(OSError):
        print("error:", " ".join(text.split()), file=sys.stderr)
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError:
        _give_up_output()
    return code


def _give_up_output() -> None:
    """Let nothing more be written, so that Python does not complain when it ends."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())

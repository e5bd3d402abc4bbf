"""What the command line says when something fails, and checks it makes before it works."""

from __future__ import annotations

import os
import re
import traceback
from collections.abc import Collection, Mapping
from pathlib import Path

from assoc_hull.errors import AssocHullError, BadInputError

__all__ = [
    "FILE_ENDING",
    "HULL_ENDINGS",
    "TEXT_ENDING",
    "InFileError",
    "UsageError",
    "check_hull_target",
    "check_other_target",
    "check_target",
    "explain",
    "in_shell",
    "is_apart",
]

FILE_ENDING, TEXT_ENDING = ".hull", ".hull.json"
HULL_ENDINGS = (FILE_ENDING, TEXT_ENDING)


_DEBUG = "ASSOC_HULL_DEBUG"

_WORD = 240
"""A word longer than this is shown by both its ends: whoever is to read it knows the middle."""


class UsageError(AssocHullError):
    """The arguments do not fit the command."""


class InFileError(AssocHullError):
    """Something is wrong, and this is the place in the file that says it."""

    def __init__(self, error: Exception, place: str) -> None:
        super().__init__(f"{explain(error)} ({place})")


def explain(error: Exception) -> str:
    """Say what is wrong, where, and what to do.

    Examples
    --------
    >>> from assoc_hull.cli.problems import explain
    >>> explain(PermissionError(13, "Permission denied", "hull.json"))
    'Permission denied, at hull.json; check name, place and permissions'
    """
    if os.environ.get(_DEBUG):
        traceback.print_exception(error)
    return re.sub(rf"\S{{{_WORD + 1},}}", _ends, _explained(error))


def in_shell(text: str, options: Mapping[str, str]) -> str:
    """Write names of Python arguments in a message as options of the command.

    Parameters
    ----------
    text : str
        A message.
    options : mapping of str to str
        How each option of the command is typed, by its name in Python; no values that stand
        without an option.

    Examples
    --------
    >>> from assoc_hull.cli.problems import in_shell
    >>> options = {"length": "--length", "zero": "--zero", "accept": "--accept"}
    >>> in_shell("give length= (Lpp in m), or zero='ap' or 'fp', or accept=True", options)
    'give --length (Lpp in m), or --zero ap or fp, or --accept'
    """

    def write(found: re.Match[str]) -> str:
        flag, value = options.get(found["name"]), found["value"] or ""
        # Where a message has words for the shell, the unit may be another there.
        if flag is None or flag in text:
            return found[0]
        if value.startswith(("[", "{")):
            return f"{flag} {'NAME=VALUE' if value[0] == '{' else 'NAME'}"
        return flag if value in ("", "True") else f"{flag} {value.replace(chr(39), '')}"

    return _KEYWORD.sub(write, text)


_KEYWORD = re.compile(
    r"(?<![\w'=.-])(?P<name>[a-z]\w*)=(?:"
    r"(?P<value>'[\w-]+'(?: or '[\w-]+')*|\[names\]|\{name: value\}|True\b)|(?=[\s,;)]|$))"
)
"""An argument as messages of the library write it: bare, with words, names, pairs, or True."""


def _ends(word: re.Match[str]) -> str:
    """Show both ends of a word that is too long to be read."""
    half = _WORD // 2
    return f"{word[0][:half]} ... {word[0][-half:]}"


def _explained(error: Exception) -> str:
    if isinstance(error, AssocHullError):
        return str(error)
    if isinstance(error, OSError):
        place = "in the output" if error.filename is None else f"at {error.filename}"
        return f"{error.strerror or error}, {place}; check name, place and permissions"
    return (
        f"{type(error).__name__} inside the program ({error}), {_place(error)}; this is a fault "
        f"of the program: report it with what {_DEBUG}=1 shows"
    )


def _place(error: Exception) -> str:
    """Give the line in which an error arose."""
    frames = traceback.extract_tb(error.__traceback__)
    return f"at {Path(frames[-1].filename).name}:{frames[-1].lineno}" if frames else "anywhere"


def check_target(path: Path, endings: Collection[str]) -> None:
    """Refuse, before anything is computed, a file that could not be written.

    Parameters
    ----------
    path : Path
        The file.
    endings : collection of str
        How its name may end.

    Raises
    ------
    BadInputError
        Another ending, a folder of this name, or no folder to write to.

    Examples
    --------
    >>> from pathlib import Path
    >>> from assoc_hull.cli.problems import check_target
    >>> check_target(Path("ship.hull.json"), [".hull.json"])
    """
    if not path.name.endswith(tuple(endings)):
        known = " or ".join(endings)
        raise BadInputError("the form is unknown", f"at {path}", f"end the name in {known}")
    if path.is_dir():
        raise BadInputError("this is a folder", f"at {path}", "give the name of a file")
    if not path.parent.is_dir():
        raise BadInputError(
            f"there is no folder {path.parent}", f"for {path.name}", "make the folder first"
        )


def check_hull_target(path: Path, *, replace: bool) -> None:
    """Refuse, before anything is computed, a hull that could not be written there.

    Parameters
    ----------
    path : Path
        The file; ``.hull`` or ``.hull.json``.
    replace : bool
        Whether a hull file that is there may be written over; the text form always may.

    Raises
    ------
    BadInputError
        See `check_target`; or there is a hull file of this name.
    """
    check_target(path, HULL_ENDINGS)
    if path.name.endswith(FILE_ENDING) and path.exists() and not replace:
        what, remedy = "there is a file of this name", "choose another name, or say --replace"
        raise BadInputError(what, f"at {path}", remedy)


def check_other_target(path: Path, hull: Path) -> None:
    """Refuse, before anything is computed, to write something else over a hull.

    Parameters
    ----------
    path : Path
        The file to be written, with any ending but that of hull files.
    hull : Path
        The hull that is read.

    Raises
    ------
    BadInputError
        See `check_target`; or a hull file lies there, or the hull that is read.
    """
    from assoc_hull.io.write_file import require_no_hull_file

    check_target(path, ("",))
    require_no_hull_file(path)
    if path.exists() and hull.exists() and path.samefile(hull):
        raise BadInputError("the hull would be written over", f"at {path}", "give another name")


def is_apart(out: Path | None, hull: Path) -> bool:
    """Tell whether a hull is written elsewhere than it is read from, however both are named.

    Examples
    --------
    >>> from pathlib import Path
    >>> from assoc_hull.cli.problems import is_apart
    >>> is_apart(Path("new.hull"), Path("ship.hull")), is_apart(Path("ship.hull").absolute(),
    ...     Path("ship.hull"))
    (True, False)
    """
    return out is not None and os.path.realpath(out) != os.path.realpath(hull)

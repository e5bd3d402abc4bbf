"""Writing a file whole or not at all.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.io.write_file import write_whole
>>> with tempfile.TemporaryDirectory() as folder:
...     write_whole(Path(folder) / "lines.txt", b"0")
...     sorted(path.name for path in Path(folder).iterdir())
['lines.txt']
"""

from __future__ import annotations

import contextlib
import os
import stat
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from assoc_hull.arguments import choice, file_path
from assoc_hull.errors import BadInputError
from assoc_hull.io.open_databases import is_hull_file

__all__ = ["form_by_ending", "mode_for", "require_no_hull_file", "take_place", "write_whole"]


def write_whole(path: str | os.PathLike[str], data: bytes, *, follow: bool = False) -> None:
    """Write a file; what was there is replaced by all of it, or stays.

    Parameters
    ----------
    path : path
        The file; its folder must exist. A link is followed within its folder. What is no file, such
        as ``/dev/stdout`` or a pipe, is written to and not replaced.
    data : bytes
        The content.
    follow : bool
        Follow a link out of its folder too.

    Raises
    ------
    BadInputError
        The file cannot be written, or is a hull file, or has the name of one; or a link leads out
        of its folder.
    """
    target = Path(os.path.realpath(path))
    if not follow:
        _refuse_link(path, target)
    if target.is_dir():
        raise BadInputError("this is a folder", f"at {target}", "give the name of a file")
    require_no_hull_file(target)
    try:
        if _is_device(path):
            Path(path).write_bytes(data)
        else:
            _replace(target, data)
    except OSError as error:
        reason = error.strerror or str(error)
        raise BadInputError(
            f"the file cannot be written ({reason})", f"at {target}", "give another place"
        ) from error


_STANDARD = ("/dev/stdout", "/dev/stderr", "/dev/fd/", "/proc/")


def _refuse_link(path: str | os.PathLike[str], target: Path) -> None:
    """Refuse a link that leads out of the folder that was asked for."""
    given = os.path.abspath(path)
    # Standard output is such a link, of the system's own.
    if not os.path.islink(given) or given.startswith(_STANDARD):
        return
    folder = Path(os.path.realpath(os.path.dirname(given)))
    if not target.is_relative_to(folder):
        what = f"this is a link out of its folder, to {target}"
        raise BadInputError(what, f"at {path}", "give that place itself, or another name")


def require_no_hull_file(path: Path) -> None:
    """Refuse to write anything else over a hull file, whose history would go, or under its name.

    Parameters
    ----------
    path : Path
        Where something else than a hull file is to be written.

    Raises
    ------
    BadInputError
        A hull file lies there, or the name says that one does.

    Examples
    --------
    >>> from pathlib import Path
    >>> from assoc_hull.io.write_file import require_no_hull_file
    >>> require_no_hull_file(Path("offsets.csv"))
    """
    if not _is_device(path) and is_hull_file(path):
        what = "a hull file would be written over, with its history"
        raise BadInputError(what, f"at {path}", "give another name")
    if path.name.lower().endswith(".hull"):
        what, remedy = "the ending .hull is that of hull files", "end the name otherwise"
        raise BadInputError(what, f"at {path}", remedy)


def _is_device(path: str | os.PathLike[str]) -> bool:
    """Tell whether there is something of this name that holds no content: a device, a pipe."""
    with contextlib.suppress(OSError):
        return not stat.S_ISREG(os.stat(path).st_mode)
    return False


def _replace(target: Path, data: bytes) -> None:
    """Write beside the target, bring it to the disk, then take the target's place."""
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", suffix=".part", dir=target.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        take_place(name, target)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(name)
        raise


def mode_for(target: Path) -> int:
    """Give the permissions of the file that is there, or those of a new one."""
    with contextlib.suppress(OSError):
        return target.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


def take_place(name: str, target: Path) -> None:
    """Let a finished file take the place and permissions of another, for good."""
    os.chmod(name, mode_for(target))
    os.replace(name, target)
    with contextlib.suppress(OSError):  # some systems know no such thing as a folder on the disk
        folder = os.open(target.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


def form_by_ending(
    path: str | os.PathLike[str],
    form: str | None,
    forms: Sequence[str],
    endings: Mapping[str, str],
    where: str,
) -> str:
    """Tell in which form a file is to be written: the one asked for, else by its ending.

    Parameters
    ----------
    path : path
        Of the file.
    form : str or None
        What was asked for.
    forms : sequence of str
        All forms.
    endings : mapping of str to str
        Endings of files, and the form that each means.
    where : str
        For the error.

    Raises
    ------
    BadInputError
        Neither says one.

    Examples
    --------
    >>> from assoc_hull.io.write_file import form_by_ending
    >>> form_by_ending("a.TXT", None, ("text", "table"), {".txt": "text"}, "in lines")
    'text'
    """
    name = os.path.basename(file_path(path, where)).lower()
    if form is not None:
        return choice(form, "format", tuple(forms), where)
    found = next((each for ending, each in endings.items() if name.endswith(ending)), None)
    if found is None:
        raise BadInputError(
            "the ending of the name tells no form", f"at {os.fspath(path)}",
            f"end it in {', '.join(endings)}, or choose the format: {', '.join(forms)}",
        )  # fmt: skip
    return found

"""Writing a file whole or not at all.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.io.whole_file import write_whole
>>> with tempfile.TemporaryDirectory() as folder:
...     write_whole(Path(folder) / "lines.txt", b"0")
...     sorted(path.name for path in Path(folder).iterdir())
['lines.txt']
"""

from __future__ import annotations

import contextlib
import os
import tempfile
from pathlib import Path

from assoc_hull.errors import BadInputError

__all__ = ["mode_for", "take_place", "write_whole"]


def write_whole(path: str | os.PathLike[str], data: bytes) -> None:
    """Write a file; what was there is replaced by all of it, or stays.

    Parameters
    ----------
    path : path
        The file; its folder must exist. A link is followed.
    data : bytes
        The content.

    Raises
    ------
    BadInputError
        The file cannot be written.
    """
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise BadInputError("this is a folder", f"at {target}", "give the name of a file")
    try:
        _replace(target, data)
    except OSError as error:
        reason = error.strerror or str(error)
        raise BadInputError(
            f"the file cannot be written ({reason})", f"at {target}", "give another place"
        ) from error


def _replace(target: Path, data: bytes) -> None:
    """Write beside the target, bring it to the disk, then take the target's place."""
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", suffix=".part", dir=target.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(name, mode_for(target))
        take_place(name, target)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(name)
        raise


def take_place(name: str, target: Path) -> None:
    """Let a file that was brought to the disk take the place of another, on the disk too."""
    os.replace(name, target)
    with contextlib.suppress(OSError):  # some systems open no folder, and need not
        folder = os.open(target.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


def mode_for(target: Path) -> int:
    """Give the permissions of the file that is there, or those of a new one."""
    with contextlib.suppress(OSError):
        return target.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask

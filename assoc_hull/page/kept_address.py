"""The address of a server that runs, so that one which follows a killed server takes it over.

Port and token stand in a file of the user's own, which nobody else can read, for as long as the
server runs. It is there afterwards only where the server was killed: the next one of the same hull
file takes both, and a page that is still open comes back by itself. Meanwhile the page asks at that
port, which anybody on this machine may have taken: so both hold for ten minutes only after the
server has said last that it runs.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import stat
import time
from pathlib import Path

import attrs

__all__ = ["KeptAddress"]

_LONGEST = 600.0  # s since the server said last that it runs
_PRIVATE = 0o600, 0o700  # a file, a folder


@attrs.define
class KeptAddress:
    """Where the address of the server of a hull file is kept; nowhere for a hull in memory."""

    path: Path | None
    token: str = ""

    @classmethod
    def of(cls, hull: Path | None) -> KeptAddress:
        """Give the place for a hull file."""
        if hull is None:
            return cls(None)
        name = hashlib.sha256(os.fsencode(hull.resolve())).hexdigest()[:32]
        return cls(_folder() / f"{name}.json")

    def read(self) -> tuple[int, str] | None:
        """Give port and token of a server that was killed not long ago; older ones are removed."""
        kept = self._told()
        if self.path is None or kept is None:
            return None
        with contextlib.suppress(OSError):
            if 0.0 <= time.time() - self.path.lstat().st_mtime < _LONGEST:
                return kept
            self.path.unlink()
        return None

    def _told(self) -> tuple[int, str] | None:
        """Give what stands in the file; None where it is not the user's own, and nobody else's."""
        if self.path is None:
            return None
        try:
            about = self.path.lstat()
            told = json.loads(self.path.read_text("utf-8"))
            port, token = told["port"], told["token"]
        except (OSError, ValueError, LookupError, TypeError):
            return None
        own = not hasattr(os, "getuid") or about.st_uid == os.getuid()
        private = stat.S_ISREG(about.st_mode) and (os.name == "nt" or not about.st_mode & 0o077)
        known = type(port) is int and 0 < port < 65536 and type(token) is str and len(token) > 40
        return (port, token) if own and private and known else None

    def keep(self, port: int, token: str) -> None:
        """Keep them; where that fails, a page does not come back by itself, and that is all."""
        self.token = token
        if self.path is None:
            return
        with contextlib.suppress(OSError):
            self.path.parent.mkdir(_PRIVATE[1], parents=True, exist_ok=True)
            draft = self.path.with_suffix(f".{os.getpid()}")
            draft.unlink(missing_ok=True)
            with open(
                os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL, _PRIVATE[0]), "w"
            ) as file:
                json.dump({"port": port, "token": token}, file)
            draft.replace(self.path)

    async def run_on(self) -> None:
        """Say that the server still runs; uvicorn waits for what it calls now and then."""
        if self.path is not None and self._is_own():
            with contextlib.suppress(OSError):
                os.utime(self.path)

    def forget(self) -> None:
        """Remove them at the end of the server: its token lets nobody in any more."""
        if self.path is not None and self._is_own():
            with contextlib.suppress(OSError):
                self.path.unlink()

    def _is_own(self) -> bool:
        """Whether the file is not that of a later server of the same hull; old it may be."""
        kept = self._told()
        return kept is not None and kept[1] == self.token


def _folder() -> Path:
    """Give the folder of this user for what does not outlast a session, or else for states."""
    for name in ("XDG_RUNTIME_DIR", "XDG_STATE_HOME", "LOCALAPPDATA"):
        if found := os.environ.get(name):
            return Path(found, "assoc-hull", "pages")
    try:
        return Path.home() / ".local" / "state" / "assoc-hull" / "pages"
    except RuntimeError:  # a user without a home
        return Path(os.devnull, "pages")  # nothing can be kept there

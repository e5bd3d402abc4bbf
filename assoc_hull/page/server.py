"""The server of the page: on this machine only, for as long as a page is open."""

from __future__ import annotations

import contextlib
import getpass
import os
import secrets
import socket
import sys
import threading
import webbrowser
from types import TracebackType
from typing import TYPE_CHECKING, Self

from assoc_hull.arguments import flag, instance, integer, text
from assoc_hull.errors import BadInputError, MissingExtraError
from assoc_hull.hull.hull import Hull
from assoc_hull.page.kept_address import KeptAddress
from assoc_hull.page.session import Session

if TYPE_CHECKING:
    import uvicorn

__all__ = ["PageServer", "serve", "user_name"]

_HOST = "127.0.0.1"
_LONGEST = 1 << 20  # bytes of a message
_LEFT = 60.0  # s after the last page was closed
_LOOK_AGAIN = 0.5  # s
_RUNS_ON = 60  # s between two times that the server says that it runs
_SWITCH = 1e-3  # s: the worker and the loop take turns


def serve(
    hull: Hull | str | os.PathLike[str],
    *,
    port: int = 0,
    author: str | None = None,
    open_browser: bool = True,
    stay: bool = False,
) -> None:
    """Show a hull in the browser, and edit it there, until the page is closed.

    Parameters
    ----------
    hull : Hull or path
        The hull, or the file that holds it: every edit is kept there as soon as it is made.
    port : int
        Of this machine; 0 for any that is free.
    author : str or None
        Who signs edits; the name of the user if None.
    open_browser : bool
        Whether the browser is asked to open the page; its address is printed in any case.
    stay : bool
        Whether to serve on when the last page has been closed for a minute; Ctrl+C ends it.

    Raises
    ------
    MissingExtraError
        The extra `page` is not installed.
    BadInputError
        The port is taken.
    """
    with PageServer(hull, port=port, author=author) as server:
        print(server.address, flush=True)
        if flag(open_browser, "open_browser", "in serve"):
            webbrowser.open(server.address)
        server.wait(stay=flag(stay, "stay", "in serve"))


class PageServer:
    """A page of a hull, served by a thread from entering a ``with`` statement until leaving it.

    Attributes
    ----------
    address : str
        What to open in a browser, from entering on; the part behind # lets in who knows it.

    Parameters
    ----------
    hull, port, author
        As for `serve`.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.page import PageServer
    >>> with PageServer(ah.examples.wigley()) as server:
    ...     server.address.startswith("http://127.0.0.1:")
    True
    """

    def __init__(
        self,
        hull: Hull | str | os.PathLike[str],
        *,
        port: int = 0,
        author: str | None = None,
    ) -> None:
        try:
            import starlette  # noqa: F401
            import uvicorn  # noqa: F401
            import websockets  # noqa: F401
        except ImportError as error:
            raise MissingExtraError(error.name or "starlette", "page") from None
        integer(port, "port", "in serve", least=0, most=65535)
        if isinstance(hull, str | os.PathLike):
            from assoc_hull.hull.sources import open as open_hull

            hull = open_hull(hull)
        self.hull = instance(hull, Hull, "hull", "in serve")
        self.author = user_name() if author is None else text(author, "author", "in serve")
        self.address = ""
        self._port = port
        self._session: Session | None = None
        self._server: uvicorn.Server | None = None
        self._thread: threading.Thread | None = None

    def __enter__(self) -> Self:
        import uvicorn

        from assoc_hull.page.app import Visitors, make_app

        self._kept = KeptAddress.of(self.hull.path)
        port, token = self._take_address()
        self._kept.keep(port, token)
        self.address = f"http://{_HOST}:{port}/#t={token}&author={_quoted(self.author)}"
        self._visitors = Visitors()
        self._session = Session(self.hull)
        app = make_app(self._session, token, port, self._visitors)
        config = uvicorn.Config(
            app, ws="websockets-sansio", ws_per_message_deflate=False, ws_max_size=_LONGEST,
            log_level="error", access_log=False, lifespan="off", timeout_graceful_shutdown=1,
            callback_notify=self._kept.run_on, timeout_notify=_RUNS_ON,
        )  # fmt: skip
        self._server = uvicorn.Server(config)
        self._switch = sys.getswitchinterval()
        sys.setswitchinterval(_SWITCH)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="assoc-hull page server")
        self._thread.start()
        return self

    def _run(self) -> None:
        assert self._server is not None
        try:
            self._server.run([self._socket])
        finally:
            self._ended.set()

    def _take_address(self) -> tuple[int, str]:
        """Take a port and a token, if possible those of a server of this file that was killed.

        So a page that is still open comes back by itself.
        """
        before = self._kept.read()
        if before is not None and self._port in (0, before[0]):
            with contextlib.suppress(BadInputError):  # somebody else has the port by now
                self._socket = _listen(before[0])
                return before
        self._socket = _listen(self._port)
        return int(self._socket.getsockname()[1]), secrets.token_urlsafe(32)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        assert self._server is not None
        assert self._thread is not None
        assert self._session is not None
        self._server.should_exit = True
        self._thread.join()
        self._socket.close()
        self._session.close()
        self._kept.forget()
        sys.setswitchinterval(self._switch)

    def wait(self, *, stay: bool = False) -> None:
        """Wait until the last page has been closed for a minute; for ever if `stay`."""
        assert self._thread is not None
        left = 0.0
        # A join that Ctrl+C interrupts takes the thread for ended (Python 3.11), and `__exit__`
        # would close the socket under it.
        while not self._ended.wait(_LOOK_AGAIN):
            visited = self._visitors.ever and not self._visitors.now
            left = left + _LOOK_AGAIN if visited else 0.0
            if left >= _LEFT and not stay:
                return


def _listen(port: int) -> socket.socket:
    """Take a port of this machine."""
    found = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        found.bind((_HOST, port))
        found.listen()
    except OSError as error:
        found.close()
        what = f"the port {port} cannot be had ({error.strerror})"
        raise BadInputError(what, "in serve", "give another one, or 0 for any") from None
    return found


def user_name() -> str:
    """Give the name of who is logged in, to sign edits by."""
    try:
        return getpass.getuser()
    except (OSError, KeyError):
        return "designer"


def _quoted(name: str) -> str:
    from urllib.parse import quote

    return quote(name, safe="")

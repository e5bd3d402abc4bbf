"""The routes of the page: static files of fixed names, one socket, and who is kept out.

A page of another site may send requests here, and by rebinding a name also with equal Host and
Origin: both are compared with a list, whole. Nothing comes from the disk by a name of the client's.
"""

from __future__ import annotations

import asyncio
import colorsys
import contextlib
import gzip
import hmac
import logging
import re
import threading
from collections.abc import Awaitable, Callable, Mapping, MutableMapping
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import attrs

from assoc_hull.page.connection import Connection
from assoc_hull.page.files import MOST_BYTES, read_dropped
from assoc_hull.page.session import Session
from assoc_hull.plot.sheet.paper import FAMILY_COLOURS

if TYPE_CHECKING:
    from starlette.requests import Request
    from starlette.responses import Response
    from starlette.websockets import WebSocket

__all__ = ["Guard", "Visitors", "family_colours", "make_app", "static_files"]

Scope = MutableMapping[str, Any]
Event = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Event]]
Send = Callable[[Event], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

_TYPES = {
    "html": "text/html; charset=utf-8",
    "css": "text/css; charset=utf-8",
    "js": "text/javascript; charset=utf-8",
    "svg": "image/svg+xml",
}
# Blocks anywhere, as types stand within expressions; of the others those on lines of their own,
# since two slashes within a line may be of an address.
_COMMENTS = re.compile(r"/\*\*.*?\*/ ?|^[ ]*//[^\n]*", re.DOTALL | re.MULTILINE)
_INDENT = re.compile(r"^[ ]+", re.MULTILINE)
_DARK = 0.72
"""Lightness of the colours of families on dark ground."""


@attrs.define
class Visitors:
    """How many pages are open, and whether there ever was one."""

    now: int = 0
    ever: bool = False


def static_files() -> Mapping[str, tuple[bytes, str]]:
    """Give all files of the page by name, as they are sent: content and type.

    Scripts come without comments, which are a third of them, and indents, on the same lines.
    """
    found = dict[str, tuple[bytes, str]]()
    for each in files("assoc_hull.page").joinpath("static").iterdir():
        ending = each.name.rpartition(".")[2]
        if ending in _TYPES:
            body = each.read_bytes()
            body = _without_comments(body.decode()).encode() if ending == "js" else body
            found[each.name] = body, _TYPES[ending]
    found["page.css"] = (found["page.css"][0] + family_colours().encode(), _TYPES["css"])
    return found


def family_colours() -> str:
    """Write the colours of the families of lines as a style sheet, for light and dark ground."""

    def rules(colours: Mapping[str, str]) -> str:
        return "".join(f" --{name}: {colour};" for name, colour in colours.items())

    dark = {name: _lighter(colour) for name, colour in FAMILY_COLOURS.items()}
    return (
        f".page {{{rules(FAMILY_COLOURS)} }}\n"
        f'.page[data-theme="dark"] {{{rules(dark)} }}\n'
    )  # fmt: skip


def _without_comments(script: str) -> str:
    # No text of the page goes over several lines, so that all indents are only for who reads.
    return _INDENT.sub("", _COMMENTS.sub(lambda found: "\n" * found[0].count("\n"), script))


def _lighter(colour: str) -> str:
    red, green, blue = (int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    hue, _, saturation = colorsys.rgb_to_hls(red, green, blue)
    lighter = colorsys.hls_to_rgb(hue, _DARK, min(saturation, 0.65))
    return "#" + "".join(f"{round(255 * each):02x}" for each in lighter)


def headers(port: int) -> dict[str, str]:
    """Give the headers of every answer: nothing from elsewhere, nothing kept, nothing framed."""
    sockets = f"ws://127.0.0.1:{port} ws://localhost:{port}"
    policy = (
        "default-src 'none'; script-src 'self'; style-src 'self'; "
        f"connect-src 'self' {sockets}; img-src 'self' blob: data:; base-uri 'none'; "
        "form-action 'none'; frame-ancestors 'none'"
    )
    return {
        "Content-Security-Policy": policy,
        "X-Content-Type-Options": "nosniff",
        "Referrer-Policy": "no-referrer",
        "Cross-Origin-Opener-Policy": "same-origin",
        "Cross-Origin-Resource-Policy": "same-origin",
        "Cache-Control": "no-store",
    }


class Guard:
    """Answers only who asks this server by its own name, and sockets only of its own page."""

    def __init__(self, app: App, port: int) -> None:
        self._app = app
        self._hosts = {f"127.0.0.1:{port}", f"localhost:{port}"}

    def lets_in(self, kind: str, host: str | None, origin: str | None) -> bool:
        """Tell whether a request may pass; `kind` is "http" or "websocket"."""
        if host not in self._hosts:
            return False
        if origin is None:
            return kind == "http"  # browsers leave it out where a page is opened
        return origin in {f"http://{each}" for each in self._hosts}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a request pass, or refuse it."""
        kind = scope["type"]
        if kind not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        if self.lets_in(kind, _header(scope, b"host"), _header(scope, b"origin")):
            await self._app(scope, receive, send)
        elif kind == "websocket":
            await send({"type": "websocket.close", "code": 1008})
        else:
            body = b"this server answers to its own address only"
            about = [(b"content-type", b"text/plain"), (b"content-length", b"%d" % len(body))]
            await send({"type": "http.response.start", "status": 403, "headers": about})
            await send({"type": "http.response.body", "body": body})


def _header(scope: Scope, name: bytes) -> str | None:
    """Give a header; None where it is missing, or there more than once."""
    found = [value for key, value in scope["headers"] if key == name]
    return found[0].decode("latin-1") if len(found) == 1 else None


def make_app(session: Session, token: str, port: int, visitors: Visitors) -> App:
    """Make the application that serves the page of a session."""
    from starlette.applications import Starlette
    from starlette.responses import JSONResponse
    from starlette.responses import Response as Answer
    from starlette.routing import Route, WebSocketRoute

    known, about = static_files(), headers(port)
    zipped = {name: gzip.compress(body, 9, mtime=0) for name, (body, _) in known.items()}
    reading = asyncio.Semaphore(1)

    async def file(request: Request) -> Response:
        name = request.path_params.get("name", "index.html")
        if name not in known:
            return Answer("there is no such file", 404, about, "text/plain")
        body, kind = known[name]
        if "gzip" not in request.headers.get("accept-encoding", ""):
            return Answer(body, 200, about, kind)
        return Answer(zipped[name], 200, {**about, "Content-Encoding": "gzip"}, kind)

    async def drop(request: Request) -> Response:
        # A page elsewhere cannot send this header unasked, and does not know the token.
        if not hmac.compare_digest(request.headers.get("x-token", "").encode(), token.encode()):
            return Answer("this server answers to its own page only", 403, about, "text/plain")
        body = bytearray()
        async for part in request.stream():
            body += part
            if len(body) > MOST_BYTES:
                most = f"it is too large: {MOST_BYTES >> 20} MiB at most are read"
                return JSONResponse({"problem": most}, 413, about)
        name = request.query_params.get("name", "")
        async with reading:  # one at a time: a drag goes on meanwhile
            found = await _aside(lambda: _told_of(bytes(body), name))
        return JSONResponse(found, 200, about)

    async def talk(socket: WebSocket) -> None:
        visitors.now, visitors.ever = visitors.now + 1, True
        try:
            await Connection(socket, session, token).run()
        finally:
            visitors.now -= 1

    routes = [
        Route("/", file, methods=["GET"]),
        WebSocketRoute("/socket", talk),
        Route("/drop", drop, methods=["POST"]),
        Route("/{name}", file, methods=["GET"]),
    ]
    return Guard(Starlette(routes=routes), port)


async def _aside(job: Callable[[], dict[str, Any]]) -> dict[str, Any]:
    """Do something in a thread of its own, for which a server that ends does not wait."""
    loop = asyncio.get_running_loop()
    done = loop.create_future()

    def give(found: dict[str, Any]) -> None:
        if not done.done():
            done.set_result(found)

    def run() -> None:
        found = job()
        with contextlib.suppress(RuntimeError):  # the loop has ended, and with it the page
            loop.call_soon_threadsafe(give, found)

    threading.Thread(target=run, name="assoc-hull page file", daemon=True).start()
    found: dict[str, Any] = await done
    return found


def _told_of(data: bytes, name: str) -> dict[str, Any]:
    """Read a dropped file; whatever fails is a sentence."""
    try:
        return read_dropped(data, name)
    except Exception as error:  # a page that falls silent is of no use to a designer
        logging.getLogger("assoc_hull.page").exception("a dropped file")
        return {"problem": f"an error of this program: {type(error).__name__} {error}"}

"""One WebSocket between a page and the session: who may speak, what is taken, what is sent."""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import json
from typing import TYPE_CHECKING

from assoc_hull.errors import BadInputError
from assoc_hull.page.messages import Hello, parse
from assoc_hull.page.session import Session
from assoc_hull.page.wire import VERSION, FrameKind

if TYPE_CHECKING:
    from starlette.websockets import WebSocket

__all__ = ["Connection"]

_PATIENCE = 5.0  # s for the first message
_POLICY, _TOO_MANY, _AGAIN = 1008, 1013, 1012  # codes a socket is closed with, RFC 6455
_WAITING = 1000
"""So many messages that a page does not take end its connection."""

_FOREIGN = 20
"""So many messages that are none end a connection."""


class Connection:
    """A page that was let in; a `Client` of the session."""

    def __init__(self, socket: WebSocket, session: Session, token: str) -> None:
        self.author = ""
        self._socket, self._session, self._token = socket, session, token
        self._loop = asyncio.get_running_loop()
        self._outgoing: asyncio.Queue[str | bytes | list[bytes]] = asyncio.Queue()
        self._passing: list[bytes] | None = None
        self._stuck = False

    def tell(self, message: str | bytes) -> None:
        """Send a message; from any thread, without waiting."""
        with contextlib.suppress(RuntimeError):  # the loop has ended, and with it the page
            self._loop.call_soon_threadsafe(self._line_up, message)

    def _line_up(self, message: str | bytes) -> None:
        """Put a message in line; one that takes nothing is let go, and is told all when it is back.

        Of what another hand does only the newest frame waits, at the end of the line: a page that
        is behind skips the others.
        """
        if isinstance(message, bytes) and message[1] == FrameKind.THEIRS:
            if self._passing is not None:
                self._passing[:] = [message]
                return
            self._passing = [message]
            self._outgoing.put_nowait(self._passing)
            return
        self._passing = None
        if self._outgoing.qsize() < _WAITING:
            self._outgoing.put_nowait(message)
        elif not self._stuck:
            self._stuck = True
            self._receiver.cancel()

    async def run(self) -> None:
        """Serve until the page goes."""
        await self._socket.accept()
        hello = await self._first()
        if hello is None:
            return
        sender = asyncio.create_task(self._send())
        self._receiver = asyncio.create_task(self._receive())
        try:
            self._session.submit(self, hello)
            await asyncio.wait([self._receiver])
        finally:
            self._receiver.cancel()
            sender.cancel()
            self._session.leave(self)
        if self._stuck:
            with contextlib.suppress(TimeoutError, RuntimeError):
                await asyncio.wait_for(self._close("the page took no message", _AGAIN), 1.0)
        elif not self._receiver.cancelled():
            self._receiver.result()

    async def _first(self) -> Hello | None:
        """Wait for the first message, and let nobody in without the token."""
        try:
            async with asyncio.timeout(_PATIENCE):
                text = await self._text()
        except TimeoutError:
            # A page on a busy machine comes late: it is to try again, not to give up.
            await self._close("no first message came", _AGAIN)
            return None
        found = None if text is None else self._let_in(text)
        if isinstance(found, str):
            await self._close(found)
            return None
        return found

    def _let_in(self, text: str) -> Hello | str:
        """Give what a first message says, or why nobody is let in with it."""
        try:
            hello = parse(text)
        except BadInputError as error:
            return str(error)
        if not isinstance(hello, Hello):
            return "the first message is no hello"
        if not hmac.compare_digest(hello.token.encode(), self._token.encode()):
            return "the address is that of another server; open the new one"
        if hello.version != VERSION:
            return "the page is of another version; reload it"
        return hello

    async def _close(self, reason: str, code: int = _POLICY) -> None:
        await self._socket.close(code, reason[:120])

    async def _text(self) -> str | None:
        """Wait for a message; None where the page has gone, empty text for bytes."""
        message = await self._socket.receive()
        if message["type"] == "websocket.disconnect":
            return None
        return message.get("text") or ""

    async def _receive(self) -> None:
        foreign = 0
        while (text := await self._text()) is not None:
            try:
                message = parse(text)
                if isinstance(message, Hello):
                    raise BadInputError("hello came twice", "in a message of the page", "leave it")
            except BadInputError as error:
                foreign += 1
                told = {"t": "problem", "id": 0, "gesture": 0, "text": str(error)}
                self._outgoing.put_nowait(json.dumps(told))
                if foreign >= _FOREIGN:
                    with contextlib.suppress(TimeoutError):
                        await asyncio.wait_for(self._outgoing.join(), _PATIENCE)
                    await self._close("too many messages that are none", _TOO_MANY)
                    return
            else:
                self._session.submit(self, message)

    async def _send(self) -> None:
        with contextlib.suppress(RuntimeError):  # it was closed meanwhile
            while True:
                message = await self._outgoing.get()
                if isinstance(message, list):
                    if message is self._passing:
                        self._passing = None  # a newer one lines up anew
                    message = message[0]
                if isinstance(message, str):
                    await self._socket.send_text(message)
                else:
                    await self._socket.send_bytes(message)
                self._outgoing.task_done()

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
from assoc_hull.page.wire import VERSION

if TYPE_CHECKING:
    from starlette.websockets import WebSocket

__all__ = ["Connection"]

_PATIENCE = 5.0  # s for the first message
_POLICY, _TOO_MANY = 1008, 1013  # codes a socket is closed with, RFC 6455
_FOREIGN = 20
"""So many messages that are none end a connection."""


class Connection:
    """A page that was let in; a `Client` of the session."""

    def __init__(self, socket: WebSocket, session: Session, token: str) -> None:
        self.author = ""
        self._socket, self._session, self._token = socket, session, token
        self._loop = asyncio.get_running_loop()
        self._outgoing: asyncio.Queue[str | bytes] = asyncio.Queue()

    def tell(self, message: str | bytes) -> None:
        """Send a message; from any thread, without waiting."""
        with contextlib.suppress(RuntimeError):  # the loop has ended, and with it the page
            self._loop.call_soon_threadsafe(self._outgoing.put_nowait, message)

    async def run(self) -> None:
        """Serve until the page goes."""
        await self._socket.accept()
        hello = await self._first()
        if hello is None:
            return
        sender = asyncio.create_task(self._send())
        try:
            self._session.submit(self, hello)
            await self._receive()
        finally:
            sender.cancel()
            self._session.leave(self)

    async def _first(self) -> Hello | None:
        """Wait for the first message, and let nobody in without the token."""
        found = await self._opening()
        if isinstance(found, str):
            await self._close(found)
            return None
        return found

    async def _opening(self) -> Hello | str | None:
        """Give the first message, or why nobody is let in with it; None where the page has gone."""
        try:
            async with asyncio.timeout(_PATIENCE):
                text = await self._text()
            if text is None:
                return None
            hello = parse(text)
        except TimeoutError:
            return "no first message came"
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
                if isinstance(message, str):
                    await self._socket.send_text(message)
                else:
                    await self._socket.send_bytes(message)
                self._outgoing.task_done()

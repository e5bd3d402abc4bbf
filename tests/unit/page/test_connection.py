"""Sockets of the page: nobody is answered without the token, and nonsense ends a connection."""

import asyncio
import json
from collections.abc import Iterator
from typing import Any

import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from assoc_hull.page import PageServer, connection
from assoc_hull.page.connection import Connection
from assoc_hull.page.wire import FrameKind, unpack
from tests.conftest import Shipped


@pytest.fixture(scope="module")
def server(shipped: Shipped) -> Iterator[PageServer]:
    """A server of a small hull."""
    with PageServer(shipped("wigley"), author="anna") as found:
        yield found


def place(server: PageServer) -> tuple[str, str]:
    """The host of a server, and its token."""
    address = server.address.removeprefix("http://")
    return address.partition("/")[0], address.partition("#t=")[2].partition("&")[0]


def talk(server: PageServer, *messages: object, **hello: object) -> list[Any]:
    """Open a socket, say hello and more, and give all that comes until it is closed or silent."""
    host, token = place(server)
    first = {"t": "hello", "version": 1, "token": token, "author": "anna", **hello}

    async def run() -> list[Any]:
        found = list[Any]()
        async with connect(f"ws://{host}/socket", origin=f"http://{host}") as socket:  # type: ignore[arg-type]
            for message in (first, *messages):
                text = message if isinstance(message, str | bytes) else json.dumps(message)
                await socket.send(text)
            await listen(socket, found)
        return found

    return asyncio.run(run())


async def listen(socket: ClientConnection, found: list[Any]) -> None:
    """Take what comes; the code and reason of the end as a pair."""
    try:
        while True:
            data = await asyncio.wait_for(socket.recv(), 1.0)
            found.append(json.loads(data) if isinstance(data, str) else unpack(data))
    except TimeoutError:
        return
    except ConnectionClosed as end:
        found.append((end.rcvd.code, end.rcvd.reason) if end.rcvd else (0, ""))


def test_a_page_with_the_token_is_told_the_hull(server: PageServer) -> None:
    """Session, net, shapes, and what there is to undo."""
    session, net, frame, state = talk(server)
    assert (session["t"], session["file"], net["t"], state["undo"]) == (
        "session",
        None,
        "net",
        None,
    )
    assert frame.kind == FrameKind.NET
    assert len(frame.rows) == len(net["points"]["row"])


@pytest.mark.parametrize(("hello", "reason"), [
    ({"token": "wrong"}, "another server"), ({"token": "é" * 43}, "another server"),
    ({"version": 2}, "another version"), ({"author": ""}, "author"), ({"t": "undo"}, "no field"),
    ({"token": None}, "token"),
])  # fmt: skip
def test_nobody_else_is_answered(server: PageServer, hello: dict[str, Any], reason: str) -> None:
    """The connection is closed, with the reason and nothing else."""
    ((code, words),) = talk(server, **hello)
    assert code == 1008
    assert reason in words


def test_a_first_message_that_is_none_ends_the_connection(server: PageServer) -> None:
    """Bytes, text that is no message, and one that is no hello."""
    host, _ = place(server)

    async def run(message: str | bytes) -> list[Any]:
        found = list[Any]()
        async with connect(f"ws://{host}/socket", origin=f"http://{host}") as socket:  # type: ignore[arg-type]
            await socket.send(message)
            await listen(socket, found)
        return found

    for message in (b"\1\2\3", "garbage", '{"t": "undo", "id": 1}', "[" * 9000):
        ((code, _),) = asyncio.run(run(message))
        assert code == 1008


def test_a_page_that_comes_late_is_told_to_try_again(
    server: PageServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a busy machine: its socket is closed with a code after which pages open another one."""
    monkeypatch.setattr(connection, "_PATIENCE", 0.05)
    host, _ = place(server)

    async def run() -> list[Any]:
        found = list[Any]()
        async with connect(f"ws://{host}/socket", origin=f"http://{host}") as socket:  # type: ignore[arg-type]
            await listen(socket, found)
        return found

    ((code, words),) = asyncio.run(run())
    assert code == 1012
    assert "no first message" in words


def test_nonsense_is_told_and_in_the_end_closes_the_connection(server: PageServer) -> None:
    """One sentence each; a page that is sound never comes near that many."""
    found = talk(server, *(["nonsense", b"\0", '{"t": "to", "d": NaN}'] * 7))
    problems = [each for each in found if isinstance(each, dict) and each["t"] == "problem"]
    assert len(problems) == 20
    assert found[-1][0] == 1013
    again = talk(server, {"t": "hello", "version": 1, "token": "x", "author": "a"})
    (problem,) = (each for each in again if isinstance(each, dict) and each["t"] == "problem")
    assert "hello came twice" in problem["text"]


@pytest.mark.parametrize("origin", [None, "null", "http://evil.example", "http://127.0.0.1"])
def test_a_socket_of_another_site_is_refused(server: PageServer, origin: str | None) -> None:
    """Before anything is said."""
    host, _ = place(server)

    async def run() -> None:
        async with connect(f"ws://{host}/socket", origin=origin):  # type: ignore[arg-type]
            pass

    with pytest.raises(InvalidStatus, match="403"):
        asyncio.run(run())


def test_a_message_that_is_too_long_ends_the_connection(server: PageServer) -> None:
    """Of more than 64 kB it is told; of more than 1 MB it is not even read."""
    found = talk(server, " " * 70_000)
    (problem,) = (each for each in found if isinstance(each, dict) and each["t"] == "problem")
    assert "it has 70000 letters" in problem["text"]
    assert talk(server, " " * 1_100_000)[-1][0] == 1009


class SlowPage:
    """A socket whose page takes a message when it is let; then it keeps what came."""

    def __init__(self) -> None:
        self.came = list[str | bytes]()
        self.takes = asyncio.Event()
        self.closed = list[int]()

    async def accept(self) -> None:
        """Open it."""

    async def receive(self) -> dict[str, Any]:
        """Say hello once, then nothing."""
        if not hasattr(self, "said"):
            self.said = True
            hello = {"t": "hello", "version": 1, "token": "t", "author": "bert"}
            return {"type": "websocket.receive", "text": json.dumps(hello)}
        await asyncio.Event().wait()
        raise AssertionError

    async def send_text(self, message: str) -> None:
        """Take a text."""
        await self.takes.wait()
        self.came.append(message)

    send_bytes = send_text

    async def close(self, code: int, _: str) -> None:
        """End it."""
        self.closed.append(code)


class Nobody:
    """A session that does nothing."""

    def submit(self, *_: object) -> None:
        """Take a message."""

    def leave(self, client: Connection) -> None:
        """Forget a client."""
        self.left = client


def theirs(number: int) -> bytes:
    """A frame of what somebody else does."""
    return bytes([1, FrameKind.THEIRS]) + number.to_bytes(8, "little")


def test_of_what_another_does_only_the_newest_frame_waits() -> None:
    """A page that is behind skips frames; what lies between two gestures keeps its place."""

    async def run() -> list[str | bytes]:
        page = SlowPage()
        connection = Connection(page, Nobody(), "t")  # type: ignore[arg-type]
        task = asyncio.create_task(connection.run())
        await asyncio.sleep(0.01)
        connection.tell("hold")
        await asyncio.sleep(0.01)
        for number in range(5000):
            connection.tell(theirs(number))
        connection.tell("let go")
        connection.tell(theirs(7000))
        connection.tell(theirs(7001))
        await asyncio.sleep(0.01)
        page.takes.set()
        await asyncio.sleep(0.01)
        connection.tell(theirs(8000))
        await asyncio.sleep(0.01)
        task.cancel()
        return page.came

    assert asyncio.run(run()) == ["hold", theirs(4999), "let go", theirs(7001), theirs(8000)]


def test_a_page_that_takes_nothing_is_let_go() -> None:
    """The server does not fill its memory; the page may come again, and is told all then."""

    async def run() -> tuple[list[int], Nobody, Connection]:
        page, session = SlowPage(), Nobody()
        connection = Connection(page, session, "t")  # type: ignore[arg-type]
        task = asyncio.create_task(connection.run())
        await asyncio.sleep(0.01)
        for number in range(1200):
            connection.tell(str(number))
        await asyncio.wait_for(task, 5.0)
        return page.closed, session, connection

    codes, session, connection = asyncio.run(run())
    assert codes == [1012]
    assert session.left is connection

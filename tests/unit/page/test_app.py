"""Who is let in, what is answered with which headers, and what the static files hold."""

import asyncio
import contextlib
import gzip
import re
import threading
import time
import urllib.request
from collections.abc import MutableMapping
from http.client import HTTPException
from importlib.resources import files
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.page import PageServer
from assoc_hull.page.app import Guard, Visitors, family_colours, make_app, static_files
from assoc_hull.page.session import Session
from assoc_hull.plot.sheet.paper import FAMILY_COLOURS
from tests.conftest import Shipped

PORT = 8123
OWN = [f"127.0.0.1:{PORT}", f"localhost:{PORT}"]
FOREIGN_HOSTS = [
    None, "", "127.0.0.1", "localhost", f"127.0.0.1:{PORT + 1}", "127.0.0.1:80",
    f"127.evil.example:{PORT}", f"evil.example:{PORT}", f"127.0.0.1.evil.example:{PORT}",
    f"localhost.:{PORT}", f"[::1]:{PORT}",
    f"0.0.0.0:{PORT}", f"127.0.0.1:{PORT}@evil.example", f"LOCALHOST:{PORT}", f" 127.0.0.1:{PORT}",
]  # fmt: skip
FOREIGN_ORIGINS = [
    "null", "", f"https://127.0.0.1:{PORT}", f"http://127.0.0.1:{PORT + 1}", "http://127.0.0.1",
    f"http://evil.example:{PORT}", f"http://127.0.0.1:{PORT}.evil.example", "file://",
    f"http://127.0.0.1:{PORT}/", f"HTTP://127.0.0.1:{PORT}",
]  # fmt: skip
FILES = static_files()
SCRIPTS = {name: body.decode() for name, (body, _) in FILES.items() if name.endswith(".js")}


async def nothing(*_: Any) -> None:
    """An application that is never reached here."""


GUARD = Guard(nothing, PORT)


@pytest.mark.parametrize("host", OWN)
def test_its_own_page_is_let_in(host: str) -> None:
    """Under both names; a page is opened without an origin, a socket never is."""
    for origin in (f"http://{each}" for each in OWN):
        assert GUARD.lets_in("websocket", host, origin)
        assert GUARD.lets_in("http", host, origin)
    assert GUARD.lets_in("http", host, None)
    assert not GUARD.lets_in("websocket", host, None)


@pytest.mark.parametrize("host", FOREIGN_HOSTS)
def test_a_foreign_host_is_kept_out(host: str | None) -> None:
    """Also where host and origin agree, as those of a page that rebinds its name do."""
    for kind in ("http", "websocket"):
        for origin in (None, f"http://{host}", f"http://{OWN[0]}"):
            assert not GUARD.lets_in(kind, host, origin)


@pytest.mark.parametrize("origin", FOREIGN_ORIGINS)
def test_a_foreign_origin_is_kept_out(origin: str) -> None:
    """No part of the address will do."""
    for kind in ("http", "websocket"):
        assert not GUARD.lets_in(kind, OWN[0], origin)


def get(
    app: Any, path: str, *headers: tuple[bytes, bytes], method: str = "GET"
) -> tuple[int, dict[str, str], bytes]:
    """Ask an application for a file: status, headers, body."""
    sent = list[MutableMapping[str, Any]]()

    async def receive() -> dict[str, Any]:
        return {"type": "http.request", "body": b"", "more_body": False}

    async def send(event: MutableMapping[str, Any]) -> None:
        sent.append(event)

    scope = {
        "type": "http", "asgi": {"version": "3.0"}, "http_version": "1.1", "method": method,
        "scheme": "http", "path": path, "raw_path": path.encode(), "query_string": b"",
        "root_path": "", "headers": list(headers),
        "client": ("127.0.0.1", 1), "server": ("127.0.0.1", PORT),
    }  # fmt: skip
    asyncio.run(app(scope, receive, send))
    about = {key.decode().lower(): value.decode() for key, value in sent[0]["headers"]}
    return sent[0]["status"], about, b"".join(each.get("body", b"") for each in sent[1:])


@pytest.fixture(scope="module")
def app(shipped: Shipped) -> Any:
    """The application of a small hull."""
    session = Session(shipped("wigley"))
    yield make_app(session, "token", PORT, Visitors())
    session.close()


HOST = (b"host", OWN[0].encode())


@pytest.mark.parametrize("name", ["", *FILES])
def test_files_come_with_headers_that_shut_all_else_out(app: Any, name: str) -> None:
    """Nothing from elsewhere, no inline script, nothing kept, nothing framed."""
    status, about, body = get(app, f"/{name}", HOST)
    assert status == 200
    assert body == FILES[name or "index.html"][0]
    policy = about["content-security-policy"]
    assert policy.startswith("default-src 'none'; script-src 'self';")
    assert f"ws://127.0.0.1:{PORT}" in policy
    assert "frame-ancestors 'none'" in policy
    assert "unsafe" not in policy
    assert about["x-content-type-options"] == "nosniff"
    assert about["referrer-policy"] == "no-referrer"
    assert about["cache-control"] == "no-store"
    assert (
        about["cross-origin-resource-policy"]
        == about["cross-origin-opener-policy"]
        == "same-origin"
    )


@pytest.mark.parametrize("path", [
    "/nothing.js", "/../wire.py", "/..%2fwire.py", "/static/page.js", "//etc/passwd",
    "/__init__.py",
])  # fmt: skip
def test_there_is_no_way_to_other_files(app: Any, path: str) -> None:
    """Names are those of a fixed list; nothing is joined to a path."""
    assert get(app, path, HOST)[0] == 404


def test_a_request_by_another_name_is_refused(app: Any) -> None:
    """In words; also one with the header twice, and one that is no GET."""
    status, _, body = get(app, "/", (b"host", b"evil.example"))
    assert (status, body) == (403, b"this server answers to its own address only")
    assert get(app, "/", HOST, (b"host", b"evil.example"))[0] == 403
    assert get(app, "/", HOST, method="POST")[0] == 405


def downloaded(app: Any) -> dict[str, bytes]:
    """What a browser that takes zipped answers is sent when it opens the page, by name."""
    found, wanted = dict[str, bytes](), ["index.html"]
    while wanted:
        name = wanted.pop()
        if name not in found:
            path = "/" if name == "index.html" else f"/{name}"
            status, about, found[name] = get(app, path, HOST, (b"accept-encoding", b"gzip, br"))
            assert (status, about["content-encoding"]) == (200, "gzip")
            text = gzip.decompress(found[name]).decode()
            wanted += re.findall(r'(?:href|src)="([^"]+)"|from "\./(\w+\.js)"', text)
            wanted = ["".join(each) for each in wanted]
    return found


def test_what_a_browser_downloads_stays_within_its_budget(app: Any) -> None:
    """All but the notebook's own script; before and after it is unzipped."""
    found = downloaded(app)
    assert set(FILES) - set(found) == {"widget.js"}
    assert sum(map(len, found.values())) < 80_000
    assert sum(len(gzip.decompress(body)) for body in found.values()) < 250_000
    for name, body in found.items():
        assert gzip.decompress(body) == FILES[name][0]


def test_scripts_are_sent_without_comments_and_indents_and_else_as_they_are() -> None:
    """Each statement stands in its line; a word within quotes is no comment."""
    for each in files("assoc_hull.page").joinpath("static").iterdir():
        if not each.name.endswith(".js"):
            continue
        written, sent = each.read_text().splitlines(), SCRIPTS[each.name].splitlines()
        assert len(written) == len(sent)
        assert not re.search(r"/\*|\*/|^ *//", SCRIPTS[each.name], re.M)
        block = False
        for line, short in zip(written, sent, strict=True):
            block |= line.lstrip().startswith("/**")
            if not block and "/**" not in line and not line.lstrip().startswith("//"):
                assert short == line.lstrip()
            block &= "*/" not in line


def test_static_files_name_no_other_site_and_hold_no_inline_script() -> None:
    """But the name space of SVG."""
    whole = b"".join(body for body, _ in FILES.values())
    addresses = set(re.findall(rb"https?:[^\s\"'`)]*", whole))
    assert addresses <= {b"http://www.w3.org/2000/svg"}
    page = FILES["index.html"][0].decode()
    assert re.findall(r"<script(?![^>]*src=)|style=|\son\w+=", page) == []


@pytest.mark.parametrize("name", SCRIPTS)
def test_modules_can_be_joined_and_write_no_markup(name: str) -> None:
    """Imports of names on lines of their own, named exports; names of a hull are never markup."""
    text = SCRIPTS[name]
    assert text.count("\n") < 500
    for line in text.splitlines():
        if line.startswith("import"):
            assert re.fullmatch(r'import \{[\w, ]+\} from "\./\w+\.js";', line)
        if line.startswith("export"):
            assert re.match(r"export (async )?(function|class|const) ", line)
    assert not re.search(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(", text)


def test_modules_know_one_another_one_way() -> None:
    """There is no ring of imports."""
    known = {name: set(re.findall(r'from "\./(\w+\.js)"', text)) for name, text in SCRIPTS.items()}
    while free := [name for name, needs in known.items() if not needs & set(known)]:
        for name in free:
            del known[name]
    assert known == {}


def test_colours_of_families_are_those_of_the_drawings() -> None:
    """Light ground has them as they are; on dark ground they are light enough to be read."""
    light, dark = family_colours().splitlines()
    for name, colour in FAMILY_COLOURS.items():
        assert f"--{name}: {colour};" in light
        (found,) = re.findall(rf"--{name}: #(\w{{6}});", dark)
        assert contrast(found, "14181d") >= 4.5
        assert contrast(colour[1:], "fdfcf9") >= 3.0


def contrast(one: str, other: str) -> float:
    """The ratio of WCAG 2."""

    def light(colour: str) -> float:
        parts = [int(colour[i : i + 2], 16) / 255.0 for i in (0, 2, 4)]
        parts = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in parts]
        return sum(w * v for w, v in zip((0.2126, 0.7152, 0.0722), parts, strict=True))

    low, high = sorted((light(one), light(other)))
    return (high + 0.05) / (low + 0.05)


def test_a_server_says_what_does_not_fit(shipped: Shipped) -> None:
    """Before anything is served; a port that is taken is named."""
    with pytest.raises(WrongTypeError, match="hull"):
        PageServer(7)  # type: ignore[arg-type]
    with pytest.raises(BadInputError, match="port"):
        PageServer(shipped("wigley"), port=70000)
    with pytest.raises(BadInputError, match="author"):
        PageServer(shipped("wigley"), author="")
    with PageServer(shipped("wigley")) as server:
        port = int(server.address.split(":")[2].split("/")[0])
        other = PageServer(shipped("wigley"), port=port)
        with pytest.raises(BadInputError, match=f"the port {port} cannot be had"):
            other.__enter__()


def test_two_servers_have_other_tokens(shipped: Shipped) -> None:
    """Each of 32 random bytes, behind # so that no log and no other site sees it."""
    hull: ah.Hull = shipped("wigley")
    with PageServer(hull, author="anna & bert") as one, PageServer(hull) as other:
        tokens = [re.search(r"/#t=([\w-]{43})&", each.address) for each in (one, other)]
        assert tokens[0]
        assert tokens[1]
        assert tokens[0][1] != tokens[1][1]
        assert one.address.endswith("&author=anna%20%26%20bert")


@pytest.mark.parametrize("given", [None, b"", b"other", b"tokentoken"])
def test_a_dropped_file_is_taken_from_its_own_page_only(app: Any, given: bytes | None) -> None:
    """Nothing is read of who does not know the token, by whatever name it asks."""
    more = [] if given is None else [(b"x-token", given)]
    assert get(app, "/drop", HOST, *more, method="POST")[0] == 403
    assert get(app, "/drop", (b"host", b"evil.example"), (b"x-token", b"token"),
               method="POST")[0] == 403  # fmt: skip


def test_a_server_does_not_wait_for_a_file_that_it_reads(
    shipped: Shipped, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A large mesh takes a minute; who leaves meanwhile leaves."""
    begun, go = threading.Event(), threading.Event()

    def slow(*_: Any) -> dict[str, Any]:
        begun.set()
        go.wait(60.0)
        return {}

    def drop(address: str) -> None:
        at, _, given = address.partition("#")
        headers = {"X-Token": given.split("&")[0].removeprefix("t=")}
        asked = urllib.request.Request(f"{at}drop?name=a.stl", b"solid", headers)
        with contextlib.suppress(OSError, HTTPException):  # the server leaves
            urllib.request.urlopen(asked, timeout=30.0).close()

    monkeypatch.setattr("assoc_hull.page.app._told_of", slow)
    with PageServer(shipped("wigley")) as server:
        hand = threading.Thread(target=drop, args=(server.address,))
        hand.start()
        assert begun.wait(30.0)
        begin = time.monotonic()
    took = time.monotonic() - begin
    go.set()
    hand.join(30.0)
    assert took < 5.0

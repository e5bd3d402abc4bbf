"""The address of a killed server: kept where only the user reads it, and for the next one only."""

import asyncio
import json
import os
import stat
import time
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.page import PageServer
from assoc_hull.page.kept_address import KeptAddress
from tests.conftest import Shipped

TOKEN = "t" * 43


@pytest.fixture
def kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> KeptAddress:
    """The place for a hull file."""
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    return KeptAddress.of(tmp_path / "ship.hull")


def test_what_is_kept_is_read_by_its_user_alone(kept: KeptAddress) -> None:
    """By nobody else; once the server has ended it is gone."""
    assert kept.read() is None
    kept.keep(8123, TOKEN)
    assert kept.path is not None
    assert stat.S_IMODE(kept.path.stat().st_mode) == 0o600
    assert kept.read() == (8123, TOKEN)
    kept.path.chmod(0o644)
    assert kept.read() is None
    kept.path.chmod(0o600)
    kept.forget()
    assert not kept.path.exists()


def test_a_server_forgets_its_own_address_only(kept: KeptAddress) -> None:
    """Another one of the same file has kept its own since."""
    other = KeptAddress(kept.path)
    kept.keep(8123, TOKEN)
    other.keep(8124, TOKEN[::-1].replace("t", "u"))
    kept.forget()
    assert other.read() == (8124, "u" * 43)


@pytest.mark.parametrize(
    "text",
    ["", "{", "[1]", "3", '{"port": 8123}', json.dumps({"port": True, "token": TOKEN}),
     json.dumps({"port": 70000, "token": TOKEN}), json.dumps({"port": 8123, "token": "short"})],
)  # fmt: skip
def test_what_does_not_fit_is_as_if_there_were_none(kept: KeptAddress, text: str) -> None:
    """A damaged file, a weak token: a new address is taken."""
    kept.keep(8123, TOKEN)
    assert kept.path is not None
    kept.path.write_text(text)
    assert kept.read() is None


def test_an_old_address_is_not_taken(kept: KeptAddress) -> None:
    """Ten minutes after the server said last that it runs; the file is removed by then."""
    kept.keep(8123, TOKEN)
    assert kept.path is not None
    for age, found in ((500.0, (8123, TOKEN)), (700.0, None)):
        os.utime(kept.path, (time.time() - age,) * 2)
        assert kept.read() == found
    assert not kept.path.exists()


def test_the_address_of_a_server_that_runs_does_not_age(kept: KeptAddress) -> None:
    """It says so now and then; one whose place another has taken says nothing for that one."""
    kept.keep(8123, TOKEN)
    assert kept.path is not None
    os.utime(kept.path, (1e9, 1e9))
    asyncio.run(kept.run_on())
    assert kept.read() == (8123, TOKEN)
    KeptAddress(kept.path).keep(8124, "u" * 43)
    os.utime(kept.path, (1e9, 1e9))
    asyncio.run(kept.run_on())
    assert kept.read() is None


def test_a_server_that_ran_for_long_forgets_its_address(kept: KeptAddress) -> None:
    """Also where it could not say that it runs, as in a machine that was asleep."""
    kept.keep(8123, TOKEN)
    assert kept.path is not None
    os.utime(kept.path, (1e9, 1e9))
    kept.forget()
    assert not kept.path.exists()


def test_a_hull_in_memory_keeps_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nor does a folder that cannot be written stop the server."""
    KeptAddress.of(None).keep(8123, TOKEN)
    assert KeptAddress.of(None).read() is None
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path / "file"))
    place = KeptAddress.of(tmp_path / "ship.hull")
    place.keep(8123, TOKEN)
    assert place.read() is None
    place.forget()


def test_a_server_after_a_killed_one_has_its_address(
    kept: KeptAddress, shipped: Shipped, tmp_path: Path
) -> None:
    """While that one still runs, a second has another; ended in order, both are gone."""
    path = tmp_path / "ship.hull"
    shipped("series60_70").save(path)
    with PageServer(ah.open(path)) as first:
        with PageServer(ah.open(path)) as second:
            assert second.address != first.address
        kept.keep(int(first.address.split(":")[2].split("/")[0]), TOKEN)
    with PageServer(ah.open(path)) as third:  # as if the first had been killed
        assert TOKEN in third.address
    with PageServer(ah.open(path)) as fourth:
        assert TOKEN not in fourth.address


def test_a_server_says_that_it_runs(
    kept: KeptAddress, shipped: Shipped, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As long as it does, its address does not age."""
    monkeypatch.setattr("assoc_hull.page.server._RUNS_ON", 0)
    shipped("series60_70").save(tmp_path / "ship.hull")
    assert kept.path is not None
    with PageServer(ah.open(tmp_path / "ship.hull")):
        os.utime(kept.path, (1e9, 1e9))
        end = time.monotonic() + 20.0
        while kept.path.stat().st_mtime <= 1e9 and time.monotonic() < end:
            time.sleep(0.05)
        assert kept.read() is not None

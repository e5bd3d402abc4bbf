"""Files that come to the page's server, and that it writes: whatever fails is a sentence."""

import errno
import logging
import shutil
from pathlib import Path
from typing import Any, NoReturn

import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.page.app import _told_of
from assoc_hull.page.files import read_dropped, write_export
from tests.conftest import Shipped


def full(*_: Any, **__: Any) -> NoReturn:
    """Fail as a disk does that has no room."""
    raise OSError(errno.ENOSPC, "No space left on device")


def test_a_full_disk_is_told_where_a_file_is_dropped(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """It is no error of the program, and nothing stands in its log."""
    monkeypatch.setattr(Path, "write_bytes", full)
    with caplog.at_level(logging.DEBUG):
        found = _told_of(b"x", "a.hull")
    assert "No space left on device" in found["problem"]
    assert "make room" in found["problem"]
    assert caplog.records == []


def test_a_full_disk_is_told_where_a_file_is_written(
    monkeypatch: pytest.MonkeyPatch, shipped: Shipped
) -> None:
    """Nobody is told to give another place for a file whose place he did not choose."""
    monkeypatch.setattr(shutil, "disk_usage", lambda _: shutil._ntuple_diskusage(1, 1, 0))
    monkeypatch.setattr(Path, "read_bytes", full)
    with pytest.raises(BadInputError, match=r"no room to write .*\.csv .*make room there"):
        write_export(shipped("wigley"), "csv")


@pytest.mark.parametrize(
    "name", ["<img src=x onerror=alert(1)>.csv", "../../etc/passwd", "a\0b.stl", "x" * 5000, "",
             "..", "-o", "con.hull", "\N{CJK UNIFIED IDEOGRAPH-8239}.hull"],
    ids=["markup", "folder", "zero", "long", "none", "dots", "option", "device", "foreign"],
)  # fmt: skip
def test_a_file_of_any_name_is_told_of(name: str) -> None:
    """In a sentence that names no folder of the server."""
    told = read_dropped(b"\0\1\2 nothing", name)["problem"]
    assert told
    assert "/tmp" not in told
    assert "<" not in told

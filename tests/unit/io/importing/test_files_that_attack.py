"""Files made to take all memory or time, or to lie about what they hold, are refused in words."""

from __future__ import annotations

import io
import struct
import time
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, BadInputError, NotSoundError
from tests.fuzz.kinds.exports import exported
from tests.fuzz.kinds.meshes import text_ply, unchanged_stl
from tests.fuzz.kinds.offsets import KEEL
from tests.fuzz.measure import processor_time

SECONDS = 5.0
"""Of processor time: half of what an input may take, on any machine."""


def refusal(path: Path, data: bytes, **options: float) -> str:
    """Write a file, and give the words with which it is refused, soon."""
    path.write_bytes(data)
    start = processor_time()
    with pytest.raises(AssocHullError) as refused:
        ah.read(path, **options)  # type: ignore[arg-type]
    assert processor_time() - start < SECONDS
    return str(refused.value)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        pytest.param(lambda: b"1," * 25_000_000, "holds 50.0 MB of text", id="one line"),
        pytest.param(
            lambda: b"station,wl_0\n" + b"0,1\n" * 600_000, "1200002 cells", id="rows"
        ),
        pytest.param(lambda: b"station wl_0\n" + b"1 " * 300_000, "cells", id="blanks"),
    ],
)  # fmt: skip
def test_a_table_longer_than_any_ships_is_refused_at_once(
    make: Callable[[], bytes], words: str, tmp_path: Path
) -> None:
    """Before its cells are parted."""
    assert words in refusal(tmp_path / "a.csv", make(), length=60.0)


def workbook(name: str, content: bytes) -> bytes:
    """A workbook with another content of the part whose name has this in it."""
    whole, out = zipfile.ZipFile(io.BytesIO(exported("ship.xlsx", "xlsx"))), io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as book:
        for each in whole.namelist():
            book.writestr(each, content if name in each else whole.read(each))
    return out.getvalue()


def test_a_workbook_that_unpacks_to_much_is_refused(tmp_path: Path) -> None:
    """.2 MB that hold 135 MB."""
    data = workbook("sheet1", b"<worksheet><sheetData>" + b"<row><c><v>1</v></c></row>" * 5_200_000)
    assert len(data) < 500_000
    assert "unpacks to 135 MB" in refusal(tmp_path / "a.xlsx", data)


def test_entities_of_entities_are_not_written_out(tmp_path: Path) -> None:
    """Ten in each of ten, eight times: 100 GB if anyone did."""
    levels = "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 9))
    text = (
        f'<?xml version="1.0"?><!DOCTYPE x [<!ENTITY e0 "{"x" * 1000}">{levels}]><worksheet '
        'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData><row r="1">'
        '<c r="A1" t="inlineStr"><is><t>&e8;</t></is></c></row></sheetData></worksheet>'
    )
    assert "a.xlsx" in refusal(tmp_path / "a.xlsx", workbook("sheet1", text.encode()))


def drawing(blocks: str, first: str) -> bytes:
    """A DXF of blocks, one of which is drawn."""
    insert = f"0\nINSERT\n2\n{first}\n10\n0\n20\n0\n30\n0\n"
    return (
        f"0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{insert}0\nENDSEC\n0\n"
        "EOF\n"
    ).encode()


def block(name: str, inside: str) -> str:
    """A block of a DXF."""
    return f"0\nBLOCK\n2\n{name}\n{inside}0\nENDBLK\n"


def test_blocks_of_blocks_are_not_drawn_without_end(tmp_path: Path) -> None:
    """Ten in each of ten, twelve times; and one that draws itself."""
    line = "0\nLINE\n8\nST 1\n10\n5\n20\n0\n30\n0\n11\n5\n21\n1\n31\n1\n"
    many = block("B12", line)
    for i in range(12):
        inside = "".join(f"0\nINSERT\n2\nB{i + 1}\n10\n{k}\n20\n0\n30\n0\n" for k in range(10))
        many += block(f"B{i}", inside)
    assert "all lines lie at x = 5 m" in refusal(tmp_path / "a.dxf", drawing(many, "B0"))
    itself = block("A", "0\nINSERT\n2\nA\n10\n0\n20\n0\n30\n0\n" + line)
    assert "all lines lie at x" in refusal(tmp_path / "a.dxf", drawing(itself, "A"))


def lying_stl() -> bytes:
    """It tells of four thousand million triangles."""
    data = unchanged_stl()
    return data[:80] + struct.pack("<I", 2**32 - 1) + data[84:]


def short_ply() -> bytes:
    """A text that ends in the middle."""
    text = text_ply()
    return text[: text.rindex(b"\n", 0, len(text) * 9 // 10) + 1]


@pytest.mark.parametrize(
    ("name", "make"),
    [
        pytest.param("a.stl", lying_stl, id="stl"),
        pytest.param("a.stl", lambda: unchanged_stl()[:-500], id="short stl"),
        pytest.param("a.ply", short_ply, id="short ply"),
    ],
)
def test_counts_that_lie_take_no_memory(
    name: str, make: Callable[[], bytes], tmp_path: Path
) -> None:
    """The file is shorter than it says."""
    assert "cut short" in refusal(tmp_path / name, make())


@pytest.mark.parametrize("word", ["nan", "inf", "-inf", "1e999"])
def test_a_half_breadth_that_is_no_number_is_named(word: str, tmp_path: Path) -> None:
    """With its row and column."""
    words = refusal(tmp_path / "a.csv", KEEL.replace("3.4", word).encode(), length=60.0)
    assert "row 5 (station 6), column 'wl_1'" in words


def test_an_outlier_is_a_verdict_and_no_broad_ship(tmp_path: Path) -> None:
    """34 typed for 3.4: refused with the cell; taken on demand, the verdict says it."""
    path = tmp_path / "a.csv"
    path.write_text(KEEL.replace("3.4", "34"))
    with pytest.raises(NotSoundError) as refused:
        ah.read(path, length=60.0)
    assert any("(36.000, 34.000, 1.000) m" in each for each in refused.value.findings)


def test_a_link_and_a_missing_file_are_told_apart(tmp_path: Path) -> None:
    """A link to a good file is read; one to nothing is no file, soon."""
    good, link, loop = tmp_path / "a.csv", tmp_path / "b.csv", tmp_path / "c.csv"
    good.write_text(KEEL)
    link.symlink_to(good)
    loop.symlink_to(loop)
    assert ah.read(link, length=60.0).particulars.length == 60.0
    start = time.monotonic()
    with pytest.raises(BadInputError, match=r"c\.csv"):
        ah.read(loop, length=60.0)
    assert time.monotonic() - start < 5.0

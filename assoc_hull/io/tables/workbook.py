"""XLSX workbooks through openpyxl (extra ``xlsx``): the same bytes for the same cells.

Examples
--------
>>> from assoc_hull.io.tables.workbook import openpyxl_module, workbook_bytes
>>> workbook_bytes(openpyxl_module().Workbook())[:2]
b'PK'
"""

from __future__ import annotations

import datetime
import io
import re
import zipfile
from collections.abc import Iterable
from typing import Any

from assoc_hull.errors import MissingExtraError

__all__ = ["head_on", "openpyxl_module", "workbook_bytes"]

_DAY = datetime.datetime(2000, 1, 1)
"""A workbook bears a date; one that never changes gives the same bytes for the same cells."""


def openpyxl_module() -> Any:
    """Give openpyxl.

    Raises
    ------
    MissingExtraError
        It is not installed.
    """
    try:
        import openpyxl
    except ImportError:
        raise MissingExtraError("openpyxl", "xlsx") from None
    return openpyxl


def head_on(sheet: Any, lines: Iterable[tuple[str, str]]) -> None:
    """Write the head of a table: pairs of a title and words, a row each."""
    for title, words in lines:
        sheet.append([f"# {title}", " ".join(words.split())])
        sheet.cell(sheet.max_row, 2).data_type = "s"  # a name that begins with = is no formula


def workbook_bytes(book: Any) -> bytes:
    """Give the file of a workbook, with a fixed date."""
    book.properties.created = book.properties.modified = _DAY
    out = io.BytesIO()
    book.save(out)
    return _settled(out.getvalue())


def _settled(data: bytes) -> bytes:
    """Put a fixed date on the members of an archive."""
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(out, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            if name == "docProps/core.xml":
                content = re.sub(rb"(<dcterms:modified[^>]*>)[^<]*", rb"\g<1>2000-01-01T00:00:00Z",
                                 content)  # fmt: skip
            member = zipfile.ZipInfo(name, _DAY.timetuple()[:6])
            new.writestr(member, content, zipfile.ZIP_DEFLATED)
    return out.getvalue()

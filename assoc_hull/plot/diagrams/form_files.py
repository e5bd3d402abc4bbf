"""Writing the form parameters of a hull to a file, in the form that its name ends in."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from assoc_hull.analysis.form.report import FormReport
from assoc_hull.arguments import file_path, instance
from assoc_hull.errors import BadInputError
from assoc_hull.io.tables.form_json import form_json
from assoc_hull.io.tables.form_table import csv_text, xlsx_bytes
from assoc_hull.io.tables.form_text import form_text
from assoc_hull.io.write_file import write_whole
from assoc_hull.plot.diagrams.form_sheet import form_pdf
from assoc_hull.plot.sheet.sheet import Path_

__all__ = ["ENDINGS", "write_form_report"]

_FORMS: Mapping[str, Callable[[FormReport], bytes]] = MappingProxyType(
    {
        ".txt": lambda report: form_text(report).encode(),
        ".pdf": form_pdf,
        ".csv": lambda report: csv_text(report).encode(),
        ".xlsx": xlsx_bytes,
        ".json": lambda report: form_json(report).encode(),
    }
)

ENDINGS = tuple(_FORMS)
"""How a name may end."""


def write_form_report(report: FormReport, path: Path_) -> None:
    """Write the form parameters of a hull.

    Parameters
    ----------
    report : FormReport
        Of the hull.
    path : path
        The ending tells the form: ``.txt`` and ``.pdf`` for people, ``.csv``, ``.xlsx`` and
        ``.json`` for programs.

    Raises
    ------
    BadInputError
        Another ending, or a file that cannot be written.
    MissingExtraError
        A PDF was asked and matplotlib is not installed, or a workbook and openpyxl is not.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from assoc_hull.analysis.form.report import form_report
    >>> from assoc_hull.plot.diagrams.form_files import write_form_report
    >>> from assoc_hull.sources import examples
    >>> report = form_report(examples.wigley(), draught=6.25, only=["Cb"])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_form_report(report, Path(folder) / "wigley.txt")
    ...     (Path(folder) / "wigley.txt").read_text("utf-8")[:15]
    'FORM PARAMETERS'
    """
    instance(report, FormReport, "the report")
    name = file_path(path)
    form = _FORMS.get(Path(name).suffix.lower())
    if form is None:
        known = ", ".join(ENDINGS)
        raise BadInputError("the form is unknown", f"at {path}", f"end the name in one of {known}")
    write_whole(name, form(report))

"""Whether the text of a STEP file is sound, before OpenCASCADE reads it; and its unit of length.

OpenCASCADE ends the process, or does not come to an end, on some files with a number that is none
or a reference to nothing. So the words of the data section are looked at first.

Source: ISO 10303-21 (2016), sections 5 to 11: the exchange structure and its tokens.

Examples
--------
>>> from assoc_hull.io.cad.step_text import require_sound, step_unit
>>> unit = "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));"
>>> text = f"ISO-10303-21;HEADER;ENDSEC;DATA;{unit}ENDSEC;END-ISO-10303-21;"
>>> require_sound(text, "a.step")
>>> step_unit(text)
'mm'
"""

from __future__ import annotations

import re

from assoc_hull.errors import BadInputError

__all__ = ["require_sound", "step_unit"]

_AGAIN = "export or copy it again, whole"
_STRING = re.compile(r"'(?:[^']|'')*'|/\*.*?\*/|\"[0-9A-F]*\"", re.S)
_DATA = re.compile(r"\bDATA\s*(?:\([^;]*\))?\s*;(.*?)\bENDSEC\s*;", re.S)
_PLAIN = (
    (re.compile(r"\.[A-Za-z0-9_]+\."), "*"),
    (re.compile(r"#[0-9]+"), "@"),
    (re.compile(r"!?[A-Za-z_][A-Za-z0-9_]*(?=\s*\()"), "@"),
    (re.compile(r"[-+]?[0-9]+(?:\.[0-9]*)?(?:[eE][-+]?[0-9]+)?"), "0"),
)
"""Words of a statement: enumerations, references, keywords, numbers; what is left is marks."""

_STRANGE = re.compile(r"[^@0*$'(),=;\s]|,\s*[,)]|\(\s*,")
"""A mark or a word that is none, or a value that is left out."""

_LARGE = re.compile(r"[0-9.][eE]\+?0*(?:[2-9][0-9]{2,}|1[0-9]{3,}|10[1-9]|1[1-9][0-9])\b")

_PREFIX = {"$": "m", "": "m", ".MILLI.": "mm", ".CENTI.": "cm"}
_CONVERTED = {"INCH": "in", "IN": "in", "FOOT": "ft", "FEET": "ft", "FT": "ft"}


def require_sound(text: str, source: str) -> None:
    """Refuse a file that is cut short, or whose statements are none.

    Parameters
    ----------
    text : str
        The file.
    source : str
        Its name, for messages.

    Raises
    ------
    BadInputError
        It does not end as it must, has no data, a word that is none, brackets that do not
        close, a reference to nothing, or a number over 1e100.
    """
    where = f"in {source}"
    if not re.search(r"END-ISO-10303-21\s*;\s*\Z", text):
        raise BadInputError("the file is cut short", where, _AGAIN)
    bare = _STRING.sub(lambda found: " " if found[0].startswith("/*") else "''", text)
    data = "".join(_DATA.findall(bare))
    if not data.strip():
        raise BadInputError("there is no data", where, _AGAIN)
    large = _LARGE.search(data)
    if large:
        raise BadInputError(f"a number is too large ({large[0]})", where, _AGAIN)
    known = set(re.findall(r"#([0-9]+)\s*=", data))
    missing = set(re.findall(r"#([0-9]+)", data)) - known
    if missing:
        first = min(missing, key=int)
        raise BadInputError(f"there is no entity #{first}, which others use", where, _AGAIN)
    plain = data
    for pattern, mark in _PLAIN:
        plain = pattern.sub(mark, plain)
    for statement, given in zip(plain.split(";"), data.split(";"), strict=True):
        _require_statement(statement, given, where)


def _require_statement(plain: str, given: str, where: str) -> None:
    strange = _STRANGE.search(plain)
    closed = plain.count("(") == plain.count(")")
    whole = not plain.strip() or re.match(r"\s*@\s*=\s*[@(]", plain)
    if strange or not closed or not whole:
        shown = " ".join(given.split())
        shown = shown if len(shown) < 80 else f"{shown[:77]}..."
        raise BadInputError(f"this is no statement: {shown!r}", where, _AGAIN)


def step_unit(text: str) -> str | None:
    """Give the unit of length of a STEP file; None if it is none that is known.

    Examples
    --------
    >>> from assoc_hull.io.cad.step_text import step_unit
    >>> step_unit("#7=(CONVERSION_BASED_UNIT('INCH',#8)LENGTH_UNIT()NAMED_UNIT(#9));")
    'in'
    """
    for entity in re.finditer(r"=\s*\(([^;]*)\)\s*;", text):
        body = entity[1]
        if not re.search(r"\bLENGTH_UNIT\s*\(", body):
            continue
        base = re.search(r"CONVERSION_BASED_UNIT\s*\(\s*'([^']*)'", body)
        if base:
            return _CONVERTED.get(base[1].strip().upper())
        metric = re.search(r"SI_UNIT\s*\(\s*([$.A-Z]*)\s*,\s*\.METRE\.", body)
        if metric:
            return _PREFIX.get(metric[1].strip())
    return None

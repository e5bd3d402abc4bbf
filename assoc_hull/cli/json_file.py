"""Reading of JSON that a command is given."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NoReturn

from assoc_hull.arguments import once
from assoc_hull.errors import BadInputError

__all__ = ["read_json"]


def read_json(path: Path, what: str) -> Any:
    """Read a file of JSON: no name twice in one object, no number that is not finite.

    Parameters
    ----------
    path : Path
        The file.
    what : str
        What it is to hold, for the message: ``"curve"``.

    Raises
    ------
    BadInputError
        With file, place and remedy.
    """
    try:
        text = path.read_bytes().decode("utf-8-sig")
        return json.loads(text, object_pairs_hook=once, parse_constant=_not_finite)
    except OSError as error:
        reason = f"the file cannot be read ({error.strerror})"
        raise BadInputError(reason, f"at {path}", "check name and permissions") from error
    except json.JSONDecodeError as error:
        where = f"in {path}, line {error.lineno}, column {error.colno}"
        raise BadInputError(f"this is no JSON ({error.msg})", where, "mend it") from error
    except (ValueError, RecursionError) as error:
        raise BadInputError(f"this is no {what} ({error})", f"in {path}", "mend it") from error


def _not_finite(text: str) -> NoReturn:
    raise ValueError(f"{text} is no finite number")

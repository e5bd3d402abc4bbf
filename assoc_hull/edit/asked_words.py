"""What an edit was asked for, in the words in which causes name it.

Examples
--------
>>> from assoc_hull.edit.asked_words import asked_words
>>> asked_words({"op": "pull", "point": "WL 1 x ST 4", "d": 0.02})
'the pull at WL 1 x ST 4'
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from assoc_hull.edit.recording import Said

__all__ = ["asked_words", "field_words", "joined_words"]

_WORDS = {
    "move": "the move of {point}",
    "insert": "the point put into {curve}",
    "delete": "the deletion of {point}",
    "pull": "the pull at {point}",
    "reshape": "the re-shaping of {curve}",
    "lead": "the lead of {line}",
    "fair": "the fairing of {lines}",
    "straighten": "the straightening of {line}",
    "round": "the rounding of {line}",
    "transform": "the transformation",
    "tunnel": "the tunnel {name}",
    "set_tunnel": "the new axis or radius of {name}",
    "remove_tunnel": "the removal of {name}",
    "body": "the body {name}",
    "set_body": "the new place or shape of {name}",
    "remove_body": "the removal of {name}",
    "set_form": "the new values of {definition}",
}
"""By modification, with names of its arguments."""

_FIELDS = frozenset({"pull", "reshape", "lead", "fair", "transform"})
"""Of these an edit sets points that nobody named."""

_MOST = 3
"""So many are named where several are."""


def asked_words(change: Mapping[str, Said]) -> str:
    """Say a modification in words; of one without words of its own, its name and first argument."""
    op = str(change.get("op", ""))
    if op in _WORDS:
        named = {name: _named(value) for name, value in change.items()}
        if change.get("lines") is None:
            named["lines"] = "the hull"
        return _WORDS[op].format_map(named)
    first = next((value for name, value in change.items() if name != "op"), None)
    title = op.replace("_", " ")
    return f"{title} of {_named(first)}" if isinstance(first, str | list) else title


def field_words(script: Iterable[Mapping[str, Said]], *, leads: bool) -> tuple[str, ...]:
    """Say those modifications of a script that set points which nobody named, each once.

    `leads`: whether lines led; else what may lead, and says so, was pinned.
    """
    chosen = (each for each in script if each.get("op") in _FIELDS or (leads and each.get("lead")))
    return tuple(dict.fromkeys(map(asked_words, chosen)))


def joined_words(words: Sequence[str]) -> str:
    """Name several things, the first of them where they are many."""
    if len(words) > _MOST:
        return f"{', '.join(words[:_MOST])} and {len(words) - _MOST} more"
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def _named(value: Said) -> str:
    """Name an argument; of a list its first items."""
    if isinstance(value, list):
        return joined_words([_named(each) for each in value])
    return str(value)

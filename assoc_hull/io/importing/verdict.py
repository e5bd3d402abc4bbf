"""The verdict on an import: sound, sound with suspicions, or not sound, with every finding.

A finding that makes the hull not sound is a refusal, unless the caller accepts it. Suspicions are
told and kept; `strict` refuses them too.

Examples
--------
>>> from assoc_hull.io.importing.verdict import Verdict
>>> from assoc_hull.io.reports import Note
>>> print(Verdict((), (Note("draught", "the table", "2 % off the waterline found"),)))
sound with suspicions (1)
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import attrs

from assoc_hull.display import ShownAsText, counted
from assoc_hull.errors import NotSoundError
from assoc_hull.io.reports import Note

__all__ = [
    "Findings",
    "Verdict",
    "grouped",
    "refused_findings",
    "require_sound",
    "told_verdict",
]


@attrs.frozen(repr=False)
class Verdict(ShownAsText):
    """What an import is worth.

    Attributes
    ----------
    faults : tuple of Note
        What makes the hull not sound.
    suspicions : tuple of Note
        What looks wrong and need not be.
    """

    faults: tuple[Note, ...] = ()
    suspicions: tuple[Note, ...] = ()

    @property
    def word(self) -> str:
        """One of "sound", "sound with suspicions", "not sound"."""
        if self.faults:
            return "not sound"
        return "sound with suspicions" if self.suspicions else "sound"

    def __str__(self) -> str:
        if not self.faults:
            return f"{self.word} ({len(self.suspicions)})" if self.suspicions else self.word
        counts = [counted(len(self.faults), "fault")]
        counts += [counted(len(self.suspicions), "suspicion")] if self.suspicions else []
        return f"{self.word} ({', '.join(counts)})"


@attrs.define
class Findings:
    """Collects what several looks at one hull find; `verdict` gives it frozen."""

    faults: list[Note] = attrs.field(factory=list)
    suspicions: list[Note] = attrs.field(factory=list)

    def fault(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note what makes the hull not sound."""
        self.faults.append(Note(kind, where, what, amount))

    def suspect(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note what looks wrong and need not be."""
        self.suspicions.append(Note(kind, where, what, amount))

    def verdict(self) -> Verdict:
        """Give the verdict; what looks found in the same words counts once, with all its places."""
        return Verdict(grouped(self.faults), grouped(self.suspicions))


_ALIKE = 3
"""So many findings that differ in places and numbers alone are one."""

_NAMED = 24
"""So many of their places are named."""

_FIGURE = re.compile(r"[-+]?[0-9][-+0-9.,]*(?:e[-+]?[0-9]+)?")
_NAME = re.compile(r"(?:[A-Za-z]+ )?[-+]?[0-9][-+0-9.]*|[^ ]+")


def grouped(findings: Sequence[Note]) -> tuple[Note, ...]:
    """Put findings together that say one thing of many lines: the worst, and where else it holds.

    Examples
    --------
    >>> found = [Note("fold", f"ST {x}", f"by {x} mm", float(x)) for x in (1, 3, 2)]
    >>> [str(each) for each in grouped(found)]
    ['fold: ST 3; likewise ST 1, ST 2: by 3 mm']
    """
    alike: dict[tuple[str, str], list[Note]] = {}
    for each in dict.fromkeys(findings):
        said = (each.kind, _FIGURE.sub("#", each.what))
        alike.setdefault(said, []).append(each)
    found = []
    for group in alike.values():
        found += group if len(group) < _ALIKE else [_as_one(group)]
    return tuple(found)


def _as_one(group: list[Note]) -> Note:
    """Give the worst of findings that are alike, with the places of the others."""
    worst = max(group, key=lambda each: abs(each.amount or 0.0))
    places = [each.where.partition(" at (")[0] for each in group]
    if len(set(places)) == 1:  # the line stands in the sentence
        places = [found[0] if (found := _NAME.match(each.what)) else each.what for each in group]
    rest = [place for place, each in zip(places, group, strict=True) if each is not worst]
    own = places[[each is worst for each in group].index(True)]
    names = [name for name in dict.fromkeys(rest) if name != own]
    shown = ", ".join(names[:_NAMED])
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    others = f"; likewise {shown}{more}" if names else ""
    return attrs.evolve(worst, where=f"{worst.where}{others}")


def refused_findings(verdict: Verdict, *, accept: bool, strict: bool) -> tuple[Note, ...]:
    """Give what a hull is refused for; nothing where it is taken."""
    if accept:
        return ()
    return verdict.faults or (verdict.suspicions if strict else ())


def told_verdict(verdict: Verdict) -> tuple[str, ...]:
    """Give what was found and the verdict, as lines of text."""
    faults = (f"fault: {each}" for each in verdict.faults)
    suspected = (f"suspicion: {each}" for each in verdict.suspicions)
    return (*faults, *suspected, f"verdict: {verdict}")


def require_sound(verdict: Verdict, source: str, *, accept: bool, strict: bool) -> None:
    """Refuse a hull that is not sound, or, if `strict`, one under suspicion.

    Raises
    ------
    NotSoundError
        There are faults and they are not accepted; or suspicions, and `strict`.
    """
    refused = refused_findings(verdict, accept=accept, strict=strict)
    if refused:
        besides = tuple(map(str, verdict.suspicions)) if verdict.faults else ()
        raise NotSoundError(source, tuple(map(str, refused)), not verdict.faults, besides)

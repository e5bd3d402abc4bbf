"""The verdict on an import: sound, sound with suspicions, or not sound, with every finding.

A finding that makes the hull not sound is a refusal, unless the caller accepts it. Suspicions are
told and kept; `strict` refuses them too.

Examples
--------
>>> from assoc_hull.io.importing.verdict import Finding, Verdict
>>> print(Verdict((), (Finding("draught", "the table", "2 % off the waterline found"),)))
sound with suspicions (1)
"""

from __future__ import annotations

import attrs

from assoc_hull.errors import NotSoundError

__all__ = ["Finding", "Verdict", "require_sound"]


@attrs.frozen
class Finding:
    """One thing that is wrong or looks wrong.

    Attributes
    ----------
    kind : str
        A short word to filter by, such as "outlier", "gap" or "coefficient".
    where : str
        The line, station, row, column or unit.
    what : str
        A sentence with the numbers, and what to do where something can be done.
    amount : float or None
        The number that matters; m where it is a length.
    """

    kind: str
    where: str
    what: str
    amount: float | None = None

    def __str__(self) -> str:
        return f"{self.kind}: {self.where}: {self.what}"


@attrs.frozen
class Verdict:
    """What an import is worth.

    Attributes
    ----------
    faults : tuple of Finding
        What makes the hull not sound.
    suspicions : tuple of Finding
        What looks wrong and need not be.
    """

    faults: tuple[Finding, ...] = ()
    suspicions: tuple[Finding, ...] = ()

    @property
    def word(self) -> str:
        """One of "sound", "sound with suspicions", "not sound"."""
        if self.faults:
            return "not sound"
        return "sound with suspicions" if self.suspicions else "sound"

    def __str__(self) -> str:
        counts = [f"{len(self.faults)} faults"] if self.faults else []
        counts += [f"{len(self.suspicions)}"] if self.suspicions and not self.faults else []
        counts += [f"{len(self.suspicions)} suspicions"] if self.suspicions and self.faults else []
        return f"{self.word} ({', '.join(counts)})" if counts else self.word


def require_sound(verdict: Verdict, source: str, *, accept: bool, strict: bool) -> None:
    """Refuse a hull that is not sound, or, if `strict`, one under suspicion.

    Raises
    ------
    NotSoundError
        There are faults and they are not accepted; or suspicions, and `strict`.
    """
    refused = verdict.faults + (verdict.suspicions if strict else ())
    if refused and not accept:
        raise NotSoundError(source, tuple(map(str, refused)))

"""Records of fairness of many curves, and of a hull before and after an edit."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import attrs

from assoc_hull.errors import UnknownNameError
from assoc_hull.geometry.fairness.criteria import FairnessRecord

__all__ = ["FairnessPair", "FairnessTable"]

_LOOK = ("bending", "variation", "support_jumps", "extrema")
_HEADS = {
    "bending": "E2", "variation": "E3", "support_jumps": "J3 1/m2", "extrema": "extremes",
    "inflections": "inflections",
}  # fmt: skip


@attrs.frozen(eq=False)
class FairnessPair:
    """A curve before and after an edit."""

    before: FairnessRecord
    after: FairnessRecord

    def ratio(self, number: str) -> float | None:
        """Give after over before of a number of the record; None where it has none or was nil."""
        before, after = getattr(self.before, number), getattr(self.after, number)
        return None if not before or after is None else float(after / before)

    @property
    def changed(self) -> bool:
        """Whether any number differs."""
        return self.before != self.after


@attrs.frozen(eq=False)
class FairnessTable:
    """Records of curves of a net, line by line.

    Attributes
    ----------
    records : tuple of FairnessRecord
        One per curve.
    keys : tuple of str
        The curves, as the hull names them.
    lines : tuple of str
        The line that each belongs to.
    """

    records: tuple[FairnessRecord, ...]
    keys: tuple[str, ...]
    lines: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.records)

    def __iter__(self) -> Iterator[FairnessRecord]:
        return iter(self.records)

    def __getitem__(self, line: str) -> tuple[FairnessRecord, ...]:
        """Give the records of the curves of a line, by its name."""
        found = tuple(
            each for each, name in zip(self.records, self.lines, strict=True) if name == line
        )
        if not found:
            raise UnknownNameError("line", str(line), tuple(dict.fromkeys(self.lines)))
        return found

    @property
    def failures(self) -> dict[str, tuple[str, ...]]:
        """By criterion that has a limit, the curves that do not keep it."""
        kinds = ("first derivative", "second derivative", "inflections", "deviation")
        return {
            kind: tuple(each.name for each in self.records if each.passed[kind] is False)
            for kind in kinds
        }

    def pairs(self, after: FairnessTable) -> tuple[FairnessPair, ...]:
        """Give the curves that this and another table have, this one before."""
        other = dict(zip(after.keys, after.records, strict=True))
        return tuple(
            FairnessPair(record, other[key])
            for key, record in zip(self.keys, self.records, strict=True)
            if key in other
        )

    def data(self) -> dict[str, Any]:
        """Give all as plain values."""
        rows = zip(self.keys, self.lines, self.records, strict=True)
        return {
            "curves": [{"key": key, "line": line, **_row(each)} for key, line, each in rows],
            "failures": {kind: list(names) for kind, names in self.failures.items()},
        }

    def compared(self, after: FairnessTable) -> dict[str, Any]:
        """Give what both have side by side as plain values."""
        return {
            "curves": [
                {"before": _row(pair.before), "after": _row(pair.after),
                 "ratios": {name: pair.ratio(name) for name in _LOOK}}
                for pair in self.pairs(after)
            ],
            "failures_before": {k: list(v) for k, v in self.failures.items()},
            "failures_after": {k: list(v) for k, v in after.failures.items()},
        }  # fmt: skip

    def __str__(self) -> str:
        lines = [_HEAD, *(_text(each) for each in self.records), ""]
        return "\n".join([*lines, *self._words()])

    def _words(self) -> Iterator[str]:
        """Say how many curves keep each limit."""
        for kind, names in self.failures.items():
            told = sum(each.passed[kind] is not None for each in self.records)
            least = f", not by {len(names)}" if names else ""
            yield f"{kind}: limit kept by {told - len(names)} of {told} curves{least}"

    def comparison(self, after: FairnessTable) -> str:
        """Write what both have side by side: the look of lines has no limit but this.

        Curves whose numbers are the same are counted only.
        """
        pairs = self.pairs(after)
        rows = [pair for pair in pairs if pair.changed]
        wide = {name: 24 for name in _HEADS}
        lines = [f"{'curve':16}" + "".join(f"{_HEADS[name]:>{wide[name]}}" for name in _HEADS)]
        for pair in rows:
            cells = (
                f"{_figure(getattr(pair.before, name))} > {_figure(getattr(pair.after, name))}"
                for name in _HEADS
            )
            lines.append(f"{pair.before.name:16}" + "".join(f"{each:>24}" for each in cells))
        lines.append(f"{len(pairs) - len(rows)} of {len(pairs)} curves are the same")
        alone = len(self) + len(after) - 2 * len(pairs)
        if alone:
            lines.append(f"{alone} curves are in one hull only")
        return "\n".join(lines)


_HEAD = (
    f"{'curve':16}{'L m':>9}{'J1 rad':>10}{'J2':>10}{'inflections':>13}{'D max':>8}{'D rms':>8}"
    f"{'E2':>10}{'E3':>12}{'J3 1/m2':>11}{'extremes':>10}"
    f"{'knuckles':>10}  not kept"
)


def _text(each: FairnessRecord) -> str:
    bends = _figure(each.inflections)
    if each.inflections_allowed:
        bends += f" ({each.inflections_allowed})"
    return (
        f"{each.name:16}{each.length:9.3f}{_jump(each.angle_jump):>10}{_jump(each.curvature_jump):>10}"
        f"{bends:>13}{_short(each.deviation_max):>8}{_short(each.deviation_rms):>8}"
        f"{each.bending:10.4g}{each.variation:12.5g}{_figure(each.support_jumps):>11}"
        f"{each.extrema:10d}{each.knuckles:10d}  {', '.join(each.failed)}"
    ).rstrip()


def _jump(value: float) -> str:
    """Write a jump; what is rounding is nil."""
    return f"{value:.2g}" if value > 1e-11 else "0"


def _short(value: float | None) -> str:
    return "-" if value is None else f"{value:.3f}"


def _figure(value: float | None) -> str:
    return "-" if value is None else f"{value:.4g}"


def _row(each: FairnessRecord) -> dict[str, Any]:
    """Give a record as plain values, with what it kept."""
    told = attrs.asdict(each, filter=lambda field, _: field.name != "limits")
    return told | {"unwanted_inflections": each.unwanted_inflections, "passed": each.passed}

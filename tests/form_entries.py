"""Entries of form parameters that no catalogue has: one without a value, one with a warning."""

from __future__ import annotations

from assoc_hull.analysis.form.parameter import (
    Absent,
    FormParameter,
    MeasuredValue,
    Warned,
    parameter,
)

__all__ = ["bare", "doubted", "many", "passed_on"]


@parameter(
    "bare", name="what no hull has", unit="m", table="hull form", definition="none", source="-",
    needs=("Lpp",),
)  # fmt: skip
def bare(length: float) -> MeasuredValue:
    """Give none."""
    return Absent("no such thing")


@parameter(
    "passed on", name="half of what no hull has", unit="m", table="hull form",
    definition="bare / 2", source="-", needs=("bare",),
)  # fmt: skip
def passed_on(half: float) -> MeasuredValue:
    """Give what comes of another."""
    return 0.5 * half


@parameter(
    "doubted", name="=a number with a warning, and | a name that is longer than a narrow column",
    unit="m2", table="bulb and resistance", definition="=Lpp / 40", source="-", needs=("Lpp",),
    digits=2,
)  # fmt: skip
def doubted(length: float) -> MeasuredValue:
    """Give a number to be read with care."""
    return Warned(length / 40.0, "to be read with care")


def many(count: int) -> list[FormParameter]:
    """Give so many entries, every fifth without a value for a reason of its own."""

    def entry(k: int) -> FormParameter:
        def compute(length: float) -> MeasuredValue:
            return Absent(f"reason {k}, which is told at some length") if k % 5 == 0 else k * length

        made = parameter(f"E{k}", name=f"entry {k}", unit="m", table="hull form",
                         definition="k Lpp", source="-", needs=("Lpp",))  # fmt: skip
        return made(compute)

    return [entry(k) for k in range(count)]

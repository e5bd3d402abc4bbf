"""Derivatives by every named parameter of four ships, against differences; and what they cost.

``python -m benchmarks.sensitivities`` prints for each parameter by how much exact derivatives
differ from central differences of hulls whose points have moved, as a part of the change of an
output with a usual change of the parameter or of a hundredth of its value, whichever is more. Then
the seconds of values and derivatives. The Duisburg Test Case is there where the data folder is.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.analysis.derivatives.curve_tangents import curve_tangents
from assoc_hull.analysis.derivatives.parameters import Moves
from assoc_hull.analysis.derivatives.reused_layout import (
    flotation_at_points,
    flotation_with_layout_of,
)
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.model.tables import copy_state
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.sensitivities import HullMoves
from benchmarks.ships import duisburg_test_case

__all__ = ["Agreement", "agreements"]

OUTPUTS = (
    "volume", "lcb", "kb", "kmt", "bmt", "cb", "cm", "cw", "a_midship", "waterplane_area", "lcf",
    "i_l", "wetted_surface", "V_a", "V_f", "LCBa", "LCBf", "Cwa", "Cwf",
)  # fmt: skip

_STEPS = (3e-6, 7e-7, 1.4e-7)
"""Of Lpp, by which the farthest point goes; the best counts, as small ones are of roundings."""


@attrs.frozen
class Agreement:
    """How far derivatives by one parameter are from differences: at worst, and of which output."""

    parameter: str
    worst: float
    output: str
    median: float


def agreements(hull: Hull) -> Iterator[Agreement]:
    """Compare for all named parameters of a hull."""
    state, body = hull.state, flotation(hull.state)
    outputs = Outputs.of(state, OUTPUTS)
    taken, _ = HullMoves(state, Layout()).every()
    found = outputs.differentiated(state, [each.parameter for each in taken])
    for k, each in enumerate(taken):
        assert isinstance(each.parameter, Moves)
        exact = found.jacobian[:, k]
        value = np.maximum(np.abs(found.values), 1e-3)
        size = np.maximum(np.abs(exact) * each.usual, 0.01 * value)
        off = np.abs(_differences(outputs, body, each.parameter) - exact).min(axis=0)
        part = off * each.usual / size
        yield Agreement(
            each.name, float(part.max()), OUTPUTS[int(part.argmax())], float(np.median(part))
        )


def _differences(outputs: Outputs, body: Flotation, way: Moves) -> FloatArray:
    """Give central differences, extrapolated, for each step: (s, m)."""
    ship = body.state.particulars
    gone, _ = curve_tangents(body, [way])

    def at(amount: float) -> FloatArray:
        rates = attrs.asdict(way.rates)
        sizes = {name: getattr(ship, name) + amount * rate for name, rate in rates.items()}
        hull = flotation_at_points(body, *gone.stepped(0, amount))
        return outputs.values_of(hull, attrs.evolve(ship, **sizes))

    found = []
    for part in _STEPS:
        step = part * ship.length / float(np.abs(gone.points).max())
        one, two = (at(i * step) - at(-i * step) for i in (1, 2))
        found.append((8.0 * one - two) / (12.0 * step))
    return np.stack(found)


def _seconds(work: Callable[[], object]) -> float:
    begin = time.process_time()
    work()
    return time.process_time() - begin


def _nudged(hull: Hull, amount: float) -> Hull:
    """Give a copy one point of which has moved."""
    found = Hull(copy_state(hull.state))
    address = next(
        name for name, each in hull.points.items() if each.free == ("y",) and each.driver is None
    )
    with found.edit("a move") as edit:
        edit.move(address, y=found.points[address].y + amount)
    return found


def _costs(hull: Hull) -> Iterator[tuple[str, float]]:
    """Seconds of a processor for five fields of hydrostatics, after all has run once."""
    outputs = Outputs.of(hull.state, ["volume", "lcb", "kmt", "cw", "a_midship"])
    taken, _ = HullMoves(hull.state, Layout()).every()
    wrt = [each.parameter for each in taken]
    trials = iter([_nudged(hull, amount).state for amount in (1e-3, 2e-3, 3e-3, 4e-3)])
    outputs.values(next(trials), like=hull.state)
    state = next(trials)
    yield "surface laid out", _seconds(lambda: flotation(state))
    state = next(trials)
    yield "surface by the old layout", _seconds(lambda: flotation_with_layout_of(hull.state, state))
    yield "values by the old layout", _seconds(lambda: outputs.values(state, like=hull.state))
    for count in (1, 5, 7):
        some = wrt[-count:]
        yield (
            f"values and derivatives by {count}",
            _seconds(lambda some=some: outputs.derivatives(state, some, like=hull.state)),  # type: ignore[misc]
        )


def main() -> None:
    """Print all of it."""
    ships = [ah.examples.wigley(), ah.examples.series60(0.70), ah.examples.bulk_carrier_207k()]
    more = duisburg_test_case()
    for hull in [*ships, *([more] if more is not None else [])]:
        print(hull.particulars.name)
        for each in agreements(hull):
            print(
                f"  {each.parameter:22s} {each.worst:8.1e} {each.output:16s} "
                f"median {each.median:8.1e}"
            )
    print("seconds on the bulk carrier")
    for what, seconds in _costs(ships[2]):
        print(f"  {what:32s} {seconds:.3f}")


if __name__ == "__main__":
    main()

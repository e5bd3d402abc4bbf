"""Fairing: what is left of noise that was put into nets whose truth is known, and what it takes.

The noise is uniform along the freedom of the points, from a fixed series of numbers by their keys;
errors are normal to the hull, against the clean net. Times are of the processor.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import assoc_hull as ah
from assoc_hull.analysis.fairness.fair_solution import (
    elimination_order,
    estimate_noise,
    first_factors,
    solve_battens,
)
from assoc_hull.analysis.hydrostatics.flotation import even_keel_displacement
from assoc_hull.edit.net_battens import net_battens
from benchmarks.clock import Figure, side_by_side
from benchmarks.ships import duisburg_test_case
from tests.noisy_nets import NoisyNet, rms, uniform_noise

__all__ = ["figures"]

_LEFT = {
    ("wigley", 0.5): 0.59, ("wigley", 1.6): 0.54, ("wigley", 5): 0.48, ("wigley", 10): 0.47,
    ("series 60", 0.5): 0.96, ("series 60", 1.6): 0.83, ("series 60", 5): 0.73,
    ("series 60", 10): 0.66, ("carrier", 0.5): 0.96, ("carrier", 1.6): 0.84,
    ("carrier", 5): 0.72, ("carrier", 10): 0.65,
}  # fmt: skip
"""By ship and half width of the noise, mm: the part of the error that a trial had left."""


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    ships = {
        "wigley": ah.examples.wigley(), "series 60": ah.examples.series60(cb=0.7),
        "carrier": ah.examples.bulk_carrier_207k(),
    }  # fmt: skip
    found = list[Figure]()
    for name, hull in ships.items():
        widths = [width for ship, width in _LEFT if ship == name]
        for width in widths[-1:] if quick else widths:
            found += _taken_out(name, hull, float(width))
        found += _of_clean(name, hull)
    if (dtc := duisburg_test_case()) is not None:
        found += _of_clean("DTC", dtc)
        found += _faired("DTC", dtc, 2e-3)
    found += _faired("carrier", ships["carrier"], 1.6e-3)
    rounds = 2 if quick else 7
    found += _times("carrier", ships["carrier"], rounds, {"stated": 15, "auto": 60})
    large = ah.examples.wigley(stations=118, waterlines=53)
    found += _times("a net of 170 curves", large, rounds, {})
    return [*found, *_window(ships["carrier"])]


def _taken_out(name: str, hull: ah.Hull, width: float) -> Iterator[Figure]:
    """Tell what is left of noise of a half width, mm."""
    title, size = f"fairing: {name}, {width:g} mm", 1e-3 * width
    net = NoisyNet.of(hull, size)
    limit = size * net.clean.freedom
    for how, noise in (("stated", size / np.sqrt(3.0)), ("auto", estimate_noise(net.problem))):
        solution = solve_battens(net.problem, noise, limit=limit)
        left = net.left(solution.displacement)
        more = 0.03 if how == "stated" else 0.04
        goal = _LEFT[name, width] + more if how == "stated" or width >= 1.6 else None
        yield Figure(
            f"{title}: error left, noise {how} ({1e3 * noise:.2f} mm)", left, "x", goal, "most"
        )
        if how == "stated":
            if name != "wigley":
                yield Figure(
                    f"{title}: of computed points", net.computed_left(solution.displacement)
                )
            for lobe in (0.2, 1.0):
                noisy, fair, lost = net.excess(solution.displacement, lobe)
                part = 0.25 if lobe < 1.0 else 0.1
                yield Figure(
                    f"{title}: sign changes above {lobe:g} deg too many, of {noisy}; {lost} lost",
                    fair, "", part * noisy if noisy >= 20 else None, "most",
                )  # fmt: skip


def _of_clean(name: str, hull: ah.Hull) -> Iterator[Figure]:
    """How far a clean net moves by itself."""
    problem = net_battens(hull.state)
    noise = estimate_noise(problem)
    moved = 1e3 * solve_battens(problem, noise).displacement
    title = f"fairing: {name} as it is, {len(problem.rows)} points, auto {1e3 * noise:.3f} mm"
    yield Figure(f"{title}: moved rms", rms(moved), "mm")
    yield Figure(f"{title}: moved most", float(np.abs(moved).max()), "mm")


def _faired(name: str, hull: ah.Hull, noise: float) -> Iterator[Figure]:
    """Tell of the published net: features, inflections, gap, volume."""
    before, features = even_keel_displacement(hull.state), [*hull.features]
    report = hull.fair(noise=noise)
    title = f"fairing: {name} by {1e3 * noise:g} mm, published"
    kept = sum(each in hull.features for each in features)
    yield Figure(f"{title}: features kept", kept, "", len(features), "equal")
    bends = np.array([each.inflections for each in report.lines]).sum(axis=0)
    yield Figure(f"{title}: inflections, of {bends[0]}", bends[1], "")
    yield Figure(f"{title}: largest gap", 1e3 * report.largest_gap, "mm")
    after = even_keel_displacement(hull.state)
    yield Figure(f"{title}: volume", after.volume / before.volume - 1.0, "of it")
    hull.undo()
    report = hull.fair(noise=noise, hold=["volume", "lcb"])
    after = even_keel_displacement(hull.state)
    off = abs(after.volume / before.volume - 1.0)
    yield Figure(f"{title}: volume, held", off, "of it", 1e-8, "most")
    yield Figure(f"{title}: LCB, held", abs(after.lcb - before.lcb), "m", 1e-6, "most")
    hull.undo()


def _times(name: str, hull: ah.Hull, rounds: int, goals: dict[str, int]) -> Iterator[Figure]:
    """Time a net: the whole act, beside one factorisation of its matrix."""
    problem, noise = net_battens(hull.state), 1.6e-3 / np.sqrt(3.0)
    error = uniform_noise(len(problem.rows), 1.6e-3) * problem.freedom
    noisy = problem.shifted(error)
    order, limit = elimination_order(noisy), 1.6e-3 * problem.freedom

    def whole(said: float | None) -> None:
        hull.state.memory.restore({})  # what it is made of is found anew, as for a new hull
        hull.fair(noise="auto" if said is None else said, tolerance=1.6e-3)
        hull.undo()

    jobs = {
        "factor": lambda: first_factors(noisy, noise),
        "solve": lambda: solve_battens(noisy, noise, limit=limit, order=order),
        "stated": lambda: whole(noise),
        "auto": lambda: whole(None),
    }
    times = side_by_side(jobs, rounds, {"factor": 5})
    title = f"fairing: {name}, "
    yield Figure(f"{title}one sparse factorisation", 1e3 * times["factor"], "ms")
    yield Figure(f"{title}the solution within bounds", 1e3 * times["solve"], "ms")
    for way in ("stated", "auto"):
        yield Figure(f"{title}the edit and its undo, noise {way}", 1e3 * times[way], "ms")
        ratio = times[way] / times["factor"]
        yield Figure(f"{title}noise {way} / factorisation", ratio, "x", goals.get(way), "most")


def _window(hull: ah.Hull) -> Iterator[Figure]:
    """Time a step of a window that a hand holds."""
    window = hull.fair_window(at="WL 9 x ST 17", radius=(20.0, 6.0))
    steps = iter(range(10**6))
    times = side_by_side({"step": lambda: window.to(noise=1e-3 + 1e-9 * next(steps))}, 50)
    count = len(window.to().rows)
    yield Figure(
        f"fairing: a step of a window of {count} points", 1e3 * times["step"], "ms", 2, "most"
    )

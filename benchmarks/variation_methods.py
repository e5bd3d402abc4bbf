"""Methods of variation on the same tasks: the lines they give, and what they cost.

``python -m benchmarks.variation_methods`` prints what the methods do to the sections of the 207k
carrier, and of DTC where the folder of published hulls is given; ``python -m benchmarks
variation_methods`` the times. Sections are lofted through the images of their points.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from functools import partial
from time import perf_counter

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import CurveData, EndKind, FloatArray, IntArray, PointKind
from assoc_hull.geometry.fairness.combs import DEAD_BAND, comb_integrals, curvature_sign_changes
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState
from assoc_hull.variation.carrying.carry_hull import apply_map
from assoc_hull.variation.certificate.fold_check import certify
from assoc_hull.variation.fields.batch_displacements import FieldPlan
from assoc_hull.variation.fields.layers import Layer
from assoc_hull.variation.fields.space_map import VariationMap
from benchmarks.clock import Figure
from benchmarks.ffd import SIDE, LatticePlan
from benchmarks.ships import duisburg_test_case
from benchmarks.variation_tasks import METHODS, Task, active_points, lattice, tasks

__all__ = [
    "Fared",
    "cloud",
    "fared",
    "figures",
    "lines",
    "main",
    "mapped",
    "sections",
    "ships",
    "title",
]

VARIANTS = 1000
_FIELD = "rounded hat, quintic"
CHORDS = 8
"""Places on each segment of each line, for what is measured on the surface and for the times."""


@attrs.frozen
class Fared:
    """What a method did on a task.

    Attributes
    ----------
    median, worst : float
        Of the ratios of comb integrals, section by section.
    before, after : int
        Changes of sign of the curvature of these sections.
    least : float
        Least dz'/dz over the region.
    spill : float
        Area times displacement beyond three radii of the place's height, of all.
    most : float, m
        Largest displacement on the hull.
    """

    median: float
    worst: float
    before: int
    after: int
    least: float
    spill: float
    most: float


def sections(state: HullState) -> IntArray:
    """Give the curves of the sections."""
    return np.array(
        [
            curve
            for curve in state.live("curves").tolist()
            if state.family(state.line_of(curve)).name == "sections"
        ]
    )


def mapped(data: CurveData, vmap: VariationMap) -> CurveData:
    """Give curves through the images of points; given directions go along."""
    turn = vmap.jacobian(data.xyz)
    tangent = (data.kind == PointKind.TANGENT)[:, None]
    direction = np.where(tangent, np.einsum("nij,nj->ni", turn, data.direction), data.direction)
    ends = np.stack([data.start[:-1], data.start[1:] - 1], axis=1)
    moved = np.einsum("mkij,mkj->mki", turn[ends], data.end_vector)
    along = (data.end_kind == EndKind.TANGENT)[..., None]
    vector = np.where(along, moved, data.end_vector)
    return attrs.evolve(data, xyz=vmap(data.xyz), direction=direction, end_vector=vector)


def fared(state: HullState, task: Task, layer: Layer) -> Fared:
    """Measure what a method did."""
    curves = sections(state)
    data, vmap = curve_data(state, curves), VariationMap((layer,))
    image = mapped(data, vmap)
    old, new = loft(data), loft(image)
    touched = np.logical_or.reduceat((image.xyz != data.xyz).any(axis=1), data.start[:-1])
    normal = np.array([1.0, 0.0, 0.0])
    combs = comb_integrals(old, normal)[touched], comb_integrals(new, normal)[touched]
    ratio = combs[1] / combs[0]
    signs = [int(curvature_sign_changes(each, normal, DEAD_BAND)[touched].sum())
             for each in (old, new)]  # fmt: skip
    spill, most = _spilled(state, curves, task, layer)
    return Fared(
        float(np.median(ratio)), float(ratio.max()), signs[0], signs[1],
        _least_slope(task, layer), spill, most,
    )  # fmt: skip


def _least_slope(task: Task, layer: Layer) -> float:
    """Give the least dz'/dz on a grid of the profile plane."""
    x = np.linspace(*task.reach, 201)
    z = np.linspace(task.low - 5.0, task.high + 5.0, 801)
    grid = np.stack(np.meshgrid(x, [0.0], z, indexing="ij"), axis=-1).reshape(-1, 3)
    return float(layer.jacobian(grid)[:, 2, 2].min())


def _spilled(state: HullState, curves: IntArray, task: Task, layer: Layer) -> tuple[float, float]:
    """Integrate the displacement over the hull, girth by girth, far from the place and in all."""
    total, far, most = 0.0, 0.0, 0.0
    for curve, width in zip(curves.tolist(), _widths(state, curves).tolist(), strict=True):
        points = sample(state.spline(curve), CHORDS)[1]
        moved = np.abs(layer.displacement(points)[:, 2])
        piece = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1)) * width
        part = 0.5 * (moved[1:] + moved[:-1]) * piece
        middle = 0.5 * (points[1:, 2] + points[:-1, 2])
        total += float(part.sum())
        far += float(part[np.abs(middle - task.z) >= 3.0 * task.radius].sum())
        most = max(most, float(moved.max()))
    return far / total, most


def _widths(state: HullState, curves: IntArray) -> FloatArray:
    """Give the length of the ship that each section stands for."""
    x = state.lines.offset[state.curves.line[curves]]
    every = np.unique(x)
    edges = np.concatenate([every[:1], 0.5 * (every[1:] + every[:-1]), every[-1:]])
    found: FloatArray = np.diff(edges)[np.searchsorted(every, x)]
    return found


def ships() -> Iterator[tuple[str, ah.Hull]]:
    """Give the carrier, and DTC where its folder is named."""
    yield "carrier", ah.examples.bulk_carrier_207k()
    ship = duisburg_test_case()
    if ship is not None:
        yield "DTC", ship


def main() -> int:
    """Print what the methods do."""
    for name, hull in ships():
        for task in tasks(hull.document.state):
            print(f"{name}, {title(task)}")
            print("\n".join(lines(hull.document.state, task)), end="\n\n")
    return 0


def title(task: Task) -> str:
    """Say what is raised, where."""
    return f"{task.name} at x {task.x:.2f}, z {task.z:.2f} m"


def lines(state: HullState, task: Task) -> Iterator[str]:
    """Give what the methods do on one task, line by line."""
    yield f"{'':24} {'comb':>6} {'worst':>7} {'signs':>11} {'Z_z':>6} {'spill':>6} {'most m':>6}"
    for method, (lay, blend) in METHODS.items():
        it = fared(state, task, lay(task, blend))
        yield (
            f"{method:24} {it.median:6.3f} {it.worst:7.2f} {it.before:4d} -> {it.after:3d}"
            f" {it.least:6.3f} {it.spill:6.3f} {it.most:6.3f}"
        )


def cloud(state: HullState) -> FloatArray:
    """Give places all over a hull: on each segment of each of its lines."""
    found = [sample(state.spline(curve), CHORDS)[1] for curve in state.live("curves").tolist()]
    return np.concatenate(found)


def _fastest(
    jobs: dict[str, Callable[[], object]], rounds: int, repeats: int = 1
) -> dict[str, float]:
    """Give the least time of each job by the clock, s, the jobs taking turns."""
    best = dict.fromkeys(jobs, np.inf)
    for _ in range(rounds):
        for name, job in jobs.items():
            for _ in range(repeats):
                begin = perf_counter()
                job()
                best[name] = min(best[name], perf_counter() - begin)
    return best


def figures(quick: bool = False) -> list[Figure]:
    """Measure times on the carrier: one variant, a thousand, laying out, certifying, re-lofting."""
    hull = ah.examples.bulk_carrier_207k()
    places = cloud(hull.document.state)
    task = next(each for each in tasks(hull.document.state) if each.name.startswith("transom"))
    return [
        Figure("variation: places on the hull", float(len(places)), ""),
        *_variants(task, places, 5 if quick else 30),
        *_apart(hull, task, places, 1 if quick else 5),
    ]


def _variants(task: Task, places: FloatArray, rounds: int) -> list[Figure]:
    """Compare one variant and a thousand, weights kept."""
    layer = METHODS[_FIELD][0](task, METHODS[_FIELD][1])
    plan, frame = FieldPlan.of([layer], places), lattice(task)
    whole = LatticePlan.of(frame, places, 2)
    few = np.flatnonzero(active_points(task).ravel())
    part = LatticePlan.of(frame, places, 2, few)
    rng = np.random.default_rng(1)
    sizes, moves = rng.uniform(-1.0, 1.0, (VARIANTS, 1)), rng.uniform(-1, 1, (VARIANTS, SIDE**3))
    some = np.ascontiguousarray(moves[:, few])
    one = _fastest(
        {
            "field": lambda: plan.moved(sizes[0]),
            "FFD": lambda: whole.moved(moves[0]),
            "least": lambda: part.moved(some[0]),
        },
        rounds, 50,
    )  # fmt: skip
    out, lots, fewer = plan.batch(sizes), whole.batch(moves), part.batch(some)
    many = _fastest(
        {
            "field": lambda: plan.batch(sizes, out),
            "FFD": lambda: whole.batch(moves, lots),
            "least": lambda: part.batch(some, fewer),
        },
        rounds,
    )
    return [
        Figure("variation: places that move, field", float(len(plan.moving[0].rows)), ""),
        Figure("variation: places that move, FFD", float(len(whole.rows)), ""),
        *_ratios("one variant", one, 8.0),
        *_ratios(f"{VARIANTS} variants", many, 3.0),
    ]


def _ratios(name: str, times: dict[str, float], goal: float) -> list[Figure]:
    return [
        Figure(f"{name}: field", 1e6 * times["field"], "us"),
        Figure(
            f"{name}: FFD, 125 control points / field", times["FFD"] / times["field"], "x", goal
        ),
        Figure(
            f"{name}: FFD, only the 15 that may move / field", times["least"] / times["field"], "x"
        ),
    ]


def _apart(hull: ah.Hull, task: Task, places: FloatArray, rounds: int) -> list[Figure]:
    """Time what is no mapping: laying out, computing weights, certifying, lofting again."""
    named = {"field": _FIELD, "additive": "additive, quintic", "FFD": "FFD 5 x 5 x 5"}
    layers = {key: METHODS[name][0](task, METHODS[name][1]) for key, name in named.items()}
    box = np.stack([places.min(axis=0), places.max(axis=0)])
    frame = lattice(task)
    jobs: dict[str, Callable[[], object]] = {
        "weights": lambda: FieldPlan.of([layers["field"]], places),
        "lattice": lambda: LatticePlan.of(frame, places, 2),
        "map": lambda: VariationMap((layers["field"],))(places),
        "FFD map": lambda: VariationMap((layers["FFD"],))(places),
        "fold": lambda: certify(layers["field"], box),
        "fold, additive": lambda: certify(layers["additive"], box),
    }
    jobs |= {
        f"loft, {key}": partial(_reloft, hull, VariationMap((each,)))
        for key, each in layers.items()
    }
    times = _fastest(jobs, rounds)
    return [
        Figure("weights of the places: field", 1e3 * times["weights"], "ms"),
        Figure("weights of the places: FFD / field", times["lattice"] / times["weights"], "x"),
        Figure("the map, no weights kept: FFD / field", times["FFD map"] / times["map"], "x"),
        Figure("apart: fold check, field", 1e3 * times["fold"], "ms"),
        Figure("apart: fold check, additive", 1e3 * times["fold, additive"], "ms"),
        *(
            Figure(f"apart: net lofted and cut again, {key}", 1e3 * times[f"loft, {key}"], "ms")
            for key in layers
        ),
    ]


def _reloft(hull: ah.Hull, vmap: VariationMap) -> None:
    """Carry the net by a map, and take it back."""
    with Transaction(hull.document, "varied", look=lambda _: None) as edit:
        apply_map(edit, vmap)


if __name__ == "__main__":
    sys.exit(main())

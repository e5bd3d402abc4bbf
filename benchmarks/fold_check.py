"""The fold check against dense sampling: ``python -m benchmarks.fold_check [--fields 5000]``.

Maps of one or two layers are drawn at random, of a strength that makes their least minor large,
small, about nil or negative. Each is certified, its minors are sampled and their minima polished,
and both answers are compared. One core, some ten minutes for 5,000 fields on 400 x 400 places.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
import time
from collections import Counter
from collections.abc import Iterable, Sequence

import attrs
import numpy as np

from assoc_hull.errors import FoldError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.fold_check import MARGIN, Certificate, certify
from assoc_hull.variation.fields.layers import Layer
from assoc_hull.variation.fields.space_map import VariationMap
from benchmarks.fold_fields import draw_box, draw_layer, scaled
from benchmarks.fold_polish import Least, minors_at, polished
from benchmarks.fold_samples import Samples, sample

__all__ = ["Case", "Summary", "Verdict", "compare", "draw"]

PLACES = 400
"""Sampled along each axis of the profile plane, or of the plane that a layer is about."""

SURE = 0.06
"""What reaches so much must be accepted."""

UNDECIDED = 0.001
"""The largest part of undecided maps."""

_ROUNDING = 1e-9

_AIMS: tuple[tuple[float, float, float], ...] = (
    (0.25, 0.08, 0.95), (0.45, 0.06, 0.08), (0.5, MARGIN, 0.06), (0.7, 0.0, MARGIN),
    (0.85, -0.02, 0.0), (1.0, -1.0, -0.02),
)  # fmt: skip
"""Part of the draws up to here, and between what their least minor is to lie."""


@attrs.frozen(eq=False)
class Case:
    """A map drawn, and what sampling says of it.

    Attributes
    ----------
    vmap : VMap
    boxes : tuple of (2, 3), m
        Of the hull, and of its image that each further layer finds.
    samples : tuple of Samples
        Of each layer at strength 1.
    strengths : tuple of float
    least : tuple of Least
        Least minor of each layer.
    """

    vmap: VariationMap
    boxes: tuple[FloatArray, ...]
    samples: tuple[Samples, ...]
    strengths: tuple[float, ...]
    least: tuple[Least, ...]

    @property
    def sampled(self) -> Least:
        """The least minor of all layers."""
        return min(self.least, key=lambda each: each.value)


@attrs.frozen
class Verdict:
    """What the fold check said of a map, and what is wrong with it.

    Attributes
    ----------
    found : Certificate
    seconds : float
    troubles : tuple of str
        Empty if sampling and the certificate agree.
    """

    found: Certificate
    seconds: float
    troubles: tuple[str, ...]


def draw(seed: int, number: int, count: int = PLACES) -> Case:
    """Draw the map of a number, and sample it on `count` x `count` places."""
    rng = np.random.default_rng([seed, number])
    boxes = [draw_box(rng)]
    layers, every, strengths, least = list[Layer](), list[Samples](), list[float](), list[Least]()
    for k in range(1 if rng.random() < 0.7 else 2):
        if layers:
            boxes.append(_image(layers[-1], boxes[-1]))
        unit = draw_layer(rng, f"layer {k + 1}")
        samples = sample(unit, boxes[-1], count)
        strength = _strength(rng, samples)
        layers.append(scaled(unit, strength))
        every.append(samples)
        strengths.append(strength)
        least.append(polished(layers[-1], samples, strength))
    vmap = VariationMap(tuple(layers))
    return Case(vmap, tuple(boxes), tuple(every), tuple(strengths), tuple(least))


def _image(layer: Layer, box: FloatArray) -> FloatArray:
    """Give the box around the images of places of a box."""
    sides = [np.linspace(box[0, k], box[1, k], n) for k, n in enumerate((81, 5, 81))]
    xyz = np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1).reshape(-1, 3)
    moved = xyz + layer.displacement(xyz)
    return np.stack([moved.min(axis=0), moved.max(axis=0)])


def _strength(rng: np.random.Generator, samples: Samples) -> float:
    """Give a strength at which the least minor is about what is drawn for it."""
    part = rng.random()
    low, high = next((low, high) for upto, low, high in _AIMS if part < upto)
    aim, every = float(rng.uniform(low, high)), max(1, len(samples.sides[2]) // 100)
    weak, strong = 0.0, 1.0
    while samples.least(strong, every) > aim:
        weak, strong = strong, 2.0 * strong
        if strong > 64.0:
            return float(rng.uniform(0.5, 2.0))
    for _ in range(14):
        middle = 0.5 * (weak + strong)
        if samples.least(middle, every) > aim:
            weak = middle
        else:
            strong = middle
    return weak


def compare(case: Case) -> Verdict:
    """Certify a map, and compare the answer with what was sampled."""
    begin = time.process_time()
    found = certify(case.vmap, case.boxes[0])
    return Verdict(found, time.process_time() - begin, tuple(_troubles(case, found)))


def _troubles(case: Case, found: Certificate) -> Iterable[str]:
    """Say in what a certificate contradicts the samples, or itself."""
    least, minor = case.sampled.value, case.sampled.minor
    if found.certified:
        if least < 0.0:
            yield f"accepted, but {minor} is {least:.6f}"
        if found.bound > least + _ROUNDING:
            yield f"bound {found.bound:.9f}, but {minor} is {least:.9f}"
        return
    value, sampled = _at_witness(case, found)
    if min(least, value if sampled else np.inf) >= SURE:
        yield f"{found.reason}, but {minor} is nowhere below {least:.6f}"
    if not _told(found):
        yield "the refusal names neither the margin nor a fold"
    if found.reason != "undecided" and not np.isclose(value, found.least, rtol=1e-6, atol=1e-6):
        yield f"{found.minor} is {value:.6f} at the witness, not {found.least:.6f}"


def _at_witness(case: Case, found: Certificate) -> tuple[float, bool]:
    """Give the minor at a witness, and whether that lies in what was sampled.

    If so, it is one more sample.
    """
    k = [layer.name for layer in case.vmap.layers].index(found.layer)
    samples, place = case.samples[k], np.array(found.witness)
    if samples.torn:
        return found.least, True
    value = minors_at(case.vmap.layers[k], samples, place[None, :])[found.minor]
    return float(value[0]), samples.holds(place)


def _told(found: Certificate) -> bool:
    """Tell whether the error of a refusal says what is wrong: the margin, if it is too thin."""
    words = {"folds": "folds", "thin": f"less than {MARGIN:g}", "undecided": "not decided"}
    try:
        found.check()
    except FoldError as error:
        return words[found.reason] in str(error) and error.margin == MARGIN
    return False


@attrs.define
class Summary:
    """Counts of verdicts, and how far the least minors of both lie apart.

    Attributes
    ----------
    counts : Counter of str
    minors : Counter of str
        Which minor was least.
    seconds : list of float
    above, below : float
        By how much the certificate's least minor lies above the sampled one, of accepted maps,
        and below it, of those that do not fold, at most.
    missed : int
        Maps that are refused for a witness between the places sampled.
    undercut : float
        The least sampled minor of an accepted map.
    overcut : float
        The greatest sampled minor of a refused one.
    troubles : list of str
    """

    counts: Counter[str] = attrs.field(factory=Counter)
    minors: Counter[str] = attrs.field(factory=Counter)
    seconds: list[float] = attrs.field(factory=list)
    above: float = 0.0
    below: float = 0.0
    missed: int = 0
    undercut: float = np.inf
    overcut: float = -np.inf
    troubles: list[str] = attrs.field(factory=list)

    def add(self, number: int, least: Least, verdict: Verdict) -> None:
        """Count a map, by its number, its least minor sampled and what the check said."""
        found = verdict.found
        self.counts[f"sampled: {_range(least.value)}"] += 1
        self.counts[f"check: {found.reason}"] += 1
        self.counts[f"{_range(least.value)} -> {found.reason}"] += 1
        self.minors[least.minor] += 1
        self.seconds.append(verdict.seconds)
        self.missed += not found.certified and least.value >= SURE and not verdict.troubles
        if found.certified:
            self.undercut = min(self.undercut, least.value)
            self.above = max(self.above, found.least - least.value)
        else:
            self.overcut = max(self.overcut, least.value)
        if found.least > 0.0:
            self.below = max(self.below, least.value - found.least)
        self.troubles += [f"map {number}: {each}" for each in verdict.troubles]

    @property
    def sound(self) -> bool:
        """Whether nothing contradicts, and few enough are undecided."""
        undecided = self.counts["check: undecided"]
        return not self.troubles and undecided <= UNDECIDED * len(self.seconds)

    def text(self) -> str:
        """Give the table."""
        whole = len(self.seconds)
        lines = [f"{name:40} {self.counts[name]:6d} {self.counts[name] / whole:7.2%}"
                 for name in sorted(self.counts)]  # fmt: skip
        lines += [f"least minor: {name:27} {count:6d}" for name, count in self.minors.most_common()]
        times = 1e3 * np.array(self.seconds)
        lines += [
            f"contradictions                           {len(self.troubles):6d}",
            f"refused for a witness between samples    {self.missed:6d}",
            f"least sampled minor of an accepted map   {self.undercut:.6f}",
            f"greatest sampled minor of a refused map  {self.overcut:.6f}",
            f"the check's least minor above the sampled one, accepted: at most {self.above:.2e}",
            f"the sampled least minor above the check's, no fold: at most {self.below:.2e}",
            f"certify: median {np.median(times):.1f} ms, 99 % {np.quantile(times, 0.99):.0f} ms,"
            f" worst {times.max():.0f} ms",
        ]
        return "\n".join([*lines, *self.troubles])


def _range(least: float) -> str:
    if least < 0.0:
        return "folds, below 0"
    if least < MARGIN:
        return f"thin, 0 to {MARGIN:g}"
    return f"near, {MARGIN:g} to {SURE:g}" if least < SURE else f"sound, above {SURE:g}"


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw, compare and print; 1 if anything contradicts."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fold_check", description=__doc__)
    parser.add_argument("--fields", type=int, default=5000, help="maps that are drawn")
    parser.add_argument("--seed", type=int, default=2, help="of the draws")
    parser.add_argument("--jobs", type=int, default=1, help="processes side by side")
    chosen = parser.parse_args(arguments)
    summary, total = Summary(), 0.0
    numbers = [(chosen.seed, number) for number in range(chosen.fields)]
    with multiprocessing.get_context("spawn").Pool(chosen.jobs) as pool:
        for number, least, verdict, seconds in pool.imap(_one, numbers, chunksize=20):
            summary.add(number, least, verdict)
            total += seconds
            if (number + 1) % 500 == 0:
                print(f"{number + 1} maps, {len(summary.troubles)} contradictions", file=sys.stderr)
    print(summary.text())
    print(f"{chosen.fields} maps, seed {chosen.seed}: {total:.0f} s of one core")
    return int(not summary.sound)


def _one(which: tuple[int, int]) -> tuple[int, Least, Verdict, float]:
    begin = time.process_time()
    case = draw(*which)
    verdict = compare(case)
    return which[1], case.sampled, verdict, time.process_time() - begin


if __name__ == "__main__":
    sys.exit(main())

"""Plates of a hull: cut at planes and lines of girth, judged one by one.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.surface.plates.hull_plates import hull_plates
>>> from assoc_hull.surface.plates.hull_seams import HullSeams
>>> x, z = np.mgrid[0:30:3j, 0:9:3j]
>>> side = SplineSurface.bezier(np.stack([x, 8.0 + 0.5 * z - 0.03 * z * z, z], axis=-1), "body")
>>> found = hull_plates((side,), HullSeams(x=(10.0, 20.0), z=3.0))
>>> [plate.name for plate in found], found["2.1"].kind
(['1.1', '1.2', '2.1', '2.2', '3.1', '3.2'], 'cylinder')
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import all_of, choice, instance
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.blocks.net_surface import NetSurface
from assoc_hull.surface.plates.doubt import Doubt
from assoc_hull.surface.plates.hull_plate import HullPlate
from assoc_hull.surface.plates.hull_plate_table import HullPlates
from assoc_hull.surface.plates.hull_seams import HullSeams, PlateRange
from assoc_hull.surface.plates.judging import judged, rung
from assoc_hull.surface.plates.level_table import LevelTable, level_table, levels_about
from assoc_hull.surface.plates.options import SAGITTA_TOL, SHARE, PlateOptions, plate_options
from assoc_hull.surface.plates.plate_nodes import PlateNodes, nodes_in
from assoc_hull.surface.plates.rivals import rival_gauss
from assoc_hull.surface.plates.shell import Shell
from assoc_hull.surface.plates.tally import Tally, tallies
from assoc_hull.surface.regions.curvature_regions import curvature_regions
from assoc_hull.surface.regions.region_result import RegionResult
from assoc_hull.surface.regions.zero_band import BREADTH, STRAIN_TOL, zero_band

__all__ = ["hull_plates"]

_WHERE = "in plates of a hull"

_LEAST = 1e-4
"""m2: what is smaller is no plate."""

_FEW, _FINE = 20, (41, 161)
"""A plate with fewer nodes is measured by so many each way on a patch, in turn."""


def hull_plates(
    surface: NetSurface | Sequence[SplineSurface],
    seams: HullSeams,
    zero: str = "strain",
    strain_tol: float = STRAIN_TOL,
    breadth: float = BREADTH,
    k0: float | None = None,
    sagitta_tol: float = SAGITTA_TOL,
    sagitta_length: float | None = None,
    share: float = SHARE,
    suggestions: Mapping[str, str] | None = None,
    others: Sequence[NetSurface] = (),
    previous: HullPlates | None = None,
) -> HullPlates:
    """Tell of each plate of a hull how it is curved, and how sure that is.

    A butt x = constant, a seam z = constant is a plane: its trace on a Bezier patch is the zero set
    of a polynomial, as the lines K = K0 are. So the areas of plates, and of the regions in them,
    are those of the surface itself, to the tolerance of `curvature_regions`. Seams of equal girth
    are polynomials by interpolation. Roll axes, radii and strains are found at 7 by 7 nodes
    on each patch.

    Parameters
    ----------
    surface : NetSurface, or sequence of SplineSurface
        The half hull, as `surface` gives it; or its blocks, u along the ship, v round the girth.
    seams : HullSeams
        Butts and seams.
    zero : {"strain", "absolute"}
        What counts as no Gaussian curvature; see `curvature_regions`.
    strain_tol : float
        The strain of the mode "strain", K0 = 8 strain_tol / breadth**2.
    breadth : float, m
        The breadth that K0, and the sagitta of what is flat, are meant for.
    k0 : float, 1/m2
        Half the width of the band of the mode "absolute".
    sagitta_tol, sagitta_length, share, suggestions
        See `plates`.
    others : sequence of NetSurface
        Other fits of the same hull, such as a stiffer one and one without every second waterline:
        by what they change, a plate's dK is found.
    previous : HullPlates, optional
        Earlier plates; Bezier patches with the same nets under the same options are taken from
        them.

    Returns
    -------
    HullPlates
        A row for each plate, from aft forward and from below upward.

    Raises
    ------
    BadInputError, WrongTypeError
        No surface, no seams, numbers that are none or that the mode does not use; seams that leave
        no plate.

    Notes
    -----
    Source: the idea of the percentages and of the advice is that of "Curvature Region Analysis for
    Application of Plates Forming", J. SNAK; classes and measures are our own.
    """
    surfaces, names, singular = _blocks(surface)
    instance(seams, HullSeams, "seams", _WHERE)
    choice(zero, "zero", ("strain", "absolute"), _WHERE)
    options = plate_options(breadth, sagitta_tol, sagitta_length, share, suggestions, _WHERE)
    if options.breadth is None:
        what = "breadth is None, and plates of a hull share one band"
        raise BadInputError(what, _WHERE, "give a breadth, m")
    if previous is not None:
        instance(previous, HullPlates, "previous", _WHERE)
    fits = all_of(others, NetSurface, "others", _WHERE)
    level = zero_band(zero, strain_tol, breadth, k0, None, _WHERE).k0
    regions = curvature_regions(
        surfaces, zero, strain_tol, breadth, k0, levels=levels_about(level)[2:],
        previous=None if previous is None else previous.regions,
    )  # fmt: skip
    shell = Shell.of(surfaces, singular, bool(seams.girth))
    work = _Work(shell, names, regions, level, options, _rivals(shell, names, fits))
    found, slivers = work.plates(seams.ranges())
    if not found:
        raise BadInputError(
            "no plate lies between these seams", _WHERE,
            "give places within the hull: x forward from AP, z upward from the base line, m",
        )  # fmt: skip
    return HullPlates(found, seams, options, regions, len(fits), shell, slivers)


Blocks = tuple[
    tuple[SplineSurface, ...], tuple[str, ...], tuple[tuple[tuple[float, float], ...], ...]
]


def _blocks(surface: object) -> Blocks:
    """Take a fitted surface, or surfaces: with names, and tangent corners."""
    if isinstance(surface, NetSurface):
        blocks = surface.blocks
        return (
            surface.patches,
            tuple(block.name for block in blocks),
            tuple(block.singular for block in blocks),
        )
    given = tuple(all_of(surface, SplineSurface, "surface", _WHERE))
    if not given:
        raise BadInputError("surface is empty", _WHERE, "give at least one block")
    return given, tuple(each.name for each in given), ()


def _rivals(
    shell: Shell, names: Sequence[str], fits: Sequence[NetSurface]
) -> tuple[FloatArray, ...]:
    """Give the curvature of other fits at the nodes of a hull."""
    return tuple(
        rival_gauss(shell, names, fit.patches, [block.name for block in fit.blocks]) for fit in fits
    )


@attrs.frozen(eq=False)
class _Work:
    """What the plates of one hull have in common."""

    shell: Shell
    names: Sequence[str]
    regions: RegionResult
    level: float
    options: PlateOptions
    rivals: Sequence[FloatArray]

    def plates(self, ranges: Sequence[PlateRange]) -> tuple[tuple[HullPlate, ...], float]:
        """Give the plates of ranges, and what is left out as too narrow, m2."""
        tried = [self._draft(each) for each in ranges]
        drafts = [each for each in tried if each is not None]
        none = [wanted for wanted, each in zip(ranges, tried, strict=True) if each is None]
        bare = LevelTable(self._table(self.level)[1].total, {}, {})
        slivers = sum(each.area for each in tallies(self.shell, none, (), bare)) if none else 0.0
        found: dict[str, HullPlate] = {}
        for k0 in sorted({each.k0 for each in drafts}):
            own = [each for each in drafts if each.k0 == k0]
            sums = tallies(self.shell, [each.wanted for each in own], *self._table(k0))
            for each, tallied in zip(own, sums, strict=True):
                found[each.wanted.name] = self._plate(each, tallied)
        return tuple(found[each.wanted.name] for each in drafts), slivers

    def _table(self, k0: float) -> tuple[tuple[float, ...], LevelTable]:
        """Give the levels about a K0, and the areas of all patches above them."""
        (part,), levels = self.regions.parts, levels_about(k0)
        return levels, level_table(self.shell.patches, levels, part.solutions)

    def _draft(self, wanted: PlateRange) -> _Draft | None:
        """Measure a plate, as far as regions are not needed; a narrow one by more nodes."""
        measured, rivals = nodes_in(self.shell, wanted), self.rivals
        for count in _FINE:
            if measured.inside.sum() < _FEW:
                measured, rivals = nodes_in(self.shell, wanted, count), ()
        if not measured.nodes.area.sum() > _LEAST:
            return None
        margin = self.shell.margin[measured.rows][:, None, None]
        sound = np.where(margin, 0.0, measured.nodes.area)
        rivals = [each[measured.rows] for each in rivals]
        doubt = Doubt.of(measured.nodes.gauss, rivals, sound)
        return _Draft(wanted, measured, doubt, rung(self.level, doubt.dk))

    def _plate(self, draft: _Draft, tallied: Tally) -> HullPlate:
        """Judge a plate."""
        blocks = np.unique(self.shell.patches.surface[draft.measured.rows]).tolist()
        names = [self.names[number] for number in blocks]
        band = (draft.k0, float(self.options.breadth or BREADTH))
        return judged(
            draft.wanted,
            names,
            draft.measured,
            tallied,
            draft.doubt,
            band,
            self.level,
            self.options,
        )


@attrs.frozen(eq=False)
class _Draft:
    """A plate before its regions are known; `k0` is the band that is told from noise, 1/m2."""

    wanted: PlateRange
    measured: PlateNodes
    doubt: Doubt
    k0: float

"""Plates of single surfaces: seams that cut them, and the search.

`plates` is what is called: surfaces are cut at lines of constant parameter, or not at all.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import choice, instance, numbers, shown
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plating.options import SAGITTA_TOL, SHARE, PlateOptions, plate_options
from assoc_hull.surface.plating.plate import PlateDraft, draft_plate, plate_of
from assoc_hull.surface.plating.plate_table import PlateTable
from assoc_hull.surface.regions.curvature_regions import curvature_regions
from assoc_hull.surface.regions.options import BREADTH, MODES, STRAIN_TOL
from assoc_hull.surface.regions.result import RegionResult
from assoc_hull.surface.regions.surface_batches import batches_of, given_surfaces, require_area

__all__ = [
    "Seams",
    "cut_at_seams",
    "plates",
    "seams_of",
]


def _parameters(value: object, name: str) -> tuple[float, ...]:
    """Take parameters that rise."""
    found = np.atleast_1d(numbers(value, name, "in Seams"))
    if (np.diff(found) <= 0.0).any():
        remedy = "give parameters that rise, each once"
        raise BadInputError(f"{name} is {shown(value)}", "in Seams", remedy)
    return tuple(found.tolist())


def _along_u(value: Any) -> tuple[float, ...]:
    return _parameters(value, "u")


def _along_v(value: Any) -> tuple[float, ...]:
    return _parameters(value, "v")


@attrs.frozen
class Seams:
    """Where a surface is cut into plates.

    Attributes
    ----------
    u, v : tuple of float
        Parameters of the surface at which it is cut, rising, within its domain.

    Raises
    ------
    BadInputError
        Numbers that are none, or do not rise.

    Examples
    --------
    >>> from assoc_hull.surface.plating.surface_plates import Seams
    >>> Seams(u=0.5).u
    (0.5,)
    """

    u: tuple[float, ...] = attrs.field(default=(), converter=_along_u)
    v: tuple[float, ...] = attrs.field(default=(), converter=_along_v)

    def __bool__(self) -> bool:
        """Whether anything is cut."""
        return bool(self.u or self.v)


def seams_of(
    seams: object, surfaces: Sequence[SplineSurface], where: str = "in plates"
) -> tuple[Seams, ...]:
    """Give the seams of each surface.

    Parameters
    ----------
    seams : Seams, sequence of Seams or None, or None
        For all surfaces, or for each.
    surfaces : sequence of SplineSurface
        The surfaces.
    where : str
        Where they were given, for messages.

    Raises
    ------
    BadInputError, WrongTypeError
        Anything else; seams for more or fewer surfaces.
    """
    if seams is None or isinstance(seams, Seams):
        return (seams or Seams(),) * len(surfaces)
    if not isinstance(seams, Sequence) or isinstance(seams, str | bytes):
        remedy = "give Seams, one for all surfaces or a list with one for each"
        raise WrongTypeError(f"seams is {shown(seams)}", where, remedy)
    if len(seams) != len(surfaces):
        what = f"there are {len(seams)} seams for {len(surfaces)} surfaces"
        raise BadInputError(what, where, "give one for each surface, None where nothing is cut")
    for each in seams:
        if each is not None and not isinstance(each, Seams):
            raise WrongTypeError(f"an item of seams is {shown(each)}", where, "give Seams or None")
    return tuple(each or Seams() for each in seams)


def cut_at_seams(surface: SplineSurface, seams: Seams) -> tuple[SplineSurface, ...]:
    """Cut a surface into plates.

    Parameters
    ----------
    surface : SplineSurface
        The surface.
    seams : Seams
        Where.

    Returns
    -------
    tuple of SplineSurface
        The plates, those with rising v one behind the other; each keeps its parameters and is
        called as the surface, with the numbers of its place along u and v.

    Raises
    ------
    BadInputError
        A seam that does not lie inside the domain.
    """
    if not seams:
        return (surface,)
    u, v = (
        list(pairwise((low, *_within(surface, name, at, low, high), high)))
        for name, at, (low, high) in zip("uv", (seams.u, seams.v), surface.domain, strict=True)
    )
    return tuple(
        surface.restricted(along, across, f"{surface.name} {_place(i, j, seams)}".strip())
        for i, along in enumerate(u, start=1)
        for j, across in enumerate(v, start=1)
    )


def _within(
    surface: SplineSurface, name: str, at: tuple[float, ...], low: float, high: float
) -> tuple[float, ...]:
    """Take seams that lie inside the domain of a surface."""
    for each in at:
        if not low < each < high:
            what = f"the seam at {name} = {each:g} does not cut it"
            remedy = f"give a parameter between {low:g} and {high:g}"
            raise BadInputError(what, surface.where, remedy)
    return at


def _place(i: int, j: int, seams: Seams) -> str:
    """Give the number of a plate: along u, along v, or both."""
    if not seams.v:
        return f"{i}"
    return f"{i}.{j}" if seams.u else f"{j}"


# --------------------------------------------------------------------------------------
# The plates of surfaces.

_WHERE = "in plates"


def plates(
    surfaces: SplineSurface | Sequence[SplineSurface] | FloatArray,
    seams: Seams | Sequence[Seams | None] | None = None,
    zero: str = "strain",
    strain_tol: float = STRAIN_TOL,
    breadth: float | None = BREADTH,
    k0: float | None = None,
    delta: float | None = None,
    sagitta_tol: float = SAGITTA_TOL,
    sagitta_length: float | None = None,
    share: float = SHARE,
    suggestions: Mapping[str, str] | None = None,
    area_tol: float = 1e-6,
    depth: int = 16,
    budget: int = 6000,
    chord_tol: float = 0.001,
    previous: PlateTable | None = None,
) -> PlateTable:
    """Tell of each plate which part is convex, saddle, cylinder and flat, and how it may be formed.

    One surface is one plate, unless seams cut it. The areas of the regions are those of
    `curvature_regions`, with their error estimate; all else (cylinder or flat, roll axis, radii,
    strains) is found at 24 by 24 nodes on each Bezier patch.

    Parameters
    ----------
    surfaces : SplineSurface, sequence of SplineSurface, or (m + 1, n + 1, 3) float, m
        The surfaces; one control net is a Bezier patch.
    seams : Seams, or a sequence with Seams or None for each surface, optional
        Lines of constant parameter that cut the surfaces into plates.
    zero : {"strain", "absolute", "exact"}
        What counts as no Gaussian curvature; see `curvature_regions`.
    strain_tol : float
        The strain of the mode "strain", K0 = 8 strain_tol / breadth**2.
    breadth : float or None, m
        The breadth that K0, and the sagitta of what is flat, are meant for; None takes the own
        breadth of each plate, with a K0 of its own.
    k0 : float, 1/m2
        Half the width of the band of the mode "absolute".
    delta : float, m
        What each coordinate of a control point may be off by.
    sagitta_tol : float, m
        A developable part is flat where no principal curvature exceeds 8 sagitta_tol / breadth**2.
    sagitta_length : float, m
        The length that takes the place of the breadth in this, such as that of the plate.
    share : float
        A plate has the class of the region that has this part of its area, above 0.5 to 1.
    suggestions : mapping of str to str, optional
        Texts of advice by "flat", "cylinder", "cone", "saddle", "convex", "mixed".
    area_tol, depth, budget, chord_tol
        Tolerances and limits of the search; see `curvature_regions`.
    previous : Plates, optional
        Earlier plates; patches with the same nets under the same options are taken from them.

    Returns
    -------
    Plates
        A row for each plate, in the order of surfaces, u and v.

    Raises
    ------
    BadInputError, WrongTypeError
        No surfaces, seams off the surface, numbers that are none or that the mode does not use.

    Notes
    -----
    With `HullSeams` for its seams, `assoc_hull.surface.plates` takes a hull or the surface of one,
    and cuts it by planes and girths: see `assoc_hull.surface.plating.hull_plates.hull_plates`.

    Source: the idea of the percentages and of the advice is that of "Curvature Region Analysis for
    Application of Plates Forming", J. SNAK; classes and measures are our own.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> import numpy as np
    >>> x, y = np.mgrid[-4:4:3j, -1:1:3j]
    >>> bowl = np.stack([x, y, 0.05 * (x * x + y * y)], axis=-1)
    >>> ah.surface.plates(bowl)[0].kind
    'convex'
    """
    given = given_surfaces(surfaces, _WHERE)
    options = plate_options(breadth, sagitta_tol, sagitta_length, share, suggestions, _WHERE)
    if previous is not None:
        instance(previous, PlateTable, "previous", _WHERE)
    drafts = _drafts(given, seams_of(seams, given, _WHERE))
    search = dict[str, Any](
        zero=choice(zero, "zero", MODES, _WHERE), strain_tol=strain_tol, k0=k0, delta=delta,
        area_tol=area_tol, depth=depth, budget=budget, chord_tol=chord_tol,
    )  # fmt: skip
    results = _results(drafts, search, options, previous)
    rows = tuple(
        plate_of(each, *_own(results, number), options.breadth or each.breadth, options)
        for number, each in enumerate(drafts)
    )
    return PlateTable(rows, options, results)


def _drafts(surfaces: tuple[SplineSurface, ...], seams: tuple[Seams, ...]) -> list[PlateDraft]:
    """Cut surfaces at their seams and measure the plates."""
    cut = [
        (plate, bool(own))
        for surface, own in zip(surfaces, seams, strict=True)
        for plate in cut_at_seams(surface, own)
    ]
    surfaces = tuple(surface for surface, _ in cut)
    require_area(surfaces, batches_of(surfaces))
    return [
        draft_plate(surface, surface.name or f"plate {number}", between)
        for number, (surface, between) in enumerate(cut, start=1)
    ]


def _results(
    drafts: list[PlateDraft],
    search: dict[str, Any],
    options: PlateOptions,
    previous: PlateTable | None,
) -> tuple[RegionResult, ...]:
    """Find the regions of all plates at once, or plate by plate where each has its own band."""
    old = () if previous is None else previous.results
    if search["zero"] != "strain" or options.breadth is not None:
        if search["zero"] == "strain":
            search = search | {"breadth": options.breadth}
        surfaces = [each.surface for each in drafts]
        return (curvature_regions(surfaces, previous=next(iter(old), None), **search),)
    return tuple(
        curvature_regions(
            each.surface, breadth=each.breadth, previous=old[i] if i < len(old) else None, **search
        )
        for i, each in enumerate(drafts)
    )


def _own(results: tuple[RegionResult, ...], number: int) -> tuple[RegionResult, int]:
    """Give the result that holds a plate, and its number there."""
    return (results[0], number) if len(results) == 1 else (results[number], 0)

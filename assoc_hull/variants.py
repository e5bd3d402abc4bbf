"""Variants: a new hull from a parent, by named parameters and fields.

Examples
--------
>>> import assoc_hull as ah
>>> parent = ah.examples.wigley()
>>> variant = ah.vary(parent, set={"breadth": 11.0})
>>> variant.hull.half_breadth(50.0, 6.25), parent.half_breadth(50.0, 6.25)
(5.5, 5.0)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import attrs

from assoc_hull.hull import Hull, to_change
from assoc_hull.model.objects import Group, Line
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.request import (
    TOLERANCE,
    Planes,
    Stations,
    VariationRequest,
    read_script,
    request_from_data,
)
from assoc_hull.variation.vary import VariationReport, vary_document

__all__ = ["Variation", "vary", "vary_by"]


@attrs.frozen(eq=False)
class Variation:
    """A varied hull.

    Attributes
    ----------
    hull : Hull
        The variant; undo gives the parent back.
    report : VariationReport
        What was asked, reached and changed.
    map : VMap
        The map that carries places of the parent to those of the variant, m.
    """

    hull: Hull
    report: VariationReport
    map: VariationMap

    def __str__(self) -> str:
        return str(self.report)


def vary(
    hull: Hull,
    *,
    set: Mapping[str, float] | None = None,
    reach: Mapping[str, float] | None = None,
    free: Sequence[object] | str = (),
    bounds: Mapping[str, tuple[float | None, float | None]] | None = None,
    exact: bool = True,
    layers: Sequence[object] = (),
    layout: Mapping[str, Any] | Layout | None = None,
    drivers: Sequence[Group | Line | str] | None = None,
    stations: Stations = "number",
    planes: Planes = "follow",
    tolerance: float = TOLERANCE,
    name: str | None = None,
    in_place: bool = False,
) -> Variation:
    """Vary a hull so that named parameters, and outputs, have asked values; all lines follow.

    The map is certified not to fold, the lines that drive are carried exactly, all others are
    cut again from them, and the asked values are measured on the lines of the result to 1e-6.
    Values that the hull has already change nothing, and make no step in the history; beside others
    they say that these values are to stay. Outputs are reached by what is free for it, on the
    hydrostatics of the result, to 1e-10 of their size.

    Parameters
    ----------
    hull : Hull
        The parent.
    set : mapping of str to float
        Values by name, m, or degrees where the name ends in ``_deg``; x from AP forward, z from
        the base line up. `measure` gives the names and the present values.
    reach : mapping of str to float
        Values of outputs by name, in their units, at the design draught: fields of
        `hydrostatics`, form parameters, sectional areas; see
        `assoc_hull.variation.aiming.outputs.Outputs`.
    free : sequence of str, layer or mapping
        What may change so that they are reached: named parameters that are not `set`, and
        layers, of which the strength is found: 1 is the layer as given, 0 none of it. Layers as
        for `layers`, or as data ``{"name": ..., "fields": [...]}``. Where there is more
        freedom than targets the change is the least.
    bounds : mapping of str to (float or None, float or None)
        Least and greatest values by the names of what is free, m, degrees, or strengths of layers;
        None leaves an end open.
    exact : bool
        Whether targets must all be met; otherwise the best compromise is taken where they
        cannot be.
    layers : sequence
        Raw layers that act after those of the named parameters: a `FieldLayer`, `AdditiveLayer`,
        `CornerLayer` or `DeadriseLayer`, or a list of fields as data (see
        `assoc_hull.variation.fields.field_data`).
    layout : mapping or Layout
        How far the fields reach; see `assoc_hull.variation.parameters.field_layout.Layout`.
    drivers : sequence of Group, Line or str
        Lines whose images are taken exactly; boundary curves always are. By default all lines
        whose planes the map keeps.
    stations : {"number", "x"}
        Sections go with the map and keep their numbers, or stay where they are.
    planes : {"follow", "stay"}
        Waterlines and buttocks go with a map that sends their planes to parallel ones, as a
        change of breadth, draught or depth does, and keep their names; or they stay at their
        heights and half-breadths and are cut again. If a map bends the planes of some over more
        than half of their length, all stay.
    tolerance : float, m
        How far a driver may leave its exact image.
    name : str
        Of the step in the history; by default it tells the values.
    in_place : bool
        Vary this hull, as a step that can be undone; else a copy of it.

    Returns
    -------
    Variation
        The hull, what was reached, and the map.

    See Also
    --------
    vary_by : the same from data or a file.
    assoc_hull.measure : present values.

    Raises
    ------
    UnknownNameError
        No such parameter or output.
    UnreachableError, DependentTargetsError, TooFewFreeError
        Targets that cannot be reached by what is free: how near one comes, and what is in the way.
    FoldError
        The map folds, or nearly; where, and between which values one may ask.
    OutOfRangeError
        What comes out is no ship; with the interval.
    BadInputError
        The parent has not what is asked for; two parameters contradict each other. The hull is
        unchanged, whatever the error.
    RefusedEditError
        A line would fold or lose its order. The hull is unchanged.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> variant = ah.vary(ah.examples.wigley(), set={"breadth": 11.0, "draught": 7.0})
    >>> [target.reached for target in variant.report.targets]
    [11.0, 7.0]
    >>> variant = ah.vary(ah.examples.wigley(), reach={"volume": 2800.0}, free=["breadth"])
    >>> round(ah.hydrostatics(variant.hull).volume, 7), round(variant.hull.particulars.breadth, 4)
    (2800.0, 10.0812)
    """
    ask = VariationRequest.of(
        set, reach=reach, free=free, bounds=bounds, exact=exact, layers=layers, layout=layout,
        drivers=drivers, stations=stations, planes=planes, tolerance=tolerance, name=name,
    )  # fmt: skip
    return _carry_out(to_change(hull, "vary", in_place=in_place), ask)


def vary_by(
    hull: Hull, script: Mapping[str, Any] | str | PathLike[str], *, in_place: bool = False
) -> Variation:
    """Vary a hull by a script: the arguments of `vary` as data, or a JSON file of them.

    The same parent and the same script give the same hull, to the last bit.

    Parameters
    ----------
    hull : Hull
        The parent.
    script : mapping or path
        See `assoc_hull.variation.request`. `VariationReport.script` is such a one.
    in_place : bool
        As in `vary`.

    Raises
    ------
    AssocHullError
        As `vary`; a file that cannot be read.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.variants import vary_by
    >>> str(vary_by(ah.examples.wigley(), {"set": {"breadth": 11.0}}).report.targets[0])
    'breadth 10 -> 11 m'
    """
    data = script if isinstance(script, Mapping) else read_script(script)
    ask = request_from_data(data)
    return _carry_out(to_change(hull, "vary", in_place=in_place), ask)


def _carry_out(hull: Hull, ask: VariationRequest) -> Variation:
    vmap, report = vary_document(hull.document, ask)
    return Variation(hull, report, vmap)

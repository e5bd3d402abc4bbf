"""Definitions in few words: a curve of sectional areas, a waterline, any other course.

Examples
--------
>>> from assoc_hull.creation.form_definitions import course, design_waterline, sectional_area
>>> from assoc_hull.model.tables import Particulars
>>> ship = Particulars("ship", 180.0, 28.0, 15.8, 10.5)
>>> areas = sectional_area(
...     ship, cm=0.995, cb=0.75, lcb=2.9, run_end=-0.208, entrance_start=0.34, run_area=0.511,
...     run_centroid=-0.488, run_start_angle_deg=25.0, entrance_end_angle_deg=-54.0,
... )
>>> areas.value("full"), round(areas.value("entrance_area"), 6)
(292.53, 0.448537)
>>> line = design_waterline(
...     ship, cw=0.84, lcf=-1.25, run_end=-0.4, entrance_start=0.5, run_area=0.45,
...     run_centroid=-0.65, run_start_angle_deg=60.0, entrance_end_angle_deg=-60.0,
... )
>>> line.use, line.value("full")
('design_waterline', 14.0)
>>> course("keel_angle", {"AP": (0.0, 45.0), "body": (70.0, 90.0)}, rule="straight").nodes
('AP', 'body')
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from assoc_hull.arguments import instance, numbers, positive, text
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.model.form_definition import NODE_FIELDS, USES, FormDefinition
from assoc_hull.model.forms.closure import close_halves
from assoc_hull.model.tables import Particulars

__all__ = ["course", "design_waterline", "sectional_area"]

_FRAME = {"run_start": -1.0, "entrance_end": 1.0, "top": 1.0}
"""Where the halves end and how high the parallel part is, if nothing else is said."""

Node = Sequence[float | None] | Mapping[str, float | None]


def sectional_area(
    particulars: Particulars,
    *,
    cm: float,
    cb: float | None = None,
    cp: float | None = None,
    lcb: float | None = None,
    name: str = "sectional areas",
    **values: float | None,
) -> FormDefinition:
    """Define a curve of sectional areas; its entrance closes it.

    Parameters
    ----------
    particulars : Particulars
        Of the ship.
    cm : float
        Midship section coefficient: the ordinate 1 stands for cm B T.
    cb, cp : float or None
        Block or prismatic coefficient, one of them, if the closure is to give the area of the
        entrance.
    lcb : float or None, m
        Centre of buoyancy from midship, forward positive, for the closure.
    name : str
        What the definition is called.
    **values : float or None
        As `assoc_hull.model.form_definition.HALVES` names them, in the frame of the ship: from
        -1 at AP to 1 at FP. The run starts at AP, the entrance ends at FP and the parallel part
        has the ordinate 1 unless they say else.

    Returns
    -------
    FormDefinition

    Raises
    ------
    BadInputError
        A value of another name, or one that is no number.
    OutOfRangeError
        No entrance that falls all the way closes the curve; the error tells the interval.
    """
    ship = instance(particulars, Particulars, "particulars", "in a curve of areas")
    full = positive(cm, "cm", "in a curve of areas") * ship.breadth * ship.draught
    given = {**_FRAME, "full": full, **values}
    found = FormDefinition(text(name, "name"), "sectional_area", "halves", given)
    if cb is None and cp is None and lcb is None:
        return found
    return close_halves(found, ship, cb=cb, cp=cp, lcb=lcb)


def design_waterline(
    particulars: Particulars,
    *,
    cw: float | None = None,
    lcf: float | None = None,
    name: str = "design waterline",
    **values: float | None,
) -> FormDefinition:
    """Define the waterline at the design draught; its entrance closes it.

    Parameters
    ----------
    particulars : Particulars
        Of the ship; the ordinate 1 stands for half the breadth.
    cw : float or None
        Waterplane coefficient, between the ends of the two halves, for the closure.
    lcf : float or None, m
        Centre of flotation from midship, forward positive, for the closure.
    name : str
        What the definition is called.
    **values : float or None
        As for `sectional_area`.

    Returns
    -------
    FormDefinition

    Raises
    ------
    BadInputError, OutOfRangeError
        As for `sectional_area`.
    """
    ship = instance(particulars, Particulars, "particulars", "in a waterline")
    given = {**_FRAME, "full": 0.5 * ship.breadth, **values}
    found = FormDefinition(text(name, "name"), "design_waterline", "halves", given)
    if cw is None and lcf is None:
        return found
    return close_halves(found, ship, cw=cw, lcf=lcf)


def course(
    use: str, nodes: Mapping[str, Node], *, rule: str = "form", name: str | None = None
) -> FormDefinition:
    """Define a course: nodes in order, joined by pieces.

    Parameters
    ----------
    use : str
        What is taken from it, one of `assoc_hull.model.form_definition.USES`.
    nodes : mapping of str to (float, float), (float, float, float) or mapping
        By label: x (m from AP) and ordinate (m, degrees, m2 or 1/m, whichever it is a curve
        of), and the angle (degrees) if it is given; or any of
        `assoc_hull.model.form_definition.NODE_FIELDS` by name.
    rule : {"form", "monotone", "straight"}
        How the pieces run where nothing is given.
    name : str or None
        What the definition is called; the use in words if None.

    Returns
    -------
    FormDefinition

    Raises
    ------
    UnknownNameError
        Of a use, or of a value of a node.
    BadInputError
        A rule that is unknown, fewer than one node, or a node that is none of these.
    """
    if text(use, "use", "in a course") not in USES:
        raise UnknownNameError("use of a definition", use, tuple(USES))
    where = f"in the course {use!r}"
    if USES[use].kind != "course":
        raise BadInputError("it is a curve of two halves", where, f"call {use} for it")
    instance(nodes, Mapping, "nodes", where)  # type: ignore[type-abstract]
    if not nodes:
        raise BadInputError("there are no nodes", where, "give nodes by their labels")
    values: dict[str, float | None] = {}
    labels: list[str] = []
    for label, node in nodes.items():
        fields = _fields(node, f"{where}, node {text(label, 'a label', where)!r}")
        labels.append(label)
        values |= {f"{label}_{field}": value for field, value in fields.items()}
    title = use.replace("_", " ") if name is None else text(name, "name", where)
    return FormDefinition(title, use, "course", values, rule, tuple(labels))


def _fields(node: Node, where: str) -> Mapping[str, float | None]:
    """Give the values of a node by their names."""
    if isinstance(node, Mapping):
        for name in node:
            if name not in NODE_FIELDS:
                raise UnknownNameError("value of a node", str(name), NODE_FIELDS)
        missing = [name for name in ("x", "y") if node.get(name) is None]
        if missing:
            raise BadInputError(f"{missing[0]} is missing", where, "give it")
        return node
    found = numbers(node, "the node", where)
    if found.shape not in ((2,), (3,)):
        raise BadInputError(
            f"the node has the shape {found.shape}", where, "give x, y and perhaps an angle"
        )
    return dict(zip(NODE_FIELDS, found.tolist(), strict=False))

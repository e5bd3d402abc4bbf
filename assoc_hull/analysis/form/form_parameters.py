"""Form parameters of a hull: a value for each entry of the catalogue."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from assoc_hull.analysis.form.catalogue import CATALOGUE
from assoc_hull.analysis.form.evaluate import check_catalogue, evaluate
from assoc_hull.analysis.form.parameter import Parameter
from assoc_hull.analysis.form.screw import Screw
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Value
from assoc_hull.analysis.hydrostatics.floating import require_numbers
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.hydrostatic_header import SALT
from assoc_hull.analysis.hydrostatics.hydrostatics import position_of
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, header_of, state_of
from assoc_hull.arguments import shown
from assoc_hull.errors import WrongTypeError
from assoc_hull.model.named_mapping import Named

__all__ = ["form_parameters", "shape_of"]

_WHERE = "in form parameters"
_MOST = 8
"""So many positions of a hull are kept, until a line changes."""

_KEPT = "form parameters"


def form_parameters(
    hull: HasState,
    *,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    screw: Screw | None = None,
    rho: float = SALT,
    shell_factor: float = 1.0,
    transom: bool = False,
    only: Iterable[str] | None = None,
    further: Iterable[Parameter] = (),
) -> Mapping[str, Value]:
    """Give the form parameters of a hull, upright at a draught.

    Values are computed once: until a line of the hull changes, asking again costs nothing.

    Parameters
    ----------
    hull : Hull
        The hull.
    draught : float, m
        At even keel; or `draughts`. The design draught if neither is given.
    draughts : (float, float), m
        T_A and T_F, on the centre line at the perpendiculars.
    screw : Screw or None
        Without it, what depends on screw and shaft has no value.
    rho, shell_factor, transom
        As for `hydrostatics`.
    only : iterable of str or None
        Symbols of the entries wanted; None: all of them.
    further : iterable of Parameter
        Entries of one's own, which may need others of the catalogue.

    Returns
    -------
    mapping of str to Value
        By symbol: a number with its unit, or the reason why there is none.

    Raises
    ------
    OutOfRangeError
        A position in which the hull does not float, with the range.
    UnknownNameError
        A symbol that is no entry.
    BadInputError
        A number that cannot be used; entries that do not fit into the catalogue.

    Examples
    --------
    >>> from assoc_hull.analysis.form.form_parameters import form_parameters
    >>> from assoc_hull.sources import examples
    >>> found = form_parameters(examples.wigley(), draught=6.25)
    >>> round(found["Cb"].number, 3), found["Cb"].unit  # 4/9
    (0.444, '-')
    """
    shape, known = _shape(hull, draught, draughts, screw, rho, shell_factor, transom)
    own = _entries(further)
    entries: Mapping[str, Parameter] = CATALOGUE
    if own:
        entries = Named("form parameter", check_catalogue([*CATALOGUE.values(), *own]))
        known = dict(known)  # another call may bring another entry of this name
    wanted = tuple(entries) if only is None else _symbols(only)
    return Named("form parameter", evaluate(entries, wanted, shape, known))


def _entries(further: object) -> tuple[Parameter, ...]:
    """Take entries of a caller's own."""
    found = tuple(further) if isinstance(further, Iterable) else (further,)
    for each in found:
        if not isinstance(each, Parameter):
            raise WrongTypeError(
                f"further holds {shown(each)}", _WHERE, "give entries made by `parameter`"
            )
    return found


def _symbols(only: object) -> tuple[str, ...]:
    """Take symbols; one alone may come without a list."""
    found = (only,) if isinstance(only, str) or not isinstance(only, Iterable) else tuple(only)
    for each in found:
        if not isinstance(each, str):
            raise WrongTypeError(f"only holds {shown(each)}", _WHERE, "give symbols of entries")
    return found


def shape_of(
    hull: HasState,
    *,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    screw: Screw | None = None,
    rho: float = SALT,
    shell_factor: float = 1.0,
    transom: bool = False,
) -> Shape:
    """Give what entries of the catalogue measure; arguments as for `form_parameters`."""
    return _shape(hull, draught, draughts, screw, rho, shell_factor, transom)[0]


def _shape(
    hull: HasState,
    draught: float | None,
    draughts: tuple[float, float] | None,
    screw: Screw | None,
    rho: float,
    shell_factor: float,
    transom: bool,
) -> tuple[Shape, dict[str, Value]]:
    """Give a hull at its position, and what is known of it."""
    if not (screw is None or isinstance(screw, Screw)):
        raise WrongTypeError(f"screw is {shown(screw)}", _WHERE, "give a Screw")
    state = state_of(hull)
    body = flotation(state)
    terms = {"rho": rho, "shell_factor": shell_factor, "transom": transom, "fingerprint": "",
             "appendages": ()}  # fmt: skip
    header = header_of(hull, body, terms)
    require_numbers(draughts if draught is None else draught, body.limits)
    position = position_of(header, draught, draughts, 0.0, "moulded")
    kept: dict[object, tuple[Shape, dict[str, Value]]] = body.kept.setdefault(_KEPT, {})
    key = (position, screw, header.rho, header.shell_factor, header.transom)
    if key not in kept:
        if len(kept) >= _MOST:
            kept.pop(next(iter(kept)), None)
        kept[key] = Shape(body, header, position, state.particulars.depth, screw), {}
    return kept[key]

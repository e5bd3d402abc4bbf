"""A 207,000 TDW bulk carrier as a net: single screw, transom stern, bulbous bow.

Principal dimensions, bilge radius and bossing are those of the example of Choi & Lee, "A Study on
the Hull Form Design System on the Basis of the Associative Geometry Objects", J. SNAK 36(4),
1999. The form is our own; stations stand clear of where the stem meets a waterline.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.adoption.adopt import adopt
from assoc_hull.edit.adoption.report import AdoptionReport
from assoc_hull.edit.document import Document
from assoc_hull.edit.newline.add_line import add_line
from assoc_hull.edit.transaction import Transaction
from assoc_hull.model.state import Association, HullState, Particulars
from assoc_hull.shipped import bulk_carrier_207k_form as form
from assoc_hull.shipped.carrier_lines import boundary_lines, buttock, station, waterline
from assoc_hull.tolerance import Tolerances

__all__ = ["bulk_carrier_207k", "bulk_carrier_207k_adopted", "bulk_carrier_207k_net"]

_STATIONS = (
    -0.25, 0.0, 0.28, 0.45, 0.5, 0.62, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5,
    5.0, 6.0, 8.0, 10.0, 12.0, 14.0, 15.0, 15.5, 16.0, 16.5, 17.0, 17.5, 18.0, 18.25, 18.5, 18.75,
    19.0, 19.2, 19.4, 19.6, 19.8, 20.04, 20.175, 20.3,
)  # fmt: skip
_WATERLINES = (
    0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.5, 15.0, 16.5, 18.0,
    20.0, 22.0, 24.5,
)  # fmt: skip
_GIVEN = (0.5, 1.0)
"""The buttocks near the centre plane are drawn: they shape the stern above the propeller."""

_BUTTOCKS = (2.0, 4.0, 6.0, 8.5, 11.0, 13.5, 16.0, 18.5, 21.0, 23.5)

_ASSOCIATIONS = (
    Association("boundary", "sections"),
    Association("boundary", "waterlines"),
    Association("boundary", "buttocks"),
    Association("sections", "waterlines"),
    Association("sections", "buttocks"),
    Association("waterlines", "buttocks"),
)

_TOLERANCES = Tolerances(spacing=0.12, turn_spacing=0.3, adopted_spacing=0.01)
"""At the stern the lines stand closer than elsewhere, and waterlines, stations and buttocks are
to shape it alike: the least spacing is a smaller part of the median than by default. The bossing
end, a circle of 0.725 m radius, is drawn by points closer than one adopts elsewhere."""

_KEEP = 0.6e-3
"""How far (m) one crossing of a buttock that is cut may move a line that was there."""


def bulk_carrier_207k_adopted() -> tuple[HullState, AdoptionReport]:
    """Adopt boundary curves, 41 stations, 20 waterlines and two buttocks.

    Returns
    -------
    HullState, AdoptionReport
    """
    x, z = np.array(_STATIONS) * form.LENGTH / 20.0, np.array(_WATERLINES)
    sources = boundary_lines()
    sources += [piece for number in _STATIONS for piece in station(number, z)]
    sources += [waterline(height, x) for height in _WATERLINES]
    sources += [piece for y in _GIVEN for piece in buttock(y, z)]
    ship = Particulars(
        "Bulk carrier 207,000 TDW", form.LENGTH, form.BREADTH, form.DEPTH, form.DRAUGHT, "closed"
    )
    return adopt(sources, ship, _ASSOCIATIONS, _TOLERANCES)


def bulk_carrier_207k() -> HullState:
    """Make the net of 41 stations, 20 waterlines and 12 buttocks.

    Lpp 300 m, B 50 m, T 18 m, depth 27 m, block coefficient 0.84, bilge radius 2.4 m; the
    bossing ends as a cylinder of 0.725 m radius about the shaft at 5.0 m. Sections are named
    by station (AP = 0, FP = 20), waterlines by height and buttocks by half-breadth in metres.

    Returns
    -------
    HullState
    """
    return bulk_carrier_207k_net()[0]


def bulk_carrier_207k_net() -> tuple[HullState, AdoptionReport]:
    """Make the net of `bulk_carrier_207k`, with the report of how its lines were adopted.

    Returns
    -------
    HullState, AdoptionReport
    """
    state, report = bulk_carrier_207k_adopted()
    with Transaction(Document(state), "cut buttocks") as edit:
        for y in _BUTTOCKS:
            add_line(edit, "buttocks", y, f"BTK {y:g}", _KEEP)
    return state, report

"""The screw, as several commands take it."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from assoc_hull.errors import BadInputError

if TYPE_CHECKING:
    from assoc_hull.analysis.form.screw import Screw

__all__ = ["add_screw", "screw_of"]


def add_screw(parser: argparse.ArgumentParser) -> None:
    """Add what may be told of the screw."""
    parser.add_argument(
        "--shaft-height", type=float, metavar="Z", help="of the shaft at the screw, above base, m"
    )
    parser.add_argument("--propeller-diameter", type=float, metavar="D", help="m")
    parser.add_argument(
        "--screw-x", type=float, metavar="X", help="plane of the screw, from AP, + forward, m"
    )
    parser.add_argument(
        "--shaft-spacing", type=float, metavar="M", help="between the shafts of two screws, m"
    )
    parser.add_argument(
        "--boss-diameter", type=float, metavar="D", help="of the stern boss at its aft face, m"
    )
    parser.add_argument(
        "--boss-x",
        type=float,
        metavar="X",
        help="aft face of the stern boss, from AP, + forward, m",
    )


def screw_of(arguments: argparse.Namespace) -> Screw | None:
    """Take what is told of the screw; height and diameter go together, others need both."""
    from assoc_hull.analysis.form.screw import Screw

    given = {
        "height": arguments.shaft_height, "diameter": arguments.propeller_diameter,
        "x": arguments.screw_x, "spacing": arguments.shaft_spacing,
        "boss_diameter": arguments.boss_diameter, "boss_x": arguments.boss_x,
    }  # fmt: skip
    told: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    if not told:
        return None
    for name, option in (("height", "--shaft-height"), ("diameter", "--propeller-diameter")):
        if name not in told:
            what = f"the screw is told without {option}"
            raise BadInputError(
                what, "in the call", "give height of the shaft and diameter of the screw"
            )
    return Screw(**told)

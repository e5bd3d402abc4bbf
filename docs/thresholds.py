"""The thresholds by which lines are read, as a table: `python docs/thresholds.py` prints it.

`docs/site_hook.py` puts it at the mark of `docs/features_of_lines.md` when the site is built.
"""

import attrs

from assoc_hull.io.lines.slices import Gaps
from assoc_hull.io.slicing.features import FeatureRules

PAGE = "features_of_lines.md"
MARK = "<!-- thresholds -->\n"
MEANINGS = {
    "CornerRule": (
        "`least_deg` over `stretch`; `share` of it on half; sides are fitted over `window`"
    ),
    "ChainRule": (
        "`lines` that must agree; a knuckle moves by at most `drift` of their distance and "
        "`slack`, its turn by the factor `ratio`"
    ),
    "StraightRunRule": (
        "`within`, or `scatters` times the noise; `least` and `least_part`; `growth`; "
        "`confidence` of arc against gradual onset"
    ),
    "ArcRule": (
        "`within`, or `scatters` times the noise; `least_deg`, `least_depth`; `growth`, `step`, "
        "`trend`; `uncertainty` of the radius"
    ),
    "FeatureRules": (
        "`alone_deg`: least turn of a corner outside a knuckle line; `onset`: largest "
        "uncertainty of a tangent point or a place of a knuckle curve; `border`: that of the end "
        "of a flat, along the line, large because a hull may leave its flat with curvature from "
        "zero; `apart`: marks of a border nearer to one another count as one; `border_deg`: "
        "borders are split at such turns; `smooth_...`: how far lines may be smoothed; "
        "`adopt_...`: default tolerance of adoption; `near_...`: a gap that weighs as much as a "
        "datum off by all that is allowed"
    ),
    "Gaps": (
        "`join`: ends this close are joined; `refuse`: farther ones up to this are an error of a "
        "mesh"
    ),
}


def tables() -> str:
    """Give each rule with its values and their meaning."""
    rules = FeatureRules()
    lines = ["| rule | values | meaning |", "|---|---|---|"]
    for rule in (rules.corner, rules.chain, rules.run, rules.arc, rules, Gaps()):
        found = attrs.asdict(rule, recurse=False).items()
        values = [f"`{name}` {value:g}" for name, value in found if isinstance(value, float | int)]
        name = type(rule).__name__
        lines.append(f"| `{name}` | {', '.join(values)} | {MEANINGS[name]} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(tables())

"""A plain ship by definitions: curve of areas, waterline, contour, deck, flats and angles."""

from __future__ import annotations

from collections.abc import Mapping

from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.tables import Particulars

PARTICULARS = Particulars("plain ship", 180.0, 28.0, 15.6, 10.5)


def course(name: str, nodes: Mapping[str, tuple[float, ...]], rule: str = "form") -> FormDefinition:
    """Make a course of nodes (x, y, angle); its use is its name."""
    fields = ("x", "y", "angle_deg", "curvature", "tangent", "leave_angle_deg")
    values = {
        f"{label}_{field}": value
        for label, given in nodes.items()
        for field, value in zip(fields, given, strict=False)
    }
    return FormDefinition(name.replace("_", " "), name, "course", values, rule, [*nodes])


AREAS = FormDefinition(
    "areas", "sectional_area", "halves", {
        "full": 292.59, "run_start_ordinate": 6.08 / 292.59, "run_start_angle_deg": 25.0,
        "run_start_tangent": 0.067, "run_end": -0.208, "run_end_tangent": 0.298,
        "run_area": 0.511, "run_centroid": -0.488, "entrance_start": 0.34,
        "entrance_start_tangent": 0.222, "entrance_area": 0.44822854506305754,
        "entrance_centroid": 0.5840017464346738, "entrance_end_angle_deg": -54.0,
        "entrance_end_tangent": 0.053,
    },
)  # fmt: skip

WATERLINE = FormDefinition(
    "waterline", "design_waterline", "halves", {
        "full": 14.0, "run_start_ordinate": 0.35, "run_start_angle_deg": 58.0, "run_end": -0.35,
        "run_area": 0.55, "run_centroid": -0.634, "entrance_start": 0.45,
        "entrance_area": 0.41, "entrance_centroid": 0.675, "entrance_end_angle_deg": -70.0,
    },
)  # fmt: skip

COURSES = (
    course("profile", {
        "transom": (-4.0, 10.8), "counter": (1.0, 8.6, -30.0), "heel": (9.0, 0.0, 0.0),
        "forefoot": (172.0, 0.0, 0.0), "stem": (180.0, 10.5, 85.0), "top": (181.5, 17.5, 75.0)}),
    course("deck_side", {
        "transom": (-4.0, 10.5), "quarter": (40.0, 14.0, 0.0), "bow": (150.0, 14.0, 0.0),
        "stem": (181.5, 0.0, -80.0)}),
    course("deck_height", {
        "aft": (-4.0, 16.0, 0.0), "waist": (60.0, 15.6, 0.0), "fore": (130.0, 15.6, 0.0),
        "bow": (181.5, 17.5)}, "monotone"),
    course("keel_angle", {
        "aft": (-4.0, 86.0), "run": (9.0, 20.0), "shoulder": (50.0, 80.0), "mid": (70.0, 90.0),
        "fore": (122.0, 90.0), "ent": (160.0, 80.0), "bow": (181.5, 20.0)}, "monotone"),
    course("waterline_angle", {
        "aft": (-4.0, 45.0), "run": (20.0, 30.0), "mid": (60.0, 0.0), "fore": (130.0, 0.0),
        "bow": (181.5, 30.0)}, "monotone"),
    course("flat_of_bottom", {
        "aft": (40.0, 0.0), "mid": (71.28, 12.1875), "fore": (120.6, 12.1875),
        "bow": (165.0, 0.0)}, "monotone"),
    course("flat_of_side", {
        "top": (46.0, 15.0), "water": (58.5, 10.5), "aft": (71.28, 1.8125),
        "fore": (120.6, 1.8125), "bow": (130.5, 10.5), "ahead": (140.0, 15.0)}, "monotone"),
    course("bilge_radius", {"mid": (90.0, 1.8125)}),
)  # fmt: skip


def plain_ship(*others: FormDefinition, without: tuple[str, ...] = ()) -> Forms:
    """Give the definitions; others stand in for those of the same use."""
    chosen = {each.use: each for each in (AREAS, WATERLINE, *COURSES, *others)}
    return Forms.of([each for use, each in chosen.items() if use not in without], PARTICULARS)

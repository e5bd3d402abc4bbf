"""Draw the pictures of the documentation: `python docs/make_images.py [name ...]`.

Everything drawn is computed from the shipped hulls; nothing is drawn by hand but boxes and
arrows. Needs the extra `plot`. Each picture stays below 150 kB. Those of the Duisburg Test Case
need its mesh, which does not come with the package: ASSOC_HULL_DATA names the folder that
holds `dtc/DTC-scaled.stl.gz`.
"""

import os
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from drawings.battens import classical_splines
from drawings.biarcs import biarc_kinds
from drawings.choi_lee import example_bossing, example_ends
from drawings.closed_mesh import closed_mesh_stern
from drawings.common import ship
from drawings.comparison import comparison
from drawings.conics import combined_waterline, conformal_sections
from drawings.container import (
    container_ship_225m,
    container_ship_225m_bodies,
    container_ship_225m_bulb,
)
from drawings.created import bulk_carrier_180m, bulk_carrier_180m_parent
from drawings.curvature import (
    curvature_lines,
    curvature_mixed,
    curvature_typical,
    plate_flat,
)
from drawings.curves import completions, knuckle_end
from drawings.dtc import dtc, dtc_report
from drawings.dxf import lines_plan_dxf
from drawings.edits import pinned_or_field, pull
from drawings.hull_plates import hull_plates, hull_surface
from drawings.imports import bad_imports
from drawings.net import crossing, levels, roles
from drawings.production import production_arcs_picture
from drawings.sections import generated_sections
from drawings.shifts import section_shifts
from drawings.stern import (
    bulk_carrier,
    carrier_combs,
    counter,
    led_buttocks,
    stern_faired,
    stern_heat,
)
from drawings.story import bossing_lines, bossing_profile
from drawings.variant import variant_areas, variant_plan
from drawings.variation import rounded_hat, variation_fields
from matplotlib import pyplot as plt
from matplotlib.figure import Figure
from PIL import Image

import assoc_hull as ah
from assoc_hull.analysis.form.curve_transform import curve_transform
from assoc_hull.analysis.form.floating_shape import Screw
from assoc_hull.analysis.form.form_parameters import form_report
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatic_table
from assoc_hull.analysis.panels.hull_panels import panels
from assoc_hull.analysis.stability.flooding import FloodingPoint
from assoc_hull.analysis.stability.stability_report import stability
from assoc_hull.creation.form_curve import FormCurve
from assoc_hull.hull.sources import examples
from assoc_hull.plot import definition_curves
from assoc_hull.plot.diagrams.curve_series import curve_series
from assoc_hull.plot.diagrams.driver_graph import neighbourhood
from assoc_hull.plot.diagrams.form_curve import form_curve_picture
from assoc_hull.plot.diagrams.form_report import form_sheets
from assoc_hull.plot.diagrams.hydrostatics import hydrostatic_curves
from assoc_hull.plot.diagrams.stability import lever_picture
from assoc_hull.plot.diagrams.study import study_scatter
from assoc_hull.plot.lines_plan.plan import lines_plan
from assoc_hull.plot.plates.panel_plan import panel_plan

FOLDER = Path(__file__).parent / "images"
LARGEST = 150_000


def plan() -> Figure:
    """Draw the lines plan of Series 60 CB 0.70."""
    return lines_plan(ship(), paper="A4")


def one_way() -> Figure:
    """Draw what drives a waterline of a hull whose sections do not follow it."""
    hull = examples.wigley()
    with hull.edit("first lines") as edit:
        edit.associate("sections", "waterlines", two_way=False)
    return neighbourhood(hull, "WL 2.5", paper="A4")


def curves() -> Figure:
    """Draw the hydrostatic curves of Series 60 CB 0.70."""
    draughts = [1.0 + 0.5 * k for k in range(17)]
    table = hydrostatic_table(examples.series60(cb=0.70), draughts, estimate=False)
    return hydrostatic_curves(table, paper="A4")


def form_sheet() -> Figure:
    """Draw the first page of the form parameters of the bulk carrier."""
    screw = Screw(height=5.0, diameter=8.6, x=5.2)
    report = form_report(examples.bulk_carrier_207k(), screw=screw, date="2026-01-31")
    return form_sheets(report)[0].figure


def levers() -> Figure:
    """Draw the righting levers of Series 60 CB 0.70."""
    vent = FloodingPoint("engine room vent", (30.0, 4.0, 11.5))
    hull = examples.series60(cb=0.70)
    found = stability(hull, weight=10_600.0, lcg=61.5, kg=6.9, trim="free", flooding=[vent])
    return lever_picture(found, paper="A4")


def series() -> Figure:
    """Draw the sectional-area curve of Series 60 CB 0.70 and its Chebyshev series."""
    areas = curve_transform(examples.series60(cb=0.70), "sectional areas", terms=24, draught=7.0)
    return curve_series(areas, terms=8)


def form_curve() -> Figure:
    """Draw the run of a curve of sectional areas: type 1 of Kim & Kang 1992."""
    run = FormCurve.of(
        (-1.0, 0.0), (-0.3, 1.0), start_angle_deg=60.0, start_curvature=-2.0,
        finish_angle_deg=0.0, area=0.55, centroid=-0.59,
    )  # fmt: skip
    return form_curve_picture(run, title="Run, type 1")


def mesh() -> Figure:
    """Draw 800 panels of half the bulk carrier, trimmed by the stern."""
    return panel_plan(panels(examples.bulk_carrier_207k(), draughts=(20.0, 17.0), count=800))


def study_front() -> Figure:
    """Draw 64 variants of Wigley's hull: wetted surface and KM_T, and which are the best."""
    drawn = ah.study.sample({"breadth": (9.5, 10.5), "draught": (5.9, 6.6)}, 64, seed=1)
    parent = examples.wigley(stations=9, waterlines=6)
    made = parent.study(set=drawn, outputs=["kmt", "wetted_surface"])
    better = {"kmt": "more", "wetted_surface": "less"}
    return study_scatter(made, "wetted_surface", "kmt", better=better)


def resistance_curve() -> Figure:
    """Draw the parts of the resistance of the bulk carrier over its speed."""
    found = examples.bulk_carrier_207k().resistance(np.linspace(8.0, 16.0, 33), c_stern=10)
    figure, axes = plt.subplots(figsize=(7.0, 3.6), layout="constrained")
    parts = {"friction and form": found.friction + found.form, "correlation": found.correlation}
    parts |= {"bulb": found.bulb, "waves": found.waves}
    axes.stackplot(found.speeds, *parts.values(), labels=list(parts))
    axes.set(xlabel="speed, kn", ylabel="resistance, kN", xlim=(8.0, 16.0))
    axes.legend(loc="upper left", frameon=False)
    return figure


def plain_ship() -> Figure:
    """Draw the lines plan of the plain ship, which is created from form parameters."""
    return lines_plan(examples.plain_ship(), paper="A4")


def six_numbers() -> Figure:
    """Draw the lines plan of a cargo ship from six numbers and a type."""
    hull = ah.create(
        length=100.0, breadth=16.0, draught=6.5, depth=9.0, cb=0.70, lcb=0.0, type="general cargo"
    )
    return lines_plan(hull, paper="A4")


def trawler() -> Figure:
    """Draw the lines plan of a trawler from six numbers."""
    hull = ah.create(
        length=40.0, breadth=9.5, draught=4.0, depth=6.0, cb=0.56, lcb_percent=-2.0, type="trawler"
    )
    return lines_plan(hull, paper="A4")


def history_change() -> Figure:
    """Draw what two edits have changed since the first state, 50 times as large."""
    hull = examples.wigley()
    before = hull.plot.snapshot()
    with hull.edit("fuller shoulder") as edit:
        edit.pull("WL 2.5 x ST 12", d=0.02, radius=(12.0, 3.0))
    with hull.edit("finer run") as edit:
        edit.move("WL 2.5 x ST 4", y=2.04)
    return hull.plot.before_after(before, exaggerate=50, paper="A4")


def prelikon_ship() -> Figure:
    """Draw the lines plan of the supply ship of main types."""
    return lines_plan(examples.prelikon_ship(), paper="A4")


def seaking_ship() -> Figure:
    """Draw the lines plan of the coaster of lines along the hull."""
    return lines_plan(examples.seaking_ship(), paper="A4")


def sfolds_ship() -> Figure:
    """Draw the lines plan of the ferry of portions."""
    return lines_plan(examples.sfolds_ship(), paper="A4")


def definitions() -> Figure:
    """Draw the definitions of the plain ship."""
    return definition_curves(examples.plain_ship().state, paper="A4")


PICTURES: dict[str, Callable[[], Figure]] = {
    "plain_ship": plain_ship,
    "six_numbers": six_numbers,
    "trawler": trawler,
    "history_change": history_change,
    "definitions": definitions,
    "prelikon_ship": prelikon_ship,
    "seaking_ship": seaking_ship,
    "sfolds_ship": sfolds_ship,
    "series60": plan,
    "hydrostatic_curves": curves,
    "form_sheet": form_sheet,
    "righting_levers": levers,
    "curve_series": series,
    "panels": mesh,
    "study_front": study_front,
    "resistance": resistance_curve,
    "closed_mesh": closed_mesh_stern,
    "form_curve": form_curve,
    "biarcs": biarc_kinds,
    "production_arcs": production_arcs_picture,
    "combined_waterline": combined_waterline,
    "conformal_sections": conformal_sections,
    "classical_splines": classical_splines,
    "crossing": crossing,
    "roles": roles,
    "pull": pull,
    "pinned_or_field": pinned_or_field,
    "levels": levels,
    "one_way": one_way,
    "spline": knuckle_end,
    "completions": completions,
    "bulk_carrier": bulk_carrier,
    "counter": counter,
    "led_buttocks": led_buttocks,
    "stern_heat": stern_heat,
    "stern_faired": stern_faired,
    "carrier_combs": carrier_combs,
    "variation_fields": variation_fields,
    "rounded_hat": rounded_hat,
    "section_shifts": section_shifts,
    "generated_sections": generated_sections,
    "bulk_carrier_180m": bulk_carrier_180m,
    "bulk_carrier_180m_parent": bulk_carrier_180m_parent,
    "container_ship_225m": container_ship_225m,
    "container_ship_225m_bulb": container_ship_225m_bulb,
    "dtc_beside_created": container_ship_225m_bodies,
    "comparison": comparison,
    "variant_areas": variant_areas,
    "variant_plan": variant_plan,
    "bossing_profile": bossing_profile,
    "example_bossing": example_bossing,
    "example_ends": example_ends,
    "bossing_lines": bossing_lines,
    "curvature_typical": curvature_typical,
    "curvature_mixed": curvature_mixed,
    "curvature_lines": curvature_lines,
    "plate_flat": plate_flat,
    "hull_plates": hull_plates,
    "hull_surface": hull_surface,
    "lines_plan_dxf": lines_plan_dxf,
    "bad_imports": bad_imports,
    "dtc": dtc,
    "dtc_report": dtc_report,
}
DPI = {"series60": 110, "bulk_carrier": 110, "bulk_carrier_180m": 110, "dtc": 110,
       "container_ship_225m": 110, "dtc_report": 110, "carrier_combs": 96,
       "counter": 116, "stern_heat": 108, "stern_faired": 108, "comparison": 110,
       "variant_plan": 110, "form_sheet": 100, "panels": 105, "closed_mesh": 105,
       "hull_plates": 62, "hull_surface": 105}  # fmt: skip
PLANS = ("series60", "bulk_carrier", "bulk_carrier_180m", "container_ship_225m", "dtc")
COLOURS = {
    **dict.fromkeys(PLANS, 16),
    "closed_mesh": 40,
    "plate_flat": 0,
    "hull_plates": 64,
    "hull_surface": 48,
}  # 0: all
COLOURS |= dict.fromkeys(("carrier_combs", "counter", "stern_heat", "stern_faired"), 48)
COLOURS |= dict.fromkeys(("form_curve", "curvature_lines", "lines_plan_dxf"), 256)


def few_colours(image: Image.Image, count: int) -> Image.Image:
    """Give a picture in as many colours: the commonest as they are, the others near to theirs.

    The usual method drops colours of few pixels: classes of a legend, a thin blue line.
    """
    half = count // 2
    found = image.getcolors(image.width * image.height) or []
    common = [colour for _, colour in sorted(found, key=lambda each: (-each[0], each[1]))[:half]]
    rest = image.quantize(count - half, Image.Quantize.MAXCOVERAGE).getpalette() or []
    palette = Image.new("P", (1, 1))
    palette.putpalette([part for colour in common for part in colour] + rest[: 3 * (count - half)])
    return image.quantize(palette=palette, dither=Image.Dither.NONE)


def write(name: str) -> int:
    """Draw one picture, take its colours down to a palette, give its size in bytes."""
    figure = PICTURES[name]()
    path = FOLDER / f"{name}.png"
    dpi = DPI.get(name, 120)
    figure.savefig(path, dpi=dpi, facecolor="white", bbox_inches=None)
    plt.close(figure)
    colours = COLOURS.get(name, 64)
    with Image.open(path) as image:
        plain = image.convert("RGB")
        (few_colours(plain, colours) if colours else plain).save(path, optimize=True)
    return path.stat().st_size


def main(names: list[str]) -> int:
    """Draw the pictures that are named, or all; tell their sizes."""
    FOLDER.mkdir(exist_ok=True)
    heavy = 0
    if not names and "ASSOC_HULL_DATA" not in os.environ:
        print("ASSOC_HULL_DATA is not set: the pictures of the DTC stay as they are")
        names = [name for name in PICTURES if not name.startswith("dtc")]
    for name in names or PICTURES:
        size = write(name)
        heavy += size > LARGEST
        print(f"{name}.png: {size / 1000:.0f} kB" + (" (too large)" if size > LARGEST else ""))
    return int(heavy > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Whatever is handed to the public interface: an error of the family, or a result."""

from __future__ import annotations

import contextlib
import inspect
import warnings
from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any, cast

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.derivatives.parameters import DRAUGHT
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
from assoc_hull.arguments import pair
from assoc_hull.creation.classical.middle_body import MiddleBody, Midship
from assoc_hull.creation.classical.prelikon import Prelikon, require_types
from assoc_hull.creation.classical.prelikon_lines import Station
from assoc_hull.creation.classical.seaking import Seaking
from assoc_hull.creation.classical.seaking_parts import DeckCamber, MidshipSection, ParallelPart
from assoc_hull.creation.classical.sfolds import Sfolds
from assoc_hull.creation.classical.sfolds_portion import (
    Portion,
    require_portions_apart,
    three_eighths_rule,
)
from assoc_hull.edit.session import Edit
from assoc_hull.geometry.classical.appendages import AppendageBox, LoftedAppendage
from assoc_hull.geometry.classical.arc_curve import round_corners, through_points
from assoc_hull.geometry.classical.boundary_lines import CodedKnuckleLine, KeelOutline, SpaceCurve
from assoc_hull.geometry.classical.camber import Camber, CamberKind
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.classical.deck import Deck, DeckHouse, Sheer
from assoc_hull.geometry.classical.frame_section import FrameSection, deck_corner, run_bends
from assoc_hull.geometry.classical.ordinate_section import OrdinateSection, PairedParabolas
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline
from assoc_hull.hull.sources import Examples
from assoc_hull.io.cad.write import write_cad
from assoc_hull.io.classical.read import holds_definition, read_definition
from assoc_hull.io.iges.write import write_iges_lines
from assoc_hull.io.mesh.closed_mesh import write_mesh
from assoc_hull.io.surfaces.hull_surface import write_surface
from assoc_hull.plot.plates.hull_map import hull_map
from assoc_hull.plot.plates.lit_surface import surface_figure
from assoc_hull.surface.cells.closed_mesh import closed_mesh
from assoc_hull.surface.plating.hull_plates import hull_plates
from assoc_hull.surface.plating.surface_plates import Seams
from tests.cut_hulls import three_blocks
from tests.formed import formed

POINT, LINE, CURVE = "WL 2.5 x ST 3", "WL 2.5", "ST 3"
PLACE = (40.0, 3.0, 2.5)
BENT = [(0.0, 0.0), (1.0, 0.1), (2.0, 0.4), (3.0, 0.9), (4.0, 1.6), (5.0, 2.5), (6.0, 3.6)]

BAD: dict[str, Any] = {
    "None": None,
    "text": "a",
    "text with an ending": "a.hull.json",
    "nan": float("nan"),
    "inf": float("inf"),
    "minus one": -1,
    "huge": 10**400,
    "complex": 1j,
    "bytes": b"a",
    "empty list": [],
    "list of a number": [1],
    "list of text": ["move"],
    "ragged list": [1, [2], 3],
    "mapping": {},
    "object": object(),
    "class": type,
    "flat array": np.zeros(4),
    "deep array": np.zeros((2, 2, 2)),
    "empty places": np.zeros((0, 3)),
    "nan places": np.full((2, 3), np.nan),
    "array of text": np.array(["a", "b"]),
}

SMALL = ah.examples.wigley(stations=5, waterlines=4)

Given = dict[str, Any]

FAIR: Given = {
    "lines": [LINE], "noise": 1e-3, "tolerance": None, "at": POINT, "radius": (20.0, 5.0),
    "keep": (), "hold": (), "since": None,
}  # fmt: skip
HULL: dict[str, Given] = {
    "from_lines": {
        "lines": [], "particulars": ah.Particulars("a", 1.0, 1.0, 1.0, 1.0),
        "associations": [], "tolerances": None,
    },
    "edit": {
        "name": "a", "policy": "all_or_nothing", "gaps": "refuse", "author": "anna", "wait": 1.0
    },
    "preview": {
        "edits": [], "policy": "all_or_nothing", "gaps": "refuse", "name": "a", "why": [POINT],
        "shapes": False, "measure": False,
    },
    "drag": {
        "point": POINT, "how": "pull", "radius": (20.0, 5.0), "across_flats": False,
        "policy": "all_or_nothing", "gaps": "refuse",
    },
    "fair": {**FAIR, "name": "a", "dry_run": True},
    "fair_window": {"at": POINT, "radius": (20.0, 5.0)},
    "shapes": {},
    "since": {"number": 0},
    "apply": {"name": "a", "edits": []},
    "undo": {"n": 0, "author": None},
    "snapshot": {},
    "design": {},
    "redo": {"n": 0},
    "find": {"address": POINT},
    "why": {"thing": POINT, "step": None, "least": 1e-4},
    "check": {"notes": False},
    "verify": {"relative": 0.0},
    "graph": {"around": POINT, "up": 1, "down": 1, "only": "two-way", "step": None},
    "meet": {"line": "WL 2.5", "plane": None, "x": 40.0, "y": None, "z": None},
    "dependencies": {"points": False},
    "half_breadth": {"x": 40.0, "z": 2.5},
    "tunnel": {"name": "thruster", "x": 40.0, "z": 2.5, "radius": 0.5},
    "save": {"path": "no-such-folder/a.hull.json", "replace": False},
    "refresh": {},
    "close": {},
    "detach": {},
    "checkpoint": {"name": "here"},
    "go": {"name": "nowhere"},
    "diff": {"before": "nowhere", "after": None},
    "replay": {"other": None, "skip": False},
    "report": {"path": "no-such-folder/a.xlsx", "parts": ("areas",), "draught": 4.0,
               "draughts": (4.0, 5.0), "kg": 4.0, "flooding": (), "rho": 1.0, "shell_factor": 1.0,
               "appendages": (), "on_error": "refuse", "surface": None, "plates": None,
               "title": "t", "date": None},
    "export": {"path": "no-such-folder/a.dxf", "form": None, "unit": None,
               "scale": None, "half": False, "points": None, "accept": False,
               "leave_out": ()},
}  # fmt: skip
EDIT: dict[str, Given] = {
    "fair": FAIR,
    "move": {"point": POINT, "x": None, "y": 3.0, "z": None, "by": None, "lead": True},
    "insert": {"curve": LINE, "place": PLACE, "lead": True},
    "delete": {"point": POINT},
    "set_kind": {"point": POINT, "kind": "tangent", "direction": (1.0, 0.0, 0.0)},
    "pin": {"point": POINT},
    "unpin": {"point": POINT},
    "pull": {
        "point": POINT, "d": 0.01, "radius": (20.0, 5.0), "across_flats": False, "fair": False,
    },
    "reshape": {
        "curve": LINE, "points": [PLACE], "span": (30.0, 60.0), "fade": "auto",
        "across_flats": False, "fair": False,
    },
    "lead": {"line": LINE, "points": [PLACE], "span": (30.0, 60.0)},
    "straighten": {"line": LINE, "a": POINT, "b": "WL 2.5 x ST 5", "fade": "auto"},
    "round": {
        "line": LINE, "a": POINT, "b": "WL 2.5 x ST 5", "radius": 90.0, "fade": (20.0, 5.0),
    },
    "spread": {"point": POINT, "length": 40.0, "fade": "auto"},
    "set_end": {"curve": LINE, "end": "start", "tangent": None, "curvature": None},
    "set_role": {"crossing": POINT, "role": "drives a"},
    "renew_roles": {"lines": [LINE]},
    "associate": {"a": "sections", "b": "waterlines", "two_way": True},
    "dissociate": {"a": "sections", "b": "waterlines"},
    "rule": {"a": "waterlines", "b": "sections", "where": [("waterlines", {"x": (0.0, 40.0)})]},
    "group": {"name": "stern lines", "lines": [LINE]},
    "regroup": {"group": "stern lines", "lines": [LINE]},
    "ungroup": {"group": "stern lines"},
    "rename": {"obj": LINE, "name": "low"},
    "set_particulars": {"draught": 6.0, "deck": "closed"},
    "add_line": {"group": "waterlines", "position": 2.0, "name": "low"},
    "shift_line": {"line": LINE, "position": 2.4},
    "remove_line": {"line": LINE},
    "knuckle_line": {
        "name": "chine", "points": ["ST 3 x WL 2.5", "ST 4 x WL 2.5", "ST 5 x WL 2.5"],
    },
    "remove_knuckle_line": {"line": LINE},
    "tunnel": {"name": "thruster", "x": 40.0, "z": 2.5, "radius": 0.5},
    "set_tunnel": {"name": "thruster", "x": 40.0, "z": 2.5, "radius": 0.5},
    "remove_tunnel": {"name": "thruster"},
    "body": {
        "name": "hatch", "group": "hatches", "x": (40.0, 50.0), "y": (-3.0, 3.0),
        "z": (10.0, 11.0), "sections": None, "corners": None, "both": False, "sign": 1,
    },
    "set_body": {
        "name": "hatch", "by": (1.0, 0.0, 0.0), "group": "hatches", "x": None, "y": None,
        "z": None, "sections": None, "corners": None, "both": False, "sign": 1,
    },
    "remove_body": {"name": "hatch"},
    "set_form": {"definition": "areas", "values": 0.5},
    "reattach": {"line": CURVE},
    "transform": {
        "mapping": None, "drivers": ["sections"], "scale": (1.0, 1.1, 1.0), "shift": None,
        "planes": "stay", "jacobian": None, "tolerance": 2e-3,
    },
}  # fmt: skip
CURVES: dict[str, Given] = {
    "at": {"t": 1.0},
    "tangent": {"t": 1.0},
    "curvature": {"t": 1.0},
    "closest": {"p": PLACE},
    "polyline": {"per_segment": 8},
    "meet": {"plane": ((1.0, 0.0, 0.0), 40.0)},
}
LINES: dict[str, Given] = {"meet": {"plane": ((1.0, 0.0, 0.0), 40.0)}}
SHIP = ah.Particulars("a", 100.0, 16.0, 9.0, 6.0)
HALVES: Given = {
    "run_end": -0.2, "entrance_start": 0.2, "run_area": 0.45, "run_centroid": -0.5,
    "run_start_angle_deg": 40.0, "entrance_end_angle_deg": -45.0,
}  # fmt: skip
ANGLES: Given = {"use": "keel_angle", "nodes": {"AP": (0.0, 45.0), "FP": (100.0, 30.0)}}
SADDLE = np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]])
PLATE = ah.surface.SplineSurface.bezier(SADDLE)
MAKERS: dict[str, tuple[Callable[..., object], Given]] = {
    "open": (ah.open, {"path": "a"}),
    "doctor": (
        ah.doctor,
        {"path": "a", "top": 3, "centre": None, "mend": None, "replace": False},
    ),
    "sample": (
        ah.study.sample,
        {"ranges": {"breadth": (9.0, 11.0)}, "count": 2, "seed": 0, "method": "latin"},
    ),
    "read": (
        ah.read,
        {
            "path": "a",
            "length": 1.0,
            "breadth": 1.0,
            "draught": 1.0,
            "scale": 1.0,
            "stations": 41,
            "waterlines": 20,
            "buttocks": 12,
            "unit": "auto",
            "axes": "auto",
            "tolerance": 0.01,
        },
    ),
    "wigley": (
        ah.examples.wigley,
        {"length": 90.0, "breadth": 9.0, "draught": 5.0, "stations": 9, "waterlines": 6},
    ),
    "series60": (ah.examples.series60, {"cb": 0.7}),
    "Hull": (ah.Hull, {"state": None}),
    "Plane": (ah.Plane, {"normal": (1.0, 0.0, 0.0), "offset": 1.0}),
    "Plane.across": (ah.Plane.across, {"axis": "x", "offset": 1.0}),
    "Association": (ah.Association, {"a": "a", "b": "b", "two_way": True}),
    "Particulars": (
        ah.Particulars,
        {
            "name": "a",
            "length": 9.0,
            "breadth": 2.0,
            "depth": 2.0,
            "draught": 1.0,
            "deck": "closed",
        },
    ),
    "Ends": (ah.Ends, {"kind": (0, 0), "vector": ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))}),
    "BoundaryKind": (ah.BoundaryKind, {"value": 0}),
    "PointKind": (ah.PointKind, {"value": 0}),
    "Tolerances": (
        ah.Tolerances,
        {field.name: field.default for field in attrs.fields(ah.Tolerances)},
    ),
    "Appendage": (
        ah.hydro.Appendage,
        {"name": "a", "volume": 1.0, "centroid": PLACE, "area": 1.0},
    ),
    "FloodingPoint": (ah.hydro.FloodingPoint, {"name": "a", "place": PLACE, "both_sides": True}),
    "Screw": (
        ah.form.Screw,
        {
            "height": 2.0,
            "diameter": 3.0,
            "x": None,
            "spacing": 0.0,
            "boss_diameter": None,
            "boss_x": None,
        },
    ),
    "FormDefinition": (
        ah.creation.FormDefinition,
        {
            "name": "a",
            "use": "keel_angle",
            "kind": "course",
            "values": {"AP_x": 0.0},
            "rule": "straight",
            "nodes": ("AP",),
        },
    ),
    "Design": (
        ah.creation.Design,
        {
            "particulars": SHIP,
            "definitions": (),
            "stations": (1.0,),
            "waterlines": (1.0,),
            "buttocks": (1.0,),
            "transom": None,
            "tolerances": ah.Tolerances(),
        },
    ),
    "Design.from_json": (ah.creation.Design.from_json, {"source": "{}"}),
    "create": (ah.create, {"design": None}),
    "SplineSurface": (
        ah.surface.SplineSurface,
        {
            "name": "a",
            "degrees": (1, 1),
            "knots_u": [0, 0, 1, 1],
            "knots_v": [0, 0, 1, 1],
            "net": SADDLE,
            "weights": None,
        },
    ),
    "SplineSurface.bezier": (
        ah.surface.SplineSurface.bezier,
        {"net": SADDLE, "name": "a", "weights": np.ones((2, 2))},
    ),
    "SplineSurface.at": (PLATE.at, {"u": 0.5, "v": [0.0, 1.0]}),
    "SplineSurface.patches": (PLATE.patches, {"number": 0}),
    "SplineSurface.restricted": (PLATE.restricted, {"u": (0.0, 0.5), "v": (0.0, 1.0), "name": "a"}),
    "curvature_regions": (
        ah.surface.curvature_regions,
        {
            "surfaces": SADDLE,
            "zero": "absolute",
            "strain_tol": 1e-3,
            "breadth": 2.5,
            "k0": 1e-3,
            "delta": 1e-9,
            "area_tol": 1e-3,
            "depth": 8,
            "budget": 600,
            "chord_tol": 0.1,
            "levels": (-0.2,),
            "previous": None,
        },
    ),
    "plates": (
        ah.surface.plates,
        {
            "surfaces": SADDLE,
            "seams": None,
            "zero": "absolute",
            "strain_tol": 1e-3,
            "breadth": 2.5,
            "k0": 1e-3,
            "delta": 1e-9,
            "sagitta_tol": 0.003,
            "sagitta_length": None,
            "share": 0.95,
            "suggestions": None,
            "area_tol": 1e-3,
            "depth": 8,
            "budget": 600,
            "chord_tol": 0.1,
            "previous": None,
        },
    ),
    "plates.of a hull": (
        hull_plates,
        {
            "surface": (PLATE,),
            "seams": ah.surface.HullSeams(x=0.5),
            "zero": "absolute",
            "strain_tol": 1e-3,
            "breadth": 2.5,
            "k0": 1e-3,
            "sagitta_tol": 0.003,
            "sagitta_length": None,
            "share": 0.95,
            "suggestions": None,
            "others": (),
            "previous": None,
        },
    ),
    "HullSeams": (ah.surface.HullSeams, {"x": 0.5, "z": (1.0, 2.0), "girth": (), "inside": True}),
    "plates.surface_figure": (
        surface_figure,
        {"surface": 3, "path": None, "title": "a", "paper": "A4"},
    ),
    "plates.hull_map": (hull_map, {"found": None, "path": None, "title": "a", "paper": "A4"}),
    "read_surfaces": (ah.surface.read_surfaces, {"path": "a", "unit": "m"}),
    "surface.write_cad": (
        write_cad,
        {
            "surfaces": three_blocks(),
            "path": "a.igs",
            "form": "iges-surfaces",
            "unit": "m",
            "half": True,
            "name": "hull",
        },
    ),
    "surface.write_iges_lines": (
        write_iges_lines,
        {
            "state": ah.examples.wigley().state,
            "path": "a.igs",
            "unit": "m",
            "half": True,
            "families": ["sections"],
        },
    ),
    "closed_mesh.write_mesh": (
        write_mesh,
        {
            "mesh": closed_mesh(SMALL, points=2),
            "path": "a.ply",
            "form": None,
            "unit": "m",
            "name": "a",
        },
    ),
    "HullSurface.below": (SMALL.surface().below, {"draught": 5.0}),
    "surface.write_surface": (
        write_surface,
        {"found": SMALL.surface(), "path": "a.ply", "form": None, "unit": None, "half": True},
    ),
    "read_classical": (ah.creation.read_classical, {"path": "a"}),
    "course": (ah.creation.course, {**ANGLES, "rule": "form", "name": None}),
    "sectional_area": (
        ah.creation.sectional_area,
        {
            "particulars": SHIP,
            "cm": 0.97,
            "cb": 0.62,
            "cp": None,
            "lcb": -0.4,
            "name": "a",
            **HALVES,
        },
    ),
    "design_waterline": (
        ah.creation.design_waterline,
        {"particulars": SHIP, "cw": 0.7, "lcf": -0.4, "name": "a", **HALVES},
    ),
    "LineSource.make": (
        ah.LineSource.make,
        {
            "group": "waterlines",
            "name": "a",
            "points": [(0, 0, 1), (5, 2, 1), (9, 0, 1)],
            "family": None,
            "plane": None,
            "boundary": None,
            "kind": None,
            "direction": None,
            "ends": None,
            "placed": False,
            "tolerance": 0.005,
        },
    ),
    "FormCurve": (ah.creation.FormCurve, {"vertices": BENT, "notes": (), "angles": (0.0, 0.0)}),
    "FormCurve.from_parameters": (
        ah.creation.FormCurve.from_parameters,
        {
            "parameters": dict(ah.creation.FormCurve(BENT).parameters),
            "tangents": None,
            "energy": "E3",
        },
    ),
    "FormCurve.of": (
        ah.creation.FormCurve.of,
        {
            "start": (0.0, 0.0),
            "finish": (4.0, 2.0),
            "start_angle_deg": 0.0,
            "finish_angle_deg": 40.0,
            "start_curvature": 0.0,
            "finish_curvature": 0.0,
            "area": 3.5,
            "centroid": None,
            "tangents": "default",
            "start_stretch": 0.0,
            "finish_stretch": 0.0,
            "energy": "E3",
        },
    ),
}
FORM_CURVES: dict[str, Given] = {
    "at": {"t": 1.0},
    "curvature": {"t": 1.0},
    "energy": {"kind": "E3"},
    "drag": {"vertex": 1, "to": (0.1, 0.2), "keep": ("area", "centroid")},
    "scaled": {"a": 2.0, "b": 3.0},
    "mirrored": {},
    "table": {},
    "document": {},
}

TERMS: Given = {
    "heel_deg": 0.0,
    "rho": 1.0,
    "shell_factor": 1.0,
    "kg": None,
    "appendages": (),
}
OPTIONS: Given = {
    **TERMS,
    "transom": False,
    "on_error": "refuse",
    "keel_thickness": 0.0,
    "draught_to": "moulded",
}
ONE: Given = {"draught": None, "draughts": None}
TWO: Given = {"demihulls": 2, "separation": 30.0}
FLOATING: dict[str, Given] = {
    "hydrostatics": {**ONE, **OPTIONS, **TWO, "estimate": False},
    "hydrostatic_table": {
        "draughts": [2.0, 4.0], "trims": (0.0,), **OPTIONS, **TWO, "estimate": False, "date": None,
    },
    "hydrostatic_derivatives": {"wrt": [DRAUGHT], **ONE, **OPTIONS},
    "freeboard": {"position": FloatingPosition(4.0, 4.0)},
    "deck_edge_angle": {"position": FloatingPosition(4.0, 4.0), "appendages": (), **TWO},
    "bonjean": {"levels": 5},
    "section_points": {"x": 40.0, "points": 5, **ONE},
    "fairness": {"lines": ["WL 2.5"], "allowed": 0, "noise": 1e-3},
    "doctor": {"top": 3, "noise": 1e-3},
    "compare": {"variant": SMALL, "draught": None, "screw": None},
    "mesh": {"half": False, "points": 2, "leave_out": ()},
    "panels": {
        **ONE, "heel_deg": 0.0, "count": None, "stations": 7, "points": 5, "spacing": "arc",
        "side": None, "knuckle_deg": None, "transom": True, "origin": None, "on_error": "refuse",
    },
    "stability": {
        "kg": 4.0, "weight": None, **ONE, "lcg": None, "tcg": 0.0, "trim": "fixed",
        "heels": (0.0,), "flooding": (), "rho": 1.0, "shell_factor": 1.0, "appendages": (),
        "on_error": "refuse", "date": None,
    },
    "cross_curves": {
        "weights": None, "draughts": (4.0,), "heels": (10.0,), "trim_by_stern": 0.0,
        "trim": "fixed", "rho": 1.0, "shell_factor": 1.0, "kg": None, "appendages": (),
        "on_error": "refuse", "date": None,
    },
    "equilibrium": {
        "weight": 500.0, "lcg": 50.0, "kg": 2.0, "tcg": 0.0, "rho": 1.0, "shell_factor": 1.0,
        "appendages": (), "on_error": "refuse",
    },
    "curve_transform": {
        "curve": "sectional areas", "kind": "chebyshev", "terms": 2, "along": None, "across": None,
        "span": None, "relative": None, **ONE, "heel_deg": 0.0,
    },
    "form_parameters": {
        **ONE, "screw": None, "rho": 1.0, "shell_factor": 1.0, "transom": False, "only": None,
        "further": (),
    },
    "immersion": {"weight": 500.0, "lcg": None, "trim_by_stern": 0.0, **TERMS},
    "jumboise": {
        "length": 5.0, "at": 50.0, "names": "keep", "name": None, "in_place": False,
    },
    "resistance": {
        "speeds": [8.0, 12.0], "method": "1984", **ONE, "c_stern": 0.0, "appendage_area": 10.0,
        "appendage_factor": 1.5, "thruster_diameter": 1.0, "thruster_coefficient": 0.005,
        "wetted_surface": 1500.0, "entrance_deg": 10.0, "bulb_area": 2.0, "bulb_height": 1.0,
        "transom_area": 1.0, "rho": 1.0, "nu": 1e-6, "roughness": 2e-4,
    },
    "measure": {"only": None},
    "production_arcs": {"lines": "WL 2.5", "within": 0.01, "least_radius": 0.0},
    "sensitivities": {
        "outputs": ["volume"], "parameters": ["breadth"], "kg": None, "layout": None
    },
    "surface": {
        "leave_out": ("WL 2.5",), "previous": None, "smoothing": None, "tolerance": None,
        "cutoff": 1e-7,
    },
    "study": {
        "set": {"breadth": 11.0}, "reach": None, "free": (), "bounds": None, "layers": (),
        "outputs": ("volume",), "layout": None, "workers": 1, "progress": None,
        "file": None, "cluster": None, "fair": False,
    },
    "shift_sections": {
        "to": None, "by": {"cb": 0.005}, "shape": "c2", "terminals": None, "fade": "b5",
        "tolerance": 2e-3, "name": None, "in_place": False,
    },
    "swing": {
        "length": None, "breadth": 10.0, "draught": None, "name": None, "in_place": False,
    },
    "vary": {
        "set": {"breadth": 11.0}, "reach": None, "free": (), "bounds": None, "exact": True,
        "layers": (), "layout": None, "drivers": None, "stations": "number", "planes": "follow",
        "tolerance": 2e-3, "fair": False, "accept": False, "name": None, "ship": None,
        "in_place": False,
    },
    "vary_by": {"script": {"set": {"breadth": 11.0}}, "ship": None, "in_place": False},
}  # fmt: skip
PLATES: Given = {  # of a hull; that method fits a surface, and then hands on all of these
    name: MAKERS["plates.of a hull"][1][name]
    for name in inspect.signature(ah.Hull.plates).parameters
    if name != "self"
}

SHEER, CAMBER = Sheer.make([(0, 1), (9, 0)]), CamberKind.make(1, 9.0, 0.3)
SECTION = OrdinateSection.make(
    hb=0, sb=1, sw=2, hd=3.5, bd=4.75, cam=0.1, zb=[0], yw=[3, 4, 5]
)  # fmt: skip
PORTION = Portion.of_areas(3, [0, 4, 8], [1, 2, 1])
SOLID = Portion.make(3, [0, 4, 8], [SECTION] * 3)
MIDSHIP = Midship(8.0, 2.0, 0.2, 1.5)
KEEL = KeelOutline.make(1, 9, [(0, 2), (1, 0)], [(9, 0), (10, 3)], [(1, 0), (9, 0)])
SIDE = CodedKnuckleLine.make([0, 10], [(8, 9), (8, 9)], [1])
FRAME = through_points([(0, 0), (4, 0), (5, 3)])
SHELL = ah.surface.plates(SADDLE, area_tol=1e-3)
CLASSICAL: dict[str, tuple[Callable[..., object], Given]] = {
    "Seams": (Seams, {"u": (0.2, 0.4), "v": 0.5}),
    "Plate.development": (SHELL[0].development, {"grid": (4, 3)}),
    "Plate.rulings": (SHELL[0].rulings, {"count": 3}),
    "Plates.column": (SHELL.column, {"name": "area"}),
    "Plates.result_of": (SHELL.result_of, {"number": 0}),
    "Plates.save": (SHELL.save, {"path": "no-such-folder/a.csv"}),
    "OrdinateSection.make": (
        OrdinateSection.make,
        {
            "hb": 0.0, "sb": 1.0, "sw": 2.0, "hd": 3.5, "bd": 4.75, "cam": 0.1, "zb": [0.0],
            "yw": [3.0, 4.0, 5.0], "nb": 0, "nw": 3, "form": "main+camber",
        },
    ),
    "OrdinateSection.area_below": (SECTION.area_below, {"z": 1.0}),
    "OrdinateSection.half_breadth": (SECTION.half_breadth, {"z": 1.0}),
    "OrdinateSection.camber": (SECTION.camber, {"y": 1.0}),
    "require_apart": (require_portions_apart, {"portions": [PORTION]}),
    "three_eighths": (three_eighths_rule, {"values": [1, 2, 3, 4], "step": 1.0}),
    "PairedParabolas.make": (
        PairedParabolas.make, {"name": "a", "first": 0.0, "step": 1.0, "values": [1, 2, 3]}
    ),
    "PairedParabolas.integral": (PORTION.curve.integral, {"first": 0.0, "last": 1.0}),
    "Portion.area": (PORTION.area, {"x": 1.0}),
    "Portion.volume_below": (SOLID.volume_below, {"z": 1.0}),
    "holds_definition": (holds_definition, {"path": "a"}),
    "read_definition": (read_definition, {"text": "SFOLDS a", "source": "a"}),
    "Sfolds.report": (Sfolds.make(SHIP, [PORTION]).report, {"state": None}),
    "Sfolds.volume_below": (Sfolds.make(SHIP, [SOLID]).volume_below, {"z": 1.0}),
    "Portion.make": (Portion.make, {"number": 3, "stations": [0.0, 4.0, 8.0], "sections": ()}),
    "Portion.of_areas": (
        Portion.of_areas, {"number": 3, "stations": [0.0, 4.0, 8.0], "areas": [1.0, 2.0, 1.0]}
    ),
    "Sfolds.make": (
        Sfolds.make,
        {
            "particulars": SHIP, "portions": [PORTION],
            "corner": 10.0, "cuts": {"waterlines": [1.0]}, "notes": (),
        },
    ),
    "MidshipSection.make": (
        MidshipSection.make,
        {
            "x": 1.0, "midship": MIDSHIP, "depth": 6.0, "rise": 0.1, "kind": "line",
            "radius": 0.2,
        },
    ),
    "Midship": (
        Midship,
        {"half_breadth": 8.0, "flat": 2.0, "rise": 0.2, "radius": 1.5, "depth": 9.0},
    ),
    "KeelOutline.make": (
        KeelOutline.make,
        {
            "x_a": 1.0, "x_b": 9.0, "aft": [(0, 2), (1, 0)], "forward": [(9, 0), (10, 3)],
            "tangent": [(1, 0), (9, 0)],
        },
    ),
    "ParallelWaterline.make": (
        ParallelWaterline.make,
        {
            "z": 1.0, "points": [(1, 0), (3, 1), (6, 1), (9, 0.5)], "aft_end": (0, 0),
            "fwd_end": (10, 0), "parallel": (3, 6), "parallel_half_breadth": 1.0,
            "end_slope": (0.2, -0.2), "method": "graph",
        },
    ),
    "KnuckleLine.make": (
        CodedKnuckleLine.make,
        {"x": [0, 4, 9], "v": [(1, 3), (2, 3), (1, 4)], "code": [2, 3], "blend": "overhauser"},
    ),
    "Camber.make": (
        Camber.make,
        {"x": [0, 9], "half_breadth": 4.0, "side_height": 3.0, "rise": 0.2, "kind": "line"},
    ),
    "Appendage.make": (
        LoftedAppendage.make, {"sections": [[(0, 0), (1, 0), (1, 1)]], "x": (0, 4), "sign": -1}
    ),
    "Frame.make": (
        FrameSection.make,
        {
            "x": 3.0, "waterline_points": [(2, 1), (3, 2)], "deck_side": (4, 6), "keel": 0.0,
            "flat": 1.0, "knuckles": [(3.5, 4)], "camber": 0.1, "camber_kind": "line",
            "corner_radius": 0.2,
        },
    ),
    "deck_corner": (
        deck_corner,
        {
            "half_breadth": 8.0, "side_height": 9.0, "rise": 0.3, "radius": 0.5,
            "side_angle": 1.5, "kind": "line", "name": "frame",
        },
    ),
    "run_bends": (
        run_bends, {"points": [(0, 0), (1, 1), (1.5, 3)], "start_angle": 0.0, "name": "frame"}
    ),
    "MiddleBody": (
        MiddleBody,
        {
            "midship": MIDSHIP, "length": 40.0, "depth": 9.0, "draught": 6.0, "stations": 5,
            "name": "body",
        },
    ),
    "Seaking": (
        Seaking,
        {
            "particulars": SHIP, "keel": KEEL, "waterlines": (), "deck": SIDE,
            "frames": np.array([2.0, 5.0]), "parallel": ParallelPart(MIDSHIP, 2.0, 6.0),
            "knuckles": (), "camber": DeckCamber(), "appendages": (), "buttocks": (1.0,),
            "told": (),
        },
    ),
    "Parallel": (ParallelPart, {"section": MIDSHIP, "first": 2.0, "last": 6.0}),
    "DeckCamber": (
        DeckCamber,
        {"rise": [(0.0, 0.2), (9.0, 0.3)], "kind": "line", "corner": [(0.0, 0.2), (9.0, 0.3)]},
    ),
    "Sheer.make": (Sheer.make, {"points": [(0, 1), (9, 0)]}),
    "CamberKind.make": (
        CamberKind.make,
        {"kind": 2, "half_breadth": 9.0, "total": 0.3, "joint": 4.0, "scale": "fixed"},
    ),
    "CamberKind.through": (
        CamberKind.through,
        {"kind": 3, "points": [(0, 0), (4, 0.1), (9, 0.3)], "scale": "fixed"},
    ),
    "Deck.make": (
        Deck.make, {"number": 1, "height": 9.0, "sheer": SHEER, "camber": CAMBER}
    ),
    "DeckHouse.make": (
        DeckHouse.make,
        {
            "decks": [Deck.make(1, 9.0, SHEER, CAMBER)], "deck": 1, "x": (1, 2), "breadth": 3.0,
            "height": 2.0, "name": "a", "deck_half_breadth": 4.0,
        },
    ),
    "AppendageBox.make": (
        AppendageBox.make,
        {"x": (1, 2), "y": (0, 1), "z": (0, 1), "sign": 1, "symmetric": True, "name": "a"},
    ),
    "through_points": (
        through_points,
        {
            "points": [(0, 0), (4, 0), (5, 3)], "kind": ["line", "arc"], "radius": [None, 9.0],
            "knuckles": [1], "name": "section",
        },
    ),
    "round_corners": (
        round_corners,
        {"points": [(0, 0), (4, 0), (5, 3)], "radius": [1.0], "name": "section"},
    ),
    "SpaceCurve.make": (
        SpaceCurve.make, {"points": [(0, 0, 0), (1, 1, 0)], "kind": "spline", "name": "a"}
    ),
    "require_types": (require_types, {"given": {1, 5}}),
    "Prelikon.make": (
        Prelikon.make,
        {
            "particulars": SHIP, "stations": [Station(x, FRAME) for x in (0.0, 9.0)], "decks": (),
            "boundaries": (), "boxes": (), "houses": (), "curves": (),
            "cuts": {"waterlines": [1.0]}, "notes": (),
        },
    ),
}  # fmt: skip
"""What definitions of a classical kind are made of; not public names of the package."""


def cases(table: dict[str, Given]) -> list[Any]:
    """Every argument of every method."""
    return [
        pytest.param(method, given, name, id=f"{method}-{name}")
        for method, given in table.items()
        for name in given
    ]


def spoilt(given: Given, name: str) -> Iterator[contextlib.AbstractContextManager[Given]]:
    """Everything bad in the place of an argument, one after another; a failure says which."""
    return (_spoilt(given, name, kind) for kind in BAD)


@contextlib.contextmanager
def _spoilt(given: Given, name: str, kind: str) -> Iterator[Given]:
    try:
        yield {**given, name: BAD[kind]}
    except BaseException as error:
        error.add_note(f"{name}: {kind}")
        raise


@pytest.fixture(scope="module", autouse=True)
def _elsewhere(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """What is written under a good name is written beside the repository."""
    with contextlib.chdir(tmp_path_factory.mktemp("elsewhere")):
        yield


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A small net; nothing here changes it for good."""
    return ah.examples.wigley(stations=9, waterlines=6)


def call(function: Callable[..., object], given: Given) -> bool:
    """Call, and tell whether an error of the family was raised; no other error may be."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            function(**given)
        except ah.AssocHullError as error:
            check(error)
            return True
    return False


def check(error: ah.AssocHullError) -> None:
    """An error is a fitting builtin too, and says it in one line of a length to be read."""
    assert isinstance(error, ValueError | TypeError | KeyError | RuntimeError)
    assert "\n" not in str(error)
    assert 10 < len(str(error)) < 400


@pytest.mark.parametrize(("method", "given", "name"), cases(HULL))
def test_a_hull_takes_nothing_amiss(hull: ah.Hull, method: str, given: Given, name: str) -> None:
    """An error of the family or a result; the hull is the same, to the bit."""
    before = hull.fingerprint
    for trial in spoilt(given, name):
        with trial as bad:
            call(getattr(hull, method), bad)
            assert hull.history == ()
    assert hull.fingerprint == before


@pytest.mark.parametrize(("method", "given", "name"), cases(EDIT))
def test_a_refused_modification_leaves_no_trace(
    hull: ah.Hull, method: str, given: Given, name: str
) -> None:
    """Caught inside the edit, which then goes on and ends: not a bit has changed."""
    for trial in spoilt(given, name):
        with trial as bad:
            assert_no_trace(hull, method, bad)


def assert_no_trace(hull: ah.Hull, method: str, given: Given) -> None:
    """Call in an edit; if it is refused the hull is as before, and else after an undo."""
    before, refused = hull.fingerprint, False
    try:
        with hull.edit("try") as edit:
            refused = call(modification(edit, method), given)
    except ah.errors.RefusedEditError as error:
        assert not refused, "what was refused in the edit makes it fail at its end"
        check(error)
    if hull.history:
        assert not refused or hull.fingerprint == before
        hull.undo()
    assert hull.fingerprint == before


def modification(edit: Edit, method: str) -> Callable[..., object]:
    """The method of an edit; values of a definition stand in a mapping of their own."""
    if method != "set_form":
        return cast("Callable[..., object]", getattr(edit, method))
    return lambda definition, values: edit.set_form(definition, run_area=values)


@pytest.mark.parametrize("name", ["definition", "values"])
def test_a_definition_takes_nothing_amiss(name: str) -> None:
    """Names and values that are none, on a hull that has definitions; it is the same after."""
    hull = ah.Hull(formed())
    for trial in spoilt(EDIT["set_form"], name):
        with trial as bad:
            assert_no_trace(hull, "set_form", bad)
    for value in BAD.values():
        assert call(lambda value=value: hull.definitions[value], {})
        assert call(lambda value=value: hull.definitions["areas"].value(value), {})
        call(lambda value=value: hull.definitions["areas"].having({"run_area": value}), {})
        assert call(lambda value=value: hull.definitions["areas"].having(value), {}) or value == {}


@pytest.mark.parametrize(("method", "given", "name"), cases(CURVES))
def test_a_curve_takes_nothing_amiss(hull: ah.Hull, method: str, given: Given, name: str) -> None:
    """Parameters and places that are none are refused."""
    curve, before = hull.find(f"{CURVE} [1]"), hull.fingerprint
    for trial in spoilt(given, name):
        with trial as bad:
            call(getattr(curve, method), bad)
    assert hull.fingerprint == before


@pytest.mark.parametrize(("method", "given", "name"), cases(FORM_CURVES))
def test_a_form_curve_takes_nothing_amiss(method: str, given: Given, name: str) -> None:
    """Nor do single values of its parameters."""
    curve = ah.creation.FormCurve(BENT)
    assert not call(getattr(curve, method), given)
    for trial in spoilt(given, name):
        with trial as bad:
            call(getattr(curve, method), bad)


@pytest.mark.parametrize("name", ah.creation.FormCurve(BENT).parameters)
def test_parameters_of_a_form_curve_are_numbers(name: str) -> None:
    """Or left to the curve, where that is possible."""
    for trial in spoilt(dict(ah.creation.FormCurve(BENT).parameters), name):
        with trial as bad:
            call(lambda bad=bad: ah.creation.FormCurve.from_parameters(bad), {})


@pytest.mark.parametrize(("method", "given", "name"), cases(LINES))
def test_a_line_takes_nothing_amiss(hull: ah.Hull, method: str, given: Given, name: str) -> None:
    """Planes that are none are refused."""
    for trial in spoilt(given, name):
        before = hull.fingerprint
        with trial as bad:
            call(getattr(hull.lines[LINE], method), bad)
            assert hull.fingerprint == before


@pytest.mark.parametrize(
    ("method", "given", "name"),
    cases({name: given for name, (_, given) in (MAKERS | CLASSICAL).items()}),
)
def test_what_is_made_is_made_of_good_values(method: str, given: Given, name: str) -> None:
    """Constructors and readers refuse what they cannot use."""
    for trial in spoilt(given, name):
        with trial as bad:
            make(method, bad)


def make(method: str, given: Given) -> None:
    """Call a constructor or reader with what may be no value for it."""
    function = (MAKERS | CLASSICAL)[method][0]
    if method in ("BoundaryKind", "PointKind"):
        value = given["value"]
        # An enumeration compares arrays before it asks its class what is missing.
        call(lambda: function(value), {}) if not isinstance(value, np.ndarray) else None
        return
    call(function, given)


@pytest.mark.parametrize(("method", "given", "name"), cases(FLOATING))
def test_a_hull_is_measured_by_good_values(
    hull: ah.Hull, method: str, given: Given, name: str
) -> None:
    """An error of the family or a result; the hull is the same, to the bit."""
    before = hull.fingerprint
    for trial in spoilt(given, name):
        with trial as bad:
            call(getattr(hull, method), bad)
    assert hull.fingerprint == before


@pytest.mark.parametrize("method", FLOATING)
def test_what_is_measured_is_a_hull(hull: ah.Hull, method: str) -> None:
    """Anything else is of the wrong type: its tables, and the class, too."""
    function, given = getattr(ah.Hull, method), FLOATING[method]
    assert not call(lambda: function(hull, **given), {})
    for value in (*BAD.values(), hull.state, ah.Hull):
        with pytest.raises(TypeError, match=r"the hull is a \w+, .*give a Hull") as caught:
            function(value, **given)
        assert isinstance(caught.value, ah.errors.BadInputError)


@pytest.mark.parametrize("name", ["parent", "variant", "draught", "screw"])
def test_two_hulls_are_compared_by_good_values(hull: ah.Hull, name: str) -> None:
    """An error of the family or a comparison; neither hull changes."""
    before = hull.fingerprint
    given = {"parent": hull, "variant": hull, "draught": None, "screw": None}
    for trial in spoilt(given, name):
        with trial as bad:
            call(ah.variation.compare, bad)
    assert hull.fingerprint == before
    assert set(inspect.signature(ah.variation.compare).parameters) == set(given)


@pytest.mark.parametrize("name", ["of", "lines", "allowed", "offsets", "tolerances", "noise"])
def test_fairness_is_asked_for_with_good_values(hull: ah.Hull, name: str) -> None:
    """Of a hull and of a plane curve: an error of the family or a result."""
    before = hull.fingerprint
    curve = PlaneArcs.make([(0.0, 0.0)], [0.0], [0.1], [3.0])
    of_hull: Given = {"of": hull, "lines": ["WL 2.5"], "offsets": None, "noise": 1e-3}
    of_curve: Given = {"of": curve, "lines": None, "offsets": [(1.0, 0.1)], "noise": None}
    for given in (of_hull, of_curve):
        given = {**given, "allowed": 0, "tolerances": 0.005}
        assert not call(ah.form.fairness, given)
        for trial in spoilt(given, name):
            with trial as bad:
                call(ah.form.fairness, bad)
    assert hull.fingerprint == before
    assert set(inspect.signature(ah.form.fairness).parameters) == set(given)


@pytest.mark.parametrize("name", ["groups", "lines", "points", "crossings"])
@pytest.mark.parametrize("value", BAD.values(), ids=BAD)
def test_a_mapping_knows_no_such_name(hull: ah.Hull, name: str, value: Any) -> None:
    """Whatever is asked for."""
    assert call(lambda: getattr(hull, name)[value], {})
    assert call(lambda: hull.groups["waterlines"].lines[value], {})


@pytest.mark.parametrize("kind", [ah.Group, ah.Line, ah.Curve, ah.Point, ah.Crossing])
@pytest.mark.parametrize("value", BAD.values(), ids=BAD)
def test_a_handle_is_made_of_tables_and_a_number(hull: ah.Hull, kind: Any, value: object) -> None:
    """What is no hull's tables, or no row of them, is refused."""
    assert call(lambda: kind.of(value, 0), {})
    assert call(lambda: kind.of(hull.state, value), {}) or isinstance(value, np.ndarray)


@pytest.mark.parametrize(
    ("kind", "table"),
    [
        (ah.Hull, HULL | FLOATING | {"plates": PLATES}),
        (Edit, EDIT),
        (ah.Curve, CURVES),
        (ah.Line, LINES),
        (
            ah.creation.FormCurve,
            {**FORM_CURVES, "from_parameters": {"parameters", "tangents", "energy"}},
        ),
    ],
    ids=["Hull", "Edit", "Curve", "Line", "FormCurve"],
)
def test_every_public_method_is_tried(kind: type, table: dict[str, Given]) -> None:
    """With all its arguments; the ways to make handles stand in a test of their own."""
    public = {
        name: set(inspect.signature(getattr(kind, name)).parameters) - {"self"}
        for name in dir(kind)
        if not name.startswith("_") and callable(getattr(kind, name)) and name != "of"
    }
    assert public == {name: set(given) for name, given in table.items()}


def test_every_public_name_is_tried() -> None:
    """What can be called stands in a table above; errors are for the package to raise."""
    tried = {name.partition(".")[0] for name in MAKERS} - {"wigley", "series60"}
    handles = {"Group", "Line", "Curve", "Point", "Crossing"}
    there = {name: getattr(ah, name) for name in ah.__all__}
    for home in ah._MOVED.values():  # once here, too; methods stand in the test before
        package, _, name = home.partition("assoc_hull.")[2].partition("(")[0].partition(".")
        if package:
            there[name] = getattr(getattr(ah, package), name)
    public = {
        name
        for name, found in there.items()
        if callable(found)
        and not isinstance(found, ModuleType)
        and not (isinstance(found, type) and issubclass(found, Exception))
    }
    tried -= {"closed_mesh", "surface"}  # results of methods
    tried |= {"compare", "fairness", "Study"}  # a study is made by `study`; see test_bad_targets
    tried |= {"widget"}  # see test_widget
    assert public == tried | handles
    made = {name for name in dir(Examples) if name[0] != "_"}
    takes_nothing = {"bulk_carrier_207k", "bulk_carrier_180m", "container_ship_225m", "plain_ship"}
    takes_nothing |= {"seaking_ship", "sfolds_ship", "prelikon_ship", "typical_plates"}
    assert made == {"wigley", "series60"} | takes_nothing


@pytest.mark.parametrize(
    "given",
    [
        lambda hull: hull.hydrostatics(draught="5"),
        lambda hull: hull.hydrostatic_table(["4", "5"]),
        lambda hull: hull.stability(kg=np.str_("4")),
        lambda hull: hull.resistance([10.0], c_stern="10"),
        lambda hull: hull.edit("a").move("ST 5 x WL 2.5", y="4"),
        lambda _: pair(("10", 3.0), "radius", positive=True),
        lambda _: ah.read("offsets.csv", length=cast("float", "45")),
    ],
    ids=["one", "some", "of numpy", "a field", "a coordinate", "a pair", "an import"],
)
def test_a_text_is_no_number_anywhere(hull: ah.Hull, given: Callable[[Any], Any]) -> None:
    """One mistake has one answer: "3,5" and "5 m" would have to be guessed."""
    with pytest.raises(ah.errors.BadInputError, match="give numbers, not text: without quotes"):
        given(hull)

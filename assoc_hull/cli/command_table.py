"""The table of all commands: what each does in a line, and where it is made.

It imports nothing, so that help and a mistyped name cost nothing; of a command only its own module
is loaded.
"""

from __future__ import annotations

import attrs

__all__ = ["COMMANDS", "GROUPS", "SYNONYMS", "Command"]


@attrs.frozen
class Command:
    """A command: one sentence about it, and the function of a module that adds it to a parser."""

    about: str
    module: str
    adder: str


GROUPS: dict[str, dict[str, Command]] = {
    "begin": {
        "demo": Command("do the main job on a shipped hull, with pictures", "demo", "add_demo"),
        "example": Command(
            "write a hull, or shell plates, that ship with the program",
            "make_hull",
            "add_example_and_import",
        ),
        "import": Command(
            "make a hull from offsets, a mesh, surfaces or lines",
            "make_hull",
            "add_example_and_import",
        ),
        "doctor": Command(
            "look for slips of the hand in a table of offsets, or for wrong points of a hull",
            "doctor",
            "add_doctor",
        ),
        "create": Command(
            "make a hull from a design: definitions by form parameters",
            "make_hull",
            "add_create",
        ),
        "classical": Command(
            "tell volumes, areas and centroids of a classical definition",
            "make_hull",
            "add_classical",
        ),
        "curve": Command(
            "make a form-parameter curve; exit 1 if a condition is violated",
            "form_parameters",
            "add_curve",
        ),
    },
    "look": {
        "info": Command("tell what a hull holds", "inspection", "add_inspection"),
        "check": Command(
            "tell what is wrong with a hull; exit 1 if anything is",
            "inspection",
            "add_inspection",
        ),
        "verify": Command(
            "rebuild a hull from its definition and compare; exit 1 if it differs",
            "inspection",
            "add_inspection",
        ),
        "history": Command("list the edits, checkpoints and branches", "edits", "add_history"),
        "diff": Command("tell how two states differ", "edits", "add_history"),
        "why": Command(
            "tell through what the last edit reached an object",
            "inspection",
            "add_why",
        ),
        "graph": Command("write objects and links as a graph", "inspection", "add_graph"),
        "plot": Command(
            "draw lines, their curvature combs, or what an edit moved",
            "inspection",
            "add_plot",
        ),
        "fairness": Command(
            "tell how fair lines are, by five criteria in numbers",
            "inspection",
            "add_fairness",
        ),
        "compare": Command("tell how a variant differs from its parent", "variants", "add_compare"),
    },
    "change": {
        "edit": Command(
            "carry out edits and let the hull follow; exit 1 if they are refused",
            "edits",
            "add_edit",
        ),
        "fair": Command(
            "take noise out of all lines together; exit 1 if it is refused",
            "fairing",
            "add_fair",
        ),
        "page": Command(
            "fair a hull by hand in the browser, on this machine only",
            "page",
            "add_page",
        ),
        "undo": Command("take back the last edits", "edits", "add_history"),
        "redo": Command("make them again", "edits", "add_history"),
        "checkpoint": Command("name the present state", "edits", "add_history"),
        "go": Command("return to a checkpoint or branch", "edits", "add_history"),
        "replay": Command(
            "make the edits of one hull again on another; exit 1 if one fails",
            "edits",
            "add_replay",
        ),
    },
    "calculate": {
        "hydrostatics": Command(
            "tell how a hull floats: volume, centres, stability at rest",
            "hydrostatics",
            "add_hydrostatics",
        ),
        "parameters": Command(
            "tell the form parameters of a hull",
            "form_parameters",
            "add_parameters",
        ),
        "stability": Command(
            "tell righting levers, and whether they meet the IMO criteria",
            "stability",
            "add_stability",
        ),
        "resistance": Command(
            "estimate the resistance in calm water by Holtrop's regression",
            "resistance",
            "add_resistance",
        ),
        "panels": Command(
            "divide the immersed hull into panels for seakeeping codes",
            "panels",
            "add_panels",
        ),
        "transform": Command(
            "give a curve as a Chebyshev, sine or Fourier series",
            "form_parameters",
            "add_transform",
        ),
    },
    "vary": {
        "vary": Command(
            "vary a hull by named parameters; exit 1 if it is refused",
            "variants",
            "add_vary",
        ),
        "shift": Command(
            "shift sections along the ship for another block or prismatic "
            "coefficient and centre of buoyancy; exit 1 if it is refused",
            "variants",
            "add_shift_and_swing",
        ),
        "swing": Command(
            "change breadth against draught, or length against both, at the same "
            "volume and coefficients; exit 1 if it is refused",
            "variants",
            "add_shift_and_swing",
        ),
        "jumboise": Command(
            "insert or take out a length of parallel body; exit 1 if it is refused",
            "variants",
            "add_shift_and_swing",
        ),
        "study": Command(
            "make many variants of a hull; exit 1 if none came to be",
            "study",
            "add_study",
        ),
        "sensitivities": Command(
            "tell how outputs change with parameters of a hull",
            "inspection",
            "add_sensitivities",
        ),
    },
    "build and exchange": {
        "surface": Command(
            "fit a surface to the lines, and tell how well it fits",
            "surface",
            "add_surface",
        ),
        "plates": Command(
            "tell how shell plates are curved, and how they may be formed",
            "plates",
            "add_plates",
        ),
        "report": Command(
            "write all that is known of a hull as one PDF, or its tables as a workbook",
            "report",
            "add_report",
        ),
        "export": Command(
            "write lines, surfaces or meshes for other programs",
            "export",
            "add_export",
        ),
    },
    "the command line itself": {
        "completion": Command(
            "print a script that lets the shell complete commands",
            "schemas",
            "add_completion_and_schema",
        ),
        "schema": Command(
            "print the JSON Schema of .hull.json files, or of other documents",
            "schemas",
            "add_completion_and_schema",
        ),
    },
}
"""By what a person wants to do, in the order of the help."""

COMMANDS = {name: command for group in GROUPS.values() for name, command in group.items()}

SYNONYMS = {
    "adopt": "import",
    "load": "import",
    "read": "import",
    "open": "info",
    "show": "info",
    "list": "info",
    "new": "create",
    "make": "create",
    "design": "create",
    "samples": "example",
    "examples": "example",
    "validate": "check",
    "test": "check",
    "log": "history",
    "revert": "undo",
    "back": "undo",
    "tag": "checkpoint",
    "save": "checkpoint",
    "checkout": "go",
    "restore": "go",
    "modify": "edit",
    "change": "edit",
    "drag": "edit HULL pull",
    "push": "edit HULL pull",
    "move": "edit HULL move",
    "pull": "edit HULL pull",
    "reshape": "edit HULL reshape",
    "insert": "edit HULL insert",
    "delete": "edit HULL delete",
    "lead": "edit HULL lead",
    "straighten": "edit HULL straighten",
    "round": "edit HULL round",
    "pin": "edit HULL pin",
    "smooth": "fair",
    "gui": "page",
    "serve": "page",
    "draw": "plot",
    "lines": "plot",
    "plan": "plot",
    "picture": "plot",
    "combs": "plot",
    "curvature": "fairness",
    "volume": "hydrostatics",
    "displacement": "hydrostatics",
    "gz": "stability",
    "levers": "stability",
    "holtrop": "resistance",
    "power": "resistance",
    "mesh": "export",
    "step": "export",
    "iges": "export",
    "stl": "export",
    "dxf": "export",
    "convert": "export",
    "write": "export",
    "booklet": "report",
    "book": "report",
    "pdf": "report",
    "document": "report",
    "scale": "vary",
    "stretch": "vary",
    "widen": "vary",
    "deepen": "vary",
    "lackenby": "shift",
    "lengthen": "jumboise",
    "optimise": "study",
    "optimize": "study",
    "variants": "study",
    "gradients": "sensitivities",
    "nurbs": "surface",
    "fit": "surface",
    "explain": "why",
}
"""Words of other programs, and the command that is meant."""

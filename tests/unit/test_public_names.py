"""What users reach by name: packages, their stubs, names that have moved, usual values."""

import ast
import inspect
import subprocess
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.analysis.derivatives.hydrostatic_derivatives import hydrostatic_derivatives
from assoc_hull.analysis.form.curve_transform import curve_transform
from assoc_hull.analysis.form.form_parameters import form_parameters
from assoc_hull.analysis.hydrostatics.draughts_from_weight import (
    deck_edge_angle,
    freeboard,
    immersion,
)
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatic_table, hydrostatics
from assoc_hull.analysis.hydrostatics.record import SALT
from assoc_hull.analysis.hydrostatics.section_areas import bonjean
from assoc_hull.analysis.panels.hull_panels import panels, section_points
from assoc_hull.analysis.resistance.holtrop_ship import NU, ROUGHNESS
from assoc_hull.analysis.resistance.hull_resistance import resistance
from assoc_hull.analysis.stability.cross_curves import cross_curves
from assoc_hull.analysis.stability.equilibrium import equilibrium
from assoc_hull.analysis.stability.stability_report import stability
from assoc_hull.surface.blocks.fit_options import CUTOFF
from assoc_hull.surface.cells.closed_mesh import closed_mesh
from assoc_hull.surface.plating.options import SAGITTA_TOL, SHARE
from assoc_hull.surface.regions.options import BREADTH, STRAIN_TOL
from assoc_hull.variation.comparing.comparison import compare
from assoc_hull.variation.parameters.parameter_measures import measure
from assoc_hull.variation.request import TOLERANCE
from assoc_hull.variation.sensitivities import sensitivities

PACKAGES = [name for name in ah._PUBLIC if name]
FACES = ["classical", "form", "hydro"]
USUAL = [
    *((name, "rho", SALT) for name in (
        "cross_curves", "equilibrium", "form_parameters", "hydrostatic_derivatives",
        "hydrostatic_table", "hydrostatics", "immersion", "resistance", "stability",
    )),
    ("resistance", "nu", NU),
    ("resistance", "roughness", ROUGHNESS),
    ("vary", "tolerance", TOLERANCE),
    ("shift_sections", "tolerance", TOLERANCE),
    ("surface", "cutoff", CUTOFF),
    ("plates", "strain_tol", STRAIN_TOL),
    ("plates", "breadth", BREADTH),
    ("plates", "sagitta_tol", SAGITTA_TOL),
    ("plates", "share", SHARE),
]  # fmt: skip
"""Methods of `Hull`, arguments, and the constant that each repeats."""
FUNCTIONS: list[Callable[..., Any]] = [
    bonjean, closed_mesh, compare, cross_curves, curve_transform, deck_edge_angle, equilibrium,
    form_parameters, freeboard, hydrostatic_derivatives, hydrostatic_table, hydrostatics,
    immersion, measure, panels, resistance, section_points, sensitivities, stability,
]  # fmt: skip
"""What methods of `Hull` call with the hull and all of their own arguments."""


def homes(package: str) -> dict[str, str]:
    """The module of each public name of a package."""
    return {name: module for module, names in ah._PUBLIC[package].items() for name in names}


def usual(function: Callable[..., Any]) -> dict[str, object]:
    """The value of each argument after the hull that need not be given, in order."""
    return {
        name: each.default
        for name, each in list(inspect.signature(function).parameters.items())[1:]
    }


@pytest.mark.parametrize("package", ah._PUBLIC)
def test_every_public_name_has_its_home(package: str) -> None:
    """What is imported late is what is public, and is there; each name is given once."""
    found = import_module(f"assoc_hull.{package}".rstrip("."))
    for name, module in homes(package).items():
        there = getattr(import_module(f"assoc_hull.{module}"), name)
        assert getattr(found, name) is there
        assert name in dir(found)
    assert len(homes(package)) == sum(map(len, ah._PUBLIC[package].values()))


def test_the_package_offers_names_and_packages() -> None:
    """In `__all__`: what has its home, the packages, and the modules that are faces."""
    packages = {*PACKAGES, *ah._FACES}
    assert set(ah.__all__) == {*homes(""), "__version__", *packages}
    assert len(ah.__all__) == len(set(ah.__all__))
    for name in packages:
        assert getattr(ah, name) is import_module(f"assoc_hull.{name}")


@pytest.mark.parametrize("face", FACES)
def test_a_face_offers_what_it_lists(face: str) -> None:
    """In a process of its own, whatever was imported before."""
    script = f"from assoc_hull.{face} import *; import assoc_hull.{face} as face\n"
    script += "assert set(face.__all__) <= set(globals())"
    subprocess.run([sys.executable, "-c", script], check=True)
    found = import_module(f"assoc_hull.{face}")
    assert len(found.__all__) == len(set(found.__all__))
    assert getattr(ah, face) is found


@pytest.mark.parametrize("package", PACKAGES)
def test_a_stub_lists_what_its_package_offers(package: str) -> None:
    """No name more, none less: type checkers and editors see the stub alone."""
    stub = Path(ah.__file__).parent / package / "__init__.pyi"
    listed = set()
    for each in ast.parse(stub.read_text(encoding="utf-8")).body:
        if isinstance(each, ast.ImportFrom):  # handed on only where it says "as" itself
            given = {name.name for name in each.names if name.asname == name.name}
            assert all(f"assoc_hull.{homes(package)[name]}" == each.module for name in given)
            listed |= given
        elif isinstance(each, ast.AnnAssign):
            assert isinstance(each.target, ast.Name)
            listed.add(each.target.id)
    assert listed == set(homes(package))


@pytest.mark.parametrize("name", ah._MOVED)
def test_a_name_that_has_moved_is_refused_with_its_new_home(name: str) -> None:
    """And the home that is named is there."""
    home = ah._MOVED[name]
    with pytest.raises(AttributeError) as caught:
        getattr(ah, name)
    assert str(caught.value) == f"assoc_hull.{name} is {home} now"
    for each in home.split(", or "):
        root, *parts = each.partition("(")[0].split(".")
        found: object = ah.Hull if root == "hull" else ah
        for part in parts:
            found = getattr(found, part)
        assert found is not ah


def test_no_name_that_has_moved_is_public_too() -> None:
    """What stands in the package is not refused."""
    assert not set(ah._MOVED) & set(ah.__all__)


@pytest.mark.parametrize("package", ah._CALLED)
def test_a_package_that_was_a_function_names_the_method(package: str) -> None:
    """Whoever calls it as before is told what to write."""
    with pytest.raises(TypeError) as caught:
        getattr(ah, package)(None)
    assert ah._CALLED[package] == f"hull.{package}(...)"
    assert str(caught.value) == (
        f"assoc_hull.{package} is a package: hull.{package}(...) is what it was"
    )
    assert callable(getattr(ah.Hull, package))


def test_another_package_is_no_function_either() -> None:
    """It never was one: the tab key does not offer it as a call."""
    assert not callable(ah.creation)


@pytest.mark.parametrize("package", [name for name in ah._PUBLIC if name])
def test_a_star_import_takes_what_is_public(package: str) -> None:
    """Also what nobody has used before."""
    taken: dict[str, object] = {}
    exec(f"from assoc_hull.{package} import *", taken)
    assert {name for names in ah._PUBLIC[package].values() for name in names} <= set(taken)


def test_the_tab_key_shows_what_is_public_and_no_more() -> None:
    """Neither machinery nor inner packages."""
    assert {name for name in dir(ah) if name[:1] != "_"} == set(ah.__all__) - {"__version__"}


def test_a_hull_answers_whether_it_has_an_address_and_is_no_sequence() -> None:
    """Python would else ask for `hull[0]`, and name an address that nobody gave."""
    hull = ah.examples.wigley(stations=5, waterlines=4)
    assert all(name in hull for name in hull.lines)
    assert "WL 99" not in hull
    with pytest.raises(TypeError, match="not iterable"):
        list(hull)  # type: ignore[call-overload]


@pytest.mark.parametrize("package", ah._PUBLIC)
def test_an_unknown_name_is_refused(package: str) -> None:
    """As by any other module."""
    found = import_module(f"assoc_hull.{package}".rstrip("."))
    with pytest.raises(AttributeError, match=rf"'{found.__name__}' has no attribute 'Ship'"):
        getattr(found, "Ship")  # noqa: B009 - the type checker knows it is not there


@pytest.mark.parametrize(("method", "argument", "constant"), USUAL)
def test_a_method_repeats_the_usual_value(method: str, argument: str, constant: float) -> None:
    """The page a user reads tells a number; it is that of the module which computes with it."""
    assert usual(getattr(ah.Hull, method))[argument] == constant


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda each: each.__name__)
def test_a_method_has_the_usual_values_of_what_it_calls(function: Callable[..., Any]) -> None:
    """The same arguments in the same order; None stands for the usual angles of heel."""
    method = {"closed_mesh": "mesh"}.get(function.__name__, function.__name__)
    given, taken = usual(getattr(ah.Hull, method)), usual(function)
    for options in (given, taken) if method in ("cross_curves", "stability") else ():
        options["heels"] = None
    assert list(given.items()) == list(taken.items())

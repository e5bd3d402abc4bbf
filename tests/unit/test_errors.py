"""The errors: what a program may rely on in every one of them."""

import builtins
import copy
import pickle
from collections.abc import Callable

import pytest

from assoc_hull import errors
from assoc_hull.errors import AssocHullError

# One sample of each error, the builtin it also is, and what its message must hold.
SAMPLES: list[tuple[AssocHullError, type[Exception], list[str]]] = [
    (
        errors.BadInputError("draught of -3 m", "argument draught", "give a depth above 0"),
        ValueError,
        ["draught of -3 m", "argument draught", "give a depth above 0"],
    ),
    (
        errors.NeedsCadError("this surface is trimmed", "in a.igs", "install the extra 'cad'"),
        ValueError,
        ["this surface is trimmed", "in a.igs", "extra 'cad'"],
    ),
    (
        errors.WrongTypeError("name is None", "in rename", "give text"),
        TypeError,
        ["name is None", "in rename", "give text"],
    ),
    (
        errors.AbsentParameterError("cannot measure 'TH'", "in measure", "ask for another"),
        KeyError,
        ["cannot measure 'TH'", "in measure", "ask for another"],
    ),
    (
        errors.RefusedSetError(
            "draught, depth cannot be had together (it folds)",
            "in vary",
            "leave out depth: the rest can be had",
            "depth",
            0.25,
            {"draught": 21.0},
        ),
        ValueError,
        ["draught, depth cannot be had together", "in vary", "leave out depth"],
    ),
    (
        errors.OutOfRangeError("draught", 19.5, "at heel 10 deg", "drowns the deck", 0.5, 9.0, "m"),
        ValueError,
        ["draught of 19.5 m", "at heel 10 deg", "drowns the deck", "from 0.5 to 9 m"],
    ),
    (errors.TooFewPointsError("curve 'WL 1'", 1), ValueError, ["curve 'WL 1'", "1", "two"]),
    (
        errors.CoincidentPointsError("curve 'ST 7'", (1.5, 2.25, 3.125), 2e-8, 1e-6),
        ValueError,
        ["curve 'ST 7'", "1.5000", "2.2500", "3.1250", "2e-08 m", "1e-06 m", "delete"],
    ),
    (
        errors.DanglingArcError(2, 0, 7, (0.125, 0.75), 3e-6),
        ArithmeticError,
        ["2 ends", "surface 0", "patch 7", "u = 0.125", "v = 0.75", "3e-06", "larger delta"],
    ),
    (
        errors.OpenNetError("V - E + F = 0", ("WL 4 x ST 10 at (1, 2, 3) m",) * 5, "mend it"),
        ValueError,
        ["V - E + F = 0", "WL 4 x ST 10 at (1, 2, 3) m", "and 1 more", "mend it"],
    ),
    (
        errors.NotSoundError("a.csv", ("gap: ST 3: 70 mm", "fold: WL 2: it folds")),
        ValueError,
        ["not sound", "gap: ST 3: 70 mm", "fold: WL 2", "in a.csv", "mend these 2", "--accept"],
    ),
    (
        errors.OpenMeshError("the volume", 12, (1.5, 2.25, 3.125), "close it"),
        RuntimeError,
        ["the volume", "12 open edges", "(1.500, 2.250, 3.125)", "close it"],
    ),
    (errors.NameTakenError("line", "WL 1"), ValueError, ["line", "'WL 1'", "choose"]),
    (
        errors.UnknownNameError("line", "WL 9", ("WL 1", "BL 2", "profile")),
        KeyError,
        ["line", "'WL 9'", "'WL 1'"],
    ),
    (
        errors.FreedomError("point 'WL 1 x ST 7'", ("x",), ("y", "z")),
        ValueError,
        ["point 'WL 1 x ST 7'", "x was asked", "give exactly y, z"],
    ),
    (
        errors.PointRoleError("point P", "driven", "curve 'ST 7'", "move the driver"),
        ValueError,
        ["point P", "driven", "computed from curve 'ST 7'", "move the driver"],
    ),
    (
        errors.BlockedRunError("WL 1", ("P", "Q", "R", "S"), "placed points", "unpin them"),
        ValueError,
        ["WL 1", "placed points (P, Q, R and 1 more)", "unpin them"],
    ),
    (errors.ForeignPointError("point P"), ValueError, ["point P", "look it up again"]),
    (
        errors.NoMeetingError("plane x = 400 m", 12.5, "choose x below 355 m"),
        ValueError,
        ["plane x = 400 m", "12.5 m", "choose x below 355 m"],
    ),
    (
        errors.DegenerateEndsError("a form-parameter curve", 0.5, 0.25),
        ValueError,
        ["a form-parameter curve", "0.5", "0.25", "tangent length"],
    ),
    (
        errors.NoMiddleVertexError("a form-parameter curve", 0.55, -0.3, -0.45, -1e-4),
        ValueError,
        ["a form-parameter curve", "area 0.55", "centroid -0.3", "-0.45 down"],
    ),
    (
        errors.GeometryError(
            "midship: R=20 exceeds the limit 14.3", "give a smaller R", {"R": 20.0}, "line 4 of a"
        ),
        ValueError,
        ["midship: R=20", "14.3", "line 4 of a", "give a smaller R"],
    ),
    (errors.RingError(("A", "B", "A")), ValueError, ["A -> B -> A", "two-way"]),
    (
        errors.RefusedEditError("fair WL 1", ("gap of 3 mm at ST 7", "gap of 2 mm at ST 8")),
        RuntimeError,
        ["'fair WL 1'", "unchanged", "gap of 3 mm at ST 7", "1 more"],
    ),
    (
        errors.FoldError(
            "folds",
            "Z_z",
            -0.036,
            0.05,
            (5.625, 0.0, 7.813),
            "local fields",
            "shaft_height",
            (("shaft+r", 4.73), ("T", 10.8)),
            4.37,
            (0.9533, 9.0467),
            fair=(3.21, 6.5),
        ),
        ValueError,
        [
            "folds at x=5.625 z=7.813 (heights come out -0.036 times as far apart) between "
            "'shaft+r' (4.730) and 'T' (10.800), node x=4.370; admissible shaft_height from 0.954 "
            "to 9.046 m, with fair lines from 3.21 to 6.5 m"
        ],
    ),
    (
        errors.FoldError("thin", "D", 0.0312, 0.05, (5.6, 2.5, 7.8), "bilge_radius"),
        ValueError,
        [
            "'bilge_radius' leaves less than 0.05 at x=5.600 y=2.500 z=7.800 (areas in profile "
            "come out 0.031 times as large); ask for less"
        ],
    ),
    (
        errors.TooFewFreeError(3, 2),
        ValueError,
        ["3 targets need at least 3 free parameters", "(2 given)", "only with exact=False"],
    ),
    (
        errors.DependentTargetsError(("LCB", "LCF"), 3.2e7),
        ValueError,
        ["aim: targets LCB and LCF move together (condition 3e7); drop one or free another"],
    ),
    (
        errors.UnreachableError(
            "volume", "m3", 57238.76, 52698.21, 52035.24, ("fore_shift", "aft_shift")
        ),
        ValueError,
        [
            "volume cannot be brought to 57238.8 m3: the nearest is 52698.2 m3 "
            "(8.73 % of the parent's value less than asked), "
            "with fore_shift and aft_shift at their bounds; widen them, free another parameter"
        ],
    ),
    (
        errors.MissingExtraError("matplotlib", "plot"),
        ImportError,
        ["matplotlib", "pip install 'assoc-hull[plot]'"],
    ),
    (
        errors.DamagedFileError("it is cut off: 4096 of 8192 bytes", "at ship.hull", "take a copy"),
        ValueError,
        ["4096 of 8192", "ship.hull", "take a copy"],
    ),
    (
        errors.HullFileError("ship.hull", "the disk is full", "make room"),
        OSError,
        ["ship.hull", "the disk is full", "make room"],
    ),
    (errors.FileBusyError("ship.hull", 2.5), TimeoutError, ["ship.hull", "2.5 s", "longer wait"]),
    (errors.StudyBusyError("study.sqlite", 0.0), TimeoutError, ["study.sqlite", "another file"]),
    (
        errors.ClusterError("tcp://a:8786", "the scheduler has gone away", "begin it again"),
        ConnectionError,
        ["tcp://a:8786", "the scheduler has gone away", "begin it again"],
    ),
    (
        errors.HullBusyError("the edit 'fuller'", "anna", 2.5, "in the edit 'finer'"),
        TimeoutError,
        ["'fuller'", "anna", "2.5 s", "'finer'", "longer wait"],
    ),
    (
        errors.StaleHullError("ship.hull", ("fair WL 1", "fair WL 2")),
        RuntimeError,
        ["ship.hull", "2 edit", "'fair WL 2'", "refresh()"],
    ),
]
each_error = pytest.mark.parametrize(
    "error", [pytest.param(sample[0], id=type(sample[0]).__name__) for sample in SAMPLES]
)


def fields(error: AssocHullError) -> dict[str, object]:
    """The public facts that an error carries."""
    return {name: value for name, value in vars(error).items() if not name.startswith("_")}


def test_every_error_has_a_sample_here() -> None:
    """An error without a sample would escape the tests below."""
    sampled = {type(sample[0]).__name__ for sample in SAMPLES}
    assert sampled | {"AssocHullError"} == set(errors.__all__)


@pytest.mark.parametrize(
    ("error", "builtin"),
    [pytest.param(error, builtin, id=type(error).__name__) for error, builtin, _ in SAMPLES],
)
def test_an_error_is_of_the_family_and_the_fitting_builtin(
    error: AssocHullError, builtin: type[Exception]
) -> None:
    """A caller may catch the family, or the builtin without knowing the package."""
    assert isinstance(error, AssocHullError)
    assert isinstance(error, builtin)
    assert getattr(builtins, builtin.__name__) is builtin


@pytest.mark.parametrize(
    ("error", "parts"),
    [pytest.param(error, parts, id=type(error).__name__) for error, _, parts in SAMPLES],
)
def test_a_message_says_what_where_how_much_and_what_to_do(
    error: AssocHullError, parts: list[str]
) -> None:
    """The message holds the fields with their numbers, in one line."""
    message = str(error)
    assert [part for part in parts if part not in message] == []
    assert "\n" not in message


@each_error
def test_an_error_has_a_docstring_of_its_own(error: AssocHullError) -> None:
    """`help` on an error says when it is raised."""
    assert type(error).__dict__["__doc__"]


@each_error
def test_an_error_is_told_by_the_path_of_its_import(error: AssocHullError) -> None:
    """In tracebacks too, whichever module of the package it is written in."""
    assert type(error).__module__ == errors.__name__


@each_error
def test_an_error_survives_pickling(error: AssocHullError) -> None:
    """An error raised in a worker process arrives with its facts."""
    twin = pickle.loads(pickle.dumps(error))
    assert type(twin) is type(error)
    assert fields(twin) == fields(error) != {}
    assert str(twin) == str(error)


@each_error
@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy], ids=["shallow", "deep"])
def test_an_error_can_be_copied(
    error: AssocHullError, copied: Callable[[AssocHullError], AssocHullError]
) -> None:
    """A copy is another error that says the same."""
    twin = copied(error)
    assert twin is not error
    assert type(twin) is type(error)
    assert fields(twin) == fields(error)


@each_error
def test_equal_facts_do_not_make_one_error_of_two(error: AssocHullError) -> None:
    """Errors compare by identity, as exceptions do, so that each can be a key."""
    twin = copy.copy(error)
    assert twin != error
    assert len({twin, error}) == 2


@pytest.mark.parametrize(
    ("error", "message"),
    [
        pytest.param(
            errors.UnknownNameError("line", "profile"),
            "there is no line named 'profile'; there is none of any name",
            id="unknown name with nothing there",
        ),
        pytest.param(
            errors.UnknownNameError("line", "Q", tuple(f"ST {k}" for k in range(10))),
            "there is no line named 'Q'; there are 'ST 0', 'ST 1', 'ST 2', 'ST 3', 'ST 4', 'ST 5', "
            "'ST 6', 'ST 7' and 2 more",
            id="unknown name with nothing near",
        ),
        pytest.param(
            errors.PointRoleError("point P", "watched", None, "give it back to the rule"),
            "point P is watched; give it back to the rule",
            id="role without a driver",
        ),
        pytest.param(
            errors.FreedomError("point P", (), ()),
            "point P is free along nothing, and nothing was asked; give exactly nothing",
            id="no freedom at all",
        ),
        pytest.param(
            errors.RefusedEditError("move", ("gap of 3 mm",)),
            "edit 'move' refused, the hull is unchanged: gap of 3 mm",
            id="a single finding",
        ),
    ],
)
def test_a_message_reads_well_without_its_optional_part(
    error: AssocHullError, message: str
) -> None:
    """What is absent leaves no gap in the sentence."""
    assert str(error) == message


def test_ends_of_an_interval_are_told_rounded_inward() -> None:
    """What is told can be had, and rounding of sums is not told."""
    error = errors.OutOfRangeError("a draught", 30.0, "at T", "", -0.0038470618, 8.2000002, "m")
    assert "give one from -0.00384 to 8.2 m" in str(error)
    exact = errors.OutOfRangeError("a draught", 30.0, "at T", "", 0.1, 0.1 + 0.2, "m")
    assert "from 0.1 to 0.3 m" in str(exact)
    close = errors.OutOfRangeError("a draught", 3.0, "at T", "", 1.0000001, 1.0000004, "m")
    assert "from 1.0000001 to 1.0000004 m" in str(close)

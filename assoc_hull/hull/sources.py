"""Where hulls come from: the examples, a design, a file that was saved, a file of another form.

Examples
--------
>>> from assoc_hull.hull.sources import examples
>>> examples.wigley()
<Hull Wigley, 31 lines, 0 edits>
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import attrs

from assoc_hull.arguments import (
    file_path,
    flag,
    instance,
    not_negative,
    number,
    positive,
    regular_file,
    shown,
    text,
)
from assoc_hull.errors import BadInputError, OutOfRangeError, RefusedEditError
from assoc_hull.hull.hull import Hull

if TYPE_CHECKING:
    from assoc_hull.creation.classical.classical_net import ClassicalDefinition
    from assoc_hull.creation.design import Design
    from assoc_hull.creation.six_numbers import SixNumbers, TypedDesign
    from assoc_hull.geometry.patches.spline_surface import SplineSurface
    from assoc_hull.io.importing.import_hull import ImportReport
    from assoc_hull.io.slicing.cut_planes import Places
    from assoc_hull.model.tables import HullState

__all__ = [
    "Examples",
    "create",
    "examples",
    "imported_hull",
    "open",
    "read",
    "read_classical",
    "read_surfaces",
]


class Examples:
    """Hulls that come with the package, one method each, and some shell plates."""

    def wigley(
        self,
        length: float = 100.0,
        breadth: float = 10.0,
        draught: float = 6.25,
        *,
        stations: int = 21,
        waterlines: int = 11,
    ) -> Hull:
        """Make the Wigley hull; see `assoc_hull.shipped.wigley`."""
        from assoc_hull.shipped.wigley import wigley

        return Hull(wigley(length, breadth, draught, stations=stations, waterlines=waterlines))

    def series60(self, cb: float = 0.70) -> Hull:
        """Make a Series 60 parent, CB 0.60 or 0.70; see `assoc_hull.shipped.series60`."""
        from assoc_hull.shipped.series60 import series60_net

        state, report = series60_net(cb)
        hull = Hull(state)
        hull.adoption = report
        return hull

    def bulk_carrier_207k(self) -> Hull:
        """Make a 207,000 TDW bulk carrier; see `assoc_hull.shipped.bulk_carrier_207k`."""
        from assoc_hull.shipped.bulk_carrier_207k import bulk_carrier_207k_net

        state, report = bulk_carrier_207k_net()
        hull = Hull(state)
        hull.adoption = report
        return hull

    def bulk_carrier_180m(self) -> Hull:
        """Create a bulk carrier by form parameters; see `assoc_hull.shipped.bulk_carrier_180m`."""
        from assoc_hull.shipped.bulk_carrier_180m import bulk_carrier_180m_design

        return create(bulk_carrier_180m_design())

    def container_ship_225m(self) -> Hull:
        """Create a container ship by form parameters, with a bulb.

        See `assoc_hull.shipped.container_ship_225m`.
        """
        from assoc_hull.shipped.container_ship_225m import container_ship_225m_design

        return create(container_ship_225m_design())

    def plain_ship(self) -> Hull:
        """Create a plain cargo ship of few definitions; see `assoc_hull.shipped.plain_ship`."""
        from assoc_hull.shipped.plain_ship import plain_ship_design

        return create(plain_ship_design())

    def seaking_ship(self) -> Hull:
        """Make a coaster of lines along the ship; see `docs/seaking.md`."""
        return _classical("seaking_ship")

    def sfolds_ship(self) -> Hull:
        """Make a ferry of portions and sections by ordinates; see `docs/sfolds.md`."""
        return _classical("sfolds_ship")

    def prelikon_ship(self) -> Hull:
        """Make a supply ship of sections of lines and arcs, with a deck; see `docs/prelikon.md`."""
        return _classical("prelikon_ship")

    def typical_plates(self) -> tuple[SplineSurface, ...]:
        """Give six shell plates; see `assoc_hull.shipped.typical_plates`."""
        from assoc_hull.shipped.typical_plates import typical_plates

        return typical_plates()


def _classical(name: str) -> Hull:
    from assoc_hull.shipped.classical_ships import classical_ship

    return create(classical_ship(name))


examples = Examples()


def create(
    design: Design | ClassicalDefinition | None = None,
    *,
    length: float | None = None,
    breadth: float | None = None,
    draught: float | None = None,
    depth: float | None = None,
    cb: float | None = None,
    lcb: float | None = None,
    lcb_percent: float | None = None,
    type: str = "bulk carrier",
    cm: float | None = None,
    bilge_radius: float | None = None,
    cw: float | None = None,
    name: str | None = None,
) -> Hull:
    """Create a hull from a design, from six numbers, or from a classical definition.

    Of a classical definition (`read_classical`) the net is made: its sections and boundary lines
    adopted, waterlines and buttocks cut; ``definition.report(hull.state)`` sets both side by side.
    Of a design, sections have the areas of the design's curve of areas. All points of sections,
    profile and deck edge are generated by the definitions, which belong to the hull from now on:
    ``hull.definitions`` holds them, ``edit.set_form`` changes them, ``hull.creation`` sets the
    net beside them. S.Y. Kim, S.W. Kang, "Ship Lines Creation by B-Spline Form Parameter
    Method", Trans. SNAK 29(2), 1992.

    Of six numbers and a type, a design of the type is carried to these dimensions and its curve of
    areas is swung to `cb` and `lcb`; the net has both by its own hydrostatics. ``hull.notes``
    tells where each other value comes from.

    Parameters
    ----------
    design : Design, definition or None
        Particulars, definitions, and where lines are to stand; or what `read_classical` gives.
        None for a ship from six numbers, which are given by name.
    length : float, m
        Between perpendiculars.
    breadth, draught, depth : float, m
        Moulded; `depth` to the deck edge amidships, all heights from the base line.
    cb : float
        Block coefficient, on the length between perpendiculars.
    lcb, lcb_percent : float, m and % of the length
        Centre of buoyancy from midship, forward positive; one of them.
    type : str
        ``"bulk carrier"``, ``"tanker"``, ``"container ship"``, ``"general cargo"`` or ``"ro-ro"``.
    cm : float or None
        Midship section coefficient; by a formula if neither it nor `bilge_radius` is given.
    bilge_radius : float or None, m
        In the place of `cm`.
    cw : float or None
        Waterplane coefficient between the ends of the design waterline.
    name : str or None
        Of the ship; its type and length if None.

    Returns
    -------
    Hull

    Raises
    ------
    BadInputError, OutOfRangeError
        Definitions of which no section can be made at a station: station, what is wanted and
        what can be are named. Of six numbers: one is missing, or far out of the range of the type;
        `cb` and `lcb` fight, and the error tells what each may be beside the other; a type that
        cannot be made well.
    GeometryError
        A classical definition of which no line can be made.
    RefusedEditError
        A waterline or a buttock that cannot be cut fairly; the error names it.
    UnknownNameError
        Of a type.

    References
    ----------
    S.Y. Kim, S.W. Kang, "Ship Lines Creation by B-Spline Form Parameter Method", Trans. SNAK 29(2),
    1992. The formulas of other values are in ``hull.notes``.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> hull = ah.create(
    ...     length=100.0, breadth=16.0, draught=6.5, depth=9.0, cb=0.70, lcb=0.0,
    ...     type="general cargo",
    ... )
    >>> round(hull.hydrostatics().cb, 5)
    0.7
    """
    from assoc_hull.creation.classical.classical_net import classical_net
    from assoc_hull.creation.design import Design
    from assoc_hull.creation.design_net import build_net
    from assoc_hull.io.classical.read import is_definition

    six = {"length": length, "breadth": breadth, "draught": draught, "depth": depth, "cb": cb}
    given = {"cm": cm, "bilge_radius": bilge_radius, "cw": cw}
    if design is None:
        return _from_six(type, six, lcb, lcb_percent, given, name)
    more = {**six, "lcb": lcb, "lcb_percent": lcb_percent, **given, "name": name}
    for word, value in more.items():
        if value is not None:
            what = f"{word} is given beside a design"
            raise BadInputError(what, "in create", "leave one out; a design has its own numbers")
    if is_definition(design):
        state, report = classical_net(design)
    else:
        state, report = build_net(instance(design, Design, "design", "in create"))
    hull = Hull(state)
    hull.adoption = report
    return hull


def _from_six(
    kind: str, six: dict[str, float | None], lcb: float | None, percent: float | None,
    given: dict[str, float | None], name: str | None,
) -> Hull:  # fmt: skip
    """Create a hull from six numbers, its net closed to CB and LCB."""
    from assoc_hull.creation.six_numbers import SixNumbers, design_for
    from assoc_hull.creation.six_numbers_net import build_typed, dips_below_base
    from assoc_hull.shipped.ship_types import ship_type

    where = "in a ship from six numbers"
    missing = [word for word, value in six.items() if value is None]
    if lcb is None and percent is None:
        missing.append("lcb")
    if missing:
        raise BadInputError(f"{', '.join(missing)} is missing", where, "give it, or a design")
    if lcb is not None and percent is not None:
        raise BadInputError("lcb and lcb_percent are both given", where, "leave one out")
    for word, value in {**six, "lcb": lcb, "lcb_percent": percent, **given}.items():
        # a text is a value that nobody has looked at: of a form, in other units
        if isinstance(value, str):
            what = f"{word} is the text {shown(value)}"
            raise BadInputError(what, where, "give a number, without quotes")
    numbers = {word: positive(value, word, where) for word, value in six.items()}
    if percent is not None:
        lcb = 0.01 * number(percent, "lcb_percent", where) * numbers["length"]
    asked = SixNumbers(**numbers, lcb=number(lcb, "lcb", where))
    known = {word: None if v is None else positive(v, word, where) for word, v in given.items()}
    title = None if name is None else text(name, "name", where)
    typed = design_for(ship_type(text(kind, "type", where)), asked, **known, name=title)
    try:
        state, report, typed = build_typed(typed)
        hull, typed = _closed(Hull(state), asked, typed)
        low = dips_below_base(hull.state)
    except (BadInputError, OutOfRangeError, RefusedEditError) as error:
        what = f"cb of {asked.cb:g} and lcb of {asked.lcb:g} m fight with lines of a {kind}"
        raise BadInputError(
            what, where, f"give another cb or lcb, or another type; what failed: {error}"
        ) from error
    hull.adoption, hull.notes = report, (*typed.notes, *low)
    return hull


_CLOSE = 2e-7
"""CB, and LCB in parts of the length, are met within this."""


def _closed(hull: Hull, asked: SixNumbers, typed: TypedDesign) -> tuple[Hull, TypedDesign]:
    """Give the hull with curves of areas by which its net has CB and LCB, without history.

    The net has parts beyond the ends of the curve of areas, and is a spline between stations: so
    CB and LCB as measured are not those of the curve, by some thousandths.
    """
    from assoc_hull.creation.six_numbers import with_areas
    from assoc_hull.creation.six_numbers_net import build_typed
    from assoc_hull.model.forms.closure import coefficients

    design = typed.design
    for _ in range(4):
        found = hull.hydrostatics(estimate=False)
        more = asked.cb - found.cb
        ahead = asked.lcb - (found.lcb - 0.5 * asked.length)
        if max(abs(more), abs(ahead) / asked.length) <= _CLOSE:
            break
        now = coefficients(design.definition("sectional_area"), design.particulars)
        assert now.block is not None
        areas = with_areas(design, now.block + more, now.centroid + ahead)
        before = design.definition("sectional_area").values
        changes = {name: v for name, v in areas.values.items() if v != before.get(name)}
        design = design.having(areas)
        try:
            with hull.edit("close CB and LCB") as edit:
                edit.set_form(areas.name, **changes)
        except (BadInputError, RefusedEditError):
            # A net that does not follow is made anew.
            state, _, typed = build_typed(attrs.evolve(typed, design=design), solve=False)
            hull = Hull(state)
            design = typed.design
    hull = Hull(hull.state)
    # What hydrostatics doubt is no ship: it refuses here, not when somebody asks for a volume.
    hull.hydrostatics()
    return hull, typed


def open(path: str | os.PathLike[str], *, wait: float = 0.0, damaged: bool = False) -> Hull:
    """Open a hull that was saved; nothing is computed.

    Parameters
    ----------
    path : path
        A hull file: every edit is in it before the ``with`` block of the edit is left. Or a
        ``.hull.json``: edits are in memory until they are saved.
    wait : float, s
        How long to wait while another process writes to the hull file, now and at each edit.
    damaged : bool
        Open a hull file also if its tables contradict one another: ``check`` then says how,
        and nothing else can be relied upon.

    Raises
    ------
    BadInputError, DamagedFileError, FileBusyError, HullFileError
        The file cannot be read or holds no hull; another process is writing.
    """
    from assoc_hull.io.hull_file.saving import open_document

    if not (isinstance(path, str) and path.lstrip()[:1] == "{"):
        regular_file(Path(file_path(path, "in open")))
    return Hull(
        open_document(
            path, not_negative(wait, "wait", "in open"), damaged=flag(damaged, "damaged", "in open")
        )
    )


def read(
    path: str | os.PathLike[str],
    *,
    length: float | None = None,
    breadth: float | None = None,
    draught: float | None = None,
    depth: float | None = None,
    ap: float | str | None = None,
    fp: float | str | None = None,
    base: float | str | None = None,
    waterline: float | str | None = None,
    origin: str | None = None,
    draught_aft: float | None = None,
    draught_fwd: float | None = None,
    scale: float | None = None,
    stations: Places | None = None,
    waterlines: Places | None = None,
    buttocks: Places | None = None,
    unit: str | None = None,
    axes: str | None = None,
    tolerance: float | None = None,
    join: float | None = None,
    deck: str | None = None,
    station_zero: str | None = None,
    station_spacings: int | None = None,
    frame_spacing: float | None = None,
    centre: float | str | None = None,
    deck_edge: str | None = None,
    accept: bool = False,
    strict: bool = False,
) -> Hull:
    """Read any supported format, told by content: a hull, offsets, lines, a mesh, surfaces, a text.

    The hull lives in memory, also one that was saved, with its history; `open` edits the file.
    Where base line, waterline and perpendiculars are, is found where it is not given, and each
    value found is a note in ``hull.adoption.notes`` with the evidence for it.

    Parameters
    ----------
    path : path
        A saved hull, a table of offsets (CSV, XLSX), digitised lines (CSV, DXF, curves of IGES,
        BRITFAIR, DELFTship, GHS), a mesh (STL, OBJ, PLY, also ``.gz``), surfaces (IGES, STEP) or
        a text of a classical definition (`read_classical`), which takes no options.
    length, breadth, draught, depth : float or None, m
        Lpp, moulded breadth, design draught, depth to the deck edge amidships, at full scale; of
        one of several hulls that to the bridge deck, which is cut off there.
        Not given, and not in the file: Lpp is the length and breadth that of the design
        waterline. A table in normalised form needs the first three.
    ap, fp : float or str or None
        x of the perpendiculars in the file: a number in its units, or text with a unit, as
        ``"12.5 m"``. Not given: the FP is where the stem meets the design waterline, the AP lies
        Lpp aft of it, or at the aft end of the waterline if nothing tells Lpp.
    base, waterline : float or str or None
        Heights of base line and design waterline in the file, likewise. Not given: the base line
        is z = 0 of the file, or the lowest place of the bottom amidships; z = 0 is the waterline
        if it cuts the hull; else the draught is half the height of the hull.
    origin : {"ap", "midship", "fp"} or None
        Where x = 0 of the file is.
    draught_aft, draught_fwd : float or None, m
        Design draughts at AP and FP of a hull that is designed with trim.
    scale : float or None
        Full scale over that of the file.
    stations, waterlines, buttocks : int or sequence of float, m, or None
        Planes that a mesh or surfaces are cut at, in ship axes: how many, or where.
    unit : str or None
        Unit of the numbers in the file: "m", "mm", "cm", "ft", "in"; of a table also "normalised".
    axes : str or None
        Axes of the file that point forward, to port and up, as "+x+y+z", of a mesh or surfaces.
    tolerance, join : float or None, m
        How far adopted lines may pass theirs; loose ends this close are joined. Not for tables.
    deck : {"open", "closed"} or None
        Whether there is a deck between the deck edges, which no form tells; open by default.
    station_zero : {"ap", "fp"} or None
        Perpendicular of station 0, of a table.
    station_spacings : int or None
        Station spacings between the perpendiculars, of a table: 10, 20 or others.
    frame_spacing : float or None, m
        Distance of frames, of a table whose stations are numbers of frames.
    centre : float or str or None
        y of the centre plane in the file; where several hulls stand side by side, of the one that
        is to be read.
    deck_edge : str or None
        Name of the line that is the deck edge, of digitised lines with bulwarks above it.
    accept : bool
        Take a hull that is not sound; the verdict is kept in its notes.
    strict : bool
        Refuse a hull under suspicion too.

    Returns
    -------
    Hull

    Raises
    ------
    BadInputError
        The file cannot be read, or is none of these; or an option that its form does not take, or
        that the hull contradicts.
    NotSoundError
        What was read is no sound hull, with all that was found, unless `accept`, which keeps the
        verdict in ``hull.adoption.notes`` and as a checkpoint; or under suspicion, and `strict`.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = ah.examples.wigley().export(f"{folder}/lines.csv").path
    ...     hull = ah.read(path, origin="midship", fp="50 m")
    Traceback (most recent call last):
        ...
    assoc_hull.errors.BadInputError: origin was given with ap or fp, as an argument; give \
either: both say where x = 0 is
    """
    from assoc_hull.io.classical.read import holds_definition
    from assoc_hull.io.hull_file.saving import holds_hull
    from assoc_hull.io.importing.import_hull import import_hull
    from assoc_hull.io.importing.options import ImportOptions

    file = regular_file(Path(file_path(path, "in read")))
    options = ImportOptions(
        length=length, breadth=breadth, draught=draught, depth=depth, ap=ap, fp=fp, base=base,
        waterline=waterline, origin=origin, draught_aft=draught_aft, draught_fwd=draught_fwd,
        scale=scale, stations=stations, waterlines=waterlines, buttocks=buttocks, unit=unit,
        axes=axes, tolerance=tolerance, join=join, deck=deck, station_zero=station_zero,
        station_spacings=station_spacings, frame_spacing=frame_spacing, centre=centre,
        deck_edge=deck_edge, accept=accept, strict=strict,
    )  # fmt: skip
    if holds_hull(file):
        options.refuse("a hull is read as it is", file)
        hull = open(file)
        hull.detach()
        return hull
    if holds_definition(file):
        options.refuse("a definition says all of it", file, options.of_lines())
        return _judged(create(read_classical(file)), file.name, accept=accept, strict=strict)
    return imported_hull(*import_hull(file, options))


def _judged(hull: Hull, source: str, *, accept: bool, strict: bool) -> Hull:
    """Give a hull of a definition its verdict, or refuse it as an import is refused."""
    from assoc_hull.io.importing.judge import judge_definition
    from assoc_hull.io.importing.verdict import require_sound, told_verdict

    if hull.adoption is None:
        return hull
    verdict = judge_definition(hull.state, hull.adoption)
    require_sound(verdict, source, accept=accept, strict=strict)
    notes = (*hull.adoption.notes, *told_verdict(verdict))
    hull.adoption = attrs.evolve(hull.adoption, notes=notes)
    return hull


def imported_hull(state: HullState, report: ImportReport) -> Hull:
    """Make a hull of what was imported; one that is not sound, but accepted, keeps the verdict.

    A checkpoint is the place for it: its name is saved with the history, and read by all who open
    the hull.
    """
    hull = Hull(state)
    hull.adoption = report.adoption
    if report.verdict.faults:
        told = "; ".join(map(str, report.verdict.faults))
        hull.checkpoint(f"as imported, {report.verdict}: {told}")
    return hull


def read_classical(path: str | os.PathLike[str]) -> ClassicalDefinition:
    """Read a classical definition of a whole hull: a text of cards, of one of three kinds.

    Parameters
    ----------
    path : path
        A text that begins with SEAKING (boundary data), SFOLDS (portions and sections) or PRELIKON
        (main types); `docs/classical_definitions.md` tells the cards.

    Returns
    -------
    definition
        With ``particulars``, ``notes`` of what was moved or left out, ``report()`` of its own exact
        volumes, areas and centroids; `create` makes the hull of it.

    Raises
    ------
    BadInputError
        The file cannot be read, or a card is not of its form; the line is named.
    GeometryError
        Numbers of which no hull can be made.
    """
    from assoc_hull.io.classical.read import read_definition_file

    return read_definition_file(path)


def read_surfaces(
    path: str | os.PathLike[str], unit: str | None = None
) -> tuple[SplineSurface, ...]:
    r"""Read spline surfaces: control nets from a table or JSON, or untrimmed ones from IGES.

    Which it is, the content of the file tells, not its name.

    Parameters
    ----------
    path : path
        A table with the columns ``patch,i_u,j_v,x,y,z`` (and ``w``), each patch a Bezier surface;
        JSON with degrees, knots and nets; or IGES with spline surfaces (entity 128).
    unit : {"m", "mm", "cm", "ft", "in"} or None
        Of the lengths in the file. None: as the file says; a table that says nothing is in m.

    Returns
    -------
    tuple of SplineSurface
        In the order of the file, in m; besides it has `form`, `unit` and `notes`: what of the
        file was left out or taken otherwise.

    Raises
    ------
    BadInputError
        The file cannot be read, is damaged, tells no unit, or holds surfaces of other kinds or
        trimmed ones: nothing is left out unseen.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> rows = [f"deck,{i},{j},{2 * i},{j},0" for i in (0, 1) for j in (0, 1)]
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "deck.csv"
    ...     _ = path.write_text("\n".join(["patch,i_u,j_v,x,y,z", *rows]))
    ...     (deck,) = ah.surface.read_surfaces(path)
    >>> deck.name, deck.at(0.5, 0.5).tolist()
    ('deck', [1.0, 0.5, 0.0])
    """
    from assoc_hull.io.surfaces.surface_file import read_surface_file

    return read_surface_file(path, unit)

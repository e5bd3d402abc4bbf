"""Pictures of one hull, as methods of `hull.plot`.

Each draws on a sheet of paper with scales and a block of particulars, gives the figure of
matplotlib back, and writes it where a path is named. Pictures of results, and of lines that are no
hull yet, stand in `assoc_hull.plot`.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING, Literal

import attrs

from assoc_hull.model.tables import HasState

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from assoc_hull.analysis.hydrostatics.record import HydrostaticTable
    from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
    from assoc_hull.plot.lines_plan.batten_heat import HeatName
    from assoc_hull.plot.lines_plan.drawing import Drawable, Drawing
    from assoc_hull.plot.sheet.paper import PaperName
    from assoc_hull.plot.sheet.sheet_figure import Path_
    from assoc_hull.variation.comparing.comparison import HullComparison
    from assoc_hull.variation.fields.layers import FieldLayer

__all__ = ["HullPictures"]


@attrs.frozen(eq=False)
class HullPictures:
    """Pictures of a hull.

    All methods take `path`, where to write the picture (the ending says whether PDF, SVG or PNG;
    by default it is only given back), and most `paper`, "A3", "A1" or "A4", landscape, and `title`,
    instead of the name of the ship. Some take `x`, the two stations (m) between which the lines are
    drawn, larger; and `heat`, which colours lines by the loftsman's batten: "residual", how far it
    springs off each point, mm, or "ratio", how far from those of the lines beside, over what is
    usual there: more than 3 is unfair. All raise BadInputError for an unknown paper or ending, and
    MissingExtraError where matplotlib is not installed.

    Attributes
    ----------
    hull : Hull
        The hull.
    """

    hull: HasState

    def lines_plan(
        self,
        path: Path_ | None = None,
        *,
        paper: PaperName = "A3",
        title: str | None = None,
        highlight: Collection[str] | None = None,
        heat: HeatName | None = None,
        x: tuple[float, float] | None = None,
    ) -> Figure:
        """Draw the three-view lines plan.

        The profile with the buttocks lies above the half-breadth plan with the waterlines, both on
        one scale, bow to the right. The body plan has a scale of its own, aft body on the left,
        fore body on the right; the section at half length is on both.

        Parameters
        ----------
        path, paper, title, heat, x
            As for all pictures.
        highlight : collection of str, optional
            Names of lines to be tinted.

        Returns
        -------
        matplotlib.figure.Figure
            The picture; every line has an id ``view/family/name``.

        Raises
        ------
        UnknownNameError
            A line to be tinted does not exist.
        BadInputError
            No line lies between the stations.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> plan = ah.examples.wigley().plot.lines_plan(paper="A4", highlight=["WL 2.5"])
        >>> [round(25.4 * side) for side in plan.get_size_inches().tolist()]
        [297, 210]
        """
        from assoc_hull.plot.lines_plan.plan import lines_plan

        return lines_plan(
            self.hull, path, paper=paper, title=title, highlight=highlight, heat=heat, x=x
        )

    def dirty(
        self,
        path: Path_ | None = None,
        *,
        paper: PaperName = "A3",
        title: str | None = None,
        x: tuple[float, float] | None = None,
    ) -> Figure:
        """Draw the lines plan inside an edit: what it has reached is tinted, points are dots.

        The block names what was asked for, and counts what it has reached. Outside an edit nothing
        is tinted.

        Parameters
        ----------
        path, paper, title, x
            As for all pictures.

        Raises
        ------
        BadInputError
            No line lies between the stations.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("fuller") as edit:
        ...     edit.pull("WL 2.5 x ST 7", 0.01)
        ...     figure = hull.plot.dirty(paper="A4")
        """
        from assoc_hull.plot.lines_plan.plan import dirty_plan

        return dirty_plan(self.hull, path, paper=paper, title=title, x=x)

    def combs(
        self,
        path: Path_ | None = None,
        *,
        paper: PaperName = "A3",
        title: str | None = None,
        heat: HeatName | None = None,
        x: tuple[float, float] | None = None,
    ) -> Figure:
        """Draw all lines with their curvature combs, each family in the view that shows it true.

        Teeth stand on the outside, dots are inflections. Each view has its own scale of curvature,
        such that 19 of 20 teeth are at most 6 mm long (at A3); teeth of more than 12 mm are cut.

        Parameters
        ----------
        path, paper, title, heat, x
            As for all pictures.

        Raises
        ------
        BadInputError
            No line lies between the stations.
        """
        from assoc_hull.plot.lines_plan.curvature_combs import combs_plan

        return combs_plan(self.hull, path, paper=paper, title=title, heat=heat, x=x)

    def curvature_combs(
        self,
        lines: Sequence[str],
        path: Path_ | None = None,
        *,
        scale: float | None = None,
        paper: PaperName = "A3",
        heat: HeatName | None = None,
        x: tuple[float, float] | None = None,
    ) -> Figure:
        """Draw curvature combs of named lines, a panel each; teeth stand on the outside.

        Parameters
        ----------
        lines : sequence of str
            Names of the lines.
        path, paper, heat, x
            As for all pictures.
        scale : float, 1/m, optional
            Curvature that a tooth of 10 mm on paper stands for, at all lines; by default chosen
            line by line so that 95 % of the teeth fit; how many longer ones are cut is reported.

        Raises
        ------
        BadInputError
            No line, a line that lies in no plane or not between the stations, a scale that is not
            positive.
        UnknownNameError
            A line that does not exist.
        """
        from assoc_hull.plot.lines_plan.curvature_combs import curvature_combs

        return curvature_combs(self.hull, lines, path, scale=scale, paper=paper, heat=heat, x=x)

    def snapshot(self) -> Drawing:
        """Keep the lines as they are now, for `before_after`."""
        from assoc_hull.plot.lines_plan.before_after import snapshot

        return snapshot(self.hull)

    def before_after(
        self,
        before: Drawable,
        path: Path_ | None = None,
        *,
        paper: PaperName = "A3",
        title: str | None = None,
        half_breadth: bool = False,
        exaggerate: float | None = None,
        x: tuple[float, float] | None = None,
    ) -> Figure:
        """Draw the body plan as it is over what it was.

        Lines are tinted where they moved. The largest movement, along the hull's normal, is named
        where it is: a point that slides along the hull does not count.

        Parameters
        ----------
        before : Drawing, or Hull
            What `snapshot` kept, or another hull.
        path, paper, title, x
            As for all pictures.
        half_breadth : bool
            Whether to draw the half-breadth plan below.
        exaggerate : float, optional
            How many times as large movements are drawn: in place of two lines that coincide on
            paper, teeth of the movement along the hull's normal, red out, blue in.

        Raises
        ------
        BadInputError
            A factor not above 0; no line lies between the stations.
        """
        from assoc_hull.plot.lines_plan.before_after import before_after

        return before_after(
            before, self.hull, path, paper=paper, title=title, half_breadth=half_breadth,
            exaggerate=exaggerate, x=x,
        )  # fmt: skip

    def comparison(
        self,
        variant: Drawable,
        path: Path_ | None = None,
        *,
        paper: PaperName = "A3",
        title: str | None = None,
        found: HullComparison | None = None,
        exaggerate: float | None = None,
        x: tuple[float, float] | None = None,
    ) -> Figure:
        """Draw the lines plan of a variant, red where it differs, and this hull in grey.

        Parameters
        ----------
        variant : Hull
            The other hull.
        path, paper, title, x
            As for all pictures.
        found : HullComparison, optional
            What `Hull.compare` gives of both: numbers, and the lines that moved farthest, then
            stand in the block.
        exaggerate : float, optional
            As for `before_after`.

        Raises
        ------
        BadInputError
            A factor not above 0; no line lies between the stations.
        """
        from assoc_hull.plot.lines_plan.comparison import comparison_plan

        return comparison_plan(
            self.hull, variant, path, paper=paper, title=title, found=found,
            exaggerate=exaggerate, x=x,
        )  # fmt: skip

    def adoption_deviations(
        self,
        path: Path_ | None = None,
        *,
        report: AdoptionReport | None = None,
        paper: PaperName = "A3",
        title: str | None = None,
    ) -> Figure:
        """Draw how far each adopted curve passes the line it was made of, and where.

        On the left each curve has a row: median and largest deviation (dots) and p95 (a bar from
        the median), the tolerance at the farthest place (an upright stroke), and its inflections
        before and after. On the right the largest deviations stand in the views of the hull.

        Parameters
        ----------
        path, paper, title
            As for all pictures; what has no room in the list is left out, and counted.
        report : AdoptionReport, optional
            Of the adoption; by default ``hull.adoption``.

        Raises
        ------
        BadInputError
            The hull was not made of given lines, and no report is given.
        """
        from assoc_hull.plot.lines_plan.adoption_deviations import adoption_deviations

        return adoption_deviations(self.hull, report, path, paper=paper, title=title)

    def neighbourhood(
        self, name: str, path: Path_ | None = None, *, hops: int = 1, paper: PaperName = "A3"
    ) -> Figure:
        """Draw what a curve is made from and what is made from it.

        The curve stands in the middle, the others farther out by hops, each family on one side. An
        arrow runs from what drives to what is made from it, with the number of crossings; where
        either drives the other it is black and has two heads.

        Parameters
        ----------
        name : str
            Name of the curve; of a line, its first curve.
        path, paper
            As for all pictures.
        hops : int
            How many links to follow, whichever way they run.

        Raises
        ------
        UnknownNameError
            No curve has this name.
        BadInputError
            Fewer than one hop.
        """
        from assoc_hull.plot.diagrams.driver_graph import neighbourhood

        return neighbourhood(self.hull, name, path, hops=hops, paper=paper)

    def variation_fields(
        self, layer: FieldLayer, path: Path_ | None = None, *, paper: PaperName = "A4"
    ) -> Figure:
        """Draw the fields of a layer over the profile, a panel for each coordinate that moves.

        Each panel shows the sum of the fields as tints, and of every field the boundary curves and
        the box outside which it moves nothing. Heights are not to the scale of the length.

        Parameters
        ----------
        layer : FieldLayer
            The fields.
        path, paper
            As for all pictures; the height of the sheet is that of the panels.

        Raises
        ------
        BadInputError
            A layer without fields.
        """
        from assoc_hull.plot.lines_plan.variation_fields import variation_fields

        return variation_fields(self.hull, layer, path, paper=paper)

    def hydrostatics(
        self,
        table: HydrostaticTable,
        picture: Literal["curves", "areas", "bonjean"] = "curves",
        path: Path_ | None = None,
    ) -> Figure:
        """Draw a picture that goes with a table of hydrostatics of this hull.

        Parameters
        ----------
        table : HydrostaticTable
            What `Hull.hydrostatic_table` gives.
        picture : "curves", "areas" or "bonjean"
            Hydrostatic curves, the sectional-area curve of the first position, or Bonjean curves.
        path
            As for all pictures.

        Raises
        ------
        BadInputError
            Another picture; one draught for curves.
        """
        from assoc_hull.plot.diagrams.hydrostatics import plot_hydrostatics

        return plot_hydrostatics(self.hull, table, picture, path)

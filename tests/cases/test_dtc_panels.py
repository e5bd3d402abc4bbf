"""Panels of the DTC: a net that was cut from a mesh, with bulb, stern bulb and transom."""

from assoc_hull.analysis.panels.hull_panels import panels
from assoc_hull.analysis.panels.mesh_quality import panel_report
from assoc_hull.hull import Hull


def test_the_mesh_is_closed(dtc: Hull) -> None:
    """At the design draught, by the stern, and heeled: normals outward, volume within 1 %."""
    for draughts, heel in (((14.5, 14.5), 0.0), ((16.5, 12.5), 0.0), ((14.0, 13.0), 8.0)):
        report = panel_report(panels(dtc, draughts=draughts, heel_deg=heel, count=1200))
        assert report.outward
        assert abs(report.volume_error or 1.0) < 0.01

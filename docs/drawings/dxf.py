"""The lines plan as a drawing program shows the DXF."""

import io

import ezdxf
from ezdxf.addons.drawing import Frontend, RenderContext
from ezdxf.addons.drawing.config import BackgroundPolicy, Configuration, LineweightPolicy
from ezdxf.addons.drawing.matplotlib import MatplotlibBackend
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from assoc_hull.hull.sources import examples
from assoc_hull.io.dxf.lines_plan import plan_drawing
from assoc_hull.io.reports import ExportBook


def lines_plan_dxf() -> Figure:
    """Draw the DXF of the bulk carrier, as ezdxf renders it."""
    text = plan_drawing(examples.bulk_carrier_207k().state, ExportBook(17))
    drawing = ezdxf.read(io.StringIO(text))
    figure = plt.figure(figsize=(13.0, 5.5))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    look = Configuration(
        background_policy=BackgroundPolicy.WHITE,
        lineweight_policy=LineweightPolicy.ABSOLUTE,
        lineweight_scaling=0.15,
    )
    backend = MatplotlibBackend(axes)
    Frontend(RenderContext(drawing), backend, config=look).draw_layout(drawing.modelspace())
    return figure

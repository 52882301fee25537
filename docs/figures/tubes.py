"""Where the tubes of a look go, by ParaView (5.11 is tested), without a window where the machine has none:

    [xvfb-run -a] pvpython tubes.py HITS.vtu PATHS.vtp WEDGES.vtp PICTURE.png

HITS and PATHS are of `raytube trace --all`, WEDGES of `raytube check --wedges`. On the left hits per facet and area, and the wedges that the
radar lights; on the right the paths of tubes that bounce twice or more."""
import sys

from paraview.simple import *

WIDTH, HEIGHT = 1200, 520
TOWARDS_THE_EYE = (0.80, 0.45, 0.38)
GREY = (0.82, 0.82, 0.82)


def view_of(layout, hint):
    view = CreateRenderView()
    AssignViewToLayout(view, layout, hint)
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = (1.0, 1.0, 1.0)
    return view


def show(source, view, array, labels, title, preset, log=False):
    """With colours for an array of its cells, and their legend."""
    display = Show(source, view)
    ColorBy(display, ("CELLS", array))
    colours = GetColorTransferFunction(array)
    colours.ApplyPreset(preset, True)
    colours.RescaleTransferFunction(labels[0], labels[-1])
    if log:
        colours.MapControlPointsToLogSpace()
        colours.UseLogScale = 1
    legend = GetScalarBar(colours, view)
    legend.Title, legend.ComponentTitle = title, ""
    legend.TitleColor = legend.LabelColor = (0.1, 0.1, 0.1)
    legend.TitleFontSize, legend.LabelFontSize = 18, 16
    legend.Orientation, legend.WindowLocation, legend.ScalarBarLength = "Horizontal", "Upper Left Corner", 0.35
    legend.AddRangeLabels, legend.UseCustomLabels, legend.CustomLabels = 0, 1, labels
    legend.AutomaticLabelFormat, legend.LabelFormat = 0, "%-g"
    display.SetScalarBarVisibility(view, True)
    return display


def show_plain(source, view, colour):
    display = Show(source, view)
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = display.AmbientColor = colour
    return display


def cells_above(source, array, least):
    return Threshold(Input=source, Scalars=["CELLS", array], ThresholdMethod="Above Upper Threshold", UpperThreshold=least)


def cells_below(source, array, most):
    return Threshold(Input=source, Scalars=["CELLS", array], ThresholdMethod="Below Lower Threshold", LowerThreshold=most)


def look_at(view, source):
    box = source.GetDataInformation().GetBounds()
    middle = [0.5 * (box[i] + box[i + 1]) for i in (0, 2, 4)]
    middle[2] += 0.05 * (box[1] - box[0])  # room for the legend
    view.CameraFocalPoint = middle
    view.CameraPosition = [m + d for m, d in zip(middle, TOWARDS_THE_EYE)]
    view.CameraViewUp = (0.0, 0.0, 1.0)
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.45 * max(box[i + 1] - box[i] for i in (0, 2, 4))


def hits_and_wedges(view, hits, wedges):
    sized = CellSize(Input=hits, ComputeVertexCount=0, ComputeLength=0, ComputeVolume=0)
    density = Calculator(Input=sized, AttributeType="Cell Data", ResultArrayName="density", Function="hits/Area*1e-6")
    show_plain(cells_below(density, "hits", 0), view, GREY)  # all of them would lie in one place with the coloured ones
    show(cells_above(density, "hits", 1), view, "density", [0.3, 1, 3, 10, 30], "hits per mm²", "Viridis (matplotlib)", log=True)
    show_plain(cells_above(wedges, "lit_fraction", 0.5), view, (0.85, 0.28, 0.06)).LineWidth = 1


def bounced_paths(view, hits, paths):
    show_plain(hits, view, GREY)
    show(cells_above(paths, "bounces", 2), view, "bounces", [2, 3, 4, 5], "bounces", "Plasma (matplotlib)").LineWidth = 1.5


def main(hits_file, paths_file, wedges_file, picture):
    hits, paths, wedges = (OpenDataFile(name) for name in (hits_file, paths_file, wedges_file))
    layout = CreateLayout("tubes")
    left = view_of(layout, 0)
    layout.SplitHorizontal(0, 0.5)
    right = view_of(layout, 2)
    hits_and_wedges(left, hits, wedges)
    bounced_paths(right, hits, paths)
    for view in (left, right):
        look_at(view, hits)
    layout.SetSize(WIDTH, HEIGHT)
    SaveScreenshot(picture, layout, ImageResolution=(WIDTH, HEIGHT))


main(*sys.argv[1:])

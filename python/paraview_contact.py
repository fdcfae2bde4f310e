"""Opens a result of mezha in ParaView: the bodies warped and coloured, with the contact boundaries on top.

    paraview --script=python/paraview_contact.py            # asks MEZHA_RESULT for the folder
    pvpython python/paraview_contact.py out/hertz --factor 10 --contact seam --picture hertz.png

The bodies are warped by their displacement times a factor (by default one that makes the largest displacement a twentieth of the
scene, and never less than 1) and coloured by the von Mises stress. Contact boundaries are tubes, coloured by the contact pressure
and warped along their normal by the mean of both bodies' normal displacements. Results with load steps open as series in time.
"""

import argparse
import glob
import os
import sys

from paraview import simple


def arguments():
    """What is to be shown, and how."""
    parser = argparse.ArgumentParser(description="opens a result of mezha in ParaView")
    parser.add_argument("folder", nargs="?", default=os.environ.get("MEZHA_RESULT"), help="folder of the result")
    parser.add_argument("--factor", type=float, help="factor of the displacement")
    parser.add_argument("--contact", help="look at this contact from near")
    parser.add_argument("--picture", help="write a picture to this file")
    given = parser.parse_args()
    if given.folder is None:
        parser.error("name the folder of a result, or set MEZHA_RESULT")
    return given


def fields(folder):
    """The file with the fields: a series of load steps, the pieces of several ranks, or one file."""
    for name in ("fields.pvd", "fields.pvtu", "fields.vtu"):
        if os.path.isfile(os.path.join(folder, name)):
            return os.path.join(folder, name)
    sys.exit(f"{folder} has no fields; was it run with output.fields = false?")


def contacts(folder):
    """The files of the contact boundaries by their names; of load steps the series."""
    files = sorted(glob.glob(os.path.join(folder, "contact_*.vtu")))
    series = lambda file: os.path.splitext(file)[0] + ".pvd"
    return {
        os.path.basename(file)[len("contact_") : -len(".vtu")]: series(file) if os.path.isfile(series(file)) else file
        for file in files
    }


def size(source):
    """The diagonal of the box around a source."""
    left, right, below, above, _, _ = source.GetDataInformation().GetBounds()
    return ((right - left) ** 2 + (above - below) ** 2) ** 0.5


def last_time(view):
    """Goes to the last load step, if there are any."""
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    view.Update()


def colour(source, view, field, title, colours, place):
    """Shows a source, coloured by a field of its points over its range at this time, with a bar of colours at a place."""
    display = simple.Show(source, view)
    simple.ColorBy(display, ("POINTS", field))
    table = simple.GetColorTransferFunction(field)
    table.ApplyPreset(colours, True)
    display.RescaleTransferFunctionToDataRange(False)
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle, bar.Visibility = title, "", 1
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.WindowLocation, bar.Position, bar.ScalarBarLength = "Any Location", place, 0.35


def look_at(source, view):
    """Turns the camera to a source alone, with as much around it again."""
    left, right, below, above, _, _ = source.GetDataInformation().GetBounds()
    x, y, half = (left + right) / 2, (below + above) / 2, max(right - left, above - below)
    view.CameraFocalPoint, view.CameraPosition = [x, y, 0], [x, y, 10 * half]
    view.CameraParallelProjection, view.CameraParallelScale = 1, half


def show(folder, factor=None, near=None):
    """Shows bodies and contacts, all of them or one from near; gives the view."""
    found = contacts(folder)
    if near is not None and near not in found:
        sys.exit(f"{folder} has no contact {near}; it has {', '.join(found) or 'none'}")
    view = simple.GetActiveViewOrCreate("RenderView")
    view.ViewSize = [1600, 1000]
    view.UseColorPaletteForBackground, view.Background = 0, [1, 1, 1]
    bodies = simple.OpenDataFile(fields(folder))
    simple.Show(bodies, view)
    last_time(view)
    extent = size(bodies)
    if factor is None:
        largest = bodies.PointData["displacement"].GetRange(-1)[1]
        factor = max(1.0, 0.05 * extent / largest) if largest > 0 else 1.0
    simple.Hide(bodies, view)
    warped = simple.WarpByVector(Input=bodies)
    warped.Vectors = ["POINTS", "displacement"]
    warped.ScaleFactor = factor
    colour(warped, view, "von_mises", "von Mises stress", "Viridis (matplotlib)", [0.9, 0.05])
    tubes = {}
    for name, file in found.items():
        curve = simple.OpenDataFile(file)
        curve.UpdatePipeline(view.ViewTime)
        moved = simple.Calculator(Input=curve, ResultArrayName="motion")
        moved.Function = "normal*(un_1+un_2)/2"
        lifted = simple.WarpByVector(Input=moved)
        lifted.Vectors = ["POINTS", "motion"]
        lifted.ScaleFactor = factor
        surface = simple.ExtractSurface(Input=lifted)
        tube = simple.Tube(Input=surface)
        tube.Scalars = ["POINTS", "lambda"]
        tube.Vectors = ["POINTS", "normal"]
        # Thin beside the contact, however small that is in the scene.
        tube.Radius = min(0.003 * extent, 0.02 * size(curve))
        simple.RenameSource(f"contact {name}", tube)
        colour(tube, view, "lambda", "contact pressure", "Black-Body Radiation", [0.9, 0.55])
        tubes[name] = tube
    view.InteractionMode = "2D"
    simple.ResetCamera(view)
    if near is not None:
        look_at(tubes[near], view)
    simple.Render(view)
    print(f"{folder}: displacements times {factor:.3g}")
    return view


given = arguments()
shown = show(given.folder, given.factor, given.contact)
if given.picture:
    simple.SaveScreenshot(given.picture, shown)
    print(f"wrote {given.picture}")

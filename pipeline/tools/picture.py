#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a PNG of a result of tessera, with VTK and without a window.

    pipeline/tools/picture.py outputs/shaft shaft.png --explode 0.3
    pipeline/tools/picture.py outputs/shaft inside.png --cut y --edges

Needs Debian's python3-vtk9, which belongs to /usr/bin/python3; without a display also xvfb and
xauth, under which it starts itself anew.
"""
import argparse
import colorsys
import math
import os
import pathlib
import shutil
import sys

# VTK's modules are imported where they are used, after main() has seen to a display.

SUPERSAMPLING = 2  # Drawn twice as large and then shrunk: crisp thin lines.
FEATURE_ANGLE_DEG = 35.0
MARGIN = 1.03  # Height of the picture over that of what is in it.


def parse_arguments():
    parser = argparse.ArgumentParser(description="Makes a PNG of a result of tessera.")
    parser.add_argument("folder", type=pathlib.Path, help="output folder of a run")
    parser.add_argument("png", type=pathlib.Path, help="picture to write")
    parser.add_argument(
        "--color",
        default="subdomain",
        choices=("subdomain", "patch", "material", "mean_ratio"),
        help="default: subdomain",
    )
    parser.add_argument(
        "--cut", choices=("x", "y", "z"), help="leave out the half before the middle"
    )
    parser.add_argument("--edges", action="store_true", help="draw the edges of the tets")
    parser.add_argument(
        "--explode", type=float, default=0.0, metavar="F", help="move subdomains apart, e.g. 0.3"
    )
    parser.add_argument("--azimuth", type=float, default=-60.0, help="of the eye, degrees")
    parser.add_argument("--elevation", type=float, default=25.0, help="of the eye, degrees")
    parser.add_argument("--width", type=int, default=1000, help="pixels")
    parser.add_argument("--height", type=int, default=560, help="pixels")
    arguments = parser.parse_args()
    if arguments.cut and arguments.color == "patch":
        parser.error("--cut shows tets, which have no patch")
    return arguments


def eye_of(arguments):
    """Direction from the mesh to the eye."""
    azimuth, elevation = math.radians(arguments.azimuth), math.radians(arguments.elevation)
    return (
        math.cos(elevation) * math.cos(azimuth),
        math.cos(elevation) * math.sin(azimuth),
        math.sin(elevation),
    )


def ensure_display():
    """Starts this script anew under a virtual display where there is none."""
    if os.environ.get("DISPLAY"):
        return
    if shutil.which("xvfb-run") is None:
        sys.exit("picture.py: no display; install the packages xvfb and xauth")
    os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, *sys.argv])


def read_pieces(folder, array):
    """The pieces of the mesh, or of its boundary if it is the patches that are wanted."""
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    files = sorted((folder / ("boundary" if array == "patch" else "mesh")).glob("*.vtu"))
    if not files:
        sys.exit(f"picture.py: {folder} is not the output folder of a finished run")
    pieces = []
    for file in files:
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(file))
        reader.Update()
        pieces.append(reader.GetOutput())
    if not pieces[0].GetCellData().HasArray(array):
        sys.exit(
            f"picture.py: the mesh has no array {array}; run it with --set output.cell_quality=true"
        )
    return pieces


def box_of(pieces):
    bounds = [piece.GetBounds() for piece in pieces]
    low = [min(b[2 * d] for b in bounds) for d in range(3)]
    high = [max(b[2 * d + 1] for b in bounds) for d in range(3)]
    return low, high


def middle_of(pieces):
    low, high = box_of(pieces)
    return [0.5 * (a + b) for a, b in zip(low, high)]


def far_half(piece, axis, middle, eye):
    """The tets that lie as a whole behind the middle, as the eye sees it."""
    from vtkmodules.vtkCommonDataModel import vtkPlane
    from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry

    plane = vtkPlane()
    plane.SetOrigin(middle)
    plane.SetNormal([math.copysign(axis == "xyz"[d], eye[d]) for d in range(3)])
    extract = vtkExtractGeometry()
    extract.SetInputData(piece)
    extract.SetImplicitFunction(plane)
    extract.ExtractInsideOn()
    extract.Update()
    return extract.GetOutput()


def moved(surface, by):
    from vtkmodules.vtkCommonTransforms import vtkTransform
    from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter

    transform = vtkTransform()
    transform.Translate(by)
    mover = vtkTransformPolyDataFilter()
    mover.SetInputData(surface)
    mover.SetTransform(transform)
    mover.Update()
    return mover.GetOutput()


def surfaces_of(pieces, arguments):
    """The surface of every piece, cut and moved as asked."""
    from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

    middle = middle_of(pieces)
    for piece in pieces:
        own_middle = middle_of([piece])
        if arguments.cut:
            piece = far_half(piece, arguments.cut, middle, eye_of(arguments))
        if piece.GetNumberOfCells() == 0:
            continue
        surface = vtkDataSetSurfaceFilter()
        surface.SetInputData(piece)
        surface.Update()
        yield moved(
            surface.GetOutput(), [arguments.explode * (a - b) for a, b in zip(own_middle, middle)]
        )


def colors_for(pieces, array):
    """A colour map: far hues for neighbouring numbers, or red to blue for a quality."""
    from vtkmodules.vtkCommonCore import vtkLookupTable

    table = vtkLookupTable()
    if array == "mean_ratio":
        table.SetHueRange(0.0, 0.62)
        table.SetSaturationRange(0.75, 0.75)
        table.SetTableRange(0.0, 1.0)
        table.Build()
        return table
    ranges = [piece.GetCellData().GetArray(array).GetRange() for piece in pieces]
    first, last = (int(pick(r[i] for r in ranges)) for i, pick in ((0, min), (1, max)))
    count = last - first + 1
    table.SetNumberOfTableValues(count)
    table.SetTableRange(first - 0.5, last + 0.5)
    for i in range(count):
        hue = (0.58 + i * 0.6180339887) % 1.0
        red, green, blue = colorsys.hsv_to_rgb(hue, (0.45, 0.62, 0.52)[i % 3], (0.97, 0.88)[i % 2])
        table.SetTableValue(i, red, green, blue, 1.0)
    return table


def appended(surfaces):
    from vtkmodules.vtkFiltersCore import vtkAppendPolyData

    append = vtkAppendPolyData()
    for surface in surfaces:
        append.AddInputData(surface)
    append.Update()
    return append.GetOutput()


def faces_actor(surface, array, colors, with_edges):
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.SetLookupTable(colors)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray(array)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToFlat()
    actor.GetProperty().SetAmbient(0.35)
    actor.GetProperty().SetDiffuse(0.7)
    if with_edges:
        actor.GetProperty().EdgeVisibilityOn()
        actor.GetProperty().SetEdgeColor(0.15, 0.15, 0.18)
        actor.GetProperty().SetLineWidth(1.0)
    return actor


def borders_actor(surfaces):
    """Sharp edges of every piece: of the geometry, and where two subdomains meet on it."""
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    lines = []
    for surface in surfaces:
        edges = vtkFeatureEdges()
        edges.SetInputData(surface)
        edges.SetFeatureAngle(FEATURE_ANGLE_DEG)
        edges.ColoringOff()
        edges.Update()
        lines.append(edges.GetOutput())
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(appended(lines))
    mapper.ScalarVisibilityOff()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.1, 0.1, 0.12)
    actor.GetProperty().SetLineWidth(1.6 * SUPERSAMPLING)
    actor.GetProperty().LightingOff()
    return actor


def legend(colors):
    import vtkmodules.vtkRenderingFreeType  # noqa: F401  Draws the text.
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor

    bar = vtkScalarBarActor()
    bar.SetLookupTable(colors)
    bar.SetTitle("mean ratio")
    bar.SetNumberOfLabels(3)
    bar.SetLabelFormat("%.1f")
    bar.SetPosition(0.91, 0.2)
    bar.SetWidth(0.07)
    bar.SetHeight(0.6)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.1, 0.1, 0.12)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    return bar


def aim_camera(renderer, surface, arguments):
    """Looks at the surface from the asked direction and fills the picture with it."""
    eye = eye_of(arguments)
    right = (-math.sin(math.radians(arguments.azimuth)), math.cos(math.radians(arguments.azimuth)), 0.0)
    up = tuple(eye[d - 2] * right[d - 1] - eye[d - 1] * right[d - 2] for d in range(3))
    spans = []
    for axis in (right, up, eye):
        along = [
            sum(a * b for a, b in zip(axis, surface.GetPoint(i)))
            for i in range(surface.GetNumberOfPoints())
        ]
        spans.append((min(along), max(along)))
    focus = [
        sum(0.5 * (low + high) * axis[d] for (low, high), axis in zip(spans, (right, up, eye)))
        for d in range(3)
    ]
    width, height, depth = (high - low for low, high in spans)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(focus)
    camera.SetPosition([f + (depth + 1.0) * e for f, e in zip(focus, eye)])
    camera.SetViewUp(up)
    camera.SetParallelScale(0.5 * MARGIN * max(height, width * arguments.height / arguments.width))
    renderer.ResetCameraClippingRange()


def write_png(renderer, arguments):
    from vtkmodules.vtkImagingCore import vtkImageResize
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter

    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(4)
    window.SetSize(SUPERSAMPLING * arguments.width, SUPERSAMPLING * arguments.height)
    window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    smaller = vtkImageResize()
    smaller.SetInputConnection(image.GetOutputPort())
    smaller.SetOutputDimensions(arguments.width, arguments.height, 1)
    writer = vtkPNGWriter()
    writer.SetFileName(str(arguments.png))
    writer.SetCompressionLevel(9)
    writer.SetInputConnection(smaller.GetOutputPort())
    writer.Write()
    if writer.GetErrorCode() != 0:
        sys.exit(f"picture: cannot write {arguments.png}")


def main():
    arguments = parse_arguments()
    ensure_display()
    try:
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  Makes the classes that draw.
        from vtkmodules.vtkRenderingCore import vtkRenderer
    except ImportError as error:
        sys.exit(f"picture.py: {error}; install python3-vtk9 and use /usr/bin/python3")

    array = "attribute" if arguments.color == "material" else arguments.color
    pieces = read_pieces(arguments.folder, array)
    surfaces = list(surfaces_of(pieces, arguments))
    colors = colors_for(pieces, array)
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    whole = appended(surfaces)
    renderer.AddActor(faces_actor(whole, array, colors, arguments.edges))
    if not arguments.cut and array != "patch":
        renderer.AddActor(borders_actor(surfaces))
    if array == "mean_ratio":
        renderer.AddActor2D(legend(colors))
    aim_camera(renderer, whole, arguments)
    write_png(renderer, arguments)


if __name__ == "__main__":
    main()

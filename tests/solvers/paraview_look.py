# SPDX-License-Identifier: BSD-3-Clause
"""Run in ParaView by paraview_test.py: opens a mesh with the reader of its format, measures every
material and patch, draws them cut in half, and says as JSON what it found."""
import colorsys
import json
import pathlib
import sys

from paraview import servermanager, simple


def read_pvtu(folder):
    """Materials and patches by name, each a source; rows of one name together."""

    def parts(name, array, texts, first):
        mesh = simple.XMLPartitionedUnstructuredGridReader(FileName=[str(folder / name)])
        simple.UpdatePipeline(proxy=mesh)
        names = mesh.GetClientSideObject().GetOutputDataObject(0).GetFieldData().GetAbstractArray(texts)
        sources = {}
        for row in range(names.GetNumberOfValues()):
            text = names.GetValue(row)
            sources.setdefault(text, []).append(of_value(mesh, array, first + row))
        return {text: simple.AppendDatasets(Input=some) for text, some in sources.items()}

    return (
        parts("mesh.pvtu", "attribute", "material_names", 1),
        parts("boundary.pvtu", "patch", "patch_names", 0),
    )


def read_xdmf(folder):
    """ParaView shows no names of tags in this format, so these stand for them."""
    mesh = simple.XDMFReader(FileNames=[str(folder / "mesh.xdmf")])
    simple.UpdatePipeline(proxy=mesh)

    def parts(grid, array):
        grid = simple.ExtractBlock(Input=mesh, Selectors=[f"/Root/{grid}"])
        simple.UpdatePipeline(proxy=grid)
        last = int(grid.CellData[array].GetRange()[1])
        return {str(tag): of_value(grid, array, tag) for tag in range(1, last + 1)}

    return parts("mesh", "material"), parts("boundary", "patch")


def read_exodus(folder):
    mesh = simple.IOSSReader(FileName=[str(folder / "mesh.exo")])
    mesh.ElementBlocks.SelectAll()
    mesh.SideSets.SelectAll()
    simple.UpdatePipeline(proxy=mesh)

    def parts(kind, names):
        return {
            name: simple.ExtractBlock(Input=mesh, Assembly="Assembly", Selectors=[f"/IOSS/{kind}/{name}"])
            for name in names
        }

    return parts("element_blocks", mesh.ElementBlocks), parts("side_sets", mesh.SideSets)


def of_value(source, array, value):
    # Limits that are 0 as they were before would be replaced by the array's range.
    return simple.Threshold(
        Input=source, Scalars=["CELLS", array], ThresholdMethod="Between",
        LowerThreshold=value - 0.5, UpperThreshold=value + 0.5,
    )  # fmt: skip


def measure(source, what):
    """Number of cells, and the volume or area."""
    whole = simple.IntegrateVariables(Input=source)
    simple.UpdatePipeline(proxy=whole)
    size = servermanager.Fetch(whole).GetCellData().GetArray(what).GetValue(0)
    return source.GetDataInformation().GetNumberOfCells(), size


def draw(sources, file):
    """Draws the half behind a plane across, each source in one plain colour of its own.
    @return The colours."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [400, 300]
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0
    boxes = [source.GetDataInformation().GetBounds() for source in sources]
    centre = [0.5 * (min(box[d] for box in boxes) + max(box[d + 1] for box in boxes)) for d in (0, 2, 4)]
    colours = [colorsys.hsv_to_rgb(i / len(sources), 1.0, 0.8) for i in range(len(sources))]
    for source, colour in zip(sources, colours):
        half = simple.Clip(Input=source, ClipType="Plane")
        half.ClipType.Origin, half.ClipType.Normal = centre, [1.0, 0.0, 0.0]
        shown = simple.Show(half, view)
        shown.Representation = "Surface"
        shown.ColorArrayName = ["CELLS", ""]
        shown.AmbientColor = shown.DiffuseColor = colour
        shown.Ambient, shown.Diffuse, shown.Specular = 1.0, 0.0, 0.0
    camera = view.GetActiveCamera()
    camera.SetPosition(1.0, 0.3, 0.4)
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetViewUp(0.0, 0.0, 1.0)
    simple.ResetCamera(view)
    simple.SaveScreenshot(str(file), view)
    return [[round(255 * part) for part in colour] for colour in colours]


READERS = {"pvtu": read_pvtu, "xdmf": read_xdmf, "exodus": read_exodus}


def main():
    word, folder, pictures = sys.argv[1], *map(pathlib.Path, sys.argv[2:])
    found = {}
    for kind, what, sources in zip(("materials", "patches"), ("Volume", "Area"), READERS[word](folder)):
        found[kind] = {name: measure(source, what) for name, source in sources.items()}
        found[f"colours of {kind}"] = draw(list(sources.values()), pictures / f"{kind}.png")
    print(json.dumps(found))


main()

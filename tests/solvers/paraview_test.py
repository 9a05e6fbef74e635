# SPDX-License-Identifier: BSD-3-Clause
"""mesh.pvtu, mesh.xdmf and mesh.exo in ParaView's own readers: counts, names, volumes and areas, and
pictures of materials and patches that are looked at."""
import contextlib
import json
import os
import pathlib
import subprocess
import unittest
import xml.etree.ElementTree

import numpy
import solver_meshes
from solver_meshes import Mesh, run
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

LOOK = pathlib.Path(__file__).with_name("paraview_look.py")


@contextlib.contextmanager
def display():
    """Name of a display without a screen. The server chooses a free one, and does not begin anew, deaf for a
    moment, when its last client goes: ParaView comes twice."""
    end, other_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(other_end), "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset"],
        pass_fds=[other_end], stderr=subprocess.DEVNULL,
    )  # fmt: skip
    os.close(other_end)
    try:
        with os.fdopen(end) as number:
            yield f":{number.readline().strip()}"
    finally:
        server.terminate()
        server.wait()


def share_of_pixels(file, colours):
    """Of each colour in a picture, and of white at the end."""
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)
    return [float((abs(pixels - colour).max(axis=1) <= 2).mean()) for colour in (*colours, [255] * 3)]


class ParaView(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.display = cls.enterClassContext(display())

    def look(self, mesh, word, folder):
        pictures = mesh.folder / "pictures" / word
        pictures.mkdir(parents=True)
        modules = mesh.root / "build/paraview/usr/lib/python3/dist-packages"
        out = run(["pvbatch", LOOK, word, folder, pictures],
                  env=os.environ | {"DISPLAY": self.display, "PYTHONPATH": str(modules)})  # fmt: skip
        self.assertNotIn("ERR|", out)
        found = json.loads(out.splitlines()[-1])
        shares = {
            kind: share_of_pixels(pictures / f"{kind}.png", found[f"colours of {kind}"])
            for kind in ("materials", "patches")
        }
        return found, shares

    def check_names_and_sizes(self, mesh, found):
        """Of each material and patch: how many cells, and how large together."""
        volumes, areas, num_triangles = mesh.volumes(), mesh.areas(), sum(mesh.triangles().values())
        self.assertEqual(list(found["materials"]), list(volumes))
        self.assertEqual(set(found["patches"]), set(areas))
        self.assertEqual(sum(cells for cells, _ in found["materials"].values()), mesh.num_tets())
        self.assertEqual(sum(cells for cells, _ in found["patches"].values()), num_triangles)
        for kind, sizes in (("materials", volumes), ("patches", areas)):
            for name, size in sizes.items():
                self.assertAlmostEqual(found[kind][name][1] / size, 1.0, delta=1e-9)

    def check_pictures(self, shares, num_patches_seen):
        """Every material is seen, and so many patches, on a white ground."""
        for kind, least in (("materials", len(shares["materials"]) - 1), ("patches", num_patches_seen)):
            *parts, ground = shares[kind]
            self.assertGreater(ground, 0.2)
            self.assertGreater(sum(parts), 0.1)
            self.assertGreaterEqual(int((numpy.array(parts) > 0.001).sum()), least, parts)

    def check(self, case, num_patches_seen):
        mesh = Mesh(case, 3)
        self.addCleanup(mesh.remove)
        pictures = []
        for word in ("pvtu", "xdmf", "exodus"):
            with self.subTest(format=word):
                folder = mesh.mesh if word == "pvtu" else mesh.convert(word)
                found, shares = self.look(mesh, word, folder)
                if word == "xdmf":
                    found |= named(found, folder / "mesh.xdmf")
                self.check_names_and_sizes(mesh, found)
                self.check_pictures(shares, num_patches_seen)
                pictures.append(shares["materials"] + shares["patches"])
        for other in pictures[1:]:  # The same mesh.
            numpy.testing.assert_allclose(other, pictures[0], atol=1e-3)

    def test_three_materials(self):
        self.check("core", 3)

    def test_bracket(self):
        self.check("bracket", 7)


def named(found, file):
    """With the names of the tags, which stand in the index."""
    lines = xml.etree.ElementTree.parse(file).getroot().iter("Information")
    names = {line.get("Name"): line.get("Value") for line in lines}
    return {
        kind: {names[f"{word} {tag}"]: sizes for tag, sizes in found[kind].items()}
        for kind, word in (("materials", "material"), ("patches", "patch"))
    }


if __name__ == "__main__":
    solver_meshes.main()

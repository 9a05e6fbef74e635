# SPDX-License-Identifier: BSD-3-Clause
"""What `tessera info` says of a CAD model."""
import json
import math
import re
import struct
import unittest
import zlib

import program
from program import CANNOT_WRITE, OK, WRONG_INPUT

GEOMETRY = program.CONFIGS / "geometry"

# Model: solids, faces, edges, length unit, volume, area.
MODELS = {
    "cylinder.step": (1, 3, 3, "mm", math.pi * 25 * 20, None),
    "frustum.iges": (1, 3, 3, "in", math.pi * 2 / 3 * (1 + 0.5 + 0.25), None),
    "cone.brep": (1, None, None, "", None, None),
    "plate_with_hole.stl": (1, None, None, "", None, None),
    "core.geo": (3, 8, None, "", 1000.0, 600 + 4 * math.pi * (4 + 9)),
    "two_blocks.step": (2, 12, 24, "mm", 1288.0, None),
}


# Makes one face red.
STYLE = """\
#90001=COLOUR_RGB('',1.,0.,0.);
#90002=FILL_AREA_STYLE_COLOUR('',#90001);
#90003=FILL_AREA_STYLE('',(#90002));
#90004=SURFACE_STYLE_FILL_AREA(#90003);
#90005=SURFACE_SIDE_STYLE('',(#90004));
#90006=SURFACE_STYLE_USAGE(.BOTH.,#90005);
#90007=PRESENTATION_STYLE_ASSIGNMENT((#90006));
#90008=STYLED_ITEM('',(#90007),{face});
#90009=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#90008),{context});
"""


class Info(program.ProgramTest):
    def info(self, model, *arguments, **options):
        outcome = self.run_program("info", model, *arguments, **options)
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual(outcome.err, "")
        return outcome.out

    def figures(self, name):
        return json.loads(self.info(GEOMETRY / name, "--json"))

    def test_every_kind_of_model(self):
        for name, (solids, faces, edges, unit, volume, area) in MODELS.items():
            with self.subTest(model=name):
                found = self.figures(name)
                self.assertEqual(len(found["solids"]), solids)
                self.assertEqual(found["length_unit"], unit)
                self.assertGreater(len(found["faces"]), 0)
                if faces is not None:
                    self.assertEqual(len(found["faces"]), faces)
                if edges is not None:
                    self.assertEqual(found["num_edges"], edges)
                self.assertEqual(len(found["edges"]), found["num_edges"])
                for edge in found["edges"]:
                    self.assertGreater(edge["length"], 0)
                total = sum(solid["volume"] for solid in found["solids"])
                self.assertGreater(total, 0)
                if volume is not None:
                    self.assertLess(abs(total / volume - 1), 0.02)
                if area is not None:
                    self.assertLess(abs(sum(f["area"] for f in found["faces"]) / area - 1), 0.02)
                for face in found["faces"]:
                    self.assertGreater(face["area"], 0)
                    self.assertTrue(set(face["solids"]) <= set(range(1, solids + 1)))
                    for axis in range(3):
                        self.assertGreaterEqual(face["box"]["low"][axis], found["box"]["low"][axis])
                        self.assertLessEqual(face["box"]["high"][axis], found["box"]["high"][axis])

    def test_names_and_what_lies_between_solids(self):
        core = self.figures("core.geo")
        self.assertEqual([solid["name"] for solid in core["solids"]], ["core", "shell", "matrix"])
        between = {face["name"]: face["solids"] for face in core["faces"]}
        self.assertEqual(between, {"core_skin": [1, 2], "shell_skin": [2, 3], "outside": [3]})

    def test_a_surface_of_csg_is_a_face_of_each_solid_that_has_a_part_of_it(self):
        self.write("blocks.geo", """algebraic3d
solid slab = plane (0, 0, 0; 0, -1, 0) and plane (0, 1, 0; 0, 1, 0)
         and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 1; 0, 0, 1);
solid left = slab and plane (0, 0, 0; -1, 0, 0) and plane (1, 0, 0; 1, 0, 0);
solid right = slab and not plane (1, 0, 0; 1, 0, 0) and plane (3, 0, 0; 1, 0, 0);
tlo left;
tlo right;
""")
        found = self.figures(self.folder / "blocks.geo")
        self.assertEqual([touch["num_faces"] for touch in found["touches"]], [1])
        self.assertAlmostEqual(found["touches"][0]["area"], 1.0)
        self.assertEqual(sorted(round(face["area"], 6) for face in found["faces"]), [1.0] * 7 + [2.0] * 4)
        self.assertEqual(sorted(map(tuple, (face["solids"] for face in found["faces"]))),
                         [(1,)] * 5 + [(1, 2)] + [(2,)] * 5)
        self.run_program("mesh", "blocks.geo", "--size", "0.5", "--output", "mesh")
        self.assertEqual(program.figures(self.folder / "mesh")["patch_names"], [face["patch"] for face in found["faces"]])

    def test_names_and_colours_of_a_step_file(self):
        text = (GEOMETRY / "bracket.step").read_text()
        face = re.search(r"(#\d+)\s*=\s*ADVANCED_FACE\(''", text)
        context = re.search(r"ADVANCED_BREP_SHAPE_REPRESENTATION\('[^']*',\([^)]*\),\s*(#\d+)\)", text).group(1)
        named = text.replace(face.group(0), face.group(0)[:-1] + "inlet'")
        end = named.rindex("ENDSEC;")
        style = STYLE.format(face=face.group(1), context=context)
        self.write("coloured.step", named[:end] + style + named[end:])
        plain, coloured = self.figures("bracket.step"), self.figures(self.folder / "coloured.step")
        self.assertEqual([f["name"] + f["colour"] for f in plain["faces"]], [""] * 11)
        marked = [f for f in coloured["faces"] if f["name"] or f["colour"]]
        self.assertEqual([(f["name"], f["colour"]) for f in marked], [("inlet", "#FF0000")])
        self.assertEqual([f["area"] for f in coloured["faces"]], [f["area"] for f in plain["faces"]])

    def test_names_of_edges_of_a_step_file(self):
        text = (GEOMETRY / "bracket.step").read_text()
        edge = re.search(r"#\d+\s*=\s*EDGE_CURVE\(''", text).group(0)
        self.write("named.step", text.replace(edge, edge[:-1] + "rim'"))
        edges = self.figures(self.folder / "named.step")["edges"]
        self.assertEqual([e["name"] for e in edges if e["name"]], ["rim"])

    def test_a_suggested_size_makes_about_so_many_tets(self):
        for name, kernel in (("cylinder.step", "subdivide"), ("core.geo", "netgen"), ("shaft.geo", "optimize")):
            with self.subTest(model=name):
                sizes = self.figures(name)["sizes"]
                self.assertEqual([size["name"] for size in sizes], ["coarse", "medium", "fine"])
                self.assertGreater(sizes[0]["size"], sizes[1]["size"])
                outcome = self.run_program("mesh", GEOMETRY / name, "--size", sizes[0]["size"], "--kernel",
                                           kernel, "--output", name)
                self.assertEqual(outcome.code, OK, outcome.err)
                made = program.figures(self.folder / name)["num_tets"]
                self.assertGreater(made, 0.5 * sizes[0]["num_tets"])
                self.assertLess(made, 2 * sizes[0]["num_tets"])

    def test_text_has_what_json_has_on_any_number_of_ranks(self):
        model = GEOMETRY / "two_blocks.step"
        text = self.info(model)
        for words in ("box diagonal", "length unit: mm", "solids: 2", "steel", "copper", "edges: 24", "faces: 12",
                      "between solids 1 and 2", "repair: touching solids were glued", "coarse", "fine"):
            self.assertIn(words, text)
        self.assertEqual(self.info(model, ranks=2), text)
        self.assertNotIn(" length ", text)
        with_edges = self.info(model, "--edges")
        self.assertEqual(with_edges.count(" length "), 24)
        self.assertEqual([line for line in with_edges.splitlines() if " length " not in line],
                         text.replace(" (--edges lists them)", "").splitlines())

    def test_picture_shows_the_faces_without_a_display(self):
        self.info(GEOMETRY / "two_blocks.step", "--picture", "blocks.png", ranks=2)
        width, height, palette, pixels = read_png((self.folder / "blocks.png").read_bytes())
        self.assertEqual(len(pixels), width * height)
        white, black = palette.index((255, 255, 255)), palette.index((0, 0, 0))
        seen = set(pixels) - {white, black}
        # Two opposite views show all faces of two boxes but the one between them; each has one shade.
        self.assertGreaterEqual(len(seen), 8)
        self.assertGreater(pixels.count(white), len(pixels) / 10)
        self.assertLess(pixels.count(white), 9 * len(pixels) / 10)
        self.assertGreater(pixels.count(black), 1000)

    def test_what_is_open_or_no_model(self):
        self.write("open.stl", program.stl_text(program.CUBE_TRIANGLES[1:]))
        case = self.write_case()
        for arguments, code, words in (
            (["open.stl"], WRONG_INPUT, ["open.stl", "3 edges"]),
            ([case, "--json"], WRONG_INPUT, ["--json", "CAD models"]),
            ([case, "--edges"], WRONG_INPUT, ["--edges", "CAD models"]),
            ([case, "--picture", "a.png"], WRONG_INPUT, ["--picture", "CAD models"]),
            (["ball.geo", "--picture", "none/a.png"], CANNOT_WRITE, ["none/a.png"]),
        ):
            with self.subTest(arguments=arguments):
                self.assert_refused(self.run_program("info", *arguments), code, *words)


def read_png(data):
    """Width, height, palette and pixels of a picture with a palette and no filters."""
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    chunks, at = {}, 8
    while at < len(data):
        (size,) = struct.unpack_from(">I", data, at)
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + size]
        assert struct.unpack_from(">I", data, at + 8 + size)[0] == zlib.crc32(kind + body)
        chunks[kind] = body
        at += 12 + size
    width, height = struct.unpack_from(">II", chunks[b"IHDR"])
    rows = zlib.decompress(chunks[b"IDAT"])
    assert len(rows) == height * (width + 1)
    pixels = b"".join(rows[y * (width + 1) + 1 : (y + 1) * (width + 1)] for y in range(height))
    palette = chunks[b"PLTE"]
    return width, height, [tuple(palette[i : i + 3]) for i in range(0, len(palette), 3)], pixels


if __name__ == "__main__":
    unittest.main()

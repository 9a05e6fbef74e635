# SPDX-License-Identifier: BSD-3-Clause
"""Models with sides that are images of each other, and cases that say so."""

# One cell of a packing: balls in the corners, which its sides cut, and one off the middle.
BALLS = [(x, y, z, 0.3) for x in (0, 1) for y in (0, 1) for z in (0, 1)] + [(0.45, 0.5, 0.55, 0.25)]


def packing_model(balls):
    """Balls, as centres and radii, in the unit cube."""
    return (
        "algebraic3d\n"
        + "".join(f"solid b{i} = sphere ({x}, {y}, {z}; {r});\n" for i, (x, y, z, r) in enumerate(balls))
        + f"solid balls = {' or '.join(f'b{i}' for i in range(len(balls)))};\nsolid box = orthobrick (0, 0, 0; 1, 1, 1);\n"
        "solid matrix = box and not balls;\nsolid grains = box and balls;\ntlo matrix;\ntlo grains;\n"
    )


PACKING = packing_model(BALLS)
SIDES = {"left": 14, "right": 15, "front": 12, "back": 13, "bottom": 10, "top": 11}
PAIRS = {("left", "right"): (1, 0, 0), ("front", "back"): (0, 1, 0), ("bottom", "top"): (0, 0, 1)}

# A sector of 30 degrees of a wheel with a hole in each.
SECTOR = (
    "algebraic3d\nsolid wheel = cylinder (0, 0, 0; 0, 0, 1; 1) and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 0.3; 0, 0, 1);\n"
    "solid hub = cylinder (0, 0, 0; 0, 0, 1; 0.3);\nsolid hole = cylinder (0.676, 0.181, 0; 0.676, 0.181, 1; 0.09);\n"
    "solid start = plane (0, 0, 0; 0, -1, 0);\nsolid end = plane (0, 0, 0; -0.5, 0.8660254037844386, 0);\n"
    "solid sector = wheel and start and end and not hub and not hole;\ntlo sector;\n"
)

# A pipe whose ends have no corner.
PIPE = (
    "algebraic3d\nsolid pipe = cylinder (0, 0, 0; 0, 0, 1; 0.5) and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 1; 0, 0, 1);\n"
    "tlo pipe;\n"
)


def packing_case(more="refine.levels = 1\n", pairs=tuple(PAIRS)):
    """A case with PACKING in model.geo."""
    names = "".join(f"[[geometry.name]]\nname = '{n}'\npatch = {{ faces = [{f}] }}\n" for n, f in SIDES.items())
    sides = "".join(f"[[periodic]]\nfrom = '{a}'\nto = '{b}'\n" for a, b in pairs)
    head = "geometry.file = 'model.geo'\noutput.report_html = false\ncoarse.max_size = 0.25\ndecompose.subdomains = 7\n"
    return head + more + names + sides


def sector_case(more="refine.levels = 2\n"):
    """A case with SECTOR in model.geo."""
    head = "geometry.file = 'model.geo'\noutput.report_html = false\ncoarse.max_size = 0.15\ndecompose.subdomains = 4\n"
    normals = {"start": [0, -1, 0], "end": [-0.5, 0.8660254037844386, 0]}
    names = "".join(f"[[geometry.name]]\nname = '{n}'\npatch = {{ normal = {v} }}\n" for n, v in normals.items())
    side = "[[periodic]]\nfrom = 'start'\nto = 'end'\nrotation = { axis = [0, 0, 1], angle = 30 }\n"
    return head + more + names + side

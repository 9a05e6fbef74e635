# SPDX-License-Identifier: BSD-3-Clause
"""Models of CSG for the bench of layers: text of a .geo file, wanted size, and patches that are walls."""
import dataclasses


@dataclasses.dataclass
class Model:
    name: str
    what: str
    size: float
    text: str
    walls: str = "*"


def all_models():
    return [
        Model("pipe", "a pipe, its ends open", 0.1, """
solid pipe = cylinder (0, 0, 0; 0, 0, 4; 0.5) and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 4; 0, 0, 1);
tlo pipe;""", "patch_1"),
        Model("bend", "a quarter of a torus between two pipes' ends", 0.1, """
solid bend = torus (0, 0, 0; 0, 0, 1; 2; 0.5) and plane (0, 0, 0; -1, 0, 0) and plane (0, 0, 0; 0, -1, 0);
tlo bend;""", "patch_1"),
        Model("tee", "two pipes that meet at a right angle", 0.1, """
solid along = cylinder (-3, 0, 0; 3, 0, 0; 0.5) and plane (-2, 0, 0; -1, 0, 0) and plane (2, 0, 0; 1, 0, 0);
solid up = cylinder (0, 0, -1; 0, 0, 3; 0.35) and plane (0, 0, 2; 0, 0, 1) and plane (0, 0, 0; 0, 0, -1);
solid tee = along or up;
tlo tee;"""),
        Model("cone", "a cone without its tip", 0.08, """
solid cone_part = cone (0, 0, 0; 0.2; 0, 0, 3; 0.6) and plane (0, 0, 0.1; 0, 0, -1) and plane (0, 0, 2.9; 0, 0, 1);
tlo cone_part;"""),
        Model("torus", "a torus", 0.12, """
solid ring = torus (0, 0, 0; 0, 0, 1; 2; 0.5);
tlo ring;"""),
        Model("ball_in_channel", "a ball in a channel", 0.1, """
solid channel = orthobrick (0, 0, 0; 4, 2, 2);
solid ball = sphere (1.2, 1, 1; 0.4);
solid flow = channel and not ball;
tlo flow;"""),
        Model("rod_in_channel", "a rod across a channel", 0.1, """
solid channel = orthobrick (0, 0, 0; 4, 2, 1);
solid rod = cylinder (1.2, 1, -1; 1.2, 1, 3; 0.3);
solid flow = channel and not rod;
tlo flow;"""),
        Model("box", "a box: all corners from inside", 0.1, """
solid box = orthobrick (0, 0, 0; 1, 1, 1);
tlo box;"""),
        Model("notched_box", "a box with a notch: a corner from outside", 0.15, """
solid box = orthobrick (0, 0, 0; 2, 2, 2);
solid notch = orthobrick (1, 1, 1; 3, 3, 3);
solid notched = box and not notch;
tlo notched;"""),
        Model("block_in_channel", "a block in a channel", 0.12, """
solid channel = orthobrick (0, 0, 0; 4, 2, 2);
solid block = orthobrick (1, 0.7, 0.7; 1.6, 1.3, 1.3);
solid flow = channel and not block;
tlo flow;"""),
        Model("fins", "a block with three thin fins in a channel", 0.15, """
solid channel = orthobrick (-1, -1, -1; 4, 3, 3);
solid body = orthobrick (0, 0, 0; 2, 2, 0.4);
solid fin1 = orthobrick (0.2, 0.3, 0.3; 1.8, 0.4, 1.2);
solid fin2 = orthobrick (0.2, 0.9, 0.3; 1.8, 1.0, 1.2);
solid fin3 = orthobrick (0.2, 1.5, 0.3; 1.8, 1.6, 1.2);
solid flow = channel and not body and not fin1 and not fin2 and not fin3;
tlo flow;"""),
        Model("gap", "a gap of two sizes between two pipes", 0.1, """
solid outer = cylinder (0, 0, 0; 0, 0, 3; 1) and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 3; 0, 0, 1);
solid inner = cylinder (0, 0, -1; 0, 0, 4; 0.8);
solid between = outer and not inner;
tlo between;"""),
        Model("wedge_in_channel", "a wedge with an edge of 11 degrees in a channel", 0.12, """
solid channel = orthobrick (-1, -1, 0; 3, 1, 1);
solid wedge = plane (0, 0, 0; -1, 0, 0) and plane (1, 0, 0; 0.1, 1, 0) and plane (1, 0, 0; 0.1, -1, 0)
    and plane (0, 0, 0.2; 0, 0, -1) and plane (0, 0, 0.8; 0, 0, 1);
solid flow = channel and not wedge;
tlo flow;"""),
    ]

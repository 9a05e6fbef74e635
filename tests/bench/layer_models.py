# SPDX-License-Identifier: BSD-3-Clause
"""Models for the bench of layers: text of a .geo file, or a function of layer_surfaces; wanted size, and patches that
are walls."""
import dataclasses


@dataclasses.dataclass
class Model:
    name: str
    what: str
    size: float
    text: str  # Of CSG; empty: layer_surfaces makes triangles.
    walls: str = "*"
    surface: str = ""

    def write(self, folder):
        """Its file."""
        if not self.surface:
            file = folder / f"{self.name}.geo"
            file.write_text("algebraic3d\n" + self.text.lstrip("\n") + "\n")
            return file
        import layer_surfaces  # Not for models of CSG: it needs VTK.
        from dirty_stl_models import write_stl
        file = folder / f"{self.name}.stl"
        write_stl(file, getattr(layer_surfaces, self.surface)(), self.name)
        return file


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
        Model("manifold", "a pipe that parts into four", 0.1, """
solid ends = orthobrick (-1.5, -3, -2; 2, 3, 1);
solid trunk = cylinder (-2, 0, 0; 0, 0, 0; 0.5) and plane (0, 0, 0; 1, 0, 0);
solid joint = sphere (0, 0, 0; 0.6);
solid one = cylinder (0, 0, 0; 3, 3, 0; 0.3) and plane (0, 0, 0; -1, -1, 0);
solid two = cylinder (0, 0, 0; 3, 0.8, 0; 0.3) and plane (0, 0, 0; -1, -0.3, 0);
solid three = cylinder (0, 0, 0; 3, -3, 0; 0.3) and plane (0, 0, 0; -1, 1, 0);
solid four = cylinder (0, 0, 0; 1, 0, -3; 0.3) and plane (0, 0, 0; -1, 0, 3);
solid manifold = ends and (trunk or joint or one or two or three or four);
tlo manifold;""", "*"),
        Model("valve", "a ball valve, half open", 0.1, """
solid run = cylinder (-3, 0, 0; 3, 0, 0; 0.5) and plane (-2, 0, 0; -1, 0, 0) and plane (2, 0, 0; 1, 0, 0);
solid cavity = sphere (0, 0, 0; 1);
solid bore = cylinder (-3, -2, 0; 3, 2, 0; 0.45);
solid ball = sphere (0, 0, 0; 0.8) and not bore;
solid stem = cylinder (0, 0, 0; 0, 0, 2; 0.2) and plane (0, 0, 0.6; 0, 0, -1) and plane (0, 0, 1.5; 0, 0, 1);
solid flow = (run or cavity) and not ball and not stem;
tlo flow;"""),
        Model("shaft", "a shaft out of the middle of a bore: a gap of 0.6 to 1.4 sizes", 0.1, """
solid bore = cylinder (0, 0, 0; 0, 0, 2; 0.6) and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 2; 0, 0, 1);
solid shaft = cylinder (0.04, 0, -1; 0.04, 0, 3; 0.5);
solid film = bore and not shaft;
tlo film;"""),
        Model("naca", "a NACA 0012 from wall to wall, its trailing edge sharp", 0.05, "", surface="naca_between_walls"),
        Model("wing", "a NACA 0012 with a flat tip", 0.05, "", surface="naca_with_tip"),
        Model("car", "a car on the ground in a box (STL)", 0.15, "", surface="car"),
        Model("vessel", "a vessel that parts twice (STL)", 0.08, "", "vessel_1", surface="vessel"),
    ]

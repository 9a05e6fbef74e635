algebraic3d

# Three materials: a ball (core) in a thicker ball (shell) in a box (matrix), lengths in mm.
solid core = sphere (0, 0, 0; 2) -bcname=core_skin -maxh=1;
solid ball = sphere (0, 0, 0; 3) -bcname=shell_skin;
solid box = orthobrick (-5, -5, -5; 5, 5, 5) -bcname=outside;

solid shell = ball and not core;
solid matrix = box and not ball;

tlo core -col=[1, 0, 0];
tlo shell -col=[0, 1, 0];
tlo matrix -transparent;

algebraic3d

# A ball of radius 1: one surface, no edge, no corner.
solid ball = sphere (0, 0, 0; 1);

tlo ball;

algebraic3d

# A brick with flat sides, 2 by 1 by 1.
solid brick = orthobrick (0, 0, 0; 2, 1, 1);

tlo brick;

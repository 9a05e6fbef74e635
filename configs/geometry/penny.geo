# A quarter of a block, for a penny-shaped crack in its middle.
algebraic3d
solid block = orthobrick (0, 0, -6; 6, 6, 6);
tlo block;

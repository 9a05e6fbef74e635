# A plate of 0.5 in 20 with a hole: edges are far longer than the wall is thick.
algebraic3d

solid plate = orthobrick (0, 0, 0; 20, 20, 0.5)
  and not cylinder (8, 8, -1; 8, 8, 2; 3);

tlo plate;

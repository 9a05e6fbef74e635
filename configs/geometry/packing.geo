# One cell of a packing of balls: one in each corner, cut by the sides, and one off the middle.
algebraic3d
solid b1 = sphere (0, 0, 0; 0.3);
solid b2 = sphere (1, 0, 0; 0.3);
solid b3 = sphere (0, 1, 0; 0.3);
solid b4 = sphere (1, 1, 0; 0.3);
solid b5 = sphere (0, 0, 1; 0.3);
solid b6 = sphere (1, 0, 1; 0.3);
solid b7 = sphere (0, 1, 1; 0.3);
solid b8 = sphere (1, 1, 1; 0.3);
solid b9 = sphere (0.45, 0.5, 0.55; 0.25);
solid balls = b1 or b2 or b3 or b4 or b5 or b6 or b7 or b8 or b9;
solid box = orthobrick (0, 0, 0; 1, 1, 1);
solid matrix = box and not balls;
solid grains = box and balls;
tlo matrix;
tlo grains;

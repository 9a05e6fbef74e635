# What a ball and a rod of size 1 have in common: a lens of 1e-4. NETGEN's search does not find it.
algebraic3d

solid ball = sphere (0, 0, 0; 1) -bcname=round;
solid rod = cylinder (0.99992, -1.49994, -0.8; 1.71992, -0.53994, 0.8; 0.7)
  and plane (0.99992, -1.49994, -0.8; -0.36, -0.48, -0.8)
  and plane (1.71992, -0.53994, 0.8; 0.36, 0.48, 0.8);
solid speck = ball and rod;

tlo speck -material=dust;

# The upper half of a hollow ball: a curved wall of 0.5 in 20.
algebraic3d

solid shell = sphere (0, 0, 0; 10)
  and not sphere (0, 0, 0; 9.5)
  and plane (0, 0, 0; 0, 0, -1);

tlo shell;

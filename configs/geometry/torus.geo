algebraic3d

# A ring about the z axis: circle of radius 1 around a circle of radius 3.
solid ring = torus (0, 0, 0; 0, 0, 1; 3; 1);

tlo ring;

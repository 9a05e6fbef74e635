algebraic3d

# A full cylinder of radius 1 and height 2 about the z axis.
solid full = cylinder (0, 0, 0; 0, 0, 1; 1)
        and plane (0, 0, 0; 0, 0, -1)
        and plane (0, 0, 2; 0, 0, 1);

tlo full;

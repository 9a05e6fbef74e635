# A cone up to its apex, cut by a slanted plane. NETGEN does not end on an apex that is on the surface.
algebraic3d

solid tip = cone (0.3, -0.2, 0.1; 1; 0.8, 0.8, 1.1; 0) -bcname=mantle;
solid ground = plane (0.3, -0.2, 0.1; -1, -2, -2) -bcname=foot;
solid all = tip and ground and plane (0.8, 0.8, 1.1; 1, 2, 2);

tlo all -material=steel;

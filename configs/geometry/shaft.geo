algebraic3d

# A stepped drive shaft along x, lengths in mm: journal, taper, seat with a keyway, flange with six
# bolt holes, stub; a bore runs through all of it.

solid journal = cylinder (0, 0, 0; 1, 0, 0; 12)
        and plane (0, 0, 0; -1, 0, 0)
        and plane (32, 0, 0; 1, 0, 0) -bcname=journal;

solid taper = cone (30, 0, 0; 12; 42, 0, 0; 18)
        and plane (30, 0, 0; -1, 0, 0)
        and plane (42, 0, 0; 1, 0, 0) -bcname=taper;

solid seat = cylinder (0, 0, 0; 1, 0, 0; 18)
        and plane (42, 0, 0; -1, 0, 0)
        and plane (84, 0, 0; 1, 0, 0) -bcname=seat;

solid flange = cylinder (0, 0, 0; 1, 0, 0; 36)
        and plane (82, 0, 0; -1, 0, 0)
        and plane (92, 0, 0; 1, 0, 0) -bcname=flange;

solid stub = cylinder (0, 0, 0; 1, 0, 0; 15)
        and plane (90, 0, 0; -1, 0, 0)
        and plane (112, 0, 0; 1, 0, 0) -bcname=stub;

solid bore = cylinder (0, 0, 0; 1, 0, 0; 6) -bcname=bore;
solid keyway = orthobrick (50, -4, 13; 74, 4, 40) -bcname=keyway;

# Six holes on a circle of radius 27.
solid holes = cylinder (0, 27, 0; 1, 27, 0; 4)
        or cylinder (0, 13.5, 23.3826859; 1, 13.5, 23.3826859; 4)
        or cylinder (0, -13.5, 23.3826859; 1, -13.5, 23.3826859; 4)
        or cylinder (0, -27, 0; 1, -27, 0; 4)
        or cylinder (0, -13.5, -23.3826859; 1, -13.5, -23.3826859; 4)
        or cylinder (0, 13.5, -23.3826859; 1, 13.5, -23.3826859; 4) -bcname=hole;

solid shaft = (journal or taper or seat or flange or stub)
        and not bore
        and not keyway
        and not holes;

tlo shaft;

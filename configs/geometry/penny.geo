# A quarter of a block with a penny-shaped crack: where the two halves of the puck meet.
algebraic3d
solid low = orthobrick (0, 0, -6; 6, 6, 0);
solid high = orthobrick (0, 0, 0; 6, 6, 6);
solid puck = cylinder (0, 0, -2; 0, 0, 2; 1) and orthobrick (-2, -2, -1; 2, 2, 1);
solid puck_low = low and puck;
solid puck_high = high and puck;
solid rest_low = low and not puck;
solid rest_high = high and not puck;
tlo puck_low;
tlo puck_high;
tlo rest_low;
tlo rest_high;

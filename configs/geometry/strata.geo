# Three layers of rock.
algebraic3d
solid low = orthobrick (0, 0, 0; 200, 100, 30);
solid middle = orthobrick (0, 0, 30; 200, 100, 60);
solid high = orthobrick (0, 0, 60; 200, 100, 100);
tlo low;
tlo middle;
tlo high;

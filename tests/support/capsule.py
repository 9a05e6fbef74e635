# SPDX-License-Identifier: BSD-3-Clause
"""A model whose layers have prisms, pyramids and tets."""

# A pipe with a round end that goes over smoothly into its wall: no columns stand on the circle where they meet.
CAPSULE = """algebraic3d
solid inlet = plane (0, 0, 0; 0, 0, -1) -bcname=inlet;
solid side = cylinder (0, 0, 0; 0, 0, 1; 0.5) -bcname=wall;
solid cut = plane (0, 0, 1; 0, 0, 1);
solid cap = sphere (0, 0, 1; 0.5) -bcname=end;
solid pipe = side and inlet and cut;
solid body = pipe or cap;
tlo body;
"""

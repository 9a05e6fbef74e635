# SPDX-License-Identifier: BSD-3-Clause
# From a CAD file to arrays and a picture: python3 part.py part.step
import sys

import numpy as np
import tessera

mesh = tessera.mesh(sys.argv[1], size=2.0, parts=4, ranks=2)

corners = mesh.points[mesh.cells]  # Shape (num_tets, 4, 3).
volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6.0
for m, name in enumerate(mesh.names.materials, 1):
    print(f"{name}: volume {volumes[mesh.materials == m].sum():.6g}")

a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
areas = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
for p, name in enumerate(mesh.names.patches):
    print(f"{name}: area {areas[mesh.patches == p].sum():.6g}")

print(mesh.report["quality"]["mean_ratio"]["mean"])
with open("mesh.png", "wb") as file:
    file.write(mesh.picture())

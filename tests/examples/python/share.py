# SPDX-License-Identifier: BSD-3-Clause
# What a solver of one's own reads: mpirun -n 3 python3 share.py DIR
import sys

import numpy as np
import tessera
from mpi4py import MPI

comm = MPI.COMM_WORLD
mesh = tessera.read(sys.argv[1], comm, ghost_layers=1)

own = mesh.cells[: mesh.num_own_cells]  # Ghosts are the last ones.
corners = mesh.points[own]
volume = comm.allreduce(float(np.linalg.det(corners[:, 1:] - corners[:, :1]).sum()) / 6.0)
num_points = comm.allreduce(int((mesh.owner == comm.rank).sum()))  # Each point has one owner.
if comm.rank == 0:
    print(f"volume {volume:.12g}, {num_points} points")

# SPDX-License-Identifier: BSD-3-Clause
"""Linear finite elements on tets as numpy arrays. Needs Debian's python3-numpy and python3-scipy."""
import dataclasses

import numpy
from scipy.sparse import coo_matrix

from tet_figures import boundary_triangles, volumes


@dataclasses.dataclass
class Mesh:
    """With the gradients of the hat functions in every tet. Shape (num_tets, 4, 3)."""
    points: numpy.ndarray
    tets: numpy.ndarray

    def __post_init__(self):
        corners = self.points[self.tets]
        self.volumes = volumes(corners)
        edges = corners[:, 1:] - corners[:, :1]
        inverse = numpy.linalg.inv(edges)
        self.hats = numpy.concatenate([-inverse.sum(axis=2)[:, None, :], inverse.transpose(0, 2, 1)], axis=1)

    def boundary(self):
        """Whether a vertex is on the boundary."""
        on_it = numpy.zeros(len(self.points), bool)
        on_it[boundary_triangles(self.tets)] = True
        return on_it

    def gradients(self, values):
        return numpy.einsum("tci,tc->ti", self.hats, values[self.tets])

    def stiffness(self):
        """As a sparse matrix, of all vertices."""
        entries = numpy.einsum("tci,tdi,t->tcd", self.hats, self.hats, self.volumes)
        rows, columns = numpy.repeat(self.tets, 4, axis=1), numpy.tile(self.tets, 4)
        size = len(self.points)
        return coo_matrix((entries.ravel(), (rows.ravel(), columns.ravel())), shape=(size, size)).tocsr()

    def times_stiffness(self, values):
        flux = self.gradients(values) * self.volumes[:, None]
        parts = numpy.einsum("tci,ti->tc", self.hats, flux)
        return numpy.bincount(self.tets.ravel(), parts.ravel(), len(self.points))

    def sums_at_vertices(self, of_tets):
        return numpy.bincount(self.tets.ravel(), numpy.repeat(of_tets, 4), len(self.points))

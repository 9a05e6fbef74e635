# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a tet mesh as numpy arrays: quality, sizes. Needs Debian's python3-numpy, and python3-vtk9 to
read one from files."""
import numpy

BATCH = 200_000  # Tets at once, so that their quality needs little memory.
EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
FACES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))


def volumes(corners):
    a, b, c = (corners[:, i] - corners[:, 0] for i in (1, 2, 3))
    return numpy.abs(numpy.einsum("ij,ij->i", numpy.cross(a, b), c)) / 6.0


def squared_edges(corners):
    return numpy.stack([((corners[:, i] - corners[:, j])**2).sum(axis=1) for i, j in EDGES], axis=1)


def mean_ratios(corners):
    """12 (3 V)^(2/3) over the sum of the squared edges."""
    return 12.0 * (3.0 * volumes(corners))**(2.0 / 3.0) / squared_edges(corners).sum(axis=1)


def min_dihedral_deg(corners):
    normals = []  # Of the face opposite to each corner, towards it.
    for c in range(4):
        p, q, r = (corners[:, (c + i) % 4] for i in (1, 2, 3))
        normal = numpy.cross(q - p, r - p)
        normal /= numpy.linalg.norm(normal, axis=1)[:, None]
        side = numpy.sign(numpy.einsum("ij,ij->i", normal, corners[:, c] - p))
        normals.append(normal * side[:, None])
    largest_cosine = max(-numpy.einsum("ij,ij->i", normals[i], normals[j]).min() for i, j in EDGES)
    return float(numpy.degrees(numpy.arccos(min(largest_cosine, 1.0))))


def quality(points, tets):
    """Mean, 1st percentile and minimum of the mean ratio, smallest dihedral angle."""
    ratios, smallest = [], 180.0
    for first in range(0, len(tets), BATCH):
        corners = points[tets[first:first + BATCH]]
        ratios.append(mean_ratios(corners))
        smallest = min(smallest, min_dihedral_deg(corners))
    ratios = numpy.concatenate(ratios)
    return {
        "tets": len(tets),
        "mean": float(ratios.mean()),
        "p01": float(numpy.quantile(ratios, 0.01)),
        "min": float(ratios.min()),
        "angle": smallest,
    }


def read_mesh(file):
    """Points by their global ids, and tets."""
    from vtkmodules.util.numpy_support import vtk_to_numpy  # Not vtk itself: threads cannot import that at once.
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

    reader = vtkXMLPUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    tets = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    ids = vtk_to_numpy(grid.GetPointData().GetGlobalIds())
    points = numpy.empty((int(ids.max()) + 1, 3))
    points[ids] = vtk_to_numpy(grid.GetPoints().GetData())  # Those that pieces share are there twice.
    return points, ids[tets]


def edges_of(points, tets):
    """The ends of every edge once."""
    keys = numpy.concatenate([numpy.sort(tets[:, edge], axis=1) for edge in EDGES]).astype(numpy.int64)
    ends = numpy.unique(keys[:, 0] * len(points) + keys[:, 1])
    return numpy.stack([ends // len(points), ends % len(points)], axis=1)


def edge_lengths(points, tets):
    """Of every edge once."""
    ends = edges_of(points, tets)
    return numpy.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)


def volume_ratios(points, tets):
    """The larger by the smaller volume of each two tets with a common face."""
    keys = numpy.sort(numpy.concatenate([tets[:, face] for face in FACES]), axis=1)
    order = numpy.lexsort(keys.T)
    is_pair = (keys[order[1:]] == keys[order[:-1]]).all(axis=1).nonzero()[0]
    of_tets = volumes(points[tets])
    one, other = (of_tets[order[is_pair + i] % len(tets)] for i in (0, 1))
    return numpy.maximum(one, other) / numpy.minimum(one, other)


def equal_size(points, tets):
    """The root mean square of the edges, weighted by volume, and G: the number of tets that the mesh
    would have if that were 1, for each unit of volume. Regular tets of one size have 8.5. So meshes
    compare at equal size."""
    volume, squares = 0.0, 0.0
    for first in range(0, len(tets), BATCH):
        corners = points[tets[first:first + BATCH]]
        of_tets = volumes(corners)
        volume += of_tets.sum()
        squares += (of_tets * squared_edges(corners).mean(axis=1)).sum()
    return {
        "rms": float(numpy.sqrt(squares / volume)),
        "G": float(len(tets) * (squares / volume)**1.5 / volume),
    }


def sizes(points, tets):
    """Median and 99th percentile of the edges, and the figures of equal_size()."""
    lengths = edge_lengths(points, tets)
    return {
        "median": float(numpy.median(lengths)),
        "p99": float(numpy.quantile(lengths, 0.99)),
        **equal_size(points, tets),
    }


def boundary_triangles(tets):
    """The faces of one tet only, as (num_triangles, 3) vertices."""
    faces = numpy.concatenate([tets[:, face] for face in FACES])
    keys = numpy.sort(faces, axis=1)
    _, first, count = numpy.unique(keys, axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def surface_angles(points, tets):
    """Smallest angles of the boundary triangles: their 1st percentile and minimum, in degrees."""
    corners = points[boundary_triangles(tets)]
    smallest = numpy.full(len(corners), numpy.pi)
    for c in range(3):
        u = corners[:, (c + 1) % 3] - corners[:, c]
        v = corners[:, (c + 2) % 3] - corners[:, c]
        cosine = numpy.einsum("ij,ij->i", u, v) / (numpy.linalg.norm(u, axis=1) * numpy.linalg.norm(v, axis=1))
        smallest = numpy.minimum(smallest, numpy.arccos(numpy.clip(cosine, -1.0, 1.0)))
    smallest = numpy.degrees(smallest)
    return {"surface_p01": float(numpy.quantile(smallest, 0.01)), "surface_min": float(smallest.min())}

# SPDX-License-Identifier: BSD-3-Clause
"""STL models for the bench of layers: closed surfaces around what flows, as triangles of shape (n, 3, 3). Needs
Debian's python3-numpy, python3-scipy and python3-vtk9."""
import numpy as np
from dirty_stl_models import grid, turned
from scipy.spatial import Delaunay, cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPlane, vtkPlaneCollection, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkFlyingEdges3D
from vtkmodules.vtkFiltersGeneral import vtkClipClosedSurface


def triangles_of(data):
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    return points[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)]


def poly_data(triangles):
    points, polys, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(triangles.reshape(-1, 3), deep=True))
    corners = np.arange(3 * len(triangles)).reshape(-1, 3)
    rows = np.concatenate([np.full((len(corners), 1), 3), corners], axis=1).ravel()
    polys.SetCells(len(corners), numpy_to_vtkIdTypeArray(rows, deep=True))
    data.SetPoints(points)
    data.SetPolys(polys)
    clean = vtkCleanPolyData()
    clean.SetInputData(data)
    clean.Update()
    return clean.GetOutput()


def cut_flat(triangles, planes):
    """What is in front of planes (point, normal), closed by flat caps."""
    collection = vtkPlaneCollection()
    for point, normal in planes:
        plane = vtkPlane()
        plane.SetOrigin(point)
        plane.SetNormal(normal)
        collection.AddItem(plane)
    clip = vtkClipClosedSurface()
    clip.SetInputData(poly_data(triangles))
    clip.SetClippingPlanes(collection)
    clip.Update()
    return triangles_of(clip.GetOutput())


def level_set(distance, low, high, step):
    """Where a function of x, y and z is zero; it is negative inside."""
    low, high = np.array(low, dtype=float), np.array(high, dtype=float)
    num = np.ceil((high - low) / step).astype(int) + 1
    z, y, x = np.meshgrid(*(low[d] + step * np.arange(num[d]) for d in (2, 1, 0)), indexing="ij")
    image = vtkImageData()
    image.SetDimensions(*map(int, num))
    image.SetOrigin(low)
    image.SetSpacing(step, step, step)
    values = distance(x, y, z)
    image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.0)
    contour.Update()
    return outwards(triangles_of(contour.GetOutput()))


def outwards(triangles):
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return triangles if np.einsum("ij,ij->i", a, np.cross(b, c)).sum() > 0.0 else turned(triangles)


def open_edges(triangles):
    """The two ends of edges that have one triangle only."""
    _, ids = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    ids = ids.reshape(-1, 3)
    keys = np.sort(np.concatenate([ids[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
    ends = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    _, first, count = np.unique(keys, axis=0, return_index=True, return_counts=True)
    return ends[first[count == 1]]


def is_inside(points, segments):
    """Of closed polygons in the plane, given as their sides."""
    (x, y), (a, b) = points.T[:, :, None], (segments[:, 0].T, segments[:, 1].T)
    crosses = (a[1] > y) != (b[1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    return (crosses & (at > x)).sum(axis=1) % 2 == 1


def flat_wall(low, high, step, segments):
    """Triangles of a rectangle with holes, in the plane."""
    x, y = (np.linspace(a, b, round((b - a) / step) + 1) for a, b in zip(low, high))
    points = np.stack(np.meshgrid(x, y), axis=2).reshape(-1, 2)
    if len(segments):
        ring = np.unique(segments.reshape(-1, 2), axis=0)
        is_far = cKDTree(ring).query(points)[0] > step / 2
        points = np.concatenate([ring, points[is_far & ~is_inside(points, segments)]])
    corners = points[Delaunay(points).simplices]
    return corners[~is_inside(corners.mean(axis=1), segments)] if len(segments) else corners


def in_room(body, low, high, step):
    """A room around a body, less the body. Where this is open, it ends on walls of the room."""
    parts, edges = [turned(body)], open_edges(body)
    for axis in range(3):
        others = [d for d in range(3) if d != axis]
        for place, outside in ((low[axis], -1.0), (high[axis], 1.0)):
            on_wall = edges[(edges[:, :, axis] == place).all(axis=1)][:, :, others]
            flat = flat_wall(np.take(low, others), np.take(high, others), step, on_wall)
            wall = np.insert(flat, axis, place, axis=2)
            normals = np.cross(wall[:, 1] - wall[:, 0], wall[:, 2] - wall[:, 0])[:, axis]
            parts.append(np.where((normals * outside > 0.0)[:, None, None], wall, turned(wall)))
    return np.concatenate(parts)


def smooth_union(distances, width):
    return -width * np.log(sum(np.exp(-one / width) for one in distances))


def rounded_box(x, y, z, half, radius):
    off = [abs(one) - (h - radius) for one, h in zip((x, y, z), half)]
    outside = np.sqrt(sum(np.maximum(one, 0.0)**2 for one in off))
    return outside + np.minimum(np.maximum.reduce(off), 0.0) - radius


def car():
    """A body with a cabin on four wheels that stand on the ground, in a box."""
    def distance(x, y, z):
        hull = rounded_box(x, y, z - 0.52, (2.0, 0.8, 0.3), 0.25)
        lean = 0.45 * (z - 0.9)  # The windows do.
        cabin = rounded_box((x - 0.25) / (1.0 - lean), y / (1.0 - lean), z - 0.95, (1.05, 0.68, 0.35), 0.2)
        wheels = []
        for side in (-0.68, 0.68):
            for axle in (-1.25, 1.25):
                round_off = np.hypot(x - axle, z - 0.3) - 0.28
                flat_off = abs(y - side) - 0.09
                wheels.append(np.hypot(np.maximum(round_off, 0.0), np.maximum(flat_off, 0.0))
                              + np.minimum(np.maximum(round_off, flat_off), 0.0) - 0.06)
        return smooth_union([hull, cabin, *wheels], 0.03)

    body = level_set(distance, (-2.3, -1.1, -0.2), (2.3, 1.1, 1.6), 0.05)
    above = cut_flat(body, [((0, 0, 0), (0, 0, 1))])
    above[abs(above) < 1e-9] = 0.0
    return in_room(above[above[:, :, 2].any(axis=1)], (-3.5, -2.0, 0.0), (5.5, 2.0, 2.5), 0.5)


def capsule(x, y, z, start, end, radius):
    start, axis = np.array(start, dtype=float), np.subtract(end, start).astype(float)
    off = [one - s for one, s in zip((x, y, z), start)]
    along = np.clip(sum(o * a for o, a in zip(off, axis)) / (axis @ axis), 0.0, 1.0)
    return np.sqrt(sum((o - along * a)**2 for o, a in zip(off, axis))) - radius


def vessel():
    """A tube that parts twice; its four ends are cut flat."""
    fork, second = (0.0, 0.0, 2.0), (0.8, 0.0, 3.2)
    ends = [((0.0, 0.0, 0.0), fork), ((-1.4, 0.0, 3.8), fork), ((1.6, 0.3, 4.2), second), ((1.2, -0.9, 3.6), second)]
    tubes = [(*ends[0], 0.4), (*ends[1], 0.28), (fork, second, 0.32), (*ends[2], 0.22), (*ends[3], 0.22)]

    def distance(x, y, z):
        return smooth_union([capsule(x, y, z, *tube) for tube in tubes], 0.06)

    whole = level_set(distance, (-2.1, -1.5, -0.6), (2.2, 0.9, 4.8), 0.05)
    planes = [(end, np.subtract(start, end) / np.linalg.norm(np.subtract(start, end))) for end, start in ends]
    return cut_flat(whole, planes)


def aerofoil(num=40):
    """NACA 0012 of length 1 with a sharp trailing edge: a ring of points in x and y."""
    x = (1.0 + np.cos(np.linspace(0.0, np.pi, num + 1))) / 2.0
    y = 0.6 * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    y[0] = 0.0
    upper = np.stack([x, y], axis=1)
    return np.concatenate([upper, (upper * [1, -1])[-2:0:-1]])


def wing(length):
    """From z = 0 on, open there."""
    ring = aerofoil()
    rows = np.stack([np.column_stack([ring, np.full(len(ring), z)]) for z in np.linspace(0.0, length, 13)])
    return outwards(grid(rows, False, True))


def naca_between_walls():
    return in_room(wing(1.0), (-0.5, -0.5, 0.0), (1.7, 0.5, 1.0), 0.2)


def naca_with_tip():
    """The tip is flat: bands between the upper and the lower side."""
    upper, lower = aerofoil()[:41], np.concatenate([aerofoil()[:1], aerofoil()[:39:-1]])
    tip = grid(np.insert(np.stack([upper, lower]), 2, 0.6, axis=2), False, False)
    is_flat = (tip == np.roll(tip, 1, axis=1)).all(axis=2).any(axis=1)
    body = np.concatenate([wing(0.6), turned(tip[~is_flat])])
    return in_room(body, (-0.5, -0.5, 0.0), (1.7, 0.5, 1.0), 0.2)

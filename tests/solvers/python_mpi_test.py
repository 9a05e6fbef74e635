#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""tessera.read() and tessera.mesh() with a communicator: shares, owners, ghosts and numbers against the whole mesh.

    tests/solvers/python_mpi_test.py --tessera build/release/bin/tessera
"""
import shutil
import sys

import numpy as np
import python_ranks
from python_ranks import RanksTest, volumes

RANKS = (1, 2, 3, 5)


def shares(comm, folder):
    """Each share against the whole mesh, which every rank reads for that."""
    import tessera

    whole, mesh = tessera.read(folder), tessera.read(folder, comm)
    for name in ("num_global_points", "num_global_cells", "num_global_triangles", "names", "report", "length_unit"):
        assert getattr(mesh, name) == getattr(whole, name), name
    assert_part_of(whole, mesh)
    for ids, number in ((mesh.cell_ids, len(whole.cells)), (mesh.triangle_ids, len(whole.triangles))):
        every = np.sort(np.concatenate(comm.allgather(ids)))
        assert np.array_equal(every, np.arange(number)), "not each on one rank"
    assert_owners(comm, mesh)
    return comm.allgather(len(mesh.cells))


def assert_part_of(whole, mesh):
    """Points, tets and triangles are those of the whole mesh."""
    assert np.array_equal(mesh.points, whole.points[mesh.point_ids])
    row = np.argsort(whole.cell_ids)[mesh.cell_ids]
    assert np.array_equal(mesh.point_ids[mesh.cells], whole.point_ids[whole.cells[row]])
    assert np.array_equal(mesh.materials, whole.materials[row])
    assert np.array_equal(mesh.subdomains, whole.subdomains[row])
    row = np.argsort(whole.triangle_ids)[mesh.triangle_ids]
    assert np.array_equal(mesh.point_ids[mesh.triangles], whole.point_ids[whole.triangles[row]])
    assert np.array_equal(mesh.patches, whole.patches[row])
    assert np.array_equal(mesh.cell_ids[mesh.triangle_cells], whole.cell_ids[whole.triangle_cells[row]])


def holders(comm, mesh):
    """Of each point of the whole mesh the ranks that have tets of their own on it."""
    found = {}
    own = np.unique(mesh.cells[: mesh.num_own_cells])
    for rank, ids in enumerate(comm.allgather(mesh.point_ids[own])):
        for point in ids.tolist():
            found.setdefault(point, []).append(rank)
    return found


def assert_owners(comm, mesh):
    ranks = holders(comm, mesh)
    for row, point in enumerate(mesh.point_ids.tolist()):
        assert mesh.owner[row] == ranks[point][0], point
        others = [rank for rank in ranks[point] if rank != comm.rank]
        is_ghost = row >= len(mesh.points) - mesh.num_ghost_points
        assert mesh.sharers[row].tolist() == ([] if is_ghost else others), point


def ghosts(comm, folder, layers):
    """Layers of other ranks' tets, found anew in the whole mesh."""
    import tessera

    whole, mesh = tessera.read(folder), tessera.read(folder, comm, ghost_layers=int(layers))
    plain = tessera.read(folder, comm)
    assert np.array_equal(mesh.cell_ids[: mesh.num_own_cells], plain.cell_ids)
    assert_part_of(whole, mesh)
    assert_owners(comm, mesh)
    has = np.isin(whole.cell_ids, plain.cell_ids)
    for _ in range(int(layers)):
        has = np.isin(whole.cells, np.unique(whole.cells[has])).any(axis=1)
        if not len(plain.cells):
            has[:] = False
    assert np.array_equal(np.sort(mesh.cell_ids), np.sort(whole.cell_ids[has]))
    home = {c: rank for rank, ids in enumerate(comm.allgather(plain.cell_ids)) for c in ids.tolist()}
    assert mesh.cell_ranks.tolist() == [home[c] for c in mesh.cell_ids.tolist()]
    assert len(mesh.points) - mesh.num_ghost_points == len(plain.points)
    return comm.allreduce(mesh.num_ghost_cells)


def consecutive(comm, folder, layers):
    """New numbers: in blocks over the ranks, the same on all ranks that have a point."""
    import tessera

    whole = tessera.read(folder)
    mesh = tessera.read(folder, comm, ghost_layers=int(layers), consecutive=True)
    plain = tessera.read(folder, comm, ghost_layers=int(layers))
    number = mesh.num_owned_points
    first = comm.scan(number) - number
    assert np.array_equal(mesh.point_ids[:number], first + np.arange(number))
    assert np.all(mesh.owner[:number] == comm.rank) and np.all(mesh.owner[number:] != comm.rank)
    blocks = np.concatenate(comm.allgather(mesh.points[:number]))
    assert len(blocks) == mesh.num_global_points == len(whole.points)
    assert np.array_equal(blocks[mesh.point_ids], mesh.points)
    for name in ("cells", "triangles"):
        assert np.array_equal(mesh.points[getattr(mesh, name)], plain.points[getattr(plain, name)]), name
    assert_owners(comm, mesh)
    return True


def refused(comm, folder):
    """The same error on all ranks, and the ranks go on."""
    import tessera

    said = []
    for what in (folder, folder + "/nowhere"):
        try:
            tessera.read(what, comm)
        except tessera.InputError as error:
            said.append((error.exit_code, error.message))
    assert len(said) == 2 and all(one == said for one in comm.allgather(said))
    return said


def made(comm, case, wrong_case):
    """mesh() with a communicator, in a process that has started MPI."""
    import pathlib

    import tessera

    mesh = tessera.mesh(case, comm=comm, quiet=True, ranks=2, keys=python_ranks.COARSER)
    volume = comm.allreduce(float(volumes(mesh).sum()))
    try:
        tessera.mesh(wrong_case, comm=comm, quiet=True)
        codes = [None]
    except tessera.TesseraError as error:
        codes = comm.allgather(error.exit_code)
    folder = str(mesh.folder)
    del mesh
    comm.barrier()
    return {"volume": volume, "codes": codes, "gone": not pathlib.Path(folder).exists()}


class Ranks(RanksTest):
    def test_shares_make_up_the_mesh(self):
        for name in self.meshes:
            for ranks in RANKS:
                with self.subTest(case=name, ranks=ranks):
                    self.assertTrue(all(self.on_ranks(ranks, shares, self.folder / name)))

    def test_more_ranks_than_files(self):
        import tessera

        few = self.folder / "few"
        keys = {"output.files": 2, **python_ranks.COARSER}
        tessera.mesh(self.root / "configs/cases/core.toml", keys=keys, output=few, quiet=True)
        self.assertEqual(sum(number == 0 for number in self.on_ranks(4, shares, few)), 2)
        self.assertGreater(self.on_ranks(4, ghosts, few, 1), 0)
        self.assertTrue(self.on_ranks(4, consecutive, few, 0))

    def test_ghosts_are_the_tets_around(self):
        for layers in (1, 2):
            with self.subTest(layers=layers):
                self.assertGreater(self.on_ranks(3, ghosts, self.folder / "core", layers), 0)
        self.assertEqual(self.on_ranks(1, ghosts, self.folder / "core", 1), 0)

    def test_numbers_can_be_consecutive(self):
        for layers in (0, 1):
            for ranks in (1, 3):
                with self.subTest(layers=layers, ranks=ranks):
                    self.assertTrue(self.on_ranks(ranks, consecutive, self.folder / "bracket", layers))

    def test_a_damaged_file_is_an_error_on_all_ranks(self):
        damaged = shutil.copytree(self.folder / "core", self.folder / "damaged")
        piece = sorted((damaged / "mesh").iterdir())[-1]
        piece.write_bytes(piece.read_bytes()[:1000])
        (code, message), (other_code, _) = self.on_ranks(3, refused, damaged)
        self.assertEqual((code, other_code), (64, 64))
        self.assertIn(piece.name, message)

    def test_mesh_runs_the_program_from_rank_0(self):
        case = self.root / "configs/cases/bracket.toml"
        for ranks in (1, 3):
            with self.subTest(ranks=ranks):
                found = self.on_ranks(ranks, made, case, self.folder / "nowhere.toml")
                self.assertAlmostEqual(found["volume"] / 5926.0, 1.0, delta=1e-2)
                self.assertEqual(found["codes"], ranks * [64])
                self.assertTrue(found["gone"])

    def test_the_example_of_the_page_runs(self):
        import tessera

        mesh = tessera.read(self.folder / "core")
        for ranks in (1, 3):
            volume, points = self.run_example(ranks, "share.py", self.folder / "core").split()[1:3]
            self.assertAlmostEqual(float(volume.rstrip(",")) / mesh.report["volume"], 1.0, delta=1e-11)
            self.assertEqual(int(points), mesh.report["num_vertices"])


if __name__ == "__main__":
    sys.exit(python_ranks.main(globals()))

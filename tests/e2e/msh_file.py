# SPDX-License-Identifier: BSD-3-Clause
"""Readers of Gmsh's MSH files that know nothing of the program that wrote them."""
import numpy as np

# By type of element: triangle, quad, tet, prism, pyramid, triangle and tet of second order.
NUM_NODES = {2: 3, 3: 4, 4: 4, 6: 6, 7: 5, 9: 6, 11: 10}
DIMENSION = {2: 2, 3: 2, 4: 3, 6: 3, 7: 3, 9: 2, 11: 3}
TRIANGLE, TET = 2, 4


def assert_range(tags, number, first, last):
    assert len(tags) == number
    assert number == 0 or (tags.min(), tags.max()) == (first, last)


class Msh:
    """What an MSH file says.

    `names` {(dimension, physical tag): name}, `physicals` {(dimension, entity): tags}, `parents` and
    `parts` {(dimension, entity): …} of partitioned entities, `ghost_parts` {entity: part}, `nodes` and
    `xyz`, `blocks` [(dimension, entity, type, rows of element and nodes)], `ghosts` rows of element,
    owner and part, `periodic` [(dimension, entity of the images, entity of the originals, matrix, rows of two
    nodes)], `order` of the sections."""

    def __init__(self, file):
        self.names, self.physicals, self.parents, self.parts, self.ghost_parts = {}, {}, {}, {}, {}
        self.blocks, self.order, self.num_parts, self.periodic = [], [], 0, []
        self.ghosts = np.empty((0, 3), int)
        self._file = file
        self._content = file.read_bytes()
        self._at = 0
        while self._at < len(self._content):
            self._read_section()

    @property
    def node_xyz(self):
        """Position of each node by its tag."""
        table = np.full((self.nodes.max() + 1, 3), np.nan)
        table[self.nodes] = self.xyz
        return table

    def elements(self, kind, with_ghosts=False):
        """Rows of element and nodes of all blocks of a type, and a name for each."""
        rows, names = [np.empty((0, NUM_NODES[kind] + 1), int)], []
        for dimension, entity, block_kind, block in self.blocks:
            is_ghost = dimension == 3 and entity in self.ghost_parts
            if block_kind == kind and (with_ghosts or not is_ghost):
                rows.append(block)
                names += [self._name(dimension, entity)] * len(block)
        return np.concatenate(rows), np.array(names, dtype=object)

    def ghost_rows(self):
        """Rows of element and nodes of the tets on ghost entities."""
        blocks = [b for d, e, _, b in self.blocks if d == 3 and e in self.ghost_parts]
        return np.concatenate([np.empty((0, 5), int), *blocks])

    def _name(self, dimension, entity):
        physicals = self.physicals.get((dimension, entity), [])
        assert len(physicals) <= 1, "groups of Tessera's entities"
        return self.names[dimension, physicals[0]] if physicals else None

    def _read_section(self):
        line = self._line()
        assert line.startswith("$"), f"{self._file}: byte {self._at}: {line!r}"
        name = line[1:]
        self.order.append(name)
        getattr(self, f"_read_{name}")()
        if self._content[self._at : self._at + 1] == b"\n":
            self._at += 1
        assert self._line() == f"$End{name}", f"{self._file}: {name} does not end at byte {self._at}"

    def _line(self):
        end = self._content.index(b"\n", self._at)
        line = self._content[self._at : end].decode()
        self._at = end + 1
        return line

    def _array(self, kind, *shape):
        values = np.frombuffer(self._content, kind, int(np.prod(shape)), self._at)
        self._at += values.nbytes
        return values.reshape(shape)

    def _ints(self, number):
        return [int(value) for value in self._array("<i4", number)]

    def _sizes(self, number):
        return [int(value) for value in self._array("<u8", number)]

    def _counted_ints(self):
        return self._ints(self._sizes(1)[0])

    def _read_MeshFormat(self):
        self.version, is_binary, size = self._line().split()
        assert size == "8"
        if is_binary == "1":
            assert self._ints(1) == [1]
        else:
            assert self.version == "2.2"

    def _read_PhysicalNames(self):
        for _ in range(int(self._line())):
            dimension, tag, name = self._line().split(" ", 2)
            assert name.startswith('"') and name.endswith('"') and '"' not in name[1:-1], name
            key = int(dimension), int(tag)
            assert key not in self.names, key
            self.names[key] = name[1:-1]

    def _read_Entities(self):
        self._read_entities(lambda key: None)

    def _read_PartitionedEntities(self):
        self.num_parts, num_ghosts = self._sizes(2)
        self.ghost_parts = dict(self._ints(2) for _ in range(num_ghosts))

        def read_parent(key):
            self.parents[key] = tuple(self._ints(2))
            self.parts[key] = self._counted_ints()

        self._read_entities(read_parent)

    def _read_entities(self, read_more):
        num_points, num_curves, *numbers = self._sizes(4)
        assert num_points == num_curves == 0
        for dimension, number in zip((2, 3), numbers):
            for _ in range(number):
                key = dimension, self._ints(1)[0]
                assert key not in self.physicals, key
                read_more(key)
                box = self._array("<f8", 2, 3)
                assert (box[0] <= box[1]).all(), box
                self.physicals[key] = self._counted_ints()
                assert self._counted_ints() == []

    def _read_Nodes(self):
        if self.version == "2.2":
            rows = [self._line().split() for _ in range(int(self._line()))]
            self.nodes = np.array([int(row[0]) for row in rows])
            self.xyz = np.array([[float(x) for x in row[1:]] for row in rows])
            return
        num_blocks, num_nodes, first, last = self._sizes(4)
        nodes, xyz = [], []
        for _ in range(num_blocks):
            dimension, entity, parametric = self._ints(3)
            assert (dimension, entity) in self.physicals and parametric == 0
            number = self._sizes(1)[0]
            nodes.append(self._array("<u8", number).astype(int))
            xyz.append(self._array("<f8", number, 3))
        self.nodes, self.xyz = np.concatenate(nodes), np.concatenate(xyz)
        assert_range(self.nodes, num_nodes, first, last)

    def _read_Elements(self):
        if self.version == "2.2":
            self._read_elements_as_text()
            return
        num_blocks, num_elements, first, last = self._sizes(4)
        for _ in range(num_blocks):
            dimension, entity, kind = self._ints(3)
            assert (dimension, entity) in self.physicals or entity in self.ghost_parts
            rows = self._array("<u8", self._sizes(1)[0], NUM_NODES[kind] + 1)
            self.blocks.append((dimension, entity, kind, rows.astype(int)))
        tags = np.concatenate([np.empty(0, int), *(block[:, 0] for *_, block in self.blocks)])
        assert_range(tags, num_elements, first, last)

    def _read_elements_as_text(self):
        groups = {}
        for _ in range(int(self._line())):
            element, kind, num_tags, *values = map(int, self._line().split())
            assert num_tags == 2 and len(values) == 2 + NUM_NODES[kind]
            physical, entity, *nodes = values
            assert physical > 0 and entity > 0
            self.physicals[DIMENSION[kind], entity] = [physical]
            groups.setdefault((DIMENSION[kind], entity, kind), []).append([element, *nodes])
        self.blocks = [(*key, np.array(rows)) for key, rows in groups.items()]

    def _read_Periodic(self):
        if self.version == "2.2":
            for _ in range(int(self._line())):
                entities = map(int, self._line().split())
                word, *numbers = self._line().split()
                assert word == "Affine"
                matrix = np.array([float(number) for number in numbers]).reshape(4, 4)
                nodes = [[int(node) for node in self._line().split()] for _ in range(int(self._line()))]
                self.periodic.append((*entities, matrix, np.array(nodes)))
            return
        for _ in range(self._sizes(1)[0]):
            entities = self._ints(3)
            assert self._sizes(1) == [16]
            matrix = self._array("<f8", 4, 4)
            self.periodic.append((*entities, matrix, self._array("<u8", self._sizes(1)[0], 2).astype(int)))

    def _read_GhostElements(self):
        rows = []
        for _ in range(self._sizes(1)[0]):
            element, owner = self._sizes(1)[0], self._ints(1)[0]
            rows += [(element, owner, part) for part in self._counted_ints()]
        self.ghosts = np.array(rows)

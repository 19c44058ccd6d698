# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The mesh of a block: its leaf or, if a dataset is in several partitions, all of them as one."""
from . import _vtk_blocks
from ._vtk_partitions import AMBIGUOUS, JoinedPartitions, join_constraints
from ._vtk_regions import describe_malformed_arrays


class BlockMesh:
    """`mesh` is the block as one vtkPolyData, or None if it is not a surface."""

    def __init__(self, block, read, regions):
        """read(leaf) returns a mesh, or None if the leaf is not a surface.

        Raises:
            What JoinedPartitions raises.
        """
        self._block = block
        meshes = {leaf.number: read(leaf.data) for leaf in block.leaves if leaf.may_be_mesh}
        self._meshes = {number: mesh for number, mesh in meshes.items() if mesh is not None}
        parts = list(self._meshes.values())
        self._joined = JoinedPartitions(parts, regions) if len(parts) > 1 else None
        self.mesh = self._joined.mesh if self._joined else parts[0] if parts else None

    def list_warnings(self):
        """(place, text) of each."""
        fate = "left out"
        notes = [(leaf.name, describe_malformed_arrays(self._meshes[leaf.number], fate, fate))
                 for leaf in self._block.leaves if self._joined and leaf.number in self._meshes]
        return [(name, "; ".join(texts)) for name, texts in notes if texts] + [
            (self._block.name, text) for text in self._list_texts()]

    def _list_texts(self):
        others = (leaf for leaf in self._block.leaves if leaf.number not in self._meshes)
        texts = ["not a surface, passed unchanged"] if any(leaf.cells for leaf in others) else []
        return texts + [AMBIGUOUS] * bool(self._joined and self._joined.has_ambiguous_points)

    def find_constraints(self, constraints):
        """`constraints` is None, a mesh for all blocks, or _vtk_blocks.list_meshes() of another
        dataset."""
        if isinstance(constraints, dict):
            pairs = [(leaf.number, leaf.data) for leaf in constraints.get(self._block.place, [])]
        elif constraints is None or self._joined is None or constraints.GetNumberOfPoints():
            return constraints
        else:
            pairs = [(number, constraints) for number in self._meshes]
        if self._joined is None and len(pairs) < 2:
            return pairs[0][1] if pairs else None
        return join_constraints([(edges, self._meshes.get(number)) for number, edges in pairs])

    def store(self, flipped, results):
        """Adds the leaves of the output. `flipped` is the mesh after the run; None: the leaves of the
        input pass unchanged."""
        results.update((leaf.number, _vtk_blocks.copy(leaf.data)) for leaf in self._block.leaves)
        if flipped is not None:
            parts = self._joined.divide(flipped) if self._joined else [flipped]
            results.update(zip(self._meshes, parts))

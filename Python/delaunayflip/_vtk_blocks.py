# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The blocks of VTK's composite datasets."""
import dataclasses
import typing

from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkDataObject, vtkDataObjectTree, vtkMultiBlockDataSet,
    vtkPartitionedDataSet, vtkPartitionedDataSetCollection, vtkPolyData, vtkUniformGridAMR)


@dataclasses.dataclass(frozen=True)
class Leaf:
    """A leaf of a composite dataset; `number` is VTK's flat index."""

    data: typing.Any
    number: int
    may_be_mesh: bool
    name: str  #: "block 3 (wing)"

    @property
    def cells(self):
        return _count_cells(self.data)


@dataclasses.dataclass
class Block:
    """A leaf, or all partitions of a dataset that have cells: one mesh. `before` is the share of all
    cells in earlier blocks, `share` that of this one."""

    place: typing.Tuple
    name: str  #: "block 3 (wing)", of its first leaf
    leaves: typing.List[Leaf]
    before: float = 0.0
    share: float = 0.0

    @property
    def cells(self):
        return sum(leaf.cells for leaf in self.leaves)


def _leaves(blocks):
    leaf = blocks.NewIterator()
    leaf.InitTraversal()
    while not leaf.IsDoneWithTraversal():
        yield leaf
        leaf.GoToNextItem()


def _count_cells(data):
    return data.GetNumberOfElements(vtkDataObject.CELL) if data is not None else 0


def _get_name(leaf):
    number = f"block {leaf.GetCurrentFlatIndex()}"
    about = leaf.GetCurrentMetaData() if leaf.HasCurrentMetaData() else None
    name = about.Get(vtkCompositeDataSet.NAME()) if about is not None else None
    return f"{number} ({name})" if name else number


def _list_places(node, place=()):
    """The places in the tree of a node and all below it, by VTK's flat index: the numbers of
    children, from the root on. Partitions of a dataset that have cells are at one place."""
    places = [place]
    if isinstance(node, vtkPartitionedDataSet):
        for i in range(node.GetNumberOfPartitions()):
            own = 0 if _count_cells(node.GetPartitionAsDataObject(i)) else -1 - i
            places.append((*place, own))
    elif isinstance(node, vtkPartitionedDataSetCollection):
        for i in range(node.GetNumberOfPartitionedDataSets()):
            places += _list_places(node.GetPartitionedDataSet(i), (*place, i))
    elif isinstance(node, vtkMultiBlockDataSet):
        for i in range(node.GetNumberOfBlocks()):
            places += _list_places(node.GetBlock(i), (*place, i))
    return places


def list_blocks(source):
    """The blocks, in the order of their places."""
    places, blocks = _list_places(source), {}
    for leaf in _leaves(source):
        number = leaf.GetCurrentFlatIndex()
        place = places[number] if number < len(places) else ()
        name = _get_name(leaf)
        block = blocks.setdefault(place or (number,), Block(place or (number,), name, []))
        block.leaves.append(Leaf(leaf.GetCurrentDataObject(), number, _is_tree(source), name))
    ordered = sorted(blocks.values(), key=lambda block: block.place)
    total, before = max(sum(block.cells for block in ordered), 1), 0
    for block in ordered:
        block.before, block.share = before / total, block.cells / total
        before += block.cells
    return ordered


def list_meshes(source):
    """{place: [Leaf]} of the polygonal leaves."""
    meshes = {block.place: [leaf for leaf in block.leaves if isinstance(leaf.data, vtkPolyData)]
              for block in list_blocks(source)}
    return {place: leaves for place, leaves in meshes.items() if leaves}


def copy(source):
    """A shallow copy."""
    made = source.NewInstance()
    made.ShallowCopy(source)
    return made


def store(source, results, output):
    """Gives `output` the structure of `source`, with results[flat index] as leaves."""
    output.CopyStructure(source)
    output.GetFieldData().ShallowCopy(source.GetFieldData())
    for leaf in _leaves(source):
        output.SetDataSet(leaf, results[leaf.GetCurrentFlatIndex()])


def _is_tree(blocks):
    """Whether all leaves may be meshes: those of AMR, which is a tree from VTK 9.6 on, are grids."""
    return isinstance(blocks, vtkDataObjectTree) and not isinstance(blocks, vtkUniformGridAMR)

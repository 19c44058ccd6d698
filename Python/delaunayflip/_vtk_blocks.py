# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The blocks of VTK's composite datasets."""
import dataclasses
import typing

from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkDataObject, vtkDataObjectTree, vtkPartitionedDataSet, vtkPolyData,
    vtkUniformGridAMR)


@dataclasses.dataclass(frozen=True)
class Block:
    """A leaf. `before` is the share of all cells in earlier leaves, `share` that of this one."""

    data: typing.Any
    number: int
    name: str  #: "block 3 (wing)"
    has_cells: bool
    may_be_mesh: bool
    before: float
    share: float


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


def transform_blocks(source, output, transform):
    """Makes `output` from transform(Block) for every leaf of `source`."""
    output.CopyStructure(source)
    output.GetFieldData().ShallowCopy(source.GetFieldData())
    blocks = source.NewInstance()  # observers may change the input meanwhile
    blocks.ShallowCopy(source)
    total = max(sum(_count_cells(leaf.GetCurrentDataObject()) for leaf in _leaves(blocks)), 1)
    before = 0
    for leaf in _leaves(blocks):
        data = leaf.GetCurrentDataObject()
        own = _count_cells(data)
        block = Block(data, leaf.GetCurrentFlatIndex(), _get_name(leaf), own > 0,
                      _is_tree(source), before / total, own / total)
        output.SetDataSet(leaf, transform(block))
        before += own


def list_meshes(blocks):
    """{flat index: leaf} of the polygonal leaves."""
    leaves = {leaf.GetCurrentFlatIndex(): leaf.GetCurrentDataObject() for leaf in _leaves(blocks)}
    return {number: data for number, data in leaves.items() if isinstance(data, vtkPolyData)}


def _is_tree(blocks):
    """Whether all leaves may be meshes: those of AMR, which is a tree from VTK 9.6 on, are grids."""
    return isinstance(blocks, vtkDataObjectTree) and not isinstance(blocks, vtkUniformGridAMR)


def _is_divided(data):
    """Whether it is a mesh in several partitions."""
    if not isinstance(data, vtkPartitionedDataSet):
        return False
    partitions = (data.GetPartitionAsDataObject(i) for i in range(data.GetNumberOfPartitions()))
    return sum(_count_cells(partition) > 0 for partition in partitions) > 1


def has_partitions(blocks):
    """Whether there are edges between partitions of one dataset, which stay as they are."""
    if _is_divided(blocks) or not _is_tree(blocks):
        return _is_divided(blocks)
    node = blocks.NewTreeIterator()
    node.VisitOnlyLeavesOff()
    node.InitTraversal()
    while not node.IsDoneWithTraversal():
        if _is_divided(node.GetCurrentDataObject()):
            return True
        node.GoToNextItem()
    return False

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The blocks of composite data: see Filters/MeshBlocks.h."""
import itertools

from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataObjectTree, vtkPartitionedDataSet


def iterate(iterator):
    """Yields an iterator of VTK at each of its positions."""
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        yield iterator
        iterator.GoToNextItem()


def name_leaf(leaf):
    """The name of a leaf in messages, such as "block 3 (wing)"; the number is VTK's flat index."""
    about = leaf.GetCurrentMetaData() if leaf.HasCurrentMetaData() else None
    name = about.Get(vtkCompositeDataSet.NAME()) if about is not None else None
    return f"block {leaf.GetCurrentFlatIndex()}" + (f" ({name})" if name else "")


def list_blocks(data, elements):
    """Lists the leaves of composite data: a dict from places to pairs of a name and a leaf. Other data is
    the only leaf. A place is the tuple of child numbers from the root to the leaf. All partitions of a
    dataset that are not empty have the same place; each empty one has a place of its own.

    Args:
        elements: vtkDataObject.CELL or POINT: a partition without any of these is empty.
    """
    if not isinstance(data, vtkCompositeDataSet):
        return {(): [("", data)]} if data is not None else {}
    is_tree = isinstance(data, vtkDataObjectTree)
    places = _list_places(data, elements) if is_tree else zip(itertools.count())
    blocks = {}
    for place, leaf in zip(places, iterate(data.NewIterator())):
        blocks.setdefault(place, []).append((name_leaf(leaf), leaf.GetCurrentDataObject()))
    return blocks


def find_leaves(blocks, place, kind):
    """The leaves of this class in another input that belong to the block at a place."""
    return [leaf for _, leaf in blocks.get((), blocks.get(place, ())) if isinstance(leaf, kind)]


def choose_leaf(leaves, number):
    """The leaf for a partition: the only one, or the one with the partition's number."""
    if len(leaves) == 1:
        return leaves[0]
    return leaves[number] if number < len(leaves) else None


def _list_places(tree, elements, place=()):
    children = tree.NewTreeIterator()
    children.TraverseSubTreeOff()
    children.VisitOnlyLeavesOff()
    children.SkipEmptyNodesOff()
    are_partitions = isinstance(tree, vtkPartitionedDataSet)
    for number, child in enumerate(iterate(children)):
        data = child.GetCurrentDataObject()
        if data is None:
            continue
        if are_partitions:
            number = 0 if data.GetNumberOfElements(elements) > 0 else -1 - number
        if isinstance(data, vtkDataObjectTree):
            yield from _list_places(data, elements, (*place, number))
        else:
            yield (*place, number)


def copy_data(source):
    """A shallow copy with copies of the leaves, too. Older versions of VTK do not copy leaves."""
    made = source.NewInstance()
    if isinstance(source, vtkDataObjectTree) and not source.IsA("vtkUniformGridAMR"):
        made.CopyStructure(source)
        made.GetFieldData().ShallowCopy(source.GetFieldData())
        for leaf in iterate(source.NewIterator()):
            made.SetDataSet(leaf, copy_data(leaf.GetCurrentDataObject()))
    else:
        made.ShallowCopy(source)
    return made

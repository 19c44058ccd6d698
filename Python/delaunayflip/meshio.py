# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Delaunay flips for meshio."""
import itertools
import typing
import warnings

import meshio
import numpy

from . import _arrays
from ._library import InvalidMesh
from ._options import Numbers, refuse_goals
from ._report import Report
from ._session import flip_arrays
from ._surface import number_tuples

#: Cell data in which meshio's readers keep the materials, groups or tags of cells.
LABELS = ("avsucd:material", "cell_tags", "gmsh:geometrical", "gmsh:physical", "medit:ref",
          "nastran:ref", "netgen:index", "obj:group_ids", "su2:tag", "tetgen:ref", "ugrid:ref")

Regions = typing.Union[None, str, int, Numbers]


@typing.overload
def flip(mesh: "meshio.Mesh", *, regions: Regions = None, **options: typing.Any) -> "meshio.Mesh": ...


@typing.overload
def flip(mesh: "meshio.Mesh", *, regions: Regions = None, return_report: typing.Literal[True],
         **options: typing.Any) -> "typing.Tuple[meshio.Mesh, Report]": ...


def flip(
    mesh: "meshio.Mesh", *, regions: Regions = None, return_report: bool = False, **options: typing.Any,
) -> "typing.Union[meshio.Mesh, typing.Tuple[meshio.Mesh, Report]]":
    """A mesh with the same points, data and sets, and with Delaunay triangles.

    Only cells of the type `triangle` flip. The mesh still fits together: an edge of triangles stays
    if it is also an edge of another cell, such as a line, a quad or a tetrahedron. Lines are not
    inserted. It warns if nothing can flip.

    Args:
        mesh: Any mesh; it is not changed.
        regions: Edges between triangles of different regions stay. By default, triangles are in
            different regions if they are in different blocks or cell sets, or differ in cell data
            that meshio reads as labels, such as gmsh:physical and medit:ref. The name of other cell
            data, or (m,) values for the triangles of all blocks, take the place of these; 0 makes
            one region of all.
        return_report: Also return the `Report`.
        **options: Those of delaunayflip.flip; the lines are added to its constraints.

    Returns:
        The mesh; with `return_report`, the mesh and the report.

    Raises:
        TypeError: The mesh is not a meshio.Mesh.
        The exceptions of delaunayflip.flip.

    Example:
        >>> import meshio
        >>> import delaunayflip.meshio
        >>> kite = meshio.Mesh([[0.0, 0], [2, -1], [4, 0], [2, 1]],
        ...                    [("triangle", [[0, 1, 2], [0, 2, 3]])])
        >>> better, report = delaunayflip.meshio.flip(kite, return_report=True)
        >>> sorted(sorted(face) for face in better.cells_dict["triangle"].tolist())
        [[0, 1, 3], [1, 2, 3]]
        >>> report.total_flips
        1
    """
    if not isinstance(mesh, meshio.Mesh):
        raise TypeError(f"mesh must be a meshio.Mesh, not {type(mesh).__name__}")
    refuse_goals(options, "meshio")
    made = mesh.copy()
    blocks = [block for block in made.cells if block.type == "triangle"]
    triangles = [_arrays.as_ids("triangles", block.data, 3) for block in blocks]
    triangles = numpy.concatenate(triangles or [numpy.empty((0, 3), dtype=int)])
    lines = [_arrays.as_ids("lines", block.data, 2) for block in mesh.cells if block.type == "line"]
    lines = numpy.concatenate([numpy.empty((0, 2), dtype=int), *lines])
    _require_points("line", lines, len(mesh.points))
    others = [block for block in mesh.cells if block.type not in ("triangle", "line")]
    edges, are_all = _find_shared_edges(triangles, others, len(mesh.points))
    _add_constraints([lines, edges], options)
    if len(triangles) == 0 or are_all:
        warnings.warn(_describe_nothing(mesh, len(triangles)), stacklevel=2)
    result, trouble = flip_arrays(
        mesh.points, triangles, regions=_number_regions(mesh, regions, len(triangles)), **options)
    for text in trouble:
        warnings.warn(text, stacklevel=2)
    for block, end in zip(blocks, numpy.cumsum([len(block) for block in blocks])):
        block.data = result.triangles[end - len(block):end]
    return (made, result.report) if return_report else made


def _require_points(what, rows, count):
    """Raises InvalidMesh if a cell names a point that does not exist: as a constraint it would get another
    number."""
    wrong = numpy.argwhere((rows < 0) | (rows >= count))
    if len(wrong):
        row, column = wrong[0].tolist()
        point = int(rows[row, column])
        raise InvalidMesh(f"{what} {row} names point {point}, but there are {count} points, numbered from 0",
                          row, point)


def _add_constraints(pairs, options):
    """Adds them to the constraints, not to be inserted."""
    pairs = numpy.concatenate(pairs)
    given = options.get("constraints")
    given = _arrays.as_ids("constraints", [] if given is None else given, 2)
    flags = _arrays.as_flags("insert_constraints", options.get("insert_constraints", True),
                             (), (len(given),))
    options["constraints"] = numpy.concatenate([given, pairs])  # so that messages number those of the caller
    options["insert_constraints"] = numpy.concatenate(
        [numpy.full(len(given), flags), numpy.zeros(len(pairs), bool)])


def _find_shared_edges(triangles, others, count):
    """The edges of the triangles that have both ends in one other cell, (k, 2), and whether these
    are all of their edges. Triangles that name a point twice have no edges. Ids that no point has are
    passed over here."""
    inner = triangles[((triangles >= 0) & (triangles < count)).all(axis=1)].astype(numpy.int64)
    inner = inner[(inner != inner[:, [1, 2, 0]]).all(axis=1)]
    is_used = numpy.zeros(count + 1, dtype=bool)  # the last one stands for all other ids
    is_used[inner] = True
    edges = numpy.sort(_number_pairs(inner, inner[:, [1, 2, 0]], count), axis=None)
    edges = edges[numpy.diff(edges, prepend=-1) != 0]
    is_shared = numpy.zeros(len(edges), dtype=bool)
    for rows in itertools.chain.from_iterable(map(_list_rows, others)):
        rows = numpy.where((rows >= 0) & (rows < count), rows, count)
        rows = rows[is_used[rows].sum(axis=1) > 1].astype(numpy.int64)
        for first, second in itertools.combinations(rows.T, 2):
            pairs = numpy.append(numpy.sort(_number_pairs(first, second, count)), -1)
            is_shared |= pairs[numpy.searchsorted(pairs[:-1], edges)] == edges
    shared = edges[is_shared]
    shared = numpy.stack([shared // (count + 1), shared % (count + 1)], axis=1)
    return shared, 0 < len(shared) == len(edges)


def _list_rows(block):
    """The points of the cells of a block, (k, n) arrays. Polyhedra are lists of faces."""
    if not block.type.startswith("polyhedron"):
        return [numpy.asarray(block.data)]
    return [numpy.unique(numpy.concatenate([numpy.ravel(face) for face in cell]))[None]
            for cell in block.data]


def _number_pairs(first, second, count):
    """A number per pair of points, whichever end comes first."""
    return numpy.minimum(first, second) * (count + 1) + numpy.maximum(first, second)


def _number_regions(mesh, given, count):
    """A number per triangle, or None for one region."""
    if given is None:
        columns = [_gather(mesh, [numpy.full(len(block), i) for i, block in enumerate(mesh.cells)])]
        columns += [_gather(mesh, mesh.cell_data[name]) for name in LABELS if name in mesh.cell_data]
        columns += [_gather(mesh, flags) for flags in _list_set_flags(mesh)]
    elif isinstance(given, str):
        if given not in mesh.cell_data:
            listed = ", ".join(map(repr, mesh.cell_data)) or "none"
            raise ValueError(f"regions: the mesh has no cell data {given!r}; it has {listed}")
        columns = [_gather(mesh, mesh.cell_data[given])]
    else:
        return numpy.full(count, given) if _arrays.as_array("regions", given).ndim == 0 else given
    numbers = numpy.zeros(count, dtype=numpy.int64)
    for column in columns:
        if column.dtype == object:
            column = _number_objects(column)
        labels = numpy.unique(number_tuples(column) if column.ndim > 1 else column, return_inverse=True)[1]
        numbers = numpy.unique(numbers * (count + 1) + labels, return_inverse=True)[1]
    return numbers if numbers.any() else None


def _number_objects(column):
    """A number per label, where None, which cannot be compared, may stand beside texts; NaN is None."""
    known = {}
    texts = [repr(label) if label == label else "None" for label in column.ravel().tolist()]
    return numpy.array([known.setdefault(text, len(known)) for text in texts], dtype=int).reshape(column.shape)


def _gather(mesh, values):
    """The values of the triangles, of an array per block."""
    chosen = [value for block, value in zip(mesh.cells, values) if block.type == "triangle"]
    return numpy.concatenate(chosen) if chosen else numpy.empty(0)


def _list_set_flags(mesh):
    """For each cell set whether it has each cell, an array per block. Sets in the name of a format,
    such as gmsh:bounding_entities, are no sets of cells."""
    for name, members in mesh.cell_sets.items():
        if name.startswith("gmsh:"):
            continue
        yield [_mark_cells(f"cell set {name!r}", [] if ids is None else ids, block)
               for block, ids in itertools.zip_longest(mesh.cells, members[:len(mesh.cells)])]


def _mark_cells(name, ids, block):
    """Whether a set, of numbers of cells or a mask, has each cell of a block."""
    count, ids = len(block), _arrays.as_array(name, ids)
    if ids.dtype == bool and ids.shape == (count,):
        return ids
    if ids.dtype == bool or ids.ndim != 1 or ids.size and ids.dtype.kind not in "iuf":
        raise ValueError(f"{name} must have numbers of cells, or a mask of shape ({count},), in each block, not "
                         f"{ids.dtype} of shape {ids.shape}")
    wrong = ids[~((ids >= 0) & (ids < count) & (ids == numpy.floor(ids)))] if ids.size else ids
    if wrong.size:
        raise ValueError(f"{name} names cell {wrong[0]} of a block that has {count} cells of type {block.type}, "
                         "numbered from 0")
    flags = numpy.zeros(count, dtype=bool)
    flags[ids.astype(int)] = True
    return flags


def _describe_nothing(mesh, count):
    """Why nothing flips."""
    counts = {}
    for block in mesh.cells:
        if block.type != "triangle":
            counts[block.type] = counts.get(block.type, 0) + len(block)
    listed = ", ".join(f"{number} {name}" for name, number in counts.items())
    if count:
        return (f"Nothing was flipped: all edges of the {count} triangles are edges of other cells "
                f"({listed}), to which they must fit.")
    listed = f" It has {listed}." if counts else ""
    return (f"Nothing was flipped: the mesh has no cells of type triangle.{listed} Split quads and "
            "polygons into triangles first; cells of higher order and volume cells are never flipped.")

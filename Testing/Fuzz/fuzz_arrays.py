#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: fuzz_arrays.py [--seed S] [--first CASE] [--cases N] [--print]

Gives arrays of random layouts and types to the functions of the Python package, as every array
argument: each result must have the bits of that for plain contiguous copies, or the same error. All
refusals must be ValueError or TypeError and name the argument.
"""
import argparse
import faulthandler
import sys
import tempfile
import warnings

import numpy

import delaunayflip

NAMES = ("points", "triangles", "constraints", "insert_constraints", "regions", "frozen")
ROWS = {"points": "point", "triangles": "triangle", "constraints": "constraint"}
NUMBERS = ("maximum_iterations", "threads", "device", "pieces", "tolerance", "feature_angle",
           "maximum_deviation", "track_quality", "geometry", "criterion", "tie_rule", "devices")


def make_mesh(draw):
    """A lattice of 1 to 4 by 1 to 4 quads, sheared and shaken, as arrays by name."""
    columns, rows = draw.integers(1, 5, 2)
    width = columns + 1
    y, x = numpy.divmod(numpy.arange(width * (rows + 1)), width)
    points = numpy.column_stack([x + draw.choice([0, 1.5, 4]) * y, y, 0 * y]).astype(float)
    points += draw.choice([0, 0.25]) * draw.integers(-1, 2, points.shape)
    a = (numpy.arange(rows)[:, None] * width + numpy.arange(columns)).ravel()
    triangles = numpy.concatenate([numpy.column_stack([a, a + 1, a + width + 1]),
                                   numpy.column_stack([a, a + width + 1, a + width])])
    count = draw.integers(0, 4)
    return {"points": points[:, :draw.integers(2, 4)],
            "triangles": draw.permuted(triangles, axis=0) if draw.random() < 0.2 else triangles,
            "constraints": draw.integers(0, len(points), (count, 2)),
            "insert_constraints": draw.integers(0, 2, count),
            "regions": draw.integers(0, 3, len(triangles)),
            "frozen": draw.integers(0, 2, len(triangles))}


def change_values(draw, values):
    """Faults, and what only looks like one."""
    values = values.copy()
    choice = draw.integers(0, 9)
    if choice == 0 and values.size:
        values.flat[draw.integers(values.size)] = (-1, 1000, 2**31, -2**63)[draw.integers(4)]
    elif choice == 1:
        values = values.astype(float)
        values.flat[:draw.integers(0, 3)] = draw.choice([numpy.nan, numpy.inf, 0.5])
    elif choice == 2:
        values = values.astype(draw.choice(["U8", "c16", "O", "M8[s]", "?"]))
    elif choice == 3:
        values = values.reshape(values.shape + (1,))
    elif choice == 4:
        values = values[..., 0] if values.ndim > 1 else values[:0]
    elif choice == 5:
        values = numpy.array(values.flat[0] if values.size else 1)
    elif choice == 6 and values.size:
        values = abs(values).astype(numpy.uint64)
        values.flat[draw.integers(values.size)] = (2**64 - 1, 2**63, 3)[draw.integers(3)]
    elif choice == 7:
        values = numpy.broadcast_to(values[:1], values.shape)
    elif choice == 8:
        values = values[:0]
    return values


def choose_type(draw, name, values):
    """The values in another type that has them, or rounded."""
    if values.dtype.kind not in "fiu":
        return values
    kinds = ("f2", "f4", "f8", "g", "i4", ">f4", ">f8", "<f8") if name == "points" else (
        "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", ">i2", ">i4", ">i8", ">u8", "<i4")
    kind = numpy.dtype(str(draw.choice(kinds)))
    with numpy.errstate(all="ignore"):
        converted = values.astype(kind)
    return converted if name == "points" or (converted == values).all() else values


class ByDlpack:
    """An array that NumPy can only view by DLPack."""

    def __init__(self, values):
        self.values = values

    def __dlpack__(self, **keywords):
        return self.values.__dlpack__(**keywords)

    def __dlpack_device__(self):
        return 1, 0


class ByMethod:
    """An array of another library that converts itself."""

    def __init__(self, values):
        self.values = values

    def __array__(self, dtype=None, copy=None):
        return self.values if dtype is None else self.values.astype(dtype)


def lay_out(draw, values):
    """The values in another memory layout, or in another container."""
    if values.ndim == 0:
        return (values, values[()])[draw.integers(2)]
    axes = range(values.ndim)
    choice = draw.integers(0, 12)
    if choice == 0:
        return numpy.asfortranarray(values)
    if choice == 1:  # negative strides
        turned = tuple(slice(None, None, draw.choice([1, -1])) for _ in axes)
        return values[turned].copy()[turned]
    if choice == 2:  # gaps, with other numbers in them
        steps = [int(step) for step in draw.integers(1, 4, values.ndim)]
        room = numpy.full([size * step + 2 for size, step in zip(values.shape, steps)], values.flat[0]
                          if values.size else 0, dtype=values.dtype)
        part = room[tuple(slice(1, 1 + size * step, step) for size, step in zip(values.shape, steps))]
        part[...] = values
        return part
    if choice == 3:  # zero strides, of the first row
        return numpy.broadcast_to(values[:1], values.shape) if len(values) else values
    if choice == 4 and values.dtype.kind != "O":  # at an odd address
        buffer = bytearray(values.nbytes + 1)
        moved = numpy.frombuffer(buffer, values.dtype, values.size, 1).reshape(values.shape)
        moved[...] = values
        return moved
    if choice == 5:
        values = values.copy()
        values.flags.writeable = False
    if choice == 6:
        return numpy.ma.array(values, mask=draw.choice([False, True]) and draw.random() < 0.3)
    if choice == 7:
        fields = numpy.zeros(values.shape, [("a", "i1"), ("b", values.dtype)])
        fields["b"] = values
        return fields["b"]
    if choice == 8 and values.ndim == 2:
        return values.view(numpy.matrix) if draw.random() < 0.5 else list(values)
    if choice == 9 and values.dtype in (float, int, "O", "U8"):
        return values.tolist()
    if choice == 10 and values.dtype.isnative and values.dtype.kind in "fiu" and values.dtype != "g":
        return ByDlpack(values.copy())
    return ByMethod(values) if choice == 11 else values


def read_values(given):
    """A plain contiguous copy of what `lay_out` has made, in native byte order; masked stays so."""
    if isinstance(given, numpy.ma.MaskedArray):
        return given.copy()
    given = numpy.asarray(getattr(given, "values", given))
    return numpy.array(given, dtype=given.dtype.newbyteorder("="), order="C")


def run(function, *arguments, **keywords):
    """(bits of the result, None) or (the error's class, its text)."""
    try:
        result = function(*arguments, **keywords)
    except (ValueError, TypeError) as error:
        return type(error), str(error)
    if not isinstance(result, delaunayflip.Result):
        return result.tobytes(), None
    report = {name: value for name, value in vars(result.report).items() if "seconds" not in name}
    return (result.triangles.dtype, result.triangles.tobytes(), result.flip_counts.tobytes(),
            repr(report)), None


def require(is_kept, promise, *details):
    if not is_kept:
        raise AssertionError(f"{promise}: {' | '.join(map(str, details))}")


def check_error(found, names):
    if found[1] is not None:
        words = [ROWS.get(name, name).replace("_", " ") for name in names]
        require(any(word in found[1].replace("_", " ") for word in words),
                f"an error names one of {names}", *found)


def try_layouts(draw, is_printed):
    arrays = make_mesh(draw)
    for name in NAMES[2:]:
        if draw.random() < 0.4:
            del arrays[name]
    if "constraints" not in arrays:
        arrays.pop("insert_constraints", None)
    for name in list(arrays):
        if draw.random() < 0.08:
            arrays[name] = change_values(draw, arrays[name])
    given = {name: lay_out(draw, choose_type(draw, name, values)) for name, values in arrays.items()}
    plain = {name: read_values(values) for name, values in given.items()}
    before = {name: repr(values.tolist()) for name, values in plain.items()}
    options = {"threads": 1, "geometry": str(draw.choice(["auto", "planar-xy", "surface"]))}
    if is_printed:
        print(plain, {name: (type(values), getattr(values, "strides", None), getattr(
            values, "dtype", None)) for name, values in given.items()}, options)
    odd = run(delaunayflip.flip, **given, **options)
    even = run(delaunayflip.flip, **plain, **options)
    require(odd == even or (odd[1] and even[1] and odd[0] is even[0]), "flip gives the same", odd, even)
    check_error(odd, arrays)
    angles = [run(delaunayflip.smallest_angles, some["points"], some["triangles"])
              for some in (given, plain)]
    require(angles[0][0] == angles[1][0], "smallest_angles gives the same", *angles)
    check_error(angles[0], ("points", "triangles"))
    for name, values in before.items():
        require(repr(read_values(given[name]).tolist()) == values, f"{name} are not written")


def try_values(draw, is_printed):
    """Values at places, from points and values of any layout."""
    shape = (draw.integers(0, 9), 2) if draw.random() < 0.7 else (draw.integers(0, 4), 3, 2)
    arrays = {"points": draw.integers(0, 9, (draw.integers(0, 40), 2)).astype(float)}
    arrays["values"] = draw.random((len(arrays["points"]), *draw.integers(1, 3, draw.integers(3))))
    arrays["places"] = 9 * draw.random(shape)
    if draw.random() < 0.2:
        name = str(draw.choice(list(arrays)))
        arrays[name] = change_values(draw, arrays[name])
    given = {name: lay_out(draw, choose_type(draw, "points", values)) for name, values in arrays.items()}
    plain = {name: read_values(values) for name, values in given.items()}
    kinds = delaunayflip.LinearInterpolator, delaunayflip.NaturalNeighborInterpolator
    kind, outside = kinds[draw.integers(2)], str(draw.choice(["nan", "nearest", "error"]))
    if is_printed:
        print(kind, outside, plain, {name: type(values) for name, values in given.items()})

    def interpolate(points, values, places):
        return kind(points, values, outside=outside, threads=1)(places)

    odd, even = run(interpolate, **given), run(interpolate, **plain)
    require(odd == even or (odd[1] and even[1] and odd[0] is even[0]), "values are the same", odd, even)
    check_error(odd, (*arrays, "points"))


def try_target(draw, is_printed):
    """A result goes to an array of any layout, whole and nowhere else, or not at all."""
    arrays = make_mesh(draw)
    with delaunayflip.Session(arrays["points"], arrays["triangles"], threads=1) as session:
        session.advance()
        triangles = session.triangles
        kind = numpy.dtype(str(draw.choice(["i4", "i8", ">i8", "i2", "u8", "f8", ">i4"])))
        shape = triangles.shape if draw.random() < 0.8 else tuple(draw.integers(0, 5, 2))
        target = lay_out(draw, numpy.zeros(shape, dtype=kind))
        if draw.random() < 0.1 and isinstance(target, numpy.ndarray) and target.size:
            with tempfile.TemporaryFile() as file:
                file.write(numpy.asarray(target).tobytes())
                file.flush()
                target = numpy.memmap(file, target.dtype, str(draw.choice(["r", "c"])), 0, target.shape)
        owner = target
        while isinstance(getattr(owner, "base", None), numpy.ndarray):
            owner = owner.base
        if is_printed:
            print(triangles, type(target), getattr(target, "flags", None))
        before = read_values(owner)
        try:
            session.store_triangles(target)
        except (ValueError, TypeError) as error:
            require("target" in str(error), "an error names the target", error)
            require((read_values(owner) == before).all(), "a refused target is not written")
        else:
            require((numpy.asarray(target) == triangles).all(), "the target has the triangles")
            numpy.asarray(target)[...] = 0
            require((read_values(owner) == before).all(), "nothing else is written")


def try_number(draw, is_printed):
    """One option has an unusual value: it is taken, or refused by name."""
    name = str(draw.choice(NUMBERS))
    values = (0, 1, -1, 2, 2**31, 2**32 + 1, 2**63, 2**64, -2**63 - 1, 0.5, 1.0, numpy.nan, numpy.inf,
              10**400, "1", "x", "auto", b"0", None, True, numpy.bool_(False), numpy.int8(1),
              numpy.uint64(2**64 - 1), numpy.float32(0.5), numpy.array(1), numpy.array([1]), [1], [],
              [0.5], (), {}, "0\0", "\ud800", 1j, object(), numpy.array(["auto", "x"]))
    value = values[draw.integers(len(values))]
    if is_printed:
        print(name, repr(value))
    arrays = make_mesh(draw)
    try:
        delaunayflip.flip(arrays["points"], arrays["triangles"],
                          **{"backend": "threads", "threads": 1, name: value})
    except (ValueError, TypeError) as error:
        words = {"device": "GPU", "devices": "GPUs", "tie_rule": "tie rule", "feature_angle": "feature angle",
                 "maximum_deviation": "maximum deviation"}
        require(name in str(error) or words.get(name, name) in str(error),
                f"an error names {name}", type(error), error)


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n")[0].replace("Usage: ", ""))
    for name, default in (("seed", 1), ("first", 0), ("cases", 1000)):
        parser.add_argument(f"--{name}", type=int, default=default)
    parser.add_argument("--print", action="store_true", dest="is_printed")
    options = parser.parse_args()
    warnings.simplefilter("ignore")  # of NumPy, about casts
    faulthandler.enable()
    failed = 0
    for case in range(options.first, options.first + options.cases):
        draw = numpy.random.default_rng([options.seed, case])
        attempts = try_layouts, try_layouts, try_layouts, try_target, try_number, try_values
        attempt = attempts[case % len(attempts)]
        faulthandler.dump_traceback_later(60, exit=True)
        try:
            attempt(draw, options.is_printed)
        except Exception as error:
            failed += 1
            print(f"FAILED: seed {options.seed} case {case}: {type(error).__name__}: {error}",
                  file=sys.stderr)
    last = options.first + options.cases - 1
    print(f"seed {options.seed}, cases {options.first} to {last}: {failed} failed")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())

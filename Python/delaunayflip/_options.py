# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The types of arguments and results. Keyword arguments as the engine's options, and the checks of all
numbers before ctypes takes them: it would cut off what is too large."""
import inspect
import math
import numbers
import operator
import reprlib
import typing
from ctypes import c_char_p, c_double, c_int32, c_int64

import numpy
import numpy.typing

from . import _library
from ._library import InvalidOptions


if typing.TYPE_CHECKING:
    from typing_extensions import Unpack
elif hasattr(typing, "Unpack"):
    Unpack = typing.Unpack
else:
    class Unpack:
        """What an older Python takes for the type of keywords."""

        def __class_getitem__(cls, options):
            return options


class OnDevice(typing.Protocol):
    """An array in the memory of a GPU, of CuPy, PyTorch or Numba."""

    @property
    def __cuda_array_interface__(self) -> typing.Any: ...


class ByDlpack(typing.Protocol):
    """An array of any library with DLPack, in the memory of the host or of a GPU."""

    @property
    def __dlpack__(self) -> typing.Callable[..., typing.Any]: ...

    def __dlpack_device__(self) -> typing.Tuple[int, int]: ...


Numbers = typing.Union[numpy.typing.ArrayLike, OnDevice, ByDlpack]
Array = numpy.typing.NDArray[typing.Any]
# In the order of the enumerations of the header.
Geometry = typing.Literal["auto", "planar", "planar-xy", "surface", "sphere"]
Criterion = typing.Literal["in-circle", "opposite-angles"]
TieRule = typing.Literal["keep", "canonical"]
Backend = typing.Literal["auto", "cuda", "threads"]
#: CUDA's numbers of GPUs, as a sequence or as a text such as "0,1"; or "all".
Devices = typing.Union[str, typing.Sequence[int]]
#: Returning False aborts; any other value continues.
Progress = typing.Callable[[float], typing.Optional[bool]]
OnIteration = typing.Callable[[typing.Dict[str, typing.Any]], typing.Optional[bool]]


class Options(typing.TypedDict, total=False):
    """The keywords of `flip` that a Session takes too, in the order of the header's options. Integers, and
    numbers that the VTK filter limits, have a range."""

    geometry: Geometry
    criterion: Criterion
    tie_rule: TieRule
    backend: Backend
    tolerance: float
    feature_angle: typing.Annotated[float, (0.0, 180.0)]
    maximum_iterations: typing.Annotated[int, (-1, 2**63 - 1)]
    threads: typing.Annotated[int, (0, 2**31 - 1)]
    device: typing.Annotated[int, (-1, 2**31 - 1)]
    track_quality: bool
    pieces: typing.Annotated[int, (0, 255)]
    devices: Devices
    maximum_deviation: float
    minimum_angle: typing.Annotated[float, (0.0, 33.0)]
    maximum_area: typing.Annotated[float, (0.0, math.inf)]
    maximum_edge: typing.Annotated[float, (0.0, math.inf)]
    keep_boundary: bool
    point_limit: typing.Annotated[int, (0, 2**63 - 1)]


_SHORT = reprlib.Repr()
_SHORT.maxother = _SHORT.maxstring = 60
_LONGEST = 120  # of a text by another library


def show(value):
    """The value for a message, in one line: the beginning of a text, a number or a short list of such;
    the type of everything else, with its shape if it has one, because it may be a whole dataset."""
    items = value if isinstance(value, (list, tuple)) and len(value) <= _SHORT.maxlist else [value]
    if all(item is None or isinstance(item, (str, bytes, numbers.Number, numpy.generic)) for item in items):
        return " ".join(_SHORT.repr(value).split())
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple):
        return f"{type(value).__name__} of shape {tuple(shape)}"
    size = f" of length {len(value)}" if isinstance(value, (list, tuple, dict, set)) else ""
    return type(value).__name__ + size


def shorten(text):
    """The text in one line, and only its beginning if it is long."""
    line = " ".join(text.split())
    return line if len(line) <= _LONGEST else line[:_LONGEST] + "..."


def list_ranges(options):
    """The lowest and the highest value of each option that has a range, in a TypedDict of options."""
    hints = typing.get_type_hints(options, include_extras=True)
    return {name: hint.__metadata__[0] for name, hint in hints.items() if hasattr(hint, "__metadata__")}


CHOICES = {name: typing.get_args(Options.__annotations__[name])
           for name in ("geometry", "criterion", "tie_rule", "backend")}
OPTION_KINDS = typing.get_type_hints(Options)
OPTION_RANGES = list_ranges(Options)
#: The goals of refinement, beside `size`. Each of them asks for refinement.
GOALS = ("minimum_angle", "maximum_area", "maximum_edge")
#: The members of the struct that have another name than their keyword.
_NAMES = {"threads": "number_of_threads", "pieces": "number_of_pieces"}
_TYPES = {float: c_double, Devices: c_char_p}  # all others are 32-bit integers, but for a count
#: delaunayflip_options.
Struct = _library.make_struct("Options", (
    (c_int64, "size"),
    *((c_int64 if name in ("maximum_iterations", "point_limit") else _TYPES.get(kind, c_int32), _NAMES.get(name, name))
      for name, kind in OPTION_KINDS.items())))


def make_options(function=None, **keywords):
    """A Struct with the engine's defaults for options that are not given. If `function` has the
    engine's defaults, options that are equal to them are passed over, which takes less time.

    Raises:
        TypeError: A keyword that is no option, or a value of a wrong type.
        ValueError: A word that is not among the choices, or a number out of range.
    """
    options = _library.make(Struct)
    known = {name for name, _ in options._fields_} - {"size"}
    defaults = function.__kwdefaults__ if function else {}
    for keyword, value in keywords.items():
        if keyword in defaults and value is defaults[keyword]:
            continue
        name = _NAMES.get(keyword, keyword)
        if name not in known:
            raise TypeError(f"{keyword!r} is not an option")
        if keyword == "devices":
            value = _list_devices(value)
        elif keyword in CHOICES:
            value = choose(keyword, value)
        else:
            value = convert(keyword, value, OPTION_KINDS[keyword], OPTION_RANGES.get(keyword))
        setattr(options, name, value)
    return options


def has_goal(options, name):
    """Whether keywords have this goal of refinement."""
    given = options.get(name)
    return given is not None if name == "size" else given is not None and to_number(name, given) != 0.0


def refuse_goals(options, name):
    """Raises InvalidOptions if there are goals of refinement, which this module does not support."""
    from ._arrays import as_regions  # which needs this file
    given = [goal for goal in (*GOALS, "size") if has_goal(options, goal)]
    if as_regions("region_seeds", options.get("region_seeds", ()))["maximum_area"].any():
        given.append("an area in region_seeds")
    if given:
        raise InvalidOptions(f"{given[0]}: delaunayflip.{name} keeps the points; use delaunayflip.flip to "
                             "refine a mesh")


def convert(keyword, value, kind, limits):
    """The value of a number or a switch. `kind`: its type. `limits`: those of an integer."""
    if kind is bool:
        return check_integer(keyword, value, 0, 1, "True or False")
    if kind is int:
        return check_integer(keyword, value, *limits)
    return to_number(keyword, value)


def show_options(function, source, names):
    """Has help() show keywords of `source` in place of the **options with which `function` takes them."""
    signature, known = inspect.signature(function), inspect.signature(source).parameters
    own = list(signature.parameters.values())[:-1]
    function.__signature__ = signature.replace(parameters=[*own, *(known[name] for name in names)])


def choose(keyword, word, choices=None):
    """The number of a word among the choices of an option."""
    choices = choices or CHOICES[keyword]
    if not isinstance(word, str) or word not in choices:
        raise ValueError(f"{keyword} must be one of {', '.join(choices)}, not {show(word)}")
    return choices.index(word)


def check_integer(name, value, low, high, wanted=""):
    """The value as int.

    Raises:
        TypeError: It is no integer.
        InvalidOptions: It is out of range.
    """
    wanted = wanted or f"an integer from {low} to {high}"
    try:
        number = operator.index(_as_python(value))
    except TypeError:
        raise TypeError(f"{name} must be {wanted}, not {show(value)}") from None
    if not low <= number <= high:
        raise InvalidOptions(f"{name} must be {wanted}, not {show(value)}")
    return number


def _as_python(value):
    """Python's number for one of NumPy, or for an array of NumPy without dimensions."""
    is_single = isinstance(value, (numpy.generic, numpy.ndarray)) and value.ndim == 0
    return value.item() if is_single and not numpy.ma.isMaskedArray(value) else value


def to_number(name, value):
    number = _as_python(value)
    if not isinstance(number, numbers.Real):
        raise TypeError(f"{name} must be a number, not {show(value)}")
    try:
        return float(number)
    except OverflowError:
        raise InvalidOptions(f"{name} is out of range: {show(value)}") from None


def _list_devices(devices):
    """Numbers of GPUs, or a text of them, as the engine reads it."""
    if not isinstance(devices, str):
        if isinstance(devices, (bytes, bytearray)) or not numpy.iterable(devices):
            raise TypeError(f"devices must be numbers of GPUs, or a text of them, not {show(devices)}")
        highest = OPTION_RANGES["device"][1]
        devices = ",".join(str(check_integer("devices", one, 0, highest)) for one in devices)
    if "\0" in devices:
        raise InvalidOptions(f"devices must be numbers of GPUs, not {show(devices)}")
    return devices.encode(errors="replace")

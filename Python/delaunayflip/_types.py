# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Types of arguments and results."""
import typing

import numpy
import numpy.typing


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
Geometry = typing.Literal["auto", "planar", "planar-xy", "surface"]
Criterion = typing.Literal["in-circle", "opposite-angles"]
TieRule = typing.Literal["keep", "canonical"]
Backend = typing.Literal["auto", "cuda", "threads"]
#: CUDA's numbers of GPUs, as a sequence or as a text such as "0,1"; or "all".
Devices = typing.Union[str, typing.Sequence[int]]
#: Returning False aborts; any other value continues.
Progress = typing.Callable[[float], typing.Optional[bool]]
OnIteration = typing.Callable[[typing.Dict[str, typing.Any]], typing.Optional[bool]]


class Options(typing.TypedDict, total=False):
    """The keywords of `flip` that a Session takes too."""

    geometry: Geometry
    criterion: Criterion
    tie_rule: TieRule
    tolerance: float
    feature_angle: float
    maximum_iterations: int
    backend: Backend
    threads: int
    device: int
    devices: Devices
    pieces: int
    track_quality: bool

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Keyword arguments as the engine's options."""
from . import _library

_CHOICES = {
    "geometry": _library.GEOMETRIES,
    "criterion": _library.CRITERIA,
    "tie_rule": _library.TIE_RULES,
    "backend": _library.BACKENDS,
}
_NAMES = {"threads": "number_of_threads", "pieces": "number_of_pieces"}


def make_options(**keywords):
    """A _library.Options with the engine's defaults for options that are not given.

    Raises:
        TypeError: A keyword that is no option.
        ValueError: A word that is not among the choices.
    """
    options = _library.Options()
    _library.library().delaunayflip_options_init(options)
    known = {name for name, _ in options._fields_} - {"size"}
    for keyword, value in keywords.items():
        name = _NAMES.get(keyword, keyword)
        if name not in known:
            raise TypeError(f"{keyword!r} is not an option")
        value = list_devices(value) if keyword == "devices" else _choose(keyword, value)
        setattr(options, name, value)
    return options


def list_devices(devices):
    """Numbers of GPUs, or a text of them, as the engine reads it."""
    text = devices if isinstance(devices, str) else ",".join(str(int(one)) for one in devices)
    return text.encode()


def _choose(keyword, value):
    choices = _CHOICES.get(keyword)
    if choices is None:
        return value
    if value not in choices:
        raise ValueError(f"{keyword} must be one of {', '.join(choices)}, not {value!r}")
    return choices.index(value)

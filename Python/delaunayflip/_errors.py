# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions of the engine, with its messages. If memory runs out, MemoryError is raised."""


class FlipError(Exception):
    """Base class of the others."""


class InvalidMesh(FlipError, ValueError):
    """A triangle or constraint edge names a point that does not exist.

    Attributes:
        cell: The triangle, or the constraint edge.
        point: The id that it names.
    """

    def __init__(self, message: str, cell: int = -1, point: int = -1) -> None:
        super().__init__(message)
        self.cell = cell
        self.point = point


class InvalidOptions(FlipError, ValueError):
    """Options that are out of range, or contradict each other or the mesh."""


class MeshTooLarge(FlipError, ValueError):
    """More triangles or points than 32-bit indices can number."""


class Stopped(FlipError):
    """A callback stopped a call that cannot return a partial result."""


class BackendUnavailable(FlipError, RuntimeError):
    """The requested backend cannot run here."""

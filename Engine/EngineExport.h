// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ENGINEEXPORT_H
#define DELAUNAYFLIP_ENGINEEXPORT_H

/// @file
/// Marks the engine's public functions and classes, which stay visible in the shared library that
/// the engine is linked into (vtkDelaunayFlipFilters); everything else is hidden there.

#if defined(__GNUC__)
#define DELAUNAYFLIP_EXPORT __attribute__((visibility("default")))
#else
#define DELAUNAYFLIP_EXPORT
#endif

#endif

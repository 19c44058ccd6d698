// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ENGINEEXPORT_H
#define DELAUNAYFLIP_ENGINEEXPORT_H

/// @file
/// Marks the engine's public functions and classes. The shared library into which the engine is
/// linked (vtkDelaunayFlipFilters) exports them and hides everything else.

#if defined(__GNUC__)
#define DELAUNAYFLIP_EXPORT __attribute__((visibility("default")))
#else
#define DELAUNAYFLIP_EXPORT
#endif

#endif

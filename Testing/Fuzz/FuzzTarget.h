// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FUZZTARGET_H
#define DELAUNAYFLIP_FUZZTARGET_H

#include <cstddef>
#include <cstdint>

/// @file
/// The functions of a target that FuzzDriver.cpp and LibFuzzer.cpp call.

/// Called once, before all cases.
void SetUpTarget(int* argc, char** argv);

/// Makes a case from the bytes and judges it.
/// @throws std::exception if a promise was broken.
void RunTarget(const std::uint8_t* bytes, std::size_t size);

/// Writes the case to standard output in readable form.
void PrintTarget(const std::uint8_t* bytes, std::size_t size);

#endif

// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FUZZTARGET_H
#define DELAUNAYFLIP_FUZZTARGET_H

#include <cstddef>
#include <cstdint>

/// @file
/// What FuzzDriver.cpp and LibFuzzer.cpp ask of a target.

/// Once, before all cases.
void SetUpTarget(int* argc, char** argv);

/// Makes a case of the bytes and judges it.
/// @throws std::exception for a promise that was broken.
void RunTarget(const std::uint8_t* bytes, std::size_t size);

/// Writes the case to standard output, for people.
void PrintTarget(const std::uint8_t* bytes, std::size_t size);

#endif

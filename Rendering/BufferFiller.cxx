// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BufferFiller.h"

namespace delaunayflip
{

namespace
{
std::unique_ptr<BufferFiller> (*MakeFiller)() = &MakeCudaFiller;
}

BufferFiller::~BufferFiller() = default;

std::unique_ptr<BufferFiller> MakeBufferFiller() { return MakeFiller(); }

void ReplaceBufferFiller(std::unique_ptr<BufferFiller> (*make)()) { MakeFiller = make; }

}

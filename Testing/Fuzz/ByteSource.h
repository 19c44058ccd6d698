// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BYTESOURCE_H
#define DELAUNAYFLIP_BYTESOURCE_H

#include <cstddef>
#include <cstdint>
#include <random>

namespace delaunayflip
{

/// Random choices made from the bytes of a case. When all bytes are used, a generator seeded by
/// them continues, so that a few bytes make a whole case. A fuzzer that changes the first bytes
/// changes the first choices.
class ByteSource
{
public:
  ByteSource(const std::uint8_t* bytes, std::size_t size)
    : Next(bytes),
      End(bytes + size),
      State(size)
  {
    for (const std::uint8_t* byte = bytes; byte != this->End; ++byte)
    {
      this->State = Mix(this->State ^ *byte);
    }
  }

  /// An integer in [0, count); `count` > 0.
  std::uint32_t Draw(std::uint32_t count)
  {
    std::uint32_t number = this->DrawByte();
    for (std::uint32_t rest = (count - 1) >> 8; rest > 0; rest >>= 8)
    {
      number = number << 8 | this->DrawByte();
    }
    return number % count;
  }

  /// True once in `times`.
  bool Once(std::uint32_t times) { return this->Draw(times) == 0; }

  /// A generator for functions that need one.
  std::mt19937 MakeRandom() { return std::mt19937(this->Draw(0xFFFFFFFFu)); }

private:
  std::uint8_t DrawByte()
  {
    if (this->Next != this->End)
    {
      return *this->Next++;
    }
    this->State = Mix(this->State);
    return static_cast<std::uint8_t>(this->State >> 56);
  }

  /// SplitMix64, a bijection that mixes all bits.
  static std::uint64_t Mix(std::uint64_t x)
  {
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
  }

  const std::uint8_t* Next;
  const std::uint8_t* End;
  std::uint64_t State;
};

}

#endif

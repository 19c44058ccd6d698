// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <random>
#include <string>

/// @file
/// Runs cases without a fuzzer. Case i of seed s is made from the sixteen bytes of s and i, so it
/// is the same on every machine. If a case breaks a promise, the driver prints its number and
/// continues. If a case is ended by a signal or takes longer than a minute, the driver prints its
/// number and stops.

namespace
{

constexpr unsigned MostSeconds = 60; // a case takes milliseconds

volatile std::uint64_t currentCase = 0;

struct Range
{
  std::uint64_t Seed = 1;
  std::uint64_t First = 0;
  std::uint64_t Cases = 1000;
  bool IsPrinted = false;
};

/// Prints the number of the case. Calls only functions that are allowed in a signal handler.
void NameCase(int signal)
{
  std::array<char, 64> text{};
  std::size_t length = text.size();
  for (std::uint64_t rest = currentCase; length == text.size() || rest > 0; rest /= 10)
  {
    text[--length] = static_cast<char>('0' + rest % 10);
  }
  const char* word = signal == SIGALRM ? "HANG in case " : "SIGNAL in case ";
  static_cast<void>(!write(STDERR_FILENO, word, std::strlen(word)));
  static_cast<void>(!write(STDERR_FILENO, &text[length], text.size() - length));
  static_cast<void>(!write(STDERR_FILENO, "\n", 1));
  ::signal(signal, SIG_DFL);
  raise(signal);
}

std::array<std::uint8_t, 16> GetBytes(std::uint64_t seed, std::uint64_t number)
{
  std::seed_seq words{ seed, seed >> 32, number, number >> 32 };
  std::array<std::uint32_t, 16> scattered{};
  words.generate(scattered.begin(), scattered.end());
  std::array<std::uint8_t, 16> bytes{};
  std::transform(scattered.begin(), scattered.end(), bytes.begin(),
    [](std::uint32_t word) { return static_cast<std::uint8_t>(word); });
  return bytes;
}

bool RunCase(std::uint64_t seed, std::uint64_t number)
{
  const auto bytes = GetBytes(seed, number);
  currentCase = number;
  alarm(MostSeconds);
  try
  {
    RunTarget(bytes.data(), bytes.size());
    return true;
  }
  catch (const std::exception& error)
  {
    std::cerr << "FAILED: seed " << seed << " case " << number << ": " << error.what() << std::endl;
    return false;
  }
}

bool ParseNumber(const char* text, std::uint64_t& number)
{
  char* end = nullptr;
  number = std::strtoull(text, &end, 10);
  return *text != '\0' && *end == '\0';
}

bool Parse(int argc, char** argv, Range& range)
{
  for (int i = 1; i < argc; ++i)
  {
    const std::string name = argv[i];
    std::uint64_t* number = name == "--seed" ? &range.Seed
      : name == "--first"                    ? &range.First
      : name == "--cases"                    ? &range.Cases
                                             : nullptr;
    range.IsPrinted = range.IsPrinted || name == "--print";
    if (name != "--print" && !(number && ++i < argc && ParseNumber(argv[i], *number)))
    {
      return false;
    }
  }
  return true;
}

}

int main(int argc, char** argv)
{
  SetUpTarget(&argc, argv);
  Range range;
  if (!Parse(argc, argv, range))
  {
    std::cerr << "usage: " << argv[0] << " [--seed S] [--first CASE] [--cases N] [--print]\n";
    return 2;
  }
  for (const int signal : { SIGALRM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT })
  {
    ::signal(signal, NameCase);
  }
  std::uint64_t failed = 0;
  for (std::uint64_t number = range.First; number < range.First + range.Cases; ++number)
  {
    if (range.IsPrinted)
    {
      const auto bytes = GetBytes(range.Seed, number);
      PrintTarget(bytes.data(), bytes.size());
    }
    failed += RunCase(range.Seed, number) ? 0 : 1;
  }
  std::cout << "seed " << range.Seed << ", cases " << range.First << " to "
            << range.First + range.Cases - 1 << ": " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}

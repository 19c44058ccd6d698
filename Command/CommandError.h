// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_COMMANDERROR_H
#define DELAUNAYFLIP_COMMANDERROR_H

#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

/// @file
/// How the command ends, and words for its messages.

namespace delaunayflip
{

/// What the command returns to the shell.
enum class ExitCode
{
  Done = 0,
  WrongUsage = 2,
  BadFile = 3, ///< Input unreadable or invalid, or an output not writable.
  IterationLimit = 4, ///< The output is written; bad edges may be left.
  NoBackend = 5, ///< The requested backend cannot run here.
  Interrupted = 130 ///< 128 + SIGINT; other signals that end it give 128 + their number.
};

/// Ends the command: the message for the user and the exit code.
class CommandError : public std::runtime_error
{
public:
  CommandError(ExitCode code, const std::string& message)
    : std::runtime_error(message),
      Code(code)
  {
  }

  ExitCode Code;
};

/// A number and its unit, e.g. "1 point" or "2 points".
inline std::string Counted(std::int64_t count, const std::string& noun)
{
  const std::string one = std::to_string(count) + " " + noun;
  return count == 1 ? one : one + "s";
}

/// The words in their order, e.g. "Material, Group".
template <typename Word>
std::string JoinWords(const std::vector<Word>& words, const std::string& separator = ", ")
{
  std::string text;
  for (const Word& word : words)
  {
    if (!text.empty())
    {
      text += separator;
    }
    text += word;
  }
  return text;
}

/// Whether memory was lacking: for an array, even one larger than any memory, or for the stack of a
/// thread, which oneTBB reports only in the text of its message.
inline bool IsLackOfMemory(const std::exception& error)
{
  return dynamic_cast<const std::bad_alloc*>(&error) ||
    dynamic_cast<const std::length_error*>(&error) ||
    std::strstr(error.what(), "pthread_create") != nullptr;
}

}

#endif

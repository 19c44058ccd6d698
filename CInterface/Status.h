// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STATUS_H
#define DELAUNAYFLIP_STATUS_H

#include "delaunayflip_c.h"

#include <cstdint>
#include <stdexcept>
#include <string>

/// @file
/// Converts exceptions to status codes: none may leave a C function.

namespace delaunayflip
{

/// A call that breaks a rule of the header.
class InvalidCall : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

/// @throws InvalidCall
void Require(bool isKept, const char* rule);

/// The last error in a thread.
struct LastError
{
  std::string Message;
  std::int64_t Cell = -1;
  std::int64_t Point = -1;
};

LastError& GetLastError();

/// Stores the message of the exception being handled as the last error, and returns its status.
delaunayflip_status FailByException();

template <typename Work>
delaunayflip_status Try(const Work& work)
{
  try
  {
    work();
    return DELAUNAYFLIP_OK;
  }
  catch (...)
  {
    return FailByException();
  }
}

}

#endif

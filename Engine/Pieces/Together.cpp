// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PieceGroup.h"

#include "FlipError.h"
#include "FlipReport.h"

#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <vector>

namespace delaunayflip
{

namespace
{
/// Why work of a rank failed, as it is sent to the other ranks.
struct RankFailure
{
  char Kind = 0; ///< 0: it did not.
  std::string Text;
};

enum FailureKind : char
{
  None,
  Options,
  Mesh,
  Size,
  Backend,
  Memory,
  Abort,
  Other
};

[[noreturn]] void Throw(char kind, const std::string& text)
{
  switch (kind)
  {
    case Options:
      throw InvalidOptions(text);
    case Mesh:
      throw InvalidMesh(text, -1, -1);
    case Size:
      throw MeshTooLarge(text);
    case Backend:
      throw BackendUnavailable(text);
    case Abort:
      throw RunAborted();
    default:
      throw std::runtime_error(text);
  }
}

/// What the exception that is being handled means.
RankFailure DescribeException()
{
  try
  {
    throw;
  }
  catch (const InvalidOptions& error)
  {
    return { Options, error.what() };
  }
  catch (const InvalidMesh& error)
  {
    return { Mesh, error.what() };
  }
  catch (const MeshTooLarge& error)
  {
    return { Size, error.what() };
  }
  catch (const BackendUnavailable& error)
  {
    return { Backend, error.what() };
  }
  catch (const RunAborted&)
  {
    return { Abort, "" };
  }
  catch (const std::bad_alloc&)
  {
    return { Memory, "not enough memory" };
  }
  catch (const std::exception& error)
  {
    return { Other, error.what() };
  }
  catch (...)
  {
    return { Other, "an exception of unknown type" };
  }
}

/// Throws on every rank if one has failed: the exception of the first of these, which names it.
void ThrowTogether(PieceGroup& group, const RankFailure& failure)
{
  Message message(failure.Text.size() + 1);
  message.front() = failure.Kind;
  std::copy(failure.Text.begin(), failure.Text.end(), message.begin() + 1);
  const std::vector<Message> all = group.Gather(message);
  bool isAborted = false;
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    const char kind = all[rank].front();
    isAborted = isAborted || kind == Abort;
    if (kind != None && kind != Abort)
    {
      const std::string where = all.size() > 1 ? "rank " + std::to_string(rank) + ": " : "";
      Throw(kind, where + std::string(all[rank].begin() + 1, all[rank].end()));
    }
  }
  if (isAborted)
  {
    throw RunAborted();
  }
}

}

void DoTogether(PieceGroup& group, const std::function<void()>& work)
{
  RankFailure failure;
  try
  {
    group.Work(work);
  }
  catch (...)
  {
    failure = DescribeException();
  }
  ThrowTogether(group, failure);
}

}

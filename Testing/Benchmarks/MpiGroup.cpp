// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MpiGroup.h"

#include <mpi.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace delaunayflip
{

namespace
{
/// Messages one after the other.
struct Parcel
{
  std::vector<char> Bytes;
  std::vector<int> Sizes;
  std::vector<int> Begins;

  explicit Parcel(std::vector<int> sizes)
    : Sizes(std::move(sizes)),
      Begins(Sizes.size())
  {
    const std::int64_t total = std::accumulate(this->Sizes.begin(), this->Sizes.end(), 0LL);
    if (total > std::numeric_limits<int>::max())
    {
      throw std::runtime_error("messages of more than 2^31 bytes");
    }
    std::partial_sum(this->Sizes.begin(), this->Sizes.end() - 1, this->Begins.begin() + 1);
    this->Bytes.resize(total);
  }

  std::vector<Message> Split() const
  {
    std::vector<Message> messages;
    for (std::size_t i = 0; i < this->Sizes.size(); ++i)
    {
      const char* begin = this->Bytes.data() + this->Begins[i];
      messages.emplace_back(begin, begin + this->Sizes[i]);
    }
    return messages;
  }
};
}

MpiGroup::MpiGroup(int& argc, char**& argv) { MPI_Init(&argc, &argv); }

MpiGroup::~MpiGroup() { MPI_Finalize(); }

int MpiGroup::GetRank() const
{
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int MpiGroup::GetSize() const
{
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

std::vector<Message> MpiGroup::Exchange(std::vector<Message> messages)
{
  std::vector<int> sizes, sizesBack(messages.size());
  for (const Message& message : messages)
  {
    sizes.push_back(static_cast<int>(message.size()));
  }
  MPI_Alltoall(sizes.data(), 1, MPI_INT, sizesBack.data(), 1, MPI_INT, MPI_COMM_WORLD);
  Parcel sent(sizes), received(sizesBack);
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    std::copy(messages[i].begin(), messages[i].end(), sent.Bytes.begin() + sent.Begins[i]);
  }
  MPI_Alltoallv(sent.Bytes.data(), sent.Sizes.data(), sent.Begins.data(), MPI_CHAR,
    received.Bytes.data(), received.Sizes.data(), received.Begins.data(), MPI_CHAR, MPI_COMM_WORLD);
  return received.Split();
}

std::vector<Message> MpiGroup::Gather(const Message& message)
{
  const int size = static_cast<int>(message.size());
  std::vector<int> sizes(this->GetSize());
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  Parcel received(sizes);
  MPI_Allgatherv(message.data(), size, MPI_CHAR, received.Bytes.data(), received.Sizes.data(),
    received.Begins.data(), MPI_CHAR, MPI_COMM_WORLD);
  return received.Split();
}

void MpiGroup::Wait() { MPI_Barrier(MPI_COMM_WORLD); }

double MpiGroup::Sum(double value)
{
  double sum = 0.0;
  MPI_Allreduce(&value, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return sum;
}

std::uint64_t MpiGroup::PassOn(
  std::uint64_t value, const std::function<std::uint64_t(std::uint64_t)>& change)
{
  for (int rank = 0; rank < this->GetSize(); ++rank)
  {
    value = rank == this->GetRank() ? change(value) : value;
    MPI_Bcast(&value, 1, MPI_UINT64_T, rank, MPI_COMM_WORLD);
  }
  return value;
}

void MpiGroup::Abort() { MPI_Abort(MPI_COMM_WORLD, 1); }

}

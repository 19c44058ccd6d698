// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InputFile.h"

#include "CommandError.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <vector>

namespace delaunayflip
{

namespace
{

std::size_t PhysicalMemory()
{
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
    static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

bool WriteAll(int file, const char* bytes, std::size_t size)
{
  while (size > 0)
  {
    const ssize_t written = write(file, bytes, size);
    if (written < 0)
    {
      return false;
    }
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

/// Lines end with \n, \r\n or \r.
std::size_t CountLines(std::string_view text)
{
  std::size_t lines = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const bool isPair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    lines += text[i] == '\n' || (text[i] == '\r' && !isPair) ? 1 : 0;
  }
  return lines;
}

}

InputFile::InputFile(const std::string& path)
  : Name(path),
    Path(path),
    Descriptor(this->OpenFile())
{
  struct stat status = {};
  fstat(this->Descriptor, &status);
  if (S_ISDIR(status.st_mode))
  {
    this->Fail("is a folder");
  }
  if (!S_ISREG(status.st_mode))
  {
    const int pipe = this->Descriptor;
    this->Descriptor = this->Spool(pipe);
    close(pipe);
    this->Path = "/dev/fd/" + std::to_string(this->Descriptor);
  }
  this->Map();
}

InputFile::~InputFile()
{
  if (!this->Bytes.empty())
  {
    munmap(const_cast<char*>(this->Bytes.data()), this->Bytes.size());
  }
  close(this->Descriptor);
}

int InputFile::OpenFile() const
{
  const int file = open(this->Path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0)
  {
    this->FailToRead();
  }
  return file;
}

int InputFile::Spool(int pipe) const
{
  std::FILE* const temporary = std::tmpfile();
  const int copy = temporary ? fcntl(fileno(temporary), F_DUPFD_CLOEXEC, 0) : -1;
  std::vector<char> buffer(1 << 20);
  std::size_t total = 0;
  ssize_t size = copy < 0 ? -1 : 1;
  while (size > 0 && total <= PhysicalMemory())
  {
    size = read(pipe, buffer.data(), buffer.size());
    total += size > 0 ? static_cast<std::size_t>(size) : 0;
    size = size > 0 && !WriteAll(copy, buffer.data(), static_cast<std::size_t>(size)) ? -1 : size;
  }
  if (size < 0)
  {
    this->FailToRead();
  }
  if (size > 0)
  {
    this->Fail("is a pipe that does not end, or that delivers more bytes than fit into memory");
  }
  std::fclose(temporary);
  return copy;
}

void InputFile::Map()
{
  struct stat status = {};
  fstat(this->Descriptor, &status);
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0)
  {
    return; // nothing to map
  }
  void* const bytes = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, this->Descriptor, 0);
  if (bytes == MAP_FAILED)
  {
    this->FailToRead();
  }
  this->Bytes = { static_cast<const char*>(bytes), size };
}

/// After a system call that failed.
void InputFile::FailToRead() const
{
  if (errno == ENOMEM)
  {
    throw std::bad_alloc();
  }
  this->Fail(std::string("cannot be read: ") + std::strerror(errno));
}

void InputFile::Fail(const std::string& reason) const
{
  throw CommandError(ExitCode::BadFile, this->Name + ": " + reason);
}

void InputFile::FailAt(const char* place, const std::string& reason) const
{
  const auto offset = static_cast<std::size_t>(place - this->Bytes.data());
  const std::size_t line = 1 + CountLines(this->Bytes.substr(0, offset));
  this->Fail("line " + std::to_string(line) + ": " + reason);
}

}

// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InputFile.h"

#include "CommandError.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <new>

namespace delaunayflip
{

InputFile::InputFile(const std::string& path)
  : Name(path),
    Path(path),
    Descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC))
{
  struct stat status = {};
  if (this->Descriptor < 0 || fstat(this->Descriptor, &status) != 0)
  {
    this->FailToRead();
  }
  if (S_ISDIR(status.st_mode))
  {
    this->Fail("is a folder");
  }
  if (!S_ISREG(status.st_mode))
  {
    this->CopyPipe();
    fstat(this->Descriptor, &status);
  }
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

InputFile::~InputFile()
{
  if (!this->Bytes.empty())
  {
    munmap(const_cast<char*>(this->Bytes.data()), this->Bytes.size());
  }
  close(this->Descriptor);
}

/// Puts a temporary file, which has no name, in the place of the pipe.
void InputFile::CopyPipe()
{
  const std::size_t most = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
    static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  std::FILE* const copy = std::tmpfile();
  std::vector<char> buffer(1 << 20);
  std::size_t total = 0;
  if (!copy)
  {
    this->FailToRead();
  }
  ssize_t size = 1;
  while (size > 0 && total <= most)
  {
    size = read(this->Descriptor, buffer.data(), buffer.size());
    if (size < 0 || write(fileno(copy), buffer.data(), static_cast<std::size_t>(size)) != size)
    {
      this->FailToRead();
    }
    total += static_cast<std::size_t>(size);
  }
  if (dup2(fileno(copy), this->Descriptor) < 0)
  {
    this->FailToRead();
  }
  if (size > 0)
  {
    this->Fail("is a pipe that does not end, or that delivers more bytes than fit into memory");
  }
  std::fclose(copy);
  this->Path = "/dev/fd/" + std::to_string(this->Descriptor);
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

namespace
{

bool IsLineEnd(char letter) { return letter == '\n' || letter == '\r'; }

bool IsBlank(char letter)
{
  return letter == ' ' || letter == '\t' || letter == '\v' || letter == '\f';
}

/// Whether a line of an .obj has a name or a path, which may have marks of comments, for other
/// programs too.
/// @param start begins with the first word of the line, or of those that it continues.
bool HasName(std::string_view start)
{
  constexpr std::string_view named[] = { "usemtl", "g", "o", "mtllib" };
  const std::size_t begin = std::min(start.find_first_not_of(" \t\v\f"), start.size());
  start.remove_prefix(begin);
  const std::string_view word = start.substr(0, start.find_first_of(" \t\v\f"));
  return std::find(std::begin(named), std::end(named), word) != std::end(named);
}

/// Without blanks around it, and without quotes around what is left.
std::string_view Trimmed(std::string_view word)
{
  while (!word.empty() && IsBlank(word.front()))
  {
    word.remove_prefix(1);
  }
  while (!word.empty() && IsBlank(word.back()))
  {
    word.remove_suffix(1);
  }
  const bool isQuoted = word.size() > 1 && word.front() == '"' && word.back() == '"';
  if (isQuoted)
  {
    word = word.substr(1, word.size() - 2);
  }
  return word;
}

}

TextLines::TextLines(const InputFile& file, bool isObj)
  : Rest(file.GetBytes()),
    File(file),
    IsObj(isObj)
{
  if (const auto start = this->Rest.substr(0, 2); start == "\xFF\xFE" || start == "\xFE\xFF")
  {
    file.Fail("is text in UTF-16; save it as UTF-8");
  }
  const std::string_view mark = "\xEF\xBB\xBF";
  if (this->Rest.substr(0, mark.size()) == mark)
  {
    this->Rest.remove_prefix(mark.size());
  }
}

bool TextLines::Next()
{
  this->Words.clear();
  bool isContinued = false;
  while ((this->Words.empty() || isContinued) && !this->Rest.empty())
  {
    const std::string_view rest = this->Rest;
    const auto end = std::find_if(rest.begin(), rest.end(), IsLineEnd);
    std::string_view line = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
    const std::size_t ending = rest.substr(line.size(), 2) == "\r\n" ? 2 : 1;
    this->Rest.remove_prefix(std::min(line.size() + ending, rest.size()));
    ++this->Line;
    if (this->IsObj)
    {
      // Also in a line with a name, a backslash behind a # continues nothing.
      const std::string_view plain = line.substr(0, line.find('#'));
      const std::size_t last = plain.find_last_not_of(" \t\v\f");
      isContinued = last != plain.npos && plain[last] == '\\';
      if (isContinued)
      {
        line = plain.substr(0, last);
      }
      else if (!HasName(this->Words.empty() ? line : this->Words[0]))
      {
        line = plain;
      }
    }
    this->Split(line);
  }
  return !this->Words.empty();
}

void TextLines::SeparateBy(std::string_view characters)
{
  const auto found = std::find_if(characters.begin(), characters.end(),
    [this](char letter) { return this->Text.find(letter) != std::string_view::npos; });
  this->Separator = found == characters.end() ? ' ' : *found;
  this->Words.clear();
  this->Split(this->Text);
}

void TextLines::Split(std::string_view line)
{
  this->Text = line;
  auto begin = std::find_if_not(line.begin(), line.end(), IsBlank);
  const bool isRow = begin != line.end() || line.find(this->Separator) != line.npos; // of tabs
  if (this->Separator != ' ' && isRow)
  {
    for (std::size_t start = 0; start <= line.size();)
    {
      std::size_t open = line.find_first_not_of(' ', start);
      while (open < line.size() && line[open] == '"') // again where quotes are doubled
      {
        open = std::min(line.find('"', open + 1), line.size() - 1) + 1;
      }
      const std::size_t end = std::min(line.find(this->Separator, open), line.size());
      this->Words.push_back(Trimmed(line.substr(start, end - start)));
      start = end + 1;
    }
    while (this->Words.size() > 1 && this->Words.back().empty())
    {
      this->Words.pop_back(); // files often end all lines with a separator
    }
    return;
  }
  while (begin != line.end())
  {
    const auto end = std::find_if(begin, line.end(), IsBlank);
    this->Words.emplace_back(&*begin, static_cast<std::size_t>(end - begin));
    begin = std::find_if_not(end, line.end(), IsBlank);
  }
}

void TextLines::Fail(const std::string& reason) const
{
  this->File.Fail(this->Noun + " " + std::to_string(this->Line) + ": " + reason);
}

void TextLines::FailOn(std::string_view word, const char* problem) const
{
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  std::replace_if(
    text.begin(), text.end(), [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  this->Fail("'" + text + "'" + problem);
}

}

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
#include <cstring>
#include <new>

namespace delaunayflip
{

InputFile::InputFile(const std::string& path)
  : Name(path)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); // else a pipe would wait
  struct stat status = {};
  if (file < 0 || fstat(file, &status) != 0)
  {
    this->FailToRead();
  }
  if (!S_ISREG(status.st_mode))
  {
    this->Fail(S_ISDIR(status.st_mode) ? "is a folder" : "is not a regular file");
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const bytes = size > 0 ? mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0) : nullptr;
  if (bytes == MAP_FAILED)
  {
    this->FailToRead();
  }
  close(file);
  this->Bytes = { static_cast<const char*>(bytes), size };
}

InputFile::~InputFile()
{
  if (!this->Bytes.empty())
  {
    munmap(const_cast<char*>(this->Bytes.data()), this->Bytes.size());
  }
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
  return isQuoted ? word.substr(1, word.size() - 2) : word;
}

}

TextLines::TextLines(const InputFile& file, bool isObj)
  : Rest(file.GetBytes()),
    File(file),
    IsObj(isObj)
{
  const std::string_view mark = "\xEF\xBB\xBF";
  this->Rest.remove_prefix(this->Rest.substr(0, mark.size()) == mark ? mark.size() : 0);
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
      line = line.substr(0, line.find('#'));
      const std::size_t last = line.find_last_not_of(" \t\v\f");
      isContinued = last != line.npos && line[last] == '\\';
      line = isContinued ? line.substr(0, last) : line;
    }
    this->Split(line);
  }
  return !this->Words.empty();
}

char TextLines::SeparateBy(std::string_view characters)
{
  const auto found = std::find_if(characters.begin(), characters.end(),
    [this](char letter) { return this->Text.find(letter) != std::string_view::npos; });
  this->Separator = found == characters.end() ? ' ' : *found;
  this->Words.clear();
  this->Split(this->Text);
  return this->Separator;
}

void TextLines::Split(std::string_view line)
{
  this->Text = line;
  auto begin = std::find_if_not(line.begin(), line.end(), IsBlank);
  if (this->Separator != ' ' && begin != line.end())
  {
    for (std::size_t start = 0; start <= line.size();)
    {
      const std::size_t end = std::min(line.find(this->Separator, start), line.size());
      this->Words.push_back(Trimmed(line.substr(start, end - start)));
      start = end + 1;
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
  this->File.Fail("line " + std::to_string(this->Line) + ": " + reason);
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

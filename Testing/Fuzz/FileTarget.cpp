// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FileCases.h"
#include "FuzzTarget.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef DELAUNAYFLIP_SANITIZED
#include <sanitizer/asan_interface.h>
#endif

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <regex>
#include <stdexcept>

/// @file
/// The command as a target for fuzzers: mutated files of the five formats and of points. The
/// program forks for every file and calls the command's own main, so that VTK is loaded once.
///
/// Whatever the file contains, the command must end by itself with one of the exit codes in its
/// help. If it fails, it must say what is wrong and with which file, and keep an earlier output. It
/// must never change the input or leave other files behind. If it succeeds, the output must have as
/// many points, verts and lines as the header of the input says, and no fewer polygons; and it must
/// be able to read its output, which is tried in one of four cases.

/// Command/main.cpp's main.
int RunCommand(int argc, char** argv);

namespace
{

using namespace delaunayflip;
namespace fs = std::filesystem;

constexpr const char* Formats[] = { "vtk", "vtp", "ply", "stl", "obj", "csv" };
constexpr std::uint32_t ReadFormats = 6;
constexpr std::uint32_t WrittenFormats = 5; // the first ones
#ifdef DELAUNAYFLIP_SANITIZED
constexpr rlim_t MostMemory = RLIM_INFINITY; // AddressSanitizer reserves terabytes

/// AddressSanitizer ends a process, by exit code 1, where operator new would throw. Ends it by a
/// signal instead, as a reader that crashes.
void EndWithoutMemory(const char* report)
{
  if (std::strstr(report, "out of memory") != nullptr)
  {
    raise(SIGKILL);
  }
}
#else
constexpr rlim_t MostMemory = rlim_t(4) << 30; // address space; files have a few kB
#endif
constexpr unsigned MostSeconds = 50; // VTK fills the memory that it may have on some counts
constexpr const char* EarlierOutput = "what was here before";

[[noreturn]] void Fail(const std::string& what) { throw std::runtime_error(what); }

std::string ReadFile(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

void WriteFile(const fs::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A temporary folder, removed at the end of the program, and the seed files.
struct FuzzFolder
{
  FuzzFolder()
  {
    std::string name = (fs::temp_directory_path() / "delaunay-flip-fuzz-XXXXXX").string();
    if (!mkdtemp(name.data()))
    {
      Fail("no folder for temporary files");
    }
    this->Folder = name;
    this->Owner = getpid();
    this->Seeds = MakeSeedFiles(name);
  }
  ~FuzzFolder()
  {
    if (getpid() == this->Owner)
    {
      std::error_code ignored;
      fs::remove_all(this->Folder, ignored);
    }
  }

  fs::path Folder;
  int Owner;
  std::vector<SeedFile> Seeds;
};

const FuzzFolder& GetFuzzFolder()
{
  static const FuzzFolder folder;
  return folder;
}

/// A case: a file, and what the command does with it.
struct FileCase
{
  std::string Input, Output; ///< Names within the folder of the case.
  std::string Bytes;
  bool HasEarlierOutput = false;
  bool IsReadAgain = false; ///< Whether the command reads its output, if there is one.
};

FileCase MakeFileCase(const std::uint8_t* bytes, std::size_t size)
{
  const std::vector<SeedFile>& seeds = GetFuzzFolder().Seeds;
  ByteSource source(bytes, size);
  // All formats are equally likely, whatever their numbers of seed files.
  const char* format = Formats[source.Draw(ReadFormats)];
  std::vector<const SeedFile*> candidates;
  for (const SeedFile& seed : seeds)
  {
    if (seed.Extension == format)
    {
      candidates.push_back(&seed);
    }
  }
  const auto draw = [&] { return source.Draw(static_cast<std::uint32_t>(candidates.size())); };
  FileCase drawn;
  drawn.Input = std::string("in.") + format;
  drawn.Output = std::string("out.") + Formats[source.Draw(WrittenFormats)];
  drawn.HasEarlierOutput = source.Once(4);
  drawn.IsReadAgain = source.Once(4);
  const std::string& seed = candidates[draw()]->Bytes;
  drawn.Bytes = MutateFile(seed, candidates[draw()]->Bytes, source);
  return drawn;
}

/// In the child: runs the command like a shell, with its output in a file.
[[noreturn]] void RunInChild(const fs::path& folder, const std::string& in, const std::string& out)
{
  const int text = open((folder / "text").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  dup2(text, STDOUT_FILENO);
  dup2(text, STDERR_FILENO);
  const rlimit memory = { MostMemory, MostMemory };
  setrlimit(RLIMIT_AS, &memory);
  alarm(MostSeconds); // of the watching process; its child goes with it
  std::string words[] = { "delaunay-flip", (folder / in).string(), (folder / out).string(),
    "--threads", "1", "--from-points" };
  char* argv[] = { words[0].data(), words[1].data(), words[2].data(), words[3].data(),
    words[4].data(), words[5].data(), nullptr };
  const bool isOfPoints = in.substr(in.rfind('.')) == ".csv";
  const int code = RunCommand(isOfPoints ? 6 : 5, argv);
  std::cout.flush();
  _exit(code);
}

/// @returns the exit code.
int Run(const fs::path& folder, const std::string& in, const std::string& out)
{
  std::cout.flush();
  const int child = fork();
  if (child == 0)
  {
    for (const int caught : { SIGALRM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT })
    {
      signal(caught, SIG_DFL);
    }
    RunInChild(folder, in, out);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child)
  {
    Fail("no child process");
  }
  if (WIFSIGNALED(status))
  {
    const bool hasHung = WTERMSIG(status) == SIGALRM;
    Fail(hasHung ? "hangs" : std::string("died of ") + strsignal(WTERMSIG(status)));
  }
  return WEXITSTATUS(status);
}

void ExpectNoOtherFiles(const fs::path& folder, const FileCase& drawn)
{
  for (const auto& entry : fs::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    if (name != drawn.Input && name != drawn.Output && name != "text")
    {
      Fail("leaves " + name);
    }
  }
}

/// A failure must change nothing and name a file.
void ExpectFailure(const fs::path& folder, const FileCase& drawn, const std::string& text)
{
  const bool exists = fs::exists(folder / drawn.Output);
  if (exists != drawn.HasEarlierOutput)
  {
    Fail(exists ? "leaves an output" : "removes the earlier output");
  }
  if (exists && ReadFile(folder / drawn.Output) != EarlierOutput)
  {
    Fail("changes the earlier output");
  }
  if (text.find(drawn.Input) == std::string::npos && text.find(drawn.Output) == std::string::npos)
  {
    Fail("names no file: " + text);
  }
}

/// How many of each a file has; -1: not known.
struct FileCounts
{
  std::int64_t Points = -1, Verts = -1, Lines = -1, Faces = -1;
};

/// The sum of the numbers that follow a word, as `pattern` says.
std::int64_t SumOf(const std::string& bytes, const std::string& pattern)
{
  const std::regex numbers(pattern);
  std::int64_t sum = 0;
  for (std::sregex_iterator found(bytes.begin(), bytes.end(), numbers), end; found != end; ++found)
  {
    sum += std::atoll((*found)[1].str().c_str());
  }
  return sum;
}

std::int64_t CountLines(const std::string& bytes, const std::string& beginning)
{
  const std::regex lines("(^|[\r\n])[ \t]*" + beginning);
  return std::distance(
    std::sregex_iterator(bytes.begin(), bytes.end(), lines), std::sregex_iterator());
}

FileCounts CountInXml(const std::string& bytes)
{
  const auto sum = [&bytes](const char* kind)
  { return SumOf(bytes, std::string("<Piece [^>]*NumberOf") + kind + "=\"([0-9]+)\""); };
  return { sum("Points"), sum("Verts"), sum("Lines"), sum("Strips") + sum("Polys") };
}

/// From version 5 on, the number of offsets, which is one more, follows the word. VTK ignores case.
FileCounts CountInLegacy(std::string bytes)
{
  std::transform(bytes.begin(), bytes.end(), bytes.begin(),
    [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  const bool hasOffsets = bytes.find("OFFSETS") != std::string::npos;
  const auto count = [&](const char* kind)
  {
    const std::int64_t number = SumOf(bytes, std::string("\n") + kind + " ([0-9]+) [0-9]+\\s");
    return hasOffsets && number > 0 ? number - 1 : number;
  };
  return { SumOf(bytes, "\nPOINTS ([0-9]+) "), count("VERTICES"), count("LINES"),
    count("POLYGONS") + count("TRIANGLE_STRIPS") };
}

FileCounts CountsOf(const std::string& bytes, const std::string& format)
{
  if (format == "vtp")
  {
    return CountInXml(bytes);
  }
  if (format == "vtk")
  {
    return CountInLegacy(bytes);
  }
  if (format == "ply")
  {
    const std::string head = bytes.substr(0, bytes.find("end_header"));
    return { SumOf(head, "[\r\n]element vertex ([0-9]+)"), -1, -1,
      SumOf(head, "[\r\n]element face ([0-9]+)") };
  }
  if (format == "obj")
  {
    const bool isContinued = bytes.find('\\') != std::string::npos;
    return isContinued ? FileCounts()
                       : FileCounts{ CountLines(bytes, "v[ \t]"), CountLines(bytes, "p[ \t]"),
                           CountLines(bytes, "l[ \t]"), CountLines(bytes, "f[ \t]") };
  }
  if (format == "csv")
  {
    return {};
  }
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, bytes.data() + 80, bytes.size() > 84 ? sizeof(triangles) : 0);
  const bool isBinary = bytes.size() == 84 + 50 * static_cast<std::size_t>(triangles);
  return { -1, -1, -1, isBinary ? triangles : CountLines(bytes, "facet") };
}

void ExpectSameCounts(const FileCounts& in, const FileCounts& out)
{
  const auto compare = [](const char* what, std::int64_t before, std::int64_t after)
  {
    if (before >= 0 && after >= 0 && before != after)
    {
      Fail(std::string("of ") + std::to_string(before) + " " + what + " only " +
        std::to_string(after) + " are in the output");
    }
  };
  compare("points", in.Points, out.Points);
  compare("verts", in.Verts, out.Verts);
  compare("lines", in.Lines, out.Lines);
  compare("polygons", in.Faces, std::min(in.Faces, out.Faces)); // they become triangles
}

std::string FormatOf(const std::string& name) { return name.substr(name.rfind('.') + 1); }

/// How many faces of a .ply may have become something else: those of one and two points become
/// verts and lines, which some formats cannot hold, and those of none are left out.
std::int64_t CountSmallFaces(
  const std::string& text, const std::string& bytes, const FileCounts& out)
{
  const std::string head = bytes.substr(0, bytes.find("end_header"));
  return SumOf(text, "left out ([0-9]+) faces? without points") +
    SumOf(text, "(?:verts|lines) \\(([0-9]+)\\)") + SumOf(head, "[\r\n]element edge ([0-9]+)") +
    std::max<std::int64_t>(out.Verts, 0) + std::max<std::int64_t>(out.Lines, 0);
}

void ExpectSuccess(const fs::path& folder, const FileCase& drawn)
{
  if (!fs::exists(folder / drawn.Output) || ReadFile(folder / drawn.Output) == EarlierOutput)
  {
    Fail("writes nothing and says that all is well");
  }
  const std::string bytes = ReadFile(folder / drawn.Output);
  FileCounts in = CountsOf(drawn.Bytes, FormatOf(drawn.Input));
  const FileCounts out = CountsOf(bytes, FormatOf(drawn.Output));
  if (FormatOf(drawn.Input) == "ply")
  {
    in.Faces -= CountSmallFaces(ReadFile(folder / "text"), bytes, out);
  }
  ExpectSameCounts(in, out);
  const auto isEmpty = [&]
  { return ReadFile(folder / "text").find(": is empty: ") != std::string::npos; };
  if (drawn.IsReadAgain && Run(folder, drawn.Output, "again.vtk") != 0 && !isEmpty())
  {
    Fail("cannot read what it wrote: " + ReadFile(folder / "text"));
  }
}

void JudgeFileCase(const fs::path& folder, const FileCase& drawn)
{
  WriteFile(folder / drawn.Input, drawn.Bytes);
  if (drawn.HasEarlierOutput)
  {
    WriteFile(folder / drawn.Output, EarlierOutput);
  }
  const int code = Run(folder, drawn.Input, drawn.Output);
  const std::string text = ReadFile(folder / "text");
  ExpectNoOtherFiles(folder, drawn);
  if (ReadFile(folder / drawn.Input) != drawn.Bytes)
  {
    Fail("changes the input");
  }
  if (code != 0 && code != 3 && code != 4)
  {
    Fail("exit code " + std::to_string(code) + ": " + text);
  }
  if (code == 3)
  {
    ExpectFailure(folder, drawn, text);
  }
  else
  {
    ExpectSuccess(folder, drawn);
  }
}

}

void SetUpTarget(int* /*argc*/, char** /*argv*/)
{
#ifdef DELAUNAYFLIP_SANITIZED
  __asan_set_error_report_callback(EndWithoutMemory);
#endif
  GetFuzzFolder();
}

void RunTarget(const std::uint8_t* bytes, std::size_t size)
{
  const fs::path folder = GetFuzzFolder().Folder / "case";
  fs::create_directory(folder);
  try
  {
    JudgeFileCase(folder, MakeFileCase(bytes, size));
  }
  catch (...)
  {
    fs::remove_all(folder);
    throw;
  }
  fs::remove_all(folder);
}

void PrintTarget(const std::uint8_t* bytes, std::size_t size)
{
  const FileCase drawn = MakeFileCase(bytes, size);
  WriteFile(drawn.Input, drawn.Bytes);
  std::cout << "wrote " << drawn.Input << "; its output is " << drawn.Output << std::endl;
}

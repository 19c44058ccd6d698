// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Console.h"

#include "CommandError.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iostream>
#include <regex>
#include <utility>

namespace delaunayflip
{

namespace
{

/// Reduces a message of VTK to one line: drops the source file, the object's address, line breaks,
/// and the bytes of a corrupt file that it may quote.
std::string InOneLine(const char* text)
{
  static const std::regex head("^[^\n]*(ERROR|Warning): In [^\n]*\n");
  static const std::regex object("^\\w+ \\(0x[0-9a-fA-F]+\\): ?");
  static const std::regex request(
    "^Algorithm (\\w+) *\\(0x[^\n]*returned failure for request[^]*$");
  static const std::regex breaks("\\s+");
  constexpr std::size_t longest = 2000; // std::regex recurses
  std::string line = std::regex_replace(std::string(text).substr(0, longest), head, "");
  line = std::regex_replace(line, object, "");
  line = std::regex_replace(line, request, "$1 failed");
  line = std::regex_replace(line, breaks, " ");
  std::replace_if(
    line.begin(), line.end(), [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

class CollectingWindow : public vtkOutputWindow
{
public:
  static CollectingWindow* New();
  vtkTypeMacro(CollectingWindow, vtkOutputWindow);

  void DisplayErrorText(const char* text) override { this->Errors.push_back(InOneLine(text)); }
  void DisplayWarningText(const char* text) override { this->Warnings.push_back(InOneLine(text)); }
  void DisplayGenericWarningText(const char* text) override { this->DisplayWarningText(text); }
  void DisplayDebugText(const char*) override {}

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};

vtkStandardNewMacro(CollectingWindow);

/// Joins the lines; repeated lines appear once.
std::string Joined(const std::vector<std::string>& lines)
{
  std::vector<std::string> different;
  for (const std::string& line : lines)
  {
    if (std::find(different.begin(), different.end(), line) == different.end())
    {
      different.push_back(line);
    }
  }
  return JoinWords(different, "; ");
}

bool IsAboutVersion(const std::string& warning)
{
  return warning.find("with older reader version") != std::string::npos ||
    warning.find("is higher than this reader supports") != std::string::npos;
}

CollectingWindow* Window()
{
  return CollectingWindow::SafeDownCast(vtkOutputWindow::GetInstance());
}

/// On a terminal, first erases a progress bar.
void PrintLine(const std::string& line)
{
  if (isatty(STDERR_FILENO))
  {
    std::cerr << "\r\033[K";
  }
  std::cerr << WithoutControls(line) << std::endl;
}

}

std::string WithoutControls(const std::string& text)
{
  std::string safe;
  for (const char letter : text)
  {
    char code[8];
    std::snprintf(code, sizeof(code), "\\x%02x", static_cast<unsigned char>(letter));
    safe += std::iscntrl(static_cast<unsigned char>(letter)) ? code : std::string(1, letter);
  }
  return safe;
}

void PrintError(const std::string& message) { PrintLine("error: " + message); }

void PrintWarning(const std::string& message) { PrintLine("warning: " + message); }

void PrintNote(const std::string& message) { PrintLine("note: " + message); }

void PrintHint(const std::string& message) { PrintLine("hint: " + message); }

void CollectVTKMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<CollectingWindow> window;
  vtkOutputWindow::SetInstance(window);
}

std::vector<std::string> TakeVTKWarnings() { return std::exchange(Window()->Warnings, {}); }

std::string TakeVTKErrors() { return Joined(std::exchange(Window()->Errors, {})); }

std::string TakeVTKProblems()
{
  std::vector<std::string>& warnings = Window()->Warnings;
  const auto problems = std::stable_partition(warnings.begin(), warnings.end(), IsAboutVersion);
  Window()->Errors.insert(Window()->Errors.end(), problems, warnings.end());
  warnings.erase(problems, warnings.end());
  return TakeVTKErrors();
}

ProgressBar::ProgressBar(bool wanted)
  : Draws(wanted && isatty(STDERR_FILENO))
{
}

void ProgressBar::Begin(Phase phase, const std::string& text)
{
  // When the phases end in most runs, as shares of the time.
  constexpr double ends[] = { 0.15, 0.6, 1.0 };
  this->PhaseBegin = std::exchange(this->PhaseEnd, ends[static_cast<std::size_t>(phase)]);
  this->Done = std::max(this->Done, this->PhaseBegin);
  this->Draw(text);
}

void ProgressBar::Show(double fraction, const std::string& text)
{
  const double done = this->PhaseBegin + (this->PhaseEnd - this->PhaseBegin) * fraction;
  this->Done = std::max(this->Done, std::min(done, this->PhaseEnd));
  if (std::chrono::steady_clock::now() - this->LastDrawn >= std::chrono::milliseconds(100))
  {
    this->Draw(text);
  }
}

void ProgressBar::Draw(const std::string& text)
{
  if (!this->Draws)
  {
    return;
  }
  this->LastDrawn = std::chrono::steady_clock::now();
  constexpr int width = 30;
  const int done = static_cast<int>(this->Done * width);
  const std::string percent = std::to_string(static_cast<int>(100.0 * this->Done));
  std::cerr << "\r\033[K[" << std::string(done, '#') << std::string(width - done, '-') << "] "
            << percent << " %, " << text << std::flush;
}

void ProgressBar::Clear()
{
  if (this->Draws)
  {
    std::cerr << "\r\033[K" << std::flush;
  }
}

}

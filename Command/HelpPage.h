// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HELP_PAGE_H
#define DELAUNAYFLIP_HELP_PAGE_H

#include <CLI/CLI.hpp>

#include <string>

/// @file
/// The text of the command's help, and its answers to unknown options.

namespace delaunayflip
{

/// The groups of options in the help, in this order.
inline constexpr const char* ToRead = "What to read";
inline constexpr const char* ToJudge = "Where edges are judged";
inline constexpr const char* ToStay = "What stays";
inline constexpr const char* OfPoints = "From points";
inline constexpr const char* ToRefine = "Points to add";
inline constexpr const char* ToAsk = "Heights from points";
inline constexpr const char* ToRun = "Where it runs";
inline constexpr const char* ToWrite = "What to write";
inline constexpr const char* ToHelp = "Help";

/// Lays out the help in 80 columns, by group, in the same way for every version of CLI11. For each
/// option it says what the option takes, but not which other options it needs or excludes.
class PlainFormatter : public CLI::FormatterBase
{
public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override;

private:
  /// The option in one column, and its help in another one.
  static std::string Describe(const CLI::Option& option);
};

/// The text above the options: what the command does, and examples.
std::string DescribeCommand();

/// The text below the options.
std::string DescribeExitCodes();

/// Returns an answer to an unknown option that asks for a smallest angle, such as --min-angle; or
/// "".
std::string ExplainAngle(const CLI::App& app);

/// Returns, for example, "; did you mean --geometry?" if an unknown option begins like a known one;
/// or "".
std::string SuggestOption(const CLI::App& app);

}

#endif

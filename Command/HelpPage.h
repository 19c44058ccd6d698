// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HELP_PAGE_H
#define DELAUNAYFLIP_HELP_PAGE_H

#include <CLI/CLI.hpp>

#include <string>

/// @file
/// What the command says of itself, and of words that it does not know.

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

/// Help in 80 columns, by group; of an option it says what it takes, and not how it goes with
/// others. Every version of CLI11 lays it out like this.
class PlainFormatter : public CLI::FormatterBase
{
public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override;

private:
  /// The option in one column, and its help in another one.
  static std::string Describe(const CLI::Option& option);
};

/// What stands above the options: what the command does, and examples.
std::string DescribeCommand();

/// What stands below them.
std::string DescribeExitCodes();

/// An answer to a word that asks for a smallest angle by another name; or "".
std::string ExplainAngle(const CLI::App& app);

/// "; did you mean --geometry?" if a word that is no option begins like one.
std::string SuggestOption(const CLI::App& app);

}

#endif

// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GDALMESSAGES_H
#define DELAUNAYFLIP_GDALMESSAGES_H

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal_priv.h>

#include <algorithm>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>

namespace delaunayflip
{

/// A text of a file, which may be corrupt, in one line of UTF-8.
inline std::string Printable(std::string text)
{
  if (!CPLIsUTF8(text.c_str(), -1))
  {
    std::replace_if(
      text.begin(), text.end(), [](char letter) { return letter < 0 || letter > 126; }, '?');
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Prepares GDAL, and collects its messages while this object lives, those of its threads too.
class GdalMessages
{
public:
  GdalMessages()
    : Before(CPLSetErrorHandlerEx(&GdalMessages::Take, this))
  {
    GDALAllRegister();
    CPLSetConfigOption("GDAL_PAM_ENABLED", "NO"); // no files .aux.xml beside a raster
  }
  ~GdalMessages() { CPLSetErrorHandlerEx(this->Before, nullptr); }
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;

  bool HasErrors() const { return !this->Errors.empty(); }

  /// @throws std::runtime_error if there was an error.
  void Check() const
  {
    if (this->HasErrors())
    {
      this->Fail();
    }
  }

  /// @throws std::runtime_error with the errors.
  [[noreturn]] void Fail() const { throw std::runtime_error(Join(this->Errors)); }

  std::set<std::string> Warnings;

private:
  static void CPL_STDCALL Take(CPLErr kind, CPLErrorNum, const char* text)
  {
    auto* const messages = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    const std::lock_guard<std::mutex> lock(messages->Taking);
    std::set<std::string>& taken = kind >= CE_Failure ? messages->Errors : messages->Warnings;
    constexpr std::size_t most = 3; // a corrupt file may have one for each feature
    if (kind >= CE_Warning && taken.size() < most)
    {
      taken.insert(Printable(text));
    }
  }

  static std::string Join(const std::set<std::string>& texts)
  {
    std::string joined;
    for (const std::string& text : texts)
    {
      joined += "; " + text;
    }
    return joined.empty() ? "GDAL gives no reason" : joined.substr(2);
  }

  CPLErrorHandler Before;
  std::set<std::string> Errors;
  std::mutex Taking;
};

}

#endif

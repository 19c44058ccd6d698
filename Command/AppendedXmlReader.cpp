// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "AppendedXmlReader.h"

#include <vtkObjectFactory.h>
#include <vtkXMLDataParser.h>

#include <string>

namespace delaunayflip
{

namespace
{
/// Ends the document, which VTK's parser does where the appended data begin, with white space until
/// expat has seen the end.
class PatientParser : public vtkXMLDataParser
{
public:
  static PatientParser* New();
  vtkTypeMacro(PatientParser, vtkXMLDataParser);

protected:
  int ParseBuffer(const char* buffer, unsigned int count) override
  {
    constexpr int TagLength = 13; // of "<AppendedData"
    constexpr int MostBlanks = 4096; // times 4 KiB: more than any header
    static const std::string blanks(4096, ' ');
    int result = this->Superclass::ParseBuffer(buffer, count);
    const bool isAtEnd = this->AppendedDataMatched == TagLength;
    for (int i = 0; result != 0 && isAtEnd && this->AppendedDataPosition == 0 && i < MostBlanks;
         ++i)
    {
      result =
        this->vtkXMLParser::ParseBuffer(blanks.data(), static_cast<unsigned int>(blanks.size()));
    }
    return result;
  }
};

vtkStandardNewMacro(PatientParser);
}

vtkStandardNewMacro(AppendedXmlReader);

void AppendedXmlReader::CreateXMLParser() { this->XMLParser = PatientParser::New(); }

}

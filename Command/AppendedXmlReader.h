// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef AppendedXmlReader_h
#define AppendedXmlReader_h

#include <vtkXMLPolyDataReader.h>

namespace delaunayflip
{

/// VTK's reader of .vtp files, and able to read those with appended data, which VTK writes by
/// default, with any expat. From 2.6 on, and from Debian's 2.5.0-1+deb12u2 on, expat looks at the
/// end of a document only when more comes; VTK 9.1 then takes the data for XML and fails.
class AppendedXmlReader : public vtkXMLPolyDataReader
{
public:
  static AppendedXmlReader* New();
  vtkTypeMacro(AppendedXmlReader, vtkXMLPolyDataReader);

protected:
  void CreateXMLParser() override;
};

}

#endif

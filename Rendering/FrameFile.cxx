// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FrameFile.h"

#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkRenderWindow.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <fstream>

namespace delaunayflip
{

std::string MakeFrameName(const std::string& prefix, int frame)
{
  const std::string number = std::to_string(frame);
  return prefix + std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number + ".png";
}

/// Encodes the PNG in memory first, because VTK's writer does not report a full disk.
bool WriteFrame(vtkRenderWindow* window, const std::string& fileName)
{
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  picture->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (!bytes || bytes->GetNumberOfValues() == 0)
  {
    return false;
  }
  std::ofstream file(fileName, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes->GetPointer(0)),
    static_cast<std::streamsize>(bytes->GetNumberOfValues()));
  file.close();
  return file.good();
}

}

// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceDrawing.h"

#include "vtkVersion.h"

#include <limits>

/// @file
/// Takes the place of DeviceDrawing.cxx where VTK is newer than 9.1, whose mapper it needs.

namespace delaunayflip
{

struct DeviceDrawing::Parts
{
};

DeviceDrawing::DeviceDrawing() = default;

DeviceDrawing::~DeviceDrawing() = default;

void DeviceDrawing::Begin(vtkRenderWindow*, vtkActor*, vtkDelaunayFlip*)
{
  this->Obstacle = std::string("VTK ") + vtkVersion::GetVTKVersion() +
    " is not 9.1, the release whose buffers can be filled";
}

void DeviceDrawing::End(const std::string& reason) { this->Obstacle = reason; }

bool DeviceDrawing::IsOn() const { return false; }

void DeviceDrawing::BeginStep() {}

void DeviceDrawing::NoteStep() {}

bool DeviceDrawing::TakeNextRun() { return false; }

bool DeviceDrawing::Fill(const Coloring&) { return false; }

void DeviceDrawing::SetQuiet(bool) {}

std::string DeviceDrawing::GetFailure() const { return this->Obstacle; }

double DeviceDrawing::GetSmallestAngle() const { return std::numeric_limits<double>::quiet_NaN(); }

}

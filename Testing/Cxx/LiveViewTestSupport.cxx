// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LiveViewTestSupport.h"

#include "TestWindow.h"

#include "vtkActor.h"
#include "vtkActor2DCollection.h"
#include "vtkActorCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace
{

/// The texts of a renderer: the status, then the keys.
std::string GetText(vtkRenderer* renderer, int number)
{
  vtkActor2DCollection* actors = renderer->GetActors2D();
  actors->InitTraversal();
  while (vtkActor2D* actor = actors->GetNextActor2D())
  {
    auto* text = vtkTextActor::SafeDownCast(actor);
    if (text && number-- == 0)
    {
      return text->GetVisibility() ? text->GetInput() : "";
    }
  }
  return "";
}

}

WatchedView::WatchedView(vtkPolyData* input, bool isOffScreen)
  : Filter(input),
    Window(MakeTestWindow()),
    Interactor(MakeTestInteractor()),
    View(vtkSmartPointer<vtkDelaunayFlipLiveView>::New())
{
  this->Window->SetSize(200, 200);
  this->Window->SetMultiSamples(0);
  this->Window->SetOffScreenRendering(isOffScreen);
  this->Interactor->SetRenderWindow(this->Window);
  this->View->SetFilter(this->Filter.Get());
  this->View->SetInteractor(this->Interactor);
  this->View->SetFrameInterval(1);
  OnEvent(this->View, vtkCommand::UpdateEvent, [this]() { ++this->Frames; });
  OnEvent(this->View, vtkCommand::StartEvent, [this]() { ++this->Starts; });
  OnEvent(this->View, vtkCommand::EndEvent, [this]() { ++this->Ends; });
  Observe(this->View, vtkCommand::ErrorEvent,
    [this](void* text) { this->Errors.emplace_back(static_cast<const char*>(text)); });
}

void WatchedView::RunToTheEnd()
{
  const int ends = this->Ends;
  OnEvent(this->View, vtkCommand::EndEvent, [this]() { this->Interactor->TerminateApp(); });
  this->View->Run();
  this->RunUntilItStops();
  EXPECT_EQ(this->Ends, ends + 1);
}

int WatchedView::RunUntilItStops()
{
  const int timer = this->Interactor->CreateRepeatingTimer(300);
  int looks = 0;
  bool wasRunning = true;
  const unsigned long observer = Observe(this->Interactor, vtkCommand::TimerEvent,
    [&](void* id)
    {
      if (*static_cast<int*>(id) == timer)
      {
        if (++looks == 200 || !wasRunning)
        {
          this->Interactor->TerminateApp();
        }
        wasRunning = this->View->IsRunning();
      }
    });
  this->Interactor->Start();
  this->Interactor->RemoveObserver(observer);
  this->Interactor->DestroyTimer(timer);
  return looks;
}

bool WatchedView::Press(const char* key)
{
  int heard = 0;
  for (const unsigned long event : { vtkCommand::KeyPressEvent, vtkCommand::CharEvent })
  {
    this->Interactor->SetKeySym(key);
    const unsigned long observer = Observe(this->Interactor, event, [&heard](void*) { ++heard; });
    this->Interactor->InvokeEvent(event);
    this->Interactor->RemoveObserver(observer);
  }
  return heard > 0;
}

std::string WatchedView::GetStatus() { return GetText(this->View->GetRenderer(), 0); }

std::string WatchedView::GetKeys() { return GetText(this->View->GetRenderer(), 1); }

Bytes WatchedView::GetPicture()
{
  vtkNew<vtkUnsignedCharArray> pixels;
  const int* size = this->Window->GetSize();
  this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
  return Bytes(pixels->GetPointer(0), pixels->GetPointer(pixels->GetNumberOfValues()));
}

bool WatchedView::HasEdges() { return this->GetActor()->GetProperty()->GetEdgeVisibility() != 0; }

vtkActor* WatchedView::GetActor()
{
  vtkActorCollection* actors = this->View->GetRenderer()->GetActors();
  actors->InitTraversal();
  return actors->GetNextActor();
}

vtkDelaunayFlipMapper* WatchedView::GetMapper()
{
  return vtkDelaunayFlipMapper::SafeDownCast(this->GetActor()->GetMapper());
}

void WatchedView::StepToTheEnd()
{
  while (this->View->Step())
  {
  }
}

ViewPair::ViewPair(vtkPolyData* mesh)
  : Copying(mesh),
    Sharing(mesh)
{
  this->Copying->ZeroCopyOff();
}

bool ViewPair::Step()
{
  const bool goesOn = this->Copying->Step();
  EXPECT_EQ(this->Sharing->Step(), goesOn);
  EXPECT_EQ(this->Sharing.GetStatus(), this->Copying.GetStatus());
  this->ExpectSamePicture();
  return goesOn;
}

void ViewPair::ExpectSamePicture()
{
  // At most one pixel in 1,000 may differ: a triangle at the edge of two colours may have either.
  EXPECT_LE(Compare(this->Sharing.GetPicture(), this->Copying.GetPicture()), 0.001)
    << "frame " << this->Sharing->GetFrameNumber();
}

double Compare(const Bytes& a, const Bytes& b)
{
  EXPECT_EQ(a.size(), b.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i + 2 < std::min(a.size(), b.size()); i += 3)
  {
    bool isSame = true;
    for (std::size_t k = i; k < i + 3; ++k)
    {
      isSame = isSame && std::abs(int(a[k]) - int(b[k])) <= 8;
    }
    different += isSame ? 0 : 1;
  }
  return 3.0 * static_cast<double>(different) / static_cast<double>(a.size());
}

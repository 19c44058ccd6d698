// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREONBACKEND_H
#define DELAUNAYFLIP_SPHEREONBACKEND_H

#include "Array.h"
#include "LoadedSphere.h"
#include "SpherePasses.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// Stores numbers of three per triangle in arrays of the caller's.
struct StoreNumberStep
{
  const std::int32_t* Numbers;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, const MutableTriangleArray& target) const
  {
    target.Set(i / 3, static_cast<int>(i % 3), this->Numbers[i]);
  }
};

/// Points on a sphere in the memory of a backend.
template <typename Backend>
class SphereOnBackend : public LoadedSphere
{
public:
  explicit SphereOnBackend(Backend backend)
    : Device(std::move(backend))
  {
  }

  /// Reads x, y and z. To be called once, at first.
  void Load(const PointInput& input)
  {
    if (input.Points.Floats)
    {
      this->Load(input, input.Points.Floats);
    }
    else
    {
      this->Load(input, input.Points.Doubles);
    }
  }

  std::unique_ptr<DeviceScope> MakeCurrent() const override { return this->Device.MakeCurrent(); }

  bool AreUsual() const override
  {
    return this->Device.template Sum<std::int64_t>(this->Count, UnusualStep{ this->View() }) == 0;
  }

  Simplex FindSimplex() const override
  {
    return delaunayflip::FindSimplex(this->View(), this->Device);
  }

  PlaneArray Project(const NumberedPoint& pole, std::int64_t& unplaced) override
  {
    // There are at most 2 n - 4 triangles. The sum waits until all memory is there for any stream.
    this->Triangles = this->Device.template MakeArray<std::int32_t>(6 * this->Count);
    this->Neighbors = this->Device.template MakeArray<std::int32_t>(6 * this->Count);
    this->Places = this->Device.template MakeArray<double>(2 * (this->Count - 1));
    const ProjectionStep project{ this->View(), StereographicProjection(pole.Place), { pole.Id },
      this->Places.Data() };
    unplaced = this->Device.template Sum<std::int64_t>(this->Count, project);
    return PlaneArray(this->Places.Data(), this->Count - 1, 2);
  }

  std::int32_t* GetTriangles() override { return this->Triangles.Data(); }
  std::int32_t* GetNeighbors() override { return this->Neighbors.Data(); }

  void JoinPole(std::int64_t inPlane, std::int32_t pole) override
  {
    this->Places = Array<double>();
    const PlaneNumbers numbers{ pole };
    std::int32_t* ids = this->Triangles.Data();
    this->Device.ForEach(3 * inPlane,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { ids[i] = numbers.GetId(ids[i]); });
    const SphereTriangles triangles{ this->Triangles.Data(), this->Neighbors.Data(), inPlane };
    const std::vector<BoundarySide> sides = ListBoundary(triangles, this->Device);
    const PoleStar star = MakePoleStar(sides, inPlane, pole);
    const std::int64_t made = SizeOf(sides);
    this->Device.Upload(star.Triangles.data(), 3 * made, this->Triangles.Data() + 3 * inPlane);
    this->Device.Upload(star.Neighbors.data(), 3 * made, this->Neighbors.Data() + 3 * inPlane);
    Array<BoundarySide> here = this->Device.template MakeArray<BoundarySide>(made);
    this->Device.Upload(sides.data(), made, here.Data());
    const BoundarySide* sideOf = here.Data();
    std::int32_t* neighbors = this->Neighbors.Data();
    this->Device.ForEach(made,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { neighbors[sideOf[i].Corner] = static_cast<std::int32_t>(inPlane + i); });
    this->NumberOfTriangles = inPlane + made;
  }

  std::int64_t CountTriangles() const override { return this->NumberOfTriangles; }

  StartSums TestStart(const PlanePoint& center) const override
  {
    const SphereTriangles triangles{ this->Triangles.Data(), this->Neighbors.Data(),
      this->NumberOfTriangles };
    return this->Device.template Sum<StartSums>(
      this->NumberOfTriangles, StartStep{ this->Points.Data(), triangles, center });
  }

  void Fetch(PlanePoint* points, std::int32_t* triangles, std::int32_t* neighbors) const override
  {
    this->Device.Download(this->Points.Data(), this->Count, points);
    this->Device.Download(this->Triangles.Data(), 3 * this->NumberOfTriangles, triangles);
    this->Device.Download(this->Neighbors.Data(), 3 * this->NumberOfTriangles, neighbors);
  }

  // Public because device lambdas require it.

  template <typename Real>
  void Load(const PointInput& input, const Real* given)
  {
    this->Count = input.Points.Count;
    this->Points = this->Device.template MakeArray<PlanePoint>(this->Count);
    const std::int64_t stride = input.Points.Stride;
    Array<Real> copied;
    if (!input.OnDevice)
    {
      const std::int64_t numbers = (this->Count - 1) * stride + 3;
      copied = this->Device.template MakeArray<Real>(numbers);
      this->Device.Upload(given, numbers, copied.Data());
      given = copied.Data();
    }
    const PlaneArray from(given, this->Count, stride);
    PlanePoint* to = this->Points.Data();
    this->Device.ForEach(this->Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) {
        to[i] = { from.Get(i, 0), from.Get(i, 1), from.Get(i, 2) };
      });
  }

protected:
  const Backend& GetBackend() const { return this->Device; }

private:
  SpherePoints View() const { return { this->Points.Data(), nullptr, this->Count }; }

  Backend Device;
  std::int64_t Count = 0;
  std::int64_t NumberOfTriangles = 0;
  Array<PlanePoint> Points;
  Array<double> Places; ///< In the plane, as long as triangles are made from them.
  Array<std::int32_t> Triangles, Neighbors;
};

}

#endif

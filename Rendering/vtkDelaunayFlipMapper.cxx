// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipMapper.h"

#include "BufferFiller.h"
#include "DataArrays.h"
#include "DelaunayFlip.h"
#include "MapperBuffers.h"
#include "MapperColors.h"
#include "MapperMesh.h"
#include "MapperShaders.h"
#include "MeshAudit.h"
#include "OpenGLFunctions.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDelaunayFlipAlgorithm.h"
#include "vtkIntArray.h"
#include "vtkLookupTable.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkShaderProgram.h"
#include "vtkTriangleFilter.h"
#include "vtkTypeInt32Array.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace delaunayflip;
using Buffer = vtkOpenGLBufferObject;

namespace
{

constexpr int MostPlanes = 6; ///< VTK's own mapper has as many.
constexpr const char* NoRun = "there is no live run of one mesh of triangles";

}

/// The mesh as it is on the host, and what OpenGL has of it.
struct vtkDelaunayFlipMapper::Parts
{
  vtkSmartPointer<vtkDelaunayFlipAlgorithm> Filter;
  std::pair<vtkPolyData*, vtkMTimeType> Input; ///< The input and its time, only to be compared.
  vtkSmartPointer<vtkPolyData> Faces = vtkSmartPointer<vtkPolyData>::New(); ///< The input's faces.
  bool IsFollowing = false; ///< The session has triangles of moved points, in place of the faces.
  vtkNew<vtkTypeInt32Array> Ids; ///< The corners of the triangles that the host has last had.
  std::vector<unsigned char> AreUsed; ///< By point: whether the input's triangles use it.
  vtkBoundingBox Box; ///< Holds the points that triangles use; not valid if nothing can be drawn.

  vtkWeakPointer<vtkOpenGLRenderWindow> Window; ///< That of the buffers.
  ShaderBuffer Places, Corners, Counts;
  vtkNew<vtkOpenGLVertexArrayObject> Array;
  std::int64_t Count = 0, PointCount = 0; ///< What the buffers hold; 0: there are none.
  std::int64_t Capacity = 0; ///< How many triangles the buffers have room for.
  vtkMTimeType PointsTime = 0; ///< The time of the points in the buffer.
  double Center[3] = { 0.0, 0.0, 0.0 };
  double Unit = 1.0; ///< The unit of places in the shader.

  std::unique_ptr<BufferFiller> Filler; ///< Null: the host fills.
  bool IsOfAnother = false; ///< The filler was made for another filter, maybe on another GPU.
  std::string Obstacle = NoRun; ///< Why the host fills.
  bool MayUseDevice = true; ///< The device has not failed since the host got a mesh.
  bool IsBehind = true; ///< The buffers hold an earlier mesh.
  bool IsNew = true; ///< They may hold another run's mesh, or what the filler has not written.
  bool ByFlipCount = false; ///< What colours show.
  double LargestCount = 0.0; ///< The largest flip count of any mesh so far.
  vtkNew<vtkLookupTable> Table;
  double TableKind = -1.0; ///< What the table was filled for: a largest count, or -1 for angles.
  bool HasWarned = false;

  /// The session that has the triangles of the faces or of their moved points, or null.
  const FlipSession* FindSession() const
  {
    const FlipSession* session = this->Filter ? this->Filter->GetSession() : nullptr;
    if (!session)
    {
      return nullptr;
    }
    const bool isOfFaces = this->IsFollowing
      ? session->GetReport().Points == this->Faces->GetNumberOfPoints()
      : session->GetReport().Triangles == this->Faces->GetNumberOfPolys();
    return isOfFaces ? session : nullptr;
  }

  /// How many triangles are drawn. While the mapper follows moved points, the filter may be updated
  /// by others, and its session has other triangles then. The buffers keep theirs until the next
  /// step.
  std::int64_t CountTriangles() const
  {
    if (this->IsFollowing && !this->IsBehind)
    {
      return this->Count;
    }
    const FlipSession* session = this->FindSession();
    return session ? session->GetReport().Triangles : this->Ids->GetNumberOfValues() / 3;
  }

  /// The faces are a copy of the mesh, which shares arrays, if its polygons are triangles, as in
  /// outputs of the filter. Otherwise polygons and strips are split into triangles. There are none
  /// if the mesh cannot be drawn: it may be one that no filter has checked.
  void ReadFaces(vtkPolyData* mesh)
  {
    this->Faces = vtkSmartPointer<vtkPolyData>::New();
    if (mesh && CanDraw(mesh))
    {
      this->Faces->ShallowCopy(mesh);
    }
    const vtkIdType size = this->Faces->GetPolys()->IsHomogeneous(); // 0: there are none
    if (this->Faces->GetNumberOfStrips() > 0 || (size != 3 && size != 0))
    {
      vtkNew<vtkTriangleFilter> split;
      split->SetInputData(this->Faces);
      split->Update();
      this->Faces = split->GetOutput();
    }
    CopyIds(this->Faces->GetPolys(), this->Ids);
    this->IsFollowing = false;
    this->AreUsed.assign(static_cast<std::size_t>(this->Faces->GetNumberOfPoints()), 0);
    for (vtkIdType i = 0; i < this->Ids->GetNumberOfValues(); ++i)
    {
      this->AreUsed[this->Ids->GetValue(i)] = 1;
    }
    this->MeasureBox();
  }

  void MeasureBox()
  {
    this->Box.Reset();
    if (this->Ids->GetNumberOfValues() == 0)
    {
      return;
    }
    std::vector<double> storage;
    BoxOfPoints box{ ViewPoints(this->Faces, storage), this->AreUsed.data(), this->Box, {} };
    vtkSMPTools::For(0, this->Faces->GetNumberOfPoints(), box);
  }

  /// Keeps those that there are, if they have the right sizes. Followed points change the number of
  /// triangles whenever their hull changes, so there is room for a few more.
  void MakeBuffers(vtkOpenGLRenderWindow* window)
  {
    constexpr std::int64_t PartOfRoom = 64, LeastRoom = 64;
    if (this->Window != window)
    {
      this->Release(this->Window);
    }
    const std::int64_t count = this->CountTriangles();
    const std::int64_t points = this->Faces->GetNumberOfPoints();
    const bool hasRoom = this->IsFollowing ? count <= this->Capacity : count == this->Capacity;
    if (this->Count > 0 && hasRoom && points == this->PointCount)
    {
      this->Count = count;
      return;
    }
    this->Release(this->Window);
    window->MakeCurrent();
    this->Window = window;
    this->Count = count;
    this->Capacity = this->IsFollowing ? count + count / PartOfRoom + LeastRoom : count;
    this->PointCount = points;
    this->UploadPoints();
    this->UploadTriangles(nullptr);
    this->UploadFlipCounts(nullptr);
    this->Places.MakeReadable(window, 3 * points, GL_R32F);
    this->Corners.MakeReadable(window, 3 * this->Capacity, GL_R32I);
    this->Counts.MakeReadable(window, this->Capacity, GL_R32I);
    this->Counts.Texture->OnRelease = [this](vtkWindow* current) { this->Release(current); };
  }

  /// Needs the window's context only if it is given.
  void Release(vtkWindow* window)
  {
    if (std::exchange(this->Count, 0) == 0)
    {
      return;
    }
    if (window)
    {
      window->MakeCurrent();
    }
    this->Filler.reset();
    for (ShaderBuffer* buffer : { &this->Places, &this->Corners, &this->Counts })
    {
      buffer->Release(window);
    }
    this->Array->ReleaseGraphicsResources();
    this->PointsTime = 0;
    this->IsBehind = true;
  }

  void UploadPoints()
  {
    vtkPoints* points = this->Faces->GetPoints();
    const vtkMTimeType time = points->GetMTime();
    if (std::exchange(this->PointsTime, time) == time)
    {
      return;
    }
    const double half = 0.5 * this->Box.GetDiagonalLength();
    const bool isUsable = half > 0.0 && std::isfinite(half);
    this->Unit = isUsable ? half : 1.0;
    this->Box.GetCenter(this->Center);
    std::vector<double> storage;
    const PointArray given = ViewPoints(this->Faces, storage);
    std::vector<float> places(3 * static_cast<std::size_t>(this->PointCount));
    vtkSMPTools::For(0, this->PointCount,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          for (int axis = 0; axis < 3; ++axis)
          {
            places[3 * i + axis] =
              static_cast<float>((given.Get(i, axis) - this->Center[axis]) / this->Unit);
          }
        }
      });
    this->Places.Values->Upload(places, Buffer::ArrayBuffer);
  }

  /// Brings the buffers of triangles and, if colours show them, of flip counts up to date. If the
  /// filter has failed, its session is gone, but the mesh in the buffers stays.
  void Fill(const FlipSession* session, bool allowsDevice)
  {
    if (std::exchange(this->IsOfAnother, false))
    {
      this->Filler.reset();
    }
    if (!session)
    {
      this->Filler.reset();
      this->Obstacle = NoRun;
    }
    else if (!allowsDevice)
    {
      this->Filler.reset();
      this->Obstacle = "ZeroCopy is off";
    }
    else if (!this->Filler && this->MayUseDevice)
    {
      this->Filler = DeviceFillerMaker(
        this->Filter, static_cast<unsigned int>(this->Corners.Values->GetHandle()));
      this->IsNew = true;
    }
    if (this->IsBehind)
    {
      if (this->Filler)
      {
        this->Filler->Fill(*session, std::exchange(this->IsNew, false));
      }
      else
      {
        this->UploadTriangles(session);
      }
      if (this->ByFlipCount)
      {
        this->UploadFlipCounts(session);
      }
      this->IsBehind = false;
    }
    else if (this->Filler)
    {
      this->Filler->Unmap();
    }
  }

  /// Does without the device, which has failed.
  void Abandon(const std::exception& error)
  {
    this->Filler.reset();
    this->Obstacle = error.what();
    this->MayUseDevice = false;
    this->IsBehind = true;
  }

  void UploadTriangles(const FlipSession* session)
  {
    if (session)
    {
      this->Ids->SetNumberOfValues(3 * this->Count);
      session->StoreTriangles(MutableTriangleArray(this->Ids->GetPointer(0), this->Count));
    }
    if (this->Ids->GetSize() < 3 * this->Capacity)
    {
      this->Ids->Resize(3 * this->Capacity);
    }
    this->Corners.Values->Upload(this->Ids->GetPointer(0),
      static_cast<std::size_t>(3 * this->Capacity), Buffer::ElementArrayBuffer);
  }

  void UploadFlipCounts(const FlipSession* session)
  {
    std::vector<std::int32_t> counts(static_cast<std::size_t>(this->Capacity));
    auto* given =
      vtkIntArray::SafeDownCast(this->Faces->GetCellData()->GetArray("vtkDelaunayFlipCount"));
    if (session)
    {
      session->StoreFlipCounts(counts.data());
    }
    else if (given && given->GetNumberOfValues() >= this->Faces->GetNumberOfCells())
    {
      const vtkIdType first = this->Faces->GetNumberOfVerts() + this->Faces->GetNumberOfLines();
      const std::int64_t size =
        std::min<std::int64_t>(counts.size(), this->Faces->GetNumberOfPolys());
      std::copy_n(given->GetPointer(first), size, counts.begin());
    }
    this->Counts.Values->Upload(counts, Buffer::TextureBuffer);
    this->LargestCount =
      std::max<double>(this->LargestCount, *std::max_element(counts.begin(), counts.end()));
  }

  void Draw(vtkShaderProgram* program)
  {
    this->Array->Bind();
    this->Array->AddAttributeArray(
      program, this->Places.Values, "place", 0, 3 * sizeof(float), VTK_FLOAT, 3, false);
    this->Corners.Values->Bind();
    this->Places.Activate(program, "places");
    this->Corners.Activate(program, "corners");
    this->Counts.Activate(program, "counts");
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * this->Count), GL_UNSIGNED_INT, nullptr);
    for (ShaderBuffer* buffer : { &this->Places, &this->Corners, &this->Counts })
    {
      buffer->Texture->Deactivate();
    }
    this->Corners.Values->Release();
    this->Array->Release();
  }
};

vtkStandardNewMacro(vtkDelaunayFlipMapper);

vtkDelaunayFlipMapper::vtkDelaunayFlipMapper()
  : Own(new Parts)
{
  FillTable(this->Own->Table, -1.0);
  this->SetLookupTable(this->Own->Table);
}

vtkDelaunayFlipMapper::~vtkDelaunayFlipMapper() { this->Own->Release(this->Own->Window); }

void vtkDelaunayFlipMapper::SetFilter(vtkDelaunayFlipAlgorithm* filter)
{
  this->Own->IsOfAnother = this->Own->IsOfAnother || this->Own->Filter != filter;
  this->Own->Filter = filter;
  this->Own->IsNew = true;
  this->EndStep();
  this->Modified();
}

vtkDelaunayFlipAlgorithm* vtkDelaunayFlipMapper::GetFilter() const { return this->Own->Filter; }

bool vtkDelaunayFlipMapper::CanDraw(vtkPolyData* mesh)
{
  vtkCellArray* arrays[] = { mesh->GetPolys(), mesh->GetStrips(), mesh->GetVerts(),
    mesh->GetLines() };
  const bool areTriples =
    !mesh->GetPoints() || mesh->GetPoints()->GetData()->GetNumberOfComponents() == 3;
  const auto isValid = [](vtkCellArray* cells) { return cells->IsValid(); };
  const auto areThere = [count = mesh->GetNumberOfPoints()](vtkCellArray* cells)
  {
    bool areThere = true; // not by the range that an array keeps: it may be of old values
    VisitIds(cells,
      [&](const auto* first, const auto* last) {
        areThere =
          std::all_of(first, last, [count](vtkIdType id) { return id >= 0 && id < count; });
      });
    return areThere;
  };
  return areTriples && std::all_of(std::begin(arrays), std::end(arrays), isValid) &&
    std::all_of(arrays, arrays + 2, areThere);
}

bool vtkDelaunayFlipMapper::DrawsRun()
{
  this->ReadInput();
  return this->Own->FindSession() != nullptr;
}

bool vtkDelaunayFlipMapper::CanFollow(vtkPoints* points)
{
  this->ReadInput();
  const Parts& own = *this->Own;
  const FlipSession* session = own.Filter ? own.Filter->GetSession() : nullptr;
  return session && session->GetReport().Triangles > 0 &&
    points->GetNumberOfPoints() == own.Faces->GetNumberOfPoints();
}

vtkIdType vtkDelaunayFlipMapper::GetNumberOfTriangles()
{
  this->ReadInput();
  return this->Own->CountTriangles();
}

double vtkDelaunayFlipMapper::GetSmallestAngle()
{
  this->ReadInput();
  std::vector<double> storage;
  TriangleMesh mesh;
  if (this->Own->Box.IsValid())
  {
    mesh.Points = ViewPoints(this->Own->Faces, storage);
    mesh.Triangles =
      TriangleArray(this->Own->Ids->GetPointer(0), this->Own->Ids->GetNumberOfValues() / 3);
  }
  return MinimumAngle(mesh, GeometryKind::Surface);
}

std::string vtkDelaunayFlipMapper::GetDrawing() const
{
  if (this->Own->Filler)
  {
    return "drawn without copies";
  }
  return "drawn from copies: " + this->Own->Obstacle;
}

/// If something is drawn before the end of the step, the buffer is given back for that.
void vtkDelaunayFlipMapper::BeginStep()
{
  const vtkSmartPointer<vtkOpenGLRenderWindow> window = this->Own->Window.Get();
  try
  {
    if (this->Own->Filler && window)
    {
      if (!window->IsCurrent()) // else a context may be flushed for nothing
      {
        window->MakeCurrent();
      }
      this->Own->Filler->Map();
    }
  }
  catch (const std::exception& error)
  {
    this->Own->Abandon(error);
  }
}

void vtkDelaunayFlipMapper::SetMovedPoints(vtkPoints* points)
{
  if (!this->CanFollow(points))
  {
    return;
  }
  this->Own->Faces->SetPoints(CopyPoints(points)); // the caller may move on before this is drawn
  this->Own->IsFollowing = true;
  this->Own->MeasureBox();
  this->Own->IsNew = true; // a motion changes triangles otherwise than by flips, too
  this->EndStep();
  this->Modified();
}

void vtkDelaunayFlipMapper::EndStep() { this->Own->IsBehind = true; }

void vtkDelaunayFlipMapper::ReadInput()
{
  Parts& own = *this->Own;
  vtkPolyData* input = this->GetInput();
  const std::pair<vtkPolyData*, vtkMTimeType> version(input, input ? input->GetMTime() : 0);
  if (std::exchange(own.Input, version) != version)
  {
    own.ReadFaces(input);
    own.MayUseDevice = true;
    own.IsNew = true;
    this->EndStep();
  }
}

void vtkDelaunayFlipMapper::ComputeBounds()
{
  this->ReadInput();
  this->Own->Box.GetBounds(this->Bounds);
}

/// Brings everything that is drawn up to date, in the current context of a window. After a failure
/// of the filter the last mesh stays, with its colours.
/// @returns false if there is nothing to draw.
bool vtkDelaunayFlipMapper::Prepare(vtkOpenGLRenderWindow* window)
{
  Parts& own = *this->Own;
  this->ReadInput();
  if (!own.Box.IsValid())
  {
    return false;
  }
  const FlipSession* session = own.FindSession();
  const bool byFlipCount = this->ColorBy == COLOR_BY_FLIP_COUNT;
  if (own.ByFlipCount != byFlipCount && (!own.Filter || session))
  {
    own.ByFlipCount = byFlipCount;
    own.IsBehind = true;
  }
  own.MakeBuffers(window);
  own.UploadPoints();
  try
  {
    own.Fill(session, this->ZeroCopy);
    // The table changes only if it must, since VTK then makes the scale anew.
    const double kind = own.ByFlipCount ? own.LargestCount : -1.0;
    if (std::exchange(own.TableKind, kind) != kind)
    {
      FillTable(own.Table, kind);
    }
    return true;
  }
  catch (const std::exception& error)
  {
    const bool wasOnDevice = own.MayUseDevice;
    own.Abandon(error);
    return wasOnDevice && this->Prepare(window); // from the host
  }
}

void vtkDelaunayFlipMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Own->Release(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkDelaunayFlipMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window || renderer->GetSelector() || !this->GetInputAlgorithm())
  {
    return;
  }
  if (actor->IsRenderingTranslucentPolygonalGeometry())
  {
    if (!std::exchange(this->Own->HasWarned, true))
    {
      vtkWarningMacro("Translucent triangles are not drawn: set the opacity of the property to 1.");
    }
    return;
  }
  if (!this->Static)
  {
    this->GetInputAlgorithm()->Update();
  }
  if (!this->Prepare(window))
  {
    return;
  }
  // It is null, and VTK gives an error, if OpenGL does not compile it.
  if (auto* program =
        window->GetShaderCache()->ReadyShaderProgram(VertexShader, FragmentShader, ""))
  {
    this->SetPlaces(program, renderer, actor->GetMatrix());
    this->SetColors(program, actor->GetProperty());
    this->Own->Draw(program);
  }
}

/// Says where the triangles are drawn, and where they are cut off.
void vtkDelaunayFlipMapper::SetPlaces(
  vtkShaderProgram* program, vtkRenderer* renderer, vtkMatrix4x4* dataToWorld)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkNew<vtkMatrix4x4> placeToWorld, placeToView, viewToClip;
  for (int axis = 0; axis < 3; ++axis)
  {
    placeToWorld->SetElement(axis, axis, this->Own->Unit);
    placeToWorld->SetElement(axis, 3, this->Own->Center[axis]);
  }
  vtkMatrix4x4::Multiply4x4(dataToWorld, placeToWorld, placeToWorld);
  vtkMatrix4x4::Multiply4x4(camera->GetModelViewTransformMatrix(), placeToWorld, placeToView);
  viewToClip->DeepCopy(
    camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  placeToView->Transpose(); // OpenGL has the columns of a matrix one after the other
  viewToClip->Transpose();
  program->SetUniformMatrix("placeToView", placeToView);
  program->SetUniformMatrix("viewToClip", viewToClip);
  float planes[MostPlanes][4] = {};
  const int count = std::min(MostPlanes, this->GetNumberOfClippingPlanes());
  for (int i = 0; i < count; ++i)
  {
    double plane[4];
    this->GetClippingPlaneInDataCoords(placeToWorld, i, plane);
    std::copy_n(plane, 4, planes[i]);
  }
  program->SetUniform4fv("planes", MostPlanes, planes);
}

/// Buffers that are too large for the shader show neither colours nor edges.
void vtkDelaunayFlipMapper::SetColors(vtkShaderProgram* program, vtkProperty* property)
{
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &largest);
  const bool isReadable = 3 * std::max(this->Own->Count, this->Own->PointCount) <= largest;
  vtkLookupTable* table = this->Own->Table;
  float bands[Bands][3];
  for (int i = 0; i < Bands; ++i)
  {
    std::copy_n(table->GetTableValue(i), 3, bands[i]);
  }
  program->SetUniform3fv("bands", Bands, bands);
  program->SetUniformf("bandsPerUnit", static_cast<float>(Bands / table->GetRange()[1]));
  int colorBy = COLOR_BY_SOLID;
  float edgeWidth = 0.0f;
  if (isReadable)
  {
    const int notByFlipCount = std::min<int>(this->ColorBy, COLOR_BY_SMALLEST_ANGLE);
    colorBy = this->Own->ByFlipCount ? COLOR_BY_FLIP_COUNT : notByFlipCount;
    edgeWidth = property->GetEdgeVisibility() ? 0.5f * property->GetLineWidth() : 0.0f;
  }
  float light[2] = { 1.0f, 0.0f };
  if (property->GetLighting())
  {
    light[0] = static_cast<float>(property->GetAmbient());
    light[1] = static_cast<float>(property->GetDiffuse());
  }
  program->SetUniformi("colorBy", colorBy);
  program->SetUniform3f("plainColor", property->GetColor());
  program->SetUniform2f("light", light);
  program->SetUniform3f("edgeColor", property->GetEdgeColor());
  program->SetUniformf("edgeWidth", edgeWidth);
}

void vtkDelaunayFlipMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ColorBy: " << this->ColorBy << "\n";
  os << indent << "Filter: " << this->GetFilter() << "\n";
  os << indent << "ZeroCopy: " << this->ZeroCopy << "\n";
  os << indent << "Drawing: " << this->GetDrawing() << "\n";
}

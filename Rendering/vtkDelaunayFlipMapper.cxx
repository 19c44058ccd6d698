// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipMapper.h"

#include "BufferFiller.h"
#include "DelaunayFlip.h"
#include "MeshAudit.h"
#include "OpenGLFunctions.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDelaunayFlip.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkTriangleFilter.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace delaunayflip;

namespace
{

constexpr int MostPlanes = 6; ///< As in VTK's own mapper.
constexpr int Bands = 12; ///< Of colours.
constexpr const char* NoRun = "there is no live run of one mesh";

/// Places are relative to the centre of the mesh, in units of half its diagonal.
constexpr const char* VertexShader = R"(//VTK::System::Dec
in vec3 place;
uniform mat4 placeToClip;
out vec3 drawnPlace;
void main()
{
  drawnPlace = place;
  gl_Position = placeToClip * vec4(place, 1.0);
}
)";

/// The lines through the edges are found in homogeneous coordinates, in pixels from the middle of
/// the viewport, so that a corner may be behind the camera.
constexpr const char* FragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec3 drawnPlace;
uniform mat4 placeToClip;
uniform mat4 dataToView;
uniform samplerBuffer places;
uniform isamplerBuffer corners;
uniform isamplerBuffer counts;
uniform vec3 bands[12];  // colours
uniform float bandsPerUnit;
uniform int byFlipCount; // else by smallest angle
uniform int numberOfPlanes;
uniform vec4 planes[6];
uniform vec2 light;      // ambient, diffuse
uniform vec4 plainColor; // if alpha is not 0
uniform vec4 viewport;   // its middle and half its size
uniform vec4 edge;       // its colour, and half its width in pixels or 0

vec3 findPlace(int slot)
{
  int first = 3 * texelFetch(corners, 3 * gl_PrimitiveID + slot).r;
  return vec3(texelFetch(places, first).r, texelFetch(places, first + 1).r,
    texelFetch(places, first + 2).r);
}

vec3 findPixel(vec3 place)
{
  vec4 clip = placeToClip * vec4(place, 1.0);
  return vec3(clip.xy * viewport.zw, clip.w);
}

// The smallest angle of a triangle has the largest cosine.
float findAngle(vec3 a, vec3 b, vec3 c)
{
  float area = length(cross(b - a, c - a));
  float most = max(dot(b - a, c - a), max(dot(c - b, a - b), dot(a - c, b - c)));
  return degrees(atan(area, most));
}

float findDistance(vec3 line)
{
  return abs(dot(line, vec3(gl_FragCoord.xy - viewport.xy, 1.0))) / length(line.xy);
}

float findEdge(vec3 a, vec3 b, vec3 c)
{
  float distance = min(findDistance(cross(b, c)),
    min(findDistance(cross(c, a)), findDistance(cross(a, b))));
  float strength = 1.0;
  if (min(a.z, min(b.z, c.z)) > 0.0)
  {
    vec2 ab = b.xy / b.z - a.xy / a.z;
    vec2 ac = c.xy / c.z - a.xy / a.z;
    float inradius = abs(ab.x * ac.y - ab.y * ac.x) / (length(ab) + length(ac) + length(ac - ab));
    strength = min(1.0, inradius * inradius / (8.0 * edge.w));
  }
  return strength * clamp(edge.w + 0.5 - distance, 0.0, 1.0);
}

void main()
{
  mat3 turn = mat3(dataToView);
  vec3 normal = cross(turn * dFdx(drawnPlace), turn * dFdy(drawnPlace));
  float size = length(normal);
  for (int i = 0; i < numberOfPlanes; ++i)
  {
    if (dot(planes[i], vec4(drawnPlace, 1.0)) < 0.0)
    {
      discard;
    }
  }
  vec3 color = plainColor.rgb;
  vec3 a, b, c;
  if (plainColor.a == 0.0 || edge.w > 0.0)
  {
    a = findPlace(0);
    b = findPlace(1);
    c = findPlace(2);
  }
  if (plainColor.a == 0.0)
  {
    float value =
      byFlipCount != 0 ? float(texelFetch(counts, gl_PrimitiveID).r) : findAngle(a, b, c);
    color = bands[int(clamp(value * bandsPerUnit, 0.0, 11.0))];
  }
  color *= light.x + light.y * (size > 0.0 ? abs(normal.z) / size : 1.0);
  if (edge.w > 0.0)
  {
    color = mix(color, edge.rgb, findEdge(findPixel(a), findPixel(b), findPixel(c)));
  }
  gl_FragData[0] = vec4(color, 1.0);
}
)";

/// A copy of a mesh, which shares arrays, if its polygons are triangles, as in outputs of the
/// filter. Otherwise one in which polygons and strips are split into triangles.
vtkSmartPointer<vtkPolyData> MakeFaces(vtkPolyData* mesh)
{
  auto faces = vtkSmartPointer<vtkPolyData>::New();
  if (mesh)
  {
    faces->ShallowCopy(mesh);
  }
  const vtkIdType size = faces->GetPolys()->IsHomogeneous(); // 0: there are none
  if (faces->GetNumberOfStrips() > 0 || (size != 3 && size != 0))
  {
    vtkNew<vtkTriangleFilter> split;
    split->SetInputData(faces);
    split->Update();
    return split->GetOutput();
  }
  return faces;
}

template <typename Array>
auto* FindValues(vtkDataArray* data)
{
  auto* array = Array::FastDownCast(data); // null for null
  return array ? array->GetPointer(0) : nullptr;
}

PointArray ViewPoints(vtkDataArray* data)
{
  const std::int64_t count = data->GetNumberOfTuples();
  const float* floats = FindValues<vtkFloatArray>(data);
  return floats ? PointArray(floats, count) : PointArray(FindValues<vtkDoubleArray>(data), count);
}

TriangleArray ViewTriangles(vtkPolyData* faces)
{
  vtkDataArray* ids = faces->GetPolys()->GetConnectivityArray();
  const void* first = ids->GetVoidPointer(0);
  return ids->GetDataTypeSize() == 4
    ? TriangleArray(static_cast<const std::int32_t*>(first), faces->GetNumberOfPolys())
    : TriangleArray(static_cast<const std::int64_t*>(first), faces->GetNumberOfPolys());
}

/// Fills the table, for flip counts or angles, with twelve bands between a few colours.
void FillTable(vtkLookupTable* table, bool byFlipCount, double largestCount)
{
  using Colors = std::vector<std::array<double, 3>>;
  // From nearly white to dark violet, or from red for slivers to blue for equilateral triangles.
  const Colors colors = byFlipCount
    ? Colors{ { 0.96, 0.95, 0.98 }, { 0.80, 0.81, 0.91 }, { 0.62, 0.60, 0.80 },
        { 0.46, 0.32, 0.66 }, { 0.25, 0.0, 0.49 } }
    : Colors{ { 0.70, 0.09, 0.17 }, { 0.94, 0.54, 0.38 }, { 0.99, 0.86, 0.78 },
        { 0.82, 0.90, 0.94 }, { 0.40, 0.66, 0.81 }, { 0.13, 0.40, 0.67 } };
  table->SetNumberOfTableValues(Bands);
  for (int i = 0; i < Bands; ++i)
  {
    const double place = static_cast<double>(i) / (Bands - 1) * (colors.size() - 1.0);
    const std::size_t low = std::min(static_cast<std::size_t>(place), colors.size() - 2);
    double rgb[3];
    for (int k = 0; k < 3; ++k)
    {
      rgb[k] = colors[low][k] + (place - low) * (colors[low + 1][k] - colors[low][k]);
    }
    table->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
  // The largest count is rounded up to a multiple of four for whole labels at its quarters.
  table->SetRange(0.0, byFlipCount ? 4.0 * std::ceil(std::max(largestCount, 12.0) / 4.0) : 60.0);
}

void MakeCurrent(vtkOpenGLRenderWindow* window)
{
  if (!window->IsCurrent()) // else a context may be flushed for nothing
  {
    window->MakeCurrent();
  }
}

void SetBands(vtkShaderProgram* program, vtkLookupTable* table, bool byFlipCount)
{
  float bands[Bands][3];
  for (int i = 0; i < Bands; ++i)
  {
    std::copy_n(table->GetTableValue(i), 3, bands[i]);
  }
  program->SetUniform3fv("bands", Bands, bands);
  program->SetUniformf("bandsPerUnit", static_cast<float>(Bands / table->GetRange()[1]));
  program->SetUniformi("byFlipCount", byFlipCount);
}

void SetMatrix(
  vtkShaderProgram* program, const char* name, vtkMatrix4x4* first, vtkMatrix4x4* transposed)
{
  vtkNew<vtkMatrix4x4> matrix;
  vtkMatrix4x4::Transpose(first, matrix);
  vtkMatrix4x4::Multiply4x4(matrix, transposed, matrix);
  program->SetUniformMatrix(name, matrix);
}

void SetColor(vtkShaderProgram* program, const char* name, const double* rgb, double fourth)
{
  const float values[4] = { static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
    static_cast<float>(rgb[2]), static_cast<float>(fourth) };
  program->SetUniform4f(name, values);
}

}

/// The mesh as it is on the host, and what OpenGL has of it.
struct vtkDelaunayFlipMapper::Parts
{
  vtkSmartPointer<vtkDelaunayFlip> Filter;
  std::string Obstacle = NoRun; ///< Why CUDA does not write; empty: it does.

  vtkMTimeType InputTime = 0;
  vtkSmartPointer<vtkPolyData> Faces = vtkSmartPointer<vtkPolyData>::New(); ///< Of the input.
  vtkSmartPointer<vtkDataArray> Points; ///< As float or double.
  vtkMTimeType PointsTime = 0;
  vtkBoundingBox Box; ///< Of the points that triangles use.
  double Center[3] = { 0.0, 0.0, 0.0 };
  double Unit = 1.0; ///< Of places in the shader.

  enum BufferName
  {
    Places,
    Corners,
    Counts ///< Of flips.
  };
  bool HasBuffers = false;
  vtkWeakPointer<vtkOpenGLRenderWindow> Window; ///< That of the buffers.
  vtkNew<vtkOpenGLBufferObject> Buffers[3];
  vtkNew<vtkTextureObject> Textures[3]; ///< By which the shader reads the buffers.
  vtkNew<vtkOpenGLVertexArrayObject> Array;
  std::int64_t Count = 0, PointCount = 0; ///< The sizes of the buffers.
  vtkMTimeType UploadTime = 0; ///< Of the points in the buffer.

  std::unique_ptr<BufferFiller> Filler; ///< Null: the host fills.
  bool MayTryDevice = true;
  bool IsBehind = true; ///< The buffers hold an earlier mesh.
  bool IsNew = true; ///< And it may be that of another run, or what the filler has not written.
  bool HasCounts = false; ///< Flip counts are those of the triangles.
  bool ByFlipCount = false; ///< What colours show.
  double LargestCount = 0.0; ///< The largest flip count of any mesh so far.
  double SmallestAngle = -1.0; ///< Of the triangles in the buffer; less than 0: not measured yet.
  bool HasWarned = false;
  double TableKind = -2.0; ///< What the table was filled for: a largest count, or -1 for angles.

  /// The session whose triangles are the faces; or null.
  const FlipSession* FindSession() const
  {
    const FlipSession* session = this->Filter ? this->Filter->GetSession() : nullptr;
    const bool fits = session && session->GetReport().Triangles == this->Faces->GetNumberOfPolys();
    return fits ? session : nullptr;
  }

  /// Points that no triangle uses do not matter. The mesh may be one that no filter has checked.
  void ReadPoints()
  {
    vtkPoints* points = this->Faces->GetPoints();
    this->Points = points ? points->GetData() : vtkSmartPointer<vtkDoubleArray>::New().Get();
    if (!vtkFloatArray::FastDownCast(this->Points) && !vtkDoubleArray::FastDownCast(this->Points))
    {
      auto doubles = vtkSmartPointer<vtkDoubleArray>::New();
      doubles->DeepCopy(this->Points);
      this->Points = doubles;
    }
    std::vector<unsigned char> areUsed(static_cast<std::size_t>(this->Points->GetNumberOfTuples()));
    const TriangleArray triangles = ViewTriangles(this->Faces);
    const auto mark = [&](const auto* ids)
    {
      for (std::int64_t i = 0; i < 3 * triangles.Count; ++i)
      {
        const auto id = static_cast<std::size_t>(ids[i]); // large if negative
        if (id < areUsed.size())
        {
          areUsed[id] = 1;
        }
      }
    };
    triangles.Ids32 ? mark(triangles.Ids32) : mark(triangles.Ids64);
    vtkNew<vtkPoints> places;
    places->SetData(this->Points);
    double bounds[6];
    vtkBoundingBox::ComputeBounds(places, areUsed.data(), bounds);
    this->Box.SetBounds(bounds);
    const vtkMTimeType time = points ? points->GetMTime() : 0;
    if (std::exchange(this->PointsTime, time) != time && this->Box.IsValid())
    {
      this->Box.GetCenter(this->Center);
      const double half = 0.5 * this->Box.GetDiagonalLength();
      this->Unit = half > 0.0 && std::isfinite(half) ? half : 1.0;
    }
  }

  /// Keeps those that there are, if they have the right sizes.
  void MakeBuffers(vtkOpenGLRenderWindow* window)
  {
    const std::int64_t count = this->Faces->GetNumberOfPolys();
    const std::int64_t points = this->Points->GetNumberOfTuples();
    if (this->HasBuffers && this->Window == window && count == this->Count &&
      points == this->PointCount)
    {
      return;
    }
    this->Release(this->Window);
    window->MakeCurrent();
    this->HasBuffers = true;
    this->Window = window;
    this->Count = count;
    this->PointCount = points;
    using Buffer = vtkOpenGLBufferObject;
    this->MakeBuffer(Places, Buffer::ArrayBuffer, GL_ARRAY_BUFFER, 3 * points, GL_R32F);
    this->MakeBuffer(
      Corners, Buffer::ElementArrayBuffer, GL_ELEMENT_ARRAY_BUFFER, 3 * count, GL_R32I);
    this->MakeBuffer(Counts, Buffer::TextureBuffer, GL_TEXTURE_BUFFER, count, GL_R32I);
  }

  /// Every value has four bytes.
  void MakeBuffer(BufferName name, vtkOpenGLBufferObject::ObjectType type, GLenum target,
    std::int64_t count, GLenum format)
  {
    vtkOpenGLBufferObject* buffer = this->Buffers[name];
    buffer->GenerateBuffer(type);
    buffer->Bind();
    glBufferData(target, static_cast<GLsizeiptr>(4 * count), nullptr, GL_DYNAMIC_DRAW);
    buffer->Release();
    vtkTextureObject* texture = this->Textures[name];
    texture->SetContext(this->Window);
    texture->SetInternalFormat(format);
    texture->CreateTextureBuffer(static_cast<unsigned int>(count), 1, VTK_FLOAT, buffer);
  }

  void UploadPoints()
  {
    if (std::exchange(this->UploadTime, this->PointsTime) == this->PointsTime)
    {
      return;
    }
    std::vector<float> places(3 * static_cast<std::size_t>(this->PointCount));
    const PointArray points = ViewPoints(this->Points);
    vtkSMPTools::For(0, this->PointCount,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = 3 * begin; i < 3 * end; ++i)
        {
          const double x = points.Get(i / 3, static_cast<int>(i % 3)) - this->Center[i % 3];
          places[i] = static_cast<float>(x / this->Unit);
        }
      });
    this->Buffers[Places]->Upload(places, vtkOpenGLBufferObject::ArrayBuffer);
  }

  /// Needs the window's context only if it is given.
  void Release(vtkWindow* window)
  {
    if (!std::exchange(this->HasBuffers, false))
    {
      return;
    }
    if (window)
    {
      window->MakeCurrent();
    }
    this->Filler.reset();
    for (const int name : { Places, Corners, Counts })
    {
      this->Textures[name]->ReleaseGraphicsResources(window);
      this->Buffers[name]->ReleaseGraphicsResources();
    }
    this->Array->ReleaseGraphicsResources();
    this->Obstacle = NoRun;
    this->UploadTime = 0;
    this->IsBehind = true;
    this->MayTryDevice = true;
  }

  /// CUDA is tried once for every mesh that the host has got. After a failure of the filter its
  /// session is gone, but the mesh in the buffers stays.
  void ChooseFiller(bool allowsDevice)
  {
    const bool hasSession = this->FindSession() != nullptr;
    const bool hasOther = this->Filter && this->Filter->GetSession();
    if (this->Filter && !hasOther && !this->IsBehind)
    {
      return;
    }
    if (!hasSession || !allowsDevice)
    {
      this->Obstacle = hasSession ? "ZeroCopy is off"
        : hasOther                ? "the mesh has other cells than triangles"
                                  : NoRun;
      this->MayTryDevice = true;
      this->IsBehind = this->IsBehind || this->Filler;
      this->Filler.reset();
    }
    else if (!this->Filler && std::exchange(this->MayTryDevice, false))
    {
      try
      {
        this->Filler = DeviceFillerMaker(this->Filter,
          { static_cast<unsigned int>(this->Buffers[Corners]->GetHandle()), this->Count });
        this->Obstacle.clear();
        this->IsBehind = true;
        this->IsNew = true;
      }
      catch (const std::exception& error)
      {
        this->Obstacle = error.what();
      }
    }
  }

  /// Does without the filler that has failed.
  void Abandon(const std::exception& error)
  {
    this->Filler.reset();
    this->Obstacle = error.what();
    this->IsBehind = true;
  }

  /// Brings the buffers of triangles and, if colours show them, of flip counts up to date.
  void Fill()
  {
    const FlipSession* session = this->FindSession();
    if (!this->IsBehind && this->Filler)
    {
      this->Filler->Unmap();
    }
    else if (this->IsBehind)
    {
      this->Filler ? this->Filler->Fill(*session, std::exchange(this->IsNew, false))
                   : this->UploadTriangles(session);
      this->SmallestAngle = session ? session->GetReport().MinimumAngleAfter : -1.0;
      this->HasCounts = false;
      this->IsBehind = false;
    }
    if (this->ByFlipCount && !std::exchange(this->HasCounts, true))
    {
      this->UploadFlipCounts(session);
    }
  }

  /// Ids of points that do not exist become 0: the mesh may be one that no filter has checked.
  void UploadTriangles(const FlipSession* session)
  {
    std::vector<std::int32_t> ids(3 * static_cast<std::size_t>(this->Count));
    const TriangleArray triangles = ViewTriangles(this->Faces);
    for (std::size_t i = 0; i < ids.size() && !session; ++i)
    {
      const std::int64_t id = triangles.Get(static_cast<std::int64_t>(i / 3), i % 3);
      ids[i] = id >= 0 && id < this->PointCount ? static_cast<std::int32_t>(id) : 0;
    }
    if (session)
    {
      session->StoreTriangles(MutableTriangleArray(ids.data(), this->Count));
    }
    this->Upload(Corners, ids);
  }

  void UploadFlipCounts(const FlipSession* session)
  {
    std::vector<std::int32_t> counts(static_cast<std::size_t>(this->Count));
    vtkDataArray* given = this->Faces->GetCellData()->GetArray("vtkDelaunayFlipCount");
    const int* flips = FindValues<vtkIntArray>(given);
    if (session)
    {
      session->StoreFlipCounts(counts.data());
    }
    else if (flips && given->GetNumberOfValues() >= this->Faces->GetNumberOfCells())
    {
      const vtkIdType first = this->Faces->GetNumberOfVerts() + this->Faces->GetNumberOfLines();
      std::copy_n(flips + first, counts.size(), counts.begin());
    }
    this->Upload(Counts, counts);
    this->LargestCount =
      std::max<double>(this->LargestCount, *std::max_element(counts.begin(), counts.end()));
  }

  void Upload(BufferName name, const std::vector<std::int32_t>& values)
  {
    glBindBuffer(GL_COPY_WRITE_BUFFER, static_cast<GLuint>(this->Buffers[name]->GetHandle()));
    glBufferSubData(
      GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(4 * values.size()), values.data());
    glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  }

  /// Of a mesh without a run in space; of a run, as its report.
  double GetSmallestAngle()
  {
    if (this->SmallestAngle < 0.0)
    {
      TriangleMesh mesh;
      mesh.Points = ViewPoints(this->Points);
      mesh.Triangles = ViewTriangles(this->Faces);
      this->SmallestAngle = std::numeric_limits<double>::quiet_NaN();
      try
      {
        this->SmallestAngle = MinimumAngle(mesh, GeometryKind::Surface);
      }
      catch (const std::exception&) // a triangle names a point that does not exist
      {
      }
    }
    return this->SmallestAngle;
  }

  /// The table changes only if it must, since VTK then makes the scale anew.
  void UpdateTable(vtkLookupTable* table)
  {
    const double kind = this->ByFlipCount ? this->LargestCount : -1.0;
    if (std::exchange(this->TableKind, kind) != kind)
    {
      FillTable(table, this->ByFlipCount, this->LargestCount);
    }
  }

  /// Whether a shader can read buffers of these sizes.
  bool IsReadable() const
  {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &largest);
    return 3 * std::max(this->Count, this->PointCount) <= largest;
  }

  void Draw(vtkShaderProgram* program)
  {
    this->Array->Bind();
    this->Array->AddAttributeArray(
      program, this->Buffers[Places], "place", 0, 3 * sizeof(float), VTK_FLOAT, 3, false);
    this->Buffers[Corners]->Bind();
    const char* const names[] = { "places", "corners", "counts" };
    for (const int name : { Places, Corners, Counts })
    {
      this->Textures[name]->Activate();
      program->SetUniformi(names[name], this->Textures[name]->GetTextureUnit());
    }
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * this->Count), GL_UNSIGNED_INT, nullptr);
    for (const int name : { Places, Corners, Counts })
    {
      this->Textures[name]->Deactivate();
    }
    this->Buffers[Corners]->Release();
    this->Array->Release();
  }
};

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkDelaunayFlipMapper);

vtkDelaunayFlipMapper::vtkDelaunayFlipMapper()
  : Own(new Parts)
{
  vtkNew<vtkLookupTable> table;
  FillTable(table, false, 0.0);
  this->SetLookupTable(table);
}

vtkDelaunayFlipMapper::~vtkDelaunayFlipMapper()
{
  if (this->Own->Window) // else VTK has released everything already
  {
    this->Own->Release(this->Own->Window);
  }
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipMapper::SetFilter(vtkDelaunayFlip* filter)
{
  if (this->Own->Filter != filter)
  {
    this->Own->Filter = filter;
    this->EndStep();
    this->Modified();
  }
}

vtkDelaunayFlip* vtkDelaunayFlipMapper::GetFilter() const { return this->Own->Filter; }

bool vtkDelaunayFlipMapper::DrawsRun()
{
  this->ReadInput();
  return this->Own->FindSession() != nullptr;
}

vtkIdType vtkDelaunayFlipMapper::GetNumberOfTriangles()
{
  this->ReadInput();
  return this->Own->Faces->GetNumberOfPolys();
}

double vtkDelaunayFlipMapper::GetSmallestAngle()
{
  this->ReadInput();
  return this->Own->GetSmallestAngle();
}

std::string vtkDelaunayFlipMapper::GetDrawing() const
{
  return this->Own->Obstacle.empty() ? "drawn without copies"
                                     : "drawn from copies: " + this->Own->Obstacle;
}

/// If something is drawn before Fill(), the buffers are given back for that.
void vtkDelaunayFlipMapper::BeginStep()
{
  if (this->Own->Filler && this->Own->Window)
  {
    try
    {
      MakeCurrent(this->Own->Window);
      this->Own->Filler->Map();
    }
    catch (const std::exception& error)
    {
      this->Own->Abandon(error);
    }
  }
}

void vtkDelaunayFlipMapper::EndStep() { this->Own->IsBehind = true; }

bool vtkDelaunayFlipMapper::Fill()
{
  const vtkSmartPointer<vtkOpenGLRenderWindow> window = this->Own->Window.Get();
  if (!window || !this->Own->HasBuffers)
  {
    return false;
  }
  MakeCurrent(window);
  return this->Prepare(window);
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipMapper::ReadInput()
{
  vtkPolyData* input = this->GetInput();
  const vtkMTimeType time = input ? input->GetMTime() : 0;
  if (std::exchange(this->Own->InputTime, time) != time)
  {
    this->Own->Faces = MakeFaces(input);
    this->Own->ReadPoints();
    this->Own->MayTryDevice = true;
    this->Own->IsNew = true;
    this->EndStep();
  }
}

void vtkDelaunayFlipMapper::ComputeBounds()
{
  this->ReadInput();
  vtkMath::UninitializeBounds(this->Bounds);
  if (this->Own->Box.IsValid())
  {
    this->Own->Box.GetBounds(this->Bounds);
  }
}

/// Brings everything that is drawn up to date, in the current context of a window. After a failure
/// of the filter the last mesh stays, with its colours.
/// @returns false if there is nothing to draw.
bool vtkDelaunayFlipMapper::Prepare(vtkOpenGLRenderWindow* window)
{
  Parts& own = *this->Own;
  this->ReadInput();
  if (own.Faces->GetNumberOfPolys() == 0)
  {
    return false;
  }
  own.MakeBuffers(window);
  own.UploadPoints();
  const bool byFlipCount = this->ColorBy == COLOR_BY_FLIP_COUNT;
  if (own.ByFlipCount != byFlipCount && (!own.Filter || own.FindSession()))
  {
    own.ByFlipCount = byFlipCount;
  }
  for (bool isOnDevice = true; isOnDevice;)
  {
    try
    {
      own.ChooseFiller(this->ZeroCopy);
      isOnDevice = own.Filler != nullptr;
      own.Fill();
      own.UpdateTable(vtkLookupTable::SafeDownCast(this->LookupTable));
      return true;
    }
    catch (const std::exception& error)
    {
      own.Abandon(error);
    }
  }
  return false;
}

void vtkDelaunayFlipMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Own->Release(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  auto* camera = vtkOpenGLCamera::SafeDownCast(renderer->GetActiveCamera());
  if (!window || !camera || renderer->GetSelector() || !this->GetInputAlgorithm())
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
  vtkShaderProgram* program =
    window->GetShaderCache()->ReadyShaderProgram(VertexShader, FragmentShader, "");
  if (!program)
  {
    vtkErrorMacro("OpenGL does not compile the shader.");
    return;
  }
  const Parts& own = *this->Own;
  vtkMatrix4x4 *worldToView, *viewToClip, *worldToClip; // transposed
  vtkMatrix3x3* normals;
  camera->GetKeyMatrices(renderer, worldToView, normals, viewToClip, worldToClip);
  vtkNew<vtkMatrix4x4> placeToWorld;
  for (int axis = 0; axis < 3; ++axis)
  {
    placeToWorld->SetElement(axis, axis, own.Unit);
    placeToWorld->SetElement(axis, 3, own.Center[axis]);
  }
  vtkMatrix4x4::Multiply4x4(actor->GetMatrix(), placeToWorld, placeToWorld);
  SetMatrix(program, "placeToClip", placeToWorld, worldToClip);
  SetMatrix(program, "dataToView", actor->GetMatrix(), worldToView);

  float planes[MostPlanes][4] = {};
  const int count = std::min(MostPlanes, this->GetNumberOfClippingPlanes());
  for (int i = 0; i < count; ++i)
  {
    double plane[4];
    this->GetClippingPlaneInDataCoords(actor->GetMatrix(), i, plane);
    for (int axis = 0; axis < 3; ++axis)
    {
      planes[i][axis] = static_cast<float>(plane[axis] * own.Unit);
      plane[3] += plane[axis] * own.Center[axis];
    }
    planes[i][3] = static_cast<float>(plane[3]);
  }
  program->SetUniformi("numberOfPlanes", count);
  program->SetUniform4fv("planes", MostPlanes, planes);

  const bool isReadable = own.IsReadable();
  SetBands(program, vtkLookupTable::SafeDownCast(this->LookupTable), own.ByFlipCount);
  vtkProperty* property = actor->GetProperty();
  const bool isLit = property->GetLighting();
  const float light[2] = { isLit ? static_cast<float>(property->GetAmbient()) : 1.0f,
    isLit ? static_cast<float>(property->GetDiffuse()) : 0.0f };
  program->SetUniform2f("light", light);
  SetColor(program, "plainColor", property->GetColor(),
    isReadable && this->ColorBy != COLOR_BY_SOLID ? 0.0 : 1.0);
  SetColor(program, "edge", property->GetEdgeColor(),
    property->GetEdgeVisibility() && isReadable ? 0.5 * property->GetLineWidth() : 0.0);
  int width, height, left, bottom;
  renderer->GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
  const float viewport[4] = { left + 0.5f * width, bottom + 0.5f * height, 0.5f * width,
    0.5f * height };
  program->SetUniform4f("viewport", viewport);
  this->Own->Draw(program);
}

void vtkDelaunayFlipMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ColorBy: " << this->ColorBy << "\n";
  os << indent << "Filter: " << this->GetFilter() << "\n";
  os << indent << "ZeroCopy: " << this->ZeroCopy << "\n";
  os << indent << "Drawing: " << this->GetDrawing() << "\n";
}

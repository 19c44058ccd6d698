// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VectorReader.h"

#include "CommandError.h"
#include "GdalMessages.h"
#include "ReferenceSystem.h"

#include <ogrsf_frmts.h>

#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace delaunayflip
{

namespace
{

std::string Quoted(const std::vector<std::string>& names)
{
  return "'" + Printable(JoinWords(names, "', '")) + "'";
}

/// Adds a name that is new, behind the others.
void AddName(std::vector<std::string>& names, const std::string& name)
{
  if (std::find(names.begin(), names.end(), name) == names.end())
  {
    names.push_back(name);
  }
}

/// Whether a feature of a drawing only labels it: a text, which GDAL has as a point, or something
/// on the sheet that it is printed on (in paper space).
bool IsLabel(const OGRFeature& feature)
{
  const int text = feature.GetFieldIndex("Text");
  const int paper = feature.GetFieldIndex("PaperSpace");
  const OGRGeometry* const geometry = feature.GetGeometryRef();
  const bool isText = text >= 0 && feature.IsFieldSetAndNotNull(text) && geometry &&
    wkbFlatten(geometry->getGeometryType()) == wkbPoint;
  return isText || (paper >= 0 && feature.GetFieldAsInteger(paper) != 0);
}

/// The layers of a file that have geometries. All of a .dxf are in one layer of GDAL, and their
/// attribute Layer names the layer of the drawing.
class Layers
{
public:
  Layers(GDALDataset& data, const VectorRequest& request)
    : Data(data),
      IsDrawing(request.Driver == "DXF")
  {
    this->FindNames();
    const std::vector<std::string>& names = this->Names;
    if (names.empty())
    {
      throw std::runtime_error("has no layer with points, lines or polygons");
    }
    const bool isAll = request.Layer == "*";
    const bool isOne = std::find(names.begin(), names.end(), request.Layer) != names.end();
    if (isOne)
    {
      this->Chosen = request.Layer;
    }
    else if (!request.Layer.empty() && !isAll)
    {
      throw std::runtime_error("has no layer '" + request.Layer + "'; it has " + Quoted(names));
    }
    else if (names.size() > 1 && !isAll)
    {
      throw std::runtime_error("has several layers: " + Quoted(names) +
        "; name one behind the file, as in FILE:" + names.front() + ", or all as FILE:*");
    }
  }

  /// Calls `visit(layer, feature)` for all of the chosen layers.
  template <typename Function>
  void ForEachFeature(const Function& visit)
  {
    for (OGRLayer* const layer : this->Data.GetLayers())
    {
      if (!this->IsDrawing && !this->IsChosen(layer->GetName()))
      {
        continue;
      }
      for (auto& feature : layer)
      {
        if (!this->IsDrawing || this->IsChosen(feature->GetFieldAsString("Layer")))
        {
          visit(*layer, *feature);
        }
      }
    }
  }

private:
  void FindNames()
  {
    for (OGRLayer* const layer : this->Data.GetLayers())
    {
      if (this->IsDrawing)
      {
        for (auto& feature : layer)
        {
          if (!IsLabel(*feature))
          {
            AddName(this->Names, feature->GetFieldAsString("Layer"));
          }
        }
      }
      else if (layer->GetGeomType() != wkbNone)
      {
        AddName(this->Names, layer->GetName());
      }
    }
  }

  bool IsChosen(const std::string& name) const
  {
    const bool isThere =
      std::find(this->Names.begin(), this->Names.end(), name) != this->Names.end();
    return isThere && (this->Chosen.empty() || name == this->Chosen);
  }

  GDALDataset& Data;
  const bool IsDrawing;
  std::vector<std::string> Names;
  std::string Chosen; ///< Empty: all.
};

/// The mesh that features become.
class FeatureMesh
{
public:
  explicit FeatureMesh(const VectorRequest& request)
    : Request(request)
  {
    this->Points->SetDataTypeToDouble();
  }

  void Add(OGRLayer& layer, OGRFeature& feature)
  {
    const OGRGeometry* const geometry = feature.GetGeometryRef();
    if (!geometry || geometry->IsEmpty())
    {
      ++this->Empty;
      return;
    }
    if (this->Request.Driver == "DXF" && IsLabel(feature))
    {
      ++this->Labels;
      return;
    }
    if (&layer != this->Layer)
    {
      this->BeginLayer(layer);
    }
    if (this->HeightField >= 0)
    {
      this->TakeHeight(feature);
    }
    this->HasHeights = this->HasHeights || geometry->Is3D();
    const std::unique_ptr<OGRGeometry> straight(geometry->getLinearGeometry()); // without arcs
    this->AddGeometry(*straight);
    for (const auto& [field, values] : this->Attributes)
    {
      double value = std::numeric_limits<double>::quiet_NaN();
      if (feature.IsFieldSetAndNotNull(field))
      {
        value = feature.GetFieldAsDouble(field);
      }
      while (values->GetNumberOfValues() < this->Points->GetNumberOfPoints())
      {
        values->InsertNextValue(value);
      }
    }
  }

  FileMesh Finish()
  {
    FileMesh file;
    file.Mesh->SetPoints(this->Points);
    file.Crs = this->Crs;
    file.HasAngles = this->HasAngles && this->MayBeAngles();
    if (this->HasAngles && !file.HasAngles)
    {
      file.Crs.clear(); // GDAL takes every GeoJSON for one in degrees
      file.Notes.push_back(
        "its coordinates are no longitudes and latitudes, although its coordinate "
        "reference system says so");
    }
    file.Mesh->SetLines(this->Lines);
    file.Mesh->SetPolys(this->Rings);
    if (this->Empty > 0)
    {
      file.Warnings.push_back(
        "left out " + Counted(this->Empty, "feature") + " without a geometry");
    }
    if (this->Labels > 0)
    {
      file.Warnings.push_back(
        "left out texts and what is in paper space (" + Counted(this->Labels, "feature") + ")");
    }
    if (this->Request.AreSegments)
    {
      return file;
    }
    if (file.Mesh->GetNumberOfCells() == 0)
    {
      for (const auto& [field, values] : this->Attributes)
      {
        file.Mesh->GetPointData()->AddArray(values);
      }
    }
    const bool lacksHeights = !this->HasHeights && this->HeightField < 0;
    if (lacksHeights && !this->Request.AreFlat && !this->Numeric.empty())
    {
      file.Notes.push_back("its geometries have no z, so z is 0; --columns NAME takes a numeric "
                           "attribute as z: " +
        Quoted(this->Numeric));
    }
    return file;
  }

private:
  bool MayBeAngles() const
  {
    constexpr double MostDegrees = 360.0;
    double bounds[6];
    this->Points->GetBounds(bounds);
    return std::all_of(
             bounds, bounds + 4, [](double x) { return !(std::fabs(x) > MostDegrees); }) ||
      this->Points->GetNumberOfPoints() == 0;
  }

  /// Finds the attributes of a layer. Those of several layers are not joined.
  void BeginLayer(OGRLayer& layer)
  {
    const bool isFirst = this->Layer == nullptr;
    const OGRFeatureDefn& fields = *layer.GetLayerDefn();
    this->Layer = &layer;
    this->HeightField = -1;
    this->Numeric.clear();
    this->Attributes.clear();
    if (const OGRSpatialReference* const crs = layer.GetSpatialRef())
    {
      this->Crs = WriteCrs(*crs, "WKT2_2019");
      this->HasAngles = crs->IsGeographic() != 0;
    }
    for (int i = 0; i < fields.GetFieldCount(); ++i)
    {
      const OGRFieldType type = fields.GetFieldDefn(i)->GetType();
      const std::string name = fields.GetFieldDefn(i)->GetNameRef();
      const bool isNumeric = type == OFTInteger || type == OFTInteger64 || type == OFTReal;
      if (!isNumeric || this->Request.Driver == "DXF") // which has only flags
      {
        continue;
      }
      this->Numeric.push_back(name);
      if (name == this->Request.Height)
      {
        this->HeightField = i;
      }
      else if (isFirst)
      {
        this->Attributes.emplace_back(i, vtkSmartPointer<vtkDoubleArray>::New());
        this->Attributes.back().second->SetName(name.c_str());
      }
    }
    if (this->HeightField < 0 && !this->Request.Height.empty())
    {
      throw std::runtime_error("--columns: layer '" + std::string(layer.GetName()) +
        "' has no numeric attribute '" + this->Request.Height + "'; it has " +
        (this->Numeric.empty() ? "no numeric attributes" : Quoted(this->Numeric)));
    }
  }

  void TakeHeight(const OGRFeature& feature)
  {
    if (!feature.IsFieldSetAndNotNull(this->HeightField))
    {
      throw std::runtime_error("feature " + std::to_string(feature.GetFID()) +
        " has no value of '" + this->Request.Height + "'");
    }
    this->Height = feature.GetFieldAsDouble(this->HeightField);
  }

  void AddGeometry(const OGRGeometry& geometry)
  {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbPoint)
    {
      if (!geometry.IsEmpty())
      {
        this->AddPoint(*geometry.toPoint());
      }
    }
    else if (type == wkbLineString)
    {
      this->AddLine(*geometry.toLineString(), this->Lines);
    }
    else if (type == wkbPolygon || type == wkbTriangle)
    {
      for (const OGRLinearRing* const ring : *geometry.toPolygon())
      {
        this->AddLine(*ring, this->Rings);
      }
    }
    else if (type == wkbPolyhedralSurface || type == wkbTIN)
    {
      for (const OGRPolygon* const face : *geometry.toPolyhedralSurface())
      {
        this->AddGeometry(*face);
      }
    }
    else
    {
      for (const OGRGeometry* const part : *geometry.toGeometryCollection())
      {
        this->AddGeometry(*part);
      }
    }
  }

  vtkIdType AddPoint(const OGRPoint& point)
  {
    const double height = this->HeightField < 0 ? point.getZ() : this->Height;
    return this->Points->InsertNextPoint(point.getX(), point.getY(), height);
  }

  /// A closed line ends with the id of its first point; a ring does not repeat it.
  void AddLine(const OGRSimpleCurve& line, vtkCellArray* cells)
  {
    const bool isRing = cells == this->Rings;
    const bool isClosed = line.getNumPoints() > 1 && line.get_IsClosed();
    std::vector<vtkIdType> ids;
    for (int i = 0; i < line.getNumPoints() - isClosed; ++i)
    {
      OGRPoint point;
      line.getPoint(i, &point);
      ids.push_back(this->AddPoint(point));
    }
    if (isClosed && !isRing)
    {
      ids.push_back(ids.front());
    }
    if (ids.size() > 1 || (isRing && !ids.empty()))
    {
      cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
    }
  }

  const VectorRequest& Request;
  const OGRLayer* Layer = nullptr; ///< That of the features now.
  int HeightField = -1; ///< Its attribute that is z, or -1.
  double Height = 0.0; ///< That of the feature, from this attribute.
  std::vector<std::string> Numeric; ///< Its numeric attributes.
  std::vector<std::pair<int, vtkSmartPointer<vtkDoubleArray>>> Attributes; ///< Per field.
  bool HasHeights = false;
  std::int64_t Empty = 0;
  std::int64_t Labels = 0; ///< How many labels a drawing has.
  std::string Crs;
  bool HasAngles = false; ///< Whether that is of longitudes and latitudes.
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Lines, Rings;
};

}

FileMesh ReadVectors(const VectorRequest& request)
{
  GdalMessages messages;
  const char* const drivers[] = { request.Driver.c_str(), nullptr };
  const GDALDatasetUniquePtr data(GDALDataset::Open(
    request.Path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, drivers));
  if (!data)
  {
    messages.Fail();
  }
  messages.Warnings.clear(); // such as that a newer GDAL has written the file
  Layers layers(*data, request);
  FeatureMesh mesh(request);
  layers.ForEachFeature(
    [&mesh](OGRLayer& layer, OGRFeature& feature) { mesh.Add(layer, feature); });
  messages.Check();
  FileMesh file = mesh.Finish();
  file.Warnings.insert(file.Warnings.end(), messages.Warnings.begin(), messages.Warnings.end());
  return file;
}

}

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
#include <iterator>
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

bool HasName(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Adds a name that is new, behind the others.
void AddName(std::vector<std::string>& names, const std::string& name)
{
  if (!HasName(names, name))
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
    const vtkIdType before = this->Points->GetNumberOfPoints();
    const std::unique_ptr<OGRGeometry> straight(geometry->getLinearGeometry()); // without arcs
    this->AddGeometry(*straight);
    if (this->KeepsAttributes())
    {
      this->TakeAttributes(feature, before);
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
    this->StoreAttributes(file);
    file.Warnings.insert(file.Warnings.end(), this->Warnings.begin(), this->Warnings.end());
    const bool lacksHeights = !this->HasHeights && this->HeightField < 0 && this->Request.HasData;
    if (lacksHeights && !this->Request.AreFlat && !this->Numeric.empty())
    {
      file.Notes.push_back("its geometries have no z, so z is 0; --columns NAME takes a numeric "
                           "attribute as z: " +
        Quoted(this->Numeric));
    }
    return file;
  }

private:
  /// A numeric attribute of points.
  struct Attribute
  {
    std::string Name;
    vtkSmartPointer<vtkDoubleArray> Values;
    int Field = -1; ///< In the layer now; -1: it has none.
  };

  /// Attributes are kept only where all points are features of their own.
  bool KeepsAttributes() const
  {
    const bool hasCells = this->Lines->GetNumberOfCells() + this->Rings->GetNumberOfCells() > 0;
    return this->Request.HasData && !hasCells;
  }

  /// Gives points without a value this one, up to a number of points.
  static void FillUp(const Attribute& attribute, vtkIdType points, double value)
  {
    while (attribute.Values->GetNumberOfValues() < points)
    {
      attribute.Values->InsertNextValue(value);
    }
  }

  /// Gives the points of a feature its values. @param before how many points precede it.
  void TakeAttributes(const OGRFeature& feature, vtkIdType before)
  {
    constexpr double None = std::numeric_limits<double>::quiet_NaN();
    for (const Attribute& attribute : this->Attributes)
    {
      if (attribute.Field < 0)
      {
        continue;
      }
      FillUp(attribute, before, None); // points of layers that do not have it
      double value = None;
      if (feature.IsFieldSetAndNotNull(attribute.Field))
      {
        value = this->ReadNumber(feature, attribute.Field);
      }
      FillUp(attribute, this->Points->GetNumberOfPoints(), value);
    }
  }

  /// A double holds all numbers of attributes but large integers of 64 bits.
  double ReadNumber(const OGRFeature& feature, int field)
  {
    const OGRFieldDefn* const definition = feature.GetFieldDefnRef(field);
    const double number = feature.GetFieldAsDouble(field);
    const bool isExact = definition->GetType() != OFTInteger64 ||
      (number < 0x1p63 && static_cast<std::int64_t>(number) == feature.GetFieldAsInteger64(field));
    if (!isExact)
    {
      AddName(this->Rounded, definition->GetNameRef());
    }
    return number;
  }

  /// Gives attributes to the points of the mesh, and tells of those that are left out.
  void StoreAttributes(FileMesh& file)
  {
    constexpr std::size_t Most = 10; // names in a warning
    if (!this->KeepsAttributes())
    {
      this->Texts = this->Names;
      this->Attributes.clear();
    }
    for (const Attribute& attribute : this->Attributes)
    {
      FillUp(
        attribute, this->Points->GetNumberOfPoints(), std::numeric_limits<double>::quiet_NaN());
      file.Mesh->GetPointData()->AddArray(attribute.Values);
    }
    std::vector<std::string> others;
    std::copy_if(this->Names.begin(), this->Names.end(), std::back_inserter(others),
      [this](const std::string& name) { return HasName(this->Texts, name); });
    const bool areMany = others.size() > Most;
    others.resize(std::min(others.size(), Most));
    if (!others.empty())
    {
      file.Warnings.push_back(
        "left out the attributes " + Quoted(others) + (areMany ? " and others" : ""));
    }
    for (const std::string& name : this->Rounded)
    {
      if (!HasName(this->Texts, name))
      {
        file.Warnings.push_back(
          "the attribute '" + Printable(name) + "' has integers beyond 2^53, which are rounded");
      }
    }
  }

  /// Layers should have one coordinate reference system: that of the first that names one.
  void CompareCrs(const OGRSpatialReference& crs, const std::string& layer)
  {
    if (std::string(crs.GetName()).rfind("Undefined", 0) == 0) // as newer versions of GDAL say
    {
      return;
    }
    if (!this->System)
    {
      this->System.reset(crs.Clone());
      this->SystemLayer = layer;
      this->Crs = WriteCrs(crs, "WKT2_2019");
      this->HasAngles = crs.IsGeographic() != 0;
      return;
    }
    const std::string names = DescribeDifference(crs, *this->System);
    if (!names.empty())
    {
      this->Warnings.push_back("the coordinate reference system of its layer " + Quoted({ layer }) +
        " is not that of its layer " + Quoted({ this->SystemLayer }) + " (" + names +
        "); the coordinates are taken as they are");
    }
  }

  bool MayBeAngles() const
  {
    constexpr double MostDegrees = 360.0;
    double bounds[6];
    this->Points->GetBounds(bounds);
    return std::all_of(
             bounds, bounds + 4, [](double x) { return !(std::fabs(x) > MostDegrees); }) ||
      this->Points->GetNumberOfPoints() == 0;
  }

  /// Finds the attributes of a layer. Those of several layers are joined by their names.
  void BeginLayer(OGRLayer& layer)
  {
    const OGRFeatureDefn& fields = *layer.GetLayerDefn();
    this->Layer = &layer;
    this->HeightField = -1;
    this->Numeric.clear();
    for (Attribute& attribute : this->Attributes)
    {
      attribute.Field = -1;
    }
    if (const OGRSpatialReference* const crs = layer.GetSpatialRef())
    {
      this->CompareCrs(*crs, layer.GetName());
    }
    for (int i = 0; i < fields.GetFieldCount(); ++i)
    {
      const OGRFieldType type = fields.GetFieldDefn(i)->GetType();
      const std::string name = fields.GetFieldDefn(i)->GetNameRef();
      const bool isNumeric = type == OFTInteger || type == OFTInteger64 || type == OFTReal;
      if (this->Request.Driver == "DXF") // which has only flags and what GDAL makes of the layer
      {
        continue;
      }
      if (isNumeric)
      {
        this->Numeric.push_back(name);
      }
      if (isNumeric && name == this->Request.Height)
      {
        this->HeightField = i;
        continue;
      }
      AddName(this->Names, name);
      if (isNumeric)
      {
        this->AttributeOf(name).Field = i;
      }
      else
      {
        AddName(this->Texts, name);
      }
    }
    if (this->HeightField < 0 && !this->Request.Height.empty())
    {
      throw std::runtime_error("--columns: layer '" + std::string(layer.GetName()) +
        "' has no numeric attribute '" + this->Request.Height + "'; it has " +
        (this->Numeric.empty() ? "no numeric attributes" : Quoted(this->Numeric)));
    }
  }

  /// The attribute with this name. Points of layers that do not have it have NaN.
  Attribute& AttributeOf(const std::string& name)
  {
    const auto known = std::find_if(this->Attributes.begin(), this->Attributes.end(),
      [&name](const Attribute& attribute) { return attribute.Name == name; });
    if (known != this->Attributes.end())
    {
      return *known;
    }
    this->Attributes.push_back({ name, vtkSmartPointer<vtkDoubleArray>::New() });
    Attribute& added = this->Attributes.back();
    added.Values->SetName(name.c_str());
    return added;
  }

  void TakeHeight(const OGRFeature& feature)
  {
    if (!feature.IsFieldSetAndNotNull(this->HeightField))
    {
      throw std::runtime_error("feature " + std::to_string(feature.GetFID()) +
        " has no value of '" + this->Request.Height + "'");
    }
    this->Height = this->ReadNumber(feature, this->HeightField);
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
  double Height = 0.0; ///< The z of the feature, from this attribute.
  std::vector<std::string> Numeric; ///< Its numeric attributes.
  std::vector<Attribute> Attributes; ///< Those of all layers.
  std::vector<std::string> Names; ///< All attributes but the height.
  std::vector<std::string> Texts; ///< Those that are no numbers.
  std::vector<std::string> Rounded; ///< Those with integers that doubles cannot hold.
  std::vector<std::string> Warnings;
  bool HasHeights = false;
  std::int64_t Empty = 0;
  std::int64_t Labels = 0; ///< How many labels a drawing has.
  std::unique_ptr<OGRSpatialReference> System; ///< That of the file; null: none is named.
  std::string SystemLayer; ///< The first layer that has it.
  std::string Crs; ///< Its text.
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

// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshBlocks.h"

#include "ConstraintEdges.h"
#include "DataArrays.h"
#include "FlipError.h"
#include "PieceFlip.h"
#include "PolyDataBridge.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUniformGridAMR.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace delaunayflip
{
namespace
{

/// The leaves of AMR, which is a tree from VTK 9.6 on, are grids.
vtkDataObjectTree* GetTree(vtkDataObject* data)
{
  return vtkUniformGridAMR::SafeDownCast(data) ? nullptr : vtkDataObjectTree::SafeDownCast(data);
}

/// What messages call a leaf: "block 3 (wing)", or "block 3" if it has no name.
std::string DescribeLeaf(vtkDataObjectTreeIterator* leaf, unsigned int number)
{
  std::string text = "block " + std::to_string(number);
  if (leaf->HasCurrentMetaData())
  {
    const char* name = leaf->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME());
    if (name && *name)
    {
      text += std::string(" (") + name + ")";
    }
  }
  return text;
}

/// The number of a child in the place of its block. The partitions that are not empty have one
/// place, and each empty one has another.
std::int64_t FindPlace(std::int64_t child, bool isPartition, bool isEmpty)
{
  if (!isPartition)
  {
    return child;
  }
  return isEmpty ? -1 - child : 0;
}

/// @param number the flat index of the tree, and then of its last node.
void AddLeaves(vtkDataObjectTree* tree, int elements, std::vector<std::int64_t> place,
  unsigned int& number, std::vector<MeshBlock>& blocks)
{
  const bool arePartitions = vtkPartitionedDataSet::SafeDownCast(tree) != nullptr;
  place.push_back(0);
  const auto child = vtkSmartPointer<vtkDataObjectTreeIterator>::Take(tree->NewTreeIterator());
  child->TraverseSubTreeOff();
  child->VisitOnlyLeavesOff();
  child->SkipEmptyNodesOff();
  std::int64_t i = 0;
  constexpr std::size_t None = SIZE_MAX;
  std::size_t joined = None; // the block of the partitions that are not empty
  for (child->InitTraversal(); !child->IsDoneWithTraversal(); child->GoToNextItem(), ++i)
  {
    ++number;
    vtkDataObject* data = child->GetCurrentDataObject();
    if (!data)
    {
      continue;
    }
    const auto size = static_cast<double>(data->GetNumberOfElements(elements));
    place.back() = FindPlace(i, arePartitions, size == 0.0);
    if (vtkDataObjectTree* inner = GetTree(data))
    {
      AddLeaves(inner, elements, place, number, blocks);
      continue;
    }
    const std::string name = DescribeLeaf(child, number);
    const bool isJoined = arePartitions && size > 0.0;
    std::size_t own = blocks.size();
    if (isJoined)
    {
      joined = std::min(joined, own);
      own = joined;
    }
    if (own == blocks.size())
    {
      blocks.push_back({ place, name, 0.0, false, {} });
    }
    blocks[own].Size += size;
    blocks[own].Leaves.push_back({ data, number, name, nullptr });
  }
}

}

std::vector<MeshBlock> ListMeshBlocks(vtkDataObject* input, int elements)
{
  std::vector<MeshBlock> blocks;
  unsigned int number = 0;
  if (vtkDataObjectTree* tree = GetTree(input))
  {
    AddLeaves(tree, elements, {}, number, blocks);
  }
  else
  {
    const bool isComposite = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
    std::vector<std::int64_t> place(static_cast<std::size_t>(isComposite));
    const auto size = static_cast<double>(input->GetNumberOfElements(elements));
    blocks.push_back({ place, "", size, false, { { input, number, "", nullptr } } });
  }
  return blocks;
}

std::vector<MeshBlock> ListOtherBlocks(vtkDataObject* input, int elements)
{
  std::vector<MeshBlock> blocks = ListMeshBlocks(input, elements);
  blocks.resize(std::max<std::size_t>(1, blocks.size()), { { 0 }, "", 0.0, false, {} });
  return blocks;
}

namespace
{

/// Says which part of a leaf of the second input is ignored, and why; "" if none is.
/// @param fits whether the first input has something at the same place.
std::string DescribeMisfit(const BlockLeaf& leaf, bool fits)
{
  if (!fits)
  {
    return "ignored, because the first input has nothing at this place";
  }
  auto* mesh = vtkPolyData::SafeDownCast(leaf.Data);
  if (!mesh)
  {
    return "not a vtkPolyData, ignored";
  }
  if (mesh->GetNumberOfStrips() > 0)
  {
    return "triangle strips ignored";
  }
  return "";
}

}

std::vector<Note> ListMisfits(const std::vector<MeshBlock>& blocks,
  const std::vector<MeshBlock>& others, const std::string& name)
{
  std::set<std::vector<std::int64_t>> places;
  for (const MeshBlock& block : blocks)
  {
    places.insert(block.Place);
  }
  std::vector<Note> notes;
  for (const MeshBlock& other : others)
  {
    const bool fits = other.Place.empty() || places.count({}) > 0 || places.count(other.Place) > 0;
    for (const BlockLeaf& leaf : other.Leaves)
    {
      const std::string fault = DescribeMisfit(leaf, fits);
      if (!fault.empty() && leaf.Data->GetNumberOfElements(vtkDataObject::CELL) > 0)
      {
        const std::string prefix = leaf.Name.empty() ? "" : leaf.Name + " of the ";
        notes.push_back({ prefix + name, fault });
      }
    }
  }
  return notes;
}

std::vector<BlockLeaf> ListOthers(const MeshBlock& block, const std::vector<MeshBlock>& others,
  const std::string& what, const char* type)
{
  std::vector<BlockLeaf> leaves;
  for (const MeshBlock& other : others)
  {
    const bool isOfAll = other.Place.empty();
    if (block.Place.empty() && !isOfAll)
    {
      throw InvalidOptions(what + " cannot be a composite dataset");
    }
    if (isOfAll || other.Place == block.Place)
    {
      std::copy_if(other.Leaves.begin(), other.Leaves.end(), std::back_inserter(leaves),
        [type](const BlockLeaf& leaf) { return leaf.Data->IsA(type) != 0; });
    }
  }
  return leaves;
}

namespace
{

/// Gives `copy` the structure of a tree, and leaves. @param leafOf the leaf at an iterator.
template <typename LeafOf>
void CopyTree(vtkDataObjectTree* tree, vtkDataObjectTree* copy, const LeafOf& leafOf)
{
  copy->CopyStructure(tree);
  copy->GetFieldData()->ShallowCopy(tree->GetFieldData());
  const auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(tree->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    copy->SetDataSet(leaf, leafOf(leaf));
  }
}

}

vtkSmartPointer<vtkDataObject> Hold(vtkDataObject* data)
{
  if (!data)
  {
    return nullptr;
  }
  auto held = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
  if (vtkDataObjectTree* tree = GetTree(data)) // in VTK 9.1 a shallow copy has the same leaves
  {
    CopyTree(tree, vtkDataObjectTree::SafeDownCast(held),
      [](vtkCompositeDataIterator* leaf) { return Hold(leaf->GetCurrentDataObject()); });
  }
  else
  {
    held->ShallowCopy(data);
  }
  return held;
}

void StoreResults(const std::vector<MeshBlock>& blocks, vtkDataObject* input, vtkDataObject* output)
{
  vtkDataObjectTree* given = GetTree(input);
  auto* tree = vtkDataObjectTree::SafeDownCast(output);
  if (!given || !tree)
  {
    output->ShallowCopy(blocks.front().Leaves.front().Result);
    return;
  }
  std::map<unsigned int, vtkDataObject*> results; // by flat index
  for (const MeshBlock& block : blocks)
  {
    for (const BlockLeaf& leaf : block.Leaves)
    {
      results[leaf.Number] = leaf.Result;
    }
  }
  CopyTree(given, tree,
    [&](vtkCompositeDataIterator* leaf) { return results[leaf->GetCurrentFlatIndex()]; });
}

//------------------------------------------------------------------------------
namespace
{

/// Verts, lines, polygons and strips, which is the order of cell ids.
std::array<vtkCellArray*, 4> ListCells(vtkPolyData* mesh)
{
  return { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys(), mesh->GetStrips() };
}

/// @throws InvalidMesh when a cell names a point that does not exist.
void RequireValidCells(vtkPolyData* mesh)
{
  PointIdCheck check{ "cell", 0, mesh->GetNumberOfPoints() };
  for (vtkCellArray* cells : ListCells(mesh))
  {
    VisitCells(cells, check, [](vtkIdType, vtkIdList*) {});
    check.FirstCell += cells->GetNumberOfCells();
  }
}

/// Gives a mesh cells of other, valid ones, and the data of these cells.
/// @param chosen by mesh the ids of cells, ascending. @param areWide whether ids are stored in 64
/// bits. @param newId of a point, by the number of its mesh and its id there.
/// @returns for each cell the number of its mesh.
template <typename NewId>
vtkSmartPointer<vtkIntArray> CopyCells(const MeshList& meshes,
  const std::vector<vtkSmartPointer<vtkIdList>>& chosen, bool areWide, const NewId& newId,
  vtkPolyData* copy)
{
  auto owners = vtkSmartPointer<vtkIntArray>::New();
  vtkIdType size = 0;
  for (const auto& cells : chosen)
  {
    size += cells->GetNumberOfIds();
  }
  std::array<vtkNew<vtkCellArray>, 4> copied; // by kind
  std::vector<vtkIdType> first(meshes.size()); // cell of the kind
  copy->GetCellData()->Initialize();
  for (std::size_t kind = 0; kind < copied.size(); ++kind)
  {
    SetWidth(copied[kind], areWide);
    for (std::size_t k = 0; k < meshes.size(); ++k)
    {
      const auto arrays = ListCells(meshes[k]);
      const vtkIdType last = first[k] + arrays[kind]->GetNumberOfCells();
      const vtkIdType next = owners->GetNumberOfValues();
      vtkNew<vtkIdList> sources, ids;
      for (auto cell = std::lower_bound(chosen[k]->begin(), chosen[k]->end(), first[k]);
           cell != chosen[k]->end() && *cell < last; ++cell)
      {
        arrays[kind]->GetCellAtId(*cell - first[k], ids);
        std::transform(
          ids->begin(), ids->end(), ids->begin(), [&](vtkIdType id) { return newId(k, id); });
        copied[kind]->InsertNextCell(ids);
        sources->InsertNextId(*cell);
        owners->InsertNextValue(static_cast<int>(k));
      }
      first[k] = last;
      const auto own = TakeWholeArrays(meshes[k]->GetCellData(), meshes[k]->GetNumberOfCells());
      vtkAbstractArray* ghosts = own->GetAbstractArray(vtkDataSetAttributes::GhostArrayName());
      if (ghosts && IsWrongGhostArray(ghosts))
      {
        own->RemoveArray(ghosts->GetName()); // else it would hide those of other partitions
      }
      AddTuples(
        own, sources, MakeRange(next, sources->GetNumberOfIds()), size, copy->GetCellData());
    }
  }
  copy->SetVerts(copied[0]);
  copy->SetLines(copied[1]);
  copy->SetPolys(copied[2]);
  copy->SetStrips(copied[3]);
  return owners;
}

/// Joins the points of all partitions. Points with the same global id are one. If a partition has
/// no global ids, points with equal coordinates are one if at least one of them is at the border of
/// its partition. Points without cells are not compared.
/// @param joined receives each once, with its data: those of the first partition that has it.
/// @returns for each partition the new ids of its points.
std::vector<vtkSmartPointer<vtkIdList>> AddPoints(
  const MeshList& partitions, vtkPolyData* joined, vtkIdType& ambiguous)
{
  std::vector<std::unique_ptr<PolyDataBridge>> bridges;
  std::vector<std::vector<std::int64_t>> numbers;
  std::vector<MeshPiece> pieces;
  bool areFloats = true;
  for (const auto& mesh : partitions)
  {
    bridges.push_back(
      std::make_unique<PolyDataBridge>(mesh, nullptr, BridgeSettings(), UpdatePlan({}, {})));
    bridges.back()->RequireValidIds();
    numbers.push_back(ReadPointNumbers(mesh));
    pieces.push_back({ bridges.back()->GetMesh(), ViewValues(numbers.back()) });
    areFloats = areFloats && (!mesh->GetPoints() || mesh->GetPoints()->GetDataType() == VTK_FLOAT);
  }
  const JoinedPoints found = JoinPoints(pieces);
  ambiguous = found.Ambiguous;
  std::vector<vtkIdType> all; // ids in the joined mesh for the points of all partitions
  std::vector<vtkSmartPointer<vtkIdList>> ids;
  vtkNew<vtkPoints> points;
  points->SetDataType(FindPointType(areFloats));
  for (const auto& mesh : partitions)
  {
    ids.push_back(vtkSmartPointer<vtkIdList>::New());
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const std::int64_t same = found.Same[all.size()];
      const bool isKnown = same < static_cast<std::int64_t>(all.size());
      const vtkIdType id = isKnown ? all[same] : points->InsertNextPoint(mesh->GetPoint(i));
      all.push_back(id);
      ids.back()->InsertNextId(id);
    }
  }
  joined->SetPoints(points);
  for (std::size_t k = partitions.size(); k-- > 0;) // the first one's data count
  {
    const vtkIdType count = partitions[k]->GetNumberOfPoints();
    AddTuples(TakeWholeArrays(partitions[k]->GetPointData(), count), MakeRange(0, count), ids[k],
      points->GetNumberOfPoints(), joined->GetPointData());
  }
  return ids;
}

void RequireRegions(const MeshList& partitions, const std::string& name)
{
  vtkAbstractArray* first = partitions.front()->GetCellData()->GetAbstractArray(name.c_str());
  for (const auto& mesh : partitions)
  {
    vtkAbstractArray* own = mesh->GetCellData()->GetAbstractArray(name.c_str());
    if (!own || !first || own->GetDataType() != first->GetDataType() ||
      own->GetNumberOfComponents() != first->GetNumberOfComponents() ||
      own->GetNumberOfTuples() < mesh->GetNumberOfCells())
    {
      throw InvalidOptions("not all partitions have a cell array named \"" + name +
        "\" of the same type, with a tuple for every cell");
    }
  }
}

/// A mesh without the cells that are marked as copies of cells of other meshes (vtkGhostType), on
/// the same points.
/// @throws InvalidMesh when a cell names a point that does not exist.
vtkSmartPointer<vtkPolyData> DropDuplicateCells(vtkPolyData* mesh)
{
  const auto ghosts = FindGhosts(mesh);
  const auto isDuplicate = [](unsigned char ghost)
  { return (ghost & vtkDataSetAttributes::DUPLICATECELL) != 0; };
  if (!ghosts || std::none_of(ghosts->Begin(), ghosts->End(), isDuplicate))
  {
    return mesh;
  }
  RequireValidCells(mesh);
  const auto own = vtkSmartPointer<vtkIdList>::New();
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    if (cell >= ghosts->GetNumberOfValues() || !isDuplicate(ghosts->GetValue(cell)))
    {
      own->InsertNextId(cell);
    }
  }
  const auto kept = ShareMesh(mesh);
  CopyCells(
    { mesh }, { own }, UsesWideIds(mesh), [](std::size_t, vtkIdType id) { return id; }, kept);
  return kept;
}

/// Joins the cells of all partitions but duplicate ghost cells, on points that each appear once,
/// and their data, by AddTuples. There are no field data.
/// @param partitions at least two. Ghost arrays that are ignored, and arrays with too few tuples,
/// are left out.
/// @param regions the name of a cell array that all must have, or empty.
/// @throws InvalidMesh when a cell names a point that does not exist; InvalidOptions when a
/// partition lacks the regions, or has them in another type.
JoinedMesh JoinPartitions(const MeshList& partitions, const std::string& regions)
{
  MeshList meshes;
  std::vector<vtkSmartPointer<vtkIdList>> all; // cells
  bool areWide = false;
  for (const auto& mesh : partitions)
  {
    RequireValidCells(mesh);
    meshes.push_back(DropDuplicateCells(mesh));
    all.push_back(MakeRange(0, meshes.back()->GetNumberOfCells()));
    areWide = areWide || UsesWideIds(mesh);
  }
  if (!regions.empty())
  {
    RequireRegions(meshes, regions);
  }
  JoinedMesh joined{ vtkSmartPointer<vtkPolyData>::New(), {}, nullptr };
  joined.Points = AddPoints(meshes, joined.Mesh, joined.Ambiguous);
  joined.Owners = CopyCells(
    meshes, all, areWide, [&](std::size_t k, vtkIdType id) { return joined.Points[k]->GetId(id); },
    joined.Mesh);
  return joined;
}

/// Divides a joined mesh after its flips. A partition has its own points first, with their data,
/// then those that it lacks, with the arrays that the joined mesh has. Its field data come before
/// those of that mesh.
/// @param owners for each cell its partition.
MeshList DividePartitions(vtkPolyData* flipped, vtkIntArray* owners, const MeshList& partitions,
  const std::vector<vtkSmartPointer<vtkIdList>>& points)
{
  constexpr vtkIdType None = -1;
  MeshList divided;
  std::vector<vtkNew<vtkIdList>> cellsOf(partitions.size());
  for (vtkIdType cell = 0; cell < owners->GetNumberOfValues(); ++cell)
  {
    cellsOf[owners->GetValue(cell)]->InsertNextId(cell);
  }
  std::vector<vtkIdType> local(flipped->GetNumberOfPoints(), None);
  for (std::size_t k = 0; k < partitions.size(); ++k)
  {
    vtkPolyData* own = partitions[k];
    vtkNew<vtkIdList> ids; // the ids of its points in the joined mesh
    const auto take = [&](std::size_t, vtkIdType id)
    {
      if (local[id] == None)
      {
        local[id] = ids->InsertNextId(id);
      }
      return local[id];
    };
    for (const vtkIdType id : *points[k])
    {
      local[id] = ids->InsertNextId(id);
    }
    vtkPolyData* made = divided.emplace_back(vtkSmartPointer<vtkPolyData>::New());
    CopyCells({ flipped }, { cellsOf[k].Get() }, UsesWideIds(own), take, made);
    const vtkIdType given = own->GetNumberOfPoints(), count = ids->GetNumberOfIds();
    made->SetPoints(own->GetPoints());
    if (count > given)
    {
      vtkNew<vtkIdList> received;
      received->SetNumberOfIds(count - given);
      std::copy(ids->begin() + given, ids->end(), received->begin());
      made->SetPoints(ExtendPoints(own, flipped->GetPoints(), received));
    }
    AddTuples(flipped->GetPointData(), ids, MakeRange(0, count), count, made->GetPointData());
    AddTuples(TakeWholeArrays(own->GetPointData(), given), MakeRange(0, given), MakeRange(0, given),
      count, made->GetPointData());
    made->GetFieldData()->ShallowCopy(own->GetFieldData());
    made->GetFieldData()->PassData(flipped->GetFieldData());
    for (const vtkIdType id : *ids)
    {
      local[id] = None;
    }
  }
  return divided;
}

}

std::vector<std::int64_t> ReadPointNumbers(vtkPolyData* mesh)
{
  vtkDataArray* ids = mesh->GetPointData()->GetGlobalIds();
  std::vector<std::int64_t> numbers;
  if (ids && ids->GetNumberOfComponents() == 1 &&
    ids->GetNumberOfTuples() == mesh->GetNumberOfPoints())
  {
    for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i) // a double has too few bits for an id
    {
      numbers.push_back(ids->GetVariantValue(i).ToTypeInt64());
    }
  }
  return numbers;
}

//------------------------------------------------------------------------------
BlockMesh::BlockMesh(MeshBlock& block, const std::string& regions, bool dropsDuplicates)
  : Block(block)
{
  for (const BlockLeaf& leaf : block.Leaves)
  {
    this->Surfaces.emplace_back(vtkPolyData::SafeDownCast(Hold(leaf.Data)));
    if (vtkPolyData* surface = this->Surfaces.back())
    {
      DropResults(surface->GetFieldData());
      DropResults(surface->GetCellData());
      this->Meshes.emplace_back(surface);
    }
  }
  if (this->IsJoined())
  {
    this->Joined = JoinPartitions(this->Meshes, regions);
    if (dropsDuplicates)
    {
      this->Joined.Mesh->GetFieldData()->ShallowCopy(this->Meshes.front()->GetFieldData());
    }
    else
    {
      vtkCellData* data = this->Joined.Mesh->GetCellData();
      std::string name = "vtkDelaunayFlipPartition";
      while (data->HasArray(name.c_str()))
      {
        name += " (2)";
      }
      this->Joined.Owners->SetName(name.c_str());
      data->AddArray(this->Joined.Owners);
    }
  }
  else if (!this->Meshes.empty())
  {
    this->Joined.Mesh = this->Meshes.front();
    if (dropsDuplicates)
    {
      this->Joined.Mesh = DropDuplicateCells(this->Joined.Mesh);
    }
  }
}

std::vector<Note> BlockMesh::ListNotes(bool ofArrays) const
{
  std::vector<Note> notes;
  bool areAllSurfaces = true;
  for (std::size_t i = 0; i < this->Surfaces.size(); ++i)
  {
    if (this->Surfaces[i] && (this->IsJoined() || ofArrays))
    {
      const std::string text =
        DescribeDefects(ListMalformedArrays(this->Surfaces[i], false, false));
      if (!text.empty())
      {
        notes.push_back({ this->Block.Leaves[i].Name, text });
      }
    }
    areAllSurfaces = areAllSurfaces && this->Surfaces[i];
  }
  if (!areAllSurfaces && this->Block.Size > 0.0)
  {
    notes.push_back({ this->Block.Name, "not a surface, passed unchanged" });
  }
  if (this->Joined.Ambiguous > 0)
  {
    notes.push_back({ this->Block.Name,
      "points of some partitions coincide with others of the same partition, and edges there "
      "stayed; number the points of the mesh before it is cut, as vtkGlobalPointIds" });
  }
  return notes;
}

vtkSmartPointer<vtkPolyData> BlockMesh::FindConstraints(
  const std::vector<MeshBlock>& constraints) const
{
  const std::vector<BlockLeaf> leaves =
    ListOthers(this->Block, constraints, "the constraints of a single mesh");
  std::vector<std::pair<vtkPolyData*, vtkPolyData*>> sources; // each with the mesh that it is for
  for (const BlockLeaf& leaf : leaves)
  {
    auto* edges = vtkPolyData::SafeDownCast(leaf.Data);
    const bool isOfAll = leaf.Number == 0;
    const bool isOnly = !this->IsJoined() && leaves.size() == 1;
    const bool isForJoined = this->IsJoined() && isOfAll && edges->GetNumberOfPoints() > 0;
    if (isOnly || isForJoined)
    {
      return edges;
    }
    const std::size_t before = sources.size();
    for (std::size_t i = 0; i < this->Surfaces.size(); ++i)
    {
      if (this->Surfaces[i] && (isOfAll || this->Block.Leaves[i].Number == leaf.Number))
      {
        sources.emplace_back(edges, this->Surfaces[i]);
      }
    }
    if (sources.size() == before)
    {
      vtkPolyData* mesh = this->IsJoined() ? nullptr : this->GetMesh();
      sources.emplace_back(edges, mesh);
    }
  }
  return JoinConstraints(sources);
}

void BlockMesh::Store(vtkPolyData* flipped)
{
  MeshList results{ flipped };
  if (flipped && this->IsJoined() && this->Joined.Owners->GetName())
  {
    const char* name = this->Joined.Owners->GetName();
    vtkCellData* data = flipped->GetCellData();
    const vtkSmartPointer<vtkIntArray> owners = vtkIntArray::SafeDownCast(data->GetArray(name));
    data->RemoveArray(name);
    results = DividePartitions(flipped, owners, this->Meshes, this->Joined.Points);
  }
  auto next = results.begin();
  for (std::size_t i = 0; i < this->Surfaces.size(); ++i)
  {
    BlockLeaf& leaf = this->Block.Leaves[i];
    if (!flipped || !this->Surfaces[i])
    {
      leaf.Result = Hold(leaf.Data);
    }
    else if (next != results.end())
    {
      leaf.Result = *next++;
    }
    else
    {
      leaf.Result = vtkSmartPointer<vtkPolyData>::New();
    }
  }
}

}

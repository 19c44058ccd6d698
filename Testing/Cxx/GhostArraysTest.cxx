// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Ghost arrays that are too short, or of another kind than ghost types have, with one warning that
/// names them.

#include "FilterTestSupport.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

namespace
{

constexpr int Hidden = vtkDataSetAttributes::HIDDENCELL;
const std::string WrongType =
  "1 ghost array that is not of type unsigned char ignored: \"vtkGhostType\"";
const std::string WrongComponents =
  "1 ghost array with several components ignored: \"vtkGhostType\"";

/// Ghost types of a rhombus: all are `flag`.
template <typename ArrayT>
vtkSmartPointer<ArrayT> MakeGhosts(int flag, int components = 1, vtkIdType tuples = 2)
{
  auto ghosts = vtkSmartPointer<ArrayT>::New();
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfComponents(components);
  ghosts->SetNumberOfTuples(tuples);
  ghosts->Fill(flag);
  return ghosts;
}

/// A rhombus in a place of its own.
vtkSmartPointer<vtkPolyData> MakeRhombusAt(double x, vtkAbstractArray* ghosts)
{
  auto mesh = MakeMesh(
    { { x - 3, 0, 0 }, { x, -1, 0 }, { x + 3, 0, 0 }, { x, 1, 0 } }, { { 0, 1, 2 }, { 0, 2, 3 } });
  if (ghosts)
  {
    mesh->GetCellData()->AddArray(ghosts);
  }
  return mesh;
}

bool IsFlipped(vtkDataObject* rhombus)
{
  auto* mesh = vtkPolyData::SafeDownCast(rhombus);
  return mesh && HasEdge(mesh, 1, 3);
}

/// Updates. @returns the only message, a warning.
std::string RunToOneWarning(WatchedFilter& filter)
{
  filter->Update();
  EXPECT_EQ(filter.GetErrors(), std::vector<std::string>{});
  EXPECT_EQ(filter.GetWarnings().size(), 1u);
  return filter.GetWarnings().empty() ? "" : filter.GetWarnings()[0];
}

void ExpectIgnored(vtkAbstractArray* ghosts, const std::string& expected)
{
  const auto mesh = MakeRhombusAt(0.0, ghosts);
  WatchedFilter filter(mesh);
  const std::string warning = RunToOneWarning(filter);
  EXPECT_TRUE(Holds(warning, expected)) << warning;
  EXPECT_TRUE(IsFlipped(filter->GetOutput()));
  EXPECT_EQ(filter->GetOutput()->GetCellData()->GetAbstractArray("vtkGhostType"), ghosts);
}

/// Flips rhombi that are partitions of one dataset.
class Partitions
{
public:
  explicit Partitions(const std::vector<vtkSmartPointer<vtkAbstractArray>>& ghosts)
  {
    for (const auto& array : ghosts)
    {
      const unsigned int count = this->Data->GetNumberOfPartitions();
      this->Data->SetPartition(count, MakeRhombusAt(10.0 * count, array));
    }
    this->Filter->SetInputDataObject(this->Data);
  }

  vtkPolyData* Get(unsigned int partition)
  {
    return vtkPolyData::SafeDownCast(
      vtkPartitionedDataSet::SafeDownCast(this->Filter->GetOutputDataObject(0))
        ->GetPartitionAsDataObject(partition));
  }

  WatchedFilter Filter;

private:
  vtkNew<vtkPartitionedDataSet> Data;
};

}

TEST(GhostArrays, ShortOnesFixTheCellsThatTheyHave)
{
  const auto mesh =
    MakeRhombusAt(0.0, MakeGhosts<vtkUnsignedCharArray>(vtkDataSetAttributes::DUPLICATECELL, 1, 1));
  WatchedFilter filter(mesh);
  const std::string warning = RunToOneWarning(filter);
  EXPECT_TRUE(Holds(warning, "too few tuples passed unchanged: \"vtkGhostType\"")) << warning;
  EXPECT_FALSE(IsFlipped(filter->GetOutput()));
}

TEST(GhostArrays, ThoseOfAnotherKindAreIgnored)
{
  ExpectIgnored(MakeGhosts<vtkIntArray>(Hidden), WrongType);
  ExpectIgnored(MakeGhosts<vtkUnsignedCharArray>(Hidden, 2), WrongComponents);
  auto texts = vtkSmartPointer<vtkStringArray>::New();
  texts->SetName(vtkDataSetAttributes::GhostArrayName());
  texts->SetNumberOfValues(2);
  ExpectIgnored(texts, WrongType);
}

TEST(GhostArrays, MayHaveAnyLayoutOfMemory)
{
  auto ghosts = vtkSmartPointer<vtkSOADataArrayTemplate<unsigned char>>::New();
  ghosts->SetNumberOfComponents(1);
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(2);
  ghosts->Fill(Hidden);
  const auto mesh = MakeRhombusAt(0.0, ghosts);
  WatchedFilter filter(mesh);
  EXPECT_FALSE(IsFlipped(RunCleanly(filter)));
}

TEST(GhostArrays, OfBlocksAreNamed)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeRhombusAt(0.0, nullptr));
  blocks->SetBlock(1, MakeRhombusAt(0.0, MakeGhosts<vtkIntArray>(Hidden)));
  WatchedFilter filter;
  filter->SetInputDataObject(blocks);
  const std::string warning = RunToOneWarning(filter);
  EXPECT_TRUE(Holds(warning, "block 2: " + WrongType)) << warning;
}

TEST(GhostArrays, OfPartitionsAreNamed)
{
  const auto wrong = MakeGhosts<vtkIntArray>(Hidden);
  Partitions all({ wrong, nullptr, wrong, MakeGhosts<vtkUnsignedCharArray>(Hidden, 2) });
  const std::string warning = RunToOneWarning(all.Filter);
  EXPECT_TRUE(Holds(warning, "block 1, block 3: " + WrongType + "; block 4: " + WrongComponents))
    << warning;
  for (unsigned int partition = 0; partition < 4; ++partition)
  {
    EXPECT_TRUE(IsFlipped(all.Get(partition))) << partition;
  }
}

/// Whatever the order of the partitions, an array that is ignored does not hide another one.
TEST(GhostArrays, ThoseThatAreIgnoredLeaveOthersInForce)
{
  const auto wrong = MakeGhosts<vtkIntArray>(7);
  const auto right = MakeGhosts<vtkUnsignedCharArray>(Hidden);
  for (const unsigned int first : { 0u, 1u })
  {
    Partitions both(first == 0 ? std::vector<vtkSmartPointer<vtkAbstractArray>>{ wrong, right }
                               : std::vector<vtkSmartPointer<vtkAbstractArray>>{ right, wrong });
    const std::string warning = RunToOneWarning(both.Filter);
    EXPECT_TRUE(Holds(warning, "block " + std::to_string(first + 1) + ": " + WrongType)) << warning;
    EXPECT_TRUE(IsFlipped(both.Get(first)));
    EXPECT_FALSE(IsFlipped(both.Get(1 - first)));
    vtkDataArray* passed = both.Get(first)->GetCellData()->GetArray("vtkGhostType");
    ASSERT_NE(vtkIntArray::SafeDownCast(passed), nullptr);
    EXPECT_EQ(passed->GetTuple1(1), 7.0);
    vtkDataArray* used = both.Get(1 - first)->GetCellData()->GetArray("vtkGhostType");
    EXPECT_NE(vtkUnsignedCharArray::SafeDownCast(used), nullptr);
  }
}

TEST(GhostArrays, ShortOnesOfPartitionsAreNamed)
{
  Partitions both({ nullptr, MakeGhosts<vtkUnsignedCharArray>(0, 1, 1) });
  const std::string warning = RunToOneWarning(both.Filter);
  EXPECT_TRUE(
    Holds(warning, "block 2: 1 cell array with too few tuples left out: \"vtkGhostType\""))
    << warning;
  EXPECT_TRUE(IsFlipped(both.Get(1)));
}

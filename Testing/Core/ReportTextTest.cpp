// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipReport.h"

#include <gtest/gtest.h>

namespace delaunayflip
{
namespace
{

TEST(ReportText, NamesEveryStopReason)
{
  EXPECT_STREQ("not started", ToString(StopReasonKind::NotStarted));
  EXPECT_STREQ("converged", ToString(StopReasonKind::Converged));
  EXPECT_STREQ("iteration limit", ToString(StopReasonKind::IterationLimit));
  EXPECT_STREQ("aborted", ToString(StopReasonKind::Aborted));
  EXPECT_STREQ("running", ToString(StopReasonKind::Running));
}

TEST(ReportText, NamesEveryGeometry)
{
  EXPECT_STREQ("auto", ToString(GeometryKind::Auto));
  EXPECT_STREQ("planar", ToString(GeometryKind::Planar));
  EXPECT_STREQ("planar-xy", ToString(GeometryKind::PlanarXY));
  EXPECT_STREQ("surface", ToString(GeometryKind::Surface));
}

TEST(ReportText, SaysDefectsInOneSentence)
{
  const Defect flat = { "zero-area triangles", 12, { 3, 8, 11 }, DefectIds::Triangles };
  const Defect noIds = { "things without ids", 2, {}, DefectIds::Points };
  EXPECT_EQ("", DescribeDefects({}));
  EXPECT_EQ("12 zero-area triangles (first: 3, 8, 11)", DescribeDefects({ flat }));
  EXPECT_EQ("12 zero-area triangles (first: 3, 8, 11); 2 things without ids",
    DescribeDefects({ flat, noIds }));
}

TEST(ReportText, SaysToleranceWhereItIsUsed)
{
  FlipOptions options;
  EXPECT_EQ("none", DescribeTolerance(options, GeometryKind::PlanarXY));
  EXPECT_EQ("automatic", DescribeTolerance(options, GeometryKind::Surface));
  options.Tolerance = 1e-9;
  EXPECT_EQ("1e-09", DescribeTolerance(options, GeometryKind::Surface));
  options.Criterion = CriterionKind::OppositeAngles;
  EXPECT_EQ("1e-09", DescribeTolerance(options, GeometryKind::Planar));
}

}
}

// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEQUALITY_H
#define DELAUNAYFLIP_PIECEQUALITY_H

#include "PieceMesh.h"
#include "PieceSurvey.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The squared cotangent of the smallest angle of a triangle, as defined in AngleSurvey.h.
/// @param x the coordinates of its corners.
double MeasureCotangent(const double (&x)[3][3], const PieceSurvey& survey);

/// The smallest angle of all triangles of a rank, in degrees; NaN if there is none.
double FindSmallestAngle(const PieceMesh& mesh, const PieceSurvey& survey, int threads);

/// The same after rounds, in less time: the engine of the first flips measures the triangles that
/// are not listed.
double FindSmallestAngleAfterRounds(const PieceMesh& mesh, const PieceSurvey& survey);

}

#endif

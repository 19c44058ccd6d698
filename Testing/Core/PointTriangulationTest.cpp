// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CgalReference.h"
#include "DelaunayFlip.h"
#include "FlipTestSupport.h"
#include "PointFamilies.h"

#include <gtest/gtest.h>

/* SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
 * SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef DELAUNAYFLIP_CHECK_H
#define DELAUNAYFLIP_CHECK_H

#include "delaunayflip_c.h"

#include <stdio.h>
#include <stdlib.h>

/** Ends the program with status 1, and says why, unless the condition holds. */
#define CHECK(condition)                                                                         \
  do                                                                                             \
  {                                                                                              \
    if (!(condition))                                                                            \
    {                                                                                            \
      fprintf(stderr, "line %d: %s (%s)\n", __LINE__, #condition, delaunayflip_error_message()); \
      exit(1);                                                                                   \
    }                                                                                            \
  } while (0)

/** Whether the two triangles of a quad have the diagonal from point 1 to point 3. */
static inline int HasShortDiagonal(const int64_t* triangles)
{
  int ends = 0;
  int i;
  for (i = 0; i < 6; ++i)
  {
    ends += triangles[i] == 1 || triangles[i] == 3;
  }
  return ends == 4;
}

#endif

/* SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
 * SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef DELAUNAYFLIP_C_INTERFACE_H
#define DELAUNAYFLIP_C_INTERFACE_H

#include <stdint.h>

/** @file
 * The engine's C interface, in the shared library libdelaunayflip: for C, and for every language
 * that can call C (Python's ctypes, Julia, Rust, Fortran, ...). This flips a mesh of two triangles,
 * and fills a report:
 *
 *     const double xyz[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
 *     int64_t ids[] = { 0, 1, 2, 0, 2, 3 };
 *     delaunayflip_mesh mesh;
 *     delaunayflip_mesh_init(&mesh);
 *     mesh.points = xyz;
 *     mesh.number_of_points = 4;
 *     mesh.triangles = ids;
 *     mesh.number_of_triangles = 2;
 *     delaunayflip_report report;
 *     delaunayflip_report_init(&report);
 *     if (delaunayflip_flip(&mesh, NULL, NULL, ids, &report) != DELAUNAYFLIP_OK)
 *     {
 *       puts(delaunayflip_error_message());
 *     }
 *     report.total_flips; // 1
 *
 * Rules that hold for all of it:
 *
 * - Every function that can fail returns a delaunayflip_status. After a failure,
 *   delaunayflip_error_message() says what was wrong, where, and what to do. A failing call writes
 *   none of its outputs.
 * - A struct begins with its size in bytes. Call its `_init` function before you set members; from
 *   other languages than C and C++ its `_init_sized` function, with the size of the struct there.
 *   Newer headers only add members at the end, so a program compiled with an older header works
 *   with a newer library, from 0.2.0 on. Enumerations are passed as int32_t.
 * - Points, triangles, queries and results may be in the memory of a GPU; everything else is in the
 *   host's. Such arrays are read or written after the work that is already in the caller's stream.
 *   When a function returns, its results are complete.
 * - Arrays belong to the caller. The library neither keeps nor frees them, except that a session
 *   reads the arrays of its mesh as long as it exists.
 * - Different sessions may be used by different threads at the same time; one session by one thread
 *   at a time.
 * - Any number of threads and any backend give the same result, bit for bit, for the same mesh and
 *   options.
 */

#ifdef __cplusplus
extern "C"
{
#endif

/** The version of this interface. Check that delaunayflip_interface_version() returns the same. */
#define DELAUNAYFLIP_INTERFACE_VERSION 1

  /** The interface version of the library that was loaded. */
  int32_t delaunayflip_interface_version(void);

  /** The release of the library, e.g. "0.2.0". */
  const char* delaunayflip_version(void);

  typedef enum
  {
    DELAUNAYFLIP_OK = 0,
    /** A triangle or constraint edge names a point that does not exist. */
    DELAUNAYFLIP_INVALID_MESH = 1,
    DELAUNAYFLIP_INVALID_OPTIONS = 2, /**< Options out of range, or that contradict the mesh. */
    DELAUNAYFLIP_MESH_TOO_LARGE = 3,
    DELAUNAYFLIP_BACKEND_UNAVAILABLE = 4, /**< The requested backend cannot run here. */
    DELAUNAYFLIP_OUT_OF_MEMORY = 5,
    /** A null pointer, an unknown type, or a struct without a size. */
    DELAUNAYFLIP_INVALID_CALL = 6,
    DELAUNAYFLIP_FAILED = 7, /**< Anything else. */
    DELAUNAYFLIP_STOPPED = 8 /**< A callback stopped a call that cannot return a partial result. */
  } delaunayflip_status;

  /** The message of the last failing call of this thread, in English; "" if there was none. Valid
   * until the thread's next failing call. At most 1023 bytes: what is longer is cut off. */
  const char* delaunayflip_error_message(void);

  /** Where the last failing call of this thread found an invalid mesh: the triangle or the
   * constraint edge, and the point id that it names. -1 where the failure has no such place. */
  int64_t delaunayflip_error_cell(void);
  int64_t delaunayflip_error_point(void);

  /** The ring that makes the points of the last failing call invalid; -1 if there is none. */
  int64_t delaunayflip_error_ring(void);

  typedef enum
  {
    DELAUNAYFLIP_FLOAT32 = 0,
    DELAUNAYFLIP_FLOAT64 = 1,
    DELAUNAYFLIP_INT32 = 2,
    DELAUNAYFLIP_INT64 = 3
  } delaunayflip_type;

  typedef enum
  {
    DELAUNAYFLIP_HOST = 0,
    DELAUNAYFLIP_CUDA = 1 /**< The memory of a GPU, as CUDA allocates it. */
  } delaunayflip_memory;

  /** A place that labels the part of the mesh around it. Parts end at segments and at edges that
   * never flip. */
  typedef struct
  {
    double x;
    double y;
    int32_t label; /**< The label of all triangles of the part. */
    double maximum_area; /**< The largest area of a triangle there; 0: no limit of its own. */
  } delaunayflip_region;

  /** A triangle mesh. Any mesh is accepted: non-manifold, open, of mixed winding, with duplicate,
   * degenerate or unused parts. */
  typedef struct
  {
    int64_t size;
    const void* points; /**< x, y, z of every point: 3 * number_of_points numbers. */
    int64_t number_of_points;
    const void* triangles; /**< Three point ids per triangle: 3 * number_of_triangles integers. */
    int64_t number_of_triangles;
    int32_t point_type; /**< DELAUNAYFLIP_FLOAT32 or DELAUNAYFLIP_FLOAT64. [FLOAT64] */
    int32_t id_type; /**< DELAUNAYFLIP_INT32 or DELAUNAYFLIP_INT64, of the triangles. [INT64] */
    const int64_t* constraint_edges; /**< Edges that must stay: pairs of point ids, or null. */
    int64_t number_of_constraint_edges;
    const unsigned char* constraints_to_insert; /**< A flag per constraint edge, or null: where it
                                                   is not 0 and the mesh is planar, an edge that
                                                   the mesh does not have is made by flips. */
    const int32_t* regions; /**< A label per triangle, or null: edges between labels stay. */
    const unsigned char* frozen_triangles; /**< A flag per triangle, or null: where it is not 0, the
                                                triangle's edges stay. */
    const int64_t* triangle_numbers; /**< A number per triangle by which a report names it, or null:
                                        its index. E.g. the cell from which it was split. */
    int32_t memory; /**< A delaunayflip_memory: where points and triangles are. [HOST] */
    int32_t point_components; /**< 3, or with DELAUNAYFLIP_CUDA also 2: x and y; z is 0. [3] */
    void* stream; /**< With DELAUNAYFLIP_CUDA: a cudaStream_t; null is the default stream. */
    const double* sizes; /**< For refinement: the longest edge near each point, linear in between;
                            NaN: no limit near that point. Null: no limit. In the host's memory. */
    const delaunayflip_region* region_seeds; /**< Places in x and y that label parts of the mesh,
                                                and may limit the areas of triangles there; or null.
                                                Parts end at edges that never flip. If several
                                                places are in one part, the first one counts. Only
                                                for delaunayflip_open. */
    int64_t number_of_region_seeds;
  } delaunayflip_mesh;

  typedef enum
  {
    DELAUNAYFLIP_GEOMETRY_AUTO = 0, /**< Planar, else planar-xy for terrain, else surface. */
    DELAUNAYFLIP_GEOMETRY_PLANAR = 1, /**< In the plane of the points; an error if there is none. */
    DELAUNAYFLIP_GEOMETRY_PLANAR_XY = 2, /**< By x and y; z has no effect. */
    DELAUNAYFLIP_GEOMETRY_SURFACE = 3, /**< In space. */
    DELAUNAYFLIP_GEOMETRY_SPHERE = 4, /**< On a sphere around the origin, by the exact orientation
                                           of four points: towards the convex hull. */
    DELAUNAYFLIP_GEOMETRY_MIXED = 5 /**< For delaunayflip_summarize; no option. */
  } delaunayflip_geometry;

  typedef enum
  {
    DELAUNAYFLIP_IN_CIRCLE = 0, /**< The exact in-circle predicate; surfaces ignore it. */
    DELAUNAYFLIP_OPPOSITE_ANGLES = 1 /**< The sum of opposite angles above pi + tolerance. */
  } delaunayflip_criterion;

  typedef enum
  {
    DELAUNAYFLIP_KEEP_TIES = 0, /**< An edge of four points on one circle stays. */
    DELAUNAYFLIP_CANONICAL_TIES = 1 /**< The result does not depend on the input's triangles. */
  } delaunayflip_tie_rule;

  typedef enum
  {
    DELAUNAYFLIP_BACKEND_AUTO = 0, /**< A GPU for large meshes where there is one, else threads. */
    DELAUNAYFLIP_BACKEND_CUDA = 1,
    DELAUNAYFLIP_BACKEND_THREADS = 2
  } delaunayflip_backend;

  /** Defaults in brackets. FlipOptions.h describes each option in full. */
  typedef struct
  {
    int64_t size;
    int32_t geometry; /**< A delaunayflip_geometry. [AUTO] */
    int32_t criterion; /**< A delaunayflip_criterion. [IN_CIRCLE] */
    int32_t tie_rule; /**< A delaunayflip_tie_rule. [KEEP_TIES] */
    int32_t backend; /**< A delaunayflip_backend. [AUTO] */
    double tolerance; /**< Radians for OPPOSITE_ANGLES, 0 <= tolerance < 1; -1: automatic. [-1] */
    double feature_angle; /**< Degrees, 0 .. 180: sharper edges of surfaces stay. [30] */
    int64_t maximum_iterations; /**< -1: until done. [-1] */
    int32_t number_of_threads; /**< 0: as many as the machine has. [0] */
    int32_t device; /**< CUDA's number of the GPU; -1: the thread's current one. [-1] */
    int32_t track_quality; /**< Not 0: the smallest angle after every iteration, unless the mesh is
                              flipped in several pieces. [0] */
    int32_t number_of_pieces; /**< In how many pieces the mesh is flipped, one after the other, 1 to
                                 255; 0: as few as possible. Does not hold for device memory. [0] */
    const char* devices; /**< GPUs that share the mesh: CUDA's numbers, such as "0,1", or "all";
                            null or "": the one of device. [NULL] */
    double maximum_deviation; /**< An edge of a surface stays if its flip would move the surface by
                                 more than this length; 0 or more. [INFINITY] */
    /** This and the members below refine a mesh in the plane or of terrain, in a session only. For
     * points they are in delaunayflip_points. Points are added until no angle is smaller: 0 to 33
     * degrees. [0] */
    double minimum_angle;
    double maximum_area; /**< Points are added until no triangle is larger; 0: no limit. [0] */
    double maximum_edge; /**< Points are added until no edge is longer; 0: no limit. [0] */
    int32_t keep_boundary; /**< Not 0: no edge of the boundary is split. Angles there may stay
                              small, or become smaller. [0] */
    int64_t point_limit; /**< The most points that the mesh may have; 0: ten times as many as are
                            given, at least a million. [0] */
  } delaunayflip_options;

  typedef enum
  {
    DELAUNAYFLIP_NOT_STARTED = 0,
    DELAUNAYFLIP_CONVERGED = 1, /**< An iteration found no edge that may flip. */
    DELAUNAYFLIP_ITERATION_LIMIT = 2,
    DELAUNAYFLIP_ABORTED = 3, /**< A callback returned 0. */
    DELAUNAYFLIP_RUNNING = 4 /**< There is more to do. */
  } delaunayflip_stop_reason;

  /** What is wrong with the input, or was left out; delaunayflip_defect's text has it in words. */
  typedef enum
  {
    DELAUNAYFLIP_DEFECT_OTHER = 0,
    DELAUNAYFLIP_DEFECT_POINTS_NOT_FINITE = 1,
    DELAUNAYFLIP_DEFECT_REPEATED_IDS = 2,
    DELAUNAYFLIP_DEFECT_TRIANGLES_WITHOUT_AREA = 3,
    DELAUNAYFLIP_DEFECT_TURNED_FROM_MOST = 4,
    DELAUNAYFLIP_DEFECT_DUPLICATE_TRIANGLES = 5,
    DELAUNAYFLIP_DEFECT_TURNED_FROM_ABOVE = 6,
    DELAUNAYFLIP_DEFECT_FLAT_FROM_ABOVE = 7,
    DELAUNAYFLIP_DEFECT_OVERLAP_FROM_ABOVE = 8,
    DELAUNAYFLIP_DEFECT_TURNED_BY_FLIPS = 9,
    DELAUNAYFLIP_DEFECT_SEPARATE_TRIANGLES = 10,
    DELAUNAYFLIP_DEFECT_CONSTRAINTS_NOT_EDGES = 11,
    DELAUNAYFLIP_DEFECT_CONSTRAINTS_LEAVE_MESH = 12,
    DELAUNAYFLIP_DEFECT_CONSTRAINTS_LEAVE_PART = 13,
    DELAUNAYFLIP_DEFECT_CONSTRAINTS_CROSS = 14,
    DELAUNAYFLIP_DEFECT_CONSTRAINTS_MEET_OVERLAP = 15,
    DELAUNAYFLIP_DEFECT_CONSTRAINTS_NEED_GUARD = 16,
    DELAUNAYFLIP_DEFECT_CONSTRAINTS_ON_SURFACE = 17,
    DELAUNAYFLIP_DEFECT_POINTS_REPEATED = 18,
    DELAUNAYFLIP_DEFECT_POINTS_TOO_NEAR = 19,
    DELAUNAYFLIP_DEFECT_SEGMENTS_CROSS = 20,
    DELAUNAYFLIP_DEFECT_SEGMENTS_NOT_FINITE = 21,
    DELAUNAYFLIP_DEFECT_SEGMENTS_WITHOUT_TRIANGLES = 22,
    DELAUNAYFLIP_DEFECT_HOLE_SEEDS_OUTSIDE = 23,
    DELAUNAYFLIP_DEFECT_RINGS_WITHOUT_AREA = 24,
    DELAUNAYFLIP_DEFECT_RINGS_REPEATED = 25,
    DELAUNAYFLIP_DEFECT_RINGS_RUN_AGAIN = 26,
    DELAUNAYFLIP_DEFECT_HOLE_POINTS_OUTSIDE = 27,
    DELAUNAYFLIP_DEFECT_POINTS_WITHOUT_TRIANGLES = 28,
    DELAUNAYFLIP_DEFECT_NOTHING_LEFT = 29,
    DELAUNAYFLIP_DEFECT_POLYGONS_TOO_SMALL = 30,
    DELAUNAYFLIP_DEFECT_CONSTRAINTS_NOT_IN_MESH = 31,
    DELAUNAYFLIP_DEFECT_POINTS_WITHOUT_HEIGHTS = 32,
    DELAUNAYFLIP_DEFECT_REGION_SEEDS_OUTSIDE = 33,
    DELAUNAYFLIP_DEFECT_TRIANGLES_NOT_REFINED = 34,
    DELAUNAYFLIP_DEFECT_POINT_LIMIT_REACHED = 35,
    DELAUNAYFLIP_DEFECT_POINTS_INSIDE = 36, /**< On a sphere: inside of the convex hull. */
    DELAUNAYFLIP_DEFECT_POINTS_IN_ONE_PLANE = 37, /**< On a sphere: there is no hull. */
    DELAUNAYFLIP_DEFECT_SEGMENTS_INSIDE = 38, /**< On a sphere: an end is inside of the hull. */
    /** In the same part as an earlier one, with another label or area. */
    DELAUNAYFLIP_DEFECT_REGION_SEEDS_REPEATED = 39,
    /** keep_boundary or point_limit, where no goal asks for refinement. */
    DELAUNAYFLIP_DEFECT_OPTIONS_WITHOUT_GOAL = 40,
    /** maximum_iterations has ended the run before refinement. */
    DELAUNAYFLIP_DEFECT_TRIANGLES_NOT_JUDGED = 41,
    DELAUNAYFLIP_DEFECT_SEGMENTS_REMOVED = 42 /**< An end was removed. */
  } delaunayflip_defect_kind;

  /** A kind of defect: how often it occurs, and where first. */
  typedef struct
  {
    int32_t kind; /**< A delaunayflip_defect_kind. */
    int32_t number_of_ids; /**< How many first_ids has; 0 if ids would not help. */
    int64_t count; /**< How many. */
    /** The first triangles or points; of rings and region seeds their numbers; of constraints and
     * segments pairs of points. */
    const int64_t* first_ids;
    /** What such a pair crosses: three numbers each, that of the other segment or constraint, or -1
     * for another edge, and its two points. Null if the reason is another one. */
    const int64_t* crossed;
    const char* text; /**< All of it in words. */
  } delaunayflip_defect;

  /** One iteration. non_delaunay = flipped + excluded + blocked. */
  typedef struct
  {
    int64_t iteration; /**< 1, 2, ... */
    int64_t tested; /**< Edges tested. */
    int64_t non_delaunay; /**< Bad edges at its start; fixed edges never count. */
    int64_t flipped;
    int64_t excluded; /**< Not flipped because a neighbour was, or as it lies between chunks. */
    int64_t blocked; /**< Bad, but the flip would fold the mesh, move it too far or duplicate an
                        edge. */
    double minimum_angle; /**< Degrees, after the iteration; NaN where it was not computed. */
    double seconds;
  } delaunayflip_iteration;

  /** The report on a run. Strings are valid until the session's next call, or its end. */
  typedef struct
  {
    int64_t size;
    int32_t stop_reason; /**< A delaunayflip_stop_reason. */
    int32_t geometry_used; /**< A delaunayflip_geometry, never AUTO. */
    const char* geometry_reason; /**< Why that geometry was used. */
    const char* backend; /**< E.g. "Threads: 8" or "CUDA: NVIDIA H200". */
    const char* fallback; /**< Why the CPU replaced a GPU; "" if it did not. */
    const char* tolerance; /**< "automatic", the requested value, or "none". */
    const char* defects; /**< What was wrong with the mesh, in one sentence; "" if nothing. */
    int64_t number_of_iterations;
    int64_t total_flips;
    int64_t total_excluded;
    int64_t total_blocked;
    int64_t non_delaunay_before; /**< Bad edges of the input that are not fixed. */
    int64_t non_delaunay_after; /**< Bad edges left, flippable or blocked. */
    int64_t blocked_by_shape; /**< Bad edges left: their flip would fold the mesh over. */
    int64_t blocked_by_edge; /**< Bad edges left: their flip would repeat an edge. */
    int64_t edges;
    int64_t boundary_edges;
    int64_t non_manifold_edges;
    int64_t wrongly_wound_edges;
    int64_t feature_edges;
    int64_t constraint_edges;
    int64_t region_edges;
    int64_t fixed_edges; /**< Edges that never flip, for any reason. */
    int64_t unmatched_constraints; /**< Constraint edges that the mesh does not have. */
    int64_t inserted_constraints; /**< Constraint edges that flips made before the iterations. */
    int64_t constraint_flips; /**< Flips that inserted these edges; not in total_flips. */
    int64_t euler_characteristic; /**< Used points - edges + triangles; flips keep it. */
    /** Degrees; 0 with a degenerate triangle; NaN without triangles; before: NaN from points. */
    double minimum_angle_before;
    double minimum_angle_after;
    double build_seconds;
    double flip_seconds;
    int64_t points; /**< How many the caller has given. */
    int64_t triangles;
    /** For sessions from points: this and what follows up to large_triangles. */
    int64_t points_not_finite; /**< Points with NaN or infinite coordinates. */
    int64_t repeated_points; /**< Points at the place of one with a lower id. */
    int64_t points_too_near; /**< Points within the tolerance of one with a lower id. */
    int64_t segment_edges; /**< Edges that segments have become, each once; not removed ones. */
    int64_t refused_segments; /**< They cross earlier ones, or an end is not finite or removed. */
    int64_t crossings; /**< Points added where segments cross. */
    double largest_shift; /**< How far rounding has moved one of these at most. */
    int64_t outside_triangles; /**< Removed outside rings and around hole seeds. */
    int64_t large_triangles; /**< Removed by alpha and longest_edge, and from open spheres. */
    int64_t keeps_sliver; /**< 1 if feature edges or constraints keep one of the ten triangles with
                               the smallest angles, with one below 5 degrees; else 0. */
    int64_t blocked_by_deviation; /**< Bad edges left: the bound on deviation blocks them. */
    int64_t duplicate_triangles; /**< Triangles with the three points of an earlier one. */
    int64_t hidden_by_winding; /**< Edges that are wrongly wound and would else be bad. */
    /** Angles above 90 degrees opposite to non-manifold edges at first: bad edges may hide there.
     */
    int64_t obtuse_at_non_manifold;
    int64_t used_points; /**< For sessions from points: how many of them triangles have. */
    /** Triangles with an angle below so many degrees, or without area; before: 0 from points. */
    int64_t triangles_below_10_before;
    int64_t triangles_below_10_after;
    int64_t triangles_below_20_before;
    int64_t triangles_below_20_after;
    int64_t triangles_below_30_before;
    int64_t triangles_below_30_after;
    int64_t left_out_rings; /**< From points: they have no area, or the edges of an earlier one. */
    int64_t refinement_points; /**< Points added by refinement. */
    int64_t refinement_rounds; /**< How often it has added points. */
    int64_t unrefined_triangles; /**< With an angle below minimum_angle, or too large: they could
                                    not get better. */
    int64_t reached_point_limit; /**< 1 if point_limit has ended refinement. */
    int64_t removed_points; /**< Points that delaunayflip_remove_points has removed. */
    int64_t move_rounds; /**< The number of rounds of the last move, removal or insertion; 0 if
                            there was none, or if it triangulated the points anew. */
    int64_t points_inside; /**< On a sphere: points inside of the convex hull, not used. */
  } delaunayflip_report;

  /** Functions of the caller, or null. Each is called on the calling thread with `user` and returns
   * 0 to abort the run, which then ends with a valid mesh. They and `user` must live until the
   * function that they are passed to returns; a session does not keep them. */
  typedef struct
  {
    int64_t size;
    int32_t (*progress)(double share, void* user); /**< The share of the work done, 0 .. 1. */
    /** After each iteration. Rounds of refinement call progress alone. */
    int32_t (*iteration)(const delaunayflip_iteration* record, void* user);
    void* user;
  } delaunayflip_callbacks;

  /** Fill a struct of `size` bytes, at least 8, with its size and the defaults; all other members
   * with 0. A program may have a shorter or a longer struct than the library. */
  void delaunayflip_mesh_init_sized(delaunayflip_mesh* mesh, int64_t size);
  void delaunayflip_options_init_sized(delaunayflip_options* options, int64_t size);
  void delaunayflip_report_init_sized(delaunayflip_report* report, int64_t size);
  void delaunayflip_callbacks_init_sized(delaunayflip_callbacks* callbacks, int64_t size);

  /** A mesh that is being flipped. */
  typedef struct delaunayflip_session delaunayflip_session;

  /** Builds the edges of `mesh` and tests them all. `options` and `callbacks` may be null. A
   * mesh in DELAUNAYFLIP_CUDA is flipped on its GPU. It is copied to the host if the options
   * request threads, if the GPU fails, or for constraints_to_insert. If a progress callback returns
   * 0, the session is aborted and has the input's triangles. On success `*session` must be passed
   * to delaunayflip_close. */
  delaunayflip_status delaunayflip_open(const delaunayflip_mesh* mesh,
    const delaunayflip_options* options, const delaunayflip_callbacks* callbacks,
    delaunayflip_session** session);

  typedef enum
  {
    DELAUNAYFLIP_EVEN_ODD = 0, /**< A path to infinity crosses the rings an odd number of times. */
    DELAUNAYFLIP_NONZERO = 1, /**< The winding numbers of the rings do not add up to 0. */
    DELAUNAYFLIP_ORIENTATION = 2 /**< In the outline: they add up to more than 0 or, if no ring is
                                    counter-clockwise, to 0. In holes: as NONZERO. */
  } delaunayflip_ring_rule; /**< When a place is inside a set of rings. On a sphere the inside of a
                               ring is the smaller of its sides; with ORIENTATION, in the outline,
                               the one to its left. */

  typedef enum
  {
    DELAUNAYFLIP_PLANE = 0, /**< The plane of x and y. */
    DELAUNAYFLIP_SPHERE = 1, /**< The convex hull of points around the origin, by x, y and z:
                                point_components is 3. Segments run along great circles, the shorter
                                way. There are no regions or sizes. */
    DELAUNAYFLIP_OPEN_SPHERE = 2 /**< Like a sphere, but a triangle is left out if its circumcircle
                                    encloses half of the sphere or more. */
  } delaunayflip_projection; /**< The surface on which points are triangulated. */

  /** Points to triangulate, the segments between them, and how. PointTriangulation.h describes each
   * member in full. */
  typedef struct
  {
    int64_t size;
    const void* points; /**< point_components numbers per point: x, y and, without effect, z. */
    int64_t number_of_points;
    int32_t point_type; /**< DELAUNAYFLIP_FLOAT32 or DELAUNAYFLIP_FLOAT64. [FLOAT64] */
    int32_t point_components; /**< 2 or 3. [2] */
    const int64_t* segments; /**< Edges that the mesh must have: pairs of point ids, or null. */
    int64_t number_of_segments;
    const int32_t* rings; /**< For each segment the number of its ring, or -1; null: no rings.
                             Its segments may run in any direction. What is not inside the outline
                             or is inside the holes is removed; see ring_rule and first_hole. */
    const double* hole_seeds; /**< x, y of places, on a sphere x, y, z: what can be reached from
                                 there without crossing a segment is removed. */
    int64_t number_of_hole_seeds;
    double point_tolerance; /**< Points nearer than this to one with a lower id are not used. [0] */
    double alpha; /**< Triangles with a larger circumradius are removed; 0: none. [0] */
    double longest_edge; /**< Triangles with a longer edge are removed; 0: none. [0] */
    int32_t ring_rule; /**< A delaunayflip_ring_rule. [EVEN_ODD] */
    int32_t split_crossings; /**< Not 0: segments that cross are split there. 0: the later one is
                                refused. [0] */
    int32_t memory; /**< A delaunayflip_memory: where the points are. [HOST] */
    void* stream; /**< With DELAUNAYFLIP_CUDA: a cudaStream_t; null is the default stream. */
    int32_t first_hole; /**< Rings from this number on are holes, those before are the outline.
                           [INT32_MAX] */
    int64_t first_added; /**< Points from this number on belong to segments alone. The defects tell
                            if no others are left. [INT64_MAX] */
    double minimum_angle; /**< Points are added until no angle is smaller: 0 to 33 degrees. [0] */
    double maximum_area; /**< Points are added until no triangle is larger; 0: no limit. [0] */
    double maximum_edge; /**< Points are added until no edge is longer; 0: no limit. [0] */
    int32_t keep_boundary; /**< Not 0: no edge of the boundary is split. Angles there may stay
                              small, or become smaller. [0] */
    int64_t point_limit; /**< How many points may be corners of the mesh; 0: ten times as many as
                            are given, at least a million. [0] */
    const double* sizes; /**< The longest edge near each point, linear in between; NaN: no limit
                            near that point. Null: no limit. */
    const delaunayflip_region* regions; /**< If several are in one part, the first one counts,
                                           and a defect names the others. */
    int64_t number_of_regions;
    int32_t projection; /**< A delaunayflip_projection. [PLANE] */
    int32_t reserved; /**< 0. */
  } delaunayflip_points;

  void delaunayflip_points_init_sized(delaunayflip_points* points, int64_t size);

  /** Triangulates points in x and y: a session that begins with a valid triangulation of all
   * places, which delaunayflip_advance makes Delaunay; then it inserts the segments and removes
   * what is outside. Geometry, criterion and tie rule of the options are not used: the triangles
   * depend on the points alone, not on their order. They are counter-clockwise and have an area.
   * If several points are at one place, the one with the lowest id is used. Points with NaN or
   * infinite x or y are not used. When nothing is left to do, the report's triangles says
   * how many triangles to store; it is 0 if all places lie on one line. All arrays must stay as
   * long as the session.
   */
  delaunayflip_status delaunayflip_open_points(const delaunayflip_points* points,
    const delaunayflip_options* options, const delaunayflip_callbacks* callbacks,
    delaunayflip_session** session);

  /** Writes 3 * number_of_triangles integers, for each triangle the triangles across its edges:
   * number k is opposite vertex k, and -1 where there is none. For sessions from points. */
  delaunayflip_status delaunayflip_store_neighbors(
    delaunayflip_session* session, int32_t* neighbors);

  /** Writes number_of_points integers: for each point the id of the point that is used at its
   * place, or -1 if it is not finite. On a sphere it is also -1 for a point inside of the convex
   * hull, and for all points if there are no triangles. After an abort before there were triangles
   * each point has its own id. For sessions from points. */
  delaunayflip_status delaunayflip_store_used_points(delaunayflip_session* session, int64_t* ids);

  /** Writes the points that were made where segments cross, as many as the report's crossings, but
   * not those of refinement. For sessions from points. Each gets `xy`, two numbers; `ends`, two ids
   * of points, of which an added one is number_of_points plus its index; and `shares`: what belongs
   * to the point, such as z, is (1 - share) times that of the first end plus share times that of
   * the second. */
  delaunayflip_status delaunayflip_store_added_points(
    delaunayflip_session* session, double* xy, int64_t* ends, double* shares);

  /** Writes x, y and z of places on the unit sphere, as doubles. Multiples of 90 degrees give exact
   * zeros and ones. So longitudes that differ by 360 degrees give one place, and so do all
   * longitudes at a pole. If an angle is not finite, all three are NaN.
   * @param degrees longitude and latitude of each place. */
  delaunayflip_status delaunayflip_place_on_sphere(
    const double* degrees, int64_t number_of_places, double* xyz);

  /** Writes all points that were made: where segments cross, and then by refinement, as many as the
   * report's crossings and refinement_points. For sessions from points. Each gets `xy`, two
   * numbers; `ids`, three ids of points, numbered as above, of which the last one is -1 if there
   * are only two; `weights`, three numbers: what belongs to the point, such as z, is the sum of
   * those of these points, each times its weight; and `segments`, the number of the segment on
   * which refinement has put it, or -1. `segments` may be null. */
  delaunayflip_status delaunayflip_store_added_weights(
    delaunayflip_session* session, double* xy, int64_t* ids, double* weights, int64_t* segments);

  /** Writes the points that refinement has added to a mesh, as many as the report's
   * refinement_points. They are numbered after those of the mesh. For sessions from triangles.
   * @param xyz three coordinates of each.
   * @param ids three points of the mesh for each; the last one is -1 if there are only two.
   * @param weights three numbers for each. The data of the point are the sum of those of the three
   * points, each times its weight. */
  delaunayflip_status delaunayflip_store_refined_points(
    delaunayflip_session* session, double* xyz, int64_t* ids, double* weights);

  /** Writes, for each triangle, its source: the triangle before refinement that contains its
   * centroid. The triangle gets the data of its source. One number for each of
   * delaunayflip_count_triangles triangles. For sessions from triangles. */
  delaunayflip_status delaunayflip_store_sources(delaunayflip_session* session, int32_t* sources);

  /** Writes the label of the region that each triangle is in, and 0 where there is none: one for
   * each of delaunayflip_count_triangles triangles. Not for a mesh in several pieces. */
  delaunayflip_status delaunayflip_store_regions(delaunayflip_session* session, int32_t* labels);

  /** Writes the edges that segments have become, as pairs of point ids, in the order and direction
   * of the segments: 2 * segment_edges of the report. For sessions from points. */
  delaunayflip_status delaunayflip_store_segment_edges(
    delaunayflip_session* session, int64_t* pairs);

  /** Writes the number of the segment of each of these edges; of several, the first one. */
  delaunayflip_status delaunayflip_store_segments_of_edges(
    delaunayflip_session* session, int64_t* numbers);

  /** Inserts more points into the triangulation, numbered after the others of the caller; those at
   * crossings come after them. The triangles are then those of all points, perhaps in another order
   * than if all had been given at once. Up to one in 32 of the points at a time are inserted in
   * place where a motion would keep the mesh, if all are in triangles that are kept, and none is on
   * a segment: only the triangles around them change. Otherwise the triangulation is made anew. For
   * sessions from points, after
   * delaunayflip_advance. Many points at a time, such as 10,000, take less time than one by one.
   * This inserts one point:
   *
   *     const double place[] = { 0.5, 0.25 };
   *     delaunayflip_points more;
   *     delaunayflip_points_init(&more);
   *     more.points = place;
   *     more.number_of_points = 1;
   *     delaunayflip_insert_points(session, &more, NULL);
   *
   * @param points in the host's memory; they are copied, in the precision of the others. Members
   * that do not say where they are and how many have no effect.
   * @param callbacks may be null. If `progress` returns 0, the call fails with
   * DELAUNAYFLIP_STOPPED, and the next delaunayflip_advance begins with all points. */
  delaunayflip_status delaunayflip_insert_points(delaunayflip_session* session,
    const delaunayflip_points* points, const delaunayflip_callbacks* callbacks);

  /** Moves points. The triangles are then those of a triangulation of the points where they are
   * now, perhaps in another order; there may be more or fewer than before. If there are no goals,
   * point_tolerance is 0, no two points meet at one place or part, and none goes through a segment,
   * the mesh follows the points by flips, unless many triangles would turn over, or flips take
   * longer than a triangulation, as along curves. Segments, outlines and holes move with their
   * points. Otherwise the triangulation is made anew. Call it after delaunayflip_advance.
   * The mesh of a session from triangles stays as it is, and delaunayflip_advance goes on with it;
   * edges that were fixed stay. That is for the CPU, and for x, y and z of all points in the host's
   * memory. It fails with DELAUNAYFLIP_INVALID_OPTIONS, and nothing changes, on a GPU, after
   * refinement, with region seeds, if points are not finite, or if automatic geometry would be
   * another one.
   * A frame of moving points:
   *
   *     delaunayflip_points places;
   *     delaunayflip_points_init(&places);
   *     places.points = xy;
   *     places.number_of_points = count;
   *     delaunayflip_move_points(session, &places, NULL, NULL);
   *     triangles = delaunayflip_count_triangles(session);
   *
   * @param places of all points of the caller, or of those in `ids`. Places in the host's memory
   * are copied, in the precision of the points. Places on a GPU must have that precision and stay
   * unchanged until the next move, and `ids` must be null. Only the members that say where the
   * places are, and how many, have an effect.
   * @param ids of the points that move, in the host's memory; null: all.
   * @param callbacks may be null. If `progress` returns 0, the call fails with
   * DELAUNAYFLIP_STOPPED, and all points are where they were. */
  delaunayflip_status delaunayflip_move_points(delaunayflip_session* session,
    const delaunayflip_points* places, const int64_t* ids, const delaunayflip_callbacks* callbacks);

  /** Removes points. The others keep their numbers. A removed point is no longer used, as if it
   * were not finite, and later moves do not bring it back. For sessions from points, after
   * delaunayflip_advance. `callbacks` as above. */
  delaunayflip_status delaunayflip_remove_points(delaunayflip_session* session, const int64_t* ids,
    int64_t number_of_ids, const delaunayflip_callbacks* callbacks);

  /** Numbers the points anew, without the removed ones and in the same order. For sessions from
   * points without segments or sizes, after delaunayflip_advance. `callbacks` as above. */
  delaunayflip_status delaunayflip_compact_points(
    delaunayflip_session* session, const delaunayflip_callbacks* callbacks);

  /** Returns the number of triangles, which takes less time than a report. */
  int64_t delaunayflip_count_triangles(const delaunayflip_session* session);

  typedef enum
  {
    DELAUNAYFLIP_LINEAR = 0, /**< Linear in each triangle. */
    DELAUNAYFLIP_NATURAL = 1 /**< Sibson's natural neighbours: smooth except at the points. */
  } delaunayflip_method; /**< How values between points are found. */

  typedef enum
  {
    DELAUNAYFLIP_OUTSIDE_NAN = 0,
    DELAUNAYFLIP_OUTSIDE_NEAREST = 1 /**< The value at the nearest place on the boundary. */
  } delaunayflip_outside; /**< What a place has that is in no triangle. */

  /** Places in x and y, given one by one or as the centres of the cells of a raster, and what is
   * wanted there. On a sphere they are directions: x, y and z, or with `degrees` longitudes and
   * latitudes; those of a raster are longitudes and latitudes in degrees. Interpolation.h describes
   * each member in full. */
  typedef struct
  {
    int64_t size;
    const void* places; /**< place_components numbers per place: x, y and, without effect except
                           on a sphere, z. */
    int64_t number_of_places;
    int32_t place_type; /**< DELAUNAYFLIP_FLOAT32 or DELAUNAYFLIP_FLOAT64. [FLOAT64] */
    int32_t place_components; /**< At least 2. [2] */
    int64_t columns; /**< How many cells the raster has along x; cells replace the places. */
    int64_t rows; /**< Along y. The cells are numbered row by row. */
    double origin_x; /**< The centre of the first cell. */
    double origin_y;
    double step_x; /**< From one cell to the next; may be negative. [1] */
    double step_y; /**< [1] */
    int32_t* triangles; /**< Receives the triangle of each place, the lowest number if there are
                           several, or -1 outside; null: not wanted. */
    const double* values; /**< value_components numbers for each point, and after them for each
                             added one; null: only the triangles are wanted. */
    double* results; /**< Receives value_components numbers for each place. */
    int32_t value_components; /**< [1] */
    int32_t method; /**< A delaunayflip_method. [LINEAR] */
    int32_t outside; /**< A delaunayflip_outside. [OUTSIDE_NAN] */
    int32_t memory; /**< A delaunayflip_memory: where all four arrays are. [HOST] */
    void* stream; /**< With DELAUNAYFLIP_CUDA: a cudaStream_t; null is the default stream. */
    int32_t degrees; /**< Boolean: places on a sphere are longitudes and latitudes in degrees. */
    int32_t reserved; /**< 0. */
  } delaunayflip_query;

  void delaunayflip_query_init_sized(delaunayflip_query* query, int64_t size);

  /** Answers in which triangles places are, and what values they have between those of the points.
   * For sessions from points, after delaunayflip_advance. With heights for the points, one each,
   * these are the heights of a raster of 100 by 50 cells:
   *
   *     delaunayflip_query query;
   *     delaunayflip_query_init(&query);
   *     query.columns = 100;
   *     query.rows = 50;
   *     query.values = heights;
   *     query.results = raster;
   *     delaunayflip_ask(session, &query, NULL);
   *
   * Triangles that an outline, holes or options have removed are outside. Natural neighbours need a
   * session that has nothing left to flip. `callbacks` may be null. If `progress` returns 0, the
   * call fails with DELAUNAYFLIP_STOPPED, and some results are written. */
  delaunayflip_status delaunayflip_ask(delaunayflip_session* session,
    const delaunayflip_query* query, const delaunayflip_callbacks* callbacks);

  /** Runs at most `iterations` more iterations; -1: until nothing is left to flip or a limit is
   * reached.
   * `*is_running` (may be null) becomes 1 if there is more to do, else 0. `callbacks` may be null.
   */
  delaunayflip_status delaunayflip_advance(delaunayflip_session* session, int64_t iterations,
    const delaunayflip_callbacks* callbacks, int32_t* is_running);

  /** Announces memory of the host that a store function will write after the next
   * delaunayflip_advance, such as a new array for the result. Its contents are lost, and it must
   * stay until that call returns. While a GPU flips, CPU threads touch its pages, which the system
   * takes longer to provide than the result takes to be stored. */
  delaunayflip_status delaunayflip_expect(
    delaunayflip_session* session, void* memory, int64_t bytes);

  /** Fills `report`. Its size must be set (delaunayflip_report_init). */
  delaunayflip_status delaunayflip_get_report(
    delaunayflip_session* session, delaunayflip_report* report);

  /** What was done, in lines of a title, ": " and a text; "" without triangles. `report` may be a
   * sum over several meshes. `*text` is valid until this thread's next call. */
  delaunayflip_status delaunayflip_summarize(const delaunayflip_report* report, const char** text);

  /** Copies the records of iterations first + 1 .. first + count to `records`, which has room for
   * `count` of them, each of `record_size` bytes: sizeof(delaunayflip_iteration). `first` + `count`
   * must not exceed the report's number_of_iterations. */
  delaunayflip_status delaunayflip_get_iterations(delaunayflip_session* session, int64_t first,
    int64_t count, delaunayflip_iteration* records, int64_t record_size);

  /** How many kinds of defects the last delaunayflip_get_report has found. */
  int64_t delaunayflip_count_defects(const delaunayflip_session* session);

  /** Copies those defects, from `first` on, to `defects`, which has room for `count` of them, each
   * of `defect_size` bytes: sizeof(delaunayflip_defect). `first` + `count` must not exceed
   * delaunayflip_count_defects. Pointers are valid as long as the report's strings. */
  delaunayflip_status delaunayflip_get_defects(delaunayflip_session* session, int64_t first,
    int64_t count, delaunayflip_defect* defects, int64_t defect_size);

  /** Writes the triangles in their input slots: 3 * number_of_triangles integers of `id_type`
   * (DELAUNAYFLIP_INT32 or DELAUNAYFLIP_INT64). A triangle that no flip touched keeps its three ids
   * in their order. If the session has nothing left to do, `triangles` may be the mesh's own array.
   */
  delaunayflip_status delaunayflip_store_triangles(
    delaunayflip_session* session, void* triangles, int32_t id_type);

  /** Does the same in an order that depends on the triangles alone, for sessions from points in the
   * plane. Each triangle begins with its lowest id, and they are sorted by their first and then by
   * their second id. So points that have moved to some places give the same integers as points that
   * were triangulated there. The other functions use the numbers of delaunayflip_store_triangles.
   */
  delaunayflip_status delaunayflip_store_ordered_triangles(
    delaunayflip_session* session, void* triangles, int32_t id_type);

  /** Writes, for every triangle slot, how many flips it was part of: number_of_triangles integers.
   */
  delaunayflip_status delaunayflip_store_flip_counts(
    delaunayflip_session* session, int32_t* counts);

  /** Both do the same for arrays in the memory of a GPU, from any session. If the session runs on
   * this GPU, nothing is copied through the host. `stream` is a cudaStream_t; null is the default
   * stream. */
  delaunayflip_status delaunayflip_store_triangles_on_device(
    delaunayflip_session* session, void* triangles, int32_t id_type, void* stream);
  delaunayflip_status delaunayflip_store_flip_counts_on_device(
    delaunayflip_session* session, int32_t* counts, void* stream);
  delaunayflip_status delaunayflip_store_neighbors_on_device(
    delaunayflip_session* session, int32_t* neighbors, void* stream);

  /** Ends a session; null is allowed. */
  void delaunayflip_close(delaunayflip_session* session);

  /** The whole run in one call: flips `mesh` and writes the result to `triangles` (integers of the
   * mesh's id_type, in the mesh's memory), which may be the very array of the mesh. `report` may be
   * null; its strings are valid until this thread's next call of this function. */
  delaunayflip_status delaunayflip_flip(const delaunayflip_mesh* mesh,
    const delaunayflip_options* options, const delaunayflip_callbacks* callbacks, void* triangles,
    delaunayflip_report* report);

  /** The smallest angle of each triangle in degrees, in space or (PLANAR_XY) by x and y, to
   * `angles`: number_of_triangles numbers. NaN where a coordinate is not finite. */
  delaunayflip_status delaunayflip_triangle_angles(
    const delaunayflip_mesh* mesh, int32_t geometry, double* angles);

  /** The unit normal of each triangle by the right-hand rule, to `normals`: 3 * number_of_triangles
   * numbers; 0, 0, 0 for a triangle without area. */
  delaunayflip_status delaunayflip_triangle_normals(const delaunayflip_mesh* mesh, double* normals);

  /** Polygon i has the corners corners[offsets[i]] .. corners[offsets[i + 1] - 1], ids of points.
   */
  typedef struct
  {
    int64_t size;
    int64_t number_of_polygons;
    const int64_t* offsets; /**< number_of_polygons + 1 integers. */
    const int64_t* corners;
    /** Receives number_of_polygons integers: how many triangles each polygon gives. May be null if
     * no polygon of more than three corners names a point twice in a row, or only two points. */
    int64_t* triangle_counts;
  } delaunayflip_polygons;

  void delaunayflip_polygons_init_sized(delaunayflip_polygons* polygons, int64_t size);

  /** Splits polygons over the points of `mesh` into triangles that keep their winding. The other
   * members of `mesh` have no effect. If there are more than three corners, those that repeat the
   * one before them are dropped first, and the last ones if they repeat the first. A polygon of n
   * corners gives n - 2 triangles, or none if fewer than three differ. Their point ids, three each,
   * are written to `triangles` in the order of the polygons. There must be room for as many as if
   * no corner were dropped. A quad is divided along its first diagonal, unless that runs outside
   * it. A larger polygon becomes a fan if it is convex, else its ears are clipped. `callbacks` may
   * be null. If `progress` returns 0 the call fails with DELAUNAYFLIP_STOPPED. */
  delaunayflip_status delaunayflip_split_polygons(const delaunayflip_mesh* mesh,
    const delaunayflip_polygons* polygons, const delaunayflip_callbacks* callbacks,
    int64_t* triangles);

  /** 1 where there is a GPU that this library can use, else 0. */
  int32_t delaunayflip_has_cuda_device(void);

  /** Frees the memory that the CUDA backend keeps between runs. */
  void delaunayflip_release_cuda_memory(void);

  /* The library has functions of these names, too, for programs compiled with the header of 0.2.0,
   * where they were not inline. They fill the structs of that release. */
#ifndef DELAUNAYFLIP_BUILDS_C_LIBRARY
  /** Fill a struct of this header with its size and the defaults; all other members with 0. */
  static inline void delaunayflip_mesh_init(delaunayflip_mesh* mesh)
  {
    delaunayflip_mesh_init_sized(mesh, sizeof(*mesh));
  }
  static inline void delaunayflip_options_init(delaunayflip_options* options)
  {
    delaunayflip_options_init_sized(options, sizeof(*options));
  }
  static inline void delaunayflip_report_init(delaunayflip_report* report)
  {
    delaunayflip_report_init_sized(report, sizeof(*report));
  }
  static inline void delaunayflip_callbacks_init(delaunayflip_callbacks* callbacks)
  {
    delaunayflip_callbacks_init_sized(callbacks, sizeof(*callbacks));
  }
  static inline void delaunayflip_points_init(delaunayflip_points* points)
  {
    delaunayflip_points_init_sized(points, sizeof(*points));
  }
  static inline void delaunayflip_query_init(delaunayflip_query* query)
  {
    delaunayflip_query_init_sized(query, sizeof(*query));
  }
  static inline void delaunayflip_polygons_init(delaunayflip_polygons* polygons)
  {
    delaunayflip_polygons_init_sized(polygons, sizeof(*polygons));
  }
#endif

#ifdef __cplusplus
}
#endif

#endif

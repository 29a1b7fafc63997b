// SPDX-License-Identifier: LGPL-2.1-or-later
// The driver: from a caller's surface to verified conforming tetrahedra (DESIGN 2).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tetra/assemble/compact.h"
#include "tetra/assemble/restore.h"
#include "tetra/assemble/tet_quality.h"
#include "tetra/assemble/verify_mesh.h"
#include "tetra/fence/fence_off.h"
#include "tetra/fence/pull_off.h"
#include "tetra/solid/snap.h"

namespace tetra {

// chazelle_palios: pull-off and fences; bajaj_dey: the convex cells of notch cutting, overlaid.
enum class TetMethod { chazelle_palios, bajaj_dey };

// automatic: PULLOFF A1 by estimates (decisions/0009); on: the paper's; off: none.
enum class PullPolicy { automatic, on, off };

// `direction`, `candidates` and `pull_off` are of chazelle_palios only.
struct TetOptions {
    TetMethod method = TetMethod::chazelle_palios;
    std::optional<Vec3d> direction;  // of the fences; none = rate the axes and the candidates
    std::vector<Vec3d> candidates;   // e.g. normals of planar faces, axes of cylinders
    PullPolicy pull_off = PullPolicy::automatic;
    CompactOptions compact;
    int grid_bits = 0;     // 0 = the coarsest of 20..26 that keeps all vertices apart
    bool quality = false;  // flips that raise the worst shapes in the end
};

// The caller's surface: closed, outward, not crossing itself (solid/validate.h). `solid` and
// `face` have one id per triangle or are empty; coplanar neighbours of different faces keep their
// common edge. Ids in the result are those of these arrays.
struct TetInput {
    std::vector<Vec3d> vertices;
    std::vector<Triangle> triangles;
    std::vector<int> solid;
    std::vector<int> face;
};

struct DirectionTrial {
    std::string name;
    double cost = -1;  // counted walls; -1 = not rated
    std::string note;
};

// What notch cutting and the overlay of its cells did.
struct CellTetCounts {
    int notches = 0;
    int planes = 0;  // that cover the notches
    int cuts = 0;
    int raw_cells = 0;  // before merging
    int cells = 0;
    int pieces = 0;      // common parts of two facets, one from each side of a plane
    int cone_cells = 0;  // cells that needed a point of their own
};

// What was done with one solid, and with how much luck.
struct SolidReport {
    int solid = 0;
    int grid_bits = 0;
    std::string direction;
    std::vector<DirectionTrial> directions;
    std::string pulled;                                           // "none", "crossings" or "all"
    std::vector<std::pair<std::string, std::int64_t>> crossings;  // per state of pulling
    PullStatistics pull;
    int cup_tets = 0;  // before the fences divide their domes
    FenceCounts fences;
    CellTetCounts cells;  // of bajaj_dey
    CompactStats compact;
    RestoreStats restore;
    MeshCheck check;
    std::vector<std::string> repairs;  // attempts that failed, and why
};

struct TetReport {
    std::vector<std::pair<std::string, double>> seconds;  // per stage, in order
    std::vector<int> rejected_grids;
    SnapReport snap;
    std::vector<SolidReport> solids;
    TetQuality quality;
    int shared_points = 0;   // nodes that solids have in common
    int contact_points = 0;  // put into finished meshes, where a later solid needed them
};

// tets have det(b-a, c-a, d-a) > 0 in doubles; skin triangles face outward.
struct TetResult {
    std::vector<Vec3d> points;
    std::vector<int> point_source;  // the caller's vertex or -1
    std::vector<std::array<int, 4>> tets;
    std::vector<int> tet_solid;
    std::vector<Triangle> skin;
    std::vector<int> skin_source;  // a caller's triangle of the same plane and face
    std::vector<int> skin_twin;    // where two solids touch: the other's skin triangle, else -1
    TetReport report;
};

// Snap, pull-off, fence-off, emission, compaction, restoring and the kernel's own check, for each
// solid; solids then share nodes at equal places. On failure other directions, no pull-off, other
// grids and no compaction are tried, in this order. Where two solids touch in a plane, both sides
// get the same triangles (imprint_contacts.h): each is in the skin twice, once for each solid. A
// solid that can't keep those of its neighbours is meshed before them.
//
// \throw InvalidSolid when the surface can't be put on a grid; VerificationFailed when every
//        attempt failed; Cancelled.
TetResult tetrahedralize(const TetInput& input, const TetOptions& options, Progress& progress);

}  // namespace tetra

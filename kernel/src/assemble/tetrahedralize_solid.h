// SPDX-License-Identifier: LGPL-2.1-or-later
// One solid on one grid: direction, pull-off, fences, compaction, restoring and check.
#pragma once

#include <chrono>

#include "tetra/assemble/tetrahedralize.h"
#include "tetra/fence/directions.h"

namespace tetra {

// Seconds per stage, in order of first use.
class StageClock {
  public:
    // Adds the time until the scope is left to `stage`.
    class Scope {
      public:
        Scope(StageClock& clock, const char* stage);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        StageClock& clock_;
        const char* stage_;
        std::chrono::steady_clock::time_point start_;
    };

    std::vector<std::pair<std::string, double>> seconds;
};

std::vector<Vec3i> to_frame(const FenceDirection& frame, const std::vector<Vec3i>& points);
HPoint from_frame(const FenceDirection& frame, const HPoint& point);

// Directions worth trying on this grid, best first; `trials` tells how they were rated, and
// `counted_to` (DirectionOptions) how closely those behind the best are.
std::vector<FenceDirection> choose_frames(const GridSolid& solid, const std::vector<int>& owners,
                                          const TetOptions& options, double counted_to,
                                          std::vector<DirectionTrial>& trials, Progress& progress);

// The state of pulling that A1 prefers in a frame, or what the policy demands. `everything` is the
// pull-off of all favourable vertices when it is known already.
PullOff choose_pull(const std::vector<Vec3i>& framed, const GridSolid& solid,
                    const std::vector<int>& owners, PullPolicy policy, const PullOff* everything,
                    SolidReport& report, Progress& progress);

// Nothing pulled.
PullOff untouched(const GridSolid& solid, const std::vector<int>& owners);

// Lets each skin triangle name the triangle of its facet under its middle. `owners` as in
// facet_owners(); facets and planes stay what they are.
void locate_sources(ExactMesh& mesh, const GridSolid& solid, const std::vector<int>& owners);

struct SolidInput {
    const TetInput& caller;
    const GridSolid& grid;          // triangles of this solid only
    const std::vector<int>& faces;  // per triangle of `grid`, or empty
    int solid = 0;
};

struct SolidTets {
    ExactMesh mesh;  // skin_source: triangles of the grid solid
    std::vector<Vec3d> points;
    std::vector<int> point_source;  // the caller's vertices
    SolidReport report;
};

// Tries frames and policies until one passes verify_mesh; throws what the last attempt threw.
SolidTets tetrahedralize_solid(const SolidInput& input, const TetOptions& options,
                               StageClock& clock, Progress& progress);

}  // namespace tetra

// SPDX-License-Identifier: LGPL-2.1-or-later
// Walls of cells along the lines of the plan: what the sweep of rules R2 to R6 finds.
#pragma once

#include <cstdint>
#include <limits>

#include "plan.h"

namespace tetra::fence {

// The wall of the cell (floor, ceiling) along one side of a line, between two plan points.
struct Run {
    int line = -1;
    bool left = false;  // the cell is left of the line
    int floor = -1, ceiling = -1;
};

// A run passes a plan point that is an event of its line. Its chain lists the sharp edges strictly
// between floor and ceiling from here to the run's next point, bottom up.
struct WallPoint {
    int run = -1, point = -1;
    int chain = -1;       // -1 at the end of the run
    bool active = false;  // rule R6: the run starts or ends here, or its chain changes
};

struct Walls {
    std::vector<Run> runs;
    std::vector<WallPoint> points;  // of run 0 along its line, of run 1, ...
    Lists run_points;               // items are 0, 1, 2, ...
    Lists chains;                   // of sharp edges; chain 0 is empty
    // Sharp edges through plan points, repeated ones included: what carries a mark.
    std::vector<int> edge_at, edge_at_point;
    std::int64_t sides = 0;  // of all walls, between neighbouring active points of their runs
};

struct WallSample {
    int stride = 1;  // every so manieth line is swept
    std::int64_t enough = std::numeric_limits<std::int64_t>::max();  // sides that end the sweep
};

Walls sweep_walls(Plan& plan, Progress& progress, const WallSample& sample = {});

}  // namespace tetra::fence

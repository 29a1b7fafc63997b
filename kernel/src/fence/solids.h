// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs a stage for each solid of an input apart, and translates triangle ids in its errors.
#pragma once

#include <algorithm>

#include "plan.h"
#include "tetra/errors.h"

namespace tetra::fence {

// One solid of a FenceInput; `triangles` are its triangles' ids in the whole.
struct SolidPart {
    FenceInput input;
    std::vector<int> triangles;
    int solid = 0;
};

// Calls run(part) in ascending order of solid ids.
template <class Run>
void for_each_solid(const FenceInput& input, Run run) {
    std::vector<int> solids = input.solid;
    if (solids.empty()) solids.assign(input.triangles.size(), 0);
    std::vector<int> ids = solids;
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    for (const int id : ids) {
        SolidPart part{{}, {}, id};
        part.input.points = input.points;
        part.input.keep = input.keep;
        for (int t = 0; t < static_cast<int>(solids.size()); ++t) {
            if (at(solids, t) != id) continue;
            part.triangles.push_back(t);
            part.input.triangles.push_back(at(input.triangles, t));
            if (!input.owner.empty()) part.input.owner.push_back(at(input.owner, t));
        }
        try {
            run(part);
        } catch (const InvalidSolid& error) {
            std::vector<Defect> defects = error.defects;
            for (Defect& d : defects)
                for (int& t : d.triangles) t = at(part.triangles, t);
            throw InvalidSolid(std::move(defects));
        }
    }
}

}  // namespace tetra::fence

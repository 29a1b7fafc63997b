// SPDX-License-Identifier: LGPL-2.1-or-later
// The edges of a region prepared for a sweep: points by rank, edges sorted around each point.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tetra/polygon/region.h"

namespace tetra {

/// An edge between ranks left < right. A floor has the region above it, a ceiling below it.
///
/// The lexicographic order is that of x after an infinitesimal shear x + eps y. Orientation does
/// not change under the shear, so no edge is vertical and "above" is the left of left -> right.
struct SweepEdge {
    int left = 0;
    int right = 0;
    bool floor = false;
};

/// Edges keep the positions of the input. The edges at a point come from the lowest to the highest.
struct SweepGraph {
    std::vector<PointId> ids;  ///< point of each rank
    std::vector<SweepEdge> edges;
    std::vector<int> ending_begin;  ///< per rank, into ending
    std::vector<int> ending;        ///< edges that have the point as right end
    std::vector<int> starting_begin;
    std::vector<int> starting;

    std::span<const int> ending_at(int rank) const {
        return std::span(ending).subspan(ending_begin[rank],
                                         ending_begin[rank + 1] - ending_begin[rank]);
    }
    std::span<const int> starting_at(int rank) const {
        return std::span(starting).subspan(starting_begin[rank],
                                           starting_begin[rank + 1] - starting_begin[rank]);
    }
};

/// Whether an edge may occur in both directions.
enum class Slits { allowed, forbidden };

/// \throw InvalidRegion for edges of no length, coinciding points and edges that overlap at an end.
SweepGraph make_sweep_graph(std::span<const DirectedEdge> edges,
                            std::span<const PointId> inner_points, const PointOracle& oracle,
                            Slits slits);

}  // namespace tetra

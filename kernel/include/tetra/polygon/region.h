// SPDX-License-Identifier: LGPL-2.1-or-later
// A planar region as a soup of directed edges between abstract points known to an exact oracle.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tetra {

/// Id of a point in the caller's numbering; ids need not be dense.
using PointId = std::int32_t;

/// Three point ids in counter-clockwise order.
using PlanarTriangle = std::array<PointId, 3>;

/// A boundary edge; the region lies on its left.
struct DirectedEdge {
    PointId from = 0;
    PointId to = 0;

    friend bool operator==(const DirectedEdge&, const DirectedEdge&) = default;
};

/// The only source of geometry: two exact predicates on points.
///
/// \pre distinct ids are distinct points; both predicates are exact and consistent.
class PointOracle {
  public:
    PointOracle() = default;
    PointOracle(const PointOracle&) = default;
    PointOracle& operator=(const PointOracle&) = default;
    virtual ~PointOracle() = default;

    /// Lexicographic order of i and j, by x and then by y: -1, 0 or +1.
    virtual int compare(PointId i, PointId j) const = 0;

    /// Sign of the area of (i, j, k): +1 for a left turn, 0 for collinear points.
    virtual int orient(PointId i, PointId j, PointId k) const = 0;
};

/// The edges do not bound a region.
class InvalidRegion : public std::invalid_argument {
  public:
    InvalidRegion(const std::string& what, std::vector<int> edges, std::vector<PointId> points)
        : std::invalid_argument(what),
          edges_at_fault(std::move(edges)),
          points_at_fault(std::move(points)) {}

    std::vector<int> edges_at_fault;       ///< positions in the list of edges that was given
    std::vector<PointId> points_at_fault;  ///< ids of the points
};

/// Directs the edges of closed loops so that the region of odd winding parity lies on their left.
///
/// The direction in which a loop comes does not matter, nor which one is called a hole: a loop
/// inside one other loop bounds a hole, inside two an island. Loops may touch in vertices.
/// Edge k of the answer is edge k of the loops, counted through all of them in order.
/// Plane sweep after Shamos and Hoey, O(n log n) calls of the oracle.
///
/// \throw InvalidRegion when a loop is shorter than three, when two points coincide, or when two
///        edges have more in common than an end.
std::vector<DirectedEdge> region_of_loops(std::span<const std::vector<PointId>> loops,
                                          const PointOracle& oracle);

}  // namespace tetra

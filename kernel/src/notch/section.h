// SPDX-License-Identifier: LGPL-2.1-or-later
// The section of a piece by a plane: the boundary of the cut polygons Q, traced by local tests.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "half_edges.h"

namespace tetra::notch {

// A set of half-edges that bounds one or more solids, closed under twin and next.
struct Piece {
    std::vector<int> edges;
    // Known to be one surface none of whose facets has a hole.
    bool simple = false;
};

// Incidence and arithmetic contradict each other (plane classes only, NOTCHES 4). Found before
// any surgery. `planes` are the classes that may be at fault.
struct Inconsistent {
    const char* reason;
    std::vector<int> planes;
};

// Where a chord ends in its facet: at a corner (the half-edge leaving it), on a crossing
// half-edge of that facet, or at a vertex that only touches the facet (half_edge = -1).
struct ChordEnd {
    int point = -1;
    int half_edge = -1;
    bool crossing = false;
};

// A directed piece of the boundary of Q, with Q on its left seen against the plane's normal.
struct Segment {
    ChordEnd from, to;
    int half_edge = -1;  // the edge on the plane it runs along; -1 for a chord
    int key = -1;        // chord: the facet it crosses
    int line = -1;
    bool facets_above = false;  // across edges: both facets above the plane, else both below
    int mate = -1;              // the segment of the twin when Q is on both sides
    int next = -1;
    int cycle = -1;
    bool no_width = false;  // its cycle runs to and fro on one line
    Direction direction{};
};

struct Section {
    int plane = -1;
    std::vector<Segment> segments;
    std::vector<char> used;  // per segment: bounds a component that is to be cut
    // Components are discs whose boundary stays on one surface: no hole, no edge across, some
    // width, and no point where the boundary passes twice.
    bool simple = false;
};

// Which components of the section are cut.
enum class Extent { notch_components, own_notches, whole_plane };

// Scratch space that lives through a run.
struct Workspace {
    double reach = 16;  // grid steps by which vertices may miss their planes
    std::vector<int> side_stamp;
    std::vector<signed char> side;
    std::vector<int> slot_stamp, slot;     // per key
    std::vector<int> label_stamp, label;   // per half-edge: the surface it is on
    std::vector<int> cycle_stamp;          // per half-edge
    std::vector<int> plane_count;          // zero between uses
    std::vector<int> notch_edges, planes;  // of the piece at hand
    int stamp = 0;
};

// Traces plane n piece. Splits edges on the plane at contacts (NOTCHES 3.5), appending the new
// half-edges to the piece; leaves all else untouched. `own` tells which notches count for
// Extent::own_notches. Throws Inconsistent.
Section trace_section(PointTable& points, HalfEdges& edges, Piece& piece, int plane, Extent extent,
                      const std::vector<char>& own, Workspace& work);

}  // namespace tetra::notch

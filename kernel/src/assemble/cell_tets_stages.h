// SPDX-License-Identifier: LGPL-2.1-or-later
// The stages from convex cells to tetrahedra, and what each hands to the next.
#pragma once

#include <array>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "../notch/half_edges.h"
#include "cell_tets.h"
#include "tetra/solid/box_tree.h"

namespace tetra::cells {

using notch::key_sign;
using notch::opposite_key;
using notch::plane_of;
using notch::PointTable;

// Convex; edge i runs from corners[i] to the next corner and lies on the plane of the key
// beyond[i], whose outward normal points away from the polygon.
struct Polygon {
    std::vector<int> corners, beyond;
};

// Counter-clockwise seen from outside its cell, on the plane of its key.
struct Facet {
    int cell, key;
    Polygon polygon;
};

struct Complex {
    explicit Complex(int grid_bits) : points(grid_bits) {}
    PointTable points;  // those of the solid first
    std::vector<Facet> facets;
    std::vector<int> first_facet{0};  // per cell, and the end
    std::vector<int> cell_solid;
    std::vector<std::vector<int>> on_plane;  // facets per plane
    bool between_solids_only = false;        // overlay no two facets of one solid
};

Complex make_complex(const GridSolid& solid, const std::vector<Polyhedra>& cells,
                     const std::vector<int>& solid_ids);

// Cuts off what lies outside of the plane of `key`; false when nothing with an area is left.
// `key_here` is the plane of the polygon.
bool clip(PointTable& points, Polygon& polygon, int key_here, int key);

// Whole-step box around points, one step wider than they are.
Box box_of(const PointTable& points, const std::vector<int>& ids);

// The common part of a facet on the stored side of a plane (front, even key) and one on the other;
// counter-clockwise seen from outside the front facet.
struct Piece {
    int front, back;
    Polygon polygon;
};

std::vector<Piece> overlay(Complex& complex, Progress& progress);

// An edge of the surface between two owners, on the plane of one of them: a directed edge of the
// outward triangle (or of the opposite one) that lies there.
struct Rim {
    int key, solid, from, to;
    int owner;      // of the triangle on its left
    bool coplanar;  // another owner goes on in the same oriented plane
};

std::vector<Rim> find_rims(Complex& complex, const GridSolid& solid,
                           const std::vector<int>& owners);

// A part of a rim strictly inside a facet or piece, by its ends.
using Segment = std::array<int, 2>;

struct Slits {
    std::vector<std::vector<Segment>> of_facet, of_piece;
    std::vector<char> two_sided;  // per plane: skin may lie on both sides of one place
};

Slits clip_rims(Complex& complex, const std::vector<Piece>& pieces, const std::vector<Rim>& rims);

// Which points divide each segment.
class Splits {
  public:
    // Registers the segment from a to b, which lies in two planes or, with `second` < 0, in one.
    void add(int a, int b, int first_plane, int second_plane);
    // Finds all points of the table that lie inside the segments.
    void find(Complex& complex, Progress& progress);
    // Calls visit(u, v) for the parts of the segment from a to b, in order.
    template <class Visit>
    void for_parts(int a, int b, Visit&& visit) const {
        const std::vector<int>* inner = between(a, b);
        int last = a;
        if (inner && a < b)
            for (auto i = inner->begin(); i != inner->end(); ++i)
                visit(std::exchange(last, *i), *i);
        else if (inner)
            for (auto i = inner->rbegin(); i != inner->rend(); ++i)
                visit(std::exchange(last, *i), *i);
        visit(last, b);
    }

  private:
    struct Entry {
        int low, high, first_plane, second_plane;
    };
    const std::vector<int>* between(int a, int b) const;
    std::unordered_map<std::uint64_t, int> index_;
    std::vector<Entry> entries_;
    std::vector<std::vector<int>> inner_;
};

// A triangle of a facet of one cell, outward. `owner` >= 0: skin of that owner.
struct Face {
    Triangle corners;
    int facet;
    int owner;
};

// Those between two cells come once for each.
std::vector<Face> triangulate_faces(Complex& complex, const std::vector<Piece>& pieces,
                                    const std::vector<Rim>& rims, const Slits& slits,
                                    const Splits& splits, const GridSolid& solid,
                                    Progress& progress);

// Tetrahedra of points of the complex and, after these, of cone points.
struct ConeTets {
    std::vector<std::array<int, 4>> tets;
    std::vector<int> tet_solid;
    std::vector<HPoint> cone_points;
};

ConeTets make_cones(Complex& complex, const std::vector<Face>& faces, Progress& progress);

}  // namespace tetra::cells

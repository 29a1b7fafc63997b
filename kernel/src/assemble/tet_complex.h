// SPDX-License-Identifier: LGPL-2.1-or-later
// A tetrahedral mesh that changes: neighbours, stars, exact and double places, and an undo log.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "tetra/exact/grid.h"
#include "tetra/solid/exact_mesh.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

using Tet = std::array<int, 4>;

// Face i lies opposite corner i; its corners in outward order.
inline constexpr int kFace[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
// kRest[i][j]: the corners k, l that make (i, j, k, l) an even permutation.
inline constexpr int kRest[4][4][2] = {{{-1, -1}, {2, 3}, {3, 1}, {1, 2}},
                                       {{3, 2}, {-1, -1}, {0, 3}, {2, 0}},
                                       {{1, 3}, {3, 0}, {-1, -1}, {0, 1}},
                                       {{2, 1}, {0, 2}, {1, 0}, {-1, -1}}};

// What a skin triangle lies on: one plane, one side of it, one B-rep face, one solid.
struct FacetClass {
    int plane = -1;     // id without side
    int face = 0;       // the caller's face
    int triangle = -1;  // a triangle of the GridSolid on it
    friend bool operator==(const FacetClass&, const FacetClass&) = default;
};

struct FacetClasses {
    std::vector<FacetClass> classes;
    std::vector<int> of_triangle;
};

// Classes of the triangles of a solid. `faces` is empty (all one face) or holds an id per triangle.
FacetClasses facet_classes(const GridSolid& solid, std::span<const int> faces);

// splitmix64: small, fast, the same everywhere.
struct Rng {
    std::uint64_t state = 1;
    std::uint64_t next() {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    int below(int n) {
        return static_cast<int>(
            (static_cast<unsigned __int128>(next()) * static_cast<unsigned>(n)) >> 64);
    }
};

// A replacement of tetrahedra by others that fill the same space.
struct Flip {
    static constexpr int kMaxKills = 8, kMaxAdds = 12;
    std::array<int, kMaxKills> kills;
    std::array<Tet, kMaxAdds> adds;
    int kill_count = 0, add_count = 0;
    int skin_class = -1;  // of new triangles on the skin, if any
    double cost = 0;      // sum over adds of the cost asked for

    void clear() { kill_count = add_count = 0, skin_class = -1, cost = 0; }
    std::span<const int> killed() const {
        return {kills.data(), static_cast<std::size_t>(kill_count)};
    }
    std::span<const Tet> added() const {
        return {adds.data(), static_cast<std::size_t>(add_count)};
    }
};

// Invariants: every live tetrahedron is positive on the exact grid points; neighbour codes of live
// tetrahedra are mutual; `stars` of a point holds each live tetrahedron at it at least once, and
// maybe stale ids, which star_of() drops.
class TetComplex {
  public:
    // Throws VerificationFailed if triangles don't pair or skin triangles are missing.
    TetComplex(const ExactMesh& mesh, const Grid& grid, const FacetClasses& classes);

    // Live tetrahedra, points in use (and all input vertices), skin with its classes.
    void write_back(ExactMesh& mesh, std::vector<Vec3d>* places) const;

    int point_count() const { return static_cast<int>(grid_.size()); }
    int tet_count() const { return live_; }
    int id_count() const { return static_cast<int>(tets_.size()); }
    bool alive(int t) const { return alive_[static_cast<std::size_t>(t)] != 0; }
    const Tet& tet(int t) const { return tets_[static_cast<std::size_t>(t)]; }
    // 4 * tetrahedron + face, or ~class on the skin.
    int neighbour(int t, int face) const {
        return neighbours_[static_cast<std::size_t>(t)][static_cast<std::size_t>(face)];
    }
    const Carrier& carrier(int p) const { return carriers_[static_cast<std::size_t>(p)]; }
    bool steiner(int p) const { return carrier(p).kind != CarrierKind::vertex; }
    const FacetClass& facet_class(int c) const {
        return classes_.classes[static_cast<std::size_t>(c)];
    }
    const Grid& grid() const { return frame_; }
    const HPoint& exact(int p) const { return exact_[static_cast<std::size_t>(p)]; }
    const Vec3d& grid_place(int p) const { return grid_[static_cast<std::size_t>(p)]; }
    const Vec3d& place(int p) const { return place_[static_cast<std::size_t>(p)]; }
    void set_place(int p, const Vec3d& place) { place_[static_cast<std::size_t>(p)] = place; }
    // From now on places may differ from the grid by more than rounding.
    void release_places() { moved_ = true; }
    // While set, positive() asks the exact grid points alone.
    void ask_grid_only(bool only) { grid_only_ = only; }

    static int corner(const Tet& t, int p) {
        for (int i = 0; i < 4; ++i)
            if (t[static_cast<std::size_t>(i)] == p) return i;
        return -1;
    }
    static bool contains(const Tet& t, int p) { return corner(t, p) >= 0; }

    // Live tetrahedra at p, each once, in a fixed order.
    const std::vector<int>& star_of(int p);

    // Positive on exact grid coordinates and on the doubles in place.
    bool positive(const Tet& t) const { return positive(t[0], t[1], t[2], t[3]); }
    bool positive(int a, int b, int c, int d) const;
    // The same with p replaced by q.
    bool positive_with(Tet t, int p, int q) const {
        for (int& v : t)
            if (v == p) v = q;
        return positive(t);
    }
    bool place_positive(const Tet& t) const;

    // p moves onto its neighbour q. All checks are the caller's.
    void collapse(int p, int q);

    // Takes out a flat tetrahedron with two skin faces: its other two become skin, each of a class
    // of its own with the source of the larger old skin face, so that no 2-2 flip reaches it.
    void peel(int t);
    // Pairs of triangles of the GridSolid whose facets exchanged skin by peels.
    const std::vector<std::array<int, 2>>& peeled_pairs() const { return peeled_; }

    // A Steiner point inside the solid, on no tetrahedron yet; the grid place is rounded.
    int add_inner_point(const Vec3d& grid, const Vec3d& place);
    void drop_last_point();
    // Replaces the tetrahedra by the cone from `apex` over their hull. All checks are the caller's.
    void cone_over(const std::vector<int>& cavity, int apex);

    // Positions in the log; undo_to() takes back every apply() after a mark.
    std::size_t mark() const { return log_.size(); }
    void apply(const Flip& flip);
    void undo_to(std::size_t mark);
    void forget() { log_.clear(); }

  private:
    int add(const Tet& t, int solid);
    void enter_star(int p, int t);
    bool exactly_positive(int a, int b, int c, int d) const;
    void reserve(const std::vector<Tet>& tets);
    // The two higher corners of a triangle; side of a tetrahedron, or skin triangle ~code.
    struct FaceKey {
        std::uint64_t corners;
        int code;
    };
    void pair_faces(const ExactMesh& mesh);
    void link_sides(const ExactMesh& mesh, int lowest, const FaceKey* first, const FaceKey* last);
    bool faces_outward(int code, const Triangle& triangle) const;
    void set_neighbour(int code, int other) {
        neighbours_[static_cast<std::size_t>(code / 4)][static_cast<std::size_t>(code % 4)] = other;
    }

    Grid frame_;
    FacetClasses classes_;
    std::vector<HPoint> exact_;
    std::vector<Carrier> carriers_;
    std::vector<Vec3i> integer_;
    std::vector<char> is_integer_;
    std::vector<Vec3d> grid_, place_;
    double grid_slack_ = 0, place_slack_ = 0;  // |grid_ - exact|, |place_ - exact| in steps
    bool moved_ = false;
    bool grid_only_ = false;
    std::vector<Tet> tets_;
    std::vector<std::array<int, 4>> neighbours_;
    std::vector<char> alive_;
    std::vector<int> solid_;
    std::vector<std::vector<int>> stars_;
    std::vector<std::uint32_t> stamp_;  // per tetrahedron: the last star_of() that saw it
    std::uint32_t clock_ = 0;
    int live_ = 0;
    std::vector<std::array<int, 2>> peeled_;
    std::vector<int> log_;  // per flip: killed ids, their count, count of added ones
};

}  // namespace tetra

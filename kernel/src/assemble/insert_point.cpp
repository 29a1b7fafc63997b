// SPDX-License-Identifier: LGPL-2.1-or-later
// Cavities grown until all of their hull is seen from the new point.
#include "insert_point.h"

#include <algorithm>
#include <optional>

namespace tetra {
namespace {

constexpr int kLargestCavity = 60;
constexpr int kDrawsPerTet = 3;
constexpr std::size_t kSources = 60;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

void sort_unique(std::vector<int>& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

bool has(const std::vector<int>& ids, int id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

// The same mixture of a tetrahedron's corners on the grid and in place.
struct Draw {
    Vec3d grid{0, 0, 0}, place{0, 0, 0};
};

Draw draw_in(const TetComplex& mesh, const Tet& t, Rng& rng, bool middle) {
    std::array<double, 4> weight;
    double sum = 0;
    for (double& w : weight) sum += w = middle ? 1 : 1 + rng.below(20);
    Draw d;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            d.grid[k] += weight[i] / sum * mesh.grid_place(t[i])[k];
            d.place[k] += weight[i] / sum * mesh.place(t[i])[k];
        }
    return d;
}

class Cavity {
  public:
    Cavity(const TetComplex& mesh, const std::vector<int>& bad, int point,
           const std::function<bool(const Tet&)>& sound)
        : mesh_(mesh), tets_(bad), point_(point), sound_(sound) {}

    // False when the hull can't be seen whole.
    bool grow() {
        for (std::size_t i = 0; i < tets_.size(); ++i)
            for (int face = 0; face < 4; ++face)
                if (!see(tets_[i], face)) return false;
        // What was seen before a neighbour joined may be inside by now; it is not counted.
        cones_ = 0;
        for (const int t : tets_)
            for (int face = 0; face < 4; ++face) cones_ += on_hull(t, face);
        return keeps_input();
    }

    int cones() const { return cones_; }
    const std::vector<int>& tets() const { return tets_; }
    const std::vector<int>& vanished() const { return vanished_; }

  private:
    bool on_hull(int t, int face) const {
        const int code = mesh_.neighbour(t, face);
        return code < 0 || !has(tets_, code / 4);
    }

    bool see(int t, int face) {
        if (!on_hull(t, face)) return true;
        Tet cone = mesh_.tet(t);
        cone[at(face)] = point_;
        if (mesh_.positive(cone) && sound_(cone)) return true;
        const int code = mesh_.neighbour(t, face);
        if (code < 0 || static_cast<int>(tets_.size()) == kLargestCavity) return false;
        tets_.push_back(code / 4);
        return true;
    }

    bool keeps_input() {
        std::vector<int> all, hull;
        for (const int t : tets_)
            for (int face = 0; face < 4; ++face) {
                all.push_back(mesh_.tet(t)[at(face)]);
                if (!on_hull(t, face)) continue;
                for (const int k : kFace[face]) hull.push_back(mesh_.tet(t)[at(k)]);
            }
        sort_unique(all);
        sort_unique(hull);
        vanished_.clear();
        std::set_difference(all.begin(), all.end(), hull.begin(), hull.end(),
                            std::back_inserter(vanished_));
        return std::none_of(vanished_.begin(), vanished_.end(),
                            [&](int p) { return !mesh_.steiner(p); });
    }

    const TetComplex& mesh_;
    std::vector<int> tets_;
    int point_;
    const std::function<bool(const Tet&)>& sound_;
    std::vector<int> vanished_;
    int cones_ = 0;
};

// Tetrahedra in which to draw: those at the corners of the bad ones, nearest first.
std::vector<int> sources_of(TetComplex& mesh, const std::vector<int>& bad) {
    std::vector<std::array<int, 2>> order;  // (-shared corners, tetrahedron)
    for (const int b : bad) {
        const Tet corners = mesh.tet(b);
        for (const int p : corners)
            for (const int t : mesh.star_of(p)) {
                int shared = 0;
                for (const int v : mesh.tet(t)) shared += TetComplex::contains(corners, v);
                order.push_back({-shared, t});
            }
    }
    std::sort(order.begin(), order.end());
    std::vector<int> sources;
    for (const auto& entry : order) {
        if (sources.size() == kSources) break;
        if (!has(sources, entry[1]) && mesh.place_positive(mesh.tet(entry[1])))
            sources.push_back(entry[1]);
    }
    return sources;
}

}  // namespace

Insertion insert_point(TetComplex& mesh, const std::vector<int>& bad, Rng& rng,
                       const std::function<bool(const Tet&)>& sound) {
    std::optional<Draw> best;
    int fewest = 0;
    for (const int t : sources_of(mesh, bad))
        for (int k = 0; k < kDrawsPerTet; ++k) {
            const Draw draw = draw_in(mesh, mesh.tet(t), rng, k == 0);
            const int point = mesh.add_inner_point(draw.grid, draw.place);
            Cavity cavity(mesh, bad, point, sound);
            const bool fits = cavity.grow();
            mesh.drop_last_point();
            if (!fits || (best && cavity.cones() >= fewest)) continue;
            best = draw;
            fewest = cavity.cones();
        }
    if (!best) return {};
    Insertion result;
    result.point = mesh.add_inner_point(best->grid, best->place);
    Cavity cavity(mesh, bad, result.point, sound);
    cavity.grow();
    result.vanished = cavity.vanished();
    mesh.cone_over(cavity.tets(), result.point);
    return result;
}

}  // namespace tetra

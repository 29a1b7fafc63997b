// SPDX-License-Identifier: LGPL-2.1-or-later
// Greedy merging on a heap of pairs; entries whose hulls are gone are skipped when they come up.
#include "merge_hulls.h"

#include <algorithm>
#include <queue>
#include <set>

#include "convex_hull.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Pair {
    double growth6;
    int a, b;  // a < b
    bool operator>(const Pair& o) const {
        return std::tie(growth6, a, b) > std::tie(o.growth6, o.a, o.b);
    }
};

class Merger {
  public:
    Merger(const std::vector<Vec3d>& points, const std::vector<std::vector<int>>& cells,
           const std::vector<int>& cell_solid)
        : points_(points), solid_(cell_solid), left_(static_cast<int>(cells.size())) {
        for (std::size_t k = 0; k < cells.size(); ++k) {
            MergedHull hull = hull_of(cells[k]);
            hull.cells = {static_cast<int>(k)};
            hull.triangles.clear();
            hulls_.push_back(std::move(hull));
        }
        beside_.resize(hulls_.size());
        alive_.assign(hulls_.size(), true);
    }

    std::vector<MergedHull> run(int most, Progress& progress) {
        const int cells = left_;
        pair_neighbours(progress);
        while (left_ > most) {
            if (heap_.empty()) pair_all();
            const Pair next = heap_.top();
            heap_.pop();
            if (!alive_[at(next.a)] || !alive_[at(next.b)]) continue;
            merge(next.a, next.b);
            progress.poll("merge_cells", 1 - static_cast<double>(left_ - most) /
                                                 static_cast<double>(cells - most));
        }
        std::vector<MergedHull> result;
        for (std::size_t k = 0; k < hulls_.size(); ++k)
            if (alive_[k]) result.push_back(std::move(hulls_[k]));
        std::sort(result.begin(), result.end(), [](const MergedHull& x, const MergedHull& y) {
            return x.cells.front() < y.cells.front();
        });
        return result;
    }

  private:
    const std::vector<Vec3d>& points_;
    std::vector<int> solid_;
    int left_;
    std::vector<MergedHull> hulls_;
    std::vector<std::set<int>> beside_;
    std::vector<char> alive_;
    std::priority_queue<Pair, std::vector<Pair>, std::greater<>> heap_;
    std::vector<Vec3d> local_;

    // The hull of points given by increasing ids; flat ones get volume 0 and keep all points.
    MergedHull hull_of(const std::vector<int>& ids) {
        local_.clear();
        for (const int i : ids) local_.push_back(points_[at(i)]);
        MergedHull hull;
        hull.triangles = convex_hull(local_);
        hull.volume6 = volume6(local_, hull.triangles);
        for (Triangle& t : hull.triangles)
            for (int& corner : t) {
                corner = ids[at(corner)];
                hull.points.push_back(corner);
            }
        std::sort(hull.points.begin(), hull.points.end());
        hull.points.erase(std::unique(hull.points.begin(), hull.points.end()), hull.points.end());
        if (hull.triangles.empty()) hull.points = ids;
        return hull;
    }

    std::vector<int> points_of_both(int a, int b) const {
        std::vector<int> both;
        std::set_union(hulls_[at(a)].points.begin(), hulls_[at(a)].points.end(),
                       hulls_[at(b)].points.begin(), hulls_[at(b)].points.end(),
                       std::back_inserter(both));
        return both;
    }

    void push(int a, int b) {
        const MergedHull both = hull_of(points_of_both(a, b));
        const double growth6 = both.volume6 - hulls_[at(a)].volume6 - hulls_[at(b)].volume6;
        heap_.push({growth6, std::min(a, b), std::max(a, b)});
    }

    void pair_neighbours(Progress& progress) {
        std::vector<std::vector<int>> at_point(points_.size());
        for (std::size_t k = 0; k < hulls_.size(); ++k)
            for (const int p : hulls_[k].points) at_point[at(p)].push_back(static_cast<int>(k));
        for (const std::vector<int>& around : at_point)
            for (const int a : around)
                for (const int b : around)
                    if (a < b && solid_[at(a)] == solid_[at(b)]) {
                        beside_[at(a)].insert(b);
                        beside_[at(b)].insert(a);
                    }
        for (std::size_t k = 0; k < hulls_.size(); ++k) {
            for (const int b : beside_[k])
                if (static_cast<int>(k) < b) push(static_cast<int>(k), b);
            progress.poll("merge_cells", 0);
        }
    }

    // Nothing that is left touches: parts of a solid may be joined across a gap.
    void pair_all() {
        for (int a = 0; a < static_cast<int>(hulls_.size()); ++a)
            for (int b = a + 1; b < static_cast<int>(hulls_.size()); ++b)
                if (alive_[at(a)] && alive_[at(b)] && solid_[at(a)] == solid_[at(b)]) {
                    beside_[at(a)].insert(b);
                    beside_[at(b)].insert(a);
                    push(a, b);
                }
    }

    void merge(int a, int b) {
        const int made = static_cast<int>(hulls_.size());
        MergedHull hull = hull_of(points_of_both(a, b));
        std::merge(hulls_[at(a)].cells.begin(), hulls_[at(a)].cells.end(),
                   hulls_[at(b)].cells.begin(), hulls_[at(b)].cells.end(),
                   std::back_inserter(hull.cells));
        hulls_.push_back(std::move(hull));
        solid_.push_back(solid_[at(a)]);
        alive_.push_back(true);
        alive_[at(a)] = alive_[at(b)] = false;
        --left_;
        std::set<int> around = beside_[at(a)];
        around.insert(beside_[at(b)].begin(), beside_[at(b)].end());
        beside_.emplace_back();
        for (const int c : around) {
            beside_[at(c)].erase(a);
            beside_[at(c)].erase(b);
            if (!alive_[at(c)]) continue;
            beside_[at(c)].insert(made);
            beside_[at(made)].insert(c);
            push(made, c);
        }
    }
};

}  // namespace

std::vector<MergedHull> merge_hulls(const std::vector<Vec3d>& points,
                                    const std::vector<std::vector<int>>& cells,
                                    const std::vector<int>& cell_solid, int most,
                                    Progress& progress) {
    return Merger(points, cells, cell_solid).run(most, progress);
}

}  // namespace tetra

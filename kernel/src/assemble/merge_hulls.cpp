// SPDX-License-Identifier: LGPL-2.1-or-later
// Greedy merging on a heap of pairs, each judged no closer than its turn asks for.
#include "merge_hulls.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>
#include <tuple>

#include "convex_hull.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// What is known of a pair's stray: that it is no less than those of its hulls; than in the middle
// of the largest bridging facet; than in the middles of all; or all that sampling tells.
enum class Known { bound, largest, middles, all };

struct Pair {
    double stray, growth6;
    int a, b;  // a < b
    Known known;
    bool operator>(const Pair& o) const {
        return std::tie(stray, growth6, a, b) > std::tie(o.stray, o.growth6, o.a, o.b);
    }
};

class Merger {
  public:
    Merger(const CellArrays& part, const std::vector<std::vector<int>>& cells,
           const PartDistance& distance)
        : points_(part.points),
          distance_(distance),
          solid_(part.cell_solid),
          left_(static_cast<int>(cells.size())) {
        for (std::size_t k = 0; k < cells.size(); ++k) {
            hulls_.push_back(hull_of(cells[k]));
            hulls_.back().cells = {static_cast<int>(k)};
        }
        beside_.resize(hulls_.size());
        alive_.assign(hulls_.size(), true);
        owner_.assign(points_.size(), 0);
    }

    std::vector<MergedHull> run(int most, Progress& progress) {
        const int cells = left_;
        pair_neighbours();
        while (left_ > most) {
            progress.poll("merge_cells",
                          static_cast<double>(cells - left_) / static_cast<double>(cells - most));
            if (heap_.empty()) pair_all();
            const Pair next = heap_.top();
            heap_.pop();
            if (!alive_[at(next.a)] || !alive_[at(next.b)]) continue;
            if (next.known == Known::all)
                merge(next);
            else
                judge(next);
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
    const PartDistance& distance_;
    std::vector<int> solid_;
    int left_;
    double level_ = 0;  // the farthest that a merged hull strays
    std::vector<MergedHull> hulls_;
    std::vector<std::set<int>> beside_;
    std::vector<char> alive_;
    std::vector<char> owner_;  // of each point while a pair is judged: 1, 2 or both bits
    std::priority_queue<Pair, std::vector<Pair>, std::greater<>> heap_;

    const Vec3d& point(int i) const { return points_[at(i)]; }

    MergedHull hull_of(const std::vector<int>& ids) const { return hull_of_points(points_, ids); }

    MergedHull hull_of_both(int a, int b) const {
        std::vector<int> both;
        std::set_union(hulls_[at(a)].points.begin(), hulls_[at(a)].points.end(),
                       hulls_[at(b)].points.begin(), hulls_[at(b)].points.end(),
                       std::back_inserter(both));
        return hull_of(both);
    }

    double bound(int a, int b) const { return std::max(hulls_[at(a)].stray, hulls_[at(b)].stray); }

    void pair(int a, int b) {
        beside_[at(a)].insert(b);
        beside_[at(b)].insert(a);
        heap_.push({bound(a, b), 0, std::min(a, b), std::max(a, b), Known::bound});
    }

    void pair_neighbours() {
        std::vector<std::vector<int>> at_point(points_.size());
        for (std::size_t k = 0; k < hulls_.size(); ++k)
            for (const int p : hulls_[k].points) at_point[at(p)].push_back(static_cast<int>(k));
        for (const std::vector<int>& around : at_point)
            for (const int a : around)
                for (const int b : around)
                    if (a < b && solid_[at(a)] == solid_[at(b)] && !beside_[at(a)].contains(b))
                        pair(a, b);
    }

    // Nothing that is left touches: parts of a solid may be joined across a gap.
    void pair_all() {
        for (int a = 0; a < static_cast<int>(hulls_.size()); ++a)
            for (int b = a + 1; b < static_cast<int>(hulls_.size()); ++b)
                if (alive_[at(a)] && alive_[at(b)] && solid_[at(a)] == solid_[at(b)]) pair(a, b);
    }

    // Puts the pair back with more known of it.
    void judge(Pair pair) {
        const MergedHull both = hull_of_both(pair.a, pair.b);
        pair.growth6 = both.volume6 - hulls_[at(pair.a)].volume6 - hulls_[at(pair.b)].volume6;
        pair.known = static_cast<Known>(static_cast<int>(pair.known) + 1);
        const std::vector<Corners> bridging = bridging_facets(both, pair);
        if (pair.known == Known::all) {
            // What has been merged strays as far as `level_` already.
            const double stray =
                farthest_of(distance_, bridging, std::max(pair.stray, level_), HUGE_VAL);
            if (stray > level_) pair.stray = std::max(pair.stray, stray);
        } else if (!bridging.empty()) {
            look(bridging, pair);
        }
        if (pair.stray <= distance_.touching()) pair.stray = 0;
        heap_.push(pair);
    }

    // Raises the stray to the distances of the middles of some facets.
    void look(const std::vector<Corners>& bridging, Pair& pair) const {
        const auto radius = [](const Corners& c) { return ball_around(c).radius; };
        const auto see = [&](const Corners& c) {
            if (radius(c) > std::max(pair.stray, level_) && !distance_.in_one_cell(c))
                pair.stray = std::max(pair.stray, distance_(ball_around(c).middle));
        };
        if (pair.known == Known::largest)
            see(*std::ranges::max_element(bridging, {}, radius));
        else
            std::ranges::for_each(bridging, see);
    }

    // Facets of the common hull that have corners of both hulls' own.
    std::vector<Corners> bridging_facets(const MergedHull& both, const Pair& pair) {
        for (const int i : hulls_[at(pair.a)].points) owner_[at(i)] |= 1;
        for (const int i : hulls_[at(pair.b)].points) owner_[at(i)] |= 2;
        std::vector<Corners> bridging;
        for (const Triangle& t : both.triangles)
            if ((owner_[at(t[0])] & owner_[at(t[1])] & owner_[at(t[2])]) == 0)
                bridging.push_back({point(t[0]), point(t[1]), point(t[2])});
        for (const int k : {pair.a, pair.b})
            for (const int i : hulls_[at(k)].points) owner_[at(i)] = 0;
        return bridging;
    }

    void merge(const Pair& pair_) {
        const int a = pair_.a, b = pair_.b;
        const int made = static_cast<int>(hulls_.size());
        MergedHull hull = hull_of_both(a, b);
        hull.stray = pair_.stray;
        level_ = std::max(level_, hull.stray);
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
            if (alive_[at(c)]) pair(made, c);
        }
    }
};

}  // namespace

std::vector<MergedHull> merge_hulls(const CellArrays& part,
                                    const std::vector<std::vector<int>>& cells,
                                    const PartDistance& distance, int most, Progress& progress) {
    return Merger(part, cells, distance).run(most, progress);
}

}  // namespace tetra

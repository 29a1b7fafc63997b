// SPDX-License-Identifier: LGPL-2.1-or-later
// Chains of gifts from the worst hull to one that can take a cell, judged by sampled distances.
#include "shift_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace tetra {
namespace {

constexpr int kMostJudged = 30000;  // hulls
constexpr int kLongestChain = 3;    // gifts that make room for one another
constexpr double kBetter = 0.999;   // of the worst stray: what counts as better

using Cells = std::vector<int>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Cells without(const Cells& cells, int gone) {
    Cells rest = cells;
    std::erase(rest, gone);
    return rest;
}

Cells with(const Cells& cells, int more) {
    Cells all = cells;
    all.insert(std::lower_bound(all.begin(), all.end(), more), more);
    return all;
}

class Shifter {
  public:
    Shifter(const CellArrays& part, const std::vector<Cells>& cells, const PartDistance& distance,
            Progress& progress)
        : points_(part.points),
          cells_(cells),
          distance_(distance),
          progress_(progress),
          beside_(cells.size()),
          owner_(cells.size(), -1) {
        std::vector<Cells> at_point(points_.size());
        for (std::size_t c = 0; c < cells.size(); ++c)
            for (const int p : cells[c]) at_point[at(p)].push_back(static_cast<int>(c));
        for (const Cells& around : at_point)
            for (const int a : around)
                for (const int b : around)
                    if (a != b && part.cell_solid[at(a)] == part.cell_solid[at(b)])
                        beside_[at(a)].push_back(b);
        for (Cells& list : beside_) {
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
        }
    }

    std::vector<MergedHull> run(std::vector<MergedHull> hulls) {
        for (MergedHull& hull : hulls) {
            groups_.push_back(std::move(hull.cells));
            stray_.push_back(0);
            settle(static_cast<int>(groups_.size()) - 1);
        }
        while (judged_ < kMostJudged) {
            worst_ = static_cast<int>(std::ranges::max_element(stray_) - stray_.begin());
            limit_ = kBetter * stray_[at(worst_)];
            if (limit_ <= distance_.touching() || !relieve()) break;
        }
        std::vector<MergedHull> result;
        for (const Cells& group : groups_) result.push_back(hull_of(group));
        for (std::size_t k = 0; k < result.size(); ++k) {
            result[k].cells = groups_[k];
            result[k].stray = stray_[k];
        }
        std::ranges::sort(result, {}, [](const MergedHull& h) { return h.cells.front(); });
        return result;
    }

  private:
    std::span<const Vec3d> points_;
    const std::vector<Cells>& cells_;
    const PartDistance& distance_;
    Progress& progress_;
    std::vector<Cells> beside_;  // per cell: cells of its solid that share a point
    std::vector<int> owner_;     // per cell: its group
    std::vector<Cells> groups_;
    std::vector<double> stray_;      // per group
    std::map<Cells, double> known_;  // strays, or what they exceed where no less was wanted
    std::vector<int> path_;          // groups of the chain under way
    int worst_ = 0, judged_ = 0;
    double limit_ = HUGE_VAL;  // a group that strays as far is no better

    MergedHull hull_of(const Cells& group) const {
        std::vector<int> ids;
        for (const int c : group) ids.insert(ids.end(), cells_[at(c)].begin(), cells_[at(c)].end());
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        return hull_of_points(points_, ids);
    }

    // How far the common hull of cells strays; any value from limit_ on when it is no less.
    double stray_of(const Cells& group) {
        if (group.size() < 2) return 0;
        const auto [place, fresh] = known_.try_emplace(group, 0);
        if (!fresh) return place->second;
        ++judged_;
        progress_.poll("shift_cells", std::min(1.0, static_cast<double>(judged_) / kMostJudged));
        const MergedHull hull = hull_of(group);
        std::vector<Corners> facets;
        for (const Triangle& t : hull.triangles)
            facets.push_back({points_[at(t[0])], points_[at(t[1])], points_[at(t[2])]});
        double& stray = place->second;
        stray = farthest_of(distance_, facets, 0, limit_);
        if (stray <= distance_.touching()) stray = 0;
        return stray;
    }

    void settle(int group) {
        for (const int c : groups_[at(group)]) owner_[at(c)] = group;
        stray_[at(group)] = stray_of(groups_[at(group)]);
    }

    // Lets the worst group do better.
    bool relieve() {
        for (int chain = 1; chain <= kLongestChain; ++chain) {
            path_ = {worst_};
            if (give(worst_, groups_[at(worst_)], -1, chain)) return true;
        }
        return divide();
    }

    // A cell of `group`, which holds these cells now, that it does well without goes to a neighbour
    // that does well with it, or well once it has given one itself.
    bool give(int group, const Cells& cells, int received, int chain) {
        struct Gift {
            double stray;
            int cell, to;
        };
        std::vector<Gift> gifts;
        for (const int c : cells) {
            if (c == received || cells.size() < 2 || judged_ >= kMostJudged) continue;
            const double left = stray_of(without(cells, c));
            if (left >= limit_) continue;
            for (const int to : groups_around(c)) {
                const double right = stray_of(with(groups_[at(to)], c));
                if (chain > 1 || right < limit_) gifts.push_back({std::max(left, right), c, to});
            }
        }
        std::ranges::stable_sort(gifts, {}, &Gift::stray);
        for (const Gift& gift : gifts) {
            const Cells taken = with(groups_[at(gift.to)], gift.cell);
            if (gift.stray >= limit_) {
                path_.push_back(gift.to);
                const bool passed_on = give(gift.to, taken, gift.cell, chain - 1);
                path_.pop_back();
                if (!passed_on) continue;
            } else {
                groups_[at(gift.to)] = taken;
                settle(gift.to);
            }
            groups_[at(group)] = without(cells, gift.cell);
            settle(group);
            return true;
        }
        return false;
    }

    std::vector<int> groups_around(int cell) const {
        std::vector<int> found;
        for (const int other : beside_[at(cell)])
            if (std::ranges::find(path_, owner_[at(other)]) == path_.end())
                found.push_back(owner_[at(other)]);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

    // The worst group loses a cell, which stands alone; two others become one.
    bool divide() {
        const Cells cells = groups_[at(worst_)];
        const auto rest = [&](int c) { return stray_of(without(cells, c)); };
        const int alone = *std::ranges::min_element(cells, {}, rest);
        if (rest(alone) >= limit_) return false;
        path_ = {worst_};
        double best = limit_;
        std::optional<std::array<int, 2>> pair;
        for (int a = 0; a < static_cast<int>(groups_.size()); ++a)
            for (const int b : groups_beside(a)) {
                if (b <= a || judged_ >= kMostJudged) continue;
                const double stray = stray_of(joined(a, b));
                if (stray >= best) continue;
                best = stray;
                pair = {a, b};
            }
        if (!pair) return false;
        const auto [a, b] = *pair;
        groups_[at(a)] = joined(a, b);
        groups_[at(b)] = {alone};
        groups_[at(worst_)] = without(cells, alone);
        for (const int group : {a, b, worst_}) settle(group);
        return true;
    }

    Cells joined(int a, int b) const {
        Cells both;
        std::ranges::merge(groups_[at(a)], groups_[at(b)], std::back_inserter(both));
        return both;
    }

    std::vector<int> groups_beside(int group) const {
        std::vector<int> found;
        if (group == worst_ || stray_[at(group)] >= limit_) return found;
        for (const int c : groups_[at(group)])
            for (const int other : groups_around(c))
                if (other != group && stray_[at(other)] < limit_) found.push_back(other);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }
};

}  // namespace

std::vector<MergedHull> shift_cells(const CellArrays& part, const std::vector<Cells>& cells,
                                    const PartDistance& distance, std::vector<MergedHull> hulls,
                                    Progress& progress) {
    return Shifter(part, cells, distance, progress).run(std::move(hulls));
}

}  // namespace tetra

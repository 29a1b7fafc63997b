// SPDX-License-Identifier: LGPL-2.1-or-later
// T-junctions: every segment is divided at every point that lies inside it.
#include <algorithm>
#include <cmath>

#include "../notch/flat_map.h"
#include "cell_tets_stages.h"

namespace tetra::cells {
namespace {

std::uint64_t key_of(int a, int b) { return notch::pair_key(std::min(a, b), std::max(a, b)); }

// Strict order along the segment low -> high by exact comparison.
class Along {
  public:
    Along(const PointTable& points, int low, int high) : points_(points) {
        const Vec3d &a = points.approx(low), &b = points.approx(high);
        for (int k = 1; k < 3; ++k)
            if (std::fabs(b[k] - a[k]) > std::fabs(b[axis_] - a[axis_])) axis_ = k;
        // Ends too near for doubles still differ in some coordinate.
        for (int k = 0; k < 3 && (sign_ = points.compare(high, low, axis_)) == 0; ++k) axis_ = k;
    }
    bool before(int p, int q) const { return sign_ * points_.compare(p, q, axis_) < 0; }

  private:
    const PointTable& points_;
    int axis_ = 0, sign_ = 1;
};

// Whether p may lie within a grid step of the line through a and b, in doubles.
bool is_near_line(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
    double ab2 = 0, ap2 = 0, dot = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        ab2 += (b[k] - a[k]) * (b[k] - a[k]);
        ap2 += (p[k] - a[k]) * (p[k] - a[k]);
        dot += (b[k] - a[k]) * (p[k] - a[k]);
    }
    return ap2 - (ab2 > 0 ? dot * dot / ab2 : 0) <= 1 + 0x1p-44 * ap2;
}

// Points by place, asked for those near a segment.
class PointFinder {
  public:
    explicit PointFinder(const PointTable& points) {
        std::vector<Triangle> items;
        for (int p = 0; p < points.points(); ++p) {
            Vec3i place;
            for (std::size_t k = 0; k < 3; ++k) place[k] = std::llround(points.approx(p)[k]);
            places_.push_back(place);
            items.push_back({p, p, p});
        }
        tree_ = build_box_tree(places_, items);
    }

    template <class Visit>
    void near(const Box& box, Visit&& visit) const {
        for_boxes_touching(tree_, box, visit);
    }

  private:
    std::vector<Vec3i> places_;
    BoxTree tree_;
};

}  // namespace

void Splits::add(int a, int b, int first_plane, int second_plane) {
    const auto [place, fresh] = index_.try_emplace(key_of(a, b), static_cast<int>(entries_.size()));
    if (fresh)
        entries_.push_back({std::min(a, b), std::max(a, b), first_plane, second_plane});
    else if (entries_[place->second].second_plane < 0)
        entries_[place->second].second_plane = second_plane;
}

void Splits::find(Complex& complex, Progress& progress) {
    PointTable& points = complex.points;
    const PointFinder finder(points);
    inner_.resize(entries_.size());
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (i % 1024 == 0)
            progress.poll("overlay", 0.3 + 0.2 * static_cast<double>(i) /
                                               static_cast<double>(entries_.size()));
        const Entry& e = entries_[i];
        const Along along(points, e.low, e.high);
        const Vec3d &a = points.approx(e.low), &b = points.approx(e.high);
        std::vector<int>& inner = inner_[i];
        const auto on_line = [&](int p) {
            if (!is_near_line(a, b, points.approx(p))) return false;
            if (points.side(p, e.first_plane) != 0) return false;
            if (e.second_plane >= 0) return points.side(p, e.second_plane) == 0;
            for (int axis = 0; axis < 3; ++axis)
                if (points.orient(e.low, e.high, p, axis) != 0) return false;
            return true;
        };
        finder.near(box_of(points, {e.low, e.high}), [&](int p) {
            if (p != e.low && p != e.high && on_line(p) && along.before(e.low, p) &&
                along.before(p, e.high))
                inner.push_back(p);
        });
        std::sort(inner.begin(), inner.end(), [&](int p, int q) { return along.before(p, q); });
    }
}

const std::vector<int>* Splits::between(int a, int b) const {
    const auto place = index_.find(key_of(a, b));
    return place == index_.end() ? nullptr : &inner_[place->second];
}

}  // namespace tetra::cells

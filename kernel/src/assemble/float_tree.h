// SPDX-License-Identifier: LGPL-2.1-or-later
// A balanced tree of boxes in doubles, for what is measured rather than decided.
#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "tetra/exact/grid.h"

namespace tetra {

struct FloatBox {
    Vec3d low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
              std::numeric_limits<double>::infinity()};
    Vec3d high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
               -std::numeric_limits<double>::infinity()};

    void add(const Vec3d& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    // Square of the distance from a point, 0 inside.
    double distance2(const Vec3d& p) const {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double d = std::max({low[k] - p[k], p[k] - high[k], 0.0});
            sum += d * d;
        }
        return sum;
    }
};

// Built in O(n log n).
class FloatTree {
  public:
    explicit FloatTree(std::vector<FloatBox> boxes) : boxes_(std::move(boxes)) {
        order_.resize(boxes_.size());
        std::iota(order_.begin(), order_.end(), 0);
        if (boxes_.empty()) return;
        nodes_.push_back({{}, 0, static_cast<int>(boxes_.size()), -1});
        for (std::size_t i = 0; i < nodes_.size(); ++i) split(i);
    }

    // Calls visit(item) for the items whose box is within the distance whose square is reach2,
    // those in nearer nodes first. visit may lower reach2.
    template <class Visit>
    void visit_near(const Vec3d& p, double& reach2, Visit&& visit) const {
        if (nodes_.empty()) return;
        std::vector<std::pair<double, int>> stack{{box_of_node(0).distance2(p), 0}};
        while (!stack.empty()) {
            const auto [distance2, i] = stack.back();
            stack.pop_back();
            if (distance2 > reach2) continue;
            const Node& node = nodes_[static_cast<std::size_t>(i)];
            if (node.left < 0) {
                for (int k = node.begin; k < node.end; ++k) {
                    const int item = order_[static_cast<std::size_t>(k)];
                    if (boxes_[static_cast<std::size_t>(item)].distance2(p) <= reach2) visit(item);
                }
                continue;
            }
            std::pair<double, int> a{box_of_node(node.left).distance2(p), node.left};
            std::pair<double, int> b{box_of_node(node.left + 1).distance2(p), node.left + 1};
            if (a.first < b.first) std::swap(a, b);
            stack.push_back(a);
            stack.push_back(b);
        }
    }

  private:
    struct Node {
        FloatBox box;
        int begin, end, left;  // children at left and left + 1; a leaf has left < 0
    };
    static constexpr int kLeaf = 4;
    std::vector<FloatBox> boxes_;
    std::vector<int> order_;
    std::vector<Node> nodes_;

    const FloatBox& box_of_node(int i) const { return nodes_[static_cast<std::size_t>(i)].box; }

    void split(std::size_t i) {
        const int begin = nodes_[i].begin, end = nodes_[i].end;
        FloatBox whole, middles;
        const auto middle = [&](int item) {
            const FloatBox& b = boxes_[static_cast<std::size_t>(item)];
            return Vec3d{b.low[0] + b.high[0], b.low[1] + b.high[1], b.low[2] + b.high[2]};
        };
        for (int k = begin; k < end; ++k) {
            const int item = order_[static_cast<std::size_t>(k)];
            whole.add(boxes_[static_cast<std::size_t>(item)].low);
            whole.add(boxes_[static_cast<std::size_t>(item)].high);
            middles.add(middle(item));
        }
        nodes_[i].box = whole;
        if (end - begin <= kLeaf) return;
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (middles.high[k] - middles.low[k] > middles.high[axis] - middles.low[axis]) axis = k;
        const int half = (begin + end) / 2;
        std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                         [&](int a, int b) {
                             return std::pair(middle(a)[axis], a) < std::pair(middle(b)[axis], b);
                         });
        nodes_[i].left = static_cast<int>(nodes_.size());
        nodes_.push_back({{}, begin, half, -1});
        nodes_.push_back({{}, half, end, -1});
    }
};

}  // namespace tetra

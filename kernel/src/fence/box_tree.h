// SPDX-License-Identifier: LGPL-2.1-or-later
// A static tree over boxes in the plan, asked for the boxes near a segment or around a point.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tetra::fence {

struct Box2 {
    std::int64_t x0, y0, x1, y1;
    void add(const Box2& b) {
        x0 = std::min(x0, b.x0);
        y0 = std::min(y0, b.y0);
        x1 = std::max(x1, b.x1);
        y1 = std::max(y1, b.y1);
    }
    bool meets(const Box2& b) const { return x0 <= b.x1 && b.x0 <= x1 && y0 <= b.y1 && b.y0 <= y1; }
};

class BoxTree {
  public:
    explicit BoxTree(std::vector<Box2> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
        std::iota(order_.begin(), order_.end(), 0);
        if (!order_.empty()) build(0, static_cast<int>(order_.size()));
    }

    // Calls visit(item) for each box for which near(box) holds; near must be monotone.
    template <class Near, class Visit>
    void query(Near near, Visit visit) const {
        int stack[128];
        int top = 0;
        if (!nodes_.empty()) stack[top++] = 0;
        while (top > 0) {
            const Node& node = nodes_[static_cast<std::size_t>(stack[--top])];
            if (!near(node.box)) continue;
            if (node.right < 0) {
                for (int i = node.first; i < node.last; ++i) {
                    const int item = order_[static_cast<std::size_t>(i)];
                    if (near(boxes_[static_cast<std::size_t>(item)])) visit(item);
                }
            } else {
                stack[top++] = node.right;
                stack[top++] = static_cast<int>(&node - nodes_.data()) + 1;
            }
        }
    }

  private:
    struct Node {
        Box2 box;
        int first, last, right;  // right < 0: a leaf; the left child follows its parent
    };
    static constexpr int kLeaf = 6;

    void build(int first, int last) {
        const std::size_t self = nodes_.size();
        Box2 box = boxes_[static_cast<std::size_t>(order_[static_cast<std::size_t>(first)])];
        for (int i = first; i < last; ++i)
            box.add(boxes_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])]);
        nodes_.push_back({box, first, last, -1});
        if (last - first <= kLeaf) return;
        const bool by_x = box.x1 - box.x0 >= box.y1 - box.y0;
        const auto centre = [&](int i) {
            const Box2& b = boxes_[static_cast<std::size_t>(i)];
            return by_x ? b.x0 + b.x1 : b.y0 + b.y1;
        };
        const int middle = (first + last) / 2;
        std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                         [&](int i, int j) {
                             const std::int64_t a = centre(i), b = centre(j);
                             return a != b ? a < b : i < j;
                         });
        build(first, middle);
        nodes_[self].right = static_cast<int>(nodes_.size());
        build(middle, last);
    }

    std::vector<Box2> boxes_;
    std::vector<int> order_;
    std::vector<Node> nodes_;
};

}  // namespace tetra::fence

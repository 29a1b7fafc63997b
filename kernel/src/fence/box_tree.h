// SPDX-License-Identifier: LGPL-2.1-or-later
// A static tree over boxes in the plan, asked for the boxes near a segment or around a point.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "tetra/exact/grid.h"

namespace tetra::fence {

// Coordinates of a plan fit 32 bits (FenceInput).
struct Box2 {
    std::int32_t x0, y0, x1, y1;
    void add(const Box2& b) {
        x0 = std::min(x0, b.x0);
        y0 = std::min(y0, b.y0);
        x1 = std::max(x1, b.x1);
        y1 = std::max(y1, b.y1);
    }
    bool meets(const Box2& b) const { return x0 <= b.x1 && b.x0 <= x1 && y0 <= b.y1 && b.y0 <= y1; }
};

inline Box2 box_around(const Vec3i& p) {
    const auto x = static_cast<std::int32_t>(p[0]), y = static_cast<std::int32_t>(p[1]);
    return {x, y, x, y};
}

inline Box2 box_around(const Vec3i& p, const Vec3i& q) {
    Box2 box = box_around(p);
    box.add(box_around(q));
    return box;
}

// Halves of the boxes in the order of a Z curve through their centres, which one sort gives.
class BoxTree {
  public:
    explicit BoxTree(const std::vector<Box2>& boxes) {
        if (boxes.empty()) return;
        items_.reserve(boxes.size());
        for (const auto& [curve, item] : order_of(boxes))
            items_.push_back({boxes[static_cast<std::size_t>(item)], item});
        nodes_.reserve(boxes.size());
        build(0, static_cast<int>(items_.size()));
    }

    // Calls visit(item) for each box for which near(box) holds; near must be monotone.
    template <class Near, class Visit>
    void query(Near near, Visit visit) const {
        int stack[128];
        int top = 0;
        if (!nodes_.empty()) stack[top++] = 0;
        while (top > 0) {
            const int at = stack[--top];
            const Node& node = nodes_[static_cast<std::size_t>(at)];
            if (!near(node.box)) continue;
            if (node.right < 0) {
                for (int i = node.first; i < node.last; ++i) {
                    const Item& item = items_[static_cast<std::size_t>(i)];
                    if (near(item.box)) visit(item.id);
                }
            } else {
                stack[top++] = node.right;
                stack[top++] = at + 1;
            }
        }
    }

  private:
    struct Node {
        Box2 box;
        int first, last, right;  // right < 0: a leaf; the left child follows its parent
    };
    struct Item {
        Box2 box;
        int id;
    };
    static constexpr int kLeaf = 4;

    static std::uint32_t spread(std::uint32_t v) {  // bits of v < 2^16 to the even places
        v = (v | (v << 8)) & 0x00ff00ffu;
        v = (v | (v << 4)) & 0x0f0f0f0fu;
        v = (v | (v << 2)) & 0x33333333u;
        return (v | (v << 1)) & 0x55555555u;
    }

    static std::vector<std::pair<std::uint32_t, int>> order_of(const std::vector<Box2>& boxes) {
        Box2 all = boxes.front();
        for (const Box2& b : boxes) all.add(b);
        const std::int64_t extent = 2 * std::max<std::int64_t>(std::int64_t{all.x1} - all.x0,
                                                               std::int64_t{all.y1} - all.y0);
        int shift = 0;
        while ((extent >> shift) > 0xffff) ++shift;
        const auto cell = [&](std::int64_t sum, std::int64_t least) {
            return spread(static_cast<std::uint32_t>((sum - 2 * least) >> shift));
        };
        std::vector<std::pair<std::uint32_t, int>> order;
        order.reserve(boxes.size());
        for (const Box2& b : boxes)
            order.emplace_back(cell(std::int64_t{b.x0} + b.x1, all.x0) |
                                   cell(std::int64_t{b.y0} + b.y1, all.y0) << 1,
                               static_cast<int>(order.size()));
        std::sort(order.begin(), order.end());
        return order;
    }

    Box2 build(int first, int last) {
        const std::size_t self = nodes_.size();
        nodes_.push_back({{}, first, last, -1});
        Box2 box = items_[static_cast<std::size_t>(first)].box;
        if (last - first <= kLeaf) {
            for (int i = first + 1; i < last; ++i) box.add(items_[static_cast<std::size_t>(i)].box);
        } else {
            const int middle = (first + last) / 2;
            box = build(first, middle);
            nodes_[self].right = static_cast<int>(nodes_.size());
            box.add(build(middle, last));
        }
        nodes_[self].box = box;
        return box;
    }

    std::vector<Item> items_;
    std::vector<Node> nodes_;
};

}  // namespace tetra::fence

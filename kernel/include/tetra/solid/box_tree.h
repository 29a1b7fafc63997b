// SPDX-License-Identifier: LGPL-2.1-or-later
// A balanced tree of axis-aligned boxes over triangles, for overlap and vertical-line queries.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "tetra/solid/grid_solid.h"

namespace tetra {

struct Box {
    Vec3i low, high;
};

inline bool boxes_touch(const Box& a, const Box& b) {
    return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] &&
           b.low[1] <= a.high[1] && a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

// Nodes lie in one array: node i covers order[begin..end) and has its children at `left` and
// left + 1, or is a leaf (left < 0). Depth is logarithmic.
struct BoxTree {
    struct Node {
        Box box;
        int begin, end, left;
    };
    std::vector<Box> boxes;  // per triangle
    std::vector<int> order;
    std::vector<Node> nodes;
};

BoxTree build_box_tree(std::span<const Vec3i> points, std::span<const Triangle> triangles);

// Calls visit(s, t), s != t, once for every pair of triangles whose boxes touch.
template <class Visit>
void for_touching_boxes(const BoxTree& tree, Visit&& visit) {
    if (tree.nodes.empty()) return;
    const auto node = [&](int i) -> const BoxTree::Node& {
        return tree.nodes[static_cast<std::size_t>(i)];
    };
    const auto box = [&](int t) -> const Box& { return tree.boxes[static_cast<std::size_t>(t)]; };
    const auto leaves = [&](const BoxTree::Node& a, const BoxTree::Node& b, bool same) {
        for (int i = a.begin; i < a.end; ++i)
            for (int j = same ? i + 1 : b.begin; j < b.end; ++j) {
                const int s = tree.order[static_cast<std::size_t>(i)];
                const int t = tree.order[static_cast<std::size_t>(j)];
                if (boxes_touch(box(s), box(t))) visit(std::min(s, t), std::max(s, t));
            }
    };
    std::vector<std::pair<int, int>> stack{{0, 0}};
    while (!stack.empty()) {
        const auto [i, j] = stack.back();
        stack.pop_back();
        const BoxTree::Node &a = node(i), &b = node(j);
        if (i == j) {
            if (a.left < 0) {
                leaves(a, a, true);
            } else {
                stack.insert(stack.end(),
                             {{a.left, a.left}, {a.left + 1, a.left + 1}, {a.left, a.left + 1}});
            }
        } else if (boxes_touch(a.box, b.box)) {
            if (a.left < 0 && b.left < 0) {
                leaves(a, b, false);
            } else if (b.left < 0 || (a.left >= 0 && a.end - a.begin >= b.end - b.begin)) {
                stack.insert(stack.end(), {{a.left, j}, {a.left + 1, j}});
            } else {
                stack.insert(stack.end(), {{i, b.left}, {i, b.left + 1}});
            }
        }
    }
}

// Calls visit(t) for the triangles whose box meets `box`.
template <class Visit>
void for_boxes_touching(const BoxTree& tree, const Box& box, Visit&& visit) {
    if (tree.nodes.empty()) return;
    std::vector<int> stack{0};
    while (!stack.empty()) {
        const BoxTree::Node& a = tree.nodes[static_cast<std::size_t>(stack.back())];
        stack.pop_back();
        if (!boxes_touch(a.box, box)) continue;
        if (a.left >= 0) {
            stack.insert(stack.end(), {a.left, a.left + 1});
            continue;
        }
        for (int i = a.begin; i < a.end; ++i) {
            const int t = tree.order[static_cast<std::size_t>(i)];
            if (boxes_touch(tree.boxes[static_cast<std::size_t>(t)], box)) visit(t);
        }
    }
}

}  // namespace tetra

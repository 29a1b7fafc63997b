// SPDX-License-Identifier: LGPL-2.1-or-later
// Building the box tree: halves by the median along the longest side.
#include "tetra/solid/box_tree.h"

#include <numeric>

namespace tetra {
namespace {

constexpr int leaf_size = 4;

Box triangle_box(std::span<const Vec3i> points, const Triangle& t) {
    Box box{points[static_cast<std::size_t>(t[0])], points[static_cast<std::size_t>(t[0])]};
    for (const int v : {t[1], t[2]})
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::min(box.low[k], points[static_cast<std::size_t>(v)][k]);
            box.high[k] = std::max(box.high[k], points[static_cast<std::size_t>(v)][k]);
        }
    return box;
}

Box join(const BoxTree& tree, int begin, int end) {
    Box box = tree.boxes[static_cast<std::size_t>(tree.order[static_cast<std::size_t>(begin)])];
    for (int i = begin + 1; i < end; ++i) {
        const Box& b =
            tree.boxes[static_cast<std::size_t>(tree.order[static_cast<std::size_t>(i)])];
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::min(box.low[k], b.low[k]);
            box.high[k] = std::max(box.high[k], b.high[k]);
        }
    }
    return box;
}

std::size_t longest_side(const Box& box) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (box.high[k] - box.low[k] > box.high[best] - box.low[best]) best = k;
    return best;
}

}  // namespace

BoxTree build_box_tree(std::span<const Vec3i> points, std::span<const Triangle> triangles) {
    BoxTree tree;
    tree.boxes.reserve(triangles.size());
    for (const Triangle& t : triangles) tree.boxes.push_back(triangle_box(points, t));
    tree.order.resize(triangles.size());
    std::iota(tree.order.begin(), tree.order.end(), 0);
    if (triangles.empty()) return tree;
    const int n = static_cast<int>(triangles.size());
    tree.nodes.push_back({join(tree, 0, n), 0, n, -1});
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const BoxTree::Node node = tree.nodes[i];
        if (node.end - node.begin <= leaf_size) continue;
        const std::size_t k = longest_side(node.box);
        const int middle = node.begin + (node.end - node.begin) / 2;
        std::nth_element(tree.order.begin() + node.begin, tree.order.begin() + middle,
                         tree.order.begin() + node.end, [&](int s, int t) {
                             const Box &a = tree.boxes[static_cast<std::size_t>(s)],
                                       &b = tree.boxes[static_cast<std::size_t>(t)];
                             const std::int64_t x = a.low[k] + a.high[k], y = b.low[k] + b.high[k];
                             return x != y ? x < y : s < t;
                         });
        tree.nodes[i].left = static_cast<int>(tree.nodes.size());
        tree.nodes.push_back({join(tree, node.begin, middle), node.begin, middle, -1});
        tree.nodes.push_back({join(tree, middle, node.end), middle, node.end, -1});
    }
    return tree;
}

}  // namespace tetra

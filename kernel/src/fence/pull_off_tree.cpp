// SPDX-License-Identifier: LGPL-2.1-or-later
// Building the tree by median splits of the longest side.
#include "pull_off_tree.h"

#include <algorithm>

namespace tetra {
namespace {

constexpr int kLeafSize = 8;

GridBox box_of(const std::vector<Vec3i>& points, const int* first, const int* last) {
    GridBox box{points[static_cast<std::size_t>(*first)], points[static_cast<std::size_t>(*first)]};
    for (; first != last; ++first) {
        const Vec3i& p = points[static_cast<std::size_t>(*first)];
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] = std::min(box.lo[k], p[k]);
            box.hi[k] = std::max(box.hi[k], p[k]);
        }
    }
    return box;
}

}  // namespace

PointTree::PointTree(const std::vector<Vec3i>& points, std::vector<int> ids)
    : ids_(std::move(ids)), place_(points.size(), -1), leaf_(points.size(), -1) {
    if (ids_.empty()) return;
    build(points, 0, static_cast<int>(ids_.size()), -1);
    for (std::size_t i = 0; i < ids_.size(); ++i)
        place_[static_cast<std::size_t>(ids_[i])] = static_cast<int>(i);
}

int PointTree::build(const std::vector<Vec3i>& points, int begin, int end, int parent) {
    const int index = static_cast<int>(nodes_.size());
    int* const first = ids_.data() + begin;
    int* const last = ids_.data() + end;
    const GridBox box = box_of(points, first, last);
    nodes_.push_back({box, begin, end, end - begin, -1, -1, parent});
    if (end - begin <= kLeafSize) {
        for (const int* id = first; id != last; ++id) leaf_[static_cast<std::size_t>(*id)] = index;
        return index;
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (box.hi[k] - box.lo[k] > box.hi[axis] - box.lo[axis]) axis = k;
    const int middle = begin + (end - begin) / 2;
    std::nth_element(first, ids_.data() + middle, last, [&](int a, int b) {
        const auto ca = points[static_cast<std::size_t>(a)][axis];
        const auto cb = points[static_cast<std::size_t>(b)][axis];
        return ca != cb ? ca < cb : a < b;
    });
    const int left = build(points, begin, middle, index);
    const int right = build(points, middle, end, index);
    nodes_[static_cast<std::size_t>(index)].left = left;
    nodes_[static_cast<std::size_t>(index)].right = right;
    return index;
}

void PointTree::erase(int id) {
    int& place = place_[static_cast<std::size_t>(id)];
    if (place < 0) return;
    ids_[static_cast<std::size_t>(place)] = -1;
    place = -1;
    for (int n = leaf_[static_cast<std::size_t>(id)]; n >= 0;
         n = nodes_[static_cast<std::size_t>(n)].parent)
        --nodes_[static_cast<std::size_t>(n)].live;
}

}  // namespace tetra

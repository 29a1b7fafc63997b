// SPDX-License-Identifier: LGPL-2.1-or-later
// A static kd-tree over grid points that forgets points one by one.
#pragma once

#include <vector>

#include "tetra/exact/grid.h"

namespace tetra {

struct GridBox {
    Vec3i lo, hi;
};

class PointTree {
  public:
    PointTree(const std::vector<Vec3i>& points, std::vector<int> ids);

    void erase(int id);

    // The first live point for which hit(id) holds, among the boxes for which may_hold(box) does;
    // -1 if there is none.
    template <class MayHold, class Hit>
    int find(const MayHold& may_hold, const Hit& hit) const {
        if (nodes_.empty()) return -1;
        int stack[2 * 64];  // two for each level
        int top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Node& node = nodes_[static_cast<std::size_t>(stack[--top])];
            if (node.live == 0 || !may_hold(node.box)) continue;
            if (node.right < 0) {
                for (int i = node.begin; i < node.end; ++i) {
                    const int id = ids_[static_cast<std::size_t>(i)];
                    if (id >= 0 && hit(id)) return id;
                }
            } else {
                stack[top++] = node.right;
                stack[top++] = node.left;
            }
        }
        return -1;
    }

  private:
    struct Node {
        GridBox box;
        int begin, end, live;
        int left, right, parent;
    };
    int build(const std::vector<Vec3i>& points, int begin, int end, int parent);

    std::vector<Node> nodes_;
    std::vector<int> ids_;    // -1 where erased
    std::vector<int> place_;  // id -> index in ids_
    std::vector<int> leaf_;   // id -> node
};

}  // namespace tetra

// SPDX-License-Identifier: LGPL-2.1-or-later
// Which triangles may lie in a slab about a plane: a box tree that also knows their normals.
#pragma once

#include <array>
#include <vector>

#include "tetra/solid/box_tree.h"

namespace tetra::notch {

using Unit = std::array<double, 4>;  // unit normal and offset of a plane

class PlaneIndex {
  public:
    // Triangle i lies in the plane units[i]; slabs reach `delta` to either side of their plane.
    PlaneIndex(const std::vector<Vec3i>& points, const std::vector<Triangle>& triangles,
               const std::vector<Unit>& units, double delta);

    // Calls visit(i) for all triangles within the slab about a plane, and for few others.
    template <class Visit>
    void for_near(const Unit& plane, Visit&& visit) const {
        std::vector<int> stack;
        if (!tree_.nodes.empty()) stack.push_back(0);
        while (!stack.empty()) {
            const auto i = static_cast<std::size_t>(stack.back());
            stack.pop_back();
            const BoxTree::Node& node = tree_.nodes[i];
            if (!spreads_[i].may_hold(plane) || !meets_slab(node.box, plane)) continue;
            if (node.left >= 0)
                stack.insert(stack.end(), {node.left, node.left + 1});
            else
                for (int k = node.begin; k < node.end; ++k)
                    visit(tree_.order[static_cast<std::size_t>(k)]);
        }
    }

  private:
    // Normals of a node up to sign, and how far from a plane's normal one of them may be when its
    // triangle lies in the slab.
    struct Spread {
        Vec3d low{}, high{};
        double slack = 0;
        bool may_hold(const Unit& plane) const;
    };

    bool meets_slab(const Box& box, const Unit& plane) const;

    double delta_;
    BoxTree tree_;
    std::vector<Spread> spreads_;  // per node
};

}  // namespace tetra::notch

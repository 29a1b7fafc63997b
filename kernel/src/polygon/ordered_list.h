// SPDX-License-Identifier: LGPL-2.1-or-later
// A sequence of small integers with insertion beside a known element and monotone search.
#pragma once

#include <cstdint>
#include <vector>

namespace tetra {

/// A treap over the elements 0, 1, 2, ...: every operation is O(log n) expected. Priorities are a
/// hash of the element, so that runs are repeatable; the sequence never depends on them.
class OrderedList {
  public:
    static constexpr int none = -1;

    bool empty() const { return root_ == none; }

    /// Puts a new element behind `place`, or at the front when that is none.
    void insert_after(int place, int element);

    void erase(int element);

    /// The element behind, or none; behind none comes the first element.
    int next(int element) const;

    /// The element before, or none.
    int previous(int element) const;

    /// The last element for which the test holds, or none.
    /// \pre the test holds for a leading part of the sequence and for nothing else.
    template <typename Test>
    int last_where(Test&& test) const {
        int found = none;
        for (int at = root_; at != none;) {
            const bool holds = test(at);
            if (holds) {
                found = at;
            }
            at = nodes_[at].child[holds ? 1 : 0];
        }
        return found;
    }

  private:
    struct Node {
        int parent = none;
        int child[2] = {none, none};
        std::uint32_t priority = 0;
    };

    int first_below(int top) const;
    void hang(int element, int parent, int side);
    void rotate_up(int element);
    int neighbour(int element, int side) const;

    std::vector<Node> nodes_;
    int root_ = none;
};

}  // namespace tetra

// SPDX-License-Identifier: LGPL-2.1-or-later
// The treap behind OrderedList.

#include "ordered_list.h"

namespace tetra {

namespace {

std::uint32_t scatter(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352dU;
    x = (x ^ (x >> 15)) * 0x846ca68bU;
    return x ^ (x >> 16);
}

}  // namespace

void OrderedList::insert_after(int place, int element) {
    if (element >= static_cast<int>(nodes_.size())) {
        nodes_.resize(static_cast<std::size_t>(element) + 1);
    }
    nodes_[element] = Node{};
    nodes_[element].priority = scatter(static_cast<std::uint32_t>(element));
    // The gap behind an element is the empty right link of it, or an empty left link further down.
    const int at = place == none ? root_ : nodes_[place].child[1];
    if (at == none) {
        hang(element, place, 1);
    } else {
        hang(element, first_below(at), 0);
    }
    while (nodes_[element].parent != none &&
           nodes_[nodes_[element].parent].priority < nodes_[element].priority) {
        rotate_up(element);
    }
}

void OrderedList::erase(int element) {
    const Node& node = nodes_[element];
    while (node.child[0] != none && node.child[1] != none) {
        const bool right = nodes_[node.child[1]].priority > nodes_[node.child[0]].priority;
        rotate_up(node.child[right ? 1 : 0]);
    }
    const int rest = node.child[0] != none ? node.child[0] : node.child[1];
    if (node.parent == none) {
        root_ = rest;
    } else {
        Node& parent = nodes_[node.parent];
        parent.child[parent.child[1] == element ? 1 : 0] = rest;
    }
    if (rest != none) {
        nodes_[rest].parent = node.parent;
    }
}

int OrderedList::next(int element) const {
    if (element != none) {
        return neighbour(element, 1);
    }
    return root_ == none ? none : first_below(root_);
}

int OrderedList::previous(int element) const { return neighbour(element, 0); }

int OrderedList::first_below(int top) const {
    while (nodes_[top].child[0] != none) {
        top = nodes_[top].child[0];
    }
    return top;
}

void OrderedList::hang(int element, int parent, int side) {
    nodes_[element].parent = parent;
    if (parent == none) {
        root_ = element;
    } else {
        nodes_[parent].child[side] = element;
    }
}

void OrderedList::rotate_up(int element) {
    const int parent = nodes_[element].parent;
    const int above = nodes_[parent].parent;
    const int side = nodes_[parent].child[1] == element ? 1 : 0;
    const int moved = nodes_[element].child[1 - side];
    nodes_[parent].child[side] = moved;
    if (moved != none) {
        nodes_[moved].parent = parent;
    }
    nodes_[element].child[1 - side] = parent;
    nodes_[parent].parent = element;
    const int above_side = above != none && nodes_[above].child[1] == parent ? 1 : 0;
    hang(element, above, above_side);
}

int OrderedList::neighbour(int element, int side) const {
    int at = nodes_[element].child[side];
    if (at != none) {
        while (nodes_[at].child[1 - side] != none) {
            at = nodes_[at].child[1 - side];
        }
        return at;
    }
    for (at = element; nodes_[at].parent != none; at = nodes_[at].parent) {
        if (nodes_[nodes_[at].parent].child[1 - side] == at) {
            return nodes_[at].parent;
        }
    }
    return none;
}

}  // namespace tetra

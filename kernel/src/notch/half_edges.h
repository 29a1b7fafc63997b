// SPDX-License-Identifier: LGPL-2.1-or-later
// Half-edges of all pieces: facets are not stored, an edge knows its oriented plane and its line.
#pragma once

#include <vector>

#include "point_table.h"

namespace tetra::notch {

// key = 2 plane + (the outward normal is the reverse of the stored one ? 1 : 0); the facet is on
// the left seen from outside. notch = id of the input notch this edge is a part of, else -1.
struct HalfEdge {
    int org = -1;  // -1: deleted
    int next = -1, prev = -1, twin = -1;
    int key = -1;
    int line = -1;
    int notch = -1;
};

constexpr int plane_of(int key) { return key >> 1; }
constexpr int opposite_key(int key) { return key ^ 1; }
constexpr int key_sign(int key) { return (key & 1) ? -1 : 1; }

class HalfEdges {
  public:
    HalfEdge& operator[](int h) { return pool_[h]; }
    const HalfEdge& operator[](int h) const { return pool_[h]; }
    int dest(int h) const { return pool_[pool_[h].twin].org; }
    bool alive(int h) const { return pool_[h].org >= 0; }
    int size() const { return static_cast<int>(pool_.size()); }

    int add(int org, int key, int line, int notch = -1);
    void remove(int h);
    void link(int from, int to) {
        pool_[from].next = to;
        pool_[to].prev = from;
    }
    void pair(int a, int b) {
        pool_[a].twin = b;
        pool_[b].twin = a;
    }
    // Puts a vertex into an edge; returns the new half-edge from it to the old end of h.
    int split(int h, int point);
    // Removes an edge between two facets of one key; appends half-edges whose corners changed.
    void dissolve(int h, std::vector<int>& touched);
    // Removes the origin of h if it has two edges of one straight line; returns whether it did.
    bool straighten(int h);

  private:
    bool straight(int h) const;
    std::vector<HalfEdge> pool_;
    std::vector<int> free_;
};

}  // namespace tetra::notch

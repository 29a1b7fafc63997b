// SPDX-License-Identifier: LGPL-2.1-or-later
// Local surgery on half-edges that keeps every piece closed.
#include "half_edges.h"

namespace tetra::notch {

int HalfEdges::add(int org, int key, int line, int notch) {
    int h;
    if (free_.empty()) {
        h = size();
        pool_.emplace_back();
    } else {
        h = free_.back();
        free_.pop_back();
        pool_[h] = HalfEdge();
    }
    pool_[h].org = org;
    pool_[h].key = key;
    pool_[h].line = line;
    pool_[h].notch = notch;
    return h;
}

void HalfEdges::remove(int h) {
    pool_[h].org = -1;
    free_.push_back(h);
}

int HalfEdges::split(int h, int point) {
    const int t = pool_[h].twin;
    const int h2 = add(point, pool_[h].key, pool_[h].line, pool_[h].notch);
    const int t2 = add(point, pool_[t].key, pool_[t].line, pool_[t].notch);
    link(h2, pool_[h].next);
    link(h, h2);
    link(t2, pool_[t].next);
    link(t, t2);
    pair(h, t2);
    pair(h2, t);
    return h2;
}

void HalfEdges::dissolve(int h, std::vector<int>& touched) {
    const int t = pool_[h].twin;
    const int before_h = pool_[h].prev, after_h = pool_[h].next;
    const int before_t = pool_[t].prev, after_t = pool_[t].next;
    if (before_h != t) {
        link(before_h, after_t);
        touched.push_back(after_t);
    }
    if (before_t != h) {
        link(before_t, after_h);
        touched.push_back(after_h);
    }
    remove(h);
    remove(t);
}

bool HalfEdges::straight(int h) const {
    const int t = pool_[h].twin;
    const int before = pool_[h].prev, after_t = pool_[t].next;
    if (pool_[before].twin != after_t || before == t) return false;
    if (pool_[h].line == pool_[before].line) return true;
    // Two edges between the same two planes are collinear, unless the planes are one (a slit).
    return plane_of(pool_[h].key) != plane_of(pool_[t].key) &&
           pool_[h].notch == pool_[before].notch;
}

bool HalfEdges::straighten(int h) {
    if (!straight(h)) return false;
    const int t = pool_[h].twin;
    const int before = pool_[h].prev, after_t = pool_[t].next;
    // `before` takes over the whole edge; t ends where after_t did.
    link(before, pool_[h].next);
    link(t, pool_[after_t].next);
    pair(before, t);
    // Both sides must meet a plane in one point, also where planes and input edge differ a little.
    pool_[t].line = pool_[before].line;
    remove(h);
    remove(after_t);
    return true;
}

}  // namespace tetra::notch

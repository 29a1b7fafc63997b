// SPDX-License-Identifier: LGPL-2.1-or-later
// The ordered stack of floors and ceilings in the strip just beside a line (rules R3, R4).
#pragma once

#include "box_tree.h"
#include "plan.h"

namespace tetra::fence {

// Finds the facets over a place infinitely near a grid point.
class Stabber {
  public:
    explicit Stabber(const Plan& plan);

    // Non-vertical facets over the point moved a little along the line and less to either side.
    void facets_beside(const Line& line, const Vec3i& point, std::vector<int>& right,
                       std::vector<int>& left) const;

  private:
    const Plan& plan_;
    std::vector<int> triangles_;
    BoxTree tree_;
};

// Facets of one strip, and the consecutive (floor, ceiling) pairs they make.
class Stack {
  public:
    Stack(const Plan& plan, bool left) : plan_(plan), left_(left) {}

    std::vector<int>& facets() { return facets_; }
    int pair_count() const { return static_cast<int>(facets_.size() / 2); }
    int floor(int pair) const { return at(facets_, 2 * pair); }
    int ceiling(int pair) const { return at(facets_, 2 * pair + 1); }

    void toggle(int facet);
    // Sorts bottom up for the strip between two plan points of the line. `edge_of` names for each
    // facet an edge that bounds it over this stretch, or is negative.
    // \throw InvalidSolid when floors and ceilings do not alternate.
    void sort(const Line& line, int from, int to, const std::vector<int>& edge_of);

  private:
    struct Entry {
        int facet;
        int edge;
        Height from, to;
    };
    int compare(const Entry& s, const Entry& t, const Line& line, int from, int to) const;
    void check_alternation() const;
    [[noreturn]] void refuse_contact(std::size_t i) const;

    const Plan& plan_;
    bool left_;
    std::vector<int> facets_;
    std::vector<Entry> entries_;
};

}  // namespace tetra::fence

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

    // To be filled in any order at the start of a stretch, then arrange() with `all`.
    std::vector<int>& facets() { return facets_; }
    int pair_count() const { return static_cast<int>(facets_.size() / 2); }
    int floor(int pair) const { return at(facets_, 2 * pair); }
    int ceiling(int pair) const { return at(facets_, 2 * pair + 1); }

    // The facet leaves or enters at the next arrange(); twice: leaves and enters again.
    void toggle(int facet);
    bool changed() const;

    // Where a strip lies: between two plan points of the line. `edge_of` names for each facet an
    // edge that bounds it over this stretch, or is negative.
    struct Strip {
        const Line& line;
        int from, to;
        const std::vector<int>& edge_of;
    };
    // Puts the facets into their order, bottom up. Those that stay keep their order among
    // themselves, as facets do not cross: only entering ones are compared, unless `all` are new.
    // \throw InvalidSolid when floors and ceilings do not alternate.
    void arrange(const Strip& strip, bool all);

  private:
    struct Toggled {
        int facet;
        bool odd;
    };
    struct Entry {
        int facet;
        int edge;
        Height from, to;
    };
    Entry entry(int facet, const Strip& strip) const;
    int compare(const Entry& s, const Entry& t, const Strip& strip) const;
    bool below(const Entry& s, const Entry& t, const Strip& strip) const;
    void sort_all(const Strip& strip);
    void move_toggled(const Strip& strip);
    void check_alternation() const;
    [[noreturn]] void refuse_contact(int lower, int upper) const;

    const Plan& plan_;
    bool left_;
    std::vector<int> facets_;
    std::vector<Toggled> toggled_;
    std::vector<Entry> entries_;
};

}  // namespace tetra::fence

// SPDX-License-Identifier: LGPL-2.1-or-later
// Stabbing queries at infinitely near places, and the order within a strip.
#include "stacks.h"

#include <algorithm>

#include "tetra/errors.h"

namespace tetra::fence {
namespace {

std::vector<int> triangles_seen_from_above(const Plan& plan) {
    std::vector<int> list;
    for (int t = 0; t < static_cast<int>(plan.facet_of.size()); ++t)
        if (at(plan.facets, at(plan.facet_of, t)).side != 0) list.push_back(t);
    return list;
}

std::vector<Box2> boxes_of(const Plan& plan, const std::vector<int>& triangles) {
    std::vector<Box2> boxes;
    boxes.reserve(triangles.size());
    for (const int t : triangles) {
        const Triangle& tri = at(plan.input->triangles, t);
        Box2 box = box_around(plan.at(tri[0]), plan.at(tri[1]));
        box.add(box_around(plan.at(tri[2])));
        boxes.push_back(box);
    }
    return boxes;
}

// Sides of u -> v on which two places lie, +1 = left: p + e (dx, dy) -+ e^2 (-dy, dx) with e
// infinitely small, right and left of the line.
struct Sides {
    int right, left;
};
Sides sides_of(const Vec3i& u, const Vec3i& v, const Vec3i& p, const Line& line) {
    const auto both = [](std::int64_t s) { return s > 0 ? Sides{1, 1} : Sides{-1, -1}; };
    const std::int64_t ex = v[0] - u[0], ey = v[1] - u[1];
    const std::int64_t s = ex * (p[1] - u[1]) - ey * (p[0] - u[0]);
    if (s != 0) return both(s);
    const std::int64_t along = ex * line.dy - ey * line.dx;
    if (along != 0) return both(along);
    return ex * line.dx + ey * line.dy > 0 ? Sides{-1, 1} : Sides{1, -1};
}

}  // namespace

Stabber::Stabber(const Plan& plan)
    : plan_(plan), triangles_(triangles_seen_from_above(plan)), tree_(boxes_of(plan, triangles_)) {}

void Stabber::facets_beside(const Line& line, const Vec3i& point, std::vector<int>& right,
                            std::vector<int>& left) const {
    right.clear();
    left.clear();
    const Box2 place = box_around(point);
    const auto visit = [&](int item) {
        const int t = at(triangles_, item);
        const Triangle& tri = at(plan_.input->triangles, t);
        const int facet = at(plan_.facet_of, t), up = at(plan_.facets, facet).side;
        bool in_right = true, in_left = true;
        for (std::size_t k = 0; k < 3 && (in_right || in_left); ++k) {
            const Sides s = sides_of(plan_.at(tri[k]), plan_.at(tri[(k + 1) % 3]), point, line);
            in_right = in_right && s.right == up;
            in_left = in_left && s.left == up;
        }
        if (in_right) right.push_back(facet);
        if (in_left) left.push_back(facet);
    };
    tree_.query([&](const Box2& box) { return box.meets(place); }, visit);
}

void Stack::toggle(int facet) {
    const auto place = std::ranges::find(toggled_, facet, &Toggled::facet);
    if (place == toggled_.end())
        toggled_.push_back({facet, true});
    else
        place->odd = !place->odd;
}

bool Stack::changed() const {
    return std::ranges::any_of(toggled_, [&](const Toggled& t) {
        return t.odd || std::ranges::find(facets_, t.facet) != facets_.end();
    });
}

Stack::Entry Stack::entry(int facet, const Strip& strip) const {
    const Surface& s = at(plan_.surfaces, facet);
    return {facet, at(strip.edge_of, facet), height(s, plan_.points[strip.from]),
            height(s, plan_.points[strip.to])};
}

// Sign of s against t in the strip; 0 when both lie in one plane.
int Stack::compare(const Entry& s, const Entry& t, const Strip& strip) const {
    const Surface &a = at(plan_.surfaces, s.facet), &b = at(plan_.surfaces, t.facet);
    const Line& line = strip.line;
    int order = 0;
    if (s.edge < 0 || s.edge != t.edge) {
        order = compare_heights(a, s.from, b, t.from, plan_.points[strip.from]);
        if (order == 0) order = compare_heights(a, s.to, b, t.to, plan_.points[strip.to]);
    }
    if (order == 0)
        order = compare_slopes(a, b, left_ ? -line.dy : line.dy, left_ ? line.dx : -line.dx);
    return order;
}

bool Stack::below(const Entry& s, const Entry& t, const Strip& strip) const {
    int order = compare(s, t, strip);
    if (order == 0) order = at(plan_.facets, t.facet).side - at(plan_.facets, s.facet).side;
    return order != 0 ? order < 0 : s.facet < t.facet;
}

void Stack::arrange(const Strip& strip, bool all) {
    if (all)
        sort_all(strip);
    else
        move_toggled(strip);
    toggled_.clear();
}

void Stack::sort_all(const Strip& strip) {
    entries_.clear();
    for (const int f : facets_) entries_.push_back(entry(f, strip));
    std::sort(entries_.begin(), entries_.end(),
              [&](const Entry& s, const Entry& t) { return below(s, t, strip); });
    for (std::size_t i = 0; i < entries_.size(); ++i) facets_[i] = entries_[i].facet;
    check_alternation();
    for (std::size_t i = 1; i + 1 < entries_.size(); i += 2)
        if (compare(entries_[i], entries_[i + 1], strip) == 0)
            refuse_contact(facets_[i], facets_[i + 1]);
}

void Stack::move_toggled(const Strip& strip) {
    // One that leaves and enters in the same point may have passed others that end in it.
    std::erase_if(toggled_, [&](const Toggled& t) {
        const auto place = std::ranges::find(facets_, t.facet);
        const bool present = place != facets_.end();
        if (present) facets_.erase(place);
        return present == t.odd;
    });
    for (const auto& [facet, odd] : toggled_) {
        const Entry fresh = entry(facet, strip);
        const auto place = std::partition_point(facets_.begin(), facets_.end(), [&](int other) {
            return below(entry(other, strip), fresh, strip);
        });
        facets_.insert(place, facet);
    }
    check_alternation();
    for (const auto& [facet, odd] : toggled_) {
        const auto i = static_cast<std::size_t>(std::find(facets_.begin(), facets_.end(), facet) -
                                                facets_.begin());
        // The space above a ceiling, or below a floor.
        const std::size_t lower = i % 2 == 1 ? i : i - 1;
        if (i == 0 || lower + 1 >= facets_.size()) continue;
        if (compare(entry(facets_[lower], strip), entry(facets_[lower + 1], strip), strip) == 0)
            refuse_contact(facets_[lower], facets_[lower + 1]);
    }
}

void Stack::check_alternation() const {
    std::size_t bad = facets_.size() % 2 == 0 ? facets_.size() : facets_.size() - 1;
    for (std::size_t i = facets_.size(); i-- > 0;)
        if (at(plan_.facets, facets_[i]).side != (i % 2 == 0 ? -1 : 1)) bad = i;
    if (bad == facets_.size()) return;
    Defect defect{
        "self_crossing",
        {},
        {},
        "floors and ceilings do not alternate along a vertical line: the surface crosses "
        "or touches itself near the listed triangles; repair them or snap to a finer grid"};
    for (std::size_t i = bad > 0 ? bad - 1 : 0; i < std::min(bad + 2, facets_.size()); ++i)
        defect.triangles.push_back(at(plan_.facets, facets_[i]).triangle);
    throw InvalidSolid({defect});
}

// Rule R12: a ceiling with a floor back to back on it.
void Stack::refuse_contact(int lower, int upper) const {
    throw InvalidSolid({{"face_contact",
                         {},
                         {at(plan_.facets, lower).triangle, at(plan_.facets, upper).triangle},
                         "two shells share part of a face; join them, separate them, or make them "
                         "different solids"}});
}

}  // namespace tetra::fence

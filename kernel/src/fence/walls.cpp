// SPDX-License-Identifier: LGPL-2.1-or-later
// Sweeps the covered stretches of every line and records where the stacks beside it differ.
#include "walls.h"

#include <algorithm>
#include <cassert>

#include "stacks.h"

namespace tetra::fence {
namespace {

std::vector<Box2> boxes_of_obstacles(const Plan& plan) {
    std::vector<Box2> boxes;
    boxes.reserve(plan.edges.size() + plan.flat_points.size());
    for (const SharpEdge& e : plan.edges) boxes.push_back(box_around(plan.at(e.u), plan.at(e.v)));
    for (const int v : plan.flat_points) boxes.push_back(box_around(plan.at(v)));
    return boxes;
}

std::int64_t turn(const Vec3i& a, const Vec3i& b, const Vec3i& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

int sign(std::int64_t v) { return (v > 0) - (v < 0); }

class Sweep {
  public:
    explicit Sweep(Plan& plan)
        : plan_(plan),
          stabber_(plan),
          obstacles_(boxes_of_obstacles(plan)),
          stacks_{Stack(plan, false), Stack(plan, true)},
          edge_of_(plan.facets.size(), -1),
          ceiling_of_(plan.facets.size(), -1),
          ceiling_stamp_(plan.facets.size(), -1) {
        walls_.chains.offset.push_back(0);  // chain 0 is empty
    }

    Walls run(Progress& progress, const WallSample& sample) {
        const int n = static_cast<int>(plan_.lines.size());
        for (int l = 0; l < n && sides_ < sample.enough; l += sample.stride) {
            progress.poll("fences", 0.5 * l / n);
            const std::size_t points = walls_.points.size(), runs = walls_.runs.size();
            sweep_line(l);
            const auto ends =
                std::count_if(walls_.points.begin() + static_cast<long>(points),
                              walls_.points.end(), [](const WallPoint& w) { return w.active; });
            sides_ += ends - static_cast<std::int64_t>(walls_.runs.size() - runs);
        }
        group_by_run();
        walls_.sides = sides_;
        return std::move(walls_);
    }

  private:
    // What happens at a plan point of the line.
    struct Event {
        int point;
        int edge;          // that crosses the line or touches it; -1 for a point only
        bool left, right;  // the strips it crosses
    };
    struct OpenWall {
        int run;
        int chain;
    };

    // Rule R3, last part: only stretches covered by edges of the line can hold walls.
    void sweep_line(int l) {
        const std::span<const int> own = plan_.line_edges[l];
        const auto axis = static_cast<std::size_t>(at(plan_.lines, l).axis);
        for (std::size_t i = 0; i < own.size();) {
            int last_point = at(plan_.edges, own[i]).v;
            std::size_t j = i + 1;
            for (; j < own.size(); ++j) {
                const SharpEdge& e = at(plan_.edges, own[j]);
                if (plan_.at(e.u)[axis] > plan_.at(last_point)[axis]) break;
                if (plan_.at(e.v)[axis] > plan_.at(last_point)[axis]) last_point = e.v;
            }
            sweep_stretch(l, own.subspan(i, j - i), at(plan_.edges, own[i]).u, last_point);
            i = j;
        }
    }

    void sweep_stretch(int l, std::span<const int> own, int first, int last) {
        const Line& line = at(plan_.lines, l);
        line_ = l;
        collect_events(line, own, plan_.at(first), plan_.at(last));
        stabber_.facets_beside(line, plan_.at(first), stacks_[0].facets(), stacks_[1].facets());
        open_.clear();
        own_active_.clear();
        std::size_t next_own = 0;
        bool first_strip = true;
        for (std::size_t i = 0; i < events_.size();) {
            const int point = events_[i].point;
            for (; i < events_.size() && events_[i].point == point; ++i) pass(events_[i]);
            bool own_changed = next_own == 0;
            own_changed |= std::erase_if(own_active_, [&](int e) {
                               return at(plan_.point_of, at(plan_.edges, e).v) == point;
                           }) > 0;
            for (; next_own < own.size() && start_of(own[next_own]) == point; ++next_own) {
                own_active_.push_back(own[next_own]);
                own_changed = true;
            }
            if (i == events_.size()) {
                close_walls(point);
                return;
            }
            const bool changed =
                arrange_stacks({line, point, events_[i].point, edge_of_}, first_strip);
            for (const int e : own_active_) note_edge(point, e);
            if (changed || own_changed)
                build_walls(point, events_[i].point);
            else
                continue_walls(point);
            first_strip = false;
        }
    }

    // False when both stay as they are.
    bool arrange_stacks(const Stack::Strip& strip, bool all) {
        if (!all && !stacks_[0].changed() && !stacks_[1].changed()) return false;
        name_edges(true);
        for (Stack& stack : stacks_)
            if (all || stack.changed()) stack.arrange(strip, all);
        name_edges(false);
        return true;
    }

    // Facets that hang on an edge of the line have its height over it: no arithmetic is needed.
    void name_edges(bool on) {
        for (const int e : own_active_)
            for (const int f : plan_.edge_facets[e]) at(edge_of_, f) = on ? e : -1;
    }

    int start_of(int edge) const { return at(plan_.point_of, at(plan_.edges, edge).u); }

    void pass(const Event& event) {
        if (event.edge < 0) return;
        note_edge(event.point, event.edge);
        // The first point is behind the place where the stacks were found.
        if (event.point == first_point_) return;
        for (const int f : plan_.edge_facets[event.edge]) {
            if (at(plan_.facets, f).side == 0) continue;
            if (event.right) stacks_[0].toggle(f);
            if (event.left) stacks_[1].toggle(f);
        }
    }

    void note_edge(int point, int edge) {
        walls_.edge_at.push_back(edge);
        walls_.edge_at_point.push_back(point);
    }

    void collect_events(const Line& line, std::span<const int> own, const Vec3i& a,
                        const Vec3i& b) {
        events_.clear();
        for (const int e : own) {
            const SharpEdge& edge = at(plan_.edges, e);
            events_.push_back({at(plan_.point_of, edge.u), e, false, false});
            events_.push_back({at(plan_.point_of, edge.v), e, false, false});
        }
        const Box2 stretch = box_around(a, b);
        const auto near = [&](const Box2& box) {
            if (!box.meets(stretch)) return false;
            const std::int64_t up = line.dx >= 0 ? line.dx * box.y1 : line.dx * box.y0;
            const std::int64_t down = line.dx >= 0 ? line.dx * box.y0 : line.dx * box.y1;
            const std::int64_t most = line.dy >= 0 ? line.dy * box.x1 : line.dy * box.x0;
            const std::int64_t least = line.dy >= 0 ? line.dy * box.x0 : line.dy * box.x1;
            return down - most <= line.c && line.c <= up - least;
        };
        obstacles_.query(near, [&](int item) { add_meeting(line, item, a, b); });
        std::sort(events_.begin(), events_.end(), [&](const Event& s, const Event& t) {
            const int order = plan_.points.compare_axis(line.axis, s.point, t.point);
            return order != 0 ? order < 0 : s.edge < t.edge;
        });
        first_point_ = events_.front().point;
    }

    // The obstacle meets the stretch a-b in one point, or not at all, or lies in its line.
    void add_meeting(const Line& line, int item, const Vec3i& a, const Vec3i& b) {
        const auto edge_count = static_cast<int>(plan_.edges.size());
        if (item >= edge_count) {
            const int v = at(plan_.flat_points, item - edge_count);
            if (line.side(plan_.at(v)) == 0) add_touching(line, -1, v, a, b, false, false);
            return;
        }
        const SharpEdge& e = at(plan_.edges, item);
        if (e.line == line_) return;
        const Vec3i &u = plan_.at(e.u), &v = plan_.at(e.v);
        const std::int64_t su = line.side(u), sv = line.side(v);
        if ((su > 0 && sv > 0) || (su < 0 && sv < 0)) return;
        const bool left = (su > 0) != (sv > 0), right = (su < 0) != (sv < 0);
        if (su == 0 || sv == 0) {
            add_touching(line, item, su == 0 ? e.u : e.v, a, b, left, right);
            return;
        }
        if (sign(turn(u, v, a)) * sign(turn(u, v, b)) > 0) return;
        const auto coordinate = [&](std::size_t k) {
            return static_cast<Int128>(sv) * u[k] - static_cast<Int128>(su) * v[k];
        };
        events_.push_back(
            {plan_.points.crossing(coordinate(0), coordinate(1), sv - su), item, left, right});
    }

    void add_touching(const Line& line, int edge, int v, const Vec3i& a, const Vec3i& b, bool left,
                      bool right) {
        const auto k = static_cast<std::size_t>(line.axis);
        const std::int64_t t = plan_.at(v)[k];
        if (t < a[k] || t > b[k]) return;
        events_.push_back({at(plan_.point_of, v), edge, left, right});
    }

    // Rule R5: a pair that is not consecutive on the other side has a wall here.
    void build_walls(int from, int to) {
        wanted_.clear();
        for (int k = 0; k < 2; ++k) {
            const Stack &mine = stacks_[k], &other = stacks_[1 - k];
            ++stamp_;
            for (int i = 0; i < other.pair_count(); ++i) {
                at(ceiling_of_, other.floor(i)) = other.ceiling(i);
                at(ceiling_stamp_, other.floor(i)) = stamp_;
            }
            for (int i = 0; i < mine.pair_count(); ++i) {
                const int f = mine.floor(i), c = mine.ceiling(i);
                if (at(ceiling_stamp_, f) == stamp_ && at(ceiling_of_, f) == c) continue;
                want_wall({line_, k == 1, f, c}, from, to);
            }
        }
        close_walls(from);
        open_.swap(wanted_);
    }

    // Continues the open wall of the same run or opens one.
    void want_wall(const Run& run, int from, int to) {
        const int chain = chain_of(run, from, to);
        for (OpenWall& open : open_) {
            if (open.run < 0) continue;
            const Run& r = at(walls_.runs, open.run);
            if (r.left != run.left || r.floor != run.floor || r.ceiling != run.ceiling) continue;
            const int kept = same_chain(open.chain, chain) ? open.chain : chain;
            if (kept != chain && chain > 0) drop_last_chain();
            walls_.points.push_back({open.run, from, kept, kept != open.chain});
            wanted_.push_back({open.run, kept});
            open.run = -1;
            return;
        }
        const auto id = static_cast<int>(walls_.runs.size());
        walls_.runs.push_back(run);
        walls_.points.push_back({id, from, chain, true});
        wanted_.push_back({id, chain});
    }

    void drop_last_chain() {
        walls_.chains.offset.pop_back();
        walls_.chains.items.resize(static_cast<std::size_t>(walls_.chains.offset.back()));
    }

    bool same_chain(int s, int t) const {
        return std::ranges::equal(walls_.chains[s], walls_.chains[t]);
    }

    void continue_walls(int point) {
        for (const OpenWall& open : open_)
            walls_.points.push_back({open.run, point, open.chain, false});
    }

    void close_walls(int point) {
        for (const OpenWall& open : open_)
            if (open.run >= 0) walls_.points.push_back({open.run, point, -1, true});
        open_.clear();
    }

    // Edges of the line strictly between floor and ceiling, bottom up.
    int chain_of(const Run& run, int from, int to) {
        chain_.clear();
        for (const int e : own_active_)
            if (!bounds(e, run.floor) && !bounds(e, run.ceiling) &&
                above(plan_.edge_surface_id(e), run.floor, from, to) &&
                above(run.ceiling, plan_.edge_surface_id(e), from, to))
                chain_.push_back(e);
        if (chain_.empty()) return 0;
        std::sort(chain_.begin(), chain_.end(), [&](int s, int t) {
            const Surface& a = at(plan_.surfaces, plan_.edge_surface_id(s));
            const Surface& b = at(plan_.surfaces, plan_.edge_surface_id(t));
            int order = compare_heights(a, b, plan_.points[from]);
            if (order == 0) order = compare_heights(a, b, plan_.points[to]);
            return order != 0 ? order < 0 : s < t;
        });
        Lists& chains = walls_.chains;
        chains.items.insert(chains.items.end(), chain_.begin(), chain_.end());
        chains.offset.push_back(static_cast<int>(chains.items.size()));
        return static_cast<int>(chains.offset.size()) - 2;
    }

    bool bounds(int edge, int facet) const {
        return std::ranges::count(plan_.edge_facets[edge], facet) > 0;
    }

    // Is s above t between the two points, touching allowed at one of them?
    bool above(int s, int t, int from, int to) const {
        const Surface &a = at(plan_.surfaces, s), &b = at(plan_.surfaces, t);
        const int p = compare_heights(a, b, plan_.points[from]);
        if (p < 0) return false;
        const int q = compare_heights(a, b, plan_.points[to]);
        return q >= 0 && p + q > 0;
    }

    void group_by_run() {
        std::vector<int> key;
        key.reserve(walls_.points.size());
        for (const WallPoint& w : walls_.points) key.push_back(w.run);
        const Lists lists = group_by(key, static_cast<int>(walls_.runs.size()));
        std::vector<WallPoint> sorted;
        sorted.reserve(walls_.points.size());
        for (const int i : lists.items) sorted.push_back(at(walls_.points, i));
        walls_.points.swap(sorted);
        walls_.run_points = lists;
        for (int i = 0; i < static_cast<int>(walls_.points.size()); ++i)
            at(walls_.run_points.items, i) = i;
    }

    Plan& plan_;
    Stabber stabber_;
    BoxTree obstacles_;
    Walls walls_;
    Stack stacks_[2];  // right, left
    std::vector<Event> events_;
    std::vector<int> own_active_, chain_;
    std::vector<OpenWall> open_, wanted_;
    std::vector<int> edge_of_;  // per facet, while the stacks are sorted
    std::vector<int> ceiling_of_, ceiling_stamp_;
    int stamp_ = 0;
    std::int64_t sides_ = 0;
    int line_ = -1;
    int first_point_ = -1;
};

}  // namespace

Walls sweep_walls(Plan& plan, Progress& progress, const WallSample& sample) {
    return Sweep(plan).run(progress, sample);
}

}  // namespace tetra::fence

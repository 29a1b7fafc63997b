// SPDX-License-Identifier: LGPL-2.1-or-later
// Tracing a section: chords of facets, edges on the plane, contacts, sectors (NOTCHES 3.3 to 3.8).
#include "section.h"

#include <algorithm>
#include <cmath>

#include "section_components.h"

namespace tetra::notch {
namespace {

struct Event {
    int slot;
    int point;
    int half_edge;
    bool crossing;
    bool start;
};

// What the facets of one key have in common on the plane.
struct Slot {
    int key;
    Direction along;  // n_P x n_facet: chords run along it, Q on their left
    Dominant lead;    // of `along`
};

struct Ray {
    int point;
    int segment;
    bool leaving;
};

class Tracer {
  public:
    Tracer(PointTable& points, HalfEdges& edges, Piece& piece, int plane, Workspace& work)
        : points_(points), edges_(edges), piece_(piece), plane_(plane), work_(work) {
        const Dominant lead = dominant(points.plane(plane));
        frame_ = {lead.axis, lead.sign};
    }

    Section run(Extent extent, const std::vector<char>& own) {
        classify();
        split_plane_edges();
        collect_corners();
        join_chords();
        collect_plane_edges();
        section_.plane = plane_;
        link_sectors();
        select_components(points_, edges_, frame_, extent, own, section_);
        return std::move(section_);
    }

  private:
    [[noreturn]] void fail(const char* reason, std::vector<int> planes) {
        planes.push_back(plane_);
        throw Inconsistent{reason, std::move(planes)};
    }

    void classify() {
        ++work_.stamp;
        on_plane_.clear();
        work_.side.resize(points_.points());
        work_.side_stamp.resize(points_.points());
        for (const int h : piece_.edges) {
            const int v = edges_[h].org;
            if (work_.side_stamp[v] == work_.stamp) continue;
            work_.side_stamp[v] = work_.stamp;
            work_.side[v] = static_cast<signed char>(points_.side(v, plane_));
            if (work_.side[v] == 0) on_plane_.push_back(v);
        }
    }

    int side(int v) const { return work_.side[v]; }

    // The point where a crossing edge meets the plane.
    int crossing_point(int h) {
        const HalfEdge& e = edges_[h];
        const int v = points_.meet(e.line, plane_, plane_of(e.key), plane_of(edges_[e.twin].key));
        if (v >= static_cast<int>(work_.side.size())) {
            work_.side.resize(v + 1);
            work_.side_stamp.resize(v + 1);
        }
        if (work_.side_stamp[v] != work_.stamp) {
            work_.side_stamp[v] = work_.stamp;
            work_.side[v] = 0;
        } else if (work_.side[v] != 0) {
            fail("crossing point classified off the plane",
                 {plane_of(e.key), plane_of(edges_[e.twin].key)});
        }
        return v;
    }

    int slot_of(int key) {
        if (static_cast<int>(work_.slot.size()) <= key) {
            work_.slot.resize(2 * points_.planes() + 2);
            work_.slot_stamp.resize(2 * points_.planes() + 2);
        }
        if (work_.slot_stamp[key] == work_.stamp) return work_.slot[key];
        Slot s;
        s.key = key;
        s.along = points_.cross(plane_, plane_of(key));
        if (key_sign(key) < 0)
            for (Int128& c : s.along) c = -c;
        s.lead = dominant(s.along);
        if (s.lead.sign == 0) fail("facet parallel to the plane meets it", {plane_of(key)});
        work_.slot_stamp[key] = work_.stamp;
        work_.slot[key] = static_cast<int>(slots_.size());
        slots_.push_back(s);
        return work_.slot[key];
    }

    int along(const Slot& s, int a, int b) const {
        return s.lead.sign * points_.compare(a, b, s.lead.axis);
    }

    bool on_edge(int h) const { return side(edges_[h].org) == 0 && side(edges_.dest(h)) == 0; }

    // +1 when the half-edge runs along its facet's chord direction. Its facet is not parallel.
    int runs_along(int h) {
        return along(slots_[slot_of(edges_[h].key)], edges_.dest(h), edges_[h].org);
    }

    bool parallel(int key) const { return plane_of(key) == plane_; }

    // Contacts on edges that lie in the plane are split at once: it harms nothing (NOTCHES 3.5).
    void split_plane_edges() {
        plane_edges_.clear();
        for (const int h : piece_.edges)
            if (h < edges_[h].twin && on_edge(h)) plane_edges_.push_back(h);
        for (std::size_t i = 0; i < plane_edges_.size(); ++i) {
            const int h = plane_edges_[i];
            int facet = edges_[h].key;
            if (parallel(facet)) facet = edges_[edges_[h].twin].key;
            if (parallel(facet)) continue;
            for (int z = contact_on(h, facet); z >= 0; z = contact_on(h, facet)) {
                const int h2 = edges_.split(h, z);
                plane_edges_.push_back(h2);
                piece_.edges.push_back(h2);
                piece_.edges.push_back(edges_[h].twin);
            }
        }
    }

    // A vertex of the piece strictly inside an edge on the plane, or -1.
    int contact_on(int h, int facet) {
        const Slot& s = slots_[slot_of(facet)];
        const int u = edges_[h].org, w = edges_.dest(h);
        const int order = along(s, w, u);
        for (const int z : on_plane_) {
            if (z == u || z == w) continue;
            if (std::fabs(points_.distance(z, plane_of(facet))) > kClassReach) continue;
            if (order * along(s, z, u) <= 0 || order * along(s, w, z) <= 0) continue;
            if (points_.side(z, plane_of(facet)) == 0) return z;
        }
        return -1;
    }

    void add_event(int key, int point, int half_edge, bool crossing, bool start) {
        events_.push_back({slot_of(key), point, half_edge, crossing, start});
    }

    void collect_corners() {
        for (const int h : piece_.edges) {
            const HalfEdge& e = edges_[h];
            if (parallel(e.key)) continue;
            const int from = side(e.org), to = side(edges_.dest(h));
            if (from * to < 0) {
                // Going down the facet opens to +d, going up to -d.
                add_event(e.key, crossing_point(h), h, true, from > 0);
            } else if (from == 0) {
                corner(h, to, side(edges_[e.prev].org));
            }
        }
    }

    // Whether the directions +d and -d point into the corner before half-edge h; `out` and `in`
    // are the sides of its two neighbours (NOTCHES 3.3, 3.4). Angles: d is 0, above is 0..pi.
    void corner(int h, int out, int in) {
        const HalfEdge& e = edges_[h];
        bool plus = false, minus = false;
        if (out != 0 && in != 0) {
            if (out != in) {
                plus = out < 0;
                minus = out > 0;
            } else {
                plus = minus = !opens_left(h);
            }
        } else if (out != 0) {
            const bool in_at_zero = runs_along(e.prev) < 0;  // the reversed in-edge points along d
            if (in_at_zero)
                minus = out > 0;
            else
                plus = out < 0;
        } else {
            const bool out_at_zero = runs_along(h) > 0;
            if (in != 0) {
                if (out_at_zero)
                    minus = in < 0;
                else
                    plus = in > 0;
            } else if (out_at_zero == (runs_along(e.prev) < 0)) {
                (out_at_zero ? minus : plus) = true;  // antenna along the plane: 360 degrees
            }
        }
        if (plus) add_event(e.key, e.org, h, false, true);
        if (minus) add_event(e.key, e.org, h, false, false);
    }

    // Corner between two neighbours on one side: true when less than pi, false when it wraps.
    bool opens_left(int h) {
        const HalfEdge& e = edges_[h];
        const int a = edges_.dest(h), b = edges_[e.prev].org;
        if (a == b) return false;
        const Dominant lead = dominant(points_.plane(plane_of(e.key)));
        const int turn = points_.orient(e.org, a, b, lead.axis) * lead.sign * key_sign(e.key);
        return turn > 0;
    }

    void join_chords() {
        std::sort(events_.begin(), events_.end(), [&](const Event& a, const Event& b) {
            if (a.slot != b.slot) return a.slot < b.slot;
            if (a.point != b.point) {
                const int c = along(slots_[a.slot], a.point, b.point);
                return c != 0 ? c < 0 : a.point < b.point;
            }
            return a.start < b.start;  // ends before starts
        });
        if (events_.size() % 2) fail("odd number of chord ends", {});
        for (std::size_t i = 0; i < events_.size(); i += 2) {
            const Event &a = events_[i], &b = events_[i + 1];
            if (a.slot != b.slot || !a.start || b.start || a.point == b.point)
                fail("chord ends do not alternate",
                     {plane_of(slots_[a.slot].key), plane_of(slots_[b.slot].key)});
            add_chord(a, b);
        }
    }

    void add_chord(const Event& a, const Event& b) {
        const Slot& s = slots_[a.slot];
        Segment chord;
        chord.key = s.key;
        chord.line = points_.plane_line(plane_, plane_of(s.key));
        chord.direction = s.along;
        chord.from = {a.point, a.half_edge, a.crossing};
        contacts_.clear();
        for (const int z : on_plane_) {
            if (std::fabs(points_.distance(z, plane_of(s.key))) > kClassReach) continue;
            if (along(s, z, a.point) <= 0 || along(s, b.point, z) <= 0) continue;
            if (points_.side(z, plane_of(s.key)) == 0) contacts_.push_back(z);
        }
        std::sort(contacts_.begin(), contacts_.end(),
                  [&](int x, int y) { return along(s, x, y) < 0; });
        for (const int z : contacts_) {
            chord.to = {z, -1, false};
            section_.segments.push_back(chord);
            chord.from = chord.to;
        }
        chord.to = {b.point, b.half_edge, b.crossing};
        section_.segments.push_back(chord);
    }

    enum State { above, below, left, right };

    // Where the facet of half-edge h lies, seen along a half-edge; `own` if that is h itself.
    State state(int h, bool own) {
        const int key = edges_[h].key;
        if (parallel(key)) return (key_sign(key) > 0) == own ? left : right;
        return runs_along(h) > 0 ? above : below;
    }

    static bool left_in(State f1, State f2, bool reflex) {
        if (f1 == above && f2 == below) return true;
        if (f1 == above && f2 == right) return true;
        if (f1 == right && f2 == below) return true;
        return f1 == f2 && (f1 == above || f1 == below) && reflex;
    }

    void collect_plane_edges() {
        for (const int h : plane_edges_) {
            const int t = edges_[h].twin;
            const bool reflex = edges_[h].notch >= 0;
            const bool h_in = left_in(state(h, true), state(t, false), reflex);
            const bool t_in = left_in(state(t, true), state(h, false), reflex);
            const int first = static_cast<int>(section_.segments.size());
            if (h_in) add_plane_edge(h);
            if (t_in) add_plane_edge(t);
            if (h_in && t_in) {
                section_.segments[first].mate = first + 1;
                section_.segments[first + 1].mate = first;
                const bool up = state(h, true) == above;
                section_.segments[first].facets_above = up;
                section_.segments[first + 1].facets_above = up;
            }
        }
    }

    void add_plane_edge(int h) {
        Segment s;
        s.half_edge = h;
        s.line = edges_[h].line;
        s.from.point = edges_[h].org;
        s.to.point = edges_.dest(h);
        s.direction = points_.direction(s.line);
        const Dominant lead = dominant(s.direction);
        if (lead.sign == 0) fail("edge without a direction", {plane_of(edges_[h].key)});
        if (lead.sign * points_.compare(s.to.point, s.from.point, lead.axis) < 0)
            for (Int128& c : s.direction) c = -c;
        section_.segments.push_back(s);
    }

    // At each point Q fills sectors from a leaving ray counter-clockwise to an arriving one
    // (NOTCHES 3.8); the boundary goes on from the arriving to the leaving one.
    void link_sectors() {
        rays_.clear();
        for (int i = 0; i < static_cast<int>(section_.segments.size()); ++i) {
            rays_.push_back({section_.segments[i].from.point, i, true});
            rays_.push_back({section_.segments[i].to.point, i, false});
        }
        std::sort(rays_.begin(), rays_.end(), [](const Ray& a, const Ray& b) {
            if (a.point != b.point) return a.point < b.point;
            if (a.leaving != b.leaving) return a.leaving < b.leaving;
            return a.segment < b.segment;
        });
        section_.simple = true;
        for (std::size_t i = 0, j; i < rays_.size(); i = j) {
            for (j = i; j < rays_.size() && rays_[j].point == rays_[i].point;) ++j;
            if (j - i > 2) {
                sort_by_angle(i, j);
                section_.simple = false;
            }
            pair_sectors(i, j);
        }
    }

    Direction towards(const Ray& r) const {
        Direction d = section_.segments[r.segment].direction;
        if (!r.leaving)
            for (Int128& c : d) c = -c;
        return d;
    }

    // Sign of the angle from b to a, counter-clockwise from the frame's first axis.
    int compare_angle(const Ray& a, const Ray& b) const {
        const Direction p = towards(a), q = towards(b);
        const int hp = half_plane(frame_, p), hq = half_plane(frame_, q);
        return hp != hq ? hp - hq : -turn_on_plane(frame_, p, q);
    }

    void sort_by_angle(std::size_t from, std::size_t to) {
        const auto first = rays_.begin() + static_cast<std::ptrdiff_t>(from);
        const auto last = rays_.begin() + static_cast<std::ptrdiff_t>(to);
        std::sort(first, last, [&](const Ray& a, const Ray& b) {
            const int c = compare_angle(a, b);
            if (c != 0) return c < 0;
            if (a.leaving != b.leaving) return a.leaving < b.leaving;
            return a.segment < b.segment;
        });
        order_ties(from, to);
    }

    // Rays of one direction: within Q one sector ends and the next begins; outside of Q two
    // sheets of the surface touch there, and what lies between them is a sector of no width.
    void order_ties(std::size_t from, std::size_t to) {
        const std::size_t count = to - from;
        std::vector<std::size_t> group(count + 1, count);  // starts of groups
        std::size_t groups = 0, alone = count;
        for (std::size_t k = 0; k < count; ++k)
            if (k == 0 || compare_angle(rays_[from + k - 1], rays_[from + k]) != 0)
                group[groups++] = k;
        group[groups] = count;
        for (std::size_t g = 0; g < groups && alone == count; ++g)
            if (group[g + 1] - group[g] == 1) alone = g;
        if (groups == count || alone == count) return;
        bool inside = rays_[from + group[alone]].leaving;
        for (std::size_t i = 1; i < groups; ++i) {
            const std::size_t g = (alone + i) % groups;
            interleave(from + group[g], from + group[g + 1], inside);
            inside = rays_[from + group[g + 1] - 1].leaving;
        }
    }

    // Ends and starts in turn, an end first when inside. Between the two sides of an across edge
    // there is only its own notch: they stay together, and where there is Q around them.
    void interleave(std::size_t from, std::size_t to, bool inside) {
        std::vector<Ray> ends, starts, across, ordered;
        for (std::size_t k = from; k < to; ++k) {
            const Ray& r = rays_[k];
            const int mate = section_.segments[r.segment].mate;
            if (mate < 0)
                (r.leaving ? starts : ends).push_back(r);
            else if (!r.leaving)
                across.insert(across.end(), {r, {r.point, mate, true}});
        }
        std::size_t e = 0, s = 0;
        if (!inside && !starts.empty()) ordered.push_back(starts[s++]);
        ordered.insert(ordered.end(), across.begin(), across.end());
        inside |= s > 0;
        while (e < ends.size() || s < starts.size()) {
            const bool take_end = s == starts.size() || (inside && e < ends.size());
            ordered.push_back(take_end ? ends[e++] : starts[s++]);
            inside = !take_end;
        }
        std::copy(ordered.begin(), ordered.end(),
                  rays_.begin() + static_cast<std::ptrdiff_t>(from));
    }

    void pair_sectors(std::size_t from, std::size_t to) {
        const std::size_t count = to - from;
        if (count % 2) fail("boundary of the section does not close", planes_of_point(from));
        for (std::size_t k = 0; k < count; ++k) {
            const Ray &r = rays_[from + k], &after = rays_[from + (k + 1) % count];
            if (r.leaving == after.leaving)
                fail("sectors of the section do not alternate", planes_of_point(from));
            if (r.leaving) section_.segments[after.segment].next = r.segment;
        }
    }

    std::vector<int> planes_of_point(std::size_t ray) { return points_.on(rays_[ray].point); }

    PointTable& points_;
    HalfEdges& edges_;
    Piece& piece_;
    int plane_;
    Workspace& work_;
    Frame frame_;
    Section section_;
    std::vector<int> on_plane_, plane_edges_, contacts_;
    std::vector<Slot> slots_;
    std::vector<Event> events_;
    std::vector<Ray> rays_;
};

}  // namespace

Section trace_section(PointTable& points, HalfEdges& edges, Piece& piece, int plane, Extent extent,
                      const std::vector<char>& own, Workspace& work) {
    return Tracer(points, edges, piece, plane, work).run(extent, own);
}

}  // namespace tetra::notch

// SPDX-License-Identifier: LGPL-2.1-or-later
// Shoots chords from reflex corners, then walks round the faces.
#include "convex_base.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>

namespace tetra::fence {
namespace {

struct Vector2 {
    std::int64_t x, y;
    Vector2 operator-() const { return {-x, -y}; }
};

std::int64_t cross(const Vector2& a, const Vector2& b) { return a.x * b.y - a.y * b.x; }

// Where b lies counter-clockwise from a: 0 below, 1 at, 2 above half a turn, 3 a full turn.
int turn_class(const Vector2& a, const Vector2& b) {
    const std::int64_t c = cross(a, b);
    if (c != 0) return c > 0 ? 0 : 2;
    return a.x * b.x + a.y * b.y < 0 ? 1 : 3;
}

bool sooner(const Vector2& from, const Vector2& a, const Vector2& b) {
    const int s = turn_class(from, a), t = turn_class(from, b);
    return s != t ? s < t : cross(a, b) > 0;
}

class Chopper {
  public:
    Chopper(Plan& plan, std::vector<LineEdge> region) : plan_(plan), edges_(std::move(region)) {
        for (int e = 0; e < static_cast<int>(edges_.size()); ++e) attach(e);
    }

    std::vector<ConvexPolygon> run(int& chords) {
        std::vector<int> corners;
        for (const auto& [point, node] : nodes_) corners.push_back(point);
        for (const int point : corners)
            while (const std::optional<Sector> sector = reflex_sector(point)) {
                cut(point, *sector);
                ++chords;
            }
        return faces();
    }

  private:
    struct Node {
        std::vector<int> out, in;
    };
    struct Sector {
        int out, in;  // counter-clockwise from the way out to the way back
    };
    struct Hit {
        int point = -1;
        std::vector<int> crossed;  // edges that the chord meets inside
        bool resolves = false;
        double length = 0;
    };

    Vector2 direction(const LineEdge& e) const {
        const Line& line = at(plan_.lines, e.line);
        return e.forward ? Vector2{line.dx, line.dy} : Vector2{-line.dx, -line.dy};
    }
    Vector2 direction(int e) const { return direction(at(edges_, e)); }

    void attach(int e) {
        nodes_[at(edges_, e).from].out.push_back(e);
        nodes_[at(edges_, e).to].in.push_back(e);
    }

    // The edge that the region's sector left of `out` ends with.
    int partner(const Node& node, int out) const {
        int best = -1;
        for (const int i : node.in)
            if (best < 0 || sooner(direction(out), -direction(i), -direction(best))) best = i;
        return best;
    }

    std::optional<Sector> reflex_sector(int point) const {
        const Node& node = nodes_.at(point);
        for (const int o : node.out) {
            const int i = partner(node, o);
            if (turn_class(direction(o), -direction(i)) >= 2) return Sector{o, i};
        }
        return std::nullopt;
    }

    // Extends one side of the corner into the region: the chord that settles another corner too,
    // else the shorter one.
    void cut(int point, const Sector& sector) {
        const LineEdge out = at(edges_, sector.out), in = at(edges_, sector.in);
        const Hit back = shoot(point, out.line, !out.forward);
        const Hit ahead = shoot(point, in.line, in.forward);
        const bool take_back =
            back.resolves != ahead.resolves ? back.resolves : back.length < ahead.length;
        const Hit& hit = take_back ? back : ahead;
        const int line = take_back ? out.line : in.line;
        const bool forward = take_back ? !out.forward : in.forward;
        for (const int e : hit.crossed) split(e, hit.point);
        add({point, hit.point, line, forward});
        add({hit.point, point, line, !forward});
    }

    void add(const LineEdge& edge) {
        edges_.push_back(edge);
        attach(static_cast<int>(edges_.size()) - 1);
    }

    void split(int e, int point) {
        const LineEdge whole = at(edges_, e);
        std::erase(nodes_[whole.to].in, e);
        at(edges_, e).to = point;
        nodes_[point].in.push_back(e);
        add({point, whole.to, whole.line, whole.forward});
    }

    int side(int point, const Line& line) const {
        const PlanPoint& p = plan_.points[point];
        const double a = static_cast<double>(line.dx) * p.y, b = static_cast<double>(line.dy) * p.x;
        const double c = static_cast<double>(line.c), value = a - b - c;
        if (std::fabs(value) > 0x1p-48 * (std::fabs(a) + std::fabs(b) + std::fabs(c)))
            return value > 0 ? 1 : -1;
        return sign_of(line.dx * p.Y - line.dy * p.X - static_cast<Int128>(line.c) * p.w);
    }

    int crossing(const Line& l, const Line& m) {
        const Int128 w = static_cast<Int128>(l.dx) * m.dy - static_cast<Int128>(l.dy) * m.dx;
        return plan_.points.crossing(
            static_cast<Int128>(l.c) * m.dx - static_cast<Int128>(m.c) * l.dx,
            static_cast<Int128>(l.c) * m.dy - static_cast<Int128>(m.c) * l.dy,
            static_cast<std::int64_t>(w));
    }

    // The first point of the region's edges on the way from `point` along the line.
    Hit shoot(int point, int line_id, bool forward) {
        const Line line = at(plan_.lines, line_id);
        const int way = forward ? 1 : -1;
        Hit hit;
        const auto offer = [&](int p, int crossed) {
            if (p != hit.point) {
                if (plan_.points.compare_axis(line.axis, p, point) * way <= 0) return;
                if (hit.point >= 0 && plan_.points.compare_axis(line.axis, p, hit.point) * way > 0)
                    return;
                hit.point = p;
                hit.crossed.clear();
            }
            if (crossed >= 0) hit.crossed.push_back(crossed);
        };
        for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
            const LineEdge& edge = at(edges_, e);
            const int a = side(edge.from, line), b = side(edge.to, line);
            if (a == 0) offer(edge.from, -1);
            if (b == 0) offer(edge.to, -1);
            if (a * b < 0 && may_be_first(edge, line, way, point, hit.point))
                offer(crossing(line, at(plan_.lines, edge.line)), e);
        }
        assert(hit.point >= 0);
        const PlanPoint &p = plan_.points[point], &q = plan_.points[hit.point];
        hit.length = std::hypot(q.x - p.x, q.y - p.y);
        const Vector2 back = forward ? Vector2{-line.dx, -line.dy} : Vector2{line.dx, line.dy};
        hit.resolves = resolves(hit.point, back);
        return hit;
    }

    // Spares exact points: false only when both ends are behind the start or beyond the best.
    bool may_be_first(const LineEdge& e, const Line& line, int way, int start, int best) const {
        const int axis = line.axis;
        const auto place = [&](int p) {
            return way * (axis == 0 ? plan_.points[p].x : plan_.points[p].y);
        };
        const double a = place(e.from), b = place(e.to), slack = 1;
        if (std::max(a, b) < place(start) - slack) return false;
        return best < 0 || std::min(a, b) <= place(best) + slack;
    }

    // Would a chord that comes in from the direction `back` leave no reflex corner at the point?
    bool resolves(int point, const Vector2& back) const {
        const auto place = nodes_.find(point);
        if (place == nodes_.end()) return false;
        for (const int o : place->second.out) {
            const Vector2 from = direction(o);
            const Vector2 to = -direction(partner(place->second, o));
            if (turn_class(from, to) < 2 || !sooner(from, back, to)) continue;
            return turn_class(from, back) <= 1 && turn_class(back, to) <= 1;
        }
        return false;
    }

    std::vector<ConvexPolygon> faces() const {
        std::vector<int> next(edges_.size(), -1);
        for (const auto& [point, node] : nodes_)
            for (const int o : node.out) at(next, partner(node, o)) = o;
        std::vector<ConvexPolygon> polygons;
        std::vector<char> seen(edges_.size(), 0);
        for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
            ConvexPolygon face;
            for (int i = e; i >= 0 && !at(seen, i); i = at(next, i)) {
                at(seen, i) = 1;
                face.push_back(at(edges_, i));
            }
            if (!face.empty()) polygons.push_back(without_straight_corners(face));
        }
        return polygons;
    }

    static ConvexPolygon without_straight_corners(const ConvexPolygon& face) {
        ConvexPolygon corners;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const LineEdge& before = face[(i + face.size() - 1) % face.size()];
            if (before.line != face[i].line || before.forward != face[i].forward)
                corners.push_back(face[i]);
        }
        for (std::size_t i = 0; i < corners.size(); ++i)
            corners[i].to = corners[(i + 1) % corners.size()].from;
        return corners;
    }

    Plan& plan_;
    std::vector<LineEdge> edges_;
    std::map<int, Node> nodes_;
};

}  // namespace

std::vector<ConvexPolygon> convex_polygons(Plan& plan, std::vector<LineEdge> region, int& chords) {
    return Chopper(plan, std::move(region)).run(chords);
}

}  // namespace tetra::fence

// SPDX-License-Identifier: LGPL-2.1-or-later
// Topological repair of flat triangles: exchange long edges, longest first; cancel folded pairs.
#include <algorithm>
#include <cassert>
#include <queue>
#include <unordered_map>

#include "tetra/exact/predicates.h"
#include "tetra/solid/edges.h"
#include "tetra/solid/snap.h"

namespace tetra {
namespace {

struct DirectedEdge {
    int solid, tail, head;
    friend bool operator==(const DirectedEdge&, const DirectedEdge&) = default;
};

struct DirectedEdgeHash {
    std::size_t operator()(const DirectedEdge& e) const {
        auto h = static_cast<std::uint64_t>(static_cast<std::uint32_t>(e.tail)) << 32 |
                 static_cast<std::uint32_t>(e.head);
        h ^= static_cast<std::uint64_t>(static_cast<std::uint32_t>(e.solid)) * 0x9e3779b97f4a7c15u;
        h *= 0xff51afd7ed558ccdu;
        return static_cast<std::size_t>(h ^ (h >> 32));
    }
};

// Lookups only: nothing depends on the order of the hash table.
class Repair {
  public:
    explicit Repair(GridSolid solid) : s_(std::move(solid)), alive_(s_.triangles.size(), 1) {}

    void run() {
        for (int t = 0; t < count(); ++t)
            if (is_flat(t)) push(t);
        if (!queue_.empty()) index_edges();
        while (!queue_.empty()) {
            const int t = queue_.top().triangle;
            queue_.pop();
            if (alive(t)) exchange(t);
        }
        cancel_folds();
    }

    GridSolid take() {
        GridSolid r;
        r.grid = s_.grid;
        std::vector<int> point_of(s_.points.size(), -1);
        for (int t = 0; t < count(); ++t)
            if (alive(t))
                for (const int v : triangle(t)) point_of[static_cast<std::size_t>(v)] = 0;
        for (std::size_t v = 0; v < point_of.size(); ++v) {
            if (point_of[v] < 0) continue;
            point_of[v] = static_cast<int>(r.points.size());
            r.points.push_back(s_.points[v]);
            r.point_source.push_back(s_.point_source[v]);
        }
        for (int t = 0; t < count(); ++t) {
            if (!alive(t)) continue;
            Triangle corners = triangle(t);
            for (int& v : corners) v = point_of[static_cast<std::size_t>(v)];
            r.triangles.push_back(corners);
            r.triangle_source.push_back(s_.triangle_source[static_cast<std::size_t>(t)]);
            r.solid.push_back(s_.solid[static_cast<std::size_t>(t)]);
        }
        return r;
    }

    int flips = 0, dropped = 0;

  private:
    struct Entry {
        Int128 length;
        int triangle;
        // Longest first: then the neighbour's own long edge is never longer than the exchanged
        // one, both new triangles are shorter when flat, and the process ends.
        friend bool operator<(const Entry& a, const Entry& b) {
            return a.length != b.length ? a.length < b.length : a.triangle > b.triangle;
        }
    };

    int count() const { return static_cast<int>(s_.triangles.size()); }
    bool alive(int t) const { return alive_[static_cast<std::size_t>(t)] != 0; }
    const Triangle& triangle(int t) const { return s_.triangles[static_cast<std::size_t>(t)]; }
    int label(int t) const { return s_.solid[static_cast<std::size_t>(t)]; }
    const Vec3i& point(int v) const { return s_.points[static_cast<std::size_t>(v)]; }
    bool is_flat(int t) const {
        return collinear(point(triangle(t)[0]), point(triangle(t)[1]), point(triangle(t)[2]));
    }

    Int128 squared_length(int u, int v) const {
        Int128 sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Int128 d = point(v)[k] - point(u)[k];
            sum += d * d;
        }
        return sum;
    }

    int long_side(int t) const {
        int best = 0;
        Int128 length = -1;
        for (int i = 0; i < 3; ++i) {
            const Int128 l = squared_length(corner(t, i), corner(t, i + 1));
            if (l > length) {
                length = l;
                best = i;
            }
        }
        return best;
    }

    int corner(int t, int i) const { return triangle(t)[static_cast<std::size_t>(i % 3)]; }

    void push(int t) {
        const int i = long_side(t);
        queue_.push({squared_length(corner(t, i), corner(t, i + 1)), t});
    }

    void index_edges() {
        for (int t = 0; t < count(); ++t) add_edges(t);
    }

    void add_edges(int t) {
        for (int i = 0; i < 3; ++i) edges_[{label(t), corner(t, i), corner(t, i + 1)}].push_back(t);
    }

    void remove(int t) {
        alive_[static_cast<std::size_t>(t)] = 0;
        for (int i = 0; i < 3; ++i) {
            std::vector<int>& list = edges_[{label(t), corner(t, i), corner(t, i + 1)}];
            list.erase(std::find(list.begin(), list.end(), t));
        }
    }

    void add(const Triangle& corners, int source, int solid) {
        s_.triangles.push_back(corners);
        s_.triangle_source.push_back(source);
        s_.solid.push_back(solid);
        alive_.push_back(1);
        const int t = count() - 1;
        add_edges(t);
        if (is_flat(t)) push(t);
    }

    int apex(int t, int tail, int head) const {
        for (const int v : triangle(t))
            if (v != tail && v != head) return v;
        assert(false);
        return -1;
    }

    // Flat t has the long edge c -> a with b between; its neighbour a -> c -> d is split at b.
    void exchange(int t) {
        const int i = long_side(t);
        const int c = corner(t, i), a = corner(t, i + 1), b = corner(t, i + 2);
        const int solid = label(t);
        const std::vector<int>& candidates = edges_[{solid, a, c}];
        if (candidates.empty()) fail(t);
        int neighbour = candidates.front();
        for (const int n : candidates)
            if (apex(n, a, c) == b) neighbour = n;
        const int d = apex(neighbour, a, c);
        const int source = s_.triangle_source[static_cast<std::size_t>(neighbour)];
        remove(t);
        remove(neighbour);
        if (d == b) {
            dropped += 2;
            return;
        }
        ++flips;
        add({a, b, d}, source, solid);
        add({b, c, d}, source, solid);
    }

    [[noreturn]] void fail(int t) const {
        Defect defect{"degenerate_triangle", {}, {}, ""};
        for (const int v : triangle(t))
            defect.vertices.push_back(s_.point_source[static_cast<std::size_t>(v)]);
        defect.triangles.push_back(s_.triangle_source[static_cast<std::size_t>(t)]);
        defect.message = "triangle " + std::to_string(defect.triangles[0]) +
                         " is flat and has no neighbour across its long edge; close the surface";
        throw InvalidSolid({std::move(defect)});
    }

    // Opposite coincident triangles u -> v -> w, v -> u -> w whose edge u-v nobody else uses are a
    // wall or gap of no thickness. Contacts of two closed shells have no such edge and stay.
    void cancel_folds() {
        std::vector<int> stack;
        const std::vector<std::array<int, 2>> folds = find_folds();
        if (folds.empty()) return;
        if (edges_.empty()) {
            for (int t = 0; t < count(); ++t)
                if (alive(t)) add_edges(t);
        }
        for (const std::array<int, 2>& fold : folds)
            stack.insert(stack.end(), fold.begin(), fold.end());
        while (!stack.empty()) {
            const int t = stack.back();
            stack.pop_back();
            if (!alive(t)) continue;
            const int other = folded_partner(t);
            if (other < 0) continue;
            const Triangle corners = triangle(t);
            remove(t);
            remove(other);
            dropped += 2;
            for (int i = 0; i < 3; ++i)
                push_users(label(t), corners[static_cast<std::size_t>(i)],
                           corners[static_cast<std::size_t>((i + 1) % 3)], stack);
        }
    }

    void push_users(int solid, int u, int v, std::vector<int>& stack) {
        for (const DirectedEdge& e : {DirectedEdge{solid, u, v}, DirectedEdge{solid, v, u}})
            if (const auto found = edges_.find(e); found != edges_.end())
                stack.insert(stack.end(), found->second.begin(), found->second.end());
    }

    int folded_partner(int t) {
        for (int i = 0; i < 3; ++i) {
            const int u = corner(t, i), v = corner(t, i + 1), w = corner(t, i + 2);
            const std::vector<int>& forward = edges_[{label(t), u, v}];
            const std::vector<int>& backward = edges_[{label(t), v, u}];
            if (forward.size() == 1 && backward.size() == 1 && apex(backward[0], u, v) == w)
                return backward[0];
        }
        return -1;
    }

    // Edges with exactly two triangles of the same three points.
    std::vector<std::array<int, 2>> find_folds() const {
        std::vector<Triangle> triangles;
        std::vector<int> solid, id;
        for (int t = 0; t < count(); ++t) {
            if (!alive(t)) continue;
            triangles.push_back(triangle(t));
            solid.push_back(label(t));
            id.push_back(t);
        }
        const EdgeTable table = build_edges(triangles, solid);
        std::vector<std::array<int, 2>> folds;
        for (std::size_t e = 0; e < table.edges.size(); ++e) {
            const std::span<const int> h = table.of(e);
            if (h.size() == 2 && apex_of(triangles, h[0]) == apex_of(triangles, h[1]))
                folds.push_back({id[static_cast<std::size_t>(h[0] / 3)],
                                 id[static_cast<std::size_t>(h[1] / 3)]});
        }
        return folds;
    }

    GridSolid s_;
    std::vector<char> alive_;
    std::unordered_map<DirectedEdge, std::vector<int>, DirectedEdgeHash> edges_;
    std::priority_queue<Entry> queue_;
};

}  // namespace

GridSolid repair_flat_triangles(GridSolid solid, SnapReport* report) {
    Repair repair(std::move(solid));
    repair.run();
    if (report) {
        report->flipped_edges += repair.flips;
        report->dropped_triangles += repair.dropped;
    }
    GridSolid result = repair.take();
    assert(is_closed(result.triangles, result.solid));
    return result;
}

}  // namespace tetra

// SPDX-License-Identifier: LGPL-2.1-or-later
// Greedy growth of plane classes from the largest exactly coplanar groups.
#include "plane_classes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "plane_index.h"

namespace tetra::notch {
namespace {

// Triangles of one exact plane, of either orientation.
struct Group {
    int plane;
    double area = 0;
    Unit unit{};  // of the first triangle's orientation is irrelevant: as stored
    std::vector<int> triangles;
    std::vector<int> vertices;
};

Vec3d as_doubles(const Vec3i& p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

double distance(const Unit& n, const Vec3i& p) {
    return n[0] * static_cast<double>(p[0]) + n[1] * static_cast<double>(p[1]) +
           n[2] * static_cast<double>(p[2]) + n[3];
}

double gap2(const Vec3i& a, const Vec3i& b) {
    double s = 0;
    for (int k = 0; k < 3; ++k) {
        const double d = static_cast<double>(a[k] - b[k]);
        s += d * d;
    }
    return s;
}

Vec3d cross(const Vec3i& a, const Vec3i& b, const Vec3i& c) {
    const Vec3d p = as_doubles(a), q = as_doubles(b), r = as_doubles(c);
    const Vec3d u{q[0] - p[0], q[1] - p[1], q[2] - p[2]}, v{r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

double length(const Vec3d& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

class Classifier {
  public:
    Classifier(const GridSolid& solid, double delta, const std::vector<char>& demoted,
               PointTable& points)
        : solid_(solid), delta_(delta), demoted_(demoted), points_(points) {}

    PlaneClasses run() {
        make_groups();
        if (delta_ > 0) grow_classes();
        result_.is_class.resize(static_cast<std::size_t>(points_.planes()), 0);
        for (std::size_t t = 0; t < solid_.triangles.size(); ++t)
            result_.is_class[plane(t)] |= result_.key[t] != result_.exact_key[t];
        return std::move(result_);
    }

  private:
    int plane(std::size_t t) const { return result_.key[t] >> 1; }

    void make_groups() {
        std::map<int, int> group_of_plane;
        for (std::size_t t = 0; t < solid_.triangles.size(); ++t) {
            const Triangle& tri = solid_.triangles[t];
            const Vec3i &a = solid_.points[tri[0]], &b = solid_.points[tri[1]],
                        &c = solid_.points[tri[2]];
            const int key = points_.add_plane(plane_through(a, b, c));
            result_.key.push_back(key);
            result_.exact_key.push_back(key);
            const auto [place, fresh] =
                group_of_plane.try_emplace(key >> 1, static_cast<int>(groups_.size()));
            if (fresh) {
                groups_.emplace_back();
                groups_.back().plane = key >> 1;
                groups_.back().unit = points_.unit_plane(key >> 1);
            }
            Group& g = groups_[place->second];
            g.area += length(cross(a, b, c)) / 2;
            g.triangles.push_back(static_cast<int>(t));
            g.vertices.insert(g.vertices.end(), tri.begin(), tri.end());
        }
        for (Group& g : groups_) {
            std::sort(g.vertices.begin(), g.vertices.end());
            g.vertices.erase(std::unique(g.vertices.begin(), g.vertices.end()), g.vertices.end());
        }
    }

    bool is_demoted(const Group& g) const {
        return g.plane < static_cast<int>(demoted_.size()) && demoted_[g.plane];
    }

    void grow_classes() {
        std::vector<int> order(groups_.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(),
                         [&](int a, int b) { return groups_[a].area > groups_[b].area; });
        taken_.assign(groups_.size(), 0);
        rank_.resize(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) rank_[order[i]] = static_cast<int>(i);
        std::vector<Triangle> first;  // a triangle stands for its group
        std::vector<Unit> units;
        for (const Group& g : groups_) {
            first.push_back(solid_.triangles[g.triangles.front()]);
            units.push_back(g.unit);
        }
        index_.emplace(solid_.points, first, units, delta_);
        for (const int seed : order) {
            if (taken_[seed] || is_demoted(groups_[seed])) continue;
            grow(seed);
        }
    }

    void grow(int seed) {
        std::vector<int> members = members_near(groups_[seed].unit, seed);
        if (members.size() == 1) return;
        int key = 2 * groups_[seed].plane;
        for (int round = 0; round < 4; ++round) {
            const int refit = spread_plane(members);
            if (refit < 0) break;
            const std::vector<int> wider = members_near(points_.unit_plane(refit >> 1), seed);
            // Keep the fit only if the seed is on it and nothing is lost.
            if (wider.size() < members.size()) break;
            key = refit;
            const bool same = wider == members;
            members = wider;
            if (same) break;
        }
        const Unit unit = points_.unit_plane(key >> 1);
        for (const int m : members) {
            taken_[m] = 1;
            assign(groups_[m], key >> 1, unit);
        }
    }

    // Groups with all vertices within delta of the plane, largest first; none without the seed.
    std::vector<int> members_near(const Unit& unit, int seed) const {
        std::vector<int> members;
        index_->for_near(unit, [&](int g) {
            if (!taken_[g] && !is_demoted(groups_[g]) && is_near(groups_[g], unit))
                members.push_back(g);
        });
        std::sort(members.begin(), members.end(),
                  [&](int a, int b) { return rank_[a] < rank_[b]; });
        if (std::find(members.begin(), members.end(), seed) == members.end()) members.clear();
        return members;
    }

    bool is_near(const Group& group, const Unit& unit) const {
        const double cosine =
            group.unit[0] * unit[0] + group.unit[1] * unit[1] + group.unit[2] * unit[2];
        if (std::fabs(cosine) < 0.9) return false;
        return std::all_of(group.vertices.begin(), group.vertices.end(), [&](int v) {
            return std::fabs(distance(unit, solid_.points[v])) <= delta_;
        });
    }

    // The plane of three far-apart vertices of the groups, -1 when they are all on a line.
    int spread_plane(const std::vector<int>& members) {
        std::vector<int> vertices;
        for (const int m : members)
            vertices.insert(vertices.end(), groups_[m].vertices.begin(), groups_[m].vertices.end());
        const auto farthest = [&](auto&& score) {
            int best = vertices.front();
            double most = -1;
            for (const int v : vertices) {
                const double s = score(solid_.points[v]);
                if (s > most || (s == most && solid_.points[v] < solid_.points[best])) {
                    most = s;
                    best = v;
                }
            }
            return solid_.points[best];
        };
        const Vec3i start = solid_.points[vertices.front()];
        const Vec3i u = farthest([&](const Vec3i& p) { return gap2(start, p); });
        const Vec3i v = farthest([&](const Vec3i& p) { return gap2(u, p); });
        const Vec3i w = farthest([&](const Vec3i& p) { return length(cross(u, v, p)); });
        if (collinear(u, v, w)) return -1;
        return points_.add_plane(plane_through(u, v, w));
    }

    void assign(const Group& group, int plane, const Unit& unit) {
        for (const int t : group.triangles) {
            const Triangle& tri = solid_.triangles[t];
            const Vec3d n =
                cross(solid_.points[tri[0]], solid_.points[tri[1]], solid_.points[tri[2]]);
            const bool reversed = n[0] * unit[0] + n[1] * unit[1] + n[2] * unit[2] < 0;
            result_.key[t] = 2 * plane + (reversed ? 1 : 0);
        }
    }

    const GridSolid& solid_;
    double delta_;
    const std::vector<char>& demoted_;
    PointTable& points_;
    PlaneClasses result_;
    std::vector<Group> groups_;
    std::vector<int> rank_;  // of a group by area
    std::optional<PlaneIndex> index_;
    std::vector<char> taken_;
};

}  // namespace

PlaneClasses assign_planes(const GridSolid& solid, double delta, const std::vector<char>& demoted,
                           PointTable& points) {
    return Classifier(solid, delta, demoted, points).run();
}

}  // namespace tetra::notch

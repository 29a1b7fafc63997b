// SPDX-License-Identifier: LGPL-2.1-or-later
// Branch and bound on an octree, the box that may hold the farthest point first.
#include "hull_error.h"

#include <cmath>
#include <queue>

#include "vec3.h"

namespace tetra {
namespace {

constexpr double kSlack = 1.05;
constexpr int kMostBoxes = 100'000;
constexpr double kSmallest = 1e-6;  // of the hull's size: what is nearer counts as touching

struct Candidate {
    double bound;
    Vec3d middle, half;
    bool operator<(const Candidate& o) const {
        return bound != o.bound ? bound < o.bound : middle < o.middle;
    }
};

class Search {
  public:
    Search(HullError& error, std::span<const Vec3d> points, std::span<const Triangle> triangles,
           const PartDistance& distance)
        : error_(error), halves_(half_spaces(points, triangles)), distance_(distance) {
        FloatBox box;
        for (const Triangle& t : triangles) {
            Vec3d middle{};
            for (const int i : t) {
                const Vec3d& p = points[static_cast<std::size_t>(i)];
                box.add(p);
                for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / 3;
                saw(distance_(p));
            }
            saw(distance_(middle));
        }
        Candidate all{0, {}, {}};
        for (std::size_t k = 0; k < 3; ++k) {
            all.middle[k] = (box.low[k] + box.high[k]) / 2;
            all.half[k] = (box.high[k] - box.low[k]) / 2;
        }
        smallest_ = kSmallest * norm(all.half);
        enter(all);
    }

    void run(Progress& progress) {
        for (int boxes = 0; !queue_.empty(); ++boxes) {
            const Candidate next = queue_.top();
            if (next.bound <= wanted()) break;
            if (boxes >= kMostBoxes) {
                error_.bound = std::max(error_.bound, next.bound);
                return;
            }
            queue_.pop();
            progress.poll("hull_error", 0);
            split(next);
        }
        // What was left out reaches no farther than that.
        error_.bound = std::max(error_.bound, wanted());
    }

  private:
    HullError& error_;
    std::vector<HalfSpace> halves_;
    const PartDistance& distance_;
    double smallest_ = 0;
    std::priority_queue<Candidate> queue_;

    void saw(double distance) {
        error_.found = std::max(error_.found, distance);
        error_.bound = std::max(error_.bound, distance);
    }

    double wanted() const { return std::max(kSlack * error_.found, smallest_); }

    void split(const Candidate& c) {
        const double longest = std::max({c.half[0], c.half[1], c.half[2]});
        std::vector<Candidate> parts{{0, c.middle, c.half}};
        for (std::size_t k = 0; k < 3; ++k) {
            if (c.half[k] < longest / 2) continue;  // keeps boxes about as wide as long
            const std::size_t count = parts.size();
            for (std::size_t i = 0; i < count; ++i) {
                parts[i].half[k] /= 2;
                Candidate other = parts[i];
                parts[i].middle[k] -= parts[i].half[k];
                other.middle[k] += other.half[k];
                parts.push_back(other);
            }
        }
        for (const Candidate& part : parts) enter(part);
    }

    // Keeps a box that may hold a point farther than is known and wanted.
    void enter(Candidate c) {
        bool inside = true;
        for (const HalfSpace& h : halves_) {
            const double reach = std::abs(h.normal[0]) * c.half[0] +
                                 std::abs(h.normal[1]) * c.half[1] +
                                 std::abs(h.normal[2]) * c.half[2];
            const double out = beyond(h, c.middle);
            if (out > reach + smallest_) return;
            if (out > 0) inside = false;
        }
        const double radius = norm(c.half);
        if (distance_.contains_ball(c.middle, radius)) return;
        const double distance = distance_(c.middle);
        if (inside) saw(distance);
        c.bound = distance + radius;
        if (c.bound > wanted()) queue_.push(c);
    }
};

}  // namespace

void raise_to(HullError& error, std::span<const Vec3d> points, std::span<const Triangle> triangles,
              const PartDistance& distance, Progress& progress) {
    Search(error, points, triangles, distance).run(progress);
}

}  // namespace tetra

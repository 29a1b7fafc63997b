// SPDX-License-Identifier: LGPL-2.1-or-later
// Cups from the last to the first: each hands its lateral sub-triangles to their owners.
#include "tetra/assemble/emit_cups.h"

#include <algorithm>
#include <utility>

#include "emit_cups_carriers.h"
#include "tetra/errors.h"

namespace tetra {
namespace {

using DirectedEdge = std::array<int, 2>;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// Directed edges without their reverse, sorted.
std::vector<DirectedEdge> boundary_of(const std::vector<Triangle>& triangles) {
    std::vector<DirectedEdge> edges, boundary;
    for (const Triangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k) edges.push_back({t[k], t[(k + 1) % 3]});
    std::sort(edges.begin(), edges.end());
    for (const DirectedEdge& e : edges)
        if (!std::binary_search(edges.begin(), edges.end(), DirectedEdge{e[1], e[0]}))
            boundary.push_back(e);
    return boundary;
}

class Emitter {
  public:
    Emitter(const FenceResult& fenced, const PullOff& pulled, const PulledSurface& surface)
        : pulled_(pulled),
          surface_(surface),
          mesh_point_(surface.points.size(), -1),
          dome_(pulled.cups.size()) {
        mesh_.points = fenced.mesh.points;
        mesh_.tets = fenced.mesh.tets;
        point_source_ = fenced.point_source;
        for (std::size_t p = 0; p < point_source_.size(); ++p)
            if (point_source_[p] >= 0) mesh_point_[index(point_source_[p])] = static_cast<int>(p);
        for (std::size_t s = 0; s < fenced.mesh.skin.size(); ++s)
            give(pulled.owners[index(fenced.mesh.skin_source[s])], fenced.mesh.skin[s]);
        for (const ClosingPair& pair : pulled.closings) {
            Triangle t;
            for (std::size_t k = 0; k < 3; ++k) t[k] = point_of(pair.triangle[k]);
            give(pulled.first_cup + pair.cup, t);
            give(pair.owner, {t[0], t[2], t[1]});
        }
    }

    ExactMesh run() {
        for (std::size_t i = pulled_.cups.size(); i-- > 0;) emit(i);
        mesh_.tet_solid.assign(mesh_.tets.size(), surface_.solid);
        mesh_.skin_source.reserve(skin_owner_.size());
        for (const int owner : skin_owner_)
            mesh_.skin_source.push_back(surface_.owner_triangle[index(owner)]);
        mesh_.carriers = skin_carriers(mesh_, skin_owner_, point_source_);
        return std::move(mesh_);
    }

  private:
    void give(int owner, const Triangle& t) {
        if (owner >= pulled_.first_cup) {
            dome_[index(owner - pulled_.first_cup)].push_back(t);
        } else {
            mesh_.skin.push_back(t);
            skin_owner_.push_back(owner);
        }
    }

    int point_of(int grid_point) {
        int& p = mesh_point_[index(grid_point)];
        if (p < 0) {
            p = static_cast<int>(mesh_.points.size());
            mesh_.points.push_back(hpoint(surface_.points[index(grid_point)]));
            point_source_.push_back(grid_point);
        }
        return p;
    }

    void emit(std::size_t i) {
        const Cup& cup = pulled_.cups[i];
        const int apex = point_of(cup.apex);
        for (const Triangle& t : dome_[i]) mesh_.tets.push_back({t[0], t[1], t[2], apex});
        const std::vector<DirectedEdge> boundary = boundary_of(dome_[i]);
        std::size_t walked = 0;
        for (std::size_t c = 0; c < cup.crown.size(); ++c) {
            int p = point_of(cup.crown[c]);
            const int end = point_of(cup.crown[(c + 1) % cup.crown.size()]);
            for (; p != end && walked < boundary.size(); ++walked) {
                const auto step =
                    std::lower_bound(boundary.begin(), boundary.end(), DirectedEdge{p, -1});
                if (step == boundary.end() || (*step)[0] != p) break;
                give(cup.lateral_owner[c], {apex, p, (*step)[1]});
                p = (*step)[1];
            }
            if (p != end) fail(cup);
        }
        if (walked != boundary.size()) fail(cup);
        std::vector<Triangle>().swap(dome_[i]);
    }

    [[noreturn]] static void fail(const Cup& cup) {
        throw VerificationFailed("the dome under grid point " + std::to_string(cup.apex) +
                                 " lost a crown vertex; try another direction or pull-off off");
    }

    const PullOff& pulled_;
    const PulledSurface& surface_;
    std::vector<int> mesh_point_;    // per grid point
    std::vector<int> point_source_;  // per mesh point
    std::vector<std::vector<Triangle>> dome_;
    std::vector<int> skin_owner_;
    ExactMesh mesh_;
};

}  // namespace

ExactMesh emit_cups(const FenceResult& fenced, const PullOff& pulled,
                    const PulledSurface& surface) {
    return Emitter(fenced, pulled, surface).run();
}

}  // namespace tetra

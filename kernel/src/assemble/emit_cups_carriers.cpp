// SPDX-License-Identifier: LGPL-2.1-or-later
// Inner, facet or edge by the number of owners; edges by walking along the borders of owners.
#include "emit_cups_carriers.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "tetra/errors.h"

namespace tetra {
namespace {

struct SkinEdge {
    int low, high, owner;
    friend auto operator<=>(const SkinEdge&, const SkinEdge&) = default;
};

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// Points that are no input points, joined along the borders of owners. Such a chain lies on one
// edge between two input points; where four facets meet, two sides may divide it differently.
class Borders {
  public:
    Borders(const ExactMesh& mesh, const std::vector<int>& owner,
            const std::vector<int>& point_source)
        : source_(point_source), parent_(mesh.points.size()), ends_(mesh.points.size(), {-1, -1}) {
        std::iota(parent_.begin(), parent_.end(), 0);
        const std::vector<SkinEdge> borders = borders_of(mesh, owner);
        for (const SkinEdge& e : borders)
            if (source_[index(e.low)] < 0 && source_[index(e.high)] < 0)
                parent_[index(root(e.low))] = root(e.high);
        for (const SkinEdge& e : borders) {
            add_end(e.low, e.high);
            add_end(e.high, e.low);
        }
    }

    std::array<int, 2> ends_of(int p) { return ends_[index(root(p))]; }

  private:
    static std::vector<SkinEdge> borders_of(const ExactMesh& mesh, const std::vector<int>& owner) {
        std::vector<SkinEdge> edges, borders;
        edges.reserve(3 * mesh.skin.size());
        for (std::size_t s = 0; s < mesh.skin.size(); ++s)
            for (std::size_t k = 0; k < 3; ++k) {
                const int a = mesh.skin[s][k], b = mesh.skin[s][(k + 1) % 3];
                edges.push_back({std::min(a, b), std::max(a, b), owner[s]});
            }
        std::sort(edges.begin(), edges.end());
        for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
            while (j < edges.size() && edges[j].low == edges[i].low &&
                   edges[j].high == edges[i].high)
                ++j;
            if (j - i != 2 || edges[i].owner != edges[i + 1].owner) borders.push_back(edges[i]);
        }
        return borders;
    }

    int root(int p) {
        while (parent_[index(p)] != p) p = parent_[index(p)] = parent_[index(parent_[index(p)])];
        return p;
    }

    void add_end(int made, int end) {
        if (source_[index(made)] >= 0 || source_[index(end)] < 0) return;
        std::array<int, 2>& ends = ends_[index(root(made))];
        const int grid_point = source_[index(end)];
        if (ends[0] == grid_point || ends[1] == grid_point) return;
        if (ends[0] >= 0 && ends[1] >= 0)
            throw InvalidSolid({{"edge_contact",
                                 {ends[0], ends[1], grid_point},
                                 {},
                                 "two sharp edges meet without a common vertex near the listed "
                                 "ones; divide both where they meet"}});
        ends[ends[0] < 0 ? 0 : 1] = grid_point;
    }

    const std::vector<int>& source_;
    std::vector<int> parent_;
    std::vector<std::array<int, 2>> ends_;  // of roots: grid points
};

}  // namespace

std::vector<Carrier> skin_carriers(const ExactMesh& mesh, const std::vector<int>& owner,
                                   const std::vector<int>& point_source) {
    constexpr int kNone = -1, kSeveral = -2;
    std::vector<int> owner_at(mesh.points.size(), kNone), triangle_at(mesh.points.size(), -1);
    for (std::size_t s = 0; s < mesh.skin.size(); ++s)
        for (const int p : mesh.skin[s]) {
            int& seen = owner_at[index(p)];
            seen = seen == kNone || seen == owner[s] ? owner[s] : kSeveral;
            triangle_at[index(p)] = mesh.skin_source[s];
        }
    Borders borders(mesh, owner, point_source);
    std::vector<Carrier> carriers(mesh.points.size());
    for (std::size_t p = 0; p < carriers.size(); ++p) {
        if (point_source[p] >= 0) {
            carriers[p] = {CarrierKind::vertex, point_source[p], -1};
        } else if (owner_at[p] == kSeveral) {
            const std::array<int, 2> ends = borders.ends_of(static_cast<int>(p));
            carriers[p] = {CarrierKind::edge, ends[0], ends[1]};
            if (ends[0] < 0 || ends[1] < 0)
                throw VerificationFailed("a point between two facets lies on no edge of the solid");
        } else if (owner_at[p] != kNone) {
            carriers[p] = {CarrierKind::facet, triangle_at[p], -1};
        }
    }
    return carriers;
}

}  // namespace tetra

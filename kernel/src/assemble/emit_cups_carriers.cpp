// SPDX-License-Identifier: LGPL-2.1-or-later
// Inner, facet or edge by the number of owners; edges by walking along the borders of owners.
#include "emit_cups_carriers.h"

#include <algorithm>
#include <array>

#include "tetra/errors.h"

namespace tetra {
namespace {

struct SkinEdge {
    int low, high, owner;
    friend auto operator<=>(const SkinEdge&, const SkinEdge&) = default;
};

std::size_t index(int i) { return static_cast<std::size_t>(i); }

class Borders {
  public:
    Borders(const ExactMesh& mesh, const std::vector<int>& owner,
            const std::vector<int>& point_source)
        : source_(point_source), next_(mesh.points.size(), {-1, -1}) {
        std::vector<SkinEdge> edges;
        edges.reserve(3 * mesh.skin.size());
        for (std::size_t s = 0; s < mesh.skin.size(); ++s)
            for (std::size_t k = 0; k < 3; ++k) {
                const int a = mesh.skin[s][k], b = mesh.skin[s][(k + 1) % 3];
                edges.push_back({std::min(a, b), std::max(a, b), owner[s]});
            }
        std::sort(edges.begin(), edges.end());
        for (std::size_t i = 0; i < edges.size();) {
            std::size_t j = i;
            while (j < edges.size() && edges[j].low == edges[i].low &&
                   edges[j].high == edges[i].high)
                ++j;
            if (j - i != 2 || edges[i].owner != edges[i + 1].owner) {
                link(edges[i].low, edges[i].high);
                link(edges[i].high, edges[i].low);
            }
            i = j;
        }
    }

    // The input point reached from p through neighbour `side`, along points that are none.
    int end_of(int p, std::size_t side) const {
        int before = p, at = next_[index(p)][side];
        while (at >= 0 && source_[index(at)] < 0 && at != p) {
            const auto& n = next_[index(at)];
            const int after = n[0] == before ? n[1] : n[0];
            before = at;
            at = after;
        }
        return at >= 0 ? source_[index(at)] : -1;
    }

  private:
    void link(int from, int to) {
        if (source_[index(from)] >= 0) return;
        auto& n = next_[index(from)];
        if (n[0] >= 0 && n[1] >= 0)
            throw VerificationFailed("two sharp edges touch between their ends; move one of them");
        n[n[0] < 0 ? 0 : 1] = to;
    }

    const std::vector<int>& source_;
    std::vector<std::array<int, 2>> next_;  // neighbours along the border; points of no source only
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
    const Borders borders(mesh, owner, point_source);
    std::vector<Carrier> carriers(mesh.points.size());
    for (std::size_t p = 0; p < carriers.size(); ++p) {
        if (point_source[p] >= 0) {
            carriers[p] = {CarrierKind::vertex, point_source[p], -1};
        } else if (owner_at[p] == kSeveral) {
            const int id = static_cast<int>(p);
            carriers[p] = {CarrierKind::edge, borders.end_of(id, 0), borders.end_of(id, 1)};
            if (carriers[p].first < 0 || carriers[p].second < 0)
                throw VerificationFailed("a point between two facets lies on no edge of the solid");
        } else if (owner_at[p] != kNone) {
            carriers[p] = {CarrierKind::facet, triangle_at[p], -1};
        }
    }
    return carriers;
}

}  // namespace tetra

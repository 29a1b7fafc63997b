// SPDX-License-Identifier: LGPL-2.1-or-later
// Each cell becomes a cone over its triangles, from one of its vertices or from a point inside.
#include <algorithm>

#include "cell_tets_stages.h"
#include "tetra/errors.h"

namespace tetra::cells {
namespace {

// Where doubles are too coarse: binary places of fixed-point coordinates whose product with a
// plane still fits 256 bits.
constexpr int kFinePlaces = 130;

constexpr bool bit(const Int512& v, int i) { return v.limb[i / 64] >> (i % 64) & 1; }

// value * 2^kFinePlaces / w, towards zero; w > 0.
Int256 quotient(const Int256& value, const Int256& w) {
    Int512 scale = 0;
    scale.limb[kFinePlaces / 64] = std::uint64_t{1} << (kFinePlaces % 64);
    const Int512 dividend = multiply<8>(value.negative() ? -value : value, scale), divisor(w);
    Int512 rest = 0, result = 0;
    for (int i = 64 * 8 - 2; i >= 0; --i) {
        rest = rest + rest + Int512(bit(dividend, i) ? 1 : 0);
        result = result + result;
        if (rest < divisor) continue;
        rest = rest - divisor;
        result = result + Int512(1);
    }
    return Int256(value.negative() ? -result : result);
}

class Cones {
  public:
    Cones(Complex& complex, const std::vector<Face>& faces) : c_(complex), faces_(faces) {
        faces_of_.resize(c_.cell_solid.size());
        for (std::size_t f = 0; f < faces.size(); ++f)
            faces_of_[c_.facets[faces[f].facet].cell].push_back(static_cast<int>(f));
    }

    ConeTets run(Progress& progress) {
        for (std::size_t cell = 0; cell < faces_of_.size(); ++cell) {
            if (cell % 64 == 0) progress.poll("cones", 0.7);
            add_cell(static_cast<int>(cell));
        }
        return std::move(out_);
    }

  private:
    void add_cell(int cell) {
        int apex = corner_apex(cell);
        if (apex < 0) {
            apex = c_.points.points() + static_cast<int>(out_.cone_points.size());
            out_.cone_points.push_back(point_inside(cell));
        }
        for (const int f : faces_of_[cell]) {
            const Triangle& t = faces_[f].corners;
            if (t[0] == apex || t[1] == apex || t[2] == apex) continue;
            out_.tets.push_back({t[0], t[2], t[1], apex});
            out_.tet_solid.push_back(c_.cell_solid[cell]);
        }
    }

    // The vertex with most triangles, all of whose facets are fanned from it; -1 when there is
    // none.
    int corner_apex(int cell) const {
        std::map<int, int> total;                     // triangles per facet
        std::map<int, std::map<int, int>> at_vertex;  // vertex -> facet -> triangles
        for (const int f : faces_of_[cell]) {
            ++total[faces_[f].facet];
            for (const int v : faces_[f].corners) ++at_vertex[v][faces_[f].facet];
        }
        int best = -1, most = 0;
        for (const auto& [v, facets] : at_vertex) {
            int count = 0;
            const bool fanned = std::all_of(facets.begin(), facets.end(), [&](const auto& entry) {
                count += entry.second;
                return entry.second == total.at(entry.first);
            });
            if (fanned && count > most) {
                most = count;
                best = v;
            }
        }
        return best;
    }

    HPoint point_inside(int cell) {
        std::vector<int> corners;
        for (int f = c_.first_facet[cell]; f < c_.first_facet[cell + 1]; ++f)
            corners.insert(corners.end(), c_.facets[f].polygon.corners.begin(),
                           c_.facets[f].polygon.corners.end());
        std::sort(corners.begin(), corners.end());
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        Vec3d middle{0, 0, 0};
        for (const int p : corners)
            for (std::size_t k = 0; k < 3; ++k)
                middle[k] += c_.points.approx(p)[k] / static_cast<double>(corners.size());
        if (const HPoint rounded = hpoint_from(middle); is_inside(cell, rounded)) return rounded;
        HPoint fine{0, 0, 0, 0};
        for (const int p : corners) {
            const HPoint& q = c_.points.exact(p);
            fine.x += quotient(q.x, q.w);
            fine.y += quotient(q.y, q.w);
            fine.z += quotient(q.z, q.w);
            fine.w += quotient(Int256(1), Int256(1));
        }
        if (!is_inside(cell, fine))
            throw VerificationFailed("tetrahedra of cells: a cell is too thin to hold a point");
        return fine;
    }

    bool is_inside(int cell, const HPoint& point) const {
        for (int f = c_.first_facet[cell]; f < c_.first_facet[cell + 1]; ++f) {
            const int key = c_.facets[f].key;
            if (key_sign(key) * side_of_plane(c_.points.plane(plane_of(key)), point) >= 0)
                return false;
        }
        return true;
    }

    Complex& c_;
    const std::vector<Face>& faces_;
    std::vector<std::vector<int>> faces_of_;
    ConeTets out_;
};

}  // namespace

ConeTets make_cones(Complex& complex, const std::vector<Face>& faces, Progress& progress) {
    return Cones(complex, faces).run(progress);
}

}  // namespace tetra::cells

// SPDX-License-Identifier: LGPL-2.1-or-later
// From the caller's arrays to solids on one grid, and from their meshes to one with shared nodes.
#include "tetra/assemble/tetrahedralize.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "tetra/solid/validate.h"
#include "tetrahedralize_contacts.h"
#include "tetrahedralize_solid.h"

namespace tetra {
namespace {

constexpr int kCoarsestBits = 20, kFinestBits = 26;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

void expect_ids(const TetInput& input) {
    const int count = static_cast<int>(input.vertices.size());
    for (std::size_t t = 0; t < input.triangles.size(); ++t)
        for (const int v : input.triangles[t])
            if (v < 0 || v >= count)
                throw InvalidSolid({{"empty",
                                     {v},
                                     {static_cast<int>(t)},
                                     "triangle " + std::to_string(t) + " names vertex " +
                                         std::to_string(v) + ", of " + std::to_string(count)}});
    const auto fits = [&](const std::vector<int>& ids) {
        return ids.empty() || ids.size() == input.triangles.size();
    };
    if (input.triangles.empty() || !fits(input.solid) || !fits(input.face))
        throw InvalidSolid({{"empty", {}, {}, "no triangles, or not one id for each"}});
}

GridChoice snapped(const TetInput& input, int lowest, int highest, Progress& progress) {
    Validation valid;
    valid.triangles = input.triangles;
    valid.triangle_source.resize(input.triangles.size());
    std::iota(valid.triangle_source.begin(), valid.triangle_source.end(), 0);
    valid.solid = input.solid;
    if (valid.solid.empty()) valid.solid.assign(input.triangles.size(), 0);
    // Facets of one solid must not come into contact by snapping; those of several may touch.
    const auto [least, most] = std::minmax_element(valid.solid.begin(), valid.solid.end());
    if (*least != *most) valid.counts.facet_contacts = std::numeric_limits<int>::max();
    return choose_grid(input.vertices, valid, lowest, highest, progress);
}

// The triangles of one solid with the points they use.
GridSolid part_of(const GridSolid& all, int solid) {
    GridSolid part;
    part.grid = all.grid;
    std::vector<int> place(all.points.size(), -1);
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
        if (all.solid[t] != solid) continue;
        Triangle own = all.triangles[t];
        for (int& v : own) {
            int& p = place[index(v)];
            if (p < 0) {
                p = static_cast<int>(part.points.size());
                part.points.push_back(all.points[index(v)]);
                part.point_source.push_back(all.point_source[index(v)]);
            }
            v = p;
        }
        part.triangles.push_back(own);
        part.triangle_source.push_back(all.triangle_source[t]);
        part.solid.push_back(solid);
    }
    return part;
}

class Joiner {
  public:
    explicit Joiner(bool several) : several_(several) {}

    void add(SolidTets part, const GridSolid& grid) {
        std::vector<int> place(part.points.size());
        for (std::size_t p = 0; p < place.size(); ++p)
            place[p] = point_of(part.points[p], part.point_source[p]);
        const auto placed = [&](auto ids) {
            for (int& p : ids) p = place[index(p)];
            return ids;
        };
        for (const auto& tet : part.mesh.tets) result_.tets.push_back(placed(tet));
        result_.tet_solid.insert(result_.tet_solid.end(), part.mesh.tet_solid.begin(),
                                 part.mesh.tet_solid.end());
        for (const Triangle& t : part.mesh.skin) result_.skin.push_back(placed(t));
        for (const int t : part.mesh.skin_source)
            result_.skin_source.push_back(grid.triangle_source[index(t)]);
        result_.report.solids.push_back(std::move(part.report));
        last_of_part_ = static_cast<int>(result_.points.size());
    }

    TetResult take() { return std::move(result_); }

  private:
    // Nodes are shared between solids, never within one.
    int point_of(const Vec3d& point, int source) {
        const int next = static_cast<int>(result_.points.size());
        if (several_) {
            const auto [place, fresh] = known_.try_emplace(point, next);
            if (!fresh && place->second < last_of_part_) {
                ++result_.report.shared_points;
                int& kept = result_.point_source[index(place->second)];
                if (kept < 0) kept = source;
                return place->second;
            }
        }
        result_.points.push_back(point);
        result_.point_source.push_back(source);
        return next;
    }

    bool several_;
    int last_of_part_ = 0;
    std::map<Vec3d, int> known_;
    TetResult result_;
};

// Skin triangles of contacts that have no twin.
int unmatched(const TetResult& result, const Imprint& imprint) {
    int count = 0;
    for (std::size_t s = 0; s < result.skin.size(); ++s)
        count += imprint.contact[index(result.skin_source[s])] >= 0 && result.skin_twin[s] < 0;
    return count;
}

// What is meshed: the imprinted surface, whose contacts get more points as meshes need them.
struct Work {
    Imprint imprint;
    TetInput surface;
    int round = 0;  // of meshing with more points

    void begin(const TetInput& input, Progress& progress) {
        imprint = imprint_contacts(input, progress);
        round = 0;
        prepare();
    }

    void prepare() {
        surface = imprint.any() ? with_contact_faces(imprint) : std::move(imprint.surface);
    }
};

TetResult mesh_solids(const TetInput& input, const GridSolid& grid, const Imprint& imprint,
                      const TetOptions& options, std::vector<ContactPoint>& contact_points,
                      StageClock& clock, Progress& progress) {
    std::vector<int> solids = grid.solid;
    std::sort(solids.begin(), solids.end());
    solids.erase(std::unique(solids.begin(), solids.end()), solids.end());
    Joiner joiner(solids.size() > 1);
    for (const int solid : solids) {
        const GridSolid part = part_of(grid, solid);
        std::vector<int> faces;
        if (!input.face.empty())
            for (const int t : part.triangle_source) faces.push_back(input.face[index(t)]);
        SolidTets tets =
            tetrahedralize_solid({input, part, faces, solid}, options, clock, progress);
        find_contact_points(tets, part, imprint, contact_points);
        joiner.add(std::move(tets), part);
    }
    TetResult result = joiner.take();
    result.skin_twin =
        solids.size() > 1 ? skin_twins(result.skin) : std::vector<int>(result.skin.size(), -1);
    return result;
}

// Back to the caller's triangles and vertices.
void name_by_caller(const TetInput& input, const Imprint& imprint, TetResult& result) {
    for (int& t : result.skin_source) t = imprint.source[index(t)];
    for (int& v : result.point_source)
        if (v >= static_cast<int>(input.vertices.size())) v = -1;
}

constexpr int kContactRounds = 8;

// All solids on one grid, or nothing when a solid needs more points on its contacts: these are then
// vertices of both sides for the next round.
std::optional<TetResult> mesh_round(const TetInput& input, const TetOptions& options,
                                    GridChoice&& choice, Work& work, StageClock& clock,
                                    Progress& progress) {
    std::vector<ContactPoint> points;
    TetResult result =
        mesh_solids(work.surface, choice.solid, work.imprint, options, points, clock, progress);
    const int open = unmatched(result, work.imprint);
    if (open > 0) {
        if (points.empty() || work.round == kContactRounds)
            throw VerificationFailed("solids in contact have different triangles on " +
                                     std::to_string(open) + " places of their common faces");
        add_contact_points(std::move(points), work.imprint);
        work.prepare();
        ++work.round;
        return std::nullopt;
    }
    name_by_caller(input, work.imprint, result);
    result.report.snap = choice.report;
    result.report.snap.merged_points += work.imprint.merged_points;
    result.report.rejected_grids = std::move(choice.rejected);
    result.report.contact_rounds = work.round;
    return result;
}

}  // namespace

TetResult tetrahedralize(const TetInput& input, const TetOptions& options, Progress& progress) {
    expect_ids(input);
    StageClock clock;
    std::vector<std::string> failures;
    const int lowest = options.grid_bits ? options.grid_bits : kCoarsestBits;
    const int highest = options.grid_bits ? options.grid_bits : kFinestBits;
    Work work;
    {
        const StageClock::Scope scope(clock, "contacts");
        work.begin(input, progress);
    }
    TetOptions chosen = options;
    for (int bits = lowest;;) {
        GridChoice choice;
        try {
            const StageClock::Scope scope(clock, "snap");
            choice = snapped(work.surface, bits, highest, progress);
        } catch (const InvalidSolid&) {
            if (work.round > 0 && chosen.compact.level == CompactLevel::none) {
                failures.push_back("contacts need too many points without compaction");
                chosen.compact.level = CompactLevel::standard;
                work.begin(input, progress);
                continue;
            }
            // A finer grid that is worse is no reason to call the solid invalid.
            if (failures.empty() && work.round == 0) throw;
            throw VerificationFailed(failures.empty() ? "solids in contact cross each other when "
                                                        "their contact gets more vertices"
                                                      : failures.back());
        }
        const int used = choice.solid.grid.bits;
        const auto give_up_or_refine = [&](const char* what) {
            failures.push_back("grid of 2^" + std::to_string(used) + ": " + what);
            if (used + 2 > highest) throw;
            bits = used + 2;
        };
        try {
            std::optional<TetResult> result =
                mesh_round(input, chosen, std::move(choice), work, clock, progress);
            if (!result) continue;
            for (SolidReport& solid : result->report.solids)
                solid.repairs.insert(solid.repairs.begin(), failures.begin(), failures.end());
            result->report.seconds = clock.seconds;
            result->report.quality = tet_quality(result->points, result->tets);
            return std::move(*result);
        } catch (const VerificationFailed& e) {
            give_up_or_refine(e.what());
        } catch (const InvalidSolid& e) {
            give_up_or_refine(e.what());
        }
    }
}

}  // namespace tetra

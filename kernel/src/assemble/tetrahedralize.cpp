// SPDX-License-Identifier: LGPL-2.1-or-later
// From the caller's arrays to solids on one grid, and from their meshes to one with shared nodes.
#include "tetra/assemble/tetrahedralize.h"

#include <algorithm>
#include <numeric>

#include "tetra/solid/validate.h"
#include "tetrahedralize_contacts.h"
#include "tetrahedralize_solid.h"

namespace tetra {
namespace {

constexpr int kCoarsestBits = 20, kFinestBits = 26;
constexpr std::size_t kMostRestarts = 8;

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
    return choose_grid(input.vertices, valid, lowest, highest, progress);
}

// Tries grids from the coarsest until the solid fits into the assembly.
class SolidMesher {
  public:
    SolidMesher(const TetOptions& options, StageClock& clock, Progress& progress)
        : options_(options), clock_(clock), progress_(progress) {}

    void add(int solid, Assembly& assembly) {
        const SolidSurface surface = assembly.surface_of(solid);
        std::vector<std::string> failures;
        const int lowest = options_.grid_bits ? options_.grid_bits : kCoarsestBits;
        const int highest = options_.grid_bits ? options_.grid_bits : kFinestBits;
        for (int bits = lowest;;) {
            GridChoice choice = grid_for_solid(surface, bits, highest, failures);
            const int used = choice.solid.grid.bits;
            if (used + 2 <= highest && !keeps_contacts(surface, choice.solid)) {
                failures.push_back("grid of 2^" + std::to_string(used) +
                                   ": too coarse for the triangles of a contact");
                bits = used + 2;
                continue;
            }
            const auto give_up_or_refine = [&](const char* what) {
                failures.push_back("grid of 2^" + std::to_string(used) + ": " + what);
                if (used + 2 > highest) throw;
                bits = used + 2;
            };
            try {
                SolidTets tets = mesh(surface, choice.solid, solid);
                std::vector<std::string>& repairs = tets.report.repairs;
                repairs.insert(repairs.begin(), failures.begin(), failures.end());
                assembly.add(surface, std::move(tets), choice.solid);
                note(choice);
                return;
            } catch (const VerificationFailed& e) {
                give_up_or_refine(e.what());
            } catch (const InvalidSolid& e) {
                give_up_or_refine(e.what());
            }
        }
    }

    SnapReport snap;
    std::vector<int> rejected_grids;

  private:
    GridChoice grid_for_solid(const SolidSurface& surface, int lowest, int highest,
                              const std::vector<std::string>& failures) {
        try {
            const StageClock::Scope scope(clock_, "snap");
            return snapped(surface.input, lowest, highest, progress_);
        } catch (const InvalidSolid&) {
            // A finer grid that is worse is no reason to call the solid invalid.
            if (failures.empty()) throw;
            throw VerificationFailed(failures.back());
        }
    }

    SolidTets mesh(const SolidSurface& surface, const GridSolid& grid, int solid) {
        std::vector<int> faces;
        if (!surface.input.face.empty())
            for (const int t : grid.triangle_source) faces.push_back(surface.input.face[index(t)]);
        return tetrahedralize_solid({surface.input, grid, faces, solid}, options_, clock_,
                                    progress_);
    }

    void note(const GridChoice& choice) {
        snap.merged_points += choice.report.merged_points;
        snap.dropped_triangles += choice.report.dropped_triangles;
        snap.flipped_edges += choice.report.flipped_edges;
        rejected_grids.insert(rejected_grids.end(), choice.rejected.begin(), choice.rejected.end());
    }

    const TetOptions& options_;
    StageClock& clock_;
    Progress& progress_;
};

std::vector<int> solids_of(const TetInput& input) {
    std::vector<int> solids = input.solid;
    if (solids.empty()) solids.push_back(0);
    std::sort(solids.begin(), solids.end());
    solids.erase(std::unique(solids.begin(), solids.end()), solids.end());
    return solids;
}

// Mostly the first order does. Points of a contact may lie so close to each other that the later
// solid has no grid for them; then it goes first and the contact is of its making.
TetResult mesh_in_some_order(const TetInput& input, const Imprint& imprint,
                             const TetOptions& options, StageClock& clock, Progress& progress) {
    std::vector<int> order = solids_of(input);
    std::vector<std::string> restarts;
    for (;;) {
        Assembly assembly(imprint);
        SolidMesher mesher(options, clock, progress);
        std::size_t next = 0;
        const auto give_up_or_restart = [&](const char* what) {
            if (next == 0 || !imprint.any() || restarts.size() == kMostRestarts) throw;
            restarts.push_back("solid " + std::to_string(order[next]) + " goes first: " + what);
            std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(next),
                        order.begin() + static_cast<std::ptrdiff_t>(next) + 1);
        };
        try {
            for (; next < order.size(); ++next) mesher.add(order[next], assembly);
            TetResult result = assembly.take(input.vertices.size());
            std::vector<std::string>& repairs = result.report.solids.front().repairs;
            repairs.insert(repairs.begin(), restarts.begin(), restarts.end());
            result.report.snap.merged_points += mesher.snap.merged_points;
            result.report.snap.dropped_triangles = mesher.snap.dropped_triangles;
            result.report.snap.flipped_edges = mesher.snap.flipped_edges;
            result.report.rejected_grids = std::move(mesher.rejected_grids);
            return result;
        } catch (const VerificationFailed& e) {
            give_up_or_restart(e.what());
        } catch (const InvalidSolid& e) {
            give_up_or_restart(e.what());
        }
    }
}

}  // namespace

TetResult tetrahedralize(const TetInput& input, const TetOptions& options, Progress& progress) {
    expect_ids(input);
    StageClock clock;
    const auto imprinted = [&] {
        const StageClock::Scope scope(clock, "contacts");
        return imprint_contacts(input, progress);
    };
    TetResult result = mesh_in_some_order(input, imprinted(), options, clock, progress);
    result.report.seconds = clock.seconds;
    result.report.quality = tet_quality(result.points, result.tets);
    return result;
}

}  // namespace tetra

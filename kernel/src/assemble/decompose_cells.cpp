// SPDX-License-Identifier: LGPL-2.1-or-later
// Which method is tried, and what follows when one fails.
#include "tetra/assemble/decompose_cells.h"

#include <cmath>
#include <optional>
#include <utility>

#include "tetra/assemble/cells_of_fences.h"
#include "tetra/errors.h"
#include "tetra/solid/conform_contacts.h"

namespace tetra {
namespace {

// Fences are tried on solids of so few triangles, where they cost little.
constexpr std::size_t kFencedTriangles = 5000;

// About one cell a notch is the least that most solids need; notches that cross one another make
// more, and there fences may do better.
constexpr double kCellsPerNotch = 1.1;

// Relative error of all solids' volume that a result may have; see verify.py. A thin solid among
// others may have more.
constexpr double kVolumeTolerance = 1e-7;

void require_volume(const CellsStats& stats) {
    if (std::fabs(stats.volume - stats.solid_volume) >
        kVolumeTolerance * std::fabs(stats.solid_volume))
        throw VerificationFailed("the cells' volumes do not add up to the solids'");
}

// Facets in contact within one solid can leave a section that does not close; giving both sides of
// every contact common vertices first helps there, and would only cost time elsewhere.
CellsOutcome by_notches(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                        const CellsOptions& options, Progress& progress) {
    CellsOutcome outcome;
    try {
        outcome.cells = convex_cells(solid, vertices, options, progress);
        require_volume(outcome.cells.stats);
    } catch (const VerificationFailed&) {
        outcome.cells = convex_cells(conform_contacts(solid), vertices, options, progress);
        require_volume(outcome.cells.stats);
    }
    outcome.by_bajaj_dey = static_cast<int>(outcome.cells.cell_solid.size());
    return outcome;
}

CellsOutcome outcome_of(FencedCells&& fenced) {
    require_volume(fenced.cells.stats);
    CellsOutcome outcome;
    outcome.by_fences = static_cast<int>(fenced.cells.cell_solid.size());
    outcome.cells = std::move(fenced.cells);
    outcome.method = CellsMethod::fences;
    outcome.directions = std::move(fenced.directions);
    return outcome;
}

CellsOutcome by_fences(const GridSolid& solid, const std::vector<Vec3d>& vertices, bool merge,
                       Progress& progress) {
    return outcome_of(*cells_of_fences(solid, vertices, merge, std::nullopt, progress));
}

// Why fences are not worth a try; empty when they are.
std::string reason_against_fences(const CellsOutcome& cut, const GridSolid& solid,
                                  const CellsOptions& options) {
    if (cut.cells.stats.notches == 0) return "no notch to resolve";
    if (options.rule == NotchRule::plain) return "the plain method was asked for";
    if (solid.triangles.size() > kFencedTriangles) return "too many triangles to try fences";
    if (cut.by_bajaj_dey <= kCellsPerNotch * cut.cells.stats.notches)
        return "few notches cross each other";
    return {};
}

CellsOutcome fewer_of(CellsOutcome&& cut, CellsOutcome&& fenced) {
    const int cells = cut.by_bajaj_dey, others = fenced.by_fences;
    CellsOutcome fewer = others < cells ? std::move(fenced) : std::move(cut);
    fewer.by_bajaj_dey = cells;
    fewer.by_fences = others;
    fewer.note = others == cells ? "as many pieces by fences" : "fewer pieces";
    return fewer;
}

CellsOutcome by_fewer_pieces(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                             const CellsOptions& options, Progress& progress) {
    CellsOutcome cut;
    try {
        cut = by_notches(solid, vertices, options, progress);
    } catch (const VerificationFailed& e) {
        CellsOutcome fenced = by_fences(solid, vertices, options.merge, progress);
        fenced.note = std::string("notch cutting failed: ") + e.what();
        return fenced;
    }
    cut.note = reason_against_fences(cut, solid, options);
    if (!cut.note.empty()) return cut;
    try {
        const auto beat = static_cast<std::size_t>(cut.by_bajaj_dey);
        std::optional<FencedCells> fenced =
            cells_of_fences(solid, vertices, options.merge, beat, progress);
        if (fenced) return fewer_of(std::move(cut), outcome_of(std::move(*fenced)));
        cut.note = "fences promise more pieces";
    } catch (const VerificationFailed& e) {
        cut.note = std::string("fences failed: ") + e.what();
    } catch (const InvalidSolid& e) {
        cut.note = std::string("fences failed: ") + e.what();
    }
    return cut;
}

}  // namespace

CellsOutcome decompose_cells(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                             CellsMethod method, const CellsOptions& options, Progress& progress) {
    switch (method) {
        case CellsMethod::fences:
            return by_fences(solid, vertices, options.merge, progress);
        case CellsMethod::automatic:
            return by_fewer_pieces(solid, vertices, options, progress);
        case CellsMethod::bajaj_dey:
            break;
    }
    return by_notches(solid, vertices, options, progress);
}

}  // namespace tetra

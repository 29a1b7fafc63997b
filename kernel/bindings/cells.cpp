// SPDX-License-Identifier: LGPL-2.1-or-later
// convex_cells(): exact convex cells of a valid surface, by the method that gives fewer, as a dict.
#include "convert.h"
#include "tetra/assemble/decompose_cells.h"
#include "tetra/solid/snap.h"
#include "tetra/solid/validate.h"

namespace tetra::python {
namespace {

constexpr int kNotchBits = 26;  // the finest grid whose predicates fit 256 bits

CellsMethod to_method(const nb::dict& options) {
    const auto method = option_or<std::string>(options, "method", "bajaj-dey");
    if (method == "bajaj-dey") return CellsMethod::bajaj_dey;
    if (method == "fences") return CellsMethod::fences;
    if (method == "auto") return CellsMethod::automatic;
    throw nb::value_error("option method must be auto, bajaj-dey or fences");
}

CellsOptions to_options(const nb::dict& options) {
    CellsOptions chosen;
    const auto rule = option_or<std::string>(
        options, "rule", option_or(options, "plain", false) ? "plain" : "cover");
    if (rule != "plain" && rule != "cover" && rule != "random")
        throw nb::value_error("option rule must be plain, cover or random");
    chosen.rule = rule == "plain" ? NotchRule::plain
                                  : (rule == "random" ? NotchRule::random : NotchRule::cover);
    const auto extent = option_or<std::string>(options, "extent", "notch");
    if (extent != "notch" && extent != "whole" && extent != "random")
        throw nb::value_error("option extent must be notch, whole or random");
    chosen.extent = extent == "whole"
                        ? CutExtent::whole_plane
                        : (extent == "random" ? CutExtent::random : CutExtent::notch_components);
    chosen.merge = option_or(options, "merge", true);
    chosen.flatness = option_or(options, "flatness", chosen.flatness);
    if (!(chosen.flatness >= 0 && chosen.flatness <= 8))
        throw nb::value_error("option flatness must be in 0..8 grid steps");
    chosen.tries = option_or(options, "tries", chosen.tries);
    chosen.seed = option_or<std::uint64_t>(options, "seed", 0);
    return chosen;
}

nb::dict to_report(const CellsOutcome& outcome, double step) {
    const CellsStats& s = outcome.cells.stats;
    nb::dict counts;
    counts["notches"] = s.notches;
    counts["planes"] = s.planes;
    counts["cuts"] = s.cuts;
    counts["splices"] = s.splices;
    counts["raw_cells"] = s.raw_cells;
    counts["pieces"] = outcome.cells.cell_solid.size();
    counts["points"] = outcome.cells.points.size();
    if (outcome.by_bajaj_dey >= 0) counts["pieces_by_bajaj_dey"] = outcome.by_bajaj_dey;
    if (outcome.by_fences >= 0) counts["pieces_by_fences"] = outcome.by_fences;
    nb::dict repairs;
    repairs["restarts"] = s.restarts;
    repairs["demoted_classes"] = s.demoted;
    nb::dict report;
    const bool fenced = outcome.method == CellsMethod::fences;
    report["method"] = fenced ? "fences" : "bajaj-dey";
    if (fenced) {
        nb::list directions;
        for (const std::string& name : outcome.directions) directions.append(name);
        report["fence_directions"] = directions;
    }
    if (!outcome.note.empty()) report["choice"] = outcome.note;
    report["counts"] = counts;
    report["repairs"] = repairs;
    report["flatness"] = s.flatness;
    report["flatness_length"] = s.flatness * step;
    report["exact"] = s.exact;
    report["grid_step"] = step;
    report["verdict"] = "verified";
    return report;
}

std::string hexadecimal(const Int256& value) {
    // With sign, as Python's int(text, 16) reads it.
    const bool minus = value.negative();
    const Int256 m = minus ? -value : value;
    std::string text = minus ? "-" : "";
    char digits[17];
    for (int i = 3; i >= 0; --i) {
        std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(m.limb[i]));
        text += digits;
    }
    return text;
}

// Rows (x, y, z, w) of homogeneous grid coordinates as hexadecimal text.
nb::list exact_rows(const std::vector<HPoint>& points) {
    nb::list rows;
    for (const HPoint& p : points)
        rows.append(
            nb::make_tuple(hexadecimal(p.x), hexadecimal(p.y), hexadecimal(p.z), hexadecimal(p.w)));
    return rows;
}

nb::dict convex_cells_arrays(const VertexArray& vertex_array, const TriangleArray& triangle_array,
                             nb::handle solid_ids, const nb::dict& options, nb::object progress) {
    const std::vector<Vec3d> vertices = to_vertices(vertex_array);
    const std::vector<Triangle> triangles = to_triangles(triangle_array);
    const std::vector<int> solid = optional_ids(solid_ids);
    const CellsOptions chosen = to_options(options);
    const CellsMethod method = to_method(options);
    double step = 0;
    Vec3d origin{};
    CellsOutcome outcome = without_gil(std::move(progress), [&](Progress& p) {
        const GridSolid grid =
            build_grid_solid(SurfaceView{vertices, triangles, {}, solid}, kNotchBits);
        step = grid.grid.step;
        origin = grid.grid.origin;
        std::vector<Defect> defects = find_defects(grid, p);
        if (!defects.empty()) throw InvalidSolid(std::move(defects));
        return decompose_cells(grid, vertices, method, chosen, p);
    });
    ConvexCells& cells = outcome.cells;
    nb::dict result;
    result["report"] = to_report(outcome, step);
    if (option_or(options, "exact_points", false)) {
        result["exact_points"] = exact_rows(cells.exact);
        result["grid_origin"] = nb::make_tuple(origin[0], origin[1], origin[2]);
    }
    result["points"] = rows_to_numpy(cells.points);
    result["point_source"] = to_numpy(std::move(cells.point_source));
    result["facet_offsets"] = to_numpy(std::move(cells.facet_offsets));
    result["facet_vertices"] = to_numpy(std::move(cells.facet_vertices));
    result["facet_source"] = to_numpy(std::move(cells.facet_source));
    result["cell_offsets"] = to_numpy(std::move(cells.cell_offsets));
    result["cell_solid"] = to_numpy(std::move(cells.cell_solid));
    return result;
}

}  // namespace

void bind_cells(nb::module_& m) {
    m.def("convex_cells", &convex_cells_arrays, nb::arg("vertices"), nb::arg("triangles"),
          nb::arg("solid") = nb::none(), nb::arg("options") = nb::dict(),
          nb::arg("progress") = nb::none(),
          R"(Partition a valid surface into convex cells by notch cutting or fences.

vertices f64 (n, 3); triangles i32 (m, 3) facing outward, index base 0; solid i32 (m,) or None.
Options: `method` (bajaj-dey, fences, auto: fewer pieces), `plain`, `merge` (True), `flatness` (4
grid steps; of bajaj-dey), `tries` (1), `seed` (0); for tests `rule` (cover, plain, random),
`extent` (notch, whole, random), `exact_points` (also return the points as hexadecimal homogeneous
grid coordinates).
Returns a dict: points f64 (p, 3), point_source i32 (p,), facet_offsets i64 (f+1,),
facet_vertices i32, facet_source i32 (f,), cell_offsets i64 (c+1,), cell_solid i32 (c,), report.
Raises InvalidSolid, VerificationFailed, Cancelled.)");
}

}  // namespace tetra::python

// SPDX-License-Identifier: LGPL-2.1-or-later
// tetrahedralize(): conforming tetrahedra of a valid surface, as a dict.
#include "tetra/assemble/imprint_contacts.h"

#include <algorithm>

#include "convert.h"
#include "tetra/assemble/tetrahedralize.h"

namespace tetra::python {
namespace {

template <class Value>
Value named(const nb::dict& options, const char* name,
            const std::vector<std::pair<const char*, Value>>& values) {
    const auto text = option_or<std::string>(options, name, values.front().first);
    for (const auto& [key, value] : values)
        if (text == key) return value;
    std::string known;
    for (const auto& [key, value] : values) known += std::string(known.empty() ? "" : ", ") + key;
    throw nb::value_error(
        ("option " + std::string(name) + " must be one of " + known + ", not " + text).c_str());
}

std::optional<Vec3d> to_direction(const nb::object& value) {
    if (value.is_none()) return std::nullopt;
    if (!nb::isinstance<nb::str>(value)) {
        const auto row = nb::cast<std::vector<double>>(value);
        if (row.size() != 3 || (row[0] == 0 && row[1] == 0 && row[2] == 0))
            throw nb::value_error("option direction must be three numbers, not all zero");
        return Vec3d{row[0], row[1], row[2]};
    }
    const auto text = nb::cast<std::string>(value);
    if (text == "auto") return std::nullopt;
    if (text == "x") return Vec3d{1, 0, 0};
    if (text == "y") return Vec3d{0, 1, 0};
    if (text == "z") return Vec3d{0, 0, 1};
    throw nb::value_error("option direction must be auto, x, y, z or three numbers");
}

TetOptions to_options(const nb::dict& options) {
    TetOptions chosen;
    chosen.method = named<TetMethod>(
        options, "method",
        {{"chazelle-palios", TetMethod::chazelle_palios}, {"bajaj-dey", TetMethod::bajaj_dey}});
    chosen.direction = to_direction(option(options, "direction"));
    const nb::object candidates = option(options, "directions");
    if (!candidates.is_none()) chosen.candidates = to_vertices(nb::cast<VertexArray>(candidates));
    chosen.pull_off = named<PullPolicy>(
        options, "pull_off",
        {{"auto", PullPolicy::automatic}, {"on", PullPolicy::on}, {"off", PullPolicy::off}});
    chosen.compact.level = named<CompactLevel>(options, "compact",
                                               {{"default", CompactLevel::standard},
                                                {"max", CompactLevel::max},
                                                {"off", CompactLevel::none}});
    chosen.compact.seconds = option_or(options, "compact_seconds", 0.0);
    chosen.compact.seed = option_or<std::uint64_t>(options, "seed", chosen.compact.seed);
    chosen.grid_bits = option_or(options, "grid_bits", 0);
    if (chosen.grid_bits != 0 && (chosen.grid_bits < 8 || chosen.grid_bits > 26))
        throw nb::value_error("option grid_bits must be in 8..26, or 0 for the best");
    chosen.quality = option_or(options, "quality", false);
    return chosen;
}

nb::dict to_dict(const SteinerCount& c) {
    nb::dict d;
    d["edge"] = c.edge;
    d["facet"] = c.facet;
    d["inner"] = c.inner;
    return d;
}

nb::dict to_dict(const PullStatistics& p) {
    nb::dict d;
    d["removed"] = p.removed;
    d["tries"] = p.tries;
    d["flips"] = p.flips;
    d["refused_owner"] = p.refused_owner;
    d["refused_degree"] = p.refused_degree;
    d["refused_gain"] = p.refused_gain;
    d["hindered_by_vertex"] = p.hindered_by_vertex;
    d["hindered_by_edge"] = p.hindered_by_edge;
    d["crowns_by_degree"] = p.crowns_by_degree;
    return d;
}

nb::dict to_dict(const FenceCounts& c) {
    nb::dict d;
    d["facets"] = c.facets;
    d["sharp_edges"] = c.sharp_edges;
    d["lines"] = c.lines;
    d["cells"] = c.cells;
    d["base_triangles"] = c.base_triangles;
    d["steiner_points"] = c.steiner_points;
    d["cyclic_columns"] = c.cyclic_columns;
    d["wall_sides"] = c.wall_sides;
    d["propagated"] = c.propagated;
    return d;
}

nb::dict to_dict(const CellTetCounts& c) {
    nb::dict d;
    d["notches"] = c.notches;
    d["planes"] = c.planes;
    d["cuts"] = c.cuts;
    d["raw_cells"] = c.raw_cells;
    d["cells"] = c.cells;
    d["pieces"] = c.pieces;
    d["cone_cells"] = c.cone_cells;
    return d;
}

nb::dict to_dict(const CompactStats& c) {
    nb::dict d;
    d["tets_before"] = c.tets_before;
    d["tets_after"] = c.tets_after;
    d["steiner_before"] = to_dict(c.steiner_before);
    d["steiner_after"] = to_dict(c.steiner_after);
    d["collapses"] = c.collapses;
    d["unlocked"] = c.unlocked;
    d["reducing_flips"] = c.reducing_flips;
    d["rounds"] = c.rounds;
    return d;
}

nb::dict to_dict(const RestoreStats& r) {
    nb::dict d;
    d["input_vertices"] = r.input_vertices;
    d["vertices_on_grid"] = r.vertices_on_grid;
    d["steiner_points"] = r.steiner_points;
    d["steiner_on_grid"] = r.steiner_on_grid;
    d["steiner_off_plane"] = r.steiner_off_plane;
    d["put_back"] = r.put_back;
    d["flips"] = r.flips;
    d["walks"] = r.walks;
    d["peeled"] = r.peeled;
    d["slivers"] = r.slivers;
    d["quality_flips"] = r.quality_flips;
    d["left"] = r.left;
    return d;
}

nb::dict to_dict(const SolidReport& s) {
    nb::list directions;
    for (const DirectionTrial& trial : s.directions) {
        nb::dict row;
        row["direction"] = trial.name;
        row["cost"] = trial.cost;
        row["note"] = trial.note;
        directions.append(row);
    }
    nb::dict crossings;
    for (const auto& [state, count] : s.crossings) crossings[state.c_str()] = count;
    nb::dict d;
    d["solid"] = s.solid;
    d["grid_bits"] = s.grid_bits;
    d["direction"] = s.direction;
    d["directions"] = directions;
    d["pulled"] = s.pulled;
    d["crossings"] = crossings;
    d["pull_off"] = to_dict(s.pull);
    d["cup_tets"] = s.cup_tets;
    d["fence_off"] = to_dict(s.fences);
    d["notch_cutting"] = to_dict(s.cells);
    d["compact"] = to_dict(s.compact);
    d["restore"] = to_dict(s.restore);
    d["steiner_distance"] = s.check.steiner_distance;
    d["area_error"] = s.check.area_error;
    d["failed_attempts"] = s.repairs;
    return d;
}

nb::dict to_dict(const TetQuality& q) {
    nb::dict d;
    d["histogram"] = std::vector<int>(q.histogram.begin(), q.histogram.end());
    d["histogram_bounds"] = std::vector<double>{1e-6, 1e-4, 1e-3, 1e-2, 0.05, 0.1, 0.2, 0.4, 0.7};
    d["min_mean_ratio"] = q.min;
    d["mean_ratio"] = q.mean;
    d["min_dihedral"] = q.min_dihedral;
    d["max_dihedral"] = q.max_dihedral;
    d["min_height"] = q.min_height;
    return d;
}

// Sums over the solids.
struct Totals {
    SteinerCount steiner;
    int raw_tets = 0, raw_steiner = 0, pulled = 0, vertices_on_grid = 0, off_plane = 0;
    int unblocked = 0, peeled = 0;
    double volume = 0, error = 0;
};

Totals totals_of(const TetResult& r) {
    Totals t;
    for (const SolidReport& s : r.report.solids) {
        t.steiner.edge += s.compact.steiner_after.edge;
        t.steiner.facet += s.compact.steiner_after.facet;
        t.steiner.inner += s.compact.steiner_after.inner;
        t.raw_tets += s.compact.tets_before;
        t.raw_steiner += s.compact.steiner_before.total();
        t.pulled += s.pull.removed;
        t.vertices_on_grid += s.restore.vertices_on_grid;
        t.off_plane += s.restore.steiner_off_plane;
        t.unblocked += s.restore.flips;
        t.peeled += s.restore.peeled;
        t.volume += s.check.volume;
        t.error += s.check.volume_error * s.check.volume;
    }
    if (t.volume > 0) t.error /= t.volume;
    return t;
}

nb::dict to_report(const TetResult& r, TetMethod method) {
    const Totals total = totals_of(r);
    nb::dict counts, seconds, repairs, report;
    counts["tets"] = r.tets.size();
    counts["points"] = r.points.size();
    counts["skin_triangles"] = r.skin.size();
    counts["steiner_edge"] = total.steiner.edge;
    counts["steiner_facet"] = total.steiner.facet;
    counts["steiner_inner"] = total.steiner.inner;
    counts["tets_before_compaction"] = total.raw_tets;
    counts["steiner_before_compaction"] = total.raw_steiner;
    counts["pulled_vertices"] = total.pulled;
    counts["shared_points"] = r.report.shared_points;
    counts["contact_triangles"] =
        (r.skin_twin.size() -
         static_cast<std::size_t>(std::count(r.skin_twin.begin(), r.skin_twin.end(), -1))) /
        2;
    for (const auto& [stage, time] : r.report.seconds) seconds[stage.c_str()] = time;
    repairs["vertices_on_grid"] = total.vertices_on_grid;
    repairs["steiner_off_plane"] = total.off_plane;
    repairs["unblocking_flips"] = total.unblocked;
    repairs["peeled"] = total.peeled;
    repairs["contact_points"] = r.report.contact_points;
    repairs["merged_points"] = r.report.snap.merged_points;
    repairs["flipped_edges"] = r.report.snap.flipped_edges;
    nb::list solids;
    for (const SolidReport& s : r.report.solids) solids.append(to_dict(s));
    report["method"] = method == TetMethod::bajaj_dey ? "bajaj-dey" : "chazelle-palios";
    report["direction"] = r.report.solids.empty() ? "" : r.report.solids.front().direction;
    report["seconds"] = seconds;
    report["counts"] = counts;
    report["volume"] = total.volume;
    report["volume_error"] = total.error;
    report["quality"] = to_dict(r.report.quality);
    report["repairs"] = repairs;
    report["rejected_grids"] = r.report.rejected_grids;
    report["solids"] = solids;
    report["verdict"] = "verified";
    return report;
}

nb::dict tetrahedralize_arrays(const VertexArray& vertices, const TriangleArray& triangles,
                               const nb::object& solid, const nb::dict& options,
                               nb::object progress) {
    TetInput input{to_vertices(vertices), to_triangles(triangles), optional_ids(solid),
                   optional_ids(option(options, "face_ids"))};
    const TetOptions chosen = to_options(options);
    TetResult r = without_gil(std::move(progress),
                              [&](Progress& p) { return tetrahedralize(input, chosen, p); });
    nb::dict result;
    result["report"] = to_report(r, chosen.method);
    std::vector<int> face = r.skin_source;
    if (!input.face.empty())
        for (int& f : face) f = input.face[static_cast<std::size_t>(f)];
    result["points"] = rows_to_numpy(r.points);
    result["point_source"] = to_numpy(std::move(r.point_source));
    result["tets"] = rows_to_numpy(r.tets);
    result["tet_solid"] = to_numpy(std::move(r.tet_solid));
    result["skin"] = rows_to_numpy(r.skin);
    result["skin_source"] = to_numpy(std::move(r.skin_source));
    result["skin_twin"] = to_numpy(std::move(r.skin_twin));
    result["skin_face"] = to_numpy(std::move(face));
    return result;
}

nb::dict outer_surface_arrays(const VertexArray& vertices, const TriangleArray& triangles,
                              const nb::object& solid, nb::object progress) {
    const TetInput input{to_vertices(vertices), to_triangles(triangles), optional_ids(solid), {}};
    const Imprint imprint =
        without_gil(std::move(progress), [&](Progress& p) { return imprint_contacts(input, p); });
    std::vector<Triangle> outer;
    std::vector<int> source;
    for (std::size_t t = 0; t < imprint.contact.size(); ++t) {
        if (imprint.contact[t] >= 0) continue;
        outer.push_back(imprint.surface.triangles[t]);
        source.push_back(imprint.source[t]);
    }
    nb::dict result;
    result["vertices"] = rows_to_numpy(imprint.surface.vertices);
    result["triangles"] = rows_to_numpy(outer);
    result["triangle_source"] = to_numpy(std::move(source));
    return result;
}

}  // namespace

void bind_tets(nb::module_& m) {
    m.def("outer_surface", &outer_surface_arrays, nb::arg("vertices"), nb::arg("triangles"),
          nb::arg("solid") = nb::none(), nb::arg("progress") = nb::none(),
          R"(What bounds all solids together: their surface without the contacts between them.

vertices f64 (n, 3); triangles i32 (m, 3), index base 0, valid; solid i32 (m,) or None.
Returns a dict: `vertices` f64 (n + k, 3), `triangles` i32 (u, 3), `triangle_source` i32 (u,).
Raises VerificationFailed, Cancelled.)");
    m.def("tetrahedralize", &tetrahedralize_arrays, nb::arg("vertices"), nb::arg("triangles"),
          nb::arg("solid") = nb::none(), nb::arg("options") = nb::dict(),
          nb::arg("progress") = nb::none(),
          R"(Fill a valid surface with face-to-face tetrahedra.

vertices f64 (n, 3); triangles i32 (m, 3), index base 0, closed and outward; solid i32 (m,) or
None. Options: `method` ("chazelle-palios", "bajaj-dey"), `direction` ("auto", "x", "y", "z" or three numbers), `directions` f64 (k, 3)
candidates, `pull_off` ("auto", "on", "off"), `compact` ("default", "max", "off"),
`compact_seconds` (0 = no limit), `seed`, `grid_bits` (0 = the coarsest of 20..26 that keeps the
vertices apart), `face_ids` i32 (m,), `quality` (False).
Returns a dict: `points` f64 (p, 3), `point_source` i32 (p,) vertex or -1, `tets` i32 (t, 4) of
positive orientation, `tet_solid` i32 (t,), `skin` i32 (s, 3) outward, `skin_source` i32 (s,) a
triangle of the same plane and face, `skin_face` i32 (s,), `skin_twin` i32 (s,) the skin triangle
of the solid in contact or -1, and `report`, a dict.
Raises InvalidSolid, VerificationFailed, Cancelled, ValueError for unknown options.)");
}

}  // namespace tetra::python

// SPDX-License-Identifier: LGPL-2.1-or-later
// validate(): exact validation of a surface, as a dict.
#include "tetra/solid/validate.h"

#include "convert.h"

namespace tetra::python {
namespace {

nb::dict to_dict(const Counts& c) {
    nb::dict d;
    d["vertices"] = c.vertices;
    d["triangles"] = c.triangles;
    d["facets"] = c.facets;
    d["notches"] = c.notches;
    d["shells"] = c.shells;
    d["solids"] = c.solids;
    d["genus"] = c.genus;
    d["euler"] = c.euler;
    d["type1_contacts"] = c.type1_contacts;
    d["type2_edges"] = c.type2_edges;
    d["type3_vertices"] = c.type3_vertices;
    d["facet_contacts"] = c.facet_contacts;
    d["merged_points"] = c.merged_points;
    d["dropped_triangles"] = c.dropped_triangles;
    d["flipped_edges"] = c.flipped_edges;
    return d;
}

nb::dict validate_arrays(const VertexArray& vertex_array, const TriangleArray& triangle_array,
                         const nb::dict& options, nb::object progress) {
    const std::vector<Vec3d> vertices = to_vertices(vertex_array);
    const std::vector<Triangle> triangles = to_triangles(triangle_array);
    const std::vector<int> solid = optional_ids(option(options, "solid"));
    ValidateOptions chosen;
    chosen.bits = option_or(options, "bits", chosen.bits);
    chosen.max_crossings = option_or(options, "max_crossings", chosen.max_crossings);
    if (chosen.bits < 1 || chosen.bits > validation_bits)
        throw nb::value_error("option bits must be in 1..40");
    Validation v = without_gil(std::move(progress), [&](Progress& p) {
        return validate(vertices, triangles, solid, chosen, p);
    });
    nb::dict result;
    result["defects"] = to_list(v.defects);
    result["triangles"] = rows_to_numpy(v.triangles);
    result["triangle_source"] = to_numpy(std::move(v.triangle_source));
    result["turned"] = v.turned;
    result["shell"] = to_numpy(std::move(v.shell));
    result["solid"] = to_numpy(std::move(v.solid));
    result["counts"] = to_dict(v.counts);
    return result;
}

}  // namespace

void bind_validate(nb::module_& m) {
    m.def("validate", &validate_arrays, nb::arg("vertices"), nb::arg("triangles"),
          nb::arg("options") = nb::dict(), nb::arg("progress") = nb::none(),
          R"(Validate a surface exactly.

vertices f64 (n, 3); triangles i32 (m, 3), index base 0. Options: `solid` i32 (m,), the B-rep
solid of each triangle; `bits` (40), the grid; `max_crossings` (100), pairs named.
Returns a dict: `defects`, a list of dicts (kind, vertices, triangles, message) with the caller's
ids; and when there are none `triangles` i32 (m2, 3) facing outward, `triangle_source` i32 (m2,),
`turned` (ids of shells that were inside out), `shell` and `solid` i32 (m2,), and `counts`.
Raises Cancelled; nothing for a bad surface.)");
}

}  // namespace tetra::python

// SPDX-License-Identifier: LGPL-2.1-or-later
// limit_cells(): cells within limits on their number and vertices, as a dict.
#include "convert.h"
#include "tetra/assemble/limit_cells.h"

namespace tetra::python {
namespace {

using OffsetArray = nb::ndarray<const std::int64_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

std::vector<std::int64_t> to_offsets(const OffsetArray& a) {
    return {a.data(), a.data() + a.shape(0)};
}

nb::dict limit_cells_arrays(const VertexArray& points, const OffsetArray& facet_offsets,
                            const IdArray& facet_vertices, const IdArray& facet_source,
                            const OffsetArray& cell_offsets, const IdArray& cell_solid,
                            int max_cells, int max_vertices, nb::object progress) {
    if (max_cells < 0) throw nb::value_error("option max_cells must be above zero");
    if (max_vertices < 0 || (max_vertices > 0 && max_vertices < 8))
        throw nb::value_error("option max_vertices must be 8 or more");
    const CellArrays part{to_vertices(points),  to_offsets(facet_offsets), to_ids(facet_vertices),
                          to_ids(facet_source), to_offsets(cell_offsets),  to_ids(cell_solid)};
    LimitedCells limited = without_gil(std::move(progress), [&](Progress& p) {
        return limit_cells(part, {max_cells, max_vertices}, p);
    });
    std::vector<int> cells;
    std::vector<Triangle> triangles;
    std::vector<std::int64_t> cell_ends{0}, triangle_ends{0};
    for (const LimitedPiece& piece : limited.pieces) {
        cells.insert(cells.end(), piece.cells.begin(), piece.cells.end());
        triangles.insert(triangles.end(), piece.triangles.begin(), piece.triangles.end());
        cell_ends.push_back(static_cast<std::int64_t>(cells.size()));
        triangle_ends.push_back(static_cast<std::int64_t>(triangles.size()));
    }
    nb::dict result;
    result["points"] = rows_to_numpy(limited.points);
    result["cells"] = to_numpy(std::move(cells));
    result["cell_offsets"] = to_numpy(std::move(cell_ends));
    result["triangles"] = rows_to_numpy(triangles);
    result["triangle_offsets"] = to_numpy(std::move(triangle_ends));
    result["error"] = limited.error;
    result["error_found"] = limited.error_found;
    result["volume_added"] = limited.volume_added;
    result["merged"] = limited.merged;
    result["simplified"] = limited.simplified;
    return result;
}

}  // namespace

void bind_limit(nb::module_& m) {
    m.def("limit_cells", &limit_cells_arrays, nb::arg("points"), nb::arg("facet_offsets"),
          nb::arg("facet_vertices"), nb::arg("facet_source"), nb::arg("cell_offsets"),
          nb::arg("cell_solid"), nb::arg("max_cells") = 0, nb::arg("max_vertices") = 0,
          nb::arg("progress") = nb::none(),
          R"(Merge convex cells into at most max_cells, of at most max_vertices each (0: no limit).

Arrays as convex_cells() returns them. Every piece contains its cells.
Returns a dict: points f64 (p, 3), those given first; piece i is made of the cells
cells[cell_offsets[i] : cell_offsets[i+1]] and has the triangles i32 triangles[triangle_offsets[i] :
triangle_offsets[i+1]], none when it is that one cell unchanged; error, the farthest that any point
of a piece is from the part, an upper bound; error_found, a lower one; volume_added; merged,
simplified: numbers of pieces. Raises ValueError, Cancelled.)");
}

}  // namespace tetra::python

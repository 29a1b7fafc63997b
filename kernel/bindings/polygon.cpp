// SPDX-License-Identifier: LGPL-2.1-or-later
// Planar polygons for Python: triangulation and guards on exact predicates of doubles.
#include <array>

#include "convert.h"
#include "tetra/polygon/double_points.h"
#include "tetra/polygon/guards.h"
#include "tetra/polygon/triangulate.h"

namespace tetra::python {
namespace {

using PointArray = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using Loops = std::vector<std::vector<PointId>>;

/// A rejected polygon, its edges told as (loop, corner from which the edge goes).
struct InvalidPolygon {
    std::string what;
    std::vector<std::array<int, 2>> edges;
    std::vector<PointId> points;
};

InvalidPolygon told_by_loops(const InvalidRegion& error, const Loops& loops) {
    InvalidPolygon told{error.what(), {}, error.points_at_fault};
    for (int edge : error.edges_at_fault) {
        int loop = 0;
        while (edge >= static_cast<int>(loops[loop].size())) {
            edge -= static_cast<int>(loops[loop++].size());
        }
        told.edges.push_back({loop, edge});
    }
    return told;
}

void check_ids(const Loops& loops, std::size_t n_points) {
    for (const std::vector<PointId>& loop : loops) {
        for (const PointId id : loop) {
            if (id < 0 || static_cast<std::size_t>(id) >= n_points) {
                throw InvalidRegion("point " + std::to_string(id) + " is not one of the " +
                                        std::to_string(n_points) + " points",
                                    {}, {id});
            }
        }
    }
}

std::vector<PlanarTriangle> triangulated(const std::vector<std::array<double, 2>>& points,
                                         const Loops& loops) {
    try {
        check_ids(loops, points.size());
        const DoublePoints oracle(points);
        return triangulate_region(region_of_loops(loops, oracle), oracle);
    } catch (const InvalidRegion& error) {
        throw told_by_loops(error, loops);
    }
}

std::vector<std::array<double, 2>> to_points(const PointArray& a) {
    std::vector<std::array<double, 2>> r(a.shape(0));
    if (!r.empty()) std::memcpy(r.data(), a.data(), r.size() * sizeof(r[0]));
    return r;
}

Loops to_loops(const std::vector<IdArray>& arrays) {
    Loops loops;
    for (const IdArray& a : arrays) loops.push_back(to_ids(a));
    return loops;
}

nb::object triangulate_polygon(const PointArray& points, const std::vector<IdArray>& loops) {
    const auto own_points = to_points(points);
    const Loops own_loops = to_loops(loops);
    std::vector<PlanarTriangle> triangles;
    {
        nb::gil_scoped_release release;
        triangles = triangulated(own_points, own_loops);
    }
    return rows_to_numpy(triangles);
}

nb::object guards_of_polygon(const PointArray& points, const std::vector<IdArray>& loops) {
    const auto own_points = to_points(points);
    const Loops own_loops = to_loops(loops);
    std::vector<PointId> guards;
    {
        nb::gil_scoped_release release;
        guards = place_guards(triangulated(own_points, own_loops));
    }
    return to_numpy(std::move(guards));
}

void translate(const std::exception_ptr& error, void* type) {
    try {
        std::rethrow_exception(error);
    } catch (const InvalidPolygon& e) {
        nb::list edges;
        for (const auto& [loop, corner] : e.edges) edges.append(nb::make_tuple(loop, corner));
        const nb::object value = nb::borrow(static_cast<PyObject*>(type))(nb::str(e.what.c_str()));
        value.attr("edges") = edges;
        value.attr("points") = nb::cast(e.points);
        PyErr_SetObject(static_cast<PyObject*>(type), value.ptr());
    }
}

PyObject* new_value_error(nb::module_& m, const char* name) {
    const std::string path = nb::cast<std::string>(m.attr("__name__")) + "." + name;
    nb::object type = nb::steal(PyErr_NewException(path.c_str(), PyExc_ValueError, nullptr));
    m.attr(name) = type;
    return type.release().ptr();  // lives as long as the module does
}

}  // namespace

void bind_polygon(nb::module_& m) {
    nb::register_exception_translator(translate, new_value_error(m, "InvalidPolygon"));
    m.def(
        "triangulate_polygon", &triangulate_polygon, nb::arg("points"), nb::arg("loops"),
        "Triangles i32 (t,3), counter-clockwise, of the region of odd parity of the loops, which\n"
        "are i32 arrays of ids into points f64 (n,2). Loops may touch in vertices; anything else\n"
        "in common is an InvalidPolygon (a ValueError) with `edges`, a list of (loop, corner),\n"
        "and `points`. Decisions are exact. O(n log n).");
    m.def("place_guards", &guards_of_polygon, nb::arg("points"), nb::arg("loops"),
          "Ids i32 (g,) of vertices that together see the whole polygon, increasing; at most\n"
          "floor((n + 2 h) / 3) for n vertices and h holes. Loops and errors as for\n"
          "triangulate_polygon. O(n log n).");
}

}  // namespace tetra::python

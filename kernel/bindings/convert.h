// SPDX-License-Identifier: LGPL-2.1-or-later
// What every topic of the bindings needs: arrays, options, progress and errors across the border.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstring>
#include <string>
#include <vector>

#include "tetra/errors.h"
#include "tetra/progress.h"
#include "tetra/solid/grid_solid.h"

namespace tetra::python {

namespace nb = nanobind;

using VertexArray = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using TriangleArray =
    nb::ndarray<const std::int32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using IdArray = nb::ndarray<const std::int32_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

inline std::vector<Vec3d> to_vertices(const VertexArray& a) {
    std::vector<Vec3d> r(a.shape(0));
    if (!r.empty()) std::memcpy(r.data(), a.data(), r.size() * sizeof(Vec3d));
    return r;
}

inline std::vector<Triangle> to_triangles(const TriangleArray& a) {
    std::vector<Triangle> r(a.shape(0));
    if (!r.empty()) std::memcpy(r.data(), a.data(), r.size() * sizeof(Triangle));
    return r;
}

inline std::vector<int> to_ids(const IdArray& a) {
    return std::vector<int>(a.data(), a.data() + a.shape(0));
}

// An optional array of an options dict, or of an argument that may be None: empty when absent.
inline std::vector<int> optional_ids(nb::handle value) {
    if (!value.is_valid() || value.is_none()) return {};
    IdArray array;
    if (!nb::try_cast(value, array)) throw nb::type_error("expected a one-dimensional i32 array");
    return to_ids(array);
}

inline nb::object option(const nb::dict& options, const char* name) {
    return options.contains(name) ? nb::object(options[name]) : nb::none();
}

template <class T>
T option_or(const nb::dict& options, const char* name, T fallback) {
    const nb::object value = option(options, name);
    return value.is_none() ? fallback : nb::cast<T>(value);
}

// A new numpy array that owns `values`; columns 0 makes it one-dimensional.
template <class T>
nb::object to_numpy(std::vector<T> values, std::size_t columns = 0) {
    auto* owned = new std::vector<T>(std::move(values));
    nb::capsule owner(owned, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    const std::size_t n = owned->size();
    if (columns == 0) {
        const std::size_t shape[1] = {n};
        return nb::cast(nb::ndarray<nb::numpy, T>(owned->data(), 1, shape, owner));
    }
    const std::size_t shape[2] = {n / columns, columns};
    return nb::cast(nb::ndarray<nb::numpy, T>(owned->data(), 2, shape, owner));
}

// Rows of fixed length: Vec3d -> f64 (n,3), Triangle -> i32 (n,3), array<int,4> -> i32 (n,4).
template <class T, std::size_t N>
nb::object rows_to_numpy(const std::vector<std::array<T, N>>& rows) {
    std::vector<T> flat(rows.size() * N);
    if (!rows.empty()) std::memcpy(flat.data(), rows.data(), flat.size() * sizeof(T));
    return to_numpy(std::move(flat), N);
}

inline nb::list to_list(const std::vector<Defect>& defects) {
    nb::list list;
    for (const Defect& d : defects) {
        nb::dict row;
        row["kind"] = d.kind;
        row["vertices"] = d.vertices;
        row["triangles"] = d.triangles;
        row["message"] = d.message;
        list.append(row);
    }
    return list;
}

// Calls a Python callable progress(stage, fraction) -> None | bool with the GIL held for that
// moment only. Without a callable it still lets Ctrl-C through. Python errors propagate.
inline Progress make_progress(nb::object callable) {
    return Progress([callable = std::move(callable)](const std::string& stage, double fraction) {
        nb::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        if (callable.is_none()) return true;
        const nb::object answer = callable(stage, fraction);
        return !answer.is(nb::bool_(false));
    });
}

// Runs `work(progress)` with the GIL released; conversions belong before and after.
template <class Work>
auto without_gil(nb::object callable, Work&& work) {
    Progress progress = make_progress(std::move(callable));
    nb::gil_scoped_release release;
    return work(progress);
}

// Registers InvalidSolid (with `.defects`, a list of dicts), VerificationFailed and Cancelled.
void bind_errors(nb::module_& m);

}  // namespace tetra::python

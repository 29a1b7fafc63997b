// SPDX-License-Identifier: LGPL-2.1-or-later
// The entry of the Python module: its version, and one call per topic.
#include <nanobind/nanobind.h>

namespace nb = nanobind;

// One line per topic: `void bind_<topic>(nb::module_& m);`, defined in <topic>.cpp.
namespace tetra::python {
void bind_cells(nb::module_& m);
void bind_errors(nb::module_& m);
void bind_limit(nb::module_& m);
void bind_polygon(nb::module_& m);
void bind_tets(nb::module_& m);
void bind_validate(nb::module_& m);
}  // namespace tetra::python

NB_MODULE(_tetra_kernel, m) {
    m.doc() = "Exact decomposition of solids; use it through the package freecad_tetra.";
    m.def(
        "version", [] { return TETRA_VERSION; },
        "Version of the compiled kernel; equals freecad_tetra.__version__.");
    tetra::python::bind_cells(m);
    tetra::python::bind_errors(m);
    tetra::python::bind_limit(m);
    tetra::python::bind_polygon(m);
    tetra::python::bind_tets(m);
    tetra::python::bind_validate(m);
}

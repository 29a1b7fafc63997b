// SPDX-License-Identifier: LGPL-2.1-or-later
// Typed kernel errors as Python exceptions of the module.
#include "convert.h"

namespace tetra::python {
namespace {

PyObject* new_exception(nb::module_& m, const char* name) {
    const std::string path = nb::cast<std::string>(m.attr("__name__")) + "." + name;
    nb::object type = nb::steal(PyErr_NewException(path.c_str(), PyExc_RuntimeError, nullptr));
    m.attr(name) = type;
    return type.release().ptr();  // lives as long as the module does
}

struct Types {
    PyObject *invalid_solid, *verification_failed, *cancelled;
};

void raise_invalid(PyObject* type, const InvalidSolid& error) {
    nb::object value = nb::borrow(type)(nb::str(error.what()));
    value.attr("defects") = to_list(error.defects);
    PyErr_SetObject(type, value.ptr());
}

void translate(const std::exception_ptr& error, void* payload) {
    const auto* types = static_cast<const Types*>(payload);
    try {
        std::rethrow_exception(error);
    } catch (const InvalidSolid& e) {
        raise_invalid(types->invalid_solid, e);
    } catch (const VerificationFailed& e) {
        PyErr_SetString(types->verification_failed, e.what());
    } catch (const Cancelled& e) {
        PyErr_SetString(types->cancelled, e.what());
    }
}

}  // namespace

void bind_errors(nb::module_& m) {
    auto* types = new Types{new_exception(m, "InvalidSolid"),
                            new_exception(m, "VerificationFailed"), new_exception(m, "Cancelled")};
    nb::register_exception_translator(translate, types);
}

}  // namespace tetra::python

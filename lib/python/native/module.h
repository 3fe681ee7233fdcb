// The parts of the module that C++ defines. The Python files beside it check arguments, bring
// arrays to one shape and document everything; users see only those.
#pragma once

#include <pybind11/pybind11.h>

namespace vndf::python {

void add_sampling(pybind11::module_& module);
void add_bsdfs(pybind11::module_& module);
void add_tables(pybind11::module_& module);
void add_references(pybind11::module_& module);
void add_verdicts(pybind11::module_& module);

}  // namespace vndf::python

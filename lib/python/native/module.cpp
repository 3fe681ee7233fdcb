// The extension module vndf._native.
#include "module.h"

#include "vndf/baking/bake.h"
#include "vndf/io/map_image.h"
#include "vndf/io/table_file.h"
#include "vndf/kernel_block.h"

namespace {

/// Content or an option that breaks a rule is a ValueError, as are the errors of the standard
/// library for these, which pybind11 knows.
void translate(std::exception_ptr error) {
  try {
    std::rethrow_exception(error);
  } catch (const vndf::KernelTablesError& e) {
    PyErr_SetString(PyExc_ValueError, e.what());
  } catch (const vndf::BakeError& e) {
    PyErr_SetString(PyExc_ValueError, e.what());
  } catch (const vndf::io::TableFileError& e) {
    PyErr_SetString(PyExc_ValueError, e.what());
  } catch (const vndf::io::MapImageError& e) {
    PyErr_SetString(PyExc_ValueError, e.what());
  }
}

}  // namespace

PYBIND11_MODULE(_native, module) {
  pybind11::register_local_exception_translator(translate);
  vndf::python::add_sampling(module);
  vndf::python::add_bsdfs(module);
  vndf::python::add_tables(module);
  vndf::python::add_references(module);
  vndf::python::add_verdicts(module);
}

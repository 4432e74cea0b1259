#pragma once

#include <pybind11/pybind11.h>

/// Errors of the library as exceptions of Python: the classes of winslow/errors.py.
///
///     winslow::python::translate_errors(module);  // once, where the module is made
namespace winslow::python {

/// Registers the translation of every error that the library throws, for this module alone.
void translate_errors();

/// A message of the command line in words of the module: "--free-interfaces" becomes "option
/// free_interfaces".
std::string in_words_of_python(std::string message);

/// Raises the exception of that class of winslow/errors.py.
[[noreturn]] void raise(const char* name, const pybind11::args& arguments);

}  // namespace winslow::python

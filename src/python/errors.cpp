#include "python/errors.h"

#include <cctype>

#include "core/error.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

py::object error_class(const char* name) {
  return py::module_::import("winslow.errors").attr(name);
}

/// Sets the exception that Python raises when this call returns.
void set_error(const char* name, const py::args& arguments) {
  const py::object kind = error_class(name);
  const py::object error = kind(*arguments);
  PyErr_SetObject(kind.ptr(), error.ptr());
}

void set_error(const char* name, const Error& error) {
  set_error(name, py::make_tuple(in_words_of_python(error.what())));
}

/// "mesh", "node", "element", "marker_face".
const char* name_of(MeshEntity entity) {
  switch (entity) {
    case MeshEntity::node:
      return "node";
    case MeshEntity::element:
      return "element";
    case MeshEntity::marker_face:
      return "marker_face";
    case MeshEntity::mesh:
      break;
  }
  return "mesh";
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const UsageError& error) {
    set_error("UsageError", error);
  } catch (const InputError& error) {
    set_error("InputError", error);
  } catch (const OutputError& error) {
    set_error("OutputError", error);
  } catch (const MeshError& error) {
    set_error("MeshError", py::make_tuple(in_words_of_python(error.what()), name_of(error.entity()),
                                          error.index()));
  } catch (const NumericError& error) {
    set_error("NumericError", error);
  } catch (const Cancelled& error) {
    set_error("Cancelled", error);
  } catch (const Error& error) {
    set_error("Error", error);
  }
}

bool is_word(char c) { return std::islower(static_cast<unsigned char>(c)) != 0 || c == '-'; }

}  // namespace

void translate_errors() { py::register_local_exception_translator(translate); }

std::string in_words_of_python(std::string message) {
  for (std::size_t begin = 0; (begin = message.find("--", begin)) != std::string::npos;) {
    std::size_t end = begin + 2;
    const bool is_flag =
        (begin == 0 || !std::isalnum(static_cast<unsigned char>(message[begin - 1]))) &&
        end < message.size() && is_word(message[end]) && message[end] != '-';
    while (end < message.size() && is_word(message[end])) ++end;
    if (is_flag) {
      std::string name = message.substr(begin + 2, end - begin - 2);
      for (char& c : name)
        if (c == '-') c = '_';
      message.replace(begin, end - begin, "option " + name);
    }
    begin += 2;
  }
  return message;
}

void raise(const char* name, const py::args& arguments) {
  set_error(name, arguments);
  throw py::error_already_set();
}

}  // namespace winslow::python

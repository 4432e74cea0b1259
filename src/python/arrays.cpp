#include "python/arrays.h"

#include "core/error.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

std::vector<py::ssize_t> shape_of_coordinates(const Coordinates& x) {
  return {x.size(), x.dimension()};
}

std::string text_of_shape(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t k = 0; k < array.ndim(); ++k)
    text += (k > 0 ? ", " : "") + std::to_string(array.shape(k));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

/// The array as float64, in place if it is that already.
InputArray<double> numbers_of(const py::object& given, const char* what) {
  InputArray<double> array = InputArray<double>::ensure(given);
  if (!array) {
    PyErr_Clear();
    throw UsageError(std::string(what) + ": found " +
                     py::str(py::type::of(given).attr("__name__")).cast<std::string>() +
                     ", expected an array of numbers");
  }
  return array;
}

Coordinates copied(const InputArray<double>& array) {
  Coordinates x(static_cast<int>(array.shape(1)), static_cast<Index>(array.shape(0)));
  std::copy_n(array.data(), array.size(), x.values().begin());
  return x;
}

}  // namespace

py::array view_of(const Coordinates& x, const py::handle& owner) {
  py::array_t<double> array(shape_of_coordinates(x), x.values().data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array array_of(Coordinates x) {
  auto* kept = new Coordinates(std::move(x));
  const py::capsule owner(kept, [](void* p) { delete static_cast<Coordinates*>(p); });
  return py::array_t<double>(shape_of_coordinates(*kept), kept->values().data(), owner);
}

Coordinates coordinates_of(const py::object& given, int dimension, Index nodes, const char* what) {
  const InputArray<double> array = numbers_of(given, what);
  if (array.ndim() != 2 || array.shape(0) != nodes || array.shape(1) != dimension)
    throw UsageError(std::string(what) + ": found an array of shape " + text_of_shape(array) +
                     ", expected (" + std::to_string(nodes) + ", " + std::to_string(dimension) +
                     ")");
  return copied(array);
}

Coordinates coordinates_of(const py::object& given, const char* what) {
  const InputArray<double> array = numbers_of(given, what);
  if (array.ndim() != 2 || (array.shape(1) != 2 && array.shape(1) != 3))
    throw UsageError(std::string(what) + ": found an array of shape " + text_of_shape(array) +
                     ", expected (n, 2) or (n, 3)");
  if (array.shape(0) > std::numeric_limits<Index>::max())
    throw UsageError(std::string(what) + ": found " + std::to_string(array.shape(0)) +
                     " nodes, expected fewer than 2^31");
  return copied(array);
}

}  // namespace winslow::python

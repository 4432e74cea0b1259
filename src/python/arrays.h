#pragma once

#include <pybind11/numpy.h>

#include "core/mesh/coordinates.h"

/// Arrays of numpy on the memory of the library, and the other way round.
namespace winslow::python {

/// An array (C-contiguous) of another type is converted; one of this type is read in place.
template <class Number>
using InputArray = pybind11::array_t<Number, pybind11::array::c_style | pybind11::array::forcecast>;

/// A read-only view (n, 2 or 3) of coordinates that `owner` keeps alive. No copy.
pybind11::array view_of(const Coordinates& x, const pybind11::handle& owner);
/// A writable array (n, 2 or 3) that takes the coordinates over. No copy.
pybind11::array array_of(Coordinates x);

/// A read-only array of any shape that takes the numbers over. No copy.
template <class Number>
pybind11::array frozen(std::vector<Number> numbers, std::vector<pybind11::ssize_t> shape) {
  auto* kept = new std::vector<Number>(std::move(numbers));
  const pybind11::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Number>*>(p); });
  pybind11::array_t<Number> array(std::move(shape), kept->data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}
template <class Number>
pybind11::array frozen(std::vector<Number> numbers) {
  const auto count = static_cast<pybind11::ssize_t>(numbers.size());
  return frozen(std::move(numbers), {count});
}

/// Coordinates with the numbers of an array (n, dimension), n nodes. Throws UsageError for another
/// shape or another type than numbers; `what` begins the message.
Coordinates coordinates_of(const pybind11::object& array, int dimension, Index nodes,
                           const char* what);
/// The same of any number of nodes, in two or three dimensions.
Coordinates coordinates_of(const pybind11::object& array, const char* what);

}  // namespace winslow::python

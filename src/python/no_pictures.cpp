#include "core/error.h"
#include "python/measures.h"

/// In place of pictures.cpp in a build without graphics.
namespace winslow::python {

void bind_pictures(pybind11::module_& module) {
  module.attr("draws") = false;
  module.def("picture", [](const pybind11::args&) {
    throw Error("this build of winslow has no graphics: build it with -DWINSLOW_BUILD_GUI=ON");
  });
}

}  // namespace winslow::python

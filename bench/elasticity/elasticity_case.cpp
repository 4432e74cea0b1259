#include "elasticity/elasticity_case.h"

#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "core/motion/motion.h"

namespace winslow::bench {

namespace {

double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') throw UsageError("found \"" + text + "\", expected a number");
  return value;
}

int whole_number(const std::string& text) {
  const double value = number(text);
  if (!(value >= 1 && value < 1e6 && value == std::floor(value)))
    throw UsageError("found \"" + text + "\", expected a whole number of at least 1");
  return static_cast<int>(value);
}

Modulus modulus_of(const std::string& name) {
  if (name == "volume") return Modulus::volume;
  if (name == "distance") return Modulus::wall_distance;
  throw UsageError("found \"" + name + "\", expected volume or distance");
}

/// The words of a command line, one after the other.
class Words {
 public:
  explicit Words(const std::vector<std::string>& words) : words_(words) {}

  bool more() const { return next_ < words_.size(); }
  const std::string& take() {
    if (!more()) throw UsageError(words_.back() + " needs more");
    return words_[next_++];
  }
  /// Two or three numbers.
  GivenVector take_vector() {
    const double x = number(take()), y = number(take());
    if (!more() || !is_number(words_[next_])) return Vec2(x, y);
    return Vec3(x, y, number(take()));
  }
  Vec3 take_axis() {
    const double x = number(take()), y = number(take());
    return {x, y, number(take())};
  }

 private:
  static bool is_number(const std::string& text) {
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0';
  }

  const std::vector<std::string>& words_;
  std::size_t next_ = 0;
};

void read_option(const std::string& flag, Words& words, ElasticityCase& out) {
  if (flag == "--marker") {
    out.markers.push_back(words.take());
  } else if (flag == "--rotate") {
    out.motion.rotate = number(words.take());
  } else if (flag == "--axis") {
    out.motion.axis = words.take_axis();
  } else if (flag == "--pivot") {
    out.motion.pivot = words.take_vector();
  } else if (flag == "--translate") {
    out.motion.translate = words.take_vector();
  } else if (flag == "--increments") {
    out.elasticity.increments = whole_number(words.take());
  } else if (flag == "--modulus") {
    out.elasticity.modulus = modulus_of(words.take());
  } else if (flag == "--tolerance") {
    out.elasticity.tolerance = number(words.take());
  } else if (flag == "-o") {
    out.output = words.take();
  } else if (flag.starts_with("-")) {
    throw UsageError("unknown option " + flag);
  } else {
    out.mesh = flag;
  }
}

template <int D>
ElasticityResult move_solid(const ElasticityCase& wanted, Mesh& mesh) {
  const Coordinates rest = mesh.coordinates;
  const auto motion = make_motion(*mesh.topology, rest, wanted.markers, for_mesh(wanted, mesh));
  ElasticSolid<D> solid(mesh.topology, mesh.topology->markers().nodes_of(wanted.markers),
                        wanted.elasticity);
  ElasticityResult result;
  try {
    deform_in_increments(
        solid, [&](double share, Coordinates& x) { motion->apply(rest, share, x); },
        wanted.elasticity.increments, mesh.coordinates);
  } catch (const Error& error) {
    result.fault = error.what();
  }
  result.linear_iterations = solid.linear_iterations();
  return result;
}

}  // namespace

ElasticityCase read_case(const std::vector<std::string>& arguments, const std::string& usage) {
  ElasticityCase out;
  Words words(arguments);
  while (words.more()) read_option(words.take(), words, out);
  if (out.mesh.empty() || out.markers.empty()) throw UsageError(usage);
  return out;
}

RigidMotion for_mesh(const ElasticityCase& wanted, const Mesh& mesh) {
  RigidMotion motion = wanted.motion;
  if (!motion.pivot) motion.pivot = Vec2(0, 0);
  if (mesh.coordinates.dimension() == 3) {
    if (!wanted.motion.pivot) motion.pivot = Vec3(0, 0, 0);
    if (!motion.axis) motion.axis = Vec3(0, 0, 1);
  }
  return motion;
}

ElasticityResult move_elastically(const ElasticityCase& wanted, Mesh& mesh) {
  return in_dimension(*mesh.topology, "linear elasticity", [&](auto dimension) {
    return move_solid<decltype(dimension)::value>(wanted, mesh);
  });
}

}  // namespace winslow::bench

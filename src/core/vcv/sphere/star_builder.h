#pragma once

#include "core/mesh/coordinates.h"
#include "core/types.h"
#include "core/vcv/sphere/sphere_fit.h"
#include "core/vcv/sphere/sphere_link.h"

namespace winslow {

/// Aspect ratio R / (3 r) of the tetrahedron 0 a b c, R and r the radii of its circumscribed and
/// its inscribed sphere: 1 if regular, infinite if flat. a . (b x c) must not be negative.
double tetrahedron_aspect_ratio(const Vec3& a, const Vec3& b, const Vec3& c);

/// Cost of one tetrahedron 0 a b c of a VCV (AIAA 2009-1362, equation 3):
///
///   1 - J where J < 0, else 1 - 1 / (AR (1 + |alpha - theta|)^2),
///
/// J = a . (b x c), AR its aspect ratio, alpha its solid angle and theta the wanted one. The paper
/// prints alpha - theta without the bars, which would reward an angle that is too small.
double tetrahedron_cost(const Vec3& a, const Vec3& b, const Vec3& c, double wanted);

/// Cost of a vertex of the link (equation 4), from the costs c of the tetrahedra around it:
///
///   C* = r C_max + max(0, 1 - r) C,   r = C_max^3,   C the mean of c^2.
class BlendedCost {
 public:
  void add(double cost) {
    largest_ = cost > largest_ ? cost : largest_;
    squares_ += cost * cost;
    ++count_;
  }
  double value() const;

 private:
  double largest_ = 0, squares_ = 0;
  int count_ = 0;
};

/// Cost of a vertex. targets: #triangles, in steradians. directions: #vertices.
double vertex_cost(const SphereLink& link, Index vertex, std::span<const double> targets,
                   std::span<const Vec3> directions);

/// Costs of the vertices of a star.
struct StarCost {
  double min = 0, max = 0;
};
StarCost star_cost(const SphereLink& link, std::span<const double> targets,
                   std::span<const Vec3> directions);

struct PerturbationOptions {
  double first_reach = 0.2;   ///< first size of perturbations, in radians
  double least_reach = 1e-3;  ///< reach at which the search ends
  int directions = 8;         ///< successive perturbations of a vertex in each sweep
  int most_sweeps = 200;
};

/// Places the vertices of a link by the paper's method (AIAA 2009-1362, section IV): each is
/// perturbed in random directions on the sphere, and perturbations that lower its cost (see
/// vertex_cost()) are kept. The reach is halved after a sweep that lowers no cost by a hundredth.
/// Returns the number of sweeps.
///
/// targets: #triangles, in steradians. directions: #vertices, unit vectors; the start on entry, the
/// result on return. The same seed gives the same bits.
int perturb_directions(const SphereLink& link, std::span<const double> targets,
                       const PerturbationOptions& options, std::uint64_t seed,
                       std::span<Vec3> directions);

/// How the directions of a VCV are found for given solid angles.
enum class VcvConstruction : std::uint8_t {
  fit,          ///< see SphereFit
  perturbation  ///< the paper's, see perturb_directions()
};

/// The wanted solid angles of the VCVs of a volume mesh (AIAA 2009-1362, sections IV and V).
enum class VcvAngles : std::uint8_t {
  equal,     ///< 4 pi / #triangles
  existing,  ///< those of a given mesh
  adjusted   ///< the mean of both, recomputed as the mesh moves
};

struct VolumeVcvOptions {
  VcvAngles angles = VcvAngles::equal;
  VcvConstruction construction = VcvConstruction::fit;
  /// Least weight of the shape of triangles relative to their angles (SphereFitOptions). Equal
  /// angles are met exactly, those of a mesh only as far as the shape permits: otherwise a nearly
  /// flat star would have a nearly flat VCV.
  double equal_regularisation = 1e-6;
  double physical_regularisation = 0.3;
  /// Edge lengths are those of the given mesh, divided by their mean in each star, to this power: 0
  /// for unit edges (as in the paper), up to 1 for the grading of the mesh itself.
  double length_power = 0;
  int threads = 0;  ///< 0 for all cores; no result depends on it

  SphereFitOptions fit() const;
};

/// Computes the wanted solid angles of one star.
class StarTargets {
 public:
  /// 4 pi / #triangles each.
  std::span<const double> equal(const SphereLink& link);
  /// The physical ones: solid angles of the directions to the neighbours, at least a hundredth of
  /// the equal angle, scaled to a sum of 4 pi.
  std::span<const double> existing(const SphereLink& link, std::span<const Vec3> physical);
  /// AIAA 2009-1362, section V: the mean of the equal and the physical ones, scaled to a sum of 4
  /// pi. Negative physical ones count as zero.
  std::span<const double> adjusted(const SphereLink& link, std::span<const Vec3> physical);
  /// Angles of any kind; `physical` is not used for equal ones.
  std::span<const double> of_kind(VcvAngles kind, const SphereLink& link,
                                  std::span<const Vec3> physical);

 private:
  void measure(const SphereLink& link, std::span<const Vec3> physical, double floor);
  std::span<const double> scaled();

  std::vector<double> angles_;
};

/// Unit vectors from a node to its neighbours (#neighbours).
void physical_directions(const SpacePoints& x, Index node, std::span<const Index> neighbours,
                         std::vector<Vec3>& out);

/// Lengths of a VCV's edges for VolumeVcvOptions::length_power (#neighbours).
void graded_lengths(const SpacePoints& x, Index node, std::span<const Index> neighbours,
                    double power, std::vector<double>& out);

/// Makes VCVs of single stars and reuses its memory.
class StarBuilder {
 public:
  explicit StarBuilder(VcvConstruction construction) : construction_(construction) {}

  /// Directions for the targets (#triangles). directions: #vertices; on entry the start if they
  /// cover the sphere (otherwise SphereStart computes one), on return the result. seed: of the
  /// perturbation. Throws NumericError as SphereStart does.
  SphereFitResult build(const SphereLink& link, std::span<const double> targets,
                        const SphereFitOptions& options, std::uint64_t seed,
                        std::span<Vec3> directions);

 private:
  VcvConstruction construction_;
  SphereStart start_;
  SphereFit fit_;
};

/// Largest magnitude of Omega / Omega* - 1 of a star.
double largest_angle_error(const SphereLink& link, std::span<const double> targets,
                           std::span<const Vec3> directions);

}  // namespace winslow

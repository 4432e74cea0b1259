#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/vcv/sphere/sphere_link.h"
#include "support/random.h"

/// Triangulated spheres for tests: links of nodes of volume meshes, by their triangles.
namespace winslow::test {

using Triangles = std::vector<SphereLink::Triangle>;

inline SphereLink link_of(const Triangles& triangles) {
  Index vertices = 0;
  for (const auto& triangle : triangles) {
    vertices = std::max(vertices, *std::max_element(triangle.begin(), triangle.end()) + 1);
  }
  return {vertices, triangles};
}

inline Triangles tetrahedron_link() { return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}; }

/// n vertices around, 2 n triangles; the tips are vertices n and n + 1. The octahedron for n = 4.
inline Triangles double_pyramid(Index n) {
  Triangles triangles;
  for (Index k = 0; k < n; ++k) {
    const Index next = (k + 1) % n;
    triangles.push_back({k, next, n});
    triangles.push_back({next, k, n + 1});
  }
  return triangles;
}

/// Every triangle cut into four: of 8 triangles 32, of 20 80.
inline Triangles subdivided(const Triangles& coarse) {
  std::vector<std::pair<Index, Index>> edges;
  Index vertices = 0;
  for (const auto& [a, b, c] : coarse) {
    vertices = std::max({vertices, a + 1, b + 1, c + 1});
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      if (p < q) edges.emplace_back(p, q);
    }
  }
  const auto middle = [&](Index p, Index q) {
    const auto found = std::find(edges.begin(), edges.end(), std::minmax({p, q}));
    return vertices + static_cast<Index>(found - edges.begin());
  };
  Triangles fine;
  for (const auto& [a, b, c] : coarse) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.push_back({a, ab, ca});
    fine.push_back({ab, b, bc});
    fine.push_back({ca, bc, c});
    fine.push_back({ab, bc, ca});
  }
  return fine;
}

/// 12 vertices of 5 neighbours.
inline Triangles icosahedron() {
  Triangles triangles;
  for (Index k = 0; k < 5; ++k) {
    const Index next = (k + 1) % 5;
    triangles.push_back({k, next, 10});
    triangles.push_back({next, k, 5 + k});
    triangles.push_back({next, 5 + k, 5 + next});
    triangles.push_back({5 + next, 5 + k, 11});
  }
  return triangles;
}

/// Puts a vertex into a triangle.
inline void stack(Triangles& triangles, std::size_t t, Index vertex) {
  const auto [a, b, c] = triangles[t];
  triangles[t] = {a, b, vertex};
  triangles.push_back({b, c, vertex});
  triangles.push_back({c, a, vertex});
}

/// Vertices put into triangles picked at random: every one but the last few with a separating
/// triangle around it.
inline Triangles random_stack(Random& random, Index vertices) {
  Triangles triangles = tetrahedron_link();
  for (Index v = 4; v < vertices; ++v) {
    stack(triangles, at(random.index(static_cast<Index>(triangles.size()))), v);
  }
  return triangles;
}

/// Turns edges of a triangulated sphere: the two triangles at an edge become two at the other
/// diagonal of their quadrilateral.
class EdgeTurner {
 public:
  explicit EdgeTurner(Triangles& triangles) : triangles_(triangles) {
    for (const auto& triangle : triangles) {
      for (std::size_t k = 0; k < 3; ++k) join(triangle[k], triangle[(k + 1) % 3]);
    }
  }

  /// Tries edges picked at random. Edges that exist already are not made; evenly: and none by which
  /// the numbers of neighbours would differ more.
  void turn(Random& random, int tries, bool evenly) {
    for (int i = 0; i < tries; ++i) {
      auto& first = triangles_[at(random.index(static_cast<Index>(triangles_.size())))];
      std::rotate(first.begin(), first.begin() + random.index(3), first.end());
      const auto [a, b, c] = first;
      for (auto& second : triangles_) {
        const auto corner =
            static_cast<std::size_t>(std::find(second.begin(), second.end(), b) - second.begin());
        if (corner == 3 || second[(corner + 1) % 3] != a) continue;
        const Index d = second[(corner + 2) % 3];
        const bool worse = degrees_[a] + degrees_[b] < degrees_[c] + degrees_[d] + 2;
        if (edges_.contains({c, d}) || (evenly && worse)) break;
        part(a, b);
        part(b, a);
        join(c, d);
        join(d, c);
        first = {c, a, d};
        second = {d, b, c};
        break;
      }
    }
  }

 private:
  void join(Index a, Index b) {
    edges_.insert({a, b});
    ++degrees_[a];
  }
  void part(Index a, Index b) {
    edges_.erase({a, b});
    --degrees_[a];
  }

  Triangles& triangles_;
  std::set<std::pair<Index, Index>> edges_;
  std::map<Index, Index> degrees_;
};

/// A double pyramid with edges turned at random.
inline Triangles random_sphere(Random& random, Index vertices, int turns) {
  Triangles triangles = vertices > 4 ? double_pyramid(vertices - 2) : tetrahedron_link();
  EdgeTurner(triangles).turn(random, turns, false);
  return triangles;
}

/// The same with numbers of neighbours that differ little, as in a mesh of good tetrahedra.
inline Triangles even_sphere(Random& random, Index vertices) {
  Triangles triangles = random_sphere(random, vertices, 50 * vertices);
  EdgeTurner(triangles).turn(random, 200 * vertices, true);
  return triangles;
}

inline Vec3 random_direction(Random& random) {
  for (;;) {
    const Vec2 p = random.vector();
    const Vec3 d(p.x(), p.y(), random.uniform(-1, 1));
    if (d.norm() > 0.1 && d.norm() < 1) return d.normalized();
  }
}

}  // namespace winslow::test

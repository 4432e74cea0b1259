// The loops of triangle_kernel.h, for every file that compiles them for one instruction set.
// WINSLOW_KERNEL names the TriangleKernel that it defines. All else has internal linkage: one
// instruction set's code must not serve another's.
#include <math.h>

#include "core/formulation/triangle_kernel.h"

namespace winslow::distortion {

namespace {

/// One number for each of four triangles.
using Pack = double __attribute__((vector_size(32)));
constexpr Index lanes = 4;

Pack load(const double* p) {
  Pack v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
void store(double* p, const Pack& v) { __builtin_memcpy(p, &v, sizeof v); }
void add(double* p, const Pack& v) { store(p, load(p) + v); }

Pack square_root(const Pack& v) {
  Pack r{};
  for (Index l = 0; l < lanes; ++l) r[l] = sqrt(v[l]);
  return r;
}

/// Four packs as the columns of a 4x4 matrix, and back.
struct Pack4 {
  Pack a, b, c, d;

  void operator+=(const Pack4& o) {
    a += o.a;
    b += o.b;
    c += o.c;
    d += o.d;
  }
};

Pack4 transposed(const Pack4& m) {
  const Pack ab0 = __builtin_shufflevector(m.a, m.b, 0, 4, 2, 6);
  const Pack ab1 = __builtin_shufflevector(m.a, m.b, 1, 5, 3, 7);
  const Pack cd0 = __builtin_shufflevector(m.c, m.d, 0, 4, 2, 6);
  const Pack cd1 = __builtin_shufflevector(m.c, m.d, 1, 5, 3, 7);
  return {
      __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5), __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5),
      __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7), __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7)};
}

/// Edges and determinants of four triangles, with chi(d) and its slope in place of d.
struct Corners {
  Pack ux{}, uy{}, vx{}, vy{}, determinant, slope, half_inverse;

  Corners(const TriangleData& data, const Index* triangle) {
    Pack ax{}, ay{};
    for (Index l = 0; l < lanes; ++l) {
      const Index* n = data.nodes + 3 * static_cast<long>(triangle[l]);
      const double* a = data.x + 2 * static_cast<long>(n[0]);
      const double* b = data.x + 2 * static_cast<long>(n[1]);
      const double* c = data.x + 2 * static_cast<long>(n[2]);
      ax[l] = a[0];
      ay[l] = a[1];
      ux[l] = b[0];
      uy[l] = b[1];
      vx[l] = c[0];
      vy[l] = c[1];
    }
    ux -= ax;
    uy -= ay;
    vx -= ax;
    vy -= ay;
    const Pack d = ux * vy - uy * vx;
    if (!data.size) {
      determinant = d;
      slope = Pack{1, 1, 1, 1};
      half_inverse = 0.5 / d;
      return;
    }
    // chi(d) = (d + root) / 2; for d < 0 the sum cancels: chi = e^2 / (2 (root - d)).
    Pack e{};
    for (Index l = 0; l < lanes; ++l) e[l] = data.epsilon * data.size[triangle[l]];
    const Pack root = square_root(e * e + d * d);
    const Pack sum = root + (d < 0 ? -d : d);
    determinant = d < 0 ? 0.5 * (e * e) / sum : 0.5 * sum;
    slope = root > 0 ? determinant / root : Pack{0.5, 0.5, 0.5, 0.5};
    half_inverse = 0.5 / determinant;
  }
};

/// Coordinates lie wherever the mesh numbers its nodes: asks for those of a triangle in time.
void prefetch(const TriangleData& data, Index triangle) {
  const Index* n = data.nodes + 3 * static_cast<long>(triangle);
  for (int k = 0; k < 3; ++k) __builtin_prefetch(data.x + 2 * static_cast<long>(n[k]));
}
constexpr Index ahead = 6 * lanes;

/// One target of each of four triangles.
struct Term {
  Pack ab, ac, bc, weight;

  /// The first term of each.
  Term(const TriangleData& data, const Index* triangle) {
    const double* row[lanes];
    for (Index l = 0; l < lanes; ++l) {
      row[l] = data.terms + 4 * static_cast<long>(data.offsets[triangle[l]]);
    }
    take(row);
  }
  /// Term number k of each; a triangle without one takes its first again, with weight zero.
  Term(const TriangleData& data, const Index* triangle, Index k) {
    const double* row[lanes];
    Pack share{};
    for (Index l = 0; l < lanes; ++l) {
      const Index first = data.offsets[triangle[l]];
      const bool used = first + k < data.offsets[triangle[l] + 1];
      row[l] = data.terms + 4 * static_cast<long>(used ? first + k : first);
      share[l] = used ? 1 : 0;
    }
    take(row);
    weight *= share;
  }

  Pack distortion(const Corners& q) const {
    const Pack wx = q.vx - q.ux, wy = q.vy - q.uy;
    const Pack form = ab * (q.ux * q.ux + q.uy * q.uy) + ac * (q.vx * q.vx + q.vy * q.vy) +
                      bc * (wx * wx + wy * wy);
    return form * q.half_inverse;
  }

 private:
  void take(const double* const* row) {
    const Pack4 columns = transposed({load(row[0]), load(row[1]), load(row[2]), load(row[3])});
    ab = columns.a;
    ac = columns.b;
    bc = columns.c;
    weight = columns.d;
  }
};

Index most_terms(const TriangleData& data, const Index* triangle) {
  Index most = 0;
  for (Index l = 0; l < lanes; ++l) {
    const Index n = data.offsets[triangle[l] + 1] - data.offsets[triangle[l]];
    most = n > most ? n : most;
  }
  return most;
}

struct Penalty {
  Pack value, slope, curvature;

  Penalty(const PenaltyConstants& c, const Pack& f) {
    Pack power = Pack{1, 1, 1, 1};  // f^(exponent - 2)
    if (c.integer >= 0) {
      Pack square = f;
      for (int n = c.integer; n != 0; n >>= 1, square *= square) {
        if ((n & 1) != 0) power *= square;
      }
    } else {
      for (Index l = 0; l < lanes; ++l) power[l] = pow(f[l], c.exponent - 2);
    }
    power *= c.scale;
    value = c.linear * f + power * f * f;
    slope = c.linear + c.exponent * (power * f);
    curvature = c.exponent * (c.exponent - 1) * power;
  }
};

/// One term, or the sum over the terms, of four triangles.
struct Sums {
  Pack value;
  Pack bx, by, cx, cy;  // gradients of b and c
  Pack4 ab, ac, bc;

  Sums(const Corners& q, const Term& t, const TriangleData& data) {
    const Pack f = t.distortion(q), inverse = 2 * q.half_inverse;
    const Penalty h(data.penalty, f);
    value = t.weight * h.value;
    const Pack wx = q.vx - q.ux, wy = q.vy - q.uy;
    const Pack dax = -q.slope * wy, day = q.slope * wx;
    const Pack dbx = q.slope * q.vy, dby = -q.slope * q.vx;
    const Pack dcx = -q.slope * q.uy, dcy = q.slope * q.ux;
    const Pack gbx = (t.ab * q.ux - t.bc * wx - f * dbx) * inverse;
    const Pack gby = (t.ab * q.uy - t.bc * wy - f * dby) * inverse;
    const Pack gcx = (t.ac * q.vx + t.bc * wx - f * dcx) * inverse;
    const Pack gcy = (t.ac * q.vy + t.bc * wy - f * dcy) * inverse;
    const Pack gax = -gbx - gcx, gay = -gby - gcy;
    const Pack slope = t.weight * h.slope;
    bx = slope * gbx;
    by = slope * gby;
    cx = slope * gcx;
    cy = slope * gcy;

    const Pack first = slope * inverse, second = t.weight * h.curvature;
    const Pack s = first * data.curvature_share * f;
    // g_i (second g_j - first D_j)^T - D_i (first g_j)^T + first L_ij I - s S_ij
    const Pack pbx = second * gbx - first * dbx, pby = second * gby - first * dby;
    const Pack pcx = second * gcx - first * dcx, pcy = second * gcy - first * dcy;
    const Pack qbx = first * gbx, qby = first * gby, qcx = first * gcx, qcy = first * gcy;
    const Pack lab = first * t.ab, lac = first * t.ac, lbc = first * t.bc;
    ab.a = gax * pbx - dax * qbx - lab;
    ab.b = gax * pby - dax * qby - s;
    ab.c = gay * pbx - day * qbx + s;
    ab.d = gay * pby - day * qby - lab;
    ac.a = gax * pcx - dax * qcx - lac;
    ac.b = gax * pcy - dax * qcy + s;
    ac.c = gay * pcx - day * qcx - s;
    ac.d = gay * pcy - day * qcy - lac;
    bc.a = gbx * pcx - dbx * qcx - lbc;
    bc.b = gbx * pcy - dbx * qcy - s;
    bc.c = gby * pcx - dby * qcx + s;
    bc.d = gby * pcy - dby * qcy - lbc;
  }

  void operator+=(const Sums& o) {
    value += o.value;
    bx += o.bx;
    by += o.by;
    cx += o.cx;
    cy += o.cy;
    ab += o.ab;
    ac += o.ac;
    bc += o.bc;
  }

  void write(const Corners& q, double* out) const {
    const auto put = [out](int place, const Pack4& columns) {
      const Pack4 rows = transposed(columns);
      store(out + place, rows.a);
      store(out + TriangleSum::size + place, rows.b);
      store(out + 2 * TriangleSum::size + place, rows.c);
      store(out + 3 * TriangleSum::size + place, rows.d);
    };
    put(TriangleSum::ab, ab);
    put(TriangleSum::ac, ac);
    put(TriangleSum::bc, bc);
    const Pack wx = q.vx - q.ux, wy = q.vy - q.uy;
    const Pack u = square_root(q.ux * q.ux + q.uy * q.uy);
    const Pack v = square_root(q.vx * q.vx + q.vy * q.vy);
    const Pack w = square_root(wx * wx + wy * wy);
    const Pack one{1, 1, 1, 1};
    put(TriangleSum::corners, {-bx - cx, -by - cy, u + v, one});
    put(TriangleSum::corners + 4, {bx, by, u + w, one});
    put(TriangleSum::corners + 8, {cx, cy, v + w, one});
  }
};

double total_of(const Pack& p) { return (p[0] + p[1]) + (p[2] + p[3]); }

double sum_triangles(const TriangleData& data, const Index* list, Index count, Index first_counted,
                     double* sums) {
  Pack value{};
  for (Index i = 0; i < count; i += lanes, sums += lanes * TriangleSum::size) {
    Index triangle[lanes];
    for (Index l = 0; l < lanes; ++l) triangle[l] = list[i + l < count ? i + l : i];
    for (Index l = i + ahead; l < count && l < i + ahead + lanes; ++l) prefetch(data, list[l]);
    const Corners q(data, triangle);
    Sums total(q, Term(data, triangle), data);
    const Index most = most_terms(data, triangle);
    for (Index k = 1; k < most; ++k) total += Sums(q, Term(data, triangle, k), data);
    total.write(q, sums);
    for (Index l = 0; l < lanes; ++l) {
      const bool counts = i + l < count && triangle[l] >= first_counted;
      value[l] += counts ? (q.determinant[l] > 0 ? total.value[l] : __builtin_inf()) : 0;
    }
  }
  return total_of(value);
}

double energy(const TriangleData& data, Index begin, Index end) {
  Pack total{};
  for (Index i = begin; i < end; i += lanes) {
    Index triangle[lanes];
    for (Index l = 0; l < lanes; ++l) triangle[l] = i + l < end ? i + l : i;
    for (Index l = i + ahead; l < end && l < i + ahead + lanes; ++l) prefetch(data, l);
    const Corners q(data, triangle);
    for (Index l = 0; l < lanes; ++l) {
      if (!(q.determinant[l] > 0)) return __builtin_inf();
    }
    const auto value = [&](const Term& term) {
      return term.weight * Penalty(data.penalty, term.distortion(q)).value;
    };
    Pack sum = value(Term(data, triangle));
    const Index most = most_terms(data, triangle);
    for (Index k = 1; k < most; ++k) sum += value(Term(data, triangle, k));
    for (Index l = 0; l < lanes; ++l) total[l] += i + l < end ? sum[l] : 0;
  }
  return total_of(total);
}

Pack block_transposed(const Pack& b) { return __builtin_shufflevector(b, b, 0, 2, 1, 3); }

template <bool with_blocks>
void scatter_sums(const double* sums, const TrianglePlaces* places, Index count, double* rows,
                  double* blocks) {
  for (Index i = 0; i < count; ++i, sums += TriangleSum::size) {
    const TrianglePlaces& to = places[i];
    const Pack ab = load(sums + TriangleSum::ab), ba = block_transposed(ab);
    const Pack ac = load(sums + TriangleSum::ac), ca = block_transposed(ac);
    const Pack bc = load(sums + TriangleSum::bc), cb = block_transposed(bc);
    const Pack diagonal[3] = {-(ab + ac), -(ba + bc), -(ca + cb)};
    for (int corner = 0; corner < 3; ++corner) {
      double* row = rows + 8 * to.rows[corner];
      add(row, diagonal[corner]);
      add(row + 4, load(sums + TriangleSum::corners + 4 * corner));
    }
    if constexpr (with_blocks) {
      const auto at = [&](int k) { return blocks + 4 * static_cast<long>(to.blocks[k]); };
      add(at(0), ab);
      add(at(1), ba);
      add(at(2), ac);
      add(at(3), ca);
      add(at(4), bc);
      add(at(5), cb);
    }
  }
}

void scatter(const double* sums, const TrianglePlaces* places, Index count, double* rows,
             double* blocks) {
  if (blocks) {
    scatter_sums<true>(sums, places, count, rows, blocks);
  } else {
    scatter_sums<false>(sums, places, count, rows, blocks);
  }
}

void write_rows(const double* entries, const Index* rows, const Index* offsets, Index count,
                double* values) {
  for (Index i = 0; i < count; ++i) {
    double* to = values + 4 * static_cast<long>(offsets[rows[i]]);
    double* const end = values + 4 * static_cast<long>(offsets[rows[i] + 1]);
    for (; to != end; to += 4, entries += 4) store(to, load(entries));
  }
}

}  // namespace

extern const TriangleKernel WINSLOW_KERNEL;
const TriangleKernel WINSLOW_KERNEL{energy, sum_triangles, scatter, write_rows};

}  // namespace winslow::distortion

#pragma once

#include <span>

#include "core/linear/sparse_system.h"

/// Threaded operations on long vectors and sparse matrices. Sums are taken over blocks of fixed
/// size and in order, so that no result depends on the number of threads (0: all cores).
namespace winslow {

double dot(std::span<const double> a, std::span<const double> b, int threads);

/// y += factor x.
void add_scaled(double factor, std::span<const double> x, std::span<double> y, int threads);

/// y = x + factor y.
void scale_and_add(double factor, std::span<const double> x, std::span<double> y, int threads);

/// x += step p and r -= step q, as in conjugate gradients. Returns r . r.
double advance(double step, std::span<const double> p, std::span<const double> q,
               std::span<double> x, std::span<double> r, int threads);

/// y = A x for one right-hand side. Returns x . y.
double multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y, int threads);

/// r = b - A x for one right-hand side. Returns r . r.
double defect(const SparseMatrix& a, std::span<const double> b, std::span<const double> x,
              std::span<double> r, int threads);

}  // namespace winslow

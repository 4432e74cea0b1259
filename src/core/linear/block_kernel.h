#pragma once

#include "core/index.h"

/// Innermost loops over 3 by 3 blocks in double precision, in two versions that round alike. With
/// AVX2 a register holds four doubles; a row of a block uses three of them. Blocks are row-major,
/// as in SparseMatrix; nothing is read or written beyond the last block.
namespace winslow {

constexpr Index padded_block = 12;

struct BlockKernel {
  // The two steps of a product P^T A P. Blocks of sums have padded_block numbers, with rows four
  // numbers apart: stores to overlapping rows would stall. Block q of `count` is added to the sum
  // slot_of[columns[q]].

  /// sum += A_ij P_jq. right: the blocks of row j of P.
  void (*add_products)(const double* a, const float* right, const Index* columns, Index count,
                       const Index* slot_of, double* sums);
  /// sum += P_i^T (A P)_iq. left: P_i; from: the sums of row i of A P.
  void (*add_transposed_products)(const float* left, const double* from, const Index* columns,
                                  Index count, const Index* slot_of, double* sums);
};

/// For any processor.
const BlockKernel& portable_block_kernel();
/// Null where compiler or processor have no AVX2.
const BlockKernel* avx2_block_kernel();
/// The fastest one that runs here.
const BlockKernel& block_kernel();

}  // namespace winslow

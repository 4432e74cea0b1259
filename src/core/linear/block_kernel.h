#pragma once

#include "core/index.h"

/// Innermost loops over 3 by 3 blocks in double precision, in two versions that round alike. With
/// AVX2 a register holds four doubles; a row of a block uses three of them. Blocks are row-major,
/// as in SparseMatrix; nothing is read or written beyond the last block.
namespace winslow {

constexpr Index padded_block = 12;

struct BlockKernel {
  /// coarse_{slot(q)} += P_i^T A_ij P_jq for `count` entries q of a row of P, slot(q) =
  /// slot_of[columns[q]]. left: P_i; right: the blocks of the row. coarse: blocks of padded_block
  /// numbers, with rows four numbers apart: stores to overlapping rows would stall.
  void (*add_triple_products)(const float* left, const double* a, const float* right,
                              const Index* columns, Index count, const Index* slot_of,
                              double* coarse);
};

/// For any processor.
const BlockKernel& portable_block_kernel();
/// Null where compiler or processor have no AVX2.
const BlockKernel* avx2_block_kernel();
/// The fastest one that runs here.
const BlockKernel& block_kernel();

}  // namespace winslow

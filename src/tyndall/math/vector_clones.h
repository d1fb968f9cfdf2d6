// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Before the definition of a function whose loops are vectorized: the compiler makes a
/// second copy of it for processors with AVX2, with eight lanes and gathers, and the loader
/// chooses. Both give the same bits, as multiplications and additions are never fused.
/// What it calls with loops of its own must be `[[gnu::always_inline]] inline`: else that is
/// compiled once, for the oldest processor.
///
/// Only where the GNU C library's loader can choose, and no sanitizer would see it do so.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) &&        \
    !defined(__SANITIZE_THREAD__) && !defined(__AVX2__)
#define TYNDALL_VECTOR_CLONES [[gnu::target_clones("avx2", "default")]]
#else
#define TYNDALL_VECTOR_CLONES
#endif

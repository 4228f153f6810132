#pragma once

/// Compiles a hot function for several instruction sets and picks one when the program starts.
///
/// The instruction set does not change a result (fixed order of summation, no fused multiply-add),
/// only the time that it takes. Not with sanitizers, whose run-time is not up when the pick is
/// made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PCRB_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define PCRB_CLONES
#endif

#pragma once

// SHLIGHT_CLONES in front of a function compiles it once for each family of processors and picks the best at load time,
// so that a program built for any x86-64 still runs its hot loops with the widest vectors there are.
// Inside of it, functions that are not SHLIGHT_ALWAYS_INLINE (the standard library's) are calls: keep them out of
// loops. Sanitizers cannot start with such functions; other compilers and processors do without.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    !defined(SHLIGHT_SANITIZED)
#define SHLIGHT_CLONES __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define SHLIGHT_CLONES
#endif

// For the pieces of such a function: lambdas and templates that must end up inside it.
#define SHLIGHT_ALWAYS_INLINE __attribute__((always_inline))

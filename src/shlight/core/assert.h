#pragma once

// Contracts between pieces of code: checked where NDEBUG is not set (presets dev, asan, tsan), free where it is.
// A failed one prints both values and aborts.

#ifdef NDEBUG
#define SHLIGHT_ASSERT_OP(a, op, b) ((void)0)
#else
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace shlight::detail {
template <class A, class B>
[[noreturn]] void contract_broken(const char* file, int line, const char* text, const A& a, const B& b) {
  std::ostringstream values;
  values << a << " and " << b;
  std::fprintf(stderr, "%s:%d: broken contract: %s, with %s\n", file, line, text, values.str().c_str());
  std::abort();
}
}  // namespace shlight::detail

#define SHLIGHT_ASSERT_OP(a, op, b)                                                                    \
  do {                                                                                                 \
    const auto& shlight_a = (a);                                                                       \
    const auto& shlight_b = (b);                                                                       \
    if (!(shlight_a op shlight_b))                                                                     \
      ::shlight::detail::contract_broken(__FILE__, __LINE__, #a " " #op " " #b, shlight_a, shlight_b); \
  } while (false)
#endif

#define SHLIGHT_ASSERT_EQ(a, b) SHLIGHT_ASSERT_OP(a, ==, b)
#define SHLIGHT_ASSERT_LT(a, b) SHLIGHT_ASSERT_OP(a, <, b)
#define SHLIGHT_ASSERT_LE(a, b) SHLIGHT_ASSERT_OP(a, <=, b)
#define SHLIGHT_ASSERT_GE(a, b) SHLIGHT_ASSERT_OP(a, >=, b)

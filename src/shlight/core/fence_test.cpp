#include "shlight/core/fence.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "shlight/core/error.h"

namespace shlight {
namespace {

std::string error_of(const FenceLimits& limits, const std::function<void(FencedBytes&)>& work) {
  try {
    run_fenced("a.file", "a good file", limits, work);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Fence, HandsOverWhatTheWorkWrote) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{3} << 20}) {
    const FencedBytes result = run_fenced("a", "b", {}, [&](FencedBytes& out) {
      for (std::size_t done = 0; done < size; done += 1 << 16) {
        const std::vector<std::byte> piece(std::min<std::size_t>(1 << 16, size - done), std::byte(done >> 16));
        out.append(piece);
      }
    });
    ASSERT_EQ(result.bytes().size(), size);
    for (std::size_t i = 0; i < size; i += 4097) EXPECT_EQ(result.bytes()[i], std::byte(i >> 16));
  }
}

TEST(Fence, AnErrorPassesWithItsWords) {
  EXPECT_EQ(error_of({}, [](FencedBytes&) { throw Error("x.hdr", "is blue", "a red one"); }),
            "x.hdr: is blue: a red one");
}

TEST(Fence, ACrashIsAnError) {
  const std::string text = error_of({}, [](FencedBytes&) { ::raise(SIGSEGV); });
  EXPECT_TRUE(text.starts_with("a.file: is malformed (its reader crashed")) << text;
  EXPECT_TRUE(text.ends_with(": a good file")) << text;
}

TEST(Fence, AnExitIsAnError) {
  const std::string text = error_of({}, [](FencedBytes&) { ::_exit(0); });
  EXPECT_EQ(text, "a.file: is malformed (its reader gave up): a good file");
}

TEST(Fence, AForeignExceptionIsAnError) {
  EXPECT_EQ(error_of({}, [](FencedBytes&) { throw std::runtime_error("odd"); }),
            "a.file: is malformed (odd): a good file");
  EXPECT_EQ(error_of({}, [](FencedBytes&) { throw 7; }), "a.file: is malformed (unknown exception): a good file");
}

TEST(Fence, AHangEnds) {
  FenceLimits limits;
  limits.seconds = 0.2;
  EXPECT_EQ(error_of(limits,
                     [](FencedBytes&) {
                       for (;;) ::pause();
                     }),
            "a.file: was not read within 0.2 s: a good file");
}

TEST(Fence, MemoryIsBounded) {
#ifdef SHLIGHT_SANITIZED
  GTEST_SKIP() << "sanitizers take terabytes of address space themselves";
#endif
  FenceLimits limits;
  limits.memory_bytes = 64 << 20;
  const auto take = [](std::size_t bytes) {
    return [bytes](FencedBytes&) {
      std::vector<char> memory(bytes);
      std::memset(memory.data(), 1, memory.size());
    };
  };
  EXPECT_EQ(error_of(limits, take(32 << 20)), "no error");
  EXPECT_EQ(error_of(limits, take(128 << 20)),
            "a.file: needs more memory than its reader may take: a good file of at most 64 MiB");
}

TEST(Fence, TheParentsMemoryIsUntouched) {
  int value = 1;
  run_fenced("a", "b", {}, [&](FencedBytes&) { value = 2; });
  EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace shlight

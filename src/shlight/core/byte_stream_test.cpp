#include "shlight/core/byte_stream.h"

#include <gtest/gtest.h>

namespace shlight {
namespace {

struct Thing {
  double number = 0;
  std::string text;
  std::vector<float> numbers;
  std::vector<std::string> texts;

  bool operator==(const Thing&) const = default;
};

template <class Io, class T>
void pass_thing(Io& io, T& thing) {
  io.field(thing.number);
  io.text(thing.text);
  io.list(thing.numbers);
  io.list(thing.texts, [&](auto& text) { io.text(text); });
}

std::vector<std::byte> written(const Thing& thing) {
  ByteBuffer buffer;
  ByteWriter writer(buffer);
  pass_thing(writer, thing);
  return buffer.bytes;
}

const Thing kThing = {1.0 / 3, "text", {1, 2, 3}, {"one", "", "three"}};

TEST(ByteStream, WhatIsWrittenComesBack) {
  for (const Thing& thing : {kThing, Thing{}}) {
    const std::vector<std::byte> bytes = written(thing);
    Thing back;
    ByteReader reader(bytes);
    pass_thing(reader, back);
    EXPECT_EQ(back, thing);
    EXPECT_TRUE(reader.at_end());
  }
}

TEST(ByteStream, EveryCutIsNoticed) {
  const std::vector<std::byte> bytes = written(kThing);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Thing back;
    ByteReader reader({bytes.data(), size});
    EXPECT_THROW(pass_thing(reader, back), ByteReader::Malformed) << size;
  }
}

// A length that no bytes follow is refused before any memory is taken for it.
TEST(ByteStream, AFalseLengthIsNoticed) {
  for (const std::uint64_t length : {std::uint64_t{1}, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
    ByteBuffer buffer;
    ByteWriter(buffer).field(length);
    std::vector<float> numbers;
    EXPECT_THROW(ByteReader(buffer.bytes).list(numbers), ByteReader::Malformed);
    std::string text;
    EXPECT_THROW(ByteReader(buffer.bytes).text(text), ByteReader::Malformed);
  }
}

}  // namespace
}  // namespace shlight

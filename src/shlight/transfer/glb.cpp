#include "shlight/transfer/glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "shlight/core/error.h"

namespace shlight {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;  // "glTF"
constexpr std::uint32_t kGltfVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;  // "JSON", "BIN\0"
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr std::string_view kChecksumKey = "\"checksum\":\"";

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof(word));
  return word;
}

void append_words(std::vector<std::byte>& bytes, std::initializer_list<std::uint64_t> words) {
  for (const std::uint64_t value : words) {
    const auto word = static_cast<std::uint32_t>(value);
    const auto raw = std::as_bytes(std::span(&word, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
  }
}

std::size_t padded(std::size_t size) {
  return (size + 3) / 4 * 4;
}

// Where the checksum's digits stand in the file; at its end where they do not.
std::size_t checksum_offset(std::span<const std::byte> file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  const std::size_t key = text.find(kChecksumKey);
  if (key == std::string_view::npos || text.size() - key - kChecksumKey.size() < kEmptyChecksum.size())
    return file.size();
  return key + kChecksumKey.size();
}

}  // namespace

std::vector<std::byte> make_glb(std::string_view json, std::span<const std::byte> binary, std::string_view name) {
  const std::size_t json_bytes = padded(json.size()), binary_bytes = padded(binary.size());
  const std::uint64_t total = kHeaderBytes + 2 * kChunkHeaderBytes + json_bytes + binary_bytes;
  if (total > kMaxGlbBytes)
    throw Error(name, fmt::format("would hold {} bytes", total), fmt::format("at most {} bytes", kMaxGlbBytes));
  std::vector<std::byte> file;
  file.reserve(total);
  append_words(file, {kMagic, kGltfVersion, total, json_bytes, kJsonChunk});
  const auto text = std::as_bytes(std::span(json));
  file.insert(file.end(), text.begin(), text.end());
  file.resize(kHeaderBytes + kChunkHeaderBytes + json_bytes, std::byte{' '});
  append_words(file, {binary_bytes, kBinaryChunk});
  file.insert(file.end(), binary.begin(), binary.end());
  file.resize(total);
  const std::string checksum = glb_checksum(file);
  if (const std::size_t offset = checksum_offset(file); offset < file.size())
    std::memcpy(file.data() + offset, checksum.data(), checksum.size());
  return file;
}

Glb split_glb(std::span<const std::byte> file, std::string_view name) {
  const auto fail = [&](const std::string& wrong) { throw Error(name, wrong, kAcceptedBaked); };
  if (file.size() < 4 || word_at(file, 0) != kMagic) fail("is no binary glTF");
  if (file.size() < kHeaderBytes + 2 * kChunkHeaderBytes) fail("is cut short");
  if (word_at(file, 4) != kGltfVersion) fail(fmt::format("is of glTF version {}", word_at(file, 4)));
  const std::uint64_t total = word_at(file, 8);
  if (total > file.size()) fail(fmt::format("is cut short: {} of {} bytes", file.size(), total));

  // Lengths are 32 bits: none of the sums can overflow.
  const std::uint64_t json_bytes = word_at(file, 12);
  const std::uint64_t binary_at = kHeaderBytes + kChunkHeaderBytes + json_bytes;
  if (binary_at + kChunkHeaderBytes > file.size() || word_at(file, 16) != kJsonChunk ||
      word_at(file, binary_at + 4) != kBinaryChunk)
    fail("is malformed: its chunks are not JSON and BIN");
  const std::uint64_t binary_bytes = word_at(file, binary_at);
  if (total != file.size() || binary_at + kChunkHeaderBytes + binary_bytes != total)
    fail(fmt::format("is malformed: its parts do not add up to its {} bytes", file.size()));
  const auto text = file.subspan(kHeaderBytes + kChunkHeaderBytes, json_bytes);
  return {{reinterpret_cast<const char*>(text.data()), text.size()}, file.subspan(binary_at + kChunkHeaderBytes)};
}

std::string glb_checksum(std::span<const std::byte> file) {
  constexpr std::uint64_t kOffsetBasis = 0xcbf29ce484222325, kPrime = 0x100000001b3;
  std::uint64_t hash = kOffsetBasis;
  const auto add = [&](std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) hash = (hash ^ static_cast<std::uint64_t>(byte)) * kPrime;
  };
  const std::size_t digits = checksum_offset(file);
  add(file.first(digits));
  if (digits < file.size()) {
    add(std::as_bytes(std::span(kEmptyChecksum)));
    add(file.subspan(digits + kEmptyChecksum.size()));
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace shlight

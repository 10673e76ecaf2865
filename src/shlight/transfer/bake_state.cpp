#include "shlight/transfer/bake_state.h"

#include <cstring>
#include <limits>
#include <span>

#include "shlight/core/byte_stream.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/transfer/sobol.h"

namespace shlight {
namespace {

// The file: these eight characters, the state's numbers, its arrays with their lengths, and a hash of all before it.
// Little-endian, as every machine is that this runs on; a file from another kind fails the hash.
constexpr char kMagic[8] = {'s', 'h', 'l', 'b', 'a', 'k', 'e', '2'};
constexpr std::string_view kAccepted = "a checkpoint of the same bake, or no file there";

std::uint64_t hash_bytes(std::span<const std::byte> bytes) {
  std::uint64_t hash = bytes.size();
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof(word), bytes.size() - i));
    hash = mix_bits(hash ^ word);
  }
  return hash;
}

// The same sequence for both ways.
template <class Stream, class State>
void for_each_part(Stream& stream, State& state) {
  stream.field(state.hash);
  stream.field(state.density);
  stream.field(state.estimated_error);
  stream.field(state.pass);
  stream.field(state.batches_done);
  stream.field(state.rays);
  stream.list(state.direct);
  stream.list(state.total);
  stream.list(state.previous);
  stream.list(state.next);
  for (auto& batch : state.packed) stream.list(batch);
}

}  // namespace

void save_checkpoint(const std::filesystem::path& path, const BakeState& state) {
  ByteBuffer buffer;
  ByteWriter writer(buffer);
  buffer.append(std::as_bytes(std::span(kMagic)));
  for_each_part(writer, state);
  writer.field(hash_bytes(buffer.bytes));
  write_file(path, buffer.bytes);
}

BakeState load_checkpoint(const std::filesystem::path& path, const BakeState& fresh) {
  const std::vector<std::byte> bytes = read_file(path, std::numeric_limits<std::uint64_t>::max());
  const std::string subject = path.string();
  constexpr std::size_t kHash = sizeof(std::uint64_t);
  if (bytes.size() < sizeof(kMagic) + kHash || std::memcmp(bytes.data(), kMagic, sizeof(kMagic)) != 0)
    throw Error(subject, "is no checkpoint of a bake", kAccepted);
  const Error damaged(subject, "is damaged", kAccepted);
  const std::span<const std::byte> hashed(bytes.data(), bytes.size() - kHash);
  std::uint64_t hash = 0;
  std::memcpy(&hash, bytes.data() + hashed.size(), kHash);
  if (hash != hash_bytes(hashed)) throw damaged;

  BakeState state;
  const std::span<const std::byte> content = hashed.subspan(sizeof(kMagic));
  try {
    ByteReader(content).field(state.hash);
    if (state.hash != fresh.hash) throw Error(subject, "was made for another scene or other settings", kAccepted);
    state.packed.resize(fresh.packed.size());
    ByteReader reader(content);
    for_each_part(reader, state);
    if (!reader.at_end()) throw damaged;
  } catch (const ByteReader::Malformed&) {
    throw damaged;
  }
  if (state.direct.size() != fresh.direct.size() || state.total.size() != fresh.total.size() ||
      state.previous.size() != fresh.previous.size() || state.next.size() != fresh.next.size() ||
      state.batches_done > state.packed.size())
    throw damaged;
  return state;
}

}  // namespace shlight

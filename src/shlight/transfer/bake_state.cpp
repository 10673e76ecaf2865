#include "shlight/transfer/bake_state.h"

#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/transfer/sobol.h"

namespace shlight {
namespace {

// The file: these eight characters, the state's numbers, its arrays with their lengths, and a hash of all before it.
// Little-endian, as every machine is that this runs on; a file from another kind fails the hash.
constexpr char kMagic[8] = {'s', 'h', 'l', 'b', 'a', 'k', 'e', '1'};
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

class Writer {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&v, sizeof(v));
  }
  template <class T>
  void array(const std::vector<T>& v) {
    value(std::uint64_t{v.size()});
    append(v.data(), v.size() * sizeof(T));
  }
  std::vector<std::byte> bytes;

 private:
  void append(const void* data, std::size_t size) {
    const std::byte* begin = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
  }
};

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::string& subject) : bytes_(bytes), subject_(subject) {}
  template <class T>
  void value(T& v) {
    take(&v, sizeof(v));
  }
  template <class T>
  void array(std::vector<T>& v) {
    std::uint64_t size = 0;
    value(size);
    if (size > bytes_.size() / sizeof(T)) fail();
    v.resize(size);
    take(v.data(), size * sizeof(T));
  }
  bool is_at_end() const { return bytes_.empty(); }
  [[noreturn]] void fail() const { throw Error(subject_, "is damaged", kAccepted); }

 private:
  void take(void* data, std::size_t size) {
    if (size > bytes_.size()) fail();
    if (size > 0) std::memcpy(data, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }
  std::span<const std::byte> bytes_;
  const std::string& subject_;
};

// The same sequence for both ways.
template <class Stream, class State>
void for_each_part(Stream& stream, State& state) {
  stream.value(state.hash);
  stream.value(state.density);
  stream.value(state.estimated_error);
  stream.value(state.pass);
  stream.value(state.batches_done);
  stream.value(state.rays);
  stream.array(state.direct);
  stream.array(state.total);
  stream.array(state.previous);
  stream.array(state.next);
  for (auto& batch : state.packed) stream.array(batch);
}

}  // namespace

void save_checkpoint(const std::filesystem::path& path, const BakeState& state) {
  Writer writer;
  writer.value(kMagic);
  for_each_part(writer, state);
  writer.value(hash_bytes(writer.bytes));
  write_file(path, writer.bytes);
}

BakeState load_checkpoint(const std::filesystem::path& path, const BakeState& fresh) {
  const std::vector<std::byte> bytes = read_file(path, std::numeric_limits<std::uint64_t>::max());
  const std::string subject = path.string();
  constexpr std::size_t kHash = sizeof(std::uint64_t);
  if (bytes.size() < sizeof(kMagic) + kHash || std::memcmp(bytes.data(), kMagic, sizeof(kMagic)) != 0)
    throw Error(subject, "is no checkpoint of a bake", kAccepted);
  const std::span<const std::byte> hashed(bytes.data(), bytes.size() - kHash);
  std::uint64_t hash = 0;
  std::memcpy(&hash, bytes.data() + hashed.size(), kHash);
  const std::span<const std::byte> content = hashed.subspan(sizeof(kMagic));
  Reader reader(content, subject);
  if (hash != hash_bytes(hashed)) reader.fail();

  BakeState state;
  Reader(content, subject).value(state.hash);
  if (state.hash != fresh.hash) throw Error(subject, "was made for another scene or other settings", kAccepted);
  state.packed.resize(fresh.packed.size());
  for_each_part(reader, state);
  if (!reader.is_at_end() || state.direct.size() != fresh.direct.size() || state.total.size() != fresh.total.size() ||
      state.previous.size() != fresh.previous.size() || state.next.size() != fresh.next.size() ||
      state.batches_done > state.packed.size())
    reader.fail();
  return state;
}

}  // namespace shlight

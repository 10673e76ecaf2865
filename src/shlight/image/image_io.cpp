#include "shlight/image/image_io.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <type_traits>

#include "shlight/core/file.h"
#include "shlight/image/dds.h"
#include "shlight/image/picture_reader.h"
#include "shlight/image/raw_float.h"
#include "shlight/image/rgbe.h"

namespace shlight {
namespace {

// The first bytes of a file; fewer where it has fewer.
std::string first_bytes(const std::string& path, std::size_t count) {
  std::string text(count, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(count));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

// By readers of our own where OpenImageIO leaves out what counts for light.
LoadedImage decode(const PictureSource& source, const LoadImageParams& params) {
  const std::string& name = source.name;
  const std::uint64_t max_pixels = params.max_pixels;
  const auto whole_file = [&] {
    // The largest pixel of these formats has 16 bytes; as many again are for smaller levels.
    constexpr std::uint64_t kPixelBytes = 32, kHeaderBytes = 1 << 20;
    return read_file(name, kPixelBytes * std::min(max_pixels, std::uint64_t{1} << 48) + kHeaderBytes);
  };
  const std::string magic = first_bytes(name, 4);
  if (magic.starts_with("#?") || has_ending(name, {".hdr", ".rgbe"}))
    return decode_rgbe(whole_file(), name, max_pixels);
  if (has_ending(name, {".float"})) return decode_raw_float(whole_file(), name, max_pixels);
  if (magic == "DDS ") {
    const auto read_blocks = [&](std::span<const std::byte> bytes) {
      return read_by_library({name, bytes}, max_pixels).image;
    };
    if (auto loaded = decode_dds(whole_file(), name, max_pixels, read_blocks)) return *std::move(loaded);
  }
  return read_by_library(source, max_pixels);
}

struct LoadedImage8 {
  Image8 image;
  std::optional<Layout> layout;
  std::vector<std::string> warnings;
};

LoadedImage8 decode8(const PictureSource& source, const LoadImageParams& params) {
  return {read8_by_library(source, params.max_pixels), {}, {}};
}

// What crosses the fence: this, the values, and the warnings, each ended by a line feed.
struct FencedHeader {
  int width = 0, height = 0;
  int layout = -1;  // none
};

template <class Loaded>
void write_fenced(const Loaded& loaded, FencedBytes& out) {
  const FencedHeader header = {loaded.image.width, loaded.image.height,
                               loaded.layout ? static_cast<int>(*loaded.layout) : -1};
  std::string warnings;
  for (const std::string& warning : loaded.warnings) warnings += warning + '\n';
  const auto values = std::as_bytes(std::span(loaded.image.values)), words = std::as_bytes(std::span(warnings));
  std::byte* to = out.resize(sizeof header + values.size() + words.size()).data();
  std::memcpy(to, &header, sizeof header);
  std::memcpy(to + sizeof header, values.data(), values.size());
  std::copy(words.begin(), words.end(), to + sizeof header + values.size());
}

// A reader that a hostile file has got hold of can write anything: the size and the values must agree.
template <class Loaded>
Loaded read_fenced(const PictureSource& source, std::span<const std::byte> bytes) {
  using Value = typename decltype(Loaded{}.image.values)::value_type;
  constexpr std::size_t kPixelBytes = (std::is_same_v<Value, float> ? 3 : 4) * sizeof(Value);
  FencedHeader header;
  if (bytes.size() < sizeof header) throw malformed_picture(source.name, "");
  std::memcpy(&header, bytes.data(), sizeof header);
  bytes = bytes.subspan(sizeof header);
  if (header.width <= 0 || header.height <= 0 || header.layout < -1 ||
      header.layout > static_cast<int>(Layout::kOpenExrCube) ||
      bytes.size() / kPixelBytes / static_cast<std::size_t>(header.width) < static_cast<std::size_t>(header.height))
    throw malformed_picture(source.name, "");

  Loaded loaded;
  loaded.image.width = header.width, loaded.image.height = header.height;
  if (header.layout >= 0) loaded.layout = static_cast<Layout>(header.layout);
  const std::size_t value_bytes =
      kPixelBytes * static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
  const auto* values = reinterpret_cast<const Value*>(bytes.data());
  loaded.image.values.assign(values, values + value_bytes / sizeof(Value));
  bytes = bytes.subspan(value_bytes);
  while (!bytes.empty()) {
    const auto end = std::find(bytes.begin(), bytes.end(), std::byte{'\n'});
    const auto length = static_cast<std::size_t>(end - bytes.begin());
    std::string& warning = loaded.warnings.emplace_back(reinterpret_cast<const char*>(bytes.data()), length);
    for (char& c : warning)
      if (c < ' ' || c > '~') c = '?';  // names out of a file
    bytes = bytes.subspan(std::min(length + 1, bytes.size()));
  }
  return loaded;
}

// Runs a decoder behind the fence.
template <class Loaded>
Loaded load_fenced(const PictureSource& source, const LoadImageParams& params,
                   Loaded (*decode)(const PictureSource&, const LoadImageParams&)) {
  if (source.bytes.empty() && !std::filesystem::is_regular_file(source.name)) {
    const bool exists = std::filesystem::exists(source.name);
    throw Error(source.name, exists ? "is not a regular file" : "no such file", kAcceptedPictures);
  }
  const std::uintmax_t file_bytes =
      source.bytes.empty() ? std::filesystem::file_size(source.name) : source.bytes.size();
  const FencedBytes fenced = run_fenced(source.name, kAcceptedPictures, limits_for_file(params.fence, file_bytes),
                                        [&](FencedBytes& out) { write_fenced(decode(source, params), out); });
  return read_fenced<Loaded>(source, fenced.bytes());
}

}  // namespace

LoadedImage load_image(const std::filesystem::path& path, const LoadImageParams& params) {
  return load_fenced<LoadedImage>({path.string(), {}}, params, decode);
}

Image8 load_image8(const std::filesystem::path& path, const LoadImageParams& params) {
  return load_fenced<LoadedImage8>({path.string(), {}}, params, decode8).image;
}

Image8 load_image8(std::span<const std::byte> bytes, const std::string& name, const LoadImageParams& params) {
  if (bytes.empty()) throw Error(name, "is empty", kAcceptedPictures);
  return load_fenced<LoadedImage8>({name, bytes}, params, decode8).image;
}

}  // namespace shlight

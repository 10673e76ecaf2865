#include "shlight/image/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <memory>
#include <type_traits>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/image/picture_reader.h"
#include "shlight/image/rgbe.h"

namespace shlight {
namespace {

constexpr float kLargestHalf = 65504;

// OpenImageIO's and OpenEXR's own threads would not survive a fork, on either side of the fence.
void without_threads() {
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
}

// The name of a file, or its bytes and what to call them.
struct Source {
  std::string name;
  std::span<const std::byte> bytes;  // empty: read the file of that name
};

Error malformed(const Source& source, std::string why) {
  return malformed_picture(source.name, std::move(why));
}

// An open picture whose header has been checked.
struct OpenPicture {
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
};

OpenPicture open_picture(const Source& source, const LoadImageParams& params) {
  OpenPicture picture;
  OIIO::ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);  // colours as the file has them
  if (!source.bytes.empty()) {
    picture.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<std::byte*>(source.bytes.data()),
                                                                     source.bytes.size());
    OIIO::Filesystem::IOProxy* proxy = picture.memory.get();
    wish.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  }
  picture.input = OIIO::ImageInput::open(source.name, &wish, picture.memory.get());
  if (!picture.input) throw malformed(source, OIIO::geterror());
  picture.spec = picture.input->spec();

  const OIIO::ImageSpec& spec = picture.spec;
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
    throw Error(source.name, fmt::format("has {} x {} pixels of {} channels", spec.width, spec.height, spec.nchannels),
                "a picture with at least one pixel");
  if (spec.image_pixels() > params.max_pixels)
    throw Error(source.name, fmt::format("has {} x {} pixels", spec.width, spec.height),
                fmt::format("at most {} pixels", params.max_pixels));
  if (spec.deep) throw Error(source.name, "is a deep picture", "one sample a pixel");
  if (spec.depth > 1) throw Error(source.name, "is a volume", "a picture of one slice");
  return picture;
}

// The channels to take for red, green and blue: those of these names, else the first three, else the first for all.
std::array<int, 3> colour_channels(const OIIO::ImageSpec& spec) {
  const auto find = [&](const char* name) {
    const auto at = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    return at == spec.channelnames.end() ? -1 : static_cast<int>(at - spec.channelnames.begin());
  };
  const std::array<int, 3> named = {find("R"), find("G"), find("B")};
  if (named[0] >= 0 && named[1] >= 0 && named[2] >= 0) return named;
  if (spec.nchannels >= 3) return {0, 1, 2};
  return {0, 0, 0};
}

// The same conversion as IEC 61966-2-1 has it.
float linear_from_srgb(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

template <class T>
void read_pixels(const Source& source, OpenPicture& picture, int first_channel, int end_channel, OIIO::TypeDesc type,
                 std::span<T> values) {
  if (!picture.input->read_image(0, 0, first_channel, end_channel, type, values.data()))
    throw malformed(source, picture.input->geterror());
}

LoadedImage decode_by_library(const Source& source, const LoadImageParams& params) {
  without_threads();
  OpenPicture picture = open_picture(source, params);
  const OIIO::ImageSpec& spec = picture.spec;
  LoadedImage loaded{Image(spec.width, spec.height), {}, {}};
  const std::span<float> rgb = loaded.image.values;

  const auto [r, g, b] = colour_channels(spec);
  if (g == r + 1 && b == r + 2) {
    read_pixels(source, picture, r, r + 3, OIIO::TypeFloat, rgb);
  } else {
    const std::size_t channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> all(channels * loaded.image.num_pixels());
    read_pixels(source, picture, 0, spec.nchannels, OIIO::TypeFloat, std::span(all));
    for (std::size_t i = 0; i < loaded.image.num_pixels(); ++i) {
      const float* pixel = all.data() + i * channels;
      rgb[3 * i] = pixel[r], rgb[3 * i + 1] = pixel[g], rgb[3 * i + 2] = pixel[b];
    }
  }
  if (!spec.format.is_floating_point())
    for (float& value : rgb) value = linear_from_srgb(value);
  return loaded;
}

// The first bytes of a file; fewer where it has fewer.
std::string first_bytes(const std::string& path, std::size_t count) {
  std::string text(count, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(count));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

bool has_ending(const std::string& path, std::initializer_list<std::string_view> endings) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::ranges::count(endings, ending) > 0;
}

// By our own readers where OpenImageIO's leave out what counts for light.
LoadedImage decode_float(const Source& source, const LoadImageParams& params) {
  const std::string& name = source.name;
  const auto whole = [&] {
    // The largest pixel of any of these formats has 16 bytes; the rest is for smaller levels and headers.
    const std::uint64_t most = params.max_pixels < (1ull << 58) ? 32 * params.max_pixels + (1 << 20) : ~0ull;
    return read_file(name, most);
  };
  if (first_bytes(name, 2) == "#?" || has_ending(name, {".hdr", ".rgbe"}))
    return decode_rgbe(whole(), name, params.max_pixels);
  return decode_by_library(source, params);
}

struct LoadedImage8 {
  Image8 image;
  std::optional<Layout> layout;
  std::vector<std::string> warnings;
};

LoadedImage8 decode_bytes(const Source& source, const LoadImageParams& params) {
  without_threads();
  OpenPicture picture = open_picture(source, params);
  const OIIO::ImageSpec& spec = picture.spec;
  const std::size_t pixels = spec.image_pixels(), channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<unsigned char> all(channels * pixels);
  read_pixels(source, picture, 0, spec.nchannels, OIIO::TypeUInt8, std::span(all));

  LoadedImage8 loaded;
  loaded.image = {spec.width, spec.height, std::vector<unsigned char>(4 * pixels)};
  unsigned char* rgba = loaded.image.values.data();
  const auto [r, g, b] = colour_channels(spec);
  const int alpha = spec.alpha_channel;
  for (std::size_t i = 0; i < pixels; ++i) {
    const unsigned char* pixel = all.data() + i * channels;
    rgba[4 * i] = pixel[r], rgba[4 * i + 1] = pixel[g], rgba[4 * i + 2] = pixel[b];
    rgba[4 * i + 3] = alpha >= 0 ? pixel[alpha] : 255;
  }
  return loaded;
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
Loaded read_fenced(const Source& source, std::span<const std::byte> bytes) {
  using Value = typename decltype(Loaded{}.image.values)::value_type;
  constexpr std::size_t kPixelBytes = (std::is_same_v<Value, float> ? 3 : 4) * sizeof(Value);
  FencedHeader header;
  if (bytes.size() < sizeof header) throw malformed(source, "");
  std::memcpy(&header, bytes.data(), sizeof header);
  bytes = bytes.subspan(sizeof header);
  if (header.width <= 0 || header.height <= 0 || header.layout < -1 ||
      header.layout > static_cast<int>(Layout::kOpenExrCube) ||
      bytes.size() / kPixelBytes / static_cast<std::size_t>(header.width) < static_cast<std::size_t>(header.height))
    throw malformed(source, "");

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
    loaded.warnings.emplace_back(reinterpret_cast<const char*>(bytes.data()), length);
    bytes = bytes.subspan(std::min(length + 1, bytes.size()));
  }
  return loaded;
}

// Runs a decoder behind the fence.
template <class Loaded>
Loaded load_fenced(const Source& source, const LoadImageParams& params,
                   Loaded (*decode)(const Source&, const LoadImageParams&)) {
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

void encode(const std::filesystem::path& path, OIIO::ImageSpec spec, OIIO::TypeDesc type, const void* values,
            const char* accepted) {
  without_threads();
  const std::string name = path.string();
  auto output = OIIO::ImageOutput::create(name);
  if (!output || !output->supports("ioproxy"))
    throw Error(name, fmt::format("cannot write '{}' pictures", path.extension().string()), accepted);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  output->set_ioproxy(&memory);
  if (!output->open(name, spec) || !output->write_image(type, values) || !output->close())
    throw Error(name, "cannot be encoded (" + output->geterror() + ")", accepted);
  write_file(path, std::as_bytes(std::span(bytes)));
}

}  // namespace

LoadedImage load_image(const std::filesystem::path& path, const LoadImageParams& params) {
  return load_fenced<LoadedImage>({path.string(), {}}, params, decode_float);
}

Image8 load_image8(const std::filesystem::path& path, const LoadImageParams& params) {
  return load_fenced<LoadedImage8>({path.string(), {}}, params, decode_bytes).image;
}

Image8 load_image8(std::span<const std::byte> bytes, const std::string& name, const LoadImageParams& params) {
  if (bytes.empty()) throw Error(name, "is empty", kAcceptedPictures);
  return load_fenced<LoadedImage8>({name, bytes}, params, decode_bytes).image;
}

void save_image(const std::filesystem::path& path, const Image& image, std::optional<Layout> layout) {
  if (has_ending(path.string(), {".hdr"})) return write_file(path, encode_rgbe(image, path.string()));
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::HALF);
  // Half floats are what everybody reads, but a sun does not fit into them.
  for (const float value : image.values)
    if (std::abs(value) > kLargestHalf) spec.set_format(OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  if (layout == Layout::kOpenExrLatLong) spec.attribute("textureformat", "LatLong Environment");
  if (layout == Layout::kOpenExrCube) spec.attribute("textureformat", "CubeFace Environment");
  spec.attribute("oiio:ColorSpace", "Linear");
  encode(path, spec, OIIO::TypeFloat, image.values.data(), "a file name that ends in .exr");
}

void save_image8(const std::filesystem::path& path, const Image8& image) {
  OIIO::ImageSpec spec(image.width, image.height, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  encode(path, spec, OIIO::TypeDesc::UINT8, image.values.data(), "a file name that ends in .png");
}

}  // namespace shlight

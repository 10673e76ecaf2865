#include "shlight/image/dds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "shlight/image/picture_reader.h"

namespace shlight {
namespace {

constexpr const char* kAcceptedFormats = "half, float, R11G11B10, R9G9B9E5, 8-bit RGB or BGR, BC1 to BC3, BC6H or BC7";

constexpr std::uint32_t four_cc(const char (&text)[5]) {
  std::uint32_t code = 0;
  for (unsigned i = 0; i < 4; ++i) code |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])) << 8 * i;
  return code;
}

// What follows "DDS ", as the file has it: little-endian words.
struct Header {
  std::uint32_t size, flags, height, width, pitch, depth, levels, reserved[11];
  struct {
    std::uint32_t size, flags, four_cc, bits, red, green, blue, alpha;
  } pixel;
  std::uint32_t caps, caps2, caps3, caps4, reserved2;
};
struct Dx10Header {
  std::uint32_t format, dimension, misc, array_size, misc2;
};
constexpr std::uint32_t kHeaderSize = 124, kPixelHeaderSize = 32;
static_assert(sizeof(Header) == kHeaderSize && sizeof(Dx10Header) == 20);
static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t kPixelFourCc = 0x4, kPixelRgb = 0x40;
constexpr std::uint32_t kCube = 0x200, kAllFaces = 0xfc00, kVolume = 0x200000;
constexpr std::uint32_t kDx10Cube = 0x4, kDx10Picture = 3;

enum class Kind { kHalf4, kFloat4, kFloat3, kR11G11B10, kR9G9B9E5, kBytes, kBlocks };

struct Format {
  Kind kind;
  unsigned bytes = 0;                     // of a pixel, or of a block of 4 x 4
  std::array<unsigned, 3> channels = {};  // kBytes: which byte is red, green and blue
  std::uint32_t four_cc = 0, dxgi = 0;    // kBlocks: how to say it to another reader
};

// By DXGI_FORMAT.
std::optional<Format> dxgi_format(std::uint32_t format) {
  constexpr std::array<unsigned, 3> kRgb = {0, 1, 2}, kBgr = {2, 1, 0};
  switch (format) {
    case 2:
      return Format{Kind::kFloat4, 16};
    case 6:
      return Format{Kind::kFloat3, 12};
    case 10:
      return Format{Kind::kHalf4, 8};
    case 26:
      return Format{Kind::kR11G11B10, 4};
    case 67:
      return Format{Kind::kR9G9B9E5, 4};
    case 28:  // and 29, _SRGB
    case 29:
      return Format{Kind::kBytes, 4, kRgb};
    case 87:  // with alpha and without, and both _SRGB
    case 88:
    case 91:
    case 93:
      return Format{Kind::kBytes, 4, kBgr};
    case 71:
    case 72:
      return Format{Kind::kBlocks, 8, {}, four_cc("DXT1")};
    case 74:
    case 75:
      return Format{Kind::kBlocks, 16, {}, four_cc("DXT3")};
    case 77:
    case 78:
      return Format{Kind::kBlocks, 16, {}, four_cc("DXT5")};
    case 95:  // BC6H_UF16, BC6H_SF16, BC7_UNORM and BC7_UNORM_SRGB
    case 96:
    case 98:
    case 99:
      return Format{Kind::kBlocks, 16, {}, four_cc("DX10"), format == 99 ? 98 : format};
    default:
      return {};
  }
}

// Which byte of a pixel a mask is; 4 where it is none.
unsigned byte_of_mask(std::uint32_t mask) {
  for (unsigned byte = 0; byte < 4; ++byte)
    if (mask == 0xffu << 8 * byte) return byte;
  return 4;
}

std::optional<Format> legacy_format(const Header& header) {
  const auto& pixel = header.pixel;
  if (pixel.flags & kPixelFourCc) {
    switch (pixel.four_cc) {
      case 113:  // D3DFMT_A16B16G16R16F
        return Format{Kind::kHalf4, 8};
      case 116:  // D3DFMT_A32B32G32R32F
        return Format{Kind::kFloat4, 16};
      case four_cc("DXT1"):
        return Format{Kind::kBlocks, 8, {}, pixel.four_cc};
      case four_cc("DXT3"):
      case four_cc("DXT5"):
        return Format{Kind::kBlocks, 16, {}, pixel.four_cc};
      default:
        return {};
    }
  }
  if (!(pixel.flags & kPixelRgb) || (pixel.bits != 24 && pixel.bits != 32)) return {};
  const Format format = {
      Kind::kBytes, pixel.bits / 8, {byte_of_mask(pixel.red), byte_of_mask(pixel.green), byte_of_mask(pixel.blue)}};
  for (const unsigned byte : format.channels)
    if (byte >= format.bytes) return {};
  return format;
}

// Mantissas of ten bits and exponents of five, biased by 15.
float float_from_half(std::uint32_t half) {
  const bool negative = half & 0x8000;
  const int exponent = static_cast<int>(half >> 10 & 31), mantissa = static_cast<int>(half & 1023);
  float value = std::ldexp(static_cast<float>(exponent == 0 ? mantissa : mantissa + 1024), std::max(exponent, 1) - 25);
  if (exponent == 31) value = mantissa == 0 ? HUGE_VALF : NAN;
  return negative ? -value : value;
}

template <class Word>
Word load(const std::byte* from) {
  Word word;
  std::memcpy(&word, from, sizeof word);
  return word;
}

void decode_pixel(const Format& format, const std::byte* from, float* rgb) {
  switch (format.kind) {
    case Kind::kHalf4:
      for (std::size_t c = 0; c < 3; ++c) rgb[c] = float_from_half(load<std::uint16_t>(from + 2 * c));
      break;
    case Kind::kFloat4:
    case Kind::kFloat3:
      for (std::size_t c = 0; c < 3; ++c) rgb[c] = load<float>(from + 4 * c);
      break;
    case Kind::kR11G11B10: {  // halves without sign and without the last bits of the mantissa
      const auto word = load<std::uint32_t>(from);
      rgb[0] = float_from_half((word & 0x7ff) << 4);
      rgb[1] = float_from_half((word >> 11 & 0x7ff) << 4);
      rgb[2] = float_from_half((word >> 22) << 5);
      break;
    }
    case Kind::kR9G9B9E5: {
      const auto word = load<std::uint32_t>(from);
      for (unsigned c = 0; c < 3; ++c)
        rgb[c] = std::ldexp(static_cast<float>(word >> 9 * c & 511), static_cast<int>(word >> 27) - 24);
      break;
    }
    case Kind::kBytes:
      for (std::size_t c = 0; c < 3; ++c) rgb[c] = linear_from_srgb(static_cast<float>(from[format.channels[c]]) / 255);
      break;
    case Kind::kBlocks:
      break;
  }
}

// A file that holds one picture of blocks.
std::vector<std::byte> single_picture(const Format& format, std::uint32_t width, std::uint32_t height,
                                      std::span<const std::byte> blocks) {
  Header header = {};
  header.size = kHeaderSize;
  header.flags = 0x81007;  // caps, height, width, pixel format, linear size
  header.height = height, header.width = width;
  header.pitch = static_cast<std::uint32_t>(blocks.size());
  header.levels = 1;
  header.pixel.size = kPixelHeaderSize;
  header.pixel.flags = kPixelFourCc;
  header.pixel.four_cc = format.four_cc;
  header.caps = 0x1000;  // texture
  const Dx10Header dx10 = {format.dxgi, kDx10Picture, 0, 1, 0};

  std::vector<std::byte> file;
  const auto append = [&](std::span<const std::byte> part) { file.insert(file.end(), part.begin(), part.end()); };
  append(std::as_bytes(std::span("DDS ", 4)));
  append(std::as_bytes(std::span(&header, 1)));
  if (format.dxgi != 0) append(std::as_bytes(std::span(&dx10, 1)));
  append(blocks);
  return file;
}

std::uint64_t level_bytes(const Format& format, std::uint64_t width, std::uint64_t height) {
  if (format.kind == Kind::kBlocks) return (width + 3) / 4 * ((height + 3) / 4) * format.bytes;
  return width * height * format.bytes;
}

}  // namespace

std::optional<LoadedImage> decode_dds(std::span<const std::byte> bytes, const std::string& name,
                                      std::uint64_t max_pixels, const ReadBlocks& read_blocks) {
  const auto take = [&](auto& part) {
    if (bytes.size() < sizeof part) throw malformed_picture(name, "it ends within its header");
    std::memcpy(&part, bytes.data(), sizeof part);
    bytes = bytes.subspan(sizeof part);
  };
  char magic[4];
  Header header;
  Dx10Header dx10 = {};
  take(magic);
  take(header);
  if (std::memcmp(magic, "DDS ", sizeof magic) != 0 || header.size != kHeaderSize ||
      header.pixel.size != kPixelHeaderSize)
    throw malformed_picture(name, "no DDS header");
  const bool has_dx10 = (header.pixel.flags & kPixelFourCc) && header.pixel.four_cc == four_cc("DX10");
  if (has_dx10) take(dx10);

  const bool cube = (header.caps2 & kCube) || (dx10.misc & kDx10Cube);
  const auto format = has_dx10 ? dxgi_format(dx10.format) : legacy_format(header);
  const bool one = !(header.caps2 & kVolume) && (!has_dx10 || (dx10.dimension == kDx10Picture && dx10.array_size <= 1));
  if (!cube && (!format || !one)) {
    // OpenImageIO 2.4 shifts a mask of no bits for ever.
    const auto& pixel = header.pixel;
    if ((pixel.flags & kPixelRgb) && (pixel.red == 0 || pixel.green == 0 || pixel.blue == 0))
      throw Error(name, "has pixels without masks for red, green and blue", kAcceptedFormats);
    return {};
  }
  if (header.caps2 & kVolume || (has_dx10 && dx10.dimension != kDx10Picture))
    throw Error(name, "is no plain cube map", "two-dimensional faces");
  if (dx10.array_size > 1)
    throw Error(name, fmt::format("is an array of {} cube maps", dx10.array_size), "a single one");
  // A DX10 header means all six; its file need not repeat them in the older fields.
  if (cube && !(dx10.misc & kDx10Cube) && (header.caps2 & kAllFaces) != kAllFaces)
    throw Error(name, fmt::format("has {} of a cube map's faces", std::popcount(header.caps2 & kAllFaces)), "all six");
  if (!format)
    throw Error(name,
                has_dx10
                    ? fmt::format("has the pixel format DXGI {}", dx10.format)
                    : fmt::format("has the pixel format {:#x} of {} bits", header.pixel.four_cc, header.pixel.bits),
                kAcceptedFormats);
  if (cube && header.width != header.height)
    throw Error(name, fmt::format("has faces of {} x {} pixels", header.width, header.height), "square ones");
  const std::uint64_t faces = cube ? 6 : 1, width = header.width, height = header.height;
  check_picture_size(name, header.width, static_cast<std::int64_t>(faces * height), max_pixels);
  constexpr std::uint64_t kLargest = 1 << 24;  // so that no product below overflows
  if (width > kLargest || height > kLargest)
    throw Error(name, fmt::format("has {} x {} pixels", width, height), fmt::format("at most {} a side", kLargest));

  // Each face is followed by its smaller levels.
  const int levels = std::max(1, static_cast<int>(std::min(header.levels, 99u)));
  if (levels > static_cast<int>(std::bit_width(std::max(width, height))))
    throw malformed_picture(name, fmt::format("{} levels of {} x {} pixels", header.levels, width, height));
  std::uint64_t face_bytes = 0;
  for (int level = 0; level < levels; ++level)
    face_bytes +=
        level_bytes(*format, std::max(std::uint64_t{1}, width >> level), std::max(std::uint64_t{1}, height >> level));
  const std::uint64_t first_bytes = level_bytes(*format, width, height);
  if (bytes.size() < (faces - 1) * face_bytes + first_bytes) throw malformed_picture(name, "it ends too soon");

  LoadedImage loaded{Image(static_cast<int>(width), static_cast<int>(faces * height)), {}, {}};
  if (cube) loaded.layout = Layout::kCube;
  const std::size_t face_values = 3 * width * height;
  for (std::uint64_t face = 0; face < faces; ++face) {
    const auto from = bytes.subspan(face * face_bytes, first_bytes);
    float* to = loaded.image.values.data() + face * face_values;
    if (format->kind == Kind::kBlocks) {
      const Image image = read_blocks(single_picture(*format, header.width, header.height, from));
      if (image.values.size() != face_values) throw malformed_picture(name, "a face of another size");
      std::copy(image.values.begin(), image.values.end(), to);
    } else {
      for (std::size_t i = 0; i < width * height; ++i)
        decode_pixel(*format, from.data() + i * format->bytes, to + 3 * i);
    }
  }
  return loaded;
}

}  // namespace shlight

#include "shlight/image/rgbe.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

#include "shlight/image/chromaticities.h"
#include "shlight/image/picture_reader.h"

namespace shlight {
namespace {

constexpr int kExponentBias = 136;  // 128, and eight bits of mantissa

struct Rgbe {
  std::uint8_t channels[4];  // red, green, blue, exponent
};

// What the lines before the pixels say.
struct Header {
  double divisor[3] = {1, 1, 1};
  std::optional<Chromaticities> primaries;
  bool xyz = false;
  // The picture is read as `count` runs of `length` pixels along one axis.
  bool rows = true;  // runs are rows, not columns
  bool x_up = true, y_up = false;
  int width = 0, height = 0;
  std::vector<std::string> warnings;
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// The number that a text begins with, taken away from it; nothing where it begins with none.
template <class Number>
std::optional<Number> take_number(std::string_view& text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  Number number{};
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failed != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool is_factor(std::optional<double> value) {
  return value && std::isfinite(*value) && *value > 0;
}

// Reads lines off the front of a file.
class Lines {
 public:
  explicit Lines(std::span<const std::byte>& bytes) : bytes_(bytes) {}
  std::optional<std::string_view> next() {
    const std::string_view text(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
    const auto end = text.find('\n');
    if (end == std::string_view::npos) return {};
    bytes_ = bytes_.subspan(end + 1);
    return trimmed(text.substr(0, end));
  }

 private:
  std::span<const std::byte>& bytes_;
};

// "-Y 512 +X 1024": from the second axis' decreasing end to … ; the first axis named is the one that changes slowly.
bool parse_resolution(std::string_view line, Header& header) {
  char axes[2] = {};
  for (char& axis : axes) {
    line = trimmed(line);
    if (line.size() < 2 || (line[0] != '+' && line[0] != '-') || (line[1] != 'X' && line[1] != 'Y')) return false;
    const bool up = line[0] == '+';
    axis = line[1];
    line.remove_prefix(2);
    if (line.empty() || (line[0] != ' ' && line[0] != '\t')) return false;
    const auto size = take_number<int>(line);
    if (!size) return false;
    (axis == 'X' ? header.width : header.height) = *size;
    (axis == 'X' ? header.x_up : header.y_up) = up;
  }
  header.rows = axes[0] == 'Y';
  return axes[0] != axes[1] && line.empty();
}

Header parse_header(std::span<const std::byte>& bytes, const std::string& name) {
  Lines lines(bytes);
  const auto magic = lines.next();
  if (!magic || !magic->starts_with("#?")) throw malformed_picture(name, "no #?RADIANCE at its start");

  Header header;
  std::string_view format;
  int bad_exposures = 0, bad_corrections = 0;
  bool bad_primaries = false;
  for (;;) {
    const auto line = lines.next();
    if (!line) throw malformed_picture(name, "its header does not end");
    if (line->empty()) break;
    const auto equals = line->find('=');
    if (line->starts_with('#') || equals == std::string_view::npos) continue;
    const std::string_view key = trimmed(line->substr(0, equals));
    std::string_view value = line->substr(equals + 1);

    if (key == "FORMAT") {
      value = trimmed(value);
      if (value != "32-bit_rle_rgbe" && value != "32-bit_rle_xyze")
        throw Error(name, "has pixels of the format '" + std::string(value.substr(0, 80)) + "'",
                    "32-bit_rle_rgbe or 32-bit_rle_xyze");
      if (!format.empty() && format != value) throw malformed_picture(name, "two FORMAT lines that differ");
      format = value;
      header.xyz = value == "32-bit_rle_xyze";
    } else if (key == "EXPOSURE") {
      const auto factor = take_number<double>(value);
      if (!is_factor(factor))
        ++bad_exposures;
      else
        for (double& divisor : header.divisor) divisor *= *factor;
    } else if (key == "COLORCORR") {
      const auto r = take_number<double>(value), g = take_number<double>(value), b = take_number<double>(value);
      if (!is_factor(r) || !is_factor(g) || !is_factor(b))
        ++bad_corrections;
      else
        header.divisor[0] *= *r, header.divisor[1] *= *g, header.divisor[2] *= *b;
    } else if (key == "PRIMARIES") {
      double numbers[8] = {};
      bool all = true, zero = true;
      for (double& number : numbers) {
        const auto taken = take_number<double>(value);
        all = all && taken;
        number = taken.value_or(0);
        zero = zero && number == 0;
      }
      const Chromaticities primaries = {
          {numbers[0], numbers[1]}, {numbers[2], numbers[3]}, {numbers[4], numbers[5]}, {numbers[6], numbers[7]}};
      header.primaries.reset();
      bad_primaries = !all || (!zero && !rec709_from(primaries));
      if (all && !zero && !bad_primaries) header.primaries = primaries;
    }
  }

  const auto warn = [&](std::string text) { header.warnings.push_back(std::move(text)); };
  if (format.empty()) warn("has no FORMAT line, taken as 32-bit_rle_rgbe");
  if (bad_exposures > 0)
    warn(fmt::format("{} EXPOSURE line{} without a positive, finite number, ignored", bad_exposures,
                     bad_exposures == 1 ? "" : "s"));
  if (bad_corrections > 0)
    warn(fmt::format("{} COLORCORR line{} without three positive, finite numbers, ignored", bad_corrections,
                     bad_corrections == 1 ? "" : "s"));
  if (bad_primaries) warn("its PRIMARIES make no colour space, ignored: taken as Rec. 709");
  for (double& divisor : header.divisor)
    if (!is_factor(divisor) || !is_factor(1 / divisor)) {
      warn("its EXPOSURE and COLORCORR lines multiply to no finite number, ignored");
      for (double& all : header.divisor) all = 1;
    }
  if (header.xyz && header.primaries) {
    warn("its PRIMARIES are ignored: it is in CIE XYZ");
    header.primaries.reset();
  }

  const auto resolution = lines.next();
  if (!resolution || !parse_resolution(*resolution, header))
    throw malformed_picture(name, "no size such as '-Y 512 +X 1024' after its header");
  return header;
}

// Reads runs of pixels, each encoded by itself.
class PixelReader {
 public:
  PixelReader(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  void read(std::span<Rgbe> run) {
    constexpr std::size_t kShortest = 8, kLongest = 0x7fff;
    if (run.size() >= kShortest && run.size() <= kLongest && bytes_.size() >= 4 && at(0) == 2 && at(1) == 2 &&
        at(2) < 128) {
      if (static_cast<std::size_t>(at(2) << 8 | at(3)) != run.size())
        throw malformed_picture(name_, "a scanline of another length than the picture's");
      bytes_ = bytes_.subspan(4);
      for (std::size_t channel = 0; channel < 4; ++channel) read_channel(run, channel);
    } else {
      read_pixels(run);
    }
  }

 private:
  unsigned at(std::size_t i) const { return std::to_integer<unsigned>(bytes_[i]); }
  void need(std::size_t count) const {
    if (bytes_.size() < count) throw malformed_picture(name_, "it ends too soon");
  }

  // New run-length encoding, one channel at a time: a count above 128 repeats the next byte, one up to 128 is followed
  // by as many bytes.
  void read_channel(std::span<Rgbe> run, std::size_t channel) {
    for (std::size_t x = 0; x < run.size();) {
      need(2);
      const bool repeat = at(0) > 128;
      const std::size_t count = repeat ? at(0) - 128 : at(0);
      if (count == 0 || count > run.size() - x) throw malformed_picture(name_, "a run of bytes leaves its scanline");
      need(1 + (repeat ? 1 : count));
      for (std::size_t i = 0; i < count; ++i)
        run[x++].channels[channel] = static_cast<std::uint8_t>(at(repeat ? 1 : 1 + i));
      bytes_ = bytes_.subspan(1 + (repeat ? 1 : count));
    }
  }

  // Flat, or the old encoding: mantissas of 1, 1, 1 repeat the pixel before by the exponent; several in a row are the
  // digits, base 256, of one number, the lowest first.
  void read_pixels(std::span<Rgbe> run) {
    unsigned shift = 0;
    for (std::size_t x = 0; x < run.size();) {
      need(4);
      Rgbe pixel;
      std::memcpy(pixel.channels, bytes_.data(), 4);
      bytes_ = bytes_.subspan(4);
      if (pixel.channels[0] != 1 || pixel.channels[1] != 1 || pixel.channels[2] != 1) {
        run[x++] = pixel;
        shift = 0;
        continue;
      }
      const std::uint64_t count = shift < 32 ? std::uint64_t{pixel.channels[3]} << shift : 0;
      if (x == 0 || shift >= 32 || count > run.size() - x)
        throw malformed_picture(name_, "a run of pixels leaves its scanline");
      for (std::uint64_t i = 0; i < count; ++i, ++x) run[x] = run[x - 1];
      shift += 8;
    }
  }

  std::span<const std::byte> bytes_;
  const std::string& name_;
};

}  // namespace

LoadedImage decode_rgbe(std::span<const std::byte> bytes, const std::string& name, std::uint64_t max_pixels) {
  Header header = parse_header(bytes, name);
  check_picture_size(name, header.width, header.height, max_pixels);
  const int count = header.rows ? header.height : header.width;
  const int length = header.rows ? header.width : header.height;
  if (bytes.size() / 4 < static_cast<std::size_t>(count)) throw malformed_picture(name, "it ends too soon");

  // What a mantissa of one is worth, for each channel and exponent.
  std::array<std::array<double, 256>, 3> unit;
  for (std::size_t c = 0; c < 3; ++c)
    for (int e = 0; e < 256; ++e)
      unit[c][static_cast<std::size_t>(e)] = e == 0 ? 0 : std::ldexp(1, e - kExponentBias) / header.divisor[c];

  LoadedImage loaded{Image(header.width, header.height), {}, std::move(header.warnings)};
  PixelReader reader(bytes, name);
  std::vector<Rgbe> run(static_cast<std::size_t>(length));
  for (int i = 0; i < count; ++i) {
    reader.read(run);
    for (int j = 0; j < length; ++j) {
      // Radiance's Y goes up, ours down.
      const int x = header.rows ? j : i, y = header.rows ? i : j;
      const auto pixel =
          loaded.image.pixel(header.x_up ? x : header.width - 1 - x, header.y_up ? header.height - 1 - y : y);
      const auto& from = run[static_cast<std::size_t>(j)].channels;
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<float>(from[c] * unit[c][from[3]]);
    }
  }
  const Chromaticities primaries = header.xyz ? kCieXyz : header.primaries.value_or(kRec709);
  const ColourMatrix matrix = *rec709_from(primaries);
  if (!is_nearly_identity(matrix)) convert_colours(matrix, loaded.image);
  return loaded;
}

std::vector<std::byte> encode_rgbe(const Image& image, const std::string& name) {
  std::string bytes = fmt::format(
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nPRIMARIES=0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329\n\n-Y {} +X {}\n",
      image.height, image.width);
  bytes.reserve(bytes.size() + 4 * image.num_pixels());
  const double most = std::ldexp(255.5, 255 - kExponentBias);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto pixel = image.pixel(x, y);
      double largest = 0;
      for (const float value : pixel) {
        if (!(value >= 0 && value < most))
          throw Error(name, fmt::format("cannot hold the value {:g} of pixel {}, {}", value, x, y),
                      "values from 0 to 1.69e38, or a file name that ends in .exr");
        largest = std::max(largest, static_cast<double>(value));
      }
      // The largest mantissa is 128 to 255 after rounding. What is too small for that is black, so that no pixel looks
      // like the 1, 1, 1 or 2, 2, n that the run-length encodings begin with.
      int exponent = 0;
      if (largest > 0) std::frexp(largest, &exponent);
      if (std::nearbyint(std::ldexp(largest, 8 - exponent)) > 255) ++exponent;
      const int biased = exponent + kExponentBias - 8;
      const bool black = largest == 0 || biased < 1;
      for (const float value : pixel)
        bytes += static_cast<char>(black ? 0 : static_cast<int>(std::nearbyint(std::ldexp(value, 8 - exponent))));
      bytes += static_cast<char>(black ? 0 : biased);
    }
  const auto raw = std::as_bytes(std::span(bytes));
  return {raw.begin(), raw.end()};
}

}  // namespace shlight

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "shlight/image/chromaticities.h"
#include "shlight/image/picture_reader.h"

namespace shlight {
namespace {

struct OpenPicture {
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
  std::unique_ptr<OIIO::ImageInput> input;
  int part = 0;
  OIIO::ImageSpec spec;  // of the part
};

OpenPicture open_picture(const PictureSource& source) {
  without_library_threads();
  OpenPicture picture;
  OIIO::ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);  // colours as the file has them
  if (!source.bytes.empty()) {
    picture.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<std::byte*>(source.bytes.data()),
                                                                     source.bytes.size());
    OIIO::Filesystem::IOProxy* proxy = picture.memory.get();
    wish.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  }
  // OpenImageIO 2.4 opens DDS files in memory twice while it looks for their format, without going back to their start.
  const std::string_view bytes(reinterpret_cast<const char*>(source.bytes.data()), source.bytes.size());
  if (bytes.starts_with("DDS ")) {
    picture.input = OIIO::ImageInput::create("dds");
    if (!picture.input || !picture.input->open(source.name, picture.spec, wish))
      throw malformed_picture(source.name, picture.input ? picture.input->geterror() : "");
    return picture;
  }
  picture.input = OIIO::ImageInput::open(source.name, &wish, picture.memory.get());
  if (!picture.input) throw malformed_picture(source.name, OIIO::geterror());
  picture.spec = picture.input->spec();
  return picture;
}

void check_spec(const PictureSource& source, const OIIO::ImageSpec& spec, std::uint64_t max_pixels) {
  if (spec.deep) throw Error(source.name, "is a deep picture", "one sample a pixel");
  if (spec.depth > 1) throw Error(source.name, "is a volume", "a picture of one slice");
  if (spec.nchannels <= 0) throw Error(source.name, "has no channels", kAcceptedPictures);
  check_picture_size(source.name, spec.width, spec.height, max_pixels);
}

// The channels to take for red, green and blue.
using Colours = std::array<int, 3>;

std::optional<int> find_channel(const OIIO::ImageSpec& spec, const std::string& name) {
  const auto at = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
  if (at == spec.channelnames.end()) return {};
  return static_cast<int>(at - spec.channelnames.begin());
}

std::optional<Colours> find_rgb(const OIIO::ImageSpec& spec, const std::string& layer = "") {
  const auto r = find_channel(spec, layer + "R"), g = find_channel(spec, layer + "G"),
             b = find_channel(spec, layer + "B");
  if (!r || !g || !b) return {};
  return Colours{*r, *g, *b};
}

// Those of these names, else the first three, else the first for all.
Colours find_colours(const OIIO::ImageSpec& spec) {
  if (const auto rgb = find_rgb(spec)) return *rgb;
  return spec.nchannels >= 3 ? Colours{0, 1, 2} : Colours{0, 0, 0};
}

// Of an OpenEXR part, the colours of one of three kinds: R, G and B; Y without chroma; R, G and B of a layer. Only
// numbers that can be radiance.
enum class ExrColours { kRgb, kGrey, kLayer };

std::optional<Colours> find_exr_colours(const OIIO::ImageSpec& spec, ExrColours kind) {
  std::optional<Colours> colours;
  if (kind == ExrColours::kRgb) {
    colours = find_rgb(spec);
  } else if (kind == ExrColours::kGrey) {
    const auto y = find_channel(spec, "Y");
    if (y && !find_channel(spec, "RY") && !find_channel(spec, "BY")) colours = {*y, *y, *y};
  } else {
    for (const std::string& name : spec.channelnames)
      if (name.ends_with(".R") && !colours) colours = find_rgb(spec, name.substr(0, name.size() - 1));
  }
  if (colours)
    for (const int channel : *colours)
      if (!spec.channelformat(channel).is_floating_point()) return {};
  return colours;
}

// Moves to the first part with colours, preferring the kinds in their sequence, and says so where there was a choice.
Colours choose_exr_part(const PictureSource& source, OpenPicture& picture, std::vector<std::string>& warnings) {
  bool deep = false;
  for (const ExrColours kind : {ExrColours::kRgb, ExrColours::kGrey, ExrColours::kLayer})
    for (int part = 0; picture.input->seek_subimage(part, 0); ++part) {
      const OIIO::ImageSpec& spec = picture.input->spec();
      deep = deep || spec.deep;
      const auto colours = find_exr_colours(spec, kind);
      if (!colours || spec.deep) continue;
      picture.part = part;
      picture.spec = spec;
      const int parts = spec.get_int_attribute("oiio:subimages", 1);
      if (parts > 1) warnings.push_back(fmt::format("has {} parts, of which number {} is taken", parts, part + 1));
      if (kind == ExrColours::kLayer) {
        const std::string& name = spec.channelnames[static_cast<std::size_t>((*colours)[0])];
        warnings.push_back(fmt::format("the colours of its layer '{}' are taken", name.substr(0, name.size() - 2)));
      }
      return *colours;
    }
  picture.input->geterror();  // of seeking beyond the last part
  if (deep) throw Error(source.name, "is a deep picture", "one sample a pixel");
  std::string names;
  for (const std::string& name : picture.spec.channelnames) names += (names.empty() ? "" : ", ") + name;
  if (names.size() > 80) names = names.substr(0, 80) + " …";
  throw Error(source.name, "has the channels " + names, "float or half channels R, G and B, or Y alone");
}

// A rectangle of pixels, ends exclusive; 64 bits, for sums of what headers say.
struct Window {
  std::int64_t x0, y0, x1, y1;
  bool operator==(const Window&) const = default;
};

Window data_window(const OIIO::ImageSpec& spec) {
  return {spec.x, spec.y, std::int64_t{spec.x} + spec.width, std::int64_t{spec.y} + spec.height};
}
Window display_window(const OIIO::ImageSpec& spec) {
  return {spec.full_x, spec.full_y, std::int64_t{spec.full_x} + spec.full_width,
          std::int64_t{spec.full_y} + spec.full_height};
}

// The picture is what its display window shows: black where it has no data, without what lies outside.
Image place_in_display_window(const PictureSource& source, Image data, const OIIO::ImageSpec& spec,
                              std::uint64_t max_pixels, std::vector<std::string>& warnings) {
  const Window from = data_window(spec), to = display_window(spec);
  if (from == to) return data;
  check_picture_size(source.name, to.x1 - to.x0, to.y1 - to.y0, max_pixels);
  const Window both = {std::max(from.x0, to.x0), std::max(from.y0, to.y0), std::min(from.x1, to.x1),
                       std::min(from.y1, to.y1)};
  if (both.x0 >= both.x1 || both.y0 >= both.y1)
    throw Error(source.name, "has no pixels within its display window", "windows that overlap");
  Image image(static_cast<int>(to.x1 - to.x0), static_cast<int>(to.y1 - to.y0));
  for (std::int64_t y = both.y0; y < both.y1; ++y)
    for (std::int64_t x = both.x0; x < both.x1; ++x)
      image.set_rgb(static_cast<int>(x - to.x0), static_cast<int>(y - to.y0),
                    data.rgb(static_cast<int>(x - from.x0), static_cast<int>(y - from.y0)));
  const auto shown = static_cast<std::uint64_t>((both.x1 - both.x0) * (both.y1 - both.y0));
  if (shown < image.num_pixels())
    warnings.push_back(
        fmt::format("{} pixels of its display window have no data, taken as black", image.num_pixels() - shown));
  if (shown < data.num_pixels())
    warnings.push_back(fmt::format("{} pixels outside of its display window are left out", data.num_pixels() - shown));
  return image;
}

// The environment map that an OpenEXR header says the picture is.
std::optional<Layout> stated_layout(const PictureSource& source, const OIIO::ImageSpec& spec) {
  const std::string_view format = spec.get_string_attribute("textureformat");
  if (format == "LatLong Environment") return Layout::kOpenExrLatLong;
  if (format != "CubeFace Environment") return {};
  if (std::int64_t{spec.height} != 6 * std::int64_t{spec.width})
    throw Error(source.name, fmt::format("says it is a cube map, but has {} x {} pixels", spec.width, spec.height),
                "six square faces above each other");
  return Layout::kOpenExrCube;
}

void convert_to_rec709(const OIIO::ImageSpec& spec, LoadedImage& loaded) {
  const auto* attribute = spec.find_attribute("chromaticities");
  if (!attribute || attribute->type().basetype != OIIO::TypeDesc::FLOAT || attribute->type().basevalues() != 8) return;
  const auto* c = static_cast<const float*>(attribute->data());
  const auto matrix = rec709_from({{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}, {c[6], c[7]}});
  if (!matrix)
    loaded.warnings.push_back("its chromaticities make no colour space, ignored: taken as Rec. 709");
  else if (!is_nearly_identity(*matrix))
    convert_colours(*matrix, loaded.image);
}

}  // namespace

void without_library_threads() {
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
}

LoadedImage read_by_library(const PictureSource& source, std::uint64_t max_pixels) {
  OpenPicture picture = open_picture(source);
  const bool exr = std::string_view(picture.input->format_name()) == "openexr";
  LoadedImage loaded;
  const Colours colours = exr ? choose_exr_part(source, picture, loaded.warnings) : find_colours(picture.spec);
  const OIIO::ImageSpec& spec = picture.spec;
  check_spec(source, spec, max_pixels);

  loaded.image = Image(spec.width, spec.height);
  float* values = loaded.image.values.data();
  const auto read = [&](int first, int end, float* to) {
    if (!picture.input->read_image(picture.part, 0, first, end, OIIO::TypeFloat, to, 3 * sizeof(float)))
      throw malformed_picture(source.name, picture.input->geterror());
  };
  if (colours[1] == colours[0] + 1 && colours[2] == colours[0] + 2) {
    read(colours[0], colours[0] + 3, values);
  } else {
    read(colours[0], colours[0] + 1, values);
    for (const std::size_t c : {std::size_t{1}, std::size_t{2}})
      if (colours[c] != colours[0])
        read(colours[c], colours[c] + 1, values + c);
      else
        for (std::size_t i = 0; i < loaded.image.values.size(); i += 3) values[i + c] = values[i];
  }
  if (!spec.format.is_floating_point())
    for (float& value : loaded.image.values) value = linear_from_srgb(value);
  if (!exr) return loaded;

  convert_to_rec709(spec, loaded);
  loaded.layout = stated_layout(source, spec);
  if (!loaded.layout)
    loaded.image = place_in_display_window(source, std::move(loaded.image), spec, max_pixels, loaded.warnings);
  return loaded;
}

Image8 read8_by_library(const PictureSource& source, std::uint64_t max_pixels) {
  OpenPicture picture = open_picture(source);
  const OIIO::ImageSpec& spec = picture.spec;
  check_spec(source, spec, max_pixels);
  const std::size_t pixels = spec.image_pixels(), channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<unsigned char> all(channels * pixels);
  if (!picture.input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, all.data()))
    throw malformed_picture(source.name, picture.input->geterror());

  Image8 image = {spec.width, spec.height, std::vector<unsigned char>(4 * pixels)};
  const auto [r, g, b] = find_colours(spec);
  const int alpha = spec.alpha_channel;
  for (std::size_t i = 0; i < pixels; ++i) {
    const unsigned char* from = all.data() + i * channels;
    unsigned char* to = image.values.data() + 4 * i;
    to[0] = from[r], to[1] = from[g], to[2] = from[b];
    to[3] = alpha >= 0 ? from[alpha] : 255;
  }
  return image;
}

}  // namespace shlight

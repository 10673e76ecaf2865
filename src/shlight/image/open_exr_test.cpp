// OpenEXR files as other programs write them, made by OpenImageIO.

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/core/temporary_folder.h"
#include "shlight/image/image_io.h"

namespace shlight {
namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

class OpenExr : public testing::Test {
 protected:
  std::string path(const std::string& name = "a.exr") const { return (folder_ / name).string(); }

  // Channel c of pixel (x, y), counted from the data window's corner.
  static float value(int part, int c, int x, int y) { return static_cast<float>(100 * part + c + 4 * x + 0.25 * y); }

  // Parts with these specifications, each level as large as its own.
  void write(std::vector<ImageSpec> parts) const {
    const auto output = OIIO::ImageOutput::create(path());
    ASSERT_TRUE(output);
    ASSERT_TRUE(output->open(path(), static_cast<int>(parts.size()), parts.data())) << output->geterror();
    for (std::size_t part = 0; part < parts.size(); ++part) {
      const bool open = part == 0 || output->open(path(), parts[part], OIIO::ImageOutput::AppendSubimage);
      ASSERT_TRUE(open) << output->geterror();
      write_pixels(*output, parts[part], static_cast<int>(part));
    }
    ASSERT_TRUE(output->close()) << output->geterror();
  }
  static void write_pixels(OIIO::ImageOutput& output, const ImageSpec& spec, int part) {
    std::vector<float> values;
    for (int y = 0; y < spec.height; ++y)
      for (int x = 0; x < spec.width; ++x)
        for (int c = 0; c < spec.nchannels; ++c) values.push_back(value(part, c, x, y));
    ASSERT_TRUE(output.write_image(TypeDesc::FLOAT, values.data())) << output.geterror();
  }

  static ImageSpec spec(int width, int height, std::vector<std::string> channels, TypeDesc type = TypeDesc::FLOAT) {
    ImageSpec result(width, height, static_cast<int>(channels.size()), type);
    result.channelnames = std::move(channels);
    result.attribute("compression", "none");
    return result;
  }

  std::string error() const {
    try {
      load_image(path());
    } catch (const Error& error) {
      const std::string text = error.what();
      EXPECT_TRUE(text.starts_with(path() + ": ")) << text;
      return text.substr(path().size() + 2);
    }
    return "no error";
  }
  // Warnings as one text.
  static std::string warnings(const LoadedImage& loaded) {
    std::string text;
    for (const std::string& warning : loaded.warnings) text += warning + ";";
    return text;
  }
  // Expects part `part`'s channels `r` and following as the picture's colours.
  static void expect_colours(const Image& image, int part, int r, int g, int b) {
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        ASSERT_EQ(image.rgb(x, y), (Rgb{value(part, r, x, y), value(part, g, x, y), value(part, b, x, y)}))
            << x << " " << y;
  }

  TemporaryFolder folder_;
};

TEST_F(OpenExr, HalfFloatAndTilesAreTheSame) {
  for (const TypeDesc type : {TypeDesc::HALF, TypeDesc::FLOAT})
    for (const int tile : {0, 16}) {
      ImageSpec s = spec(40, 20, {"R", "G", "B", "A"}, type);
      s.tile_width = s.tile_height = tile;
      write({s});
      const LoadedImage loaded = load_image(path());
      expect_colours(loaded.image, 0, 0, 1, 2);
      EXPECT_EQ(warnings(loaded), "");
      EXPECT_FALSE(loaded.layout);
    }
}

TEST_F(OpenExr, LevelZeroIsTaken) {
  const auto output = OIIO::ImageOutput::create(path());
  for (int level = 0, size = 16; size > 0; ++level, size /= 2) {
    ImageSpec s = spec(size, size, {"R", "G", "B"});
    s.tile_width = s.tile_height = 16;
    s.attribute("textureformat", "Plain Texture");
    ASSERT_TRUE(output->open(path(), s, level == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendMIPLevel));
    write_pixels(*output, s, level);
  }
  ASSERT_TRUE(output->close());
  const Image image = load_image(path()).image;
  EXPECT_EQ(image.width, 16);
  expect_colours(image, 0, 0, 1, 2);
}

TEST_F(OpenExr, ChannelsByName) {
  write({spec(3, 2, {"Y"})});
  expect_colours(load_image(path()).image, 0, 0, 0, 0);
  write({spec(3, 2, {"R", "G", "B", "A", "Z"})});
  expect_colours(load_image(path()).image, 0, 0, 1, 2);
  write({spec(3, 2, {"A", "sky.R", "sky.G", "sky.B"})});
  const LoadedImage layer = load_image(path());
  EXPECT_EQ(warnings(layer), "the colours of its layer 'sky' are taken;");
  expect_colours(layer.image, 0, 1, 2, 3);
  // Depth, a normal or one colour is no light.
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"Z"}, {"N.X", "N.Y", "N.Z"}, {"R"}, {"R", "G"}, {"A"}, {"Y", "RY", "BY"}}) {
    write({spec(3, 2, names)});
    EXPECT_NE(error().find("has the channels "), std::string::npos) << names[0];
  }
  write({spec(3, 2, {"R", "G", "B"}, TypeDesc::UINT)});
  EXPECT_EQ(error(), "has the channels R, G, B: float or half channels R, G and B, or Y alone");
}

TEST_F(OpenExr, TheFirstPartWithColours) {
  ImageSpec depth = spec(4, 3, {"Z"}), grey = spec(4, 3, {"Y"}), first = spec(4, 3, {"R", "G", "B"}), second = first;
  depth.attribute("oiio:subimagename", "depth"), grey.attribute("oiio:subimagename", "grey");
  first.attribute("oiio:subimagename", "first"), second.attribute("oiio:subimagename", "second");
  write({depth, grey, first, second});
  const LoadedImage loaded = load_image(path());
  expect_colours(loaded.image, 2, 0, 1, 2);
  EXPECT_EQ(warnings(loaded), "has 4 parts, of which number 3 is taken;");
  write({depth, grey});
  expect_colours(load_image(path()).image, 1, 0, 0, 0);
}

TEST_F(OpenExr, TheDisplayWindowIsThePicture) {
  ImageSpec s = spec(4, 3, {"R", "G", "B"});
  s.x = 10, s.y = -20;
  const auto set_display = [&](int x, int y, int width, int height) {
    s.full_x = x, s.full_y = y, s.full_width = width, s.full_height = height;
    write({s});
  };
  set_display(10, -20, 4, 3);
  expect_colours(load_image(path()).image, 0, 0, 1, 2);

  set_display(8, -21, 8, 5);  // larger on all sides
  const LoadedImage larger = load_image(path());
  EXPECT_EQ(larger.image.width, 8);
  EXPECT_EQ(larger.image.height, 5);
  EXPECT_EQ(warnings(larger), "28 pixels of its display window have no data, taken as black;");
  EXPECT_EQ(larger.image.rgb(0, 0), Rgb{});
  EXPECT_EQ(larger.image.rgb(2, 1), (Rgb{value(0, 0, 0, 0), value(0, 1, 0, 0), value(0, 2, 0, 0)}));
  EXPECT_EQ(larger.image.rgb(5, 3), (Rgb{value(0, 0, 3, 2), value(0, 1, 3, 2), value(0, 2, 3, 2)}));
  EXPECT_EQ(larger.image.rgb(6, 3), Rgb{});

  set_display(11, -19, 2, 1);  // smaller on all sides
  const LoadedImage smaller = load_image(path());
  EXPECT_EQ(smaller.image.height, 1);
  EXPECT_EQ(smaller.image.rgb(1, 0), (Rgb{value(0, 0, 2, 1), value(0, 1, 2, 1), value(0, 2, 2, 1)}));
  EXPECT_EQ(warnings(smaller), "10 pixels outside of its display window are left out;");

  set_display(14, -20, 4, 3);
  EXPECT_EQ(error(), "has no pixels within its display window: windows that overlap");
  set_display(0, -20, 40000, 40000);
  EXPECT_NE(error().find("has 40000 x 40000 pixels: at most"), std::string::npos);
}

TEST_F(OpenExr, EnvironmentMapsAreWholeAndSaySo) {
  ImageSpec s = spec(8, 4, {"R", "G", "B"});
  s.x = 3, s.y = 5, s.full_width = 2, s.full_height = 2;
  s.attribute("textureformat", "LatLong Environment");
  write({s});
  const LoadedImage lat_long = load_image(path());
  EXPECT_EQ(lat_long.layout, Layout::kOpenExrLatLong);
  expect_colours(lat_long.image, 0, 0, 1, 2);

  s = spec(2, 12, {"R", "G", "B"});
  s.attribute("textureformat", "CubeFace Environment");
  write({s});
  const LoadedImage cube = load_image(path());
  EXPECT_EQ(cube.layout, Layout::kOpenExrCube);
  expect_colours(cube.image, 0, 0, 1, 2);
  s.height = s.full_height = 11;
  write({s});
  EXPECT_EQ(error(), "says it is a cube map, but has 2 x 11 pixels: six square faces above each other");
}

TEST_F(OpenExr, SavedLayoutsComeBack) {
  for (const auto& [layout, height] : {std::pair{Layout::kOpenExrLatLong, 6}, {Layout::kOpenExrCube, 72}}) {
    Image image(12, height);
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>(i % 1000);
    save_image(path(), image, layout);
    const LoadedImage loaded = load_image(path());
    EXPECT_EQ(loaded.layout, layout);
    EXPECT_EQ(loaded.image.values, image.values);
    save_image(path(), image, Layout::kLatLong);
    EXPECT_FALSE(load_image(path()).layout);
  }
}

TEST_F(OpenExr, ChromaticitiesAreConverted) {
  ImageSpec s = spec(3, 2, {"R", "G", "B"});
  const auto with = [&](std::array<float, 8> chromaticities) {
    s.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), chromaticities.data());
    write({s});
    return load_image(path());
  };
  // Rec. 709, and the same adapted to D50.
  for (const std::array<float, 8>& ours :
       {std::array<float, 8>{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f},
        {0.648447f, 0.330877f, 0.321187f, 0.597894f, 0.155901f, 0.0660563f, 0.345708f, 0.358541f}}) {
    const LoadedImage loaded = with(ours);
    expect_colours(loaded.image, 0, 0, 1, 2);
    EXPECT_EQ(warnings(loaded), "");
  }
  const LoadedImage wide = with({0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f});
  const Rgb from = {value(0, 0, 2, 1), value(0, 1, 2, 1), value(0, 2, 2, 1)};
  EXPECT_NEAR(wide.image.rgb(2, 1).r, 1.6605 * from.r - 0.5876 * from.g - 0.0728 * from.b, 2e-3);
  EXPECT_NEAR(wide.image.rgb(2, 1).b, -0.0182 * from.r - 0.1006 * from.g + 1.1187 * from.b, 2e-3);
  const LoadedImage nonsense = with({0, 0, 0, 0, 0, 0, 0, 0});
  expect_colours(nonsense.image, 0, 0, 1, 2);
  EXPECT_EQ(warnings(nonsense), "its chromaticities make no colour space, ignored: taken as Rec. 709;");
}

TEST_F(OpenExr, DeepPicturesAreRefused) {
  ImageSpec s = spec(2, 2, {"R", "G", "B", "A", "Z"});
  s.deep = true;
  const auto output = OIIO::ImageOutput::create(path());
  ASSERT_TRUE(output->open(path(), s));
  OIIO::DeepData deep(s);
  for (int pixel = 0; pixel < 4; ++pixel) deep.set_samples(pixel, 2);
  ASSERT_TRUE(output->write_deep_image(deep));
  ASSERT_TRUE(output->close());
  EXPECT_EQ(error(), "is a deep picture: one sample a pixel");
}

// A header by hand, which OpenImageIO would not write: luminance, and chroma at half the resolution.
TEST_F(OpenExr, SubsampledChromaIsRefused) {
  std::string file("\x76\x2f\x31\x01\x02\0\0\0", 8);
  const auto attribute = [&](const std::string& name, const std::string& type, const std::string& data) {
    const auto size = static_cast<std::uint32_t>(data.size());
    file += name + '\0' + type + '\0' + std::string(reinterpret_cast<const char*>(&size), 4) + data;
  };
  const auto words = [](std::initializer_list<std::int32_t> list) {
    return std::string(reinterpret_cast<const char*>(list.begin()), 4 * list.size());
  };
  std::string channels;
  for (const auto& [name, sampling] : {std::pair{"BY", 2}, {"RY", 2}, {"Y", 1}})
    channels += name + std::string(1, '\0') + words({1, 0, sampling, sampling});
  attribute("channels", "chlist", channels + '\0');
  attribute("compression", "compression", std::string(1, '\0'));
  attribute("dataWindow", "box2i", words({0, 0, 1, 1}));
  attribute("displayWindow", "box2i", words({0, 0, 1, 1}));
  attribute("lineOrder", "lineOrder", std::string(1, '\0'));
  attribute("pixelAspectRatio", "float", words({0x3f800000}));
  attribute("screenWindowCenter", "v2f", words({0, 0}));
  attribute("screenWindowWidth", "float", words({0x3f800000}));
  file += '\0';
  // Two rows: BY, RY and Y of two pixels, then Y alone.
  const auto first = static_cast<std::int32_t>(file.size()) + 16;
  file += words({first, 0, first + 16, 0}) + words({0, 8, 0, 0}) + words({1, 4, 0});
  write_file(path(), std::string_view(file));
  EXPECT_NE(error().find("Subsampled channels are not supported"), std::string::npos) << error();
}

// Every second byte, one after the other, made large or negative.
TEST_F(OpenExr, HeadersThatLieAreReadOrRefused) {
  ImageSpec s = spec(3, 2, {"R", "G", "B"});
  write({s});
  const auto good = read_file(path(), 1 << 20);
  LoadImageParams params;
  params.max_pixels = 1 << 20;
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); at += 2) {
    auto bytes = good;
    bytes[at] = at % 4 ? std::byte{0xff} : bytes[at] ^ std::byte{0x80};
    write_file(path("bad.exr"), std::span<const std::byte>(bytes));
    try {
      const Image image = load_image(path("bad.exr"), params).image;
      EXPECT_LE(image.num_pixels(), params.max_pixels);
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 25);
}

}  // namespace
}  // namespace shlight

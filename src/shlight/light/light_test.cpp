#include "shlight/light/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "shlight/core/error.h"
#include "shlight/core/temporary_folder.h"
#include "shlight/image/cube_files.h"
#include "shlight/image/pixels.h"
#include "shlight/light/builtin_light.h"
#include "shlight/light/coefficient_file.h"
#include "shlight/sh/basis.h"
#include "shlight/sh/zonal.h"

namespace shlight {
namespace {

TEST(LoadLight, TheSameLightFromEveryLayout) {
  const auto axes = make_axes_light();
  const RgbCoefficients exact = axes->project(5);
  for (const Layout layout : all_layouts()) {
    const TemporaryFolder folder;
    const auto size = size_from_horizon(layout, 512);
    Environment environment = {axes->picture({layout, size}), layout};
    // What lies beside the light must not count.
    const PixelQuadrature pixels(layout, environment.size(), 1);
    for (int y = 0; y < environment.image.height; ++y)
      for (int x = 0; x < environment.image.width; ++x)
        if (!pixels.covers({x, y})) environment.image.set_rgb(x, y, {1000, 1000, 1000});
    const std::string name(layout_name(layout));
    const std::filesystem::path path = folder / (name + ".exr");
    LoadLightParams params;
    if (layout == Layout::kCube) {
      const auto faces = split_cube(environment.image);
      const CubeFiles files = cube_files_for(path);
      for (std::size_t i = 0; i < 6; ++i) save_image(files[i], faces[i]);
    } else {
      save_image(path, environment.image);
      params.layout = layout;
    }
    const auto [light, info] = load_light(layout == Layout::kCube ? (folder / "").string() : path.string(), params);
    EXPECT_EQ(info.layout, layout);
    EXPECT_NEAR(info.pixels.max, 6.04, 0.01);
    const RgbCoefficients c = light->project(5);
    for (std::size_t i = 0; i < c.size(); ++i) {
      EXPECT_NEAR(c[i].r, exact[i].r, 2e-3 * exact[0].r) << name << " " << i;
      EXPECT_NEAR(c[i].g, exact[i].g, 2e-3 * exact[0].g) << name << " " << i;
      EXPECT_NEAR(c[i].b, exact[i].b, 2e-3 * exact[0].b) << name << " " << i;
    }
    EXPECT_NEAR(light->radiance({1, 0, 0}).r, 6.04, 1e-2);
    const Image picture = light->lat_long(512);
    EXPECT_NEAR(picture.rgb(384, 128).r, 6.04, 1e-2);  // +X is three quarters to the right
  }
}

TEST(LoadLight, CoefficientFilesAreLights) {
  const TemporaryFolder folder;
  RgbCoefficients c(3);
  add_delta({0, 1, 0}, {1, 2, 3}, c);
  save_coefficients(folder / "a.json", c);
  const auto [light, info] = load_light((folder / "a.json").string());
  EXPECT_EQ(info.kind, LightInfo::Kind::kCoefficients);
  EXPECT_EQ(info.bands, 3);
  EXPECT_EQ(light->project(3), c);
  EXPECT_EQ(light->project(5), resize_bands(c, 5));
  EXPECT_NEAR(light->radiance({0, 1, 0}).g, 2 * 9 / (4 * 3.141592653589793), 1e-12);
}

// A file with a sun is both of its parts at any number of bands, and shows the sun in the sky.
TEST(LoadLight, CoefficientFilesWithASunAreBoth) {
  const TemporaryFolder folder;
  const auto sky = make_sky_light({});
  const auto split = sky->split_sun();
  ASSERT_TRUE(split);
  save_coefficients(folder / "a.json", split->rest->project(3), split->sun);
  const auto light = load_light((folder / "a.json").string()).light;
  const RgbCoefficients exact = sky->project(3), both = light->project(3);
  // A delta light for a disc of 0.27°.
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_NEAR(both[i].g, exact[i].g, 1e-4 * exact[0].g) << i;
  EXPECT_EQ(resize_bands(light->project(8), 3), both);
  EXPECT_GT(std::abs(light->project(8).at(7, 0).g), 0.01);
  const Vec3d d = split->sun.direction;
  EXPECT_NEAR(light->radiance(d).g / sky->radiance(d).g, 1, 1e-3);
  const auto again = light->split_sun();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->sun.irradiance, split->sun.irradiance);
  EXPECT_EQ(again->rest->project(3), split->rest->project(3));
}

TEST(LoadLight, PixelsThatAreNotFiniteAreReportedAndTakenAsZero) {
  const TemporaryFolder folder;
  Image image(64, 32);
  for (float& value : image.values) value = 1;
  Image repaired = image;
  image.set_rgb(5, 6, {NAN, 1, 1});
  repaired.set_rgb(5, 6, {0, 1, 1});
  save_image(folder / "a.exr", image);
  save_image(folder / "b.exr", repaired);
  const auto a = load_light((folder / "a.exr").string()), b = load_light((folder / "b.exr").string());
  EXPECT_EQ(a.info.pixels.nan, 1u);
  EXPECT_EQ(a.info.pixels.first_nan->x, 5);
  EXPECT_EQ(a.light->project(3), b.light->project(3));
}

TEST(LoadLight, AShapeThatTellsNothingNeedsALayout) {
  const TemporaryFolder folder;
  save_image(folder / "a.exr", Image(100, 40));
  EXPECT_THROW(load_light((folder / "a.exr").string()), Error);
  LoadLightParams params;
  params.layout = Layout::kLatLong;
  EXPECT_EQ(load_light((folder / "a.exr").string(), params).info.layout, Layout::kLatLong);
}

// A constant light clamped to half loses half, whatever the layout, and only pictures can be clamped.
TEST(LoadLight, ClampedPictures) {
  const TemporaryFolder folder;
  LoadLightParams params;
  params.clamp = 2;
  for (const Layout layout : {Layout::kLatLong, Layout::kCube, Layout::kOpenExrCube}) {
    const auto [width, height] = picture_size(layout, size_from_horizon(layout, 64));
    Image image(width, height);
    for (float& value : image.values) value = 4;
    image.set_rgb(1, 1, {4, NAN, -4});
    save_image(folder / "a.exr", image, layout);
    params.layout = layout;
    const auto [light, info] = load_light((folder / "a.exr").string(), params);
    EXPECT_EQ(info.clamp->above, image.num_pixels());
    EXPECT_EQ(info.clamp->negative, 1u);
    EXPECT_NEAR(info.clamp->lost_share(), 0.5, 2e-3);
    EXPECT_NEAR(info.clamp->lost.r, 8 * 3.141592653589793, 1e-5);
    EXPECT_EQ(info.pixels.nan, 1u);
    EXPECT_NEAR(light->project(1)[0].r, 2 * std::sqrt(4 * 3.141592653589793), 1e-5);
  }
  params.layout.reset();
  for (const char* other : {"builtin:sky", "fn:1 + y", "nothing.json"}) EXPECT_THROW(load_light(other, params), Error);
}

// What a file states comes before what its shape suggests, and after what was asked for.
TEST(LoadLight, FilesThatStateTheirLayout) {
  const TemporaryFolder folder;
  save_image(folder / "a.exr", Image(64, 32), Layout::kOpenExrLatLong);
  EXPECT_EQ(load_light((folder / "a.exr").string()).info.layout, Layout::kOpenExrLatLong);
  LoadLightParams params;
  params.layout = Layout::kLatLong;
  EXPECT_EQ(load_light((folder / "a.exr").string(), params).info.layout, Layout::kLatLong);
}

// The nine coefficients published for ten classic probes light as their polynomial does.
TEST(LoadLight, PublishedTables) {
  const char* data = std::getenv("SHLIGHT_TEST_DATA");
  if (!data) GTEST_SKIP() << "SHLIGHT_TEST_DATA names no folder";
  std::ifstream file(std::string(data) + "/references/published_tables.json");
  const auto root = nlohmann::json::parse(file);
  const TemporaryFolder folder;
  int tables = 0;
  for (const auto& [name, table] : root["tables"].items()) {
    // Their sequence is L00, L1−1, L10, L11, L2−2 …: ours.
    ASSERT_EQ(root["order"][8], "L22");
    RgbCoefficients c(3);
    for (std::size_t i = 0; i < 9; ++i) c[i] = {table[i][0], table[i][1], table[i][2]};
    save_coefficients(folder / "probe.json", c);
    const RgbCoefficients back = load_light((folder / "probe.json").string()).light->project(3);
    for (const Vec3d n : make_sphere_samples(0, 6, 1).directions) {
      const Rgb difference = eval_irradiance_polynomial(back, n) - reconstruct(irradiance_from_radiance(c), n);
      EXPECT_NEAR(difference.g, 0, 1e-12) << name;
    }
    // All were taken with the sky up.
    EXPECT_GT(luminance(eval_irradiance_polynomial(back, {0, 1, 0})), 0) << name;
    ++tables;
  }
  EXPECT_EQ(tables, 10);
}

}  // namespace
}  // namespace shlight

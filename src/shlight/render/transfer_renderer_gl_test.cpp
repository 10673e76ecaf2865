#include "shlight/render/transfer_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "shlight/render/matrices.h"
#include "shlight/render/render.h"
#include "shlight/render/render_test_util.h"
#include "shlight/render/sh_glsl.h"
#include "shlight/render/targets.h"
#include "shlight/sh/rotation.h"
#include "shlight/transfer/clustered_pca.h"
#include "shlight/transfer/quantise.h"

namespace shlight {
namespace {

using std::numbers::pi;

constexpr int kSize = 65;
constexpr double kHalfPrecision = 1.0 / 1024;

// Transfer of a scene with the coefficients that `coefficient` gives: of vertex v, channel c, index i.
Transfer make_test_transfer(const Scene& scene, int bands, int channels,
                            const std::function<double(std::size_t, int, int)>& coefficient) {
  Transfer transfer;
  transfer.bands = bands;
  transfer.channels = channels;
  transfer.first_vertex = {0};
  for (const Instance& instance : scene.instances)
    transfer.first_vertex.push_back(transfer.first_vertex.back() + scene.meshes[instance.mesh].positions.size());
  const std::size_t vertices = transfer.first_vertex.back();
  for (std::size_t v = 0; v < vertices; ++v)
    for (int c = 0; c < channels; ++c)
      for (int i = 0; i < num_coefficients(bands); ++i)
        transfer.coefficients.push_back(static_cast<float>(coefficient(v, c, i)));
  transfer.ambient_occlusion.assign(vertices, 1);
  transfer.bent_normals.assign(vertices, {0, 1, 0});
  return transfer;
}

// Transfer whose radiance under a light of 1 from everywhere is `radiance` at each vertex.
Transfer make_constant_transfer(const Scene& scene, const std::function<double(std::size_t)>& radiance) {
  return make_test_transfer(scene, 1, 1, [&](std::size_t v, int, int) { return radiance(v) / std::sqrt(4 * pi); });
}

Transfer bake_cosine(const Scene& scene, int bands) {
  BakeParams params;
  params.kind = TransferKind::kCosine;
  params.bands = bands;
  return bake_transfer(scene, params);
}

// Σ L_i A_i of a vertex in double; further bands of either do not count.
Rgb lit(const Transfer& transfer, std::size_t vertex, const RgbCoefficients& light) {
  const auto stride = static_cast<std::size_t>(num_coefficients(transfer.bands));
  const auto channels = static_cast<std::size_t>(transfer.channels);
  const auto a = [&](std::size_t c, std::size_t i) {
    return double{transfer.coefficients[(vertex * channels + c % channels) * stride + i]};
  };
  Rgb sum;
  for (std::size_t i = 0; i < std::min(stride, light.size()); ++i)
    sum += Rgb{light[i].r * a(0, i), light[i].g * a(1, i), light[i].b * a(2, i)};
  return sum;
}

RgbCoefficients random_light(int bands) {
  std::mt19937 random(7u + static_cast<unsigned>(bands));
  std::uniform_real_distribution<double> value(-1, 1);
  RgbCoefficients light(bands);
  for (Rgb& c : light.values()) c = {value(random), value(random), value(random)};
  return light;
}

RenderParams test_params(int bands, double azimuth = 0) {
  RenderParams params;
  params.width = params.height = kSize;
  params.bands = bands;
  params.camera = {azimuth, 0};
  params.show_background = false;
  return params;
}

Image draw(const Scene& scene, const Transfer& transfer, const RgbCoefficients& light, const RenderParams& params) {
  return render_transfer(scene, transfer, {light, {}}, params).radiance;
}

// The point of the plane z = 0 that a pixel of `params` shows, seen from the front.
Vec3d point_at(const Scene& scene, const RenderParams& params, int x, int y) {
  const View view = make_view(params.camera, scene_extent(scene), 1);
  const glm::dmat4 to_clip = to_glm(view.view_to_clip) * to_glm(view.world_to_view);
  const auto ndc = [&](double u, double v) {
    const glm::dvec4 p = to_clip * glm::dvec4(u, v, 0, 1);
    return glm::dvec2(p) / p.w;
  };
  const glm::dvec2 origin = ndc(0, 0), unit = ndc(1, 1) - origin;
  return {(2 * (x + 0.5) / params.width - 1 - origin.x) / unit.x,
          (1 - 2 * (y + 0.5) / params.height - origin.y) / unit.y, 0};
}

double max_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    largest = std::max(largest, static_cast<double>(std::abs(a.values[i] - b.values[i])));
  return largest;
}

void expect_near(Rgb actual, Rgb expected, double tolerance, const testing::Message& where) {
  EXPECT_NEAR(actual.r, expected.r, tolerance) << where;
  EXPECT_NEAR(actual.g, expected.g, tolerance) << where;
  EXPECT_NEAR(actual.b, expected.b, tolerance) << where;
}

class TransferRendererTest : public GlTest {
 protected:
  // render_transfer makes its own context.
  void SetUp() override {
    GlTest::SetUp();
    context_.reset();
  }

  const Scene square_ = make_test_scene(make_square());
  const Scene sphere_ = make_test_scene(make_ellipsoid({1, 1, 1}));
};

// Everywhere in both triangles of a square, whose vertices have random coefficients.
TEST_F(TransferRendererTest, PixelsAreTheSumInDoubleInterpolated) {
  const Vec3f base_color = {0.5f, 1, 0.25f};
  const Scene scene = make_test_scene(make_square(), base_color);
  for (const int channels : {1, 3})
    for (int bands = 1; bands <= kMaxGlslBands; ++bands) {
      std::mt19937 random(99);
      std::uniform_real_distribution<double> value(-1, 1);
      const Transfer transfer = make_test_transfer(scene, bands, channels, [&](auto...) { return value(random); });
      const RgbCoefficients light = random_light(bands);
      double largest = 0;
      for (std::size_t v = 0; v < 4; ++v) {
        const Rgb sum = lit(transfer, v, light);
        largest = std::max({largest, std::abs(sum.r), std::abs(sum.g), std::abs(sum.b)});
      }
      const RenderParams params = test_params(bands);
      const Image image = draw(scene, transfer, light, params);
      int pixels = 0;
      for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
          const Vec3d p = point_at(scene, params, x, y);
          // Not where edges and the diagonal are antialiased.
          if (std::max(std::abs(p.x), std::abs(p.y)) > 0.95 || std::abs(p.x - p.y) < 0.05) continue;
          const double u = (p.x + 1) / 2, v = (p.y + 1) / 2;
          const Rgb corner[] = {lit(transfer, 0, light), lit(transfer, 1, light), lit(transfer, 2, light),
                                lit(transfer, 3, light)};
          const Rgb sum = v < u ? (1 - u) * corner[0] + (u - v) * corner[1] + v * corner[2]
                                : (1 - v) * corner[0] + u * corner[2] + (v - u) * corner[3];
          const Rgb expected = {base_color.x * std::max(sum.r, 0.0), base_color.y * std::max(sum.g, 0.0),
                                base_color.z * std::max(sum.b, 0.0)};
          // Four samples a pixel lie off its centre where 0 is crossed.
          const double slack = 0.03 * (std::min({std::abs(sum.r), std::abs(sum.g), std::abs(sum.b)}) < 0.1 * largest);
          expect_near(image.rgb(x, y), expected, (2 * kHalfPrecision + slack) * largest,
                      testing::Message() << bands << " bands, " << channels << " channels, " << x << " " << y);
          ++pixels;
        }
      EXPECT_GT(pixels, 1000);
    }
}

// Expects both methods' pictures of the sphere to be the same but for the interpolation of radiance instead of normals,
// which is of second degree in the distance of vertices, 0.065: about 1e-3 of what varies. Pixels of the outline are
// another matter, since their centres may lie outside of the triangle that they show, which looks along the line of
// sight: a small step is a long way on it, and what is linear goes on where the normal's length is mended.
void expect_same_sphere(const Image& transfer, const Image& irradiance, const testing::Message& where) {
  constexpr double kTolerance = 5e-3, kMeanTolerance = 1e-3;
  double largest = 0, sum = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Rgb d = transfer.rgb(x, y) - irradiance.rgb(x, y);
      const double difference = std::max({std::abs(d.r), std::abs(d.g), std::abs(d.b)});
      sum += difference;
      if (std::hypot(x - kSize / 2, y - kSize / 2) < 0.44 * kSize) largest = std::max(largest, difference);
    }
  EXPECT_LT(largest, kTolerance) << where;
  EXPECT_LT(sum / (kSize * kSize), kMeanTolerance) << where;
}

// Cosine transfer is the irradiance of the vertex's normal.
TEST_F(TransferRendererTest, CosineTransferLooksLikeIrradiance) {
  for (const int bands : {1, 3, 5, 10}) {
    const Transfer transfer = bake_cosine(sphere_, bands);
    RgbCoefficients light = constant_light(bands, {0.5, 0.6, 0.7});
    light += delta_light(bands, {0.48, 0.64, 0.6}, {1, 2, 3});
    RenderParams params = test_params(bands, 30);
    params.show_background = true;
    const Image expected = render_irradiance(sphere_, {light, {}}, params).radiance;
    expect_same_sphere(draw(sphere_, transfer, light, params), expected, testing::Message() << bands);
  }
}

// White in constant light cannot be seen: A_0 = 1/√4π is all that such a light meets, whatever the other A_i are.
TEST_F(TransferRendererTest, WhiteFurnace) {
  for (const double radiance : {1.0, 1e-7, 1e7})
    for (const int bands : {1, 2, 5, 10})
      for (const int channels : {1, 3}) {
        const Transfer transfer = make_test_transfer(sphere_, bands, channels, [](std::size_t v, int, int i) {
          return i == 0 ? 1 / std::sqrt(4 * pi) : std::sin(static_cast<double>(v) + i);
        });
        RenderParams params = test_params(bands);
        params.show_background = true;
        const Image image = draw(sphere_, transfer, constant_light(bands, {radiance, radiance, radiance}), params);
        const auto [least, most] = std::minmax_element(image.values.begin(), image.values.end());
        EXPECT_NEAR(*least / radiance, 1, kHalfPrecision) << radiance << " " << bands << " " << channels;
        EXPECT_NEAR(*most / radiance, 1, kHalfPrecision) << radiance << " " << bands << " " << channels;
      }
}

// Meshes of different numbers of vertices, one of them twice, between which nothing is drawn.
TEST_F(TransferRendererTest, EveryInstanceTakesItsOwnTransfer) {
  Mesh triangle;
  triangle.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0, 0.5f, 0}};
  triangle.normals.assign(3, {0, 0, 1});
  triangle.indices = {0, 1, 2};
  Mesh unused = make_square();
  Scene scene = make_test_scene(make_square());
  scene.meshes = {make_square(), unused, triangle};
  const auto moved = [](float x, float scale) {
    return Mat4f{scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, x, 0, 0, 1};
  };
  scene.instances = {{2, moved(-3, 2)}, {0, moved(0, 1)}, {2, moved(3, 2)}};
  const Transfer transfer = make_constant_transfer(scene, [](std::size_t v) {
    return v < 3 ? 0.25 : v < 7 ? 0.5 : 0.75;
  });
  const RenderParams params = test_params(1);
  const Image image = draw(scene, transfer, constant_light(1, {1, 1, 1}), params);
  int pixels[3] = {};
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Vec3d p = point_at(scene, params, x, y);
      for (const int place : {-1, 0, 1})
        if (std::hypot(p.x - 3 * place, p.y + 0.3) < 0.25) {
          EXPECT_NEAR(image.rgb(x, y).g, 0.5 + 0.25 * place, kHalfPrecision) << x << " " << y;
          ++pixels[place + 1];
        }
    }
  for (const int count : pixels) EXPECT_GE(count, 4);
}

// Transfer that is linear over a fine grid gives a picture that is: no vertex is mistaken for another.
TEST_F(TransferRendererTest, VerticesMayBeMoreThanARow) {
  constexpr int kSide = 150;
  Mesh grid;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j)
      grid.positions.push_back(
          {2 * static_cast<float>(j) / (kSide - 1) - 1, 2 * static_cast<float>(i) / (kSide - 1) - 1, 0});
  grid.normals.assign(grid.positions.size(), {0, 0, 1});
  for (std::uint32_t i = 0; i + 1 < kSide; ++i)
    for (std::uint32_t j = 0; j + 1 < kSide; ++j) {
      const std::uint32_t a = i * kSide + j;
      for (const std::uint32_t index : {a, a + 1, a + kSide + 1, a, a + kSide + 1, a + kSide})
        grid.indices.push_back(index);
    }
  const Scene scene = make_test_scene(grid);
  const Transfer transfer = make_constant_transfer(scene, [&](std::size_t v) {
    const Vec3f p = grid.positions[v];
    return 0.5 + 0.3 * p.x + 0.15 * p.y;
  });
  const RenderParams params = test_params(1);
  const Image image = draw(scene, transfer, constant_light(1, {1, 1, 1}), params);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Vec3d p = point_at(scene, params, x, y);
      if (std::max(std::abs(p.x), std::abs(p.y)) > 0.95) continue;
      EXPECT_NEAR(image.rgb(x, y).g, 0.5 + 0.3 * p.x + 0.15 * p.y, kHalfPrecision) << x << " " << y;
    }
}

TEST_F(TransferRendererTest, TurningTheLightIsTurningItsCoefficients) {
  const RgbCoefficients light = delta_light(5, {0.48, 0.64, 0.6}, {1, 2, 3});
  const Transfer transfer = bake_cosine(sphere_, 5);
  for (const Rotation& rotation : {rotation_about_y(1.5), rotation_zyz(0.4, 2, -1)}) {
    RenderParams params = test_params(5);
    const Image still = draw(sphere_, transfer, light, params);
    const Image expected = draw(sphere_, transfer, rotate(rotation, light), params);
    params.rotate_light = rotation;
    const Image turned = draw(sphere_, transfer, light, params);
    EXPECT_LT(max_difference(turned, expected), kHalfPrecision);
    expect_same_sphere(turned, render_irradiance(sphere_, {light, {}}, params).radiance, {});
    EXPECT_GT(max_difference(still, expected), 0.1) << "the turn is seen";
  }
}

// What was compressed is drawn as it decodes on the processor, up to half floats' rounding: in 16 and 8 bits, and as
// clustered principal components, mono and coloured, with fewer bands than there are and with other bands of light.
TEST_F(TransferRendererTest, CompressedIsDrawnAsItDecodes) {
  constexpr int kBands = 5;
  for (const int channels : {1, 3}) {
    // Smooth enough for clusters, with a constant so that nothing is negative and cut off.
    const Transfer transfer = make_test_transfer(sphere_, kBands, channels, [](std::size_t v, int c, int i) {
      return i == 0 ? 2 + c : 0.2 * std::sin(0.01 * static_cast<double>(v) * (1 + i % 3) + c + i);
    });
    BakeInfo info;
    const auto expect_decoded = [&](const std::vector<float>& coefficients, const std::string& what) {
      Transfer decoded = transfer;
      decoded.coefficients = coefficients;
      EXPECT_NE(decoded.coefficients, transfer.coefficients) << what;
      for (const int bands : {2, 8}) {
        RgbCoefficients light = random_light(bands);
        light[0] = {3, 3, 3};
        RenderParams params = test_params(bands);
        params.rotate_light = rotation_zyz(0.4, 2, -1);
        const Image expected = draw(sphere_, decoded, light, params);
        const Image drawn = render_baked({sphere_, decoded, info}, {light, {}}, params).radiance;
        const double largest = static_cast<double>(*std::ranges::max_element(expected.values));
        EXPECT_GT(largest, 1) << what;
        EXPECT_LT(max_difference(drawn, expected), kHalfPrecision * largest) << what << " " << channels << " " << bands;
      }
    };
    for (const int bits : {16, 8}) {
      info.bits = bits;
      expect_decoded(quantise_transfer(transfer, bits).coefficients, std::to_string(bits));
    }
    info.bits = 16;
    for (const int components : {3, 4}) {
      info.pca = compress_pca(transfer, {.clusters = 12, .components = components});
      expect_decoded(pca_coefficients(*info.pca), "pca");
    }
  }
}

// The light or `bands` may have fewer bands than the transfer, and the other way round.
TEST_F(TransferRendererTest, UsesTheBandsThatBothHave) {
  const Transfer transfer =
      make_test_transfer(square_, 5, 3, [](std::size_t, int c, int i) { return i == 0 ? 2 : std::sin(c + 7.0 * i); });
  const RgbCoefficients light = constant_light(10, {9, 9, 9}), more = random_light(10);
  RgbCoefficients both = light;
  both += more;
  for (const int bands : {1, 2, 3, 4, 5, 8}) {
    const RgbCoefficients first = resize_bands(both, bands);
    const Rgb expected = lit(transfer, 0, first);
    for (const RgbCoefficients& given : {first, both}) {
      const Rgb drawn = draw(square_, transfer, given, test_params(bands)).rgb(kSize / 2, kSize / 3);
      expect_near(drawn, expected, 2 * kHalfPrecision * expected.g, testing::Message() << bands);
    }
  }
}

// As many as a bake can have.
TEST_F(TransferRendererTest, HasRoomForSixteenBands) {
  context_.emplace();
  const Transfer transfer = make_test_transfer(square_, kMaxTransferBands, 3, [](std::size_t, int c, int i) {
    return i == 0 ? 2 : i == 255 ? 1 + 0.1 * c : 0.01 * std::sin(c + 7.0 * i);
  });
  RgbCoefficients light = random_light(kMaxTransferBands);
  light[0] = {1, 2, 3}, light[255] = {3, 2, 1};
  const TransferRenderer renderer(transfer, light);
  const RadianceTarget target(kSize, kSize);
  target.begin();
  renderer.draw(GpuScene(square_), make_view({0, 0}, scene_extent(square_), 1));
  target.resolve();
  const Rgb expected = lit(transfer, 0, light);
  expect_near(target.read(1).rgb(kSize / 2, kSize / 3), expected, 2 * kHalfPrecision * expected.b, {});
}

TEST_F(TransferRendererTest, BothSidesLookTheSame) {
  const Transfer transfer = make_constant_transfer(square_, [](std::size_t) { return 0.5; });
  for (const double azimuth : {0.0, 180.0})
    EXPECT_NEAR(draw(square_, transfer, constant_light(1, {1, 1, 1}), test_params(1, azimuth)).rgb(32, 32).g, 0.5,
                kHalfPrecision);
}

// Radiance goes from 1 on the left to -1 on the right: black beyond the middle, not beyond the first negative vertex,
// and magenta in half of that where it is marked.
TEST_F(TransferRendererTest, NegativeRadianceIsBlackOrMarked) {
  const Transfer transfer = make_constant_transfer(square_, [](std::size_t v) { return v == 0 || v == 3 ? 1 : -1; });
  RenderParams params = test_params(1);
  const RgbCoefficients light = constant_light(1, {1, 1, 1});
  const Image plain = draw(square_, transfer, light, params);
  params.mark_negative = true;
  const Image marked = draw(square_, transfer, light, params);
  int striped = 0, negative = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Vec3d p = point_at(square_, params, x, y);
      if (std::max(std::abs(p.x), std::abs(p.y)) > 0.95 || std::abs(p.x) < 0.05) continue;
      EXPECT_NEAR(plain.rgb(x, y).g, std::max(-p.x, 0.0), kHalfPrecision) << x << " " << y;
      if (p.x > 0)
        ++negative, striped += marked.rgb(x, y).r > 2 * marked.rgb(x, y).g;
      else
        EXPECT_EQ(marked.rgb(x, y), plain.rgb(x, y)) << x << " " << y;
    }
  ASSERT_GT(negative, 100);
  EXPECT_NEAR(double(striped) / negative, 0.5, 0.1);
}

TEST_F(TransferRendererTest, NothingToSeeIsNoError) {
  const Transfer nothing = make_test_transfer(Scene(), 3, 1, {});
  for (const float value : draw(Scene(), nothing, constant_light(3, {1, 1, 1}), test_params(3)).values)
    ASSERT_EQ(value, 0);
}

}  // namespace
}  // namespace shlight

#include "shlight/render/tone_map.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "shlight/image/tone_map.h"
#include "shlight/render/render_test_util.h"

namespace shlight {
namespace {

gl::Texture make_row(int width, const float* values) {
  gl::Texture texture = gl::make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, 1, 0, GL_RGBA, GL_FLOAT, values);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

// Tone maps colours into floats, so that nothing is lost to eight bits.
std::vector<Rgb> tone_mapped(const std::vector<Rgb>& colors, double exposure, ToneCurve curve = ToneCurve::kFilmic) {
  std::vector<float> values;
  for (const Rgb& c : colors)
    values.insert(values.end(), {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1});
  const int width = static_cast<int>(colors.size());
  const gl::Texture input = make_row(width, values.data()), output = make_row(width, nullptr);
  const gl::Framebuffer framebuffer = gl::make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, output.id(), 0);
  glViewport(0, 0, width, 1);
  ToneMapper().draw(input.id(), exposure, curve);
  glReadPixels(0, 0, width, 1, GL_RGBA, GL_FLOAT, values.data());
  std::vector<Rgb> result(colors.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2]};
  return result;
}

class ToneMap : public GlTest {};

TEST_F(ToneMap, GreysStayGreyAndInOrder) {
  std::vector<Rgb> greys = {{0, 0, 0}};
  for (double stops = -14; stops <= 14; stops += 0.25) greys.push_back(std::exp2(stops) * Rgb{1, 1, 1});
  const std::vector<Rgb> mapped = tone_mapped(greys, 1);
  EXPECT_EQ(mapped[0], Rgb{});
  for (std::size_t i = 1; i < mapped.size(); ++i) {
    EXPECT_GE(mapped[i].g, mapped[i - 1].g) << greys[i].g;
    EXPECT_LE(mapped[i].g, 1) << greys[i].g;
    EXPECT_NEAR(mapped[i].r, mapped[i].g, 1e-5);
    EXPECT_NEAR(mapped[i].b, mapped[i].g, 1e-5);
  }
  EXPECT_GT(mapped.back().g, 0.999);
}

TEST_F(ToneMap, MiddleGreyStaysAfterExposure) {
  const double srgb = 1.055 * std::pow(0.18, 1 / 2.4) - 0.055;
  EXPECT_NEAR(tone_mapped({{0.18, 0.18, 0.18}}, 1)[0].g, srgb, 1e-4);
  EXPECT_NEAR(tone_mapped({{0.0225, 0.0225, 0.0225}}, 8)[0].g, srgb, 1e-4);
}

TEST_F(ToneMap, BrightColorsGoToWhiteAndHuesKeepTheirOrder) {
  const std::vector<Rgb> mapped = tone_mapped({{0.3, 0.1, 0.05}, {1000, 1000, 3000}, {0, 0, 4}}, 1);
  EXPECT_GT(mapped[0].r, mapped[0].g);
  EXPECT_GT(mapped[0].g, mapped[0].b);
  EXPECT_GT(mapped[1].r, 0.97);
  EXPECT_GT(mapped[2].r, 0.05) << "a bright blue lamp is not fully blue";
}

TEST_F(ToneMap, IsDefinedForAllFloats) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const Rgb& c : tone_mapped({{inf, inf, inf}, {-1, -1, -1}, {3e38, 0, 0}, {1e-45, 0, 0}}, 4))
    for (const double value : {c.r, c.g, c.b}) {
      EXPECT_GE(value, 0);
      EXPECT_LE(value, 1);
    }
}

TEST_F(ToneMap, IsTheProcessorsToHalfAStepOfAPicture) {
  std::vector<Rgb> colors;
  for (double stops = -12; stops <= 12; stops += 0.5)
    for (const Rgb& hue : {Rgb{1, 1, 1}, Rgb{1, 0.2, 0.03}, Rgb{0.1, 0.4, 1}, Rgb{0, 1, -1}})
      colors.push_back(std::exp2(stops) * hue);
  for (const ToneCurve curve : {ToneCurve::kFilmic, ToneCurve::kNone}) {
    const std::vector<Rgb> mapped = tone_mapped(colors, 0.7, curve);
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const Rgb expected = tone_map(0.7 * colors[i], curve);
      EXPECT_NEAR(mapped[i].r, encode_srgb(expected.r), 0.5 / 255) << i;
      EXPECT_NEAR(mapped[i].g, encode_srgb(expected.g), 0.5 / 255) << i;
      EXPECT_NEAR(mapped[i].b, encode_srgb(expected.b), 0.5 / 255) << i;
    }
  }
}

}  // namespace
}  // namespace shlight

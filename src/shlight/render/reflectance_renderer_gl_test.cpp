#include "shlight/render/reflectance_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shlight/brdf/make_brdf.h"
#include "shlight/brdf/metallic_roughness.h"
#include "shlight/image/environment.h"
#include "shlight/image/tone_map.h"
#include "shlight/light/light.h"
#include "shlight/render/render.h"
#include "shlight/render/render_test_util.h"
#include "shlight/render/surface_renderer.h"
#include "shlight/scene/load_scene.h"
#include "shlight/scene/shapes.h"
#include "shlight/sh/zonal.h"
#include "shlight/transfer/shadow_ratio.h"

namespace shlight {
namespace {

constexpr int kSize = 129;

// Of the largest radiance: half floats, a normal interpolated between 192 columns, a view that is parallel to 1/4°.
constexpr double kShadingTolerance = 6e-3;

ReflectanceTableParams table_params(int bands) {
  ReflectanceTableParams params;
  params.bands = bands;
  return params;
}

RgbCoefficients test_light(int bands) {
  RgbCoefficients light = constant_light(bands, {0.5, 0.6, 0.7});
  light += delta_light(bands, {0.48, 0.64, 0.6}, {1, 2, 3});
  light += delta_light(bands, {-0.6, 0.0, 0.8}, {2, 1, 0.5});
  return light;
}

// Nearly parallel projection, in which a pixel's place gives the normal.
RenderParams parallel_params(int bands) {
  RenderParams params;
  params.width = params.height = kSize;
  params.bands = bands;
  params.camera.azimuth = params.camera.elevation = 0;
  params.camera.vertical_fov = 0.5;
  return params;
}

Image draw(const Scene& scene, const std::vector<SurfaceReflectance>& surfaces, const RgbCoefficients& light,
           const RenderParams& params) {
  return render_reflectance(scene, surfaces, {light, {}}, params).radiance;
}

Rgb times(Rgb a, Vec3f b) {
  return {a.r * b.x, a.g * b.y, a.b * b.z};
}

double largest_of(Rgb c) {
  return std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)});
}

// What the sphere's pixels should be, in double: the light turned into each local frame, the table looked up there.
void expect_as_in_double(const Image& image, const SurfaceReflectance& surface, Vec3f base_color,
                         const RgbCoefficients& light, const std::string& where) {
  double largest = 0, error = 0;
  for (int i = 0; i < 200; ++i) {
    const double r = 0.97 * std::sqrt((i + 0.5) / 200), angle = 2.4 * i;
    const int x = static_cast<int>((0.5 + 0.47 * r * std::cos(angle)) * kSize);
    const int y = static_cast<int>((0.5 - 0.47 * r * std::sin(angle)) * kSize);
    const double nx = ((x + 0.5) / kSize - 0.5) / 0.47, ny = (0.5 - (y + 0.5) / kSize) / 0.47;
    const double nz2 = 1 - nx * nx - ny * ny;
    // Where the surface is nearly edge-on, a pixel holds many views.
    if (nz2 < 0.04) continue;
    const Vec3d n = {nx, ny, std::sqrt(nz2)};
    // The grooves of a lathe, as make_tangents has them.
    const Vec3d along = {n.z, 0, -n.x}, t = (1 / std::sqrt(dot(along, along))) * along, b = cross(n, t);
    const RgbCoefficients local = rotate(Rotation{{t, b, n}}, light);
    const Vec3d view = {0, 0, 1}, v = {dot(t, view), dot(b, view), dot(n, view)};
    Rgb expected = reflect_light(*surface.plain, v, local);
    if (surface.tinted) expected = expected + times(reflect_light(*surface.tinted, v, local), base_color);
    expected = {std::max(expected.r, 0.0), std::max(expected.g, 0.0), std::max(expected.b, 0.0)};
    largest = std::max(largest, largest_of(expected));
    error = std::max(error, largest_of(image.rgb(x, y) - expected));
  }
  EXPECT_GT(largest, 0) << where;
  EXPECT_LT(error, kShadingTolerance * largest) << where;
}

class ReflectanceRendererTest : public GlTest {
 protected:
  // render_reflectance makes its own context.
  void SetUp() override {
    GlTest::SetUp();
    context_.reset();
  }

  const Vec3f base_color_ = {0.9f, 0.5f, 0.2f};
  const Scene sphere_ = make_test_scene(make_ellipsoid({1, 1, 1}, 96), base_color_);
};

TEST_F(ReflectanceRendererTest, SphereIsTheSumInDouble) {
  for (const int bands : {1, 3, 5})
    for (const char* material :
         {"lambert", "oren-nayar:sigma=0.6", "ward", "cook-torrance:m=0.3", "ggx:alpha=0.4,f0=0.9/0.6/0.2",
          "ggx-aniso:ax=0.2,ay=0.5", "ward-aniso:rd=0.3/0.1/0.1", "ward:rd=0.6/0.2/0.4,rs=0.3/0.1/0.2"}) {
      const auto brdf = make_brdf(material);
      const auto surfaces = make_surface_reflectances(sphere_, *brdf, table_params(bands));
      const SurfaceReflectance whole = {make_reflectance_table(*brdf, table_params(bands)), {}, {}, {}};
      const RgbCoefficients light = test_light(bands);
      expect_as_in_double(draw(sphere_, surfaces, light, parallel_params(bands)), whole, base_color_, light,
                          std::string(material) + ", bands " + std::to_string(bands));
    }
}

// Where on the unit sphere the middle of a pixel looks, and from where, in the world; nothing beside it, where it is
// nearly edge-on, and at its poles.
struct SeenPoint {
  Vec3d normal, to_eye;
};
std::optional<SeenPoint> seen_on_unit_sphere(const View& view, double x, double y) {
  // Columns of the view's matrix are orthogonal and of one length.
  const Mat4d& m = view.world_to_view;
  const Vec3d columns[] = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}, offset = {m[12], m[13], m[14]};
  const auto to_world = [&](Vec3d d) {
    return (1 / dot(columns[0], columns[0])) * Vec3d{dot(columns[0], d), dot(columns[1], d), dot(columns[2], d)};
  };
  const Vec3d eye = to_world(-1.0 * offset);
  const Vec3d ray = to_world({x / view.view_to_clip[0], y / view.view_to_clip[5], -1});
  const double a = dot(ray, ray), b = dot(ray, eye), root = b * b - a * (dot(eye, eye) - 1);
  if (root < 0) return std::nullopt;
  const Vec3d n = eye + (-b - std::sqrt(root)) / a * ray, to_eye = eye - n;
  const Vec3d v = (1 / std::sqrt(dot(to_eye, to_eye))) * to_eye;
  // At the poles the lathe's grooves turn within a triangle.
  if (dot(n, v) < 0.25 || std::abs(n.y) > 0.95) return std::nullopt;
  return SeenPoint{n, v};
}

// The picture, perspective, exposed and tone mapped, is the sum in double to one of its steps.
TEST_F(ReflectanceRendererTest, PictureIsTheSumInDoubleToOneStep) {
  const Scene sphere = make_test_scene(make_ellipsoid({1, 1, 1}, 512), base_color_);
  RenderParams params;
  params.width = 120, params.height = 90;
  params.camera.zoom = 1.3;
  const View view = make_view(params.camera, scene_extent(sphere), 120.0 / 90);
  const std::pair<int, const char*> cases[] = {{3, "cook-torrance:m=0.4,f0=0.5"},
                                               {5, "ggx:alpha=0.2,f0=0.9/0.6/0.2"},
                                               {5, "ggx-aniso:ax=0.1,ay=0.4,f0=0.9/0.6/0.3"},
                                               {5, "ward-aniso:rd=0.3/0.1/0.1"},
                                               {8, "oren-nayar-full:sigma=0.7"},
                                               {8, "ggx-aniso:ax=0.1,ay=0.4,f0=0.9/0.6/0.3"}};
  for (const auto& [bands, material] : cases) {
    const auto brdf = make_brdf(material);
    ReflectanceTableParams size = table_params(bands);
    size.square_size = 32;  // whatever is between entries, both find it there
    const ReflectanceTable table = make_reflectance_table(*brdf, size);
    const RgbCoefficients light = test_light(bands);
    const double exposure = auto_exposure(light);
    params.bands = bands;
    const auto surfaces = make_surface_reflectances(sphere, *brdf, size);
    const Image8 picture = render_reflectance(sphere, surfaces, {light, {}}, params).picture;
    int count = 0;
    double error = 0, brightest = 0;
    for (int y = 0; y < params.height; ++y)
      for (int x = 0; x < params.width; ++x) {
        const auto seen =
            seen_on_unit_sphere(view, 2 * (x + 0.5) / params.width - 1, 1 - 2 * (y + 0.5) / params.height);
        if (!seen) continue;
        const Vec3d n = seen->normal, along = {n.z, 0, -n.x};
        const Vec3d t = (1 / std::sqrt(dot(along, along))) * along, b = cross(n, t);
        const Vec3d v = {dot(t, seen->to_eye), dot(b, seen->to_eye), dot(n, seen->to_eye)};
        const Rgb radiance = reflect_light(table, v, rotate(Rotation{{t, b, n}}, light));
        const Rgb expected = tone_map(exposure * radiance, params.curve);
        const std::size_t at = 4 * (static_cast<std::size_t>(y) * params.width + x);
        const double values[] = {expected.r, expected.g, expected.b};
        for (std::size_t k = 0; k < 3; ++k) {
          error = std::max(error, std::abs(picture.values[at + k] - 255 * encode_srgb(values[k])));
          brightest = std::max(brightest, static_cast<double>(picture.values[at + k]));
        }
        ++count;
      }
    EXPECT_GT(count, 2000);
    EXPECT_GT(brightest, 100);
    // A step, and the half that it is rounded by.
    EXPECT_LT(error, 1.5) << material << ", " << bands << " bands";
  }
}

TEST_F(ReflectanceRendererTest, GlossyMaterialsOfScenesTakeTheirBaseColors) {
  Scene sphere = sphere_;
  for (const MetallicRoughness gloss : {MetallicRoughness{0, 0.4f}, {1, 0.6f}, {0.5f, 1}}) {
    sphere.materials[0].gloss = gloss;
    const auto surfaces = make_surface_reflectances(sphere, table_params(5));
    ASSERT_TRUE(surfaces[0].tinted);
    const RgbCoefficients light = test_light(5);
    const Image image = draw(sphere, surfaces, light, parallel_params(5));
    expect_as_in_double(image, surfaces[0], base_color_, light, std::to_string(gloss.metallic));
    // And the base colour in the model itself says the same.
    const Rgb base = {base_color_.x, base_color_.y, base_color_.z};
    const SurfaceReflectance whole = {
        make_reflectance_table(*make_metallic_roughness(base, gloss.metallic, gloss.roughness), table_params(5)),
        {},
        {},
        {}};
    expect_as_in_double(image, whole, base_color_, light, std::to_string(gloss.metallic));
  }
}

TEST_F(ReflectanceRendererTest, VerticesAndPixelsAgreeOnAFineMesh) {
  for (const char* material : {"ggx:alpha=0.3,f0=0.9/0.6/0.2", "ggx-aniso:ax=0.2,ay=0.5"}) {
    const auto surfaces = make_surface_reflectances(sphere_, *make_brdf(material), table_params(5));
    RenderParams params = parallel_params(5);
    const Image pixels = draw(sphere_, surfaces, test_light(5), params);
    params.shade = Shade::kVertex;
    const Image vertices = draw(sphere_, surfaces, test_light(5), params);
    double largest = 0, error = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        // Not the outline, where a pixel holds part of the background.
        const double nx = ((x + 0.5) / kSize - 0.5) / 0.47, ny = (0.5 - (y + 0.5) / kSize) / 0.47;
        if (nx * nx + ny * ny > 0.96) continue;
        largest = std::max(largest, largest_of(pixels.rgb(x, y)));
        error = std::max(error, largest_of(pixels.rgb(x, y) - vertices.rgb(x, y)));
      }
    EXPECT_LT(error, 1e-2 * largest) << material;
  }
}

TEST_F(ReflectanceRendererTest, LambertianSurfacesLookAsByIrradiance) {
  const RgbCoefficients light = test_light(5);
  const RenderParams params = parallel_params(5);
  const Image irradiance = render_irradiance(sphere_, {light, {}}, params).radiance;
  EXPECT_EQ(draw(sphere_, make_surface_reflectances(sphere_, table_params(5)), light, params).values,
            irradiance.values);
}

TEST_F(ReflectanceRendererTest, TurningTheLightIsTurningTheView) {
  // A sphere of an isotropic material under a light turned by 90° seen from 0° is that light seen from -90°.
  const auto surfaces = make_surface_reflectances(sphere_, *make_brdf("ggx:alpha=0.3,f0=0.5"), table_params(5));
  RenderParams params = parallel_params(5);
  params.show_background = false;
  params.rotate_light = rotation_about_y(std::numbers::pi / 2);
  const Image turned = draw(sphere_, surfaces, test_light(5), params);
  params.rotate_light = {};
  params.camera.azimuth = -90;
  const Image seen = draw(sphere_, surfaces, test_light(5), params);
  double largest = 0, error = 0;
  for (std::size_t i = 0; i < turned.values.size(); ++i) {
    largest = std::max(largest, std::abs(double{turned.values[i]}));
    error = std::max(error, std::abs(double{turned.values[i]} - seen.values[i]));
  }
  EXPECT_LT(error, kShadingTolerance * largest);
}

TEST_F(ReflectanceRendererTest, ThingsHaveMaterialsOfTheirOwn) {
  // Two spheres side by side: one mirrors sharply, the other is Lambertian; each looks as it does alone.
  Scene both = sphere_;
  both.materials.push_back(both.materials[0]);
  both.materials[1].gloss = MetallicRoughness{1, 0.4f};
  both.meshes.push_back(both.meshes[0]);
  both.meshes[1].material = 1;
  both.instances = {{0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1.5f, 0, 0, 1}},
                    {1, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1.5f, 0, 0, 1}}};
  Scene swapped = both;
  std::swap(swapped.instances[0].to_world, swapped.instances[1].to_world);
  RenderParams params = parallel_params(5);
  params.width = 2 * kSize;
  params.show_background = false;
  const RgbCoefficients light = test_light(5);
  const Image a = draw(both, make_surface_reflectances(both, table_params(5)), light, params);
  const Image b = draw(swapped, make_surface_reflectances(swapped, table_params(5)), light, params);
  // Distant lights do not see where a thing is.
  const int x = params.width / 4, y = params.height / 2;
  const double difference = largest_of(a.rgb(x, y) - a.rgb(params.width - 1 - x, y));
  EXPECT_GT(difference, 0.01);
  EXPECT_LT(largest_of(a.rgb(x, y) - b.rgb(x + params.width / 2, y)), 0.1 * difference);
}

// What a sphere's middle leaves toward an eye in front of it, by brute force: ∫ f L cos over a fine grid of the
// picture.
Rgb reflected_to_front(const Brdf& brdf, const Image& picture) {
  Rgb sum;
  const double step = std::numbers::pi / picture.height;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Vec3d d = *direction_at(Layout::kLatLong, {(x + 0.5) / picture.width, (y + 0.5) / picture.height});
      if (d.z <= 0) continue;
      const Rgb f = brdf.eval(d, {0, 0, 1}), l = picture.rgb(x, y);
      const double weight = d.z * step * step * std::sqrt(1 - d.y * d.y);
      sum += weight * Rgb{f.r * l.r, f.g * l.g, f.b * l.b};
    }
  return sum;
}

// Smooth enough for pixels, with far more than five bands.
Image make_spotty_picture() {
  Image picture(512, 256);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Vec3d d = *direction_at(Layout::kLatLong, {(x + 0.5) / picture.width, (y + 0.5) / picture.height});
      const double spot = std::exp(60 * (0.2 * d.x + 0.1 * d.y + std::sqrt(0.95) * d.z - 1));
      picture.set_rgb(x, y, {0.3 + 4 * spot, 0.3 + 0.2 * d.y + 3 * spot, 0.4 + spot});
    }
  return picture;
}

TEST_F(ReflectanceRendererTest, HybridHighlightsAreThoseOfTheWholeLight) {
  const Image picture = make_spotty_picture();
  const auto light = std::make_unique<ImageLight>(Environment{picture, Layout::kLatLong});
  RenderParams params = parallel_params(5);
  double gained = 0;
  for (const char* material : {"ggx:alpha=0.1,f0=0.9/0.6/0.3", "ggx:alpha=0.8,f0=0.8", "cook-torrance:m=0.15,f0=0.7",
                               "ggx-aniso:ax=0.1,ay=0.3,f0=0.8"}) {
    const auto brdf = make_brdf(material);
    const auto surfaces = make_surface_reflectances(sphere_, *brdf, table_params(5), true);
    const RenderLight lit = {light->project(5, 0), picture};
    const Rgb hybrid = render_hybrid(sphere_, surfaces, lit, params).radiance.rgb(kSize / 2, kSize / 2);
    const auto plain = make_surface_reflectances(sphere_, *brdf, table_params(5));
    const Rgb alone = draw(sphere_, plain, lit.coefficients, params).rgb(kSize / 2, kSize / 2);
    const Rgb expected = reflected_to_front(*brdf, picture);
    // Sixteen slim lobes for a wide one.
    const double tolerance = brdf->traits().symmetry == BrdfSymmetry::kIsotropic ? 0.03 : 0.08;
    EXPECT_NEAR(hybrid.r, expected.r, tolerance * expected.r) << material << ", without: " << alone.r;
    EXPECT_NEAR(hybrid.b, expected.b, tolerance * expected.b) << material << ", without: " << alone.b;
    gained = std::max(gained, std::abs(alone.r - expected.r) / expected.r);
  }
  EXPECT_GT(gained, 0.2) << "a test that the reflectance method passes too is no test of this one";
}

TEST_F(ReflectanceRendererTest, HybridLosesNothingOfALightOfFewBands) {
  // All of it is in the first bands: part of it comes by them, part by the residual of their reconstruction.
  const auto brdf = make_brdf("ggx:alpha=0.1,f0=0.9/0.6/0.3");
  const RgbCoefficients light = test_light(5);
  const RenderParams params = parallel_params(5);
  const Image reflectance = draw(sphere_, make_surface_reflectances(sphere_, *brdf, table_params(5)), light, params);
  const Image hybrid =
      render_hybrid(sphere_, make_surface_reflectances(sphere_, *brdf, table_params(5), true), {light, {}}, params)
          .radiance;
  const int middle = kSize / 2;
  EXPECT_LT(largest_of(hybrid.rgb(middle, middle) - reflectance.rgb(middle, middle)),
            0.03 * largest_of(reflectance.rgb(middle, middle)));
}

TEST_F(ReflectanceRendererTest, HybridMirrorShowsTheLight) {
  const Image picture = make_spotty_picture();
  const auto light = std::make_unique<ImageLight>(Environment{picture, Layout::kLatLong});
  const auto surfaces = make_surface_reflectances(sphere_, *make_brdf("ggx:alpha=0.01,f0=1"), table_params(5), true);
  const Image image = render_hybrid(sphere_, surfaces, {light->project(5, 0), picture}, parallel_params(5)).radiance;
  const Environment environment = {picture, Layout::kLatLong};
  for (int x = kSize / 5; x < kSize - kSize / 5; x += 3) {
    const double nx = ((x + 0.5) / kSize - 0.5) / 0.47, nz = std::sqrt(1 - nx * nx);
    const Rgb expected = eval_bilinear(environment, {2 * nz * nx, 0, 2 * nz * nz - 1});
    // Facets of α = 0.01 still scatter some of the spot.
    EXPECT_NEAR(image.rgb(x, kSize / 2).r, expected.r, 0.08 * expected.r + 0.02) << x;
  }
}

// A grey sky with a sun of half a degree and of this irradiance.
constexpr double kSky = 0.3, kSunIrradiance = 3;
Image make_sunny_picture(Vec3d to_sun) {
  Image picture(1024, 512);
  double solid_angle = 0;
  const double step = std::numbers::pi / picture.height;
  const auto for_each = [&](const auto& visit) {
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const Vec3d d = *direction_at(Layout::kLatLong, {(x + 0.5) / picture.width, (y + 0.5) / picture.height});
        visit(x, y, d, dot(d, to_sun) > std::cos(std::numbers::pi / 360));
      }
  };
  for_each([&](int, int, Vec3d d, bool sun) { solid_angle += sun ? step * step * std::sqrt(1 - d.y * d.y) : 0; });
  for_each([&](int x, int y, Vec3d, bool sun) {
    const double value = kSky + (sun ? kSunIrradiance / solid_angle : 0);
    picture.set_rgb(x, y, {value, value, value});
  });
  return picture;
}

// Highlights of the sun, up to grazing ones, and what diffuse parts reflect of it, against the model itself, under a
// light that is turned.
TEST_F(ReflectanceRendererTest, HybridReflectsTheSunAsTheModelDoes) {
  const Vec3d toward = {0.5, 0.6, 0.3}, to_sun = (1 / std::sqrt(dot(toward, toward))) * toward, to_eye = {0, 0, 1};
  const double turn = 0.7;
  const Rotation back = rotation_about_y(-turn);
  const Image picture =
      make_sunny_picture({dot(back.rows[0], to_sun), dot(back.rows[1], to_sun), dot(back.rows[2], to_sun)});
  const auto light = std::make_unique<ImageLight>(Environment{picture, Layout::kLatLong});
  RenderParams params = parallel_params(5);
  params.rotate_light = rotation_about_y(turn);
  // Of the largest radiance. A Ward lobe fades toward the horizon where the grooves of the drawn one do not.
  const std::pair<const char*, double> cases[] = {
      {"ggx:alpha=0.05,f0=0.9/0.6/0.3", 0.035},
      {"ggx:alpha=0.15,f0=0.9/0.6/0.3", 0.015},
      {"cook-torrance:m=0.15,f0=0.7", 0.015},
      {"ward:rd=0,rs=0.5,sigma=0.15", 0.055},
      {"ward:rd=0.6/0.3/0.1,rs=0.02,sigma=0.15", 0.015},
      {"metallic-roughness:base=0.7/0.3/0.1,metallic=0,roughness=0.4", 0.015},
      {"ggx-aniso:ax=0.05,ay=0.2,f0=0.8", 0.05}};
  for (const auto& [material, tolerance] : cases) {
    const auto brdf = make_brdf(material);
    const auto surfaces = make_surface_reflectances(sphere_, *brdf, table_params(5), true);
    const Image image = render_hybrid(sphere_, surfaces, {light->project(5, 0), picture}, params).radiance;
    const ReflectanceTable table = make_reflectance_table(*brdf, table_params(1));
    double largest = 0, error = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const double nx = ((x + 0.5) / kSize - 0.5) / 0.47, ny = (0.5 - (y + 0.5) / kSize) / 0.47;
        const double nz2 = 1 - nx * nx - ny * ny;
        if (nz2 < 0.06) continue;
        const Vec3d n = {nx, ny, std::sqrt(nz2)}, along = {n.z, 0, -n.x};
        const Vec3d t = (1 / std::sqrt(dot(along, along))) * along, b = cross(n, t);
        const auto local = [&](Vec3d d) { return Vec3d{dot(t, d), dot(b, d), dot(n, d)}; };
        const Vec3d v = local(to_eye), s = local(to_sun);
        Rgb expected = reflect_light(table, v, constant_light(1, {kSky, kSky, kSky}));
        if (s.z > 0) expected += kSunIrradiance * s.z * brdf->eval(s, v);
        largest = std::max(largest, largest_of(expected));
        error = std::max(error, largest_of(image.rgb(x, y) - expected));
      }
    EXPECT_LT(error, tolerance * largest) << material << ": " << error / largest;
  }
}

TEST_F(ReflectanceRendererTest, HybridShowsOneDegreeWithoutTheSun) {
  const Image picture = make_sunny_picture({0, 0.6, 0.8});
  const auto light = std::make_unique<ImageLight>(Environment{picture, Layout::kLatLong});
  const auto surfaces = make_surface_reflectances(sphere_, *make_brdf("ggx:alpha=0.1,f0=0.8"), table_params(3), true);
  RenderParams params = parallel_params(3);
  params.show = Show::kDegree;
  params.degree = 0;
  const Rgb shown =
      render_hybrid(sphere_, surfaces, {light->project(3, 0), picture}, params).radiance.rgb(kSize / 2, kSize / 2);
  const ReflectanceTable table = make_reflectance_table(*make_brdf("ggx:alpha=0.1,f0=0.8"), table_params(1));
  const Rgb expected = reflect_light(table, {0, 0, 1}, light->project(1, 0));
  EXPECT_NEAR(shown.g, expected.g, 0.01 * expected.g);
}

TEST_F(ReflectanceRendererTest, BakedShadowsAreThoseOfTransfer) {
  // Of matte surfaces, reflectance times the share of irradiance is the transfer's own sum.
  const Scene scene = without_colors(make_scene("builtin:scene"));
  BakeParams bake;
  bake.kind = TransferKind::kShadowed;
  bake.bands = 3;
  bake.samples = 64;
  const Transfer transfer = bake_transfer(scene, bake);
  const ShadowRatio shadows(scene, transfer);
  RenderParams params;
  params.bands = 3;
  params.width = 160, params.height = 120;
  params.show_background = false;
  params.rotate_light = rotation_about_y(1);
  RgbCoefficients light = constant_light(3, {1, 1, 1});
  light[1] = {0.8, 0.6, 0.4};
  light[3] = {0.3, 0.3, 0.6};
  const auto surfaces = make_surface_reflectances(scene, *make_brdf("lambert:rho=1"), table_params(3));
  const Image open = draw(scene, surfaces, light, params);
  const Image expected = render_transfer(scene, transfer, {light, {}}, params).radiance;
  const auto difference = [&](const Image& image) {
    double sum = 0, square = 0;
    for (std::size_t i = 0; i < expected.values.size(); ++i) {
      sum += std::pow(double{image.values[i]} - double{expected.values[i]}, 2);
      square += std::pow(double{expected.values[i]}, 2);
    }
    return std::sqrt(sum / square);
  };
  EXPECT_GT(difference(open), 0.1) << "a scene whose shadows matter";
  params.shadows = &shadows;
  for (const Shade shade : {Shade::kPixel, Shade::kVertex}) {
    params.shade = shade;
    // Both are linear across triangles, but their product is not; and nothing is ever quite black.
    EXPECT_LT(difference(draw(scene, surfaces, light, params)), 0.03);
  }
}

TEST_F(ReflectanceRendererTest, WhiteFurnace) {
  // In constant light a mirror is as bright as its albedo, which is below 1 by what is lost between facets.
  const auto surfaces = make_surface_reflectances(sphere_, *make_brdf("ggx:alpha=0.1,f0=1"), table_params(5));
  const Image image = draw(sphere_, surfaces, constant_light(5, {1, 1, 1}), parallel_params(5));
  const Rgb center = image.rgb(kSize / 2, kSize / 2);
  const double albedo = std::sqrt(4 * std::numbers::pi) * eval_reflectance_table(*surfaces[0].plain, {0, 0, 1})[0].g;
  EXPECT_NEAR(center.g, albedo, kShadingTolerance);
  for (const float value : image.values) EXPECT_LE(value, 1 + kShadingTolerance);
}

}  // namespace
}  // namespace shlight

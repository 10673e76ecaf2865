#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shlight/image/clamp.h"
#include "shlight/image/environment.h"
#include "shlight/image/image_io.h"
#include "shlight/image/pixel_report.h"
#include "shlight/image/resample.h"
#include "shlight/light/sun.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/project.h"

namespace shlight {

struct SunSplit;

// Light from infinitely far away: radiance as a function of the direction it comes from.
class Light {
 public:
  virtual ~Light() = default;

  // Linear Rec. 709 radiance from a unit direction. Safe to call from several threads.
  virtual Rgb radiance(Vec3d direction) const = 0;

  // The coefficients of the radiance, by the most exact method that this kind of light has.
  // `threads`: 0 for all there are.
  virtual RgbCoefficients project(int bands, int threads = 0) const = 0;

  // A picture of the light. Throws Cancelled where `progress` stops it.
  virtual Image picture(const MakePictureParams& params, const Progress& progress = {}) const;

  // The light as a lat-long picture: its own where it is one, else of `width` x `width`/2 pixels.
  virtual Image lat_long(int width, int threads = 0) const;

  // The light's sun and the light without it, as sun.h defines them; nothing where it has none. Formulas have none.
  virtual std::optional<SunSplit> split_sun(int threads = 0) const;
};

struct SunSplit {
  Sun sun;
  std::unique_ptr<Light> rest;
};

struct LoadLightParams {
  std::optional<Layout> layout;  // of pictures; nothing: as the file states it, else told from the picture's shape
  std::optional<double> clamp;   // of pictures, positive: channels above it are cut, negative ones become 0 (clamp.h)
  LoadImageParams image;
};

// What a light was made from.
struct LightInfo {
  enum class Kind { kImage, kCoefficients, kFormula, kBuiltin };
  Kind kind = Kind::kBuiltin;
  std::string name;
  std::optional<Layout> layout;  // of an image, as are these
  int width = 0, height = 0;
  PixelReport pixels;
  std::vector<std::string> warnings;  // what was odd about the file, a line each
  std::optional<ClampReport> clamp;   // where it was asked for
  int bands = 0;                      // of coefficients
};

struct LoadedLight {
  std::unique_ptr<Light> light;
  LightInfo info;
};

// Makes a light from what a user writes: the path of a picture or of a coefficient file (.json), "builtin:NAME" with
// optional parameters ("builtin:sky:elevation=20,turbidity=4"), or a formula "fn:…" (formula_light.h). Pixels that are
// not finite are taken as 0, which info.pixels reports; only then are they clamped. Throws Error, also where something
// else than a picture is to be clamped.
LoadedLight load_light(const std::string& light, const LoadLightParams& params = {});

// Pixels of constant radiance.
class ImageLight : public Light {
 public:
  explicit ImageLight(Environment environment) : environment_(std::move(environment)) {}
  Rgb radiance(Vec3d direction) const override { return eval_nearest(environment_, direction); }
  RgbCoefficients project(int bands, int threads) const override;
  Image picture(const MakePictureParams& params, const Progress& progress) const override;
  Image lat_long(int width, int threads) const override;
  std::optional<SunSplit> split_sun(int threads) const override;
  const Environment& environment() const { return environment_; }

 private:
  Environment environment_;
};

// The function that coefficients stand for, negative radiance and all, and, where there is one, a sun beside it: a
// delta light to project(), a disc of the sun's size to radiance().
class CoefficientLight : public Light {
 public:
  explicit CoefficientLight(RgbCoefficients coefficients, std::optional<Sun> sun = {})
      : coefficients_(std::move(coefficients)), sun_(sun) {}
  Rgb radiance(Vec3d direction) const override;
  RgbCoefficients project(int bands, int threads) const override;
  std::optional<SunSplit> split_sun(int threads) const override;
  const std::optional<Sun>& sun() const { return sun_; }

 private:
  RgbCoefficients coefficients_;
  std::optional<Sun> sun_;
};

// A function and, on top of it, discs and polygons of uniform radiance, which are projected in closed form however
// small they are.
class FunctionLight : public Light {
 public:
  struct Disc {
    Vec3d axis;             // unit
    double half_angle = 0;  // radians
    Rgb radiance;
  };
  // A lamp that shines to both sides, as add_polygon of area_light.h takes it.
  struct Polygon {
    std::vector<Vec3d> vertices;
    Rgb radiance;
  };
  explicit FunctionLight(SphereFunction function, std::vector<Disc> discs = {}, std::vector<Polygon> polygons = {});
  Rgb radiance(Vec3d direction) const override;
  RgbCoefficients project(int bands, int threads) const override;
  Image picture(const MakePictureParams& params, const Progress& progress) const override;
  // The brightest disc that is small enough for a sun.
  std::optional<SunSplit> split_sun(int threads) const override;

 private:
  SphereFunction function_;
  std::vector<Disc> discs_;
  std::vector<double> squared_chords_;  // of the discs' edges to their axes
  std::vector<Polygon> polygons_;
};

}  // namespace shlight

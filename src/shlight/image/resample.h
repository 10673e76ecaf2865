#pragma once

#include <functional>
#include <span>

#include "shlight/core/progress.h"
#include "shlight/image/environment.h"
#include "shlight/image/pixels.h"

// Making pictures of environments: each pixel is the mean radiance over the area that it covers.

namespace shlight {

struct MakePictureParams {
  Layout layout = Layout::kLatLong;
  int size = 1024;  // see picture_size
  int threads = 0;  // 0: all there are
};

// How many samples a side a pixel needs, told from its 2 x 2 quadrature nodes.
using SamplesASide = std::function<int(std::span<const WeightedDirection> nodes)>;

constexpr int kMostSamplesASide = 32;  // what is asked beyond is not given

// A picture of a radiance function. Pixels that stand for no direction are black. Throws Cancelled where `progress`
// stops it.
Image make_picture(const std::function<Rgb(Vec3d direction)>& radiance, const SamplesASide& samples,
                   const MakePictureParams& params, const Progress& progress = {});

// The same environment in another layout or size. Area-correct: where pixels become larger each is the mean of those it
// covers, where they become smaller they are interpolated, over the seams too. All layouts of one light have the same
// coefficients but for what a pixel's width blurs.
Image resample(const Environment& environment, const MakePictureParams& params, const Progress& progress = {});

}  // namespace shlight

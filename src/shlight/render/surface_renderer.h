#pragma once

#include <variant>

#include "shlight/render/irradiance_renderer.h"
#include "shlight/render/normal_renderer.h"
#include "shlight/render/reflectance_renderer.h"
#include "shlight/render/transfer_renderer.h"

namespace shlight {

// A renderer of any method, and what all of them can be asked.
using SurfaceRenderer = std::variant<IrradianceRenderer, TransferRenderer, ReflectanceRenderer, NormalRenderer>;

void draw_surfaces(const SurfaceRenderer& renderer, const GpuScene& scene, const View& view,
                   const Rotation& light_to_world);
void set_radiance(SurfaceRenderer& renderer, const RgbCoefficients& radiance);
void mark_negative(SurfaceRenderer& renderer, Vec3f radiance);
// Whether the GpuScene has to have tangents.
bool needs_tangents(const SurfaceRenderer& renderer);

// What `transfer`'s renderer shows of a scene without colours: how open each vertex is to the light, cosine-weighted,
// and what others reflect to it: the light is 1 from everywhere.
RgbCoefficients visibility_light(int bands);
Scene without_colors(Scene scene);

}  // namespace shlight

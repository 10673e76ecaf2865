#include "shlight/scene/builtin_scene.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "shlight/core/assert.h"
#include "shlight/scene/shapes.h"
#include "shlight/scene/transform.h"

namespace shlight {
namespace {

// Linear reflectances of real things: white paint keeps about 0.8 of the light, and no paint reaches 0 or 1.
constexpr Vec3f kWhite = {0.80f, 0.79f, 0.76f};
constexpr Vec3f kPaper = {0.62f, 0.60f, 0.56f};
constexpr Vec3f kRed = {0.58f, 0.07f, 0.05f};
constexpr Vec3f kBlue = {0.11f, 0.24f, 0.52f};
constexpr Vec3f kGold = {0.78f, 0.42f, 0.09f};
constexpr Vec3f kWood = {0.42f, 0.26f, 0.15f};
constexpr Vec3f kTeal = {0.09f, 0.38f, 0.33f};
constexpr Vec3f kClay = {0.60f, 0.27f, 0.16f};

// The knot's proportions, alone and in the still life.
constexpr TorusKnotParams kKnot = {.major = 2, .minor = 1, .tube = 0.55f};
constexpr float kKnotRadius = kKnot.major + kKnot.minor + kKnot.tube;  // of the sphere it just fits

void scale_mesh(Mesh& mesh, float factor) {
  for (Vec3f& p : mesh.positions) p = factor * p;
}

void add_mesh(Scene& scene, Mesh mesh, std::string name, Vec3f base_color, const Mat4f& to_world) {
  mesh.name = name;
  mesh.material = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back({std::move(name), base_color, {}, {}});
  scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size()), to_world});
  scene.meshes.push_back(std::move(mesh));
}

// Things that rest on others keep this distance, so that no two surfaces share a plane; too little to be seen.
constexpr float kGap = 5e-4f;

// The matrix that turns `mesh` by `turn` and sets it down at (x, z) on something of height `y`.
Mat4f rest_on(float y, float x, float z, const Mat4f& turn, const Mesh& mesh) {
  float lowest = std::numeric_limits<float>::max();
  for (const Vec3f& p : mesh.positions) lowest = std::min(lowest, transform_point(turn, p).y);
  return multiply(make_translation({x, y + kGap - lowest, z}), turn);
}

Mat4f turned(float degrees) {
  return make_rotation({0, 1, 0}, degrees);
}

}  // namespace

Scene make_sphere_scene(int rings) {
  Scene scene;
  add_mesh(scene, make_sphere(1, rings), "sphere", kWhite, kIdentity);
  return scene;
}

Scene make_knot_scene() {
  Scene scene;
  Mesh knot = make_torus_knot(kKnot);
  scale_mesh(knot, 1 / kKnotRadius);
  add_mesh(scene, std::move(knot), "knot", kGold, kIdentity);
  return scene;
}

// From above, +X to the right, the viewer at +Z below:
//
//          red wall           bench with the knot on top
//          white sphere       and a pearl under it
//       bowl        blue cube          cone
Scene make_still_life_scene() {
  Scene scene;
  const auto add = [&](Mesh mesh, const char* name, Vec3f base_color, float y, float x, float z, const Mat4f& turn) {
    const Mat4f to_world = rest_on(y, x, z, turn, mesh);
    add_mesh(scene, std::move(mesh), name, base_color, to_world);
  };
  constexpr int kRoundSteps = 4;
  constexpr float kStep = 0.0125f;

  // The floor's top is at height 0. It is cut finely because methods that keep light at vertices show shadows on it.
  constexpr float kFloor = 0.96f, kThickness = 0.06f;
  const OutlineCorner floor[] = {{0, -kThickness}, {kFloor, -kThickness, 0.025f}, {kFloor, 0, 0.025f}, {0, 0}};
  add_mesh(scene, make_turned(floor, 288, kStep), "floor", kPaper, kIdentity);

  add(make_rounded_box({0.52f, 0.5f, 0.1f}, 0.02f, kRoundSteps, kStep), "red wall", kRed, 0, -0.46f, -0.40f,
      turned(24));
  add(make_sphere(0.2f, 48), "white sphere", kWhite, 0, -0.30f, -0.10f, kIdentity);

  // A bench: a slab that hangs over on two legs; its parts are turned together.
  constexpr float kLegHeight = 0.3f, kSlabHeight = 0.05f;
  const Mat4f bench = multiply(make_translation({0.40f, 0, -0.34f}), turned(-18));
  for (const float x : {-0.2f, 0.2f}) {
    const Mesh leg = make_rounded_box({0.05f, kLegHeight, 0.24f}, 0.015f, kRoundSteps, 2 * kStep);
    add_mesh(scene, leg, "bench leg", kWood, multiply(bench, rest_on(0, x, 0, kIdentity, leg)));
  }
  const Mesh slab = make_rounded_box({0.64f, kSlabHeight, 0.32f}, 0.02f, kRoundSteps, kStep);
  add_mesh(scene, slab, "bench slab", kWood, multiply(bench, rest_on(kLegHeight + kGap, 0, 0, kIdentity, slab)));
  TorusKnotParams knot = kKnot;
  knot.along = 320, knot.around = 32;
  Mesh small_knot = make_torus_knot(knot);
  scale_mesh(small_knot, 0.17f / kKnotRadius);
  add(std::move(small_knot), "knot", kGold, kLegHeight + kSlabHeight + 2 * kGap, 0.40f, -0.34f, turned(-8));
  add(make_sphere(0.075f, 32), "pearl", kWhite, 0, 0.36f, -0.25f, kIdentity);

  add(make_rounded_box({0.24f, 0.24f, 0.24f}, 0.045f, kRoundSteps, kStep), "blue cube", kBlue, 0, 0.13f, 0.30f,
      turned(32));
  const OutlineCorner cone[] = {{0, 0}, {0.14f, 0, 0.012f}, {0.012f, 0.36f, 0.017f}, {0, 0.36f}};
  add(make_turned(cone, 96, kStep), "cone", kTeal, 0, 0.58f, 0.22f, kIdentity);

  const OutlineCorner bowl[] = {{0, 0},
                                {0.075f, 0, 0.01f},
                                {0.17f, 0.12f, 0.07f},
                                {0.185f, 0.16f, 0.007f},
                                {0.17f, 0.16f, 0.007f},
                                {0.155f, 0.125f, 0.07f},
                                {0.07f, 0.02f, 0.03f},
                                {0, 0.02f}};
  add(make_turned(bowl, 96, kStep), "bowl", kClay, 0, -0.36f, 0.42f, kIdentity);
  return scene;
}

}  // namespace shlight

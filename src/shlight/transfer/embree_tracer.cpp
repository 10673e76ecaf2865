#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "shlight/core/error.h"
#include "shlight/transfer/merge_fans.h"
#include "shlight/transfer/tracer.h"

namespace shlight {
namespace {

// A Ray is handed to Embree as it lies.
static_assert(sizeof(Ray) == sizeof(RTCRay) && alignof(Ray) == alignof(RTCRay));
static_assert(offsetof(Ray, near) == offsetof(RTCRay, tnear) && offsetof(Ray, direction) == offsetof(RTCRay, dir_x) &&
              offsetof(Ray, far) == offsetof(RTCRay, tfar) && offsetof(Ray, id) == offsetof(RTCRay, id));

class EmbreeTracer final : public Tracer {
 public:
  EmbreeTracer(std::span<const Vec3f> positions, std::span<const std::uint32_t> indices)
      : positions_(positions), indices_(indices), device_(rtcNewDevice(nullptr)) {
    if (!device_) fail();
    scene_ = rtcNewScene(device_);
    // Costs a fifth of the speed. Without it, a few of a hundred rays that meet a wall right beside the vertex which
    // they leave slip between its triangles there: corners of closed rooms see light.
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    // An eighth of what origins keep away from surfaces (contacts.h).
    float largest = 0;
    for (const Vec3f p : positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    fans_ = merge_fans(positions, indices, 0x1p-23f * largest);
    if (!indices.empty()) add_triangles(positions, fans_ ? std::span<const std::uint32_t>(fans_->indices) : indices);
    rtcCommitScene(scene_);
    fail_on_error();
  }
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;
  ~EmbreeTracer() override {
    if (scene_) rtcReleaseScene(scene_);
    if (device_) rtcReleaseDevice(device_);
  }

  void find_occluded(std::span<Ray> rays) const override {
    RTCIntersectContext context = incoherent();
    rtcOccluded1M(scene_, &context, reinterpret_cast<RTCRay*>(rays.data()), static_cast<unsigned>(rays.size()),
                  sizeof(Ray));
  }

  void find_hits(std::span<const Ray> rays, std::span<Hit> hits) const override {
    constexpr std::size_t kBlock = 256;
    std::array<RTCRayHit, kBlock> block;
    RTCIntersectContext context = incoherent();
    for (std::size_t begin = 0; begin < rays.size(); begin += kBlock) {
      const std::size_t count = std::min(kBlock, rays.size() - begin);
      for (std::size_t j = 0; j < count; ++j) {
        block[j].ray = reinterpret_cast<const RTCRay&>(rays[begin + j]);
        block[j].hit.geomID = RTC_INVALID_GEOMETRY_ID;
        block[j].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect1M(scene_, &context, block.data(), static_cast<unsigned>(count), sizeof(RTCRayHit));
      for (std::size_t j = 0; j < count; ++j) {
        const RTCHit& hit = block[j].hit;
        const Hit found = hit.geomID == RTC_INVALID_GEOMETRY_ID ? Hit{} : Hit{hit.primID, hit.u, hit.v};
        hits[begin + j] = fans_ ? unmerge_hit(*fans_, positions_, indices_, found) : found;
      }
    }
  }

 private:
  static RTCIntersectContext incoherent() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
  }

  void add_triangles(std::span<const Vec3f> positions, std::span<const std::uint32_t> indices) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads whole registers, so it wants memory of its own that has room after the last vertex.
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f),
                                             positions.size());
    if (!vertices) {
      rtcReleaseGeometry(geometry);
      fail();
    }
    std::copy(positions.begin(), positions.end(), static_cast<Vec3f*>(vertices));
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0,
                               3 * sizeof(std::uint32_t), indices.size() / 3);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  void fail_on_error() {
    if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE) fail(error);
  }
  [[noreturn]] void fail() { fail(rtcGetDeviceError(device_)); }
  [[noreturn]] void fail(RTCError error) {
    if (scene_) rtcReleaseScene(scene_);
    if (device_) rtcReleaseDevice(device_);
    throw Error("Embree",
                error == RTC_ERROR_OUT_OF_MEMORY
                    ? "out of memory"
                    : fmt::format("cannot make its tree: error {}", static_cast<int>(error)),
                "a scene that fits into memory");
  }

  std::span<const Vec3f> positions_;
  std::span<const std::uint32_t> indices_;
  std::optional<MergedFans> fans_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace

std::unique_ptr<Tracer> make_embree_tracer(std::span<const Vec3f> positions, std::span<const std::uint32_t> indices) {
  return std::make_unique<EmbreeTracer>(positions, indices);
}

}  // namespace shlight

#include "shlight/transfer/baked_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/sh/coefficients.h"
#include "shlight/sh/convention_text.h"
#include "shlight/transfer/glb.h"

namespace shlight {
namespace {

constexpr std::pair<TransferKind, std::string_view> kKinds[] = {{TransferKind::kCosine, "cosine"},
                                                                {TransferKind::kShadowed, "shadowed"},
                                                                {TransferKind::kInterreflected, "interreflected"}};
constexpr std::pair<TransferMethod, std::string_view> kMethods[] = {{TransferMethod::kBest, "best"},
                                                                    {TransferMethod::kMonteCarlo, "monte-carlo"}};

template <class Value, std::size_t n>
std::string_view name_in(const std::pair<Value, std::string_view> (&table)[n], Value value) {
  for (const auto& [entry, name] : table)
    if (entry == value) return name;
  return "";
}

template <class Value, std::size_t n>
std::optional<Value> find_in(const std::pair<Value, std::string_view> (&table)[n], std::string_view name) {
  for (const auto& [value, entry] : table)
    if (entry == name) return value;
  return {};
}

}  // namespace

std::string_view to_text(TransferKind kind) {
  return name_in(kKinds, kind);
}
std::optional<TransferKind> find_transfer_kind(std::string_view name) {
  return find_in(kKinds, name);
}
std::string_view to_text(TransferMethod method) {
  return name_in(kMethods, method);
}
std::optional<TransferMethod> find_transfer_method(std::string_view name) {
  return find_in(kMethods, name);
}

std::string transfer_attribute(int channels, int channel, int k) {
  return channels == 1 ? fmt::format("_SH_TRANSFER_{}", k) : fmt::format("_SH_TRANSFER_{}_{}", "RGB"[channel], k);
}

int num_transfer_attributes(int bands) {
  return (num_coefficients(bands) + 3) / 4;
}

std::string pca_attribute(int k) {
  return fmt::format("_SH_PCA_{}", k);
}

int num_pca_attributes(int components) {
  return (components + 4) / 4;
}

nlohmann::ordered_json baked_convention() {
  return {{"basis", convention::kBasis},
          {"condon_shortley_phase", convention::kCondonShortleyPhase},
          {"index", convention::kIndex},
          {"polynomials", convention::kPolynomials},
          {"frame", fmt::format("{}, of the world and not of the node", convention::kFrame)},
          {"quantity",
           "transfer: radiance of a vertex = base color * sum of light's coefficients of radiance * these; "
           "1/pi is in it, the base color is not"},
          {"color", convention::kColor}};
}

namespace {

// Ambient occlusion and bent normal.
constexpr std::size_t kOtherBytes = sizeof(float) + sizeof(Vec3f);

}  // namespace

std::size_t baked_bytes_per_vertex(int bands, int channels, int bits) {
  const auto coefficients = static_cast<std::size_t>(4 * channels * num_transfer_attributes(bands));
  return coefficients * static_cast<std::size_t>(bits) / 8 + kOtherBytes;
}

std::size_t baked_pca_bytes_per_vertex(int components) {
  return 4 * sizeof(std::int16_t) * static_cast<std::size_t>(num_pca_attributes(components)) + kOtherBytes;
}

std::size_t pca_table_bytes(int bands, int channels, int clusters, int components) {
  return sizeof(float) * static_cast<std::size_t>(clusters) * static_cast<std::size_t>(components + 1) *
         static_cast<std::size_t>(channels * num_coefficients(bands));
}

double baked_bytes_per_vertex(const Transfer& transfer, const BakeInfo& info) {
  if (!info.pca) return static_cast<double>(baked_bytes_per_vertex(transfer.bands, transfer.channels, info.bits));
  const auto vertices = static_cast<double>(std::max<std::size_t>(1, transfer.num_vertices()));
  return static_cast<double>(baked_pca_bytes_per_vertex(info.pca->components)) +
         static_cast<double>(sizeof(float) * info.pca->table.size()) / vertices;
}

std::uint64_t estimate_baked_bytes(const Scene& scene, int bands, int channels, int bits,
                                   const std::optional<PcaParams>& pca) {
  constexpr std::uint64_t kJsonBytes = 1 << 12, kAccessorBytes = 200;
  const auto accessors = static_cast<std::uint64_t>(channels * num_transfer_attributes(bands) + 8);
  std::uint64_t bytes = kJsonBytes + scene.instances.size() * accessors * kAccessorBytes;
  bytes += num_vertices(scene) *
           (pca ? baked_pca_bytes_per_vertex(pca->components) : baked_bytes_per_vertex(bands, channels, bits));
  if (pca) bytes += pca_table_bytes(bands, channels, num_pca_clusters(*pca, num_vertices(scene)), pca->components);
  for (const Mesh& mesh : scene.meshes)
    bytes += sizeof(Vec3f) * (mesh.positions.size() + mesh.normals.size() + mesh.colors.size()) +
             sizeof(Vec2f) * mesh.texcoords.size() + sizeof(std::uint32_t) * mesh.indices.size();
  return bytes;
}

void check_savable(const std::filesystem::path& path, const Scene& scene, const BakeInfo& info,
                   const std::optional<PcaParams>& pca) {
  check_writable(path);
  const int channels = info.params.kind == TransferKind::kInterreflected ? 3 : 1;
  const std::uint64_t bytes = estimate_baked_bytes(scene, info.params.bands, channels, info.bits, pca);
  if (bytes > kMaxGlbBytes)
    throw Error(path.string(), fmt::format("would hold about {} bytes", bytes),
                fmt::format("at most {}: fewer bands, or parts of the scene in files of their own", kMaxGlbBytes));
}

bool is_baked_file(const std::filesystem::path& path) {
  constexpr std::size_t kJsonAt = 20;  // after the headers of file and chunk
  std::array<char, kJsonAt + kBakedHead.size()> head = {};
  // Opening a pipe would wait for whoever writes into it.
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  const std::string_view text(head.data(), head.size());
  return file && text.starts_with("glTF") && text.substr(kJsonAt) == kBakedHead;
}

}  // namespace shlight

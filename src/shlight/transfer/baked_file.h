#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shlight/scene/scene.h"
#include "shlight/transfer/clustered_pca.h"
#include "shlight/transfer/transfer.h"

// Baked files: a scene and its transfer as one binary glTF file, which every viewer of such files shows as a model and
// which shlight can light. docs/baked-files.md describes the format for other readers.

namespace shlight {

// What there is to know about a bake beside its result.
struct BakeInfo {
  BakeParams params;  // what it was baked with; threads, tracer and checkpoint are not kept
  std::string model;  // what was baked, in words for people
  int bits = 32;      // of each coefficient in the file: 32 for floats as they are, 16 or 8 (quantise.h)
  std::optional<ClusteredPca> pca = {};  // what the file holds in the place of coefficients; then bits is 16
};

struct Baked {
  Scene scene;  // as it was baked, without meshes that no instance shows; names that are no UTF-8 are mended
  Transfer transfer;
  BakeInfo info;
};

// Writes a baked file whole or not at all. `transfer` is bake_transfer's of `scene`. Every float comes back with the
// bits it had, but for coefficients of fewer than 32 bits, which come back as quantise_transfer has them, or as
// pca_coefficients of info.pca, which is compress_pca's of `transfer`. Seconds are not kept: the same bake is the same
// file. Throws Error, also where a mesh is shown that has no triangle, or where the file would be larger than 4 GiB.
void save_baked(const std::filesystem::path& path, const Scene& scene, const Transfer& transfer, const BakeInfo& info);

// The bytes of that file. `name` is used in errors.
std::vector<std::byte> format_baked(const Scene& scene, const Transfer& transfer, const BakeInfo& info,
                                    const std::string& name);

// Reads a baked file, which may come from anybody: what comes back keeps all that scene.h and transfer.h promise, and
// takes no more than a few times the memory of file and coefficients. Throws Error where the file was cut short or
// changed by anything but save_baked, or is of another version.
Baked load_baked(const std::filesystem::path& path);
Baked load_baked(std::span<const std::byte> bytes, const std::string& name);

// Whether a file begins as save_baked's do. Such a file is not only a model, or not one that can be read.
bool is_baked_file(const std::filesystem::path& path);

// Whether a bake of the scene with these params would give the same transfer again.
inline bool still_fits(const Transfer& transfer, const Scene& scene, const BakeParams& params) {
  return transfer.hash == hash_bake(scene, params);
}

// What a baked file holds for each vertex beside its mesh: transfer, ambient occlusion, bent normal.
// With clustered PCA that is of `components`, and the table of all clusters has pca_table_bytes beside it.
std::size_t baked_bytes_per_vertex(int bands, int channels, int bits = 32);
std::size_t baked_pca_bytes_per_vertex(int components);
std::size_t pca_table_bytes(int bands, int channels, int clusters, int components);
// With each vertex's share of the table.
double baked_bytes_per_vertex(const Transfer& transfer, const BakeInfo& info);

// Throws the Error that save_baked would, as far as can be told before baking: the folder is not there, or not
// writable, or the file would be larger than 4 GiB. `pca` is what info.pca is going to be made with.
void check_savable(const std::filesystem::path& path, const Scene& scene, const BakeInfo& info,
                   const std::optional<PcaParams>& pca = {});

// "cosine", "shadowed", "interreflected"; nothing where there is no such kind.
std::string_view to_text(TransferKind kind);
std::optional<TransferKind> find_transfer_kind(std::string_view name);
// "best", "monte-carlo".
std::string_view to_text(TransferMethod method);
std::optional<TransferMethod> find_transfer_method(std::string_view name);

}  // namespace shlight

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "shlight/transfer/baked_file.h"

// What the writer and the reader of baked files share; not installed.

namespace shlight {

inline constexpr int kBakedVersion = 1;
// The head of the JSON text of every version, by which baked files are known.
inline constexpr std::string_view kBakedHead = "{\"asset\":{\"extras\":{\"shlight\":{\"version\":";

// glTF's numbers for things.
inline constexpr int kGltfByte = 5120, kGltfShort = 5122, kGltfFloat = 5126, kGltfUnsignedInt = 5125,
                     kGltfArrayBuffer = 34962, kGltfElementBuffer = 34963;

// Where its factor is 0, a material is Lambertian: it has no gloss.
inline constexpr const char* kSpecularExtension = "KHR_materials_specular";

inline constexpr const char* kOcclusionAttribute = "_AMBIENT_OCCLUSION";
inline constexpr const char* kBentNormalAttribute = "_BENT_NORMAL";
// "_SH_TRANSFER_2", or "_SH_TRANSFER_R_2" where there are three channels: coefficients 4k … 4k+3.
std::string transfer_attribute(int channels, int channel, int k);
// How many of them a channel has; the last is filled up with zeros.
int num_transfer_attributes(int bands);

// "_SH_PCA_2": numbers 4k … 4k+3 of a vertex's code, cluster and weights, and how many of them there are; the last is
// filled up with zeros.
std::string pca_attribute(int k);
int num_pca_attributes(int components);

// About how large a file becomes, its textures apart.
std::uint64_t estimate_baked_bytes(const Scene& scene, int bands, int channels, int bits = 32,
                                   const std::optional<PcaParams>& pca = {});

// The convention of light's coefficient files, but for the quantity.
nlohmann::ordered_json baked_convention();

}  // namespace shlight

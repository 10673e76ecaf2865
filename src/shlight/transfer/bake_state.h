#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace shlight {

// What a bake has done so far: all that it needs to go on, and what a checkpoint holds.
struct BakeState {
  std::uint64_t hash = 0;                         // hash_bake of what is baked
  double density = 0;                             // of the adaptive plan, 0 while it is not chosen or not wanted
  double estimated_error = 0;                     // known when pass 0 is done
  std::uint64_t pass = 0;                         // 0: occlusion; b: bounce b
  std::uint64_t batches_done = 0;                 // of this pass
  std::uint64_t rays = 0;                         // of all passes
  std::vector<float> direct;                      // bands² a site: shadowed transfer
  std::vector<float> total, previous, next;       // 3 bands² a site: all light, the last whole bounce, the one in work
  std::vector<std::vector<std::uint8_t>> packed;  // of each batch, what pack_occlusion made

  bool operator==(const BakeState&) const = default;
};

// Writes it whole or not at all. Throws Error.
void save_checkpoint(const std::filesystem::path& path, const BakeState& state);

// Reads what save_checkpoint wrote, with as many values and batches as `fresh`, a state in which nothing is done, has
// room for. Throws Error where the file is something else, is damaged, or was made for something else than `fresh`.
BakeState load_checkpoint(const std::filesystem::path& path, const BakeState& fresh);

}  // namespace shlight

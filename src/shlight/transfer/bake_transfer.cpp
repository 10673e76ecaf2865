#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "shlight/core/error.h"
#include "shlight/sh/coefficients.h"
#include "shlight/transfer/cosine_transfer.h"
#include "shlight/transfer/transfer.h"
#include "shlight/transfer/world_mesh.h"

namespace shlight {

Transfer bake_transfer(const Scene& scene, const BakeParams& params, const BakeWatcher&) {
  if (params.kind != TransferKind::kCosine) throw Error("transfer", "of that kind is not there yet", "cosine");
  const auto begin = std::chrono::steady_clock::now();
  WorldMesh world = make_world_mesh(scene);
  Transfer transfer;
  transfer.kind = params.kind;
  transfer.bands = params.bands;
  transfer.first_vertex = world.first_vertex;
  const std::size_t vertices = world.positions.size();
  transfer.coefficients.resize(vertices * static_cast<std::size_t>(num_coefficients(params.bands)));
  if (params.method == TransferMethod::kMonteCarlo)
    sample_cosine_transfer(params.bands, world.normals, params.samples, params.seed, transfer.coefficients,
                           params.threads);
  else
    eval_cosine_transfer(params.bands, world.normals, transfer.coefficients, params.threads);
  transfer.ambient_occlusion.assign(vertices, 1);
  transfer.bent_normals = std::move(world.normals);
  transfer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return transfer;
}

}  // namespace shlight

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "command.h"
#include "shlight/core/error.h"
#include "shlight/core/process.h"
#include "shlight/scene/load_scene.h"
#include "shlight/transfer/baked_file.h"
#include "shlight/transfer/clustered_pca.h"
#include "shlight/transfer/quantise.h"

namespace shlight::app {
namespace {

// How coefficients are stored: in so many bits, or as clustered principal components.
struct Compression {
  std::string name = "none";
  int bits = 32;
  std::optional<PcaParams> pca;
};

// "16", "8", "pca" or "pca:CLUSTERSxCOMPONENTS"
std::string parse_compression(const std::string& text, Compression& compression) {
  compression.name = text;
  compression.bits = text == "8" ? 8 : 16;
  if (text == "16" || text == "8") return "";
  PcaParams& pca = compression.pca.emplace();
  if (text == "pca") return "";
  int end = 0;
  if (std::sscanf(text.c_str(), "pca:%5dx%5d%n", &pca.clusters, &pca.components, &end) != 2 ||
      end != static_cast<int>(text.size()))
    return fmt::format("'{}' is none of 16, 8, pca and pca:CLUSTERSxCOMPONENTS such as pca:64x7", text);
  if (pca.clusters < 1 || pca.clusters > kMaxPcaClusters || pca.components < 1 || pca.components > kMaxPcaComponents)
    return fmt::format("'{}' is not of 1 to {} clusters and 1 to {} components", text, kMaxPcaClusters,
                       kMaxPcaComponents);
  return "";
}

struct BakeArguments {
  std::string model;
  std::filesystem::path output;
  BakeParams params;
  Compression compression;
  bool json = false;
};

// Shows how far the bake is on stderr where that is a terminal, keeps the last status, and stops where the user asked.
BakeWatcher watch_bake(BakeStatus& last) {
  return [&last, terminal = ::isatty(STDERR_FILENO) != 0](const BakeStatus& status) {
    last = status;
    if (terminal) {
      fmt::print(stderr, "\rbaking: {}\033[K{}", to_text(status), status.fraction_done >= 1 ? "\r\033[K" : "");
      std::fflush(stderr);
    }
    return !stop_requested();
  };
}

// The bake, from where an earlier one was stopped, if it was.
Transfer bake(const Scene& scene, const BakeParams& params, BakeStatus& status) {
  std::error_code ignored;
  // Told once the checkpoint has been found to be good.
  bool to_tell = std::filesystem::exists(params.checkpoint, ignored);
  try {
    return bake_transfer(scene, params, [&, watcher = watch_bake(status)](const BakeStatus& now) {
      if (now.fraction_done > 0 && std::exchange(to_tell, false))
        spdlog::info("{}: goes on from where an earlier bake stopped", params.checkpoint.string());
      return watcher(now);
    });
  } catch (const Cancelled&) {
    if (std::filesystem::exists(params.checkpoint, ignored))
      spdlog::info("{}: holds what is done; the same command goes on from there", params.checkpoint.string());
    throw;
  }
}

// What the file will hold of `transfer`.
Transfer stored_transfer(const Transfer& transfer, const BakeInfo& info) {
  if (!info.pca) return quantise_transfer(transfer, info.bits);
  Transfer stored = transfer;
  stored.coefficients = pca_coefficients(*info.pca);
  return stored;
}

// What storing it costs under the built-in lights from several sides, in the worst case.
ShadingError worst_shading_error(const Transfer& transfer, const Transfer& stored) {
  ShadingError worst;
  for (const char* name : {"builtin:sky", "builtin:studio", "builtin:axes", "builtin:thesis"}) {
    const RgbCoefficients light = load_light(name).light->project(transfer.bands);
    for (const double turn : {0.0, 1.3, 2.6, 3.9}) {
      const Rotation rotation = rotation_zyz(turn, 2 * turn, 3 * turn);
      const ShadingError error = measure_shading_error(transfer, stored, rotate(rotation, light));
      worst = {std::max(worst.rms, error.rms), std::max(worst.max, error.max)};
    }
  }
  return worst;
}

void run_bake(const BakeArguments& arguments) {
  const Scene scene = make_scene(arguments.model);
  for (const std::string& warning : scene.warnings) spdlog::warn("{}: {}", arguments.model, warning);
  BakeParams params = arguments.params;
  params.checkpoint = arguments.output.string() + ".checkpoint";
  BakeInfo info = {params, arguments.model, arguments.compression.bits, {}};
  std::optional<PcaParams> pca = arguments.compression.pca;
  if (pca) pca->threads = params.threads;
  // Not after hours of baking.
  check_savable(arguments.output, scene, info, pca);

  BakeStatus status;
  const Transfer transfer = bake(scene, params, status);
  if (pca) info.pca = compress_pca(transfer, *pca);
  save_baked(arguments.output, scene, transfer, info);
  std::error_code error;
  std::filesystem::remove(params.checkpoint, error);
  if (error) spdlog::warn("{}: cannot be deleted ({})", params.checkpoint.string(), error.message());

  const double rays_per_second = transfer.seconds > 0 ? static_cast<double>(status.rays) / transfer.seconds : 0;
  const double bytes_per_vertex = baked_bytes_per_vertex(transfer, info);
  const std::uint64_t peak_bytes = peak_memory();
  spdlog::info(
      "{}: {} transfer of {} vertices, {} bands, {:.4g} bytes a vertex, {:.3g} million rays in {:.3g} s, {:.3g} MB of "
      "memory at most",
      arguments.output.string(), to_text(transfer.kind), transfer.num_vertices(), transfer.bands, bytes_per_vertex,
      1e-6 * static_cast<double>(transfer.rays), transfer.seconds, 1e-6 * static_cast<double>(peak_bytes));
  ShadingError cost;
  if (info.bits < 32) {
    cost = worst_shading_error(transfer, stored_transfer(transfer, info));
    spdlog::info("{} change the radiance under built-in lights by {:.2g} at most (root mean square), {:.2g} at worst",
                 describe_storage(info), cost.rms, cost.max);
  }
  if (arguments.json)
    print_json({{"file", arguments.output.string()},
                {"transfer", to_text(transfer.kind)},
                {"bands", transfer.bands},
                {"channels", transfer.channels},
                {"vertices", transfer.num_vertices()},
                {"triangles", num_triangles(scene)},
                {"rays", transfer.rays},
                {"estimated_error", transfer.estimated_error},
                {"seconds", transfer.seconds},
                {"rays_per_second", rays_per_second},
                {"peak_bytes", peak_bytes},
                {"bytes_per_vertex", bytes_per_vertex},
                {"transfer_bytes_per_vertex", bytes_per_vertex - static_cast<double>(baked_bytes_per_vertex(0, 1))},
                {"compress", arguments.compression.name},
                {"bits", info.bits},
                {"clusters", info.pca ? info.pca->clusters : 0},
                {"components", info.pca ? info.pca->components : 0},
                {"shading_error", {{"rms", cost.rms}, {"max", cost.max}}},
                {"file_bytes", std::filesystem::file_size(arguments.output)},
                {"hash", fmt::format("{:016x}", transfer.hash)}});
}

// What only some of the options' combinations mean.
void check_options(const CLI::App& command, const BakeParams& params) {
  const bool monte_carlo = params.method == TransferMethod::kMonteCarlo;
  if (monte_carlo && params.kind == TransferKind::kInterreflected)
    throw CLI::ValidationError("--method", "monte-carlo bakes cosine and shadowed transfer only");
  if (monte_carlo && params.samples == 0)
    throw CLI::ValidationError("--samples", "monte-carlo needs a number of samples");
  if (!monte_carlo && params.kind == TransferKind::kCosine && params.samples > 0)
    throw CLI::ValidationError("--samples", "cosine transfer is exact and takes none, but for --method monte-carlo");
  if (command.count("--bounces") > 0 && params.kind != TransferKind::kInterreflected)
    throw CLI::ValidationError("--bounces", "only with --transfer interreflected");
}

}  // namespace

void add_bake(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("bake", "Bake a model's transfer into a .glb that any light can light");
  const auto arguments = std::make_shared<BakeArguments>();
  BakeParams& params = arguments->params;
  command->add_option("MODEL", arguments->model, kModelHelp)->required();
  command->add_option("-o,--output", arguments->output, "Where to write; FILE.glb.checkpoint beside it while it bakes")
      ->required()
      ->type_name("FILE.glb")
      ->check(CLI::Validator(
          [](std::string& name) { return name.ends_with(".glb") ? "" : "'" + name + "' does not end in .glb"; }, ""));
  add_bake_options(*command, params);
  command->add_option("--bands", params.bands, "Bands n: n*n coefficients of degrees 0 … n-1 for each vertex")
      ->capture_default_str()
      ->check(CLI::Range(1, kMaxTransferBands).description(fmt::format("1 to {}", kMaxTransferBands)));
  command
      ->add_option_function<std::string>(
          "--compress",
          [arguments](const std::string& text) {
            if (const std::string wrong = parse_compression(text, arguments->compression); !wrong.empty())
              throw CLI::ValidationError("--compress", wrong);
          },
          "Bits of a coefficient, 16 or 8 instead of a float's 32; or principal components of clusters of vertices: by "
          "itself, 256 clusters of 11, fewer for few vertices. Says what it costs")
      ->type_name("16|8|pca[:CLUSTERSxCOMPONENTS]");
  const std::map<std::string, TransferMethod> methods = {{"best", TransferMethod::kBest},
                                                         {"monte-carlo", TransferMethod::kMonteCarlo}};
  command->add_option("--method", params.method, "The best there is for each kind, or the thesis's random samples")
      ->transform(CLI::CheckedTransformer(methods).description(""))
      ->type_name("best|monte-carlo")
      ->default_str("best");
  command->add_option("--seed", params.seed, "Another seed, other samples")->capture_default_str();
  command->add_option("--threads", params.threads, "0: all; the result is the same for any number")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024).description("0 to 1024"));
  command
      ->add_option("--checkpoint", params.checkpoint_seconds,
                   "Note down what is done every so many seconds, to go on from there even after a crash")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->check(number_from(0, 1e9).description(""));
  command->add_flag("--json", arguments->json, "Print on stdout what it took, as JSON");
  command->footer(
      "Examples:\n  shlight bake statue.obj -o statue.glb\n"
      "  shlight bake builtin:scene -o scene.glb --transfer interreflected --bands 5 --bounces 3\n"
      "  shlight bake statue.obj -o small.glb --compress pca:64x7\n"
      "Stopped with Ctrl-C, the same command goes on from where it was.");
  command->callback([command, arguments, &run] {
    check_options(*command, arguments->params);
    run = [arguments] { run_bake(*arguments); };
  });
}

}  // namespace shlight::app

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <charconv>

#include "command.h"

namespace shlight::app {
namespace {

// "auto" or a number; 0 is auto
std::string parse_samples(const std::string& text, int& samples) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const bool number = error == std::errc() && stop == end && value >= 1 && value <= kMaxTransferSamples;
  if (!number && text != "auto")
    return fmt::format("'{}' is neither auto nor a number from 1 to {}", text, kMaxTransferSamples);
  samples = value;
  return "";
}

}  // namespace

void add_bake_options(CLI::App& command, BakeParams& params) {
  std::map<std::string, TransferKind> kinds;
  for (const TransferKind kind : {TransferKind::kCosine, TransferKind::kShadowed, TransferKind::kInterreflected})
    kinds.emplace(to_text(kind), kind);
  command
      .add_option("--transfer", params.kind, "What is baked: no shadows, shadows, or those and light between surfaces")
      ->transform(CLI::CheckedTransformer(kinds).description(""))
      ->type_name("cosine|shadowed|interreflected")
      ->default_str(std::string(to_text(params.kind)));
  command
      .add_option_function<std::string>(
          "--samples",
          [&params](const std::string& text) {
            if (const std::string wrong = parse_samples(text, params.samples); !wrong.empty())
              throw CLI::ValidationError("--samples", wrong);
          },
          "Rays a vertex; auto: as many as each needs")
      ->type_name("N|auto")
      ->default_str("auto");
  command.add_option("--bounces", params.bounces, "Of light between surfaces")
      ->capture_default_str()
      ->check(CLI::Range(0, 64).description("0 to 64"));
}

void check_bake_options(const CLI::App& command, const BakeParams& params) {
  if (command.count("--samples") > 0 && params.kind == TransferKind::kCosine)
    throw CLI::ValidationError("--samples", "cosine transfer is exact and takes none");
  if (command.count("--bounces") > 0 && params.kind != TransferKind::kInterreflected)
    throw CLI::ValidationError("--bounces", "only with --transfer interreflected");
}

std::string describe_storage(const BakeInfo& info) {
  return info.pca ? fmt::format("{} clusters of {} components", info.pca->clusters, info.pca->components)
                  : fmt::format("{} bits", info.bits);
}

Transfer bake_aloud(const std::string& model, const Scene& scene, const BakeParams& params) {
  const Progress bar = progress_bar("baking");
  const Transfer transfer =
      bake_transfer(scene, params, [&bar](const BakeStatus& status) { return bar(status.fraction_done); });
  report_progress(bar, 1);
  spdlog::info("{}: {} transfer of {} vertices, {} bands, {:.3g} million rays in {:.3g} s", model,
               to_text(transfer.kind), transfer.num_vertices(), transfer.bands,
               1e-6 * static_cast<double>(transfer.rays), transfer.seconds);
  return transfer;
}

}  // namespace shlight::app

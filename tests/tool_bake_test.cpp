// shlight bake, and shlight info of what it writes.

#include <gtest/gtest.h>

#include "shlight/scene/builtin_scene.h"
#include "shlight/scene/load_scene.h"
#include "shlight/transfer/baked_file.h"
#include "shlight/transfer/transfer_test_util.h"
#include "tool_test_util.h"

namespace shlight {
namespace {

class ToolBake : public ToolTest {};

TEST_F(ToolBake, WritesWhatTheLibraryBakes) {
  const std::string file = path("sphere.glb");
  const auto json = run_json({"bake", "builtin:sphere", "-o", file, "--transfer", "cosine", "--bands", "4"});
  const Scene scene = make_sphere_scene();
  EXPECT_EQ(json["vertices"], num_vertices(scene));
  EXPECT_EQ(json["triangles"], num_triangles(scene));
  EXPECT_EQ(json["bytes_per_vertex"], baked_bytes_per_vertex(4, 1));
  EXPECT_EQ(json["file_bytes"], std::filesystem::file_size(file));
  for (const char* key : {"rays", "seconds", "rays_per_second"}) EXPECT_TRUE(json[key].is_number()) << key;
  // At least what the file holds, since it is put together in memory; and a sphere's is nothing like a gigabyte.
  EXPECT_GT(json["peak_bytes"], json["file_bytes"]);
  EXPECT_LT(json["peak_bytes"], 1e9);
  EXPECT_EQ(contents().size(), 1u) << "no checkpoint is left";

  const Baked baked = load_baked(file);
  const Transfer transfer = bake_transfer(scene, make_cosine_params(4));
  EXPECT_EQ(baked.transfer.coefficients, transfer.coefficients);
  EXPECT_EQ(baked.info.params.kind, TransferKind::kCosine);
  EXPECT_EQ(baked.info.model, "builtin:sphere");
}

TEST_F(ToolBake, InfoTellsEverything) {
  const std::string file = path("scene.glb");
  const auto bake = run_json({"bake", "builtin:scene", "-o", file, "--transfer", "cosine", "--bands", "3"});
  const auto info = run_json({"info", file});
  const auto model = run_json({"info", "builtin:scene"});
  EXPECT_EQ(info["kind"], "baked");
  EXPECT_EQ(info["transfer"], "cosine");
  EXPECT_EQ(info["model"], "builtin:scene");
  EXPECT_EQ(info["bands"], 3);
  EXPECT_EQ(info["channels"], 1);
  EXPECT_EQ(info["settings"]["method"], "best");
  for (const char* key : {"vertices", "triangles", "meshes", "instances", "materials", "bounds_min", "bounds_max"})
    EXPECT_EQ(info[key], model[key]) << key;
  for (const char* key : {"vertices", "rays", "estimated_error", "hash", "bytes_per_vertex"})
    EXPECT_EQ(info[key], bake[key]) << key;
}

// Half and a quarter of the bytes, for errors of about one step: 1/32767 and 1/127 of the largest coefficients.
TEST_F(ToolBake, FewerBitsCostLittle) {
  const std::vector<std::string> bake = {"bake", "builtin:sphere", "-o", path("a.glb"), "--transfer", "cosine"};
  const auto with = [&](const std::string& bits) {
    std::vector<std::string> arguments = bake;
    arguments.insert(arguments.end(), {"--compress", bits});
    return run_json(arguments);
  };
  const auto half = with("16"), quarter = with("8"), whole = run_json(bake);
  EXPECT_EQ(whole["bytes_per_vertex"], 7 * 16 + 16);
  EXPECT_EQ(half["bytes_per_vertex"], 7 * 8 + 16);
  EXPECT_EQ(quarter["bytes_per_vertex"], 7 * 4 + 16);
  EXPECT_EQ(whole["shading_error"]["max"], 0);
  EXPECT_LT(half["shading_error"]["rms"].get<double>(), 1e-4);
  EXPECT_LT(quarter["shading_error"]["rms"].get<double>(), 2e-2);
  EXPECT_GT(quarter["shading_error"]["rms"].get<double>(), half["shading_error"]["rms"].get<double>());
}

// Clusters of vertices for the bytes of a few coefficients; what the file holds is what was measured.
TEST_F(ToolBake, ClusteredPcaCostsLittle) {
  const std::string file = path("a.glb");
  const std::vector<std::string> bake = {"bake", "builtin:sphere", "-o", file, "--transfer", "cosine"};
  const auto with = [&](const std::string& compression) {
    std::vector<std::string> arguments = bake;
    arguments.insert(arguments.end(), {"--compress", compression});
    return run_json(arguments);
  };
  const auto little = with("pca:8x3"), more = with("pca:32x7"), usual = with("pca");
  EXPECT_EQ(little["bits"], 16);
  EXPECT_EQ(little["clusters"], 8);
  EXPECT_EQ(usual["clusters"], num_pca_clusters({}, usual["vertices"].get<std::size_t>()));
  EXPECT_EQ(usual["components"], PcaParams().components);
  const double vertices = little["vertices"].get<double>();
  EXPECT_NEAR(little["bytes_per_vertex"].get<double>(), 8 + 16 + 8 * 4 * 25 * 4 / vertices, 1e-9);
  EXPECT_NEAR(little["transfer_bytes_per_vertex"].get<double>(), 8 + 8 * 4 * 25 * 4 / vertices, 1e-9);
  EXPECT_LT(little["shading_error"]["rms"].get<double>(), 0.1);
  EXPECT_LT(more["shading_error"]["rms"].get<double>(), 4e-3);
  EXPECT_LT(usual["shading_error"]["rms"].get<double>(), 1e-3);
  EXPECT_GT(usual["shading_error"]["rms"].get<double>(), 0);

  const auto info = run_json({"info", file});
  for (const char* key : {"clusters", "components", "bits", "bytes_per_vertex", "vertices"})
    EXPECT_EQ(info[key], usual[key]) << key;
  const Baked baked = load_baked(file);
  const Transfer transfer = bake_transfer(make_sphere_scene(), make_cosine_params(5));
  ASSERT_TRUE(baked.info.pca);
  EXPECT_EQ(baked.transfer.coefficients, pca_coefficients(compress_pca(transfer)));
}

TEST_F(ToolBake, TellsWhetherItFits) {
  const std::string model = write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  run({"bake", model, "-o", path("a.glb"), "--transfer", "cosine", "--compress", "8"});
  EXPECT_EQ(run_json({"info", path("a.glb"), "--fits", model})["fits"], true);
  EXPECT_FALSE(run_json({"info", path("a.glb")}).contains("fits"));
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  const ToolRun changed = run({"info", path("a.glb"), "--fits", model, "--json"});
  EXPECT_EQ(nlohmann::json::parse(changed.out)["fits"], false);
  EXPECT_NE(changed.err.find("no longer fits " + model), std::string::npos) << changed;
  expect_refused({"info", model, "--fits", model}, model, "is no baked file");
}

// What is baked is a MODEL to every command, baking too.
TEST_F(ToolBake, ABakedFileIsAModel) {
  run({"bake", "builtin:knot", "-o", path("a.glb"), "--transfer", "cosine", "--bands", "2"});
  const Scene scene = load_scene(path("a.glb"));
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(num_triangles(scene), num_triangles(make_knot_scene()));
  run({"bake", path("a.glb"), "-o", path("b.glb"), "--transfer", "cosine", "--bands", "2"});
  const Transfer a = load_baked(path("a.glb")).transfer, b = load_baked(path("b.glb")).transfer;
  EXPECT_EQ(a.coefficients.size(), b.coefficients.size());
}

// The convention is that of coefficient files, key for key, but for what is measured.
TEST_F(ToolBake, ConventionIsThatOfCoefficientFiles) {
  run({"bake", "builtin:sphere", "-o", path("a.glb"), "--transfer", "cosine"});
  const std::string text = text_of(path("a.glb"));
  auto light = run_json({"project", "builtin:axes"})["convention"];
  light.erase("quantity");
  light.erase("frame");
  for (const auto& [key, value] : light.items())
    EXPECT_NE(text.find("\"" + key + "\":" + value.dump()), std::string::npos) << key;
}

TEST_F(ToolBake, WhatCannotBeWrittenIsToldBeforeBaking) {
  std::filesystem::create_directory(folder_ / "folder.glb");
  for (const auto& [output, wrong] : {std::pair{path("missing/a.glb"), "cannot be written ("},
                                      {path("folder.glb"), "is not a regular file"},
                                      {std::string("/proc/a.glb"), "cannot be written ("}})
    // Were it baked first, this would take hours.
    expect_refused({"bake", "builtin:scene", "-o", output, "--transfer", "cosine", "--method", "monte-carlo",
                    "--samples", "65536", "--bands", "16"},
                   output, wrong);
}

TEST_F(ToolBake, AFailureLeavesTheOldFile) {
  const std::string file = write("a.glb", "old");
  expect_refused({"bake", path("missing.obj"), "-o", file}, path("missing.obj"), "is not there");
  expect_refused({"bake", write("empty.obj", "v 0 0 0\n"), "-o", file}, path("empty.obj"), "");
  EXPECT_EQ(text_of(file), "old");
  run({"bake", "builtin:sphere", "-o", file, "--transfer", "cosine"});
  EXPECT_TRUE(is_baked_file(file));
}

TEST_F(ToolBake, DamagedFilesAreRefused) {
  run({"bake", "builtin:sphere", "-o", path("a.glb"), "--transfer", "cosine", "--bands", "2"});
  std::string file = text_of(path("a.glb"));
  expect_refused({"info", write("cut.glb", file.substr(0, file.size() / 2))}, path("cut.glb"), "is cut short");
  file[file.size() / 2] ^= 1;
  expect_refused({"info", write("changed.glb", file)}, path("changed.glb"), "has been changed");
  file = text_of(path("a.glb"));
  const std::string version = "{\"shlight\":{\"version\":1";
  const std::size_t at = file.find(version);
  ASSERT_NE(at, std::string::npos);
  file[at + version.size() - 1] = '7';
  expect_refused({"info", write("new.glb", file)}, path("new.glb"), "is of version 7");
}

TEST_F(ToolBake, WrongUsageIsExplained) {
  const std::string glb = path("a.glb");
  for (const auto& [arguments, named] :
       {std::pair<std::vector<std::string>, std::string>{{}, "MODEL is required"},
        {{"builtin:sphere"}, "--output is required"},
        {{"builtin:sphere", "-o", path("a.gltf")}, "does not end in .glb"},
        {{"builtin:sphere", "-o", glb, "--transfer", "lit"}, "lit"},
        {{"builtin:sphere", "-o", glb, "--bands", "17"}, "--bands: Value 17 not in range 1 to 16"},
        {{"builtin:sphere", "-o", glb, "--samples", "0"}, "'0' is neither auto nor a number"},
        {{"builtin:sphere", "-o", glb, "--method", "monte-carlo"}, "monte-carlo needs a number of samples"},
        {{"builtin:sphere", "-o", glb, "--transfer", "cosine", "--samples", "9"}, "takes none"},
        {{"builtin:sphere", "-o", glb, "--compress", "12"}, "'12' is none of 16, 8, pca"},
        {{"builtin:sphere", "-o", glb, "--compress", "pca:8"}, "'pca:8' is none of 16, 8, pca"},
        {{"builtin:sphere", "-o", glb, "--compress", "pca:0x3"}, "'pca:0x3' is not of 1 to 2048 clusters"},
        {{"builtin:sphere", "-o", glb, "--compress", "pca:8x32"}, "and 1 to 31 components"},
        {{"builtin:sphere", "-o", glb, "--checkpoint", "-1"}, "--checkpoint"},
        {{"builtin:sphere", "-o", glb, "--bounces", "2"}, "only with --transfer interreflected"},
        {{"builtin:sphere", "-o", glb, "--transfer", "interreflected", "--method", "monte-carlo", "--samples", "9"},
         "cosine and shadowed transfer only"}}) {
    std::vector<std::string> all = {"bake"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ToolRun run = run_tool(all);
    const auto where = testing::Message() << testing::PrintToString(all) << "\n" << run;
    EXPECT_EQ(run.exit_code, 2) << where;
    EXPECT_NE(run.err.find(named), std::string::npos) << where;
  }
  EXPECT_TRUE(contents().empty());
}

}  // namespace
}  // namespace shlight

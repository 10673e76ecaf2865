#include "shlight/image/cube_files.h"

#include <gtest/gtest.h>

#include <fstream>

#include "shlight/core/error.h"
#include "shlight/core/temporary_folder.h"

namespace shlight {
namespace {

void save_face(const std::filesystem::path& path, int size, double value) {
  Image face(size, size);
  for (int i = 0; i < size * size; ++i) face.set_rgb(i % size, i / size, {value, value, value});
  save_image(path, face);
}

std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(CubeFiles, EveryWayToNameTheSixFiles) {
  const std::vector<std::vector<std::string>> ways = {
      {"px", "nx", "py", "ny", "pz", "nz"},
      {"sky_posx", "sky_negx", "sky_posy", "sky_negy", "sky_posz", "sky_negz"},
      {"a-right", "a-left", "a-top", "a-bottom", "a-front", "a-back"},
      {"B Right", "B Left", "B Up", "B Down", "B Front", "B Back"},
      {"c.PX", "c.NX", "c.PY", "c.NY", "c.PZ", "c.NZ"}};
  for (const auto& names : ways) {
    const TemporaryFolder folder;
    for (std::size_t i = 0; i < 6; ++i) save_face(folder / (names[i] + ".exr"), 2, double(i));
    // By any of the six, or by the folder.
    for (const std::filesystem::path& path :
         {folder / (names[0] + ".exr"), folder / (names[5] + ".exr"), std::filesystem::path(folder / "")}) {
      const auto files = find_cube_files(path);
      ASSERT_TRUE(files.has_value()) << path;
      const LoadedImage cube = load_cube_files(*files);
      EXPECT_EQ(cube.layout, Layout::kCube);
      ASSERT_EQ(cube.image.height, 12);
      for (int i = 0; i < 6; ++i) EXPECT_EQ(cube.image.rgb(1, 2 * i + 1).r, i);
      const auto faces = split_cube(cube.image);
      for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(faces[i].rgb(0, 0).g, double(i));
    }
  }
}

TEST(CubeFiles, OtherFilesAreNoFaces) {
  const TemporaryFolder folder;
  for (const char* name : {"city", "apx", "lonely_front", "px2"})
    save_face(folder / (std::string(name) + ".exr"), 2, 1);
  for (const char* name : {"city.exr", "apx.exr", "lonely_front.exr", "px2.exr", "none.exr"})
    EXPECT_FALSE(find_cube_files(folder / name).has_value()) << name;
}

TEST(CubeFiles, WhatIsMissingIsNamed) {
  const TemporaryFolder folder;
  EXPECT_NE(message_of([&] { find_cube_files(folder / ""); }).find("without a cube map"), std::string::npos);
  for (const char* name : {"px", "py", "pz"}) save_face(folder / (std::string(name) + ".exr"), 2, 1);
  EXPECT_NE(message_of([&] { find_cube_files(folder / "py.exr"); }).find("without nx.exr, ny.exr, nz.exr"),
            std::string::npos);
  for (const char* name : {"nx", "ny", "nz"}) save_face(folder / (std::string(name) + ".exr"), 2, 1);
  EXPECT_TRUE(find_cube_files(folder / "").has_value());
  for (const char* name : {"b_px", "b_nx"}) save_face(folder / (std::string(name) + ".exr"), 2, 1);
  EXPECT_NE(message_of([&] { find_cube_files(folder / ""); }).find("several cube maps"), std::string::npos);
}

TEST(CubeFiles, FacesMustBeSquareAndOfOneSize) {
  const TemporaryFolder folder;
  const CubeFiles files = cube_files_for(folder / "a.exr");
  EXPECT_EQ(files[3].filename(), "a_ny.exr");
  for (const auto& file : files) save_face(file, 4, 1);
  EXPECT_EQ(load_cube_files(files).image.height, 24);
  LoadImageParams few;
  few.max_pixels = 95;
  EXPECT_NE(message_of([&] { load_cube_files(files, few); }).find("at most"), std::string::npos);
  save_face(files[4], 8, 1);
  EXPECT_NE(message_of([&] { load_cube_files(files); }).find("six faces of one size"), std::string::npos);
  save_image(files[4], Image(4, 8));
  EXPECT_NE(message_of([&] { load_cube_files(files); }).find("square face"), std::string::npos);
}

}  // namespace
}  // namespace shlight

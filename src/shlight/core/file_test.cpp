#include "shlight/core/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <string>

#include "shlight/core/error.h"
#include "shlight/core/temporary_folder.h"

namespace shlight {
namespace {

std::string text_of(const std::filesystem::path& path) {
  const auto bytes = read_file(path, 1 << 20);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(File, WritesAndReplacesWhole) {
  const TemporaryFolder folder;
  const auto path = folder / "a.txt";
  write_file(path, std::string_view("first"));
  EXPECT_EQ(text_of(path), "first");
  ::chmod(path.c_str(), 0640);
  write_file(path, std::string_view("second, longer"));
  EXPECT_EQ(text_of(path), "second, longer");
  struct stat status;
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0640u);
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(File, AFailedWriteLeavesNothing) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_file(folder / "no/such/folder.txt", std::string_view("x")), Error);
  EXPECT_THROW(write_file(folder.path(), std::string_view("x")), Error);
  EXPECT_EQ(files_in(folder.path()), 0u);
  // A device stays a device.
  EXPECT_THROW(write_file("/dev/null", std::string_view("x")), Error);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(File, ReadsWithinItsLimit) {
  const TemporaryFolder folder;
  write_file(folder / "a", std::string_view("12345"));
  EXPECT_EQ(read_file(folder / "a", 5).size(), 5u);
  EXPECT_THROW(read_file(folder / "a", 4), Error);
  EXPECT_THROW(read_file(folder / "b", 4), Error);
  EXPECT_THROW(read_file(folder.path(), 4), Error);
  EXPECT_THROW(read_file("/dev/zero", 4), Error);
}

}  // namespace
}  // namespace shlight

#include "shlight/scene/ply_header.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "shlight/core/error.h"

namespace shlight {
namespace {

std::string fault_of(const std::string& header) {
  std::istringstream file(header);
  try {
    check_ply_header(file, "a.ply");
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

const std::string kVertices = "element vertex 3\nproperty float x\nproperty float32 y\nproperty double z\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\n";

const std::string kTextData = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2";

TEST(PlyHeader, SoundHeadersPass) {
  EXPECT_EQ(fault_of("ply\nformat ascii 1.0\ncomment by hand\n" + kVertices + kFaces + "end_header\n" + kTextData), "");
  EXPECT_EQ(fault_of("ply\r\nformat binary_big_endian 1.0\r\nobj_info x y z\r\nelement vertex 0\r\nend_header\r\n"),
            "");
  EXPECT_EQ(fault_of("ply\ncomment first\n\nformat   binary_little_endian\t1.0 \n" + kVertices + "end_header\n" +
                     std::string(3 * 16, '\0')),
            "");
}

TEST(PlyHeader, FaultsAreNamed) {
  const std::string accepted = "PLY 1.0 with elements vertex and face";
  EXPECT_EQ(fault_of("ply\nformat ascii 2.0\n"),
            "a.ply: has a malformed header (line 2: \"format ascii 2.0\"): " + accepted);
  EXPECT_EQ(fault_of("ply\nformat ascii 1.0\n" + kVertices), "a.ply: has a header without an end: " + accepted);
  EXPECT_EQ(fault_of("ply\nformat ascii 1.0\n" + kVertices + "element tristrips 1\n"),
            "a.ply: holds triangle strips: " + accepted);
}

TEST(PlyHeader, MalformedLinesAreRefused) {
  for (const char* line : {"element vertex", "element vertex 3 4", "element vertex -1", "element vertex 4294967296",
                           "element vertex 0x3", "property half x", "property float", "property list uchar int",
                           "property list uchar vec3 v", "property float x y", "what is this", "format ascii 1.0"})
    EXPECT_NE(fault_of("ply\nformat ascii 1.0\n" + std::string(line) + "\nend_header\n"), "") << line;
}

TEST(PlyHeader, MoreElementsThanBytesAreRefused) {
  const std::string binary = "ply\nformat binary_little_endian 1.0\n" + kVertices + "end_header\n";
  EXPECT_EQ(fault_of(binary + std::string(3 * 16 - 1, '\0')),
            "a.ply: has 47 bytes after its header, which promises at least 48: a whole file");
  EXPECT_EQ(fault_of("ply\nformat binary_big_endian 1.0\n" + kFaces + "end_header\n" + '\0'), "");
  EXPECT_NE(fault_of("ply\nformat binary_big_endian 1.0\n" + kFaces + "end_header\n"), "");
  EXPECT_NE(fault_of("ply\nformat ascii 1.0\nelement vertex 4294967295\nend_header\n\n"), "");
  EXPECT_NE(fault_of("ply\nformat ascii 1.0\n" + kVertices + kFaces + "end_header\n0 0 0\n1 0 0\n0 1 0"), "");
}

TEST(PlyHeader, OtherFilesAreRefused) {
  EXPECT_NE(fault_of(""), "");
  EXPECT_NE(fault_of("plyx\nformat ascii 1.0\nend_header\n"), "");
  EXPECT_NE(fault_of("ply\nend_header\n"), "");
  EXPECT_NE(fault_of(std::string(100'000, 'a')), "");
}

}  // namespace
}  // namespace shlight

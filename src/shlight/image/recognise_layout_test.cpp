#include "shlight/image/recognise_layout.h"

#include <gtest/gtest.h>

#include "shlight/core/error.h"

namespace shlight {
namespace {

std::string message_of(const std::string& path, const Image& image) {
  try {
    recognise_layout(path, image);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RecogniseLayout, ByShape) {
  EXPECT_EQ(recognise_layout("a.hdr", Image(64, 32)), Layout::kLatLong);
  EXPECT_EQ(recognise_layout("a.hdr", Image(30, 40)), Layout::kVerticalCross);
  EXPECT_EQ(recognise_layout("a.hdr", Image(40, 30)), Layout::kHorizontalCross);
  EXPECT_EQ(recognise_layout("a.hdr", Image(60, 10)), Layout::kHorizontalStrip);
  EXPECT_EQ(recognise_layout("a.hdr", Image(10, 60)), Layout::kVerticalStrip);
}

TEST(RecogniseLayout, ByNameWhereTheShapeLeavesAChoice) {
  EXPECT_EQ(recognise_layout("dir/grace_probe.hdr", Image(10, 10)), Layout::kAngularMap);
  EXPECT_EQ(recognise_layout("Mirror.hdr", Image(10, 10)), Layout::kMirrorBall);
  EXPECT_EQ(recognise_layout("sky_octahedral.exr", Image(10, 10)), Layout::kOctahedral);
  EXPECT_EQ(recognise_layout("sky-mirror-ball.exr", Image(10, 10)), Layout::kMirrorBall);
  // The shape has the last word.
  EXPECT_EQ(recognise_layout("grace_probe.hdr", Image(20, 10)), Layout::kLatLong);
}

TEST(RecogniseLayout, AmbiguousPicturesAreRefusedWithTheCandidates) {
  const std::string square = message_of("a.hdr", Image(10, 10));
  EXPECT_NE(square.find("angular-map, mirror-ball, octahedral"), std::string::npos) << square;
  EXPECT_NE(message_of("mirror_probe.hdr", Image(10, 10)).find("--layout"), std::string::npos);
  EXPECT_NE(message_of("a.hdr", Image(100, 31)).find("tell no layout"), std::string::npos);
  // A photograph of 4:3 is no cross.
  Image photograph(40, 30);
  for (int x = 0; x < 40; ++x) photograph.set_rgb(x, 0, {0.1 * x, 0, 0});
  EXPECT_NE(message_of("a.hdr", photograph).find("corners are not empty"), std::string::npos);
}

}  // namespace
}  // namespace shlight

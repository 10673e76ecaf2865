#include "command_line.h"

#include <gtest/gtest.h>

#include "navigation.h"

namespace shlight::viewer {
namespace {

std::string command(const Settings& settings) {
  return render_command(settings, settings.looks[0], 640, 480, 0);
}

TEST(CommandLine, SaysOnlyWhatMatters) {
  Settings s;
  s.camera = {};
  s.exposure = 0;
  s.looks[0] = {};
  s.looks[0].method = Method::kIrradiance;
  EXPECT_EQ(command(s),
            "shlight render builtin:scene --light builtin:sky --method irradiance --bands 5 --camera 30,15,1 --size "
            "640x480 -o picture.png");
}

TEST(CommandLine, QuotesWhatAShellWouldTakeApart) {
  Settings s;
  s.model = "my model's.obj";
  s.light = "fn:max(0, y)";
  EXPECT_NE(command(s).find(" 'my model'\\''s.obj' --light 'fn:max(0, y)' "), std::string::npos) << command(s);
}

TEST(CommandLine, TurnsAboutTheVerticalHaveANumber) {
  Settings s;
  s.rotate_light = rotation_about_y(-0.5235987755982988);
  EXPECT_NE(command(s).find(" --rotate-light -30 "), std::string::npos) << command(s);
  turn_light(s, 0, 0.2);
  EXPECT_NE(command(s).find(" --rotate "), std::string::npos) << command(s);
}

}  // namespace
}  // namespace shlight::viewer

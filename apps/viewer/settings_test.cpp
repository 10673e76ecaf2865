#include "settings.h"

#include <gtest/gtest.h>

#include "shlight/core/error.h"

namespace shlight::viewer {
namespace {

TEST(Settings, AreSetByName) {
  Settings s;
  for (const auto& [name, value] : {std::pair{"camera", "20,-10,1.5"},
                                    {"side", "b"},
                                    {"method", "hybrid"},
                                    {"bands", "7"},
                                    {"material", "ggx:alpha=0.3"},
                                    {"compare", "split"},
                                    {"transfer", "interreflected"},
                                    {"window", "hann:6"}})
    set_by_name(s, name, value);
  EXPECT_EQ(s.camera.azimuth, 20);
  EXPECT_EQ(s.camera.elevation, -10);
  EXPECT_EQ(s.camera.zoom, 1.5);
  EXPECT_EQ(s.looks[1].method, Method::kHybrid);
  EXPECT_EQ(s.looks[1].bands, 7);
  EXPECT_EQ(s.looks[1].material, "ggx:alpha=0.3");
  EXPECT_EQ(s.looks[0].method, Settings().looks[0].method) << "the other side keeps its own";
  EXPECT_EQ(s.compare, Compare::kSplit);
}

TEST(Settings, ADegreeBringsTheBandsThatHaveIt) {
  Settings s;
  set_by_name(s, "bands", "2");
  set_by_name(s, "show", "degree:4");
  EXPECT_EQ(s.look().bands, 5);
  EXPECT_EQ(s.look().degree, 4);
}

TEST(Settings, RefuseWhatTheyAreNot) {
  for (const auto& [name, value] :
       {std::pair{"bands", "0"}, {"bands", "11"},      {"bands", "2.5"},    {"bands", ""},
        {"bands", "nan"},        {"camera", "1"},      {"camera", "0,91"},  {"camera", "0,0,0"},
        {"camera", "1,2,3,4"},   {"exposure", "inf"},  {"method", "magic"}, {"window", "box"},
        {"material", "velvet"},  {"transfer", "soft"}, {"samples", "0"},    {"divider", "1.1"},
        {"show", "degree:10"},   {"insight", "yes"},   {"colour", "red"},   {"look-at", "1,2"}}) {
    Settings s;
    EXPECT_THROW(set_by_name(s, name, value), Error) << name << " " << value;
    EXPECT_EQ(s.looks, Settings().looks) << name;
  }
}

}  // namespace
}  // namespace shlight::viewer

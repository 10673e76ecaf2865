#include "parameters.h"

#include <gtest/gtest.h>

namespace shlight::viewer {
namespace {

TEST(Parameters, TakeApartAndPutTogether) {
  for (const char* text : {"lambert", "ggx:alpha=0.3,f0=0.9/0.6/0.2", "sky:elevation=20"})
    EXPECT_EQ(Parameters(text).text(), text);
}

TEST(Parameters, KeepWhatIsNotSet) {
  Parameters parameters("sky:elevation=20,turbidity=4");
  parameters.set("elevation", "30");
  parameters.set("ground", "0.1");
  EXPECT_EQ(parameters.text(), "sky:elevation=30,turbidity=4,ground=0.1");
  EXPECT_EQ(parameters.get("turbidity", "2"), "4");
  EXPECT_EQ(parameters.get("azimuth", "-125"), "-125");
}

TEST(Parameters, TakeAnyText) {
  for (const char* text : {"", ":", ":,", "a:=", "a:b", "a:,=,"}) EXPECT_NO_THROW(Parameters(text).text());
}

}  // namespace
}  // namespace shlight::viewer

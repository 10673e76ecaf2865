#include "script.h"

#include <gtest/gtest.h>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/core/temporary_folder.h"

namespace shlight::viewer {
namespace {

class ScriptTest : public testing::Test {
 protected:
  Script script(const std::string& text) const {
    write_file(folder_ / "script", text);
    return Script(folder_ / "script");
  }
  TemporaryFolder folder_;
};

TEST_F(ScriptTest, IsReadLineByLine) {
  Script s = script("# nothing\n\n  set light fn:max(0, y)  \r\nwait");
  ASSERT_FALSE(s.ended());
  EXPECT_EQ(s.line().number, 3);
  EXPECT_EQ(s.line().words[1], "light");
  EXPECT_EQ(s.line().rest, "light fn:max(0, y)");
  EXPECT_EQ(s.where(), (folder_ / "script").string() + ":3");
  s.advance();
  EXPECT_EQ(s.line().words[0], "wait");
  s.advance();
  EXPECT_TRUE(s.ended());
}

TEST_F(ScriptTest, RefusesWhatIsNoCommandBeforeAnythingIsDone) {
  for (const char* text :
       {"jump", "set bands", "wait 1 2", "drag left 1 2 3", "screenshot", std::string("\0\1", 2).c_str()})
    EXPECT_THROW(script(std::string("wait\n") + text), Error) << text;
  EXPECT_THROW(Script(folder_ / "none"), Error);
}

TEST(Script, WordsStandForNumbersSizesAndKeys) {
  EXPECT_EQ(to_number("-2.5"), -2.5);
  EXPECT_EQ(to_pixels("640"), 640);
  EXPECT_EQ(to_key("q"), to_key("Q"));
  EXPECT_NE(to_key("Tab"), to_key("T"));
  for (const char* wrong : {"", "2x", "nan", "1e9"}) EXPECT_THROW(to_number(wrong), Error) << wrong;
  for (const char* wrong : {"0", "-3", "1.5", "20000"}) EXPECT_THROW(to_pixels(wrong), Error) << wrong;
  for (const char* wrong : {"", "F1", "!"}) EXPECT_THROW(to_key(wrong), Error) << wrong;
}

}  // namespace
}  // namespace shlight::viewer

#include "shlight/report/html.h"

#include <gtest/gtest.h>

namespace shlight {
namespace {

std::string base64(std::string_view text) {
  const std::string uri = data_uri("a/b", std::as_bytes(std::span(text)));
  EXPECT_TRUE(uri.starts_with("data:a/b;base64,"));
  return uri.substr(16);
}

// The examples of RFC 4648, section 10.
TEST(Html, DataUrisAreBase64) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfb\xf0"), "//vw");
}

TEST(Html, TablesBecomeCsvWithoutTags) {
  EXPECT_EQ(csv_table({{"a", "b"}, {{"<b>x</b>, y", "say \"1\""}}}), "a,b\n\"x, y\",\"say \"\"1\"\"\"\n");
}

TEST(Html, NumbersAsPeopleReadThem) {
  EXPECT_EQ(format_seconds(43.774), "43.8 s");
  EXPECT_EQ(format_seconds(0.0012), "1.20 ms");
  EXPECT_EQ(format_seconds(65e-6), "65.0 µs");
  EXPECT_EQ(format_percent(0.0035), "0.35 %");
  EXPECT_EQ(format_percent(0.05), "5.0 %");
  EXPECT_EQ(format_percent(0.53), "53 %");
  EXPECT_EQ(format_percent(0), "0 %");
  EXPECT_EQ(format_percent(2e-8), "2.0 · 10<sup>−6</sup> %");
  EXPECT_EQ(format_factor(12.3), "12 ×");
  EXPECT_EQ(format_count(31076), "31\u202f076");
  EXPECT_EQ(format_count(999), "999");
  EXPECT_EQ(format_count(1234567), "1\u202f234\u202f567");
}

}  // namespace
}  // namespace shlight

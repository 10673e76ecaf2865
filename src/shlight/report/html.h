#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Pieces of the report's page. Not installed.

namespace shlight {

// "data:image/png;base64,…" (RFC 2397, RFC 4648).
std::string data_uri(std::string_view media_type, std::span<const std::byte> bytes);

// A figure: `content` is HTML, as are its caption's lines.
std::string html_figure(const std::string& content, const std::vector<std::string>& caption);

// A table in which the first column is words and the others are numbers, set flush right; wide ones scroll within
// themselves. Cells are HTML.
struct HtmlTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};
std::string html_table(const HtmlTable& table);

// The same numbers for other programs. Cells with commas or quotes are quoted (RFC 4180).
std::string csv_table(const HtmlTable& table);

// HTML. A time as people read it: "43.8 s", "1.20 ms", "65.0 µs". A fraction in percent: "0.35 %". A factor: "12 ×".
std::string format_seconds(double seconds);
std::string format_percent(double fraction);
std::string format_factor(double factor);
// A number with thin spaces between thousands: "31 076"; small ones with a digit after the point, where they have one.
std::string format_count(double count);

}  // namespace shlight

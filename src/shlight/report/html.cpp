#include "shlight/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace shlight {
namespace {

// Text without tags, for programs that read tables.
std::string plain(const std::string& html) {
  std::string text;
  bool in_tag = false;
  for (const char c : html) {
    if (c == '<') in_tag = true;
    if (!in_tag) text += c;
    if (c == '>') in_tag = false;
  }
  return text;
}

// Three digits, or all of those before the point.
std::string three_digits(double value) {
  const double size = std::abs(value);
  return fmt::format("{:.{}f}", value, size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}

}  // namespace

std::string data_uri(std::string_view media_type, std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string uri = fmt::format("data:{};base64,", media_type);
  uri.reserve(uri.size() + 4 * (bytes.size() / 3 + 1));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    // Three bytes are four digits of six bits; what is missing at the end is zero and its digits are '='.
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? std::to_integer<unsigned>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) uri += k <= count ? kDigits[bits >> (18 - 6 * k) & 63u] : '=';
  }
  return uri;
}

std::string html_figure(const std::string& content, const std::vector<std::string>& caption) {
  std::string lines;
  for (const std::string& line : caption) lines += (lines.empty() ? "" : "<br>") + line;
  return "<figure>" + content + "<figcaption>" + lines + "</figcaption></figure>\n";
}

std::string html_table(const HtmlTable& table) {
  std::string html = "<div class=\"wide\"><table>\n<thead><tr>";
  for (const std::string& cell : table.head) html += "<th scope=\"col\">" + cell + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr><th scope=\"row\">" + row.at(0) + "</th>";
    for (std::size_t i = 1; i < row.size(); ++i) html += "<td>" + row[i] + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string csv_table(const HtmlTable& table) {
  std::string csv;
  const auto add = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::string cell = plain(row[i]);
      if (cell.find_first_of(",\"\n") != std::string::npos) {
        for (std::size_t at = 0; (at = cell.find('"', at)) != std::string::npos; at += 2) cell.insert(at, 1, '"');
        cell = '"' + cell + '"';
      }
      csv += (i == 0 ? "" : ",") + cell;
    }
    csv += "\n";
  };
  add(table.head);
  for (const auto& row : table.rows) add(row);
  return csv;
}

std::string format_seconds(double seconds) {
  if (seconds >= 1) return three_digits(seconds) + " s";
  if (seconds >= 1e-3) return three_digits(1e3 * seconds) + " ms";
  return three_digits(1e6 * seconds) + " µs";
}

std::string format_percent(double fraction) {
  const double percent = 100 * std::abs(fraction);
  if (percent != 0 && percent < 0.001) {
    const auto exponent = static_cast<int>(std::floor(std::log10(percent)));
    return fmt::format("{:.1f} · 10<sup>−{}</sup> %", 100 * fraction / std::pow(10, exponent), -exponent);
  }
  if (percent < 1) return fmt::format("{:.2g} %", 100 * fraction);
  return fmt::format("{:.{}f} %", 100 * fraction, percent < 9.95 ? 1 : 0);
}

std::string format_factor(double factor) {
  return (factor >= 100 ? format_count(factor) : fmt::format("{:.2g}", factor)) + " ×";
}

std::string format_count(double count) {
  if (count < 9.95 && count != std::round(count)) return fmt::format("{:.1f}", count);
  std::string digits = fmt::format("{:.0f}", count);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, "\u202f");
  return digits;
}

}  // namespace shlight

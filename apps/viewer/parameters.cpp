#include "parameters.h"

#include <algorithm>

namespace shlight::viewer {

Parameters::Parameters(const std::string& text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  name = text.substr(0, colon);
  for (std::size_t at = colon + 1; at < text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, comma - at);
    const std::size_t equals = std::min(part.find('='), part.size());
    values.emplace_back(part.substr(0, equals), equals < part.size() ? part.substr(equals + 1) : "");
    at = comma + 1;
  }
}

std::string Parameters::text() const {
  std::string result = name;
  for (std::size_t i = 0; i < values.size(); ++i)
    result += (i == 0 ? ":" : ",") + values[i].first + "=" + values[i].second;
  return result;
}

std::string Parameters::get(const std::string& key, const std::string& otherwise) const {
  const auto found = std::ranges::find(values, key, &std::pair<std::string, std::string>::first);
  return found == values.end() ? otherwise : found->second;
}

void Parameters::set(const std::string& key, const std::string& value) {
  const auto found = std::ranges::find(values, key, &std::pair<std::string, std::string>::first);
  if (found == values.end())
    values.emplace_back(key, value);
  else
    found->second = value;
}

}  // namespace shlight::viewer

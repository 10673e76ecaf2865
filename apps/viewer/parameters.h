#pragma once

#include <string>
#include <utility>
#include <vector>

namespace shlight::viewer {

// "name:key=value,key=value", as materials and built-in lights are written, taken apart for sliders.
struct Parameters {
  std::string name;
  std::vector<std::pair<std::string, std::string>> values;

  explicit Parameters(const std::string& text);
  std::string text() const;
  // The value of `key`, or `otherwise` where it is not given.
  std::string get(const std::string& key, const std::string& otherwise) const;
  void set(const std::string& key, const std::string& value);
};

}  // namespace shlight::viewer

#pragma once

#include <string>
#include <vector>

namespace shlight::viewer {

// Models and lights opened lately, the newest first, kept in a file of the user's state folder. Whatever is wrong with
// that file, the window does without.
class Recent {
 public:
  // Without a file where `remember` is false.
  explicit Recent(bool remember);
  void add_model(const std::string& path) { add(models_, path); }
  void add_light(const std::string& path) { add(lights_, path); }
  const std::vector<std::string>& models() const { return models_; }
  const std::vector<std::string>& lights() const { return lights_; }

 private:
  void add(std::vector<std::string>& list, const std::string& path);
  void save() const;

  std::string file_;
  std::vector<std::string> models_, lights_;
};

// Files beside `path` that may be of the same kind, sorted.
std::vector<std::string> models_beside(const std::string& path);
std::vector<std::string> lights_beside(const std::string& path);

}  // namespace shlight::viewer

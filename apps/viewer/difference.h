#pragma once

#include <memory>
#include <optional>
#include <string>

#include "shlight/image/image.h"
#include "shlight/render/targets.h"
#include "shlight/truth/image_error.h"
#include "task.h"

namespace shlight::viewer {

// Where two pictures differ, as a heat map, found beside the window.
class Difference {
 public:
  struct Result {
    Image8 map;          // FLIP, with a scale beside it
    double largest = 1;  // at the top of the scale
    ImageError error;
    int width = 0, height = 0;  // of the pictures as they were compared
  };

  // Asks for that of two pictures of radiance; `key` says what they show.
  void request(const std::string& key, Image test, Image reference);
  // True where there is a new result.
  bool update();
  void cancel() { task_.cancel(); }
  bool busy() const { return task_.busy(); }
  // Of the newest comparison that is done, and its key.
  const Result* result() const { return result_.get(); }
  const std::string& result_key() const { return result_key_; }
  const PictureTexture* texture() const { return texture_ ? &*texture_ : nullptr; }
  const std::string& wanted() const { return task_.wanted(); }

 private:
  Task<std::shared_ptr<const Result>> task_;
  std::shared_ptr<const Result> result_;
  std::string result_key_;
  std::optional<PictureTexture> texture_;
};

}  // namespace shlight::viewer

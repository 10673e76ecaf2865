#include "difference.h"

#include <algorithm>
#include <utility>

#include "shlight/render/background.h"
#include "shlight/truth/heat_map.h"

namespace shlight::viewer {

void Difference::request(const std::string& key, Image test, Image reference) {
  task_.request(
      key,
      [test = std::move(test), reference = std::move(reference)](const auto& publish, const Progress&) {
        constexpr int kLargest = 640;  // more takes seconds
        const Image small_test = reduce_to_size(test, kLargest), small_reference = reduce_to_size(reference, kLargest);
        auto result = std::make_shared<Result>();
        ImageErrorParams params;
        params.meaning = Meaning::kRadiance;
        params.threads = worker_threads();
        result->error = measure_error(small_test, small_reference, params);
        const float largest = *std::ranges::max_element(result->error.flip_map.values);
        if (largest > 0) result->largest = double{largest};
        result->map = make_heat_map(result->error.flip_map, result->largest);
        result->width = small_test.width, result->height = small_test.height;
        publish(result);
      },
      false);
}

bool Difference::update() {
  const auto news = task_.poll();
  if (!news || !news->result) return false;
  result_ = *news->result;
  result_key_ = news->key;
  texture_.emplace(result_->map);
  return true;
}

}  // namespace shlight::viewer

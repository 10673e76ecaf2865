#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace shlight {

// The world is not as a call needs it to be: a file, a size, a driver, a user's text. Reads
// "subject: what is wrong: what would have been accepted"; the subject is mostly a path.
// A broken contract between two pieces of code is never an Error: that is SHLIGHT_ASSERT's.
class Error : public std::runtime_error {
 public:
  Error(std::string_view subject, std::string_view what_is_wrong, std::string_view what_is_accepted);
  // From a text that is already complete, where an error is handed on.
  explicit Error(const std::string& text) : std::runtime_error(text) {}
};

// A long operation was stopped because its Progress said so. Nothing was left half-written.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("stopped before it was done") {}
};

}  // namespace shlight

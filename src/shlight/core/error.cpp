#include "shlight/core/error.h"

#include <fmt/format.h>

namespace shlight {

Error::Error(std::string_view subject, std::string_view what_is_wrong, std::string_view what_is_accepted)
    : std::runtime_error(fmt::format("{}: {}: {}", subject, what_is_wrong, what_is_accepted)) {}

}  // namespace shlight

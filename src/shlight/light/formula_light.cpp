#include "shlight/light/formula_light.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>

#include "shlight/core/error.h"

namespace shlight {
namespace {

constexpr std::size_t kMaxLength = 10000;
constexpr const char* kAccepted =
    "an expression in theta, phi, x, y, z such as \"fn:max(0, y)\", or parts \"fn:r=1; g=x^2; b=max(0, z)\"";

double clamp_of(double v, double low, double high) {
  return std::max(low, std::min(high, v));
}
double smoothstep_of(double low, double high, double v) {
  const double t = clamp_of((v - low) / (high - low), 0, 1);
  return t * t * (3 - 2 * t);
}

// muParser evaluates from variables bound to it, one direction at a time.
class Formula {
 public:
  explicit Formula(const std::string& text) : text_(text) {
    if (text.size() > kMaxLength)
      throw Error("fn", fmt::format("the formula has {} characters", text.size()),
                  fmt::format("at most {} characters", kMaxLength));
    if (text.find('=') != std::string::npos && starts_with_part(text))
      parse_parts(text);
    else
      parse(0, text);
  }

  Rgb operator()(Vec3d direction) {
    const std::lock_guard lock(mutex_);
    direction_ = direction;
    theta_ = std::atan2(std::hypot(direction.x, direction.y), direction.z);
    phi_ = std::atan2(direction.y, direction.x);
    const double r = eval(0);
    if (!parts_) return {r, r, r};
    return {r, eval(1), eval(2)};
  }

 private:
  static std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t\n");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\n") + 1 - first);
  }

  // "r =", "g=" …, but not "r ==".
  static bool starts_with_part(const std::string& text) {
    const std::string t = trimmed(text);
    const auto equals = t.find('=');
    if (equals == std::string::npos || (equals + 1 < t.size() && t[equals + 1] == '=')) return false;
    const std::string name = trimmed(t.substr(0, equals));
    return name == "r" || name == "g" || name == "b";
  }

  void parse_parts(const std::string& text) {
    parts_ = true;
    std::size_t begin = 0;
    while (begin <= text.size()) {
      const std::size_t end = std::min(text.find(';', begin), text.size());
      const std::string part = trimmed(text.substr(begin, end - begin));
      begin = end + 1;
      if (part.empty()) continue;
      if (!starts_with_part(part)) throw Error("fn", fmt::format("'{}' is no part r=, g= or b=", part), kAccepted);
      const std::size_t channel = std::string("rgb").find(part[0]);
      if (parsers_[channel]) throw Error("fn", fmt::format("'{}' is given twice", part[0]), kAccepted);
      parse(channel, part.substr(part.find('=') + 1));
    }
  }

  void parse(std::size_t channel, const std::string& expression) {
    // muParser would take a single '=' for an assignment to its variable.
    for (std::size_t i = 0; i < expression.size(); ++i)
      if (expression[i] == '=' && !(i > 0 && std::string("=<>!").find(expression[i - 1]) != std::string::npos) &&
          !(i + 1 < expression.size() && expression[i + 1] == '='))
        throw Error("fn", fmt::format("'{}' has a '=' that compares nothing", trimmed(expression)), kAccepted);
    mu::Parser& parser = parsers_[channel].emplace();
    try {
      for (const auto& [name, variable] : {std::pair{"x", &direction_.x},
                                           {"y", &direction_.y},
                                           {"z", &direction_.z},
                                           {"theta", &theta_},
                                           {"phi", &phi_}})
        parser.DefineVar(name, variable);
      parser.DefineConst("pi", std::numbers::pi);
      parser.DefineConst("e", std::numbers::e);
      parser.DefineFun("clamp", clamp_of);
      parser.DefineFun("smoothstep", smoothstep_of);
      parser.SetExpr(expression);
      int values = 0;
      parser.Eval(values);
      if (values != 1) throw Error("fn", fmt::format("'{}' has {} values", expression, values), kAccepted);
    } catch (const mu::Parser::exception_type& error) {
      throw Error("fn", fmt::format("'{}' does not parse ({})", trimmed(expression), error.GetMsg()), kAccepted);
    }
  }

  double eval(std::size_t channel) {
    if (!parsers_[channel]) return 0;
    double value = 0;
    try {
      value = parsers_[channel]->Eval();
    } catch (const mu::Parser::exception_type& error) {
      throw Error("fn", fmt::format("'{}' cannot be evaluated ({})", text_, error.GetMsg()), kAccepted);
    }
    if (!std::isfinite(value))
      throw Error("fn",
                  fmt::format("'{}' is {} at x = {:.6g}, y = {:.6g}, z = {:.6g}", text_,
                              std::isnan(value) ? "NaN" : "infinite", direction_.x, direction_.y, direction_.z),
                  "a formula with a finite value in every direction");
    return value;
  }

  std::string text_;
  bool parts_ = false;
  Vec3d direction_ = {0, 0, 1};
  double theta_ = 0, phi_ = 0;
  std::array<std::optional<mu::Parser>, 3> parsers_;
  std::mutex mutex_;
};

}  // namespace

std::unique_ptr<Light> make_formula_light(const std::string& formula) {
  const auto parsed = std::make_shared<Formula>(formula);
  return std::make_unique<FunctionLight>([parsed](Vec3d direction) { return (*parsed)(direction); });
}

}  // namespace shlight

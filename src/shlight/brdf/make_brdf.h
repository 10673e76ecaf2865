#pragma once

#include <memory>
#include <string>
#include <vector>

#include "shlight/brdf/brdf.h"

// Reflection models by name, as command lines and files have them.

namespace shlight {

// "name" or "name:key=value,key=value,…", for instance "cook-torrance:m=0.5,f0=0.9" or "lambert:rho=0.8/0.5/0.2": what
// is a colour takes one number or red/green/blue. What is not given has its default. "merl:FILE" and "cornell:FILE" are
// measured; what was wrong with the file and could be repaired goes to `warnings`. Throws Error that names the model,
// the parameter and what it may be.
std::unique_ptr<Brdf> make_brdf(const std::string& material, std::vector<std::string>* warnings = nullptr);

// One parameter of a model, for help texts and sliders.
struct BrdfParameter {
  std::string key;
  double min = 0, max = 1;
  double value = 0;  // where it is not given
  bool is_colour = false;
  std::vector<std::string> words;  // where it takes one of these instead of a number; `value` is the index of one
};

struct BrdfModel {
  std::string name;
  std::vector<BrdfParameter> parameters;  // empty for measured ones, which take the name of a file
};
const std::vector<BrdfModel>& brdf_models();

// A line for each model, as "  cook-torrance:m=0.01…1,f0=0…1".
std::string describe_brdf_models();

}  // namespace shlight

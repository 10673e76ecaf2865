#pragma once

#include "shlight/truth/path_tracer.h"

namespace shlight {

// Takes another picture of the same scene, traced with another seed, into `sum`: the mean of both, each with the weight
// of its paths, and the mean's variance, so that a picture can converge pass by pass. An empty `sum` becomes `more`.
void accumulate_paths(const PathTraceResult& more, PathTraceResult& sum);

}  // namespace shlight

#pragma once

#include <cstdint>

namespace shlight {

// The most memory that this process has held at once, in bytes: the system's own high-water mark of what was resident.
// 0 where the system keeps none.
std::uint64_t peak_memory();

// What it holds now.
std::uint64_t resident_memory();

// Sets the mark to what is held now. Without effect where the system does not let it be set.
void reset_peak_memory();

// How long this process has been running, in ms, to 10 ms: what libraries take to load is in it. 0 where the system
// does not tell.
double process_age_ms();

}  // namespace shlight

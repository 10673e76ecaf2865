#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace shlight {

// The first points of the two-dimensional Sobol sequence in the unit square, Owen-scrambled [1]: each is uniform in
// [0, 1)², and for every k the first 2^k lie one in each box of every dyadic cutting of the square into 2^k equal
// boxes, as do the next 2^k. Other seeds give independent sequences. Their mean of a smooth function converges like
// N^-3/2, of one with an edge like N^-3/4.
//
// [1] Owen 1995, Randomly permuted (t,m,s)-nets and (t,s)-sequences.
// [2] Sobol' 1967; the second dimension's matrix is Pascal's triangle modulo 2.
void make_scrambled_sobol(std::uint64_t seed, std::span<double> x, std::span<double> y);

// SplitMix64's mixing function (Steele, Lea & Flood 2014): a number in which every bit depends on every bit of `v`.
inline std::uint64_t mix_bits(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15u;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}

}  // namespace shlight

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The container of binary glTF [1, section 4.4]: twelve bytes of header, a JSON chunk, a binary chunk. With a checksum,
// which glTF has not: sixteen hexadecimal digits somewhere in the JSON text, after the first "checksum":".
//
// Written by hand rather than with tinygltf: that would not save a line, since what it reads has to be checked in the
// same way, keeps three copies of a file in memory, and parses with the trust of a library that is given good files.
//
// [1] Khronos Group: glTF 2.0 Specification, https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html

namespace shlight {

inline constexpr std::string_view kAcceptedBaked = "a .glb file as shlight bake writes it";
inline constexpr std::string_view kEmptyChecksum = "0000000000000000";
inline constexpr std::uint64_t kMaxGlbBytes = 0xffffffff;  // all that its header can say

struct Glb {
  std::string_view json;
  std::span<const std::byte> binary;
};

// The file of a JSON text that has `"checksum":"` and kEmptyChecksum in it, and of the bytes of buffer 0. Throws Error
// with `name` as its subject where it would be larger than
// kMaxGlbBytes.
std::vector<std::byte> make_glb(std::string_view json, std::span<const std::byte> binary, std::string_view name);

// The two chunks, which lie in `file`. Throws Error.
Glb split_glb(std::span<const std::byte> file, std::string_view name);

// FNV-1a [http://www.isthe.com/chongo/tech/comp/fnv] of 64 bits over the whole file, with the checksum's own digits
// taken as kEmptyChecksum, in hexadecimal.
std::string glb_checksum(std::span<const std::byte> file);

}  // namespace shlight

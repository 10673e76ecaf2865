#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace shlight {

// Reads a whole regular file. Throws Error where it cannot be read or holds more than `max_bytes`.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes);

// Writes a file whole or not at all: into a temporary file beside it, which is then renamed over it. What stood at
// `path` before stays as it was where anything fails. Throws Error.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

// Throws the Error that write_file would, as far as can be told without the bytes: before long work, that is. Leaves
// nothing behind.
void check_writable(const std::filesystem::path& path);

}  // namespace shlight

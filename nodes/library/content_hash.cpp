// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/content_hash.hpp"

#include <xxhash.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace posevote::library {
namespace {

namespace fs = std::filesystem;

std::string hex(XXH128_hash_t hash) {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, hash);
  std::string text;
  for (const unsigned char byte : bytes.digest)
    for (const int digit : {byte >> 4, byte & 15}) text += "0123456789abcdef"[digit];
  return text;
}

void hash_text(XXH3_state_t* state, std::string_view text) {
  const std::uint64_t length = text.size();
  XXH3_128bits_update(state, &length, sizeof length);
  XXH3_128bits_update(state, text.data(), text.size());
}

void hash_file(XXH3_state_t* state, const fs::path& path) {
  std::error_code is_loop;  // of links
  std::ifstream stream(path, std::ios::binary);
  if (!stream || fs::is_directory(path, is_loop))
    throw std::runtime_error(path.string() + ": cannot be opened");
  std::array<char, 1 << 16> buffer;
  std::uint64_t length = 0;
  while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0) {
    length += static_cast<std::uint64_t>(stream.gcount());
    XXH3_128bits_update(state, buffer.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw std::runtime_error(path.string() + ": cannot be read");
  XXH3_128bits_update(state, &length, sizeof length);
}

}  // namespace

std::string checksum(std::string_view bytes) {
  return hex(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string hash_files(const std::vector<fs::path>& files, const std::string& text) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                       &XXH3_freeState);
  if (!state) throw std::bad_alloc();
  XXH3_128bits_reset(state.get());
  for (const fs::path& file : files) hash_file(state.get(), file);
  hash_text(state.get(), text);
  return hex(XXH3_128bits_digest(state.get()));
}

}  // namespace posevote::library

// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/content_hash.hpp"

#include <xxhash.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <new>
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

/// A number's own bytes.
std::string_view bytes_of(const std::uint64_t& number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

void hash_file(Checksum& sum, const fs::path& path) {
  std::error_code is_loop;  // of links
  std::ifstream stream(path, std::ios::binary);
  if (!stream || fs::is_directory(path, is_loop))
    throw std::runtime_error(path.string() + ": cannot be opened");
  std::array<char, 1 << 16> buffer;
  std::uint64_t length = 0;
  while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0) {
    length += static_cast<std::uint64_t>(stream.gcount());
    sum.add({buffer.data(), static_cast<std::size_t>(stream.gcount())});
  }
  if (stream.bad()) throw std::runtime_error(path.string() + ": cannot be read");
  sum.add(bytes_of(length));
}

}  // namespace

struct Checksum::State {
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash{XXH3_createState(),
                                                                &XXH3_freeState};
};

Checksum::Checksum() : state_(std::make_unique<State>()) {
  if (!state_->hash) throw std::bad_alloc();
  XXH3_128bits_reset(state_->hash.get());
}

Checksum::~Checksum() = default;

void Checksum::add(std::string_view bytes) {
  XXH3_128bits_update(state_->hash.get(), bytes.data(), bytes.size());
}

std::string Checksum::hex() const { return library::hex(XXH3_128bits_digest(state_->hash.get())); }

std::string checksum(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.hex();
}

std::string hash_files(const std::vector<fs::path>& files, const std::string& text) {
  Checksum sum;
  for (const fs::path& file : files) hash_file(sum, file);
  const std::uint64_t length = text.size();
  sum.add(bytes_of(length));
  sum.add(text);
  return sum.hex();
}

}  // namespace posevote::library

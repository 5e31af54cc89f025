// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/library_file.hpp"

#include <xxhash.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "graph/write_file.hpp"
#include "nodes/library/library_payload.hpp"

namespace posevote::library {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "POSEVLIB";
constexpr std::uint32_t kVersion = 11;

std::string hex(XXH128_hash_t hash) {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, hash);
  std::string text;
  for (const unsigned char byte : bytes.digest)
    for (const int digit : {byte >> 4, byte & 15}) text += "0123456789abcdef"[digit];
  return text;
}

std::string checksum_of(std::string_view payload) {
  return hex(XXH3_128bits(payload.data(), payload.size()));
}

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

std::string read_file(const fs::path& path) {
  if (!fs::is_regular_file(path)) throw std::runtime_error("is not a file");
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(fs::file_size(path), '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw std::runtime_error("cannot be read");
  return bytes;
}

ModelLibrary parse(std::string_view bytes, const std::string& key) {
  ByteReader in(bytes);
  if (bytes.substr(0, kMagic.size()) != kMagic) throw std::runtime_error("is not a model library");
  in.take(kMagic.size());
  const auto version = in.get<std::uint32_t>();
  if (version != kVersion)
    throw std::runtime_error("is a model library of format version " + std::to_string(version) +
                             ", expected " + std::to_string(kVersion));
  if (in.get_text() != key)
    throw std::runtime_error("was made from other models or with other parameters");
  const std::string_view checksum = in.get_text();
  const std::string_view payload = in.get_text();
  if (!in.rest().empty() || checksum_of(payload) != checksum)
    throw std::runtime_error("is damaged: its checksum is wrong");
  return decode_library(payload);
}

using HashState = std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)>;

void hash_text(XXH3_state_t* state, std::string_view text) {
  const std::uint64_t length = text.size();
  XXH3_128bits_update(state, &length, sizeof length);
  XXH3_128bits_update(state, text.data(), text.size());
}

void hash_file(XXH3_state_t* state, const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || fs::is_directory(path)) fail(path, "cannot be opened");
  std::array<char, 1 << 16> buffer;
  std::uint64_t length = 0;
  while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0) {
    length += static_cast<std::uint64_t>(stream.gcount());
    XXH3_128bits_update(state, buffer.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) fail(path, "cannot be read");
  XXH3_128bits_update(state, &length, sizeof length);
}

}  // namespace

std::string hash_library(const ModelLibrary& library) {
  return checksum_of(encode_library(library));
}

void save_library(const ModelLibrary& library, const fs::path& path, const std::string& key) {
  if (fs::exists(path) && !fs::is_regular_file(path)) fail(path, "is there, and no plain file");
  const std::string payload = encode_library(library);
  ByteWriter out;
  for (const char letter : kMagic) out.put(letter);
  out.put(kVersion);
  out.put(key);
  out.put(checksum_of(payload));
  out.put(payload);
  graph::write_file(path, out.bytes());
}

std::optional<ModelLibrary> load_library(const fs::path& path, const std::string& key,
                                         std::string& why_not) {
  try {
    return parse(read_file(path), key);
  } catch (const std::exception& error) {
    why_not = error.what();
    return std::nullopt;
  }
}

std::string hash_files(const std::vector<fs::path>& files, const std::string& parameters) {
  const HashState state(XXH3_createState(), &XXH3_freeState);
  if (!state) throw std::bad_alloc();
  XXH3_128bits_reset(state.get());
  for (const fs::path& file : files) hash_file(state.get(), file);
  hash_text(state.get(), parameters);
  return hex(XXH3_128bits_digest(state.get()));
}

}  // namespace posevote::library

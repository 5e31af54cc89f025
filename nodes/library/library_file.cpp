// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/library_file.hpp"

#include <cstdint>
#include <fstream>
#include <stdexcept>

#include "graph/write_file.hpp"
#include "nodes/library/content_hash.hpp"
#include "nodes/library/library_payload.hpp"

namespace posevote::library {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "POSEVLIB";
constexpr std::uint32_t kVersion = 15;

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
  if (!in.rest().empty() || library::checksum(payload) != checksum)
    throw std::runtime_error("is damaged: its checksum is wrong");
  return decode_library(payload);
}

}  // namespace

std::string hash_library(const ModelLibrary& library) {
  Checksum sum;
  encode_library(library, [&](std::string_view piece) { sum.add(piece); });
  return sum.hex();
}

void save_library(const ModelLibrary& library, const fs::path& path, const std::string& key) {
  if (fs::exists(path) && !fs::is_regular_file(path)) fail(path, "is there, and no plain file");
  const std::string payload = encode_library(library);
  ByteWriter out;
  for (const char letter : kMagic) out.put(letter);
  out.put(kVersion);
  out.put(key);
  out.put(checksum(payload));
  out.put(payload);
  graph::write_file(path, out.take());
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

}  // namespace posevote::library

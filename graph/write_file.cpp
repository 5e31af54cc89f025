// SPDX-License-Identifier: BSD-3-Clause
#include "graph/write_file.hpp"

#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "graph/output_file.hpp"

namespace posevote::graph {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinished = ".tmp";

/// A name in the same folder that nobody else writes at the same time.
fs::path unique_neighbour(const fs::path& file) {
  std::random_device random;
  std::ostringstream suffix;
  suffix << "." << std::hex << random() << random() << kUnfinished;
  return file.string() + suffix.str();
}

/// One that unique_neighbour has made.
bool is_unfinished(const fs::path& file) {
  const std::string random = file.stem().extension().string();
  return file.extension() == kUnfinished && random.size() > 1 &&
         random.find_first_not_of("0123456789abcdef", 1) == std::string::npos;
}

void put(const fs::path& file, std::string_view bytes, bool durably, const fs::path& name) {
  OutputFile out(file, OutputFile::Start::kAnew, name);
  out.write(bytes);
  if (durably) out.sync();
  out.close();
}

[[noreturn]] void fail(const fs::path& file, const std::string& cause) {
  throw std::runtime_error(file.string() + ": cannot be written: " + cause);
}

void write(const fs::path& link, std::string_view bytes, bool durably) {
  std::error_code problem;
  const bool is_link = fs::is_symlink(fs::symlink_status(link, problem));
  const fs::path file = is_link ? fs::weakly_canonical(link, problem) : link;
  if (problem && is_link) fail(link, problem.message());
  const fs::file_status status = fs::status(file, problem);
  if (fs::is_directory(status)) fail(link, "is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) return put(file, bytes, false, link);
  const fs::path temporary = unique_neighbour(file);
  try {
    put(temporary, bytes, durably, link);
    fs::rename(temporary, file, problem);
    if (problem) fail(link, problem.message());
  } catch (const std::runtime_error&) {
    fs::remove(temporary, problem);
    throw;
  }
  if (durably) sync_file(file.has_parent_path() ? file.parent_path() : ".");
}

}  // namespace

void write_file(const fs::path& file, std::string_view bytes) { write(file, bytes, false); }

void write_durably(const fs::path& file, std::string_view bytes) { write(file, bytes, true); }

void remove_unfinished(const fs::path& folder) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (is_unfinished(entry.path())) fs::remove(entry.path(), none);
}

}  // namespace posevote::graph

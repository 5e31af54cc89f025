// SPDX-License-Identifier: BSD-3-Clause
#include "graph/write_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <random>
#include <sstream>
#include <stdexcept>

namespace posevote::graph {
namespace {

namespace fs = std::filesystem;

/// A name in the same folder that nobody else writes at the same time.
fs::path unique_neighbour(const fs::path& file) {
  std::random_device random;
  std::ostringstream suffix;
  suffix << "." << std::hex << random() << random() << ".tmp";
  return file.string() + suffix.str();
}

/// 0, or the errno of what failed; -1 where that said nothing.
int put(const fs::path& file, std::string_view bytes) {
  const auto problem = [] { return errno != 0 ? errno : -1; };
  errno = 0;
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  if (!stream) return problem();
  int error = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream) != bytes.size()) error = problem();
  errno = 0;
  if (std::fclose(stream) != 0 && error == 0) error = problem();
  return error;
}

/// 0, or the errno of what failed.
int sync(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int error = fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS ? 0 : errno;
  close(descriptor);
  return error;
}

[[noreturn]] void fail(const fs::path& file, const std::string& cause) {
  throw std::runtime_error(file.string() + ": cannot be written: " + cause);
}

}  // namespace

std::string cause_of(int error) {
  return error > 0 ? std::strerror(error) : "the system gives no cause; is the disk full?";
}

namespace {

void write(const fs::path& link, std::string_view bytes, bool durably) {
  std::error_code problem;
  const bool is_link = fs::is_symlink(fs::symlink_status(link, problem));
  const fs::path file = is_link ? fs::weakly_canonical(link, problem) : link;
  if (problem && is_link) fail(link, problem.message());
  const fs::file_status status = fs::status(file, problem);
  if (fs::is_directory(status)) fail(link, "is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    if (const int error = put(file, bytes)) fail(link, cause_of(error));
    return;
  }
  const fs::path temporary = unique_neighbour(file);
  int error = put(temporary, bytes);
  if (error == 0 && durably) error = sync(temporary);
  problem.clear();
  if (error == 0) fs::rename(temporary, file, problem);
  if (error == 0 && !problem) {
    if (durably) sync(file.has_parent_path() ? file.parent_path() : ".");
    return;
  }
  std::error_code ignored;
  fs::remove(temporary, ignored);
  fail(link, error != 0 ? cause_of(error) : problem.message());
}

}  // namespace

void write_file(const fs::path& file, std::string_view bytes) { write(file, bytes, false); }

void write_durably(const fs::path& file, std::string_view bytes) { write(file, bytes, true); }

void sync_file(const fs::path& file) {
  if (const int error = sync(file)) fail(file, cause_of(error));
}

}  // namespace posevote::graph

// SPDX-License-Identifier: BSD-3-Clause
#include "graph/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace posevote::graph {
namespace {

namespace fs = std::filesystem;

/// `call` until no signal interrupts it.
template <class Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// `write(rest, done)` until it has written all; false where it fails.
template <class Write>
bool write_all(std::string_view bytes, const Write& write) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t more = uninterrupted([&] { return write(bytes.substr(done), done); });
    if (more < 0) return false;
    done += static_cast<std::size_t>(more);
  }
  return true;
}

/// There are file systems that know no such thing.
bool sync(int descriptor) {
  return uninterrupted([&] { return fsync(descriptor); }) == 0 || errno == EINVAL || errno == EROFS;
}

[[noreturn]] void fail(const fs::path& file, int error) {
  throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(error));
}

}  // namespace

OutputFile::OutputFile(const fs::path& file, Start start, const fs::path& name)
    : name_(name.empty() ? file : name) {
  const int flags = start == Start::kAnew ? O_WRONLY | O_CREAT | O_TRUNC : O_WRONLY;
  descriptor_ = uninterrupted([&] { return open(file.c_str(), flags | O_CLOEXEC, 0666); });
  require(descriptor_ >= 0);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::string_view bytes) {
  require(write_all(bytes, [this](std::string_view rest, std::size_t) {
    return ::write(descriptor_, rest.data(), rest.size());
  }));
}

void OutputFile::write_at(std::uint64_t offset, std::string_view bytes) {
  require(write_all(bytes, [&](std::string_view rest, std::size_t done) {
    return pwrite(descriptor_, rest.data(), rest.size(), static_cast<off_t>(offset + done));
  }));
}

void OutputFile::cut(std::uint64_t size) {
  require(uninterrupted([&] { return ftruncate(descriptor_, static_cast<off_t>(size)); }) == 0);
}

void OutputFile::sync() { require(graph::sync(descriptor_)); }

void OutputFile::close() {
  // Linux has closed it even where a signal came between.
  require(::close(std::exchange(descriptor_, -1)) == 0 || errno == EINTR);
}

void OutputFile::require(bool success) const {
  if (!success) fail(name_, errno);
}

void sync_file(const fs::path& file) {
  const int descriptor = uninterrupted([&] { return open(file.c_str(), O_RDONLY | O_CLOEXEC); });
  if (descriptor < 0) fail(file, errno);
  const int error = sync(descriptor) ? 0 : errno;
  ::close(descriptor);
  if (error != 0) fail(file, error);
}

}  // namespace posevote::graph

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace posevote::graph {

/// A file that is written to, straight to the system: what a call has written outlasts a kill. A
/// call that a signal interrupts, or that writes a part only, is gone on with. Every member throws
/// std::runtime_error "FILE: cannot be written: cause" where it fails.
class OutputFile {
 public:
  enum class Start {
    kAnew,   ///< empty, and made where there is none
    kThere,  ///< as it is; it must be there
  };

  /// `name`: what errors call it, where that is not its own.
  OutputFile(const std::filesystem::path& file, Start start,
             const std::filesystem::path& name = {});
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Closes it; whether all has been written, close() alone can tell.
  ~OutputFile();

  /// From where the last one ended: the start of the file at first.
  void write(std::string_view bytes);
  void write_at(std::uint64_t offset, std::string_view bytes);
  void cut(std::uint64_t size);
  /// Puts on the disk what has been written.
  void sync();
  void close();

 private:
  void require(bool success) const;

  std::filesystem::path name_;
  int descriptor_ = -1;
};

/// Puts on the disk what has been written to a file, or which names a folder has. Throws as
/// OutputFile does.
void sync_file(const std::filesystem::path& file);

}  // namespace posevote::graph

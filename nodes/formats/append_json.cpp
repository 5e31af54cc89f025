// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/append_json.hpp"

#include <cerrno>
#include <stdexcept>
#include <utility>

#include "graph/write_file.hpp"

namespace posevote::formats {

AppendJson::AppendJson(std::filesystem::path file, const std::string& head, std::string tail)
    : file_(std::move(file)), tail_(std::move(tail)) {
  graph::write_file(file_, head + tail_);
  stream_.open(file_, std::ios::in | std::ios::out | std::ios::binary);
  if (!stream_)
    throw std::runtime_error(file_.string() + ": cannot be opened: " + graph::cause_of(errno));
  end_ = static_cast<std::streamoff>(head.size());
}

AppendJson::AppendJson(std::filesystem::path file, std::string tail)
    : file_(std::move(file)), tail_(std::move(tail)) {
  stream_.open(file_, std::ios::in | std::ios::out | std::ios::binary);
  stream_.seekg(-static_cast<std::streamoff>(tail_.size()) - 1, std::ios::end);
  empty_ = stream_.get() == '[';
  end_ = stream_.tellg();
  if (!stream_) throw std::runtime_error(file_.string() + ": is not what this run began");
}

void AppendJson::append(const std::string& item, const std::string& tail) {
  stream_.seekp(end_);
  const std::string text = (empty_ ? "\n" : ",\n") + item;
  try {
    put(text + tail);
  } catch (const std::runtime_error&) {
    stream_.clear();
    stream_.seekp(end_);
    stream_ << tail_ << std::flush;  // the old tail's bytes are the file's already
    std::filesystem::resize_file(file_, std::size_t(end_) + tail_.size());
    throw;
  }
  end_ += static_cast<std::streamoff>(text.size());
  std::filesystem::resize_file(file_, std::size_t(end_) + tail.size());
  tail_ = tail;
  empty_ = false;
}

void AppendJson::put(const std::string& text) {
  errno = 0;
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream_.flush();
  if (!stream_)
    throw std::runtime_error(file_.string() + ": cannot be written: " + graph::cause_of(errno));
}

}  // namespace posevote::formats

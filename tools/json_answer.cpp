// SPDX-License-Identifier: BSD-3-Clause
#include "tools/json_answer.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <string>

namespace posevote {
namespace {

void flush() {
  std::cout.flush();
  std::fflush(stdout);
}

void write_all(int file, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::write(file, text.data() + at, text.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      throw std::runtime_error(std::string("standard output: ") + std::strerror(errno));
    at += static_cast<std::size_t>(written);
  }
}

}  // namespace

JsonAnswer::JsonAnswer(bool wanted) {
  if (!wanted) return;
  flush();
  stdout_ = ::dup(STDOUT_FILENO);
  if (stdout_ < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
    throw std::runtime_error(std::string("standard output: ") + std::strerror(errno));
}

JsonAnswer::~JsonAnswer() {
  if (!wanted()) return;
  flush();
  ::dup2(stdout_, STDOUT_FILENO);
  ::close(stdout_);
}

void JsonAnswer::give(const nlohmann::ordered_json& answer) const {
  if (wanted())
    write_all(stdout_,
              answer.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace posevote

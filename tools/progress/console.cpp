// SPDX-License-Identifier: BSD-3-Clause
#include "tools/progress/console.hpp"

#include <fcntl.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <streambuf>
#include <string_view>

#include "tools/text.hpp"

namespace posevote::console {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kEraseLine = "\r\x1b[K";

std::mutex mutex;
std::string drawn;  ///< the live line as it stands on the terminal
Clock::time_point last_line = Clock::now();

bool has_value(const char* name) {
  const char* value = std::getenv(name);
  return value && *value;
}

bool understands_escapes() {
  static const bool answer =
      has_value("TERM") && std::string_view(std::getenv("TERM")) != "dumb" && isatty(STDERR_FILENO);
  return answer;
}

std::size_t columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

/// All but line ends and tabs.
std::string printable_lines(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of("\n\t");
    safe += printable(std::string(text.substr(0, end)));
    if (end == std::string_view::npos) break;
    safe += text[end];
    text.remove_prefix(end + 1);
  }
  return safe;
}

/// With the mutex held.
void erase() {
  if (drawn.empty()) return;
  std::fputs(kEraseLine, stderr);
  std::fflush(stderr);
  drawn.clear();
}

void put(std::FILE* file, const std::string& text) {
  const std::lock_guard lock(mutex);
  erase();
  std::fwrite(text.data(), 1, text.size(), file);
  std::fflush(file);
  last_line = Clock::now();
}

/// Passes whole lines on: the live line is not to be drawn in the middle of one.
class Lines : public std::streambuf {
 public:
  explicit Lines(std::FILE* file) : file_(file) {}

  /// The last line may lack its end.
  void finish() {
    if (!text_.empty()) put(file_, printable_lines(text_));
    text_.clear();
  }

 private:
  int_type overflow(int_type c) override {
    if (c != traits_type::eof()) text_ += traits_type::to_char_type(c);
    if (c == '\n') sync();
    return traits_type::not_eof(c);
  }
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    text_.append(text, static_cast<std::size_t>(count));
    if (text_.ends_with('\n')) sync();
    return count;
  }
  int sync() override {
    const std::size_t end = text_.rfind('\n') + 1;  // 0 where there is none
    if (end > 0) put(file_, printable_lines(std::string_view(text_).substr(0, end)));
    text_.erase(0, end);
    return std::ferror(file_) ? -1 : 0;
  }

  std::FILE* file_;
  std::string text_;
};

/// Never destroyed: the standard streams flush them last of all.
Lines& lines_of(std::FILE* file) {
  static Lines& out = *new Lines(stdout);
  static Lines& err = *new Lines(stderr);
  return file == stdout ? out : err;
}

/// "error: ...", the first word in colour on a terminal that wants it.
class Log : public spdlog::sinks::base_sink<std::mutex> {
 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const bool coloured = understands_escapes() && !has_value("NO_COLOR");
    const char* colour = message.level >= spdlog::level::err    ? "\x1b[31m"
                         : message.level == spdlog::level::warn ? "\x1b[33m"
                                                                : "\x1b[32m";
    const auto level = spdlog::level::to_string_view(message.level);
    const std::string word(level.data(), level.size());
    put(stderr, (coloured ? colour + word + "\x1b[0m" : word) + ": " +
                    printable_lines({message.payload.data(), message.payload.size()}) + "\n");
  }
  void flush_() override {}
};

void open_closed(int descriptor) {
  if (fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) (void)!open("/dev/null", O_RDWR);
}

}  // namespace

void begin() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) open_closed(descriptor);
  std::cout.rdbuf(&lines_of(stdout));
  std::cerr.rdbuf(&lines_of(stderr));
  std::atexit([] {
    lines_of(stdout).finish();
    lines_of(stderr).finish();
  });
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("posevote", std::make_shared<Log>()));
}

bool is_live() { return understands_escapes(); }

void draw(const std::string& text) {
  if (!understands_escapes()) return;
  const std::string shown = cut_to_width(printable(text), columns() - 1);
  const std::lock_guard lock(mutex);
  if (shown == drawn) return;
  std::fputs((kEraseLine + shown).c_str(), stderr);
  std::fflush(stderr);
  drawn = shown;
}

void complain(const std::string& line) { put(stderr, printable_lines(line) + "\n"); }

double silence() {
  const std::lock_guard lock(mutex);
  return std::chrono::duration<double>(Clock::now() - last_line).count();
}

std::string cut_to_width(const std::string& text, std::size_t columns) {
  std::size_t used = 0, end = 0;
  while (end < text.size()) {
    std::size_t next = end + 1;
    while (next < text.size() && (static_cast<unsigned char>(text[next]) & 0xC0) == 0x80) ++next;
    used += next - end == 1 ? 1 : 2;
    if (used > columns) return text.substr(0, end);
    end = next;
  }
  return text;
}

}  // namespace posevote::console

// SPDX-License-Identifier: BSD-3-Clause
// --json: what a command's tables say, for programs.
#pragma once

#include <nlohmann/json.hpp>

namespace posevote {

/// While it lives and is `wanted`, whatever is printed goes to standard error, so that standard
/// output holds the answer and nothing else.
class JsonAnswer {
 public:
  explicit JsonAnswer(bool wanted);
  ~JsonAnswer();
  JsonAnswer(const JsonAnswer&) = delete;
  JsonAnswer& operator=(const JsonAnswer&) = delete;

  bool wanted() const { return stdout_ >= 0; }
  /// Prints it to standard output, if it is wanted. Numbers that are not finite become null, bytes
  /// that are no UTF-8 U+FFFD. Throws std::runtime_error where it cannot be written.
  void give(const nlohmann::ordered_json& answer) const;

 private:
  int stdout_ = -1;
};

}  // namespace posevote

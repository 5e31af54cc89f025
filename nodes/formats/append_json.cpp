// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/append_json.hpp"

#include <fstream>
#include <stdexcept>
#include <utility>

#include "graph/output_file.hpp"

namespace posevote::formats {

AppendJson::AppendJson(std::filesystem::path file, std::string tail)
    : file_(std::move(file)), tail_(std::move(tail)) {
  std::ifstream stream(file_, std::ios::binary);
  if (!stream) throw std::runtime_error(file_.string() + ": cannot be read");
  stream.seekg(-static_cast<std::streamoff>(tail_.size()) - 1, std::ios::end);
  empty_ = stream.get() == '[';
  end_ = static_cast<std::uint64_t>(stream.tellg());
  if (!stream) throw std::runtime_error(file_.string() + ": is not what this run began");
}

void AppendJson::append(const std::string& item, const std::string& tail) {
  const std::string text = (empty_ ? "\n" : ",\n") + item;
  graph::OutputFile out(file_, graph::OutputFile::Start::kThere);
  const auto end_with = [&](const std::string& bytes) {
    out.write_at(end_, bytes);
    out.cut(end_ + bytes.size());
  };
  try {
    end_with(text + tail);
  } catch (const std::runtime_error&) {
    end_with(tail_);  // its bytes are the file's already
    throw;
  }
  out.close();
  end_ += text.size();
  tail_ = tail;
  empty_ = false;
}

std::string json_list(const std::string& head, const std::vector<std::string>& items,
                      const std::string& tail) {
  std::string text = head;
  for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "\n" : ",\n") + items[i];
  return text + tail;
}

}  // namespace posevote::formats

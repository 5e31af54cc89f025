// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/frames.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "nodes/formats/file_bytes.hpp"
#include "tools/report/folder.hpp"
#include "tools/report/html.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPart = 100;  // frames that are folded together

/// The pictures of a run.
class Pictures {
 public:
  Pictures(const fs::path& folder, std::size_t& left) : left_(left) {
    for (const fs::path& file : list_folder(folder / "pictures"))
      if (file.extension() == ".png") files_[mend_utf8(file.stem().string())] = file;
  }

  /// "" where there is none, or none that can be read, or the page is full.
  std::string thumbnail(const AnsweredFrame& frame) {
    const auto file = files_.find(frame.name);
    if (file == files_.end()) return "";
    if (left_ == 0) return ++left_out_, "";
    try {
      const formats::FileBytes bytes = formats::read_file(file->second);
      if (!bytes.view().starts_with("\x89PNG")) return "";
      --left_, ++shown_;
      return html::image("png", bytes.view(), "picture of " + frame.name,
                         "class=\"thumbnail\" tabindex=\"0\"");  // with the focus, it is enlarged
    } catch (const std::runtime_error&) {
      return "";
    }
  }

  std::string note() const {
    if (shown_ + left_out_ == 0) return "";
    std::string text = "Click a picture to enlarge it.";
    if (left_out_ > 0)
      text = fmt::format("{} of {} pictures are on this page; --pictures N takes more. ", shown_,
                         shown_ + left_out_) +
             text;
    return html::paragraph(text);
  }

 private:
  std::size_t& left_;
  std::size_t shown_ = 0, left_out_ = 0;
  std::map<std::string, fs::path> files_;  ///< by name in UTF-8
};

constexpr html::Kind kNumber = html::Kind::kNumber;
const std::vector<html::Column> kColumns = {{"frame", kNumber},      {"scan", html::Kind::kLong},
                                            {"time [s]", kNumber},   {"model"},
                                            {"confidence", kNumber}, {"density", kNumber},
                                            {"runner-up", kNumber},  {"inliers [%]", kNumber},
                                            {"RMSE [mm]", kNumber}};
constexpr std::size_t kFirstOfObject = 3;

html::Row object_cells(const FoundObject& found) {
  return {escape_markup(found.model),
          html::number(found.confidence, 3),
          html::number(found.density, 0),
          html::number(found.runner_up_density, 0),
          html::number(100 * found.inlier_fraction, 0),
          html::number(1000 * found.rmse, 2)};
}

/// A row for each detection; the frame's own cells reach over all of them.
std::string frame_rows(const AnsweredFrame& frame, Pictures& pictures) {
  const std::size_t rows = std::max<std::size_t>(1, frame.found.size());
  std::string text =
      "<tbody><tr>" + html::cell(html::number(frame.number, 0), kColumns[0], rows) +
      html::cell(html::path(frame.file) + pictures.thumbnail(frame), kColumns[1], rows) +
      html::cell(html::number(frame.seconds, 2), kColumns[2], rows);
  for (std::size_t r = 0; r < rows; ++r) {
    const html::Row cells = frame.found.empty() ? html::Row{"nothing found", "", "", "", "", ""}
                                                : object_cells(frame.found[r]);
    if (r > 0) text += "<tr>";
    for (std::size_t c = 0; c < cells.size(); ++c)
      text += html::cell(cells[c], kColumns[kFirstOfObject + c]);
    text += "</tr>\n";
  }
  return text + "</tbody>\n";
}

}  // namespace

std::string frames_markup(const RunResults& run, const fs::path& folder, std::size_t& left,
                          bool open) {
  if (run.frames.empty()) return "";
  Pictures pictures(folder, left);
  std::string parts;
  for (std::size_t begin = 0; begin < run.frames.size(); begin += kPart) {
    const std::size_t end = std::min(begin + kPart, run.frames.size());
    std::string rows;
    for (std::size_t i = begin; i < end; ++i) rows += frame_rows(run.frames[i], pictures);
    const std::string title =
        fmt::format("Frames {} to {}", html::number(run.frames[begin].number, 0),
                    html::number(run.frames[end - 1].number, 0));
    parts += html::fold(title, "<div class=\"frames\">" + html::table(kColumns, rows) + "</div>\n",
                        open && begin == 0);
  }
  return html::heading("Frames") + pictures.note() + parts;
}

}  // namespace posevote

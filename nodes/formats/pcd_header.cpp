// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/pcd_header.hpp"

#include <stdexcept>
#include <string_view>

#include "nodes/formats/file_bytes.hpp"

namespace posevote::formats {
namespace {

/// Real files have some ten, and names are searched.
constexpr std::size_t kMostFields = 1000;

/// The header while it is being read: what must have been said, and what must agree in the end.
struct Draft {
  PcdHeader header;
  std::optional<std::uint64_t> width, height, points;
};

void read_fields(TextScanner& in, PcdHeader& header) {
  if (!header.fields.empty()) in.fail("a second line FIELDS");
  while (!in.line_done()) {
    if (header.fields.size() == kMostFields) in.fail("too many fields");
    PcdField field;
    field.name = in.word();
    if (field.name != "_" && header.find(field.name))
      in.fail("a second field " + in_quotes(field.name));
    header.fields.push_back(std::move(field));
  }
}

/// SIZE, TYPE and COUNT: one word a field.
template <class Set>
void read_per_field(TextScanner& in, PcdHeader& header, const Set& set) {
  for (PcdField& field : header.fields) {
    if (in.line_done()) in.fail("fewer values than FIELDS has names");
    set(field);
  }
  if (header.fields.empty() || !in.line_done()) in.fail("more values than FIELDS has names");
}

PcdData read_data(TextScanner& in) {
  const std::string_view word = in.word();
  if (word == "ascii") return PcdData::kAscii;
  if (word == "binary") return PcdData::kBinary;
  if (word == "binary_compressed") return PcdData::kBinaryCompressed;
  in.fail("expected DATA ascii, binary or binary_compressed, found " + in_quotes(word));
}

void read_entry(TextScanner& in, std::string_view keyword, Draft& draft) {
  PcdHeader& header = draft.header;
  if (keyword == "FIELDS" || keyword == "COLUMNS") {
    read_fields(in, header);
  } else if (keyword == "SIZE") {
    read_per_field(in, header, [&](PcdField& f) { f.size = read_count(in, "bytes of a value"); });
  } else if (keyword == "TYPE") {
    read_per_field(in, header, [&](PcdField& f) {
      const std::string_view type = in.word();
      if (type != "F" && type != "I" && type != "U")
        in.fail("expected a type F, I or U, found " + in_quotes(type));
      f.type = type[0];
    });
  } else if (keyword == "COUNT") {
    read_per_field(in, header, [&](PcdField& f) { f.count = read_count(in, "values of a field"); });
  } else if (keyword == "WIDTH") {
    draft.width = read_count(in, "points in a row");
  } else if (keyword == "HEIGHT") {
    draft.height = read_count(in, "rows");
  } else if (keyword == "POINTS") {
    draft.points = read_count(in, "points");
  } else if (keyword == "VIEWPOINT") {
    for (double& coordinate : header.viewpoint) coordinate = in.number();
  } else if (keyword == "DATA") {
    header.data = read_data(in);
  } else if (keyword != "VERSION") {
    in.fail("expected a line of a PCD header, found " + in_quotes(keyword));
  }
}

void check_fields(const PcdHeader& header) {
  for (const PcdField& field : header.fields) {
    const bool whole = field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8;
    if (!whole || (field.type == 'F' && field.size < 4))
      throw std::runtime_error("the PCD header gives field " + in_quotes(field.name) + " type " +
                               field.type + " and size " + std::to_string(field.size));
  }
  for (const std::string axis : {"x", "y", "z"}) {
    const auto at = header.find(axis);
    if (!at || header.fields[*at].count != 1)
      throw std::runtime_error("the PCD header has no single field " + axis +
                               ", expected x, y and z");
  }
}

std::uint64_t agreed_points(const Draft& draft) {
  if (!draft.points && !draft.width)
    throw std::runtime_error("the PCD header says neither POINTS nor WIDTH");
  if (!draft.width) return *draft.points;
  const std::uint64_t height = draft.height.value_or(1);
  if (height > 0 && *draft.width > (std::uint64_t{1} << 32) / height)
    throw std::runtime_error("the PCD header claims more than 2^32 points: WIDTH " +
                             std::to_string(*draft.width) + ", HEIGHT " + std::to_string(height));
  const std::uint64_t grid = *draft.width * height;
  if (draft.points && *draft.points != grid)
    throw std::runtime_error("the PCD header contradicts itself: POINTS " +
                             std::to_string(*draft.points) + ", WIDTH x HEIGHT " +
                             std::to_string(grid));
  return grid;
}

}  // namespace

std::optional<std::size_t> PcdHeader::find(const std::string& field) const {
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fields[i].name == field) return i;
  return std::nullopt;
}

std::uint64_t PcdHeader::point_bytes() const {
  std::uint64_t sum = 0;  // at most 2^32 x 8 a field, so kMostFields of them fit
  for (const PcdField& field : fields)
    if (data != PcdData::kBinaryCompressed || field.name != "_") sum += field.bytes();
  return sum;
}

std::uint64_t PcdHeader::point_values() const {
  std::uint64_t sum = 0;
  for (const PcdField& field : fields) sum += field.count;
  return sum;
}

PcdHeader read_pcd_header(TextScanner& in) {
  Draft draft;
  while (in.next_line()) {
    const std::string_view keyword = in.word();
    read_entry(in, keyword, draft);
    if (keyword != "DATA") continue;
    if (draft.header.fields.empty()) in.fail("DATA before FIELDS");
    check_fields(draft.header);
    draft.header.points = agreed_points(draft);
    return draft.header;
  }
  in.fail("the file ends within the header: no DATA");
}

}  // namespace posevote::formats

// SPDX-License-Identifier: BSD-3-Clause
// Pieces of an HTML page. What is called `markup` is put in as it is; all other text is escaped.
// Every tag is closed.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace posevote::html {

std::string base64(std::string_view bytes);

/// An <img> that holds its bytes. A plot in it stays what it is: its identifiers cannot clash with
/// another plot's, and a torn one cannot break the page.
std::string image(const std::string& type, std::string_view bytes, const std::string& description,
                  const std::string& attributes);

/// A file's name, which may be broken after its slashes.
std::string path(const std::string& file);

/// With that many digits behind the point; "-" for what is not finite.
std::string number(double value, int digits);

enum class Kind {
  kText,
  kNumber,  ///< to the right
  kLong     ///< broken wherever need be: paths, messages
};
struct Column {
  std::string head;
  Kind kind = Kind::kText;
};
using Row = std::vector<std::string>;  ///< markup of each column's cell

std::string cell(const std::string& markup, const Column& column, std::size_t rows = 1);
/// <thead>...</thead> and `body`, <tbody>s.
std::string table(const std::vector<Column>& columns, const std::string& body);
/// At most so many rows; says how many there are more.
std::string table(const std::vector<Column>& columns, const std::vector<Row>& rows,
                  std::size_t most = std::numeric_limits<std::size_t>::max());

std::string heading(const std::string& text);
std::string paragraph(const std::string& text);
/// Folded, until it is clicked.
std::string fold(const std::string& summary, const std::string& markup, bool open = false);

/// A part of a page.
struct Section {
  std::string title, markup;
};
/// The whole page, with links to its sections where there are several.
std::string page(const std::string& title, const std::vector<Section>& sections);

}  // namespace posevote::html

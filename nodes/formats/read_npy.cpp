// SPDX-License-Identifier: BSD-3-Clause
// Reads depth images: NumPy's .npy, an array of height x width. uint16 is raw depth, as in a PNG;
// float32 and float64 are metres.
//
// The header is a Python dictionary: {'descr': '<u2', 'fortran_order': False, 'shape': (480, 640), }
#include <regex>
#include <stdexcept>
#include <string>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"

namespace posevote::formats {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kMostPixelsAside = 8192;
constexpr std::size_t kMostHeader = 4096;

struct Header {
  std::string text;
  std::size_t size = 0;  ///< of all that stands before the data
};

Header read_header(std::string_view bytes) {
  if (!bytes.starts_with(kMagic) || bytes.size() < kMagic.size() + 6)
    throw std::runtime_error("not a NumPy file: starts with " + in_quotes(bytes));
  const int version = static_cast<unsigned char>(bytes[kMagic.size()]);
  const char* at = bytes.data() + kMagic.size() + 2;
  const std::size_t before = kMagic.size() + 2 + (version == 1 ? 2 : 4);
  const std::size_t length =
      version == 1 ? load_bytes<std::uint16_t>(at) : load_bytes<std::uint32_t>(at);
  if (length > kMostHeader || length > bytes.size() - std::min(before, bytes.size()))
    throw std::runtime_error("damaged NumPy file: its header claims " + std::to_string(length) +
                             " bytes");
  return {std::string(bytes.substr(before, length)), before + length};
}

/// What a pattern's group finds in the header.
std::smatch find(const std::string& header, const char* key, const std::string& pattern) {
  std::smatch found;
  if (!std::regex_search(header, found, std::regex("'" + std::string(key) + "': *" + pattern)))
    throw std::runtime_error("damaged NumPy file: no " + std::string(key) + " in " +
                             in_quotes(header));
  return found;
}

/// Width and height. A longer number than any image's is no number here.
DepthImage read_shape(const std::string& header) {
  const std::string shape = find(header, "shape", "(\\([^)]*\\))")[1];
  std::smatch sides;
  static const std::regex two("\\((\\d{1,5}), *(\\d{1,5}),?\\)");
  if (!std::regex_match(shape, sides, two))
    throw std::runtime_error("not a depth image: an array of shape " + in_quotes(shape) +
                             ", expected (height, width)");
  DepthImage image{std::stoul(sides[2]), std::stoul(sides[1])};
  if (image.width > kMostPixelsAside || image.height > kMostPixelsAside)
    throw std::runtime_error("damaged NumPy file: claims " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " pixels");
  return image;
}

template <class Stored, class Value>
void read_values(std::string_view data, std::endian order, std::size_t count,
                 std::vector<Value>& values) {
  if (data.size() < count * sizeof(Stored))
    throw std::runtime_error("damaged NumPy file: ends after " + std::to_string(data.size()) +
                             " of " + std::to_string(count * sizeof(Stored)) + " bytes of data");
  if (!is_padding(data.substr(count * sizeof(Stored))))
    throw std::runtime_error("damaged NumPy file: more data than its shape says");
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(
        static_cast<Value>(load_bytes<Stored>(data.data() + i * sizeof(Stored), order)));
}

DepthImage read_npy(std::string_view bytes) {
  const Header header = read_header(bytes);
  DepthImage image = read_shape(header.text);
  if (find(header.text, "fortran_order", "(True|False)")[1] == "True")
    throw std::runtime_error("its values stand column by column; save numpy.ascontiguousarray()");
  const std::smatch type = find(header.text, "descr", "'([<>|=]?)(\\w+)'");
  const std::endian order = type[1] == ">" ? std::endian::big : std::endian::little;
  const std::string_view data = bytes.substr(header.size);
  const std::size_t count = image.width * image.height;
  if (type[2] == "u2")
    read_values<std::uint16_t>(data, order, count, image.values);
  else if (type[2] == "f4")
    read_values<float>(data, order, count, image.metres);
  else if (type[2] == "f8")
    read_values<double>(data, order, count, image.metres);
  else
    throw std::runtime_error("holds values of type " + in_quotes(type[2].str()) +
                             ", expected uint16 (raw), float32 or float64 (metres)");
  return image;
}

const auto registered = register_format("NumPy", {".npy"}, read_npy);

}  // namespace
}  // namespace posevote::formats

// SPDX-License-Identifier: BSD-3-Clause
// A model library as a string of bytes and back; what is around it in the file is library_file's.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "nodes/data/model.hpp"

namespace posevote::library {

/// Appends values, lengths before contents.
class ByteWriter {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T value) { put_all(&value, 1); }
  void put(std::string_view text) {
    put(std::uint64_t{text.size()});
    put_all(text.data(), text.size());
  }
  template <class Matrix>
  void put_matrix(const Matrix& matrix) {
    put(static_cast<std::uint64_t>(matrix.rows()));
    put(static_cast<std::uint64_t>(matrix.cols()));
    put_all(matrix.data(), static_cast<std::size_t>(matrix.size()));
  }
  /// As they lie in memory, without their number.
  template <class T>
  void put_all(const T* values, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  /// What was put since the last time.
  std::string take() { return std::exchange(bytes_, {}); }

 private:
  std::string bytes_;
};

/// Reads them back. Trusts no length: throws std::runtime_error before it would allocate more than
/// there are bytes left.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view get_text() { return take(get<std::uint64_t>()); }
  template <class Matrix>
  Matrix get_matrix() {
    const auto rows = get<std::uint64_t>(), columns = get<std::uint64_t>();
    constexpr int kColumns = Matrix::ColsAtCompileTime;
    if (kColumns != Eigen::Dynamic && columns != static_cast<std::uint64_t>(kColumns))
      throw std::runtime_error("is damaged: a matrix has the wrong number of columns");
    if ((columns == 0) != (rows == 0) && kColumns == Eigen::Dynamic)
      throw std::runtime_error("is damaged: a matrix has rows or columns only");
    if (columns > 0 && rows > rest_.size() / sizeof(typename Matrix::Scalar) / columns)
      throw std::runtime_error("is damaged: it ends within a matrix");
    Matrix matrix(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    get_all(matrix.data(), rows * columns);
    return matrix;
  }
  /// So many that are not more than there are bytes left.
  template <class T>
  void get_all(T* values, std::uint64_t count) {
    const std::string_view bytes = take(count * sizeof(T));
    if (!bytes.empty()) std::memcpy(values, bytes.data(), bytes.size());
  }
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) throw std::runtime_error("is damaged: it ends too early");
    const std::string_view head = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return head;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

/// Everything but the index, of which the options are kept. Throws std::runtime_error for a library
/// that is not sound: what is written can be read.
std::string encode_library(const ModelLibrary& library);
/// The same bytes, of which each piece goes to `sink`: the whole is large, and need not be in memory.
void encode_library(const ModelLibrary& library,
                    const std::function<void(std::string_view piece)>& sink);

/// The library, with an index built anew. Throws std::runtime_error "is damaged: ..." if the bytes
/// are not what encode_library made or do not fit together.
ModelLibrary decode_library(std::string_view bytes);

}  // namespace posevote::library

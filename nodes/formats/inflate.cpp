// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/inflate.hpp"

#include <bzlib.h>
#include <lz4frame.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "nodes/formats/file_bytes.hpp"

namespace posevote::formats {
namespace {

constexpr std::size_t kStep = 1 << 20;  ///< by which what is made grows [bytes]
constexpr std::size_t kMost =
    1 << 30;  ///< recorders begin a new chunk after less than 1 MB [bytes]

/// Calls `step(to, room)`, which returns how much it made there: 0 where there is no more.
template <class Step>
std::string grow(std::size_t size, const Step& step) {
  std::string made;
  for (;;) {
    const std::size_t before = made.size();
    made.resize(before + std::min(kStep, size + 1 - before));
    const std::size_t count = step(made.data() + before, made.size() - before);
    made.resize(before + count);
    if (made.size() > size || count == 0) break;
  }
  if (made.size() == size) return made;
  throw std::runtime_error("damaged bag: a chunk holds " +
                           std::string(made.size() > size ? "more" : "less") + " than the " +
                           std::to_string(size) + " bytes that it claims");
}

[[noreturn]] void fail_inside() {
  throw std::runtime_error("damaged bag: a chunk cannot be decompressed");
}

std::string inflate_lz4(std::string_view bytes, std::size_t size) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION))) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, &LZ4F_freeDecompressionContext);
  return grow(size, [&](char* to, std::size_t room) {
    std::size_t count = 0, taken = 1;
    while (count == 0 && taken > 0) {  // what it took before may be to come yet
      taken = bytes.size();
      count = room;
      if (LZ4F_isError(LZ4F_decompress(context.get(), to, &count, bytes.data(), &taken, nullptr)))
        fail_inside();
      bytes.remove_prefix(taken);
    }
    return count;
  });
}

std::string inflate_bz2(std::string_view bytes, std::size_t size) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> context(&stream,
                                                                           &BZ2_bzDecompressEnd);
  std::string input(bytes);  // the library's pointer is not const
  stream.next_in = input.data();
  stream.avail_in = static_cast<unsigned>(input.size());
  bool ended = false;
  return grow(size, [&](char* to, std::size_t room) -> std::size_t {
    if (ended) return 0;
    stream.next_out = to;
    stream.avail_out = static_cast<unsigned>(room);
    const int result = BZ2_bzDecompress(&stream);
    if (result != BZ_OK && result != BZ_STREAM_END) fail_inside();
    ended = result == BZ_STREAM_END;
    return room - stream.avail_out;
  });
}

}  // namespace

std::string inflate(std::string_view bytes, const std::string& compression, std::size_t size) {
  if (size > kMost)
    throw std::runtime_error("a chunk claims " + std::to_string(size) + " bytes, expected " +
                             std::to_string(kMost) + " at most");
  if (compression == "lz4") return inflate_lz4(bytes, size);
  if (compression == "bz2") return inflate_bz2(bytes, size);
  throw std::runtime_error("its chunks are compressed by " + in_quotes(compression) +
                           ", expected none, bz2 or lz4");
}

}  // namespace posevote::formats

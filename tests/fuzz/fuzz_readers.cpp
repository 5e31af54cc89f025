// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer's program (https://llvm.org/docs/LibFuzzer.html), for any reader:
//
//   fuzz_readers --list                                 the names of all
//   fuzz_readers --reader=ply --samples=DIR             writes its samples as a first corpus
//   fuzz_readers --reader=ply [libFuzzer's options] DIR
//
// tools/fuzz does all of that. libFuzzer leaves options with two dashes to us.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/reader.hpp"

namespace {

namespace fs = std::filesystem;
using posevote::test::Reader;

const Reader* chosen = nullptr;

/// What stands behind "--name=" among the arguments; "" where it is not.
std::string option(int argc, char** argv, const std::string& name) {
  const std::string head = "--" + name + "=";
  for (int i = 1; i < argc; ++i)
    if (std::string(argv[i]).starts_with(head)) return argv[i] + head.size();
  return "";
}

void list_readers() {
  for (const Reader& reader : posevote::test::readers()) std::puts(reader.name.c_str());
}

void write_samples(const Reader& reader, const fs::path& folder) {
  fs::create_directories(folder);
  for (const auto& sample : reader.samples)
    std::ofstream(folder / sample.name, std::ios::binary) << sample.bytes;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc == 2 && std::string((*argv)[1]) == "--list") {
    list_readers();
    std::exit(0);
  }
  const std::string name = option(*argc, *argv, "reader");
  for (const Reader& reader : posevote::test::readers())
    if (reader.name == name) chosen = &reader;
  if (!chosen) {
    std::fprintf(stderr, "no reader '%s'; --list names them\n", name.c_str());
    std::exit(2);
  }
  if (const std::string samples = option(*argc, *argv, "samples"); !samples.empty()) {
    write_samples(*chosen, samples);
    std::exit(0);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  posevote::test::takes(*chosen, {reinterpret_cast<const char*>(data), size});
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/load/read_cloud.hpp"

#include <cctype>
#include <map>
#include <stdexcept>
#include <string>

#include "nodes/load/file_bytes.hpp"
#include "nodes/load/raw_mesh.hpp"

namespace posevote::load {

Cloud read_cloud(const std::filesystem::path& path, double metres_per_unit) {
  static const std::map<std::string, RawMesh (*)(std::string_view)> kReaders{{".ply", read_ply},
                                                                             {".pcd", read_pcd},
                                                                             {".obj", read_obj},
                                                                             {".stl", read_stl},
                                                                             {".off", read_off}};
  const FileBytes bytes = read_file(path);
  const auto reader = kReaders.find(lower_extension(path));
  if (reader == kReaders.end())
    throw std::runtime_error("unknown extension " + in_quotes(path.extension().string()) +
                             ", expected .ply, .pcd, .obj, .stl or .off");
  return to_cloud(reader->second(bytes.view()), metres_per_unit);
}

double metres_per(const std::string& unit) { return unit == "mm" ? 0.001 : 1.0; }

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace posevote::load
